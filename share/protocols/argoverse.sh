#!/usr/bin/env bash
# The paper's table on Argoverse 1: 16384 points, then the front camera's view, boxes given by the annotations.
#   share/protocols/argoverse.sh <folder of tracking logs, as argoverse-tracking/val> [log ...]     default: all
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
print_table --protocol argoverse
