#!/usr/bin/env bash
# The paper's table on the KITTI odometry set: 16384 points, then the camera's view.
#   share/protocols/kitti-odometry.sh <folder with sequences/ and poses/> [sequence ...]     default: 02 to 10
. "$(dirname "$0")/common.sh"
root=${1:?usage: $0 <folder with sequences/ and poses/> [sequence ...]}; shift
need_folder "$root/sequences" "the KITTI odometry data set"
config=$project/config/kitti.ini
[ $# -gt 0 ] || set -- 02 03 04 05 06 07 08 09 10
for sequence in "$@"; do
  "$(tool kitti2rawlog)" --sequence "$root/sequences/$sequence" --output "$out/$sequence.rawlog" --overwrite
  densify_withheld "$sequence"
done
print_table --protocol kitti-odometry
