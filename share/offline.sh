#!/usr/bin/env bash
# What the next real scan is worth: mean errors of moving / static objects in both modes, and Chamfer in view of scans that are
# drawn from the key scan or from both, as a table of share/results.md.
#   share/offline.sh [folder of 2011_09_26_drive_0052_sync]
set -euo pipefail
cd "$(dirname "$0")/.."
. share/figure.sh

mean() {  # <mode> <measure.sh's arguments ...>
  SET="resample=none carrier=3drangescan mode=$1" bash share/measure.sh "${@:2}" --no-paper > "$out/offline.txt"
  printf '%s %s\n' "$(figure "$out/offline.txt" "moving objects, position" ours 2)" \
    "$(figure "$out/offline.txt" "static objects, position" ours 2)"
}
chamfer() {  # <mode> <measure.sh's arguments ...>
  SET="resample=beam mode=$1" bash share/measure.sh "${@:2}" --no-paper > "$out/offline.txt"
  figure "$out/offline.txt" Chamfer ours 3
}
row() {  # <title> <measure.sh's arguments ...>
  echo "offline: $1 ..." >&2
  local causal offline
  causal="$(mean causal "${@:2}") $(chamfer causal "${@:2}")"
  offline="$(mean offline "${@:2}") $(chamfer offline "${@:2}")"
  awk -v title="$1" -v causal="$causal" -v offline="$offline" 'BEGIN {
    split(causal, c, " "); split(offline, o, " ")
    printf "| %s | %s | %s | %.2f | %s | %s | %s | %s | %.2f |\n", title, c[1], o[1], o[1] / c[1], c[2], o[2], c[3], o[3], o[3] / c[3] }'
}

echo "| | moving: causal | offline | ratio | static: causal | offline | Chamfer in view: causal | offline | ratio |"
echo "|---|---|---|---|---|---|---|---|---|"
if [ -n "$drive" ]; then
  for keep in 2 3 4; do row "drive 0052, K = $keep" drive "$drive" "$keep"; done
fi
for name in $(scenarios); do
  row "$name" scenario "$name"
done
