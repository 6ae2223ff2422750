#!/usr/bin/env bash
# The paper's tables of running times, on a drive of the KITTI raw set.
#   share/protocols/running-time.sh <folder of a drive, as .../2011_09_26_drive_0052_sync>
. "$(dirname "$0")/common.sh"
drive=${1:?usage: $0 <folder of a KITTI raw drive>}
need_folder "$drive" "a drive of the KITTI raw data set"
config=$project/config/kitti.ini
"$(tool kitti2rawlog)" --drive "$drive" --output "$out/drive.rawlog" --overwrite
densify_withheld drive
print_table --no-paper --report "$out/drive-report.json"
