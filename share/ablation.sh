#!/usr/bin/env bash
# What each clue is worth: the mean errors of moving / static objects with it switched off, as a table of share/results.md.
#   share/ablation.sh [folder of 2011_09_26_drive_0052_sync]
set -euo pipefail
cd "$(dirname "$0")/.."
. share/figure.sh

ablation_logs=("scenario queue" "scenario turning")
[ -z "$drive" ] || ablation_logs=("drive $drive 2" "drive $drive 3" "${ablation_logs[@]}")
ablation_row() {  # <title> <settings>
  echo "$1 ..." >&2
  printf '| %s | `%s` |' "$1" "$2"
  for log in "${ablation_logs[@]}"; do
    SET="resample=none $2" bash share/measure.sh $log --no-paper > "$out/ablation.txt"
    printf ' %s / %s |' "$(figure "$out/ablation.txt" "moving objects, position" ours 2)" \
      "$(figure "$out/ablation.txt" "static objects, position" ours 2)"
  done
  echo
}

printf '| | settings |'
for log in "${ablation_logs[@]}"; do printf ' %s |' "${log/#"drive $drive"/drive 0052, K =}"; done
printf '\n|---|---|'
for log in "${ablation_logs[@]}"; do printf -- '---|'; done
echo
ablation_row "all clues" ""
ablation_row "without the motion between real scans" object_motion.scan_prior=false
ablation_row "without what earlier images told" object_motion.image_prior=false
ablation_row "without the ground" object_motion.ground_prior=false
ablation_row "without the test for parked ones" object_motion.static_test=false
ablation_row "with points that are covered by now" object_motion.drop_covered=false
ablation_row "with patches on depth edges left there" points.off_edges=false
ablation_row "with what stands beside a mover" object_motion.part_standing=false
ablation_row "the picture alone (the paper)" preset=paper
ablation_row "with the next scan (offline)" mode=offline
ablation_row "the same, the log run over once" "mode=offline hindsight=false"
