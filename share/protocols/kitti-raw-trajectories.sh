#!/usr/bin/env bash
# The paper's table of depth errors on vehicles' trajectories of the KITTI raw set, boxes given by the tracklets.
#   share/protocols/kitti-raw-trajectories.sh <folder 2011_09_26 with its drives> [drive ...]   default: 0004 0047 0056
. "$(dirname "$0")/common.sh"
root=${1:?usage: $0 <folder 2011_09_26 with its drives> [drive ...]}; shift
config=$project/config/kitti.ini
[ $# -gt 0 ] || set -- 0004 0047 0056
for drive in "$@"; do
  folder=$root/$(basename "$root")_drive_${drive}_sync
  need_folder "$folder" "drive $drive of the KITTI raw data set"
  name=${drive#00}
  "$(tool kitti2rawlog)" --drive "$folder" --output "$out/$name.rawlog" --boxes "$out/${name}_boxes.csv" \
    --truth-objects "$out/${name}_objects.csv" --overwrite
  densify_withheld "$name" --detections "$out/${name}_boxes.csv"
  comparisons+=(--truth-objects "$out/${name}_objects.csv")
done
print_table --protocol kitti-raw-trajectories
