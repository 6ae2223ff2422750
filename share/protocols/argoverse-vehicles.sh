#!/usr/bin/env bash
# The paper's table on vehicles of Argoverse 1: their points only, within 32 m by 8 m of the road, 2048 of them.
#   share/protocols/argoverse-vehicles.sh <folder of tracking logs, as argoverse-tracking/val> [log ...]     default: all
. "$(dirname "$0")/common.sh"
root=${1:?usage: $0 <folder of tracking logs> [log ...]}; shift
need_folder "$root" "Argoverse 1 tracking logs"
[ $# -gt 0 ] || { cd "$root"; set -- *; cd - > /dev/null; }
for log in "$@"; do
  "$(tool argoverse2rawlog)" --log "$root/$log" --output "$out/$log.rawlog" --boxes "$out/${log}_boxes.csv" \
    --truth-objects "$out/${log}_objects.csv" --overwrite
  densify_withheld "$log" --detections "$out/${log}_boxes.csv"
  comparisons+=(--truth-objects "$out/${log}_objects.csv")
done
print_table --protocol argoverse-vehicles
