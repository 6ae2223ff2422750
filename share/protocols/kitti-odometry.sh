#!/usr/bin/env bash
# The paper's table on the KITTI odometry set: 16384 points, then the camera's view.
#   share/protocols/kitti-odometry.sh <folder with sequences/ and poses/> [sequence ...]     default: 02 to 10
. "$(dirname "$0")/common.sh"
sequences_table "$@"
