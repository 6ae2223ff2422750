#!/usr/bin/env bash
# The paper's table on vehicles of Argoverse 1: their points only, within 32 m by 8 m of the road, 2048 of them.
#   share/protocols/argoverse-vehicles.sh <folder of tracking logs, as argoverse-tracking/val> [log ...]     default: all
. "$(dirname "$0")/common.sh"
tracking_logs_table "$@"
