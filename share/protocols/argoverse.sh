#!/usr/bin/env bash
# The paper's table on Argoverse 1: 16384 points, then the front camera's view, boxes given by the annotations.
#   share/protocols/argoverse.sh <folder of tracking logs, as argoverse-tracking/val> [log ...]     default: all
. "$(dirname "$0")/common.sh"
tracking_logs_table "$@"
