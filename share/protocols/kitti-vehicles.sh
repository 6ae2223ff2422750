#!/usr/bin/env bash
# The paper's table on vehicles of the KITTI odometry set: their points only, within 32 m by 8 m of the road.
#   share/protocols/kitti-vehicles.sh <folder with sequences/ and poses/> [sequence ...]     default: 02 to 10
. "$(dirname "$0")/common.sh"
sequences_table "$@"
