#!/usr/bin/env bash
# Makes share/results.md: every scenario of the simulator, and a drive of the KITTI raw set where its folder is given.
#   share/results.sh [folder of 2011_09_26_drive_0052_sync]       logs and reports go to out/results, or $OUT
set -euo pipefail
cd "$(dirname "$0")/.."
out=${OUT:-out/results}
drive=${1:-}
mkdir -p "$out"
runs=()

measure() {  # <name> <title> <command's arguments ...>
  local name=$1 title=$2; shift 2
  echo "$title ..." >&2
  bash share/measure.sh "$@" > "$out/$name.txt"
  runs+=("$name|$title|share/measure.sh ${*/#"$drive"/2011_09_26_drive_0052_sync}")
}

# figure <table> <heading's beginning> <row> <column after the row's name>
figure() {
  awk -v heading="$2" -v row="$3" -v column="$4" '
    index($0, heading) == 1 { inside = 1; next }
    /^$/ { inside = 0 }
    inside && $1 == row { print $(column + 1); exit }' "$1"
}

if [ -n "$drive" ]; then
  for keep in 2 3 4; do
    measure "drive-$keep" "KITTI drive 0052, one scan of $keep kept" drive "$drive" "$keep" --protocol kitti-odometry
  done
fi
for file in config/scenarios/*.ini; do
  name=$(basename "$file" .ini)
  case $name in demo | small) continue ;; esac
  measure "scenario-$name" "Scenario $name" scenario "$name"
done

# What each clue is worth: the mean errors with it switched off.
ablation_logs=("scenario queue" "scenario turning" "scenario braking" "scenario sparse_16")
[ -z "$drive" ] || ablation_logs=("drive $drive 2" "drive $drive 3" "${ablation_logs[@]}")
ablation_row() {  # <title> <settings>
  echo "$1 ..." >&2
  printf '| %s | `%s` |' "$1" "$2"
  for log in "${ablation_logs[@]}"; do
    SET=$2 bash share/measure.sh $log --no-paper > "$out/ablation.txt"
    printf ' %s / %s |' "$(figure "$out/ablation.txt" "moving objects, position" ours 2)" \
      "$(figure "$out/ablation.txt" "static objects, position" ours 2)"
  done
  echo
}
ablation() {
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
  ablation_row "the picture alone (the paper)" preset=paper
  ablation_row "with the next scan (offline)" mode=offline
}

ablation > "$out/ablation.md"

{
  cat share/results-intro.md
  echo "| | objects | hold | ego | const-v | paper | **ours** | ours / best other | static: ego | static: ours | Chamfer: hold | ego | ours | oracle |"
  echo "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|"
  for run in "${runs[@]}"; do
    IFS='|' read -r name title command <<< "$run"
    table=$out/$name.txt
    moving() { figure "$table" "moving objects, position" "$1" 2; }
    hold=$(moving hold) ego=$(moving ego) velocity=$(moving constant-velocity) paper=$(moving paper) ours=$(moving ours)
    ratio=$(printf '%s\n' "$hold" "$ego" "$velocity" "$paper" | sort -g | head -1 | awk -v ours="$ours" '{printf "%.2f", ours / $1}')
    echo "| $title | $(figure "$table" "moving objects, position" ours 1) | $hold | $ego | $velocity | $paper | **$ours** | $ratio |" \
      "$(figure "$table" "static objects, position" ego 2) | $(figure "$table" "static objects, position" ours 2) |" \
      "$(figure "$table" Chamfer hold 3) | $(figure "$table" Chamfer ego 3) | $(figure "$table" Chamfer ours 3) | $(figure "$table" Chamfer oracle 3) |"
  done
  printf '\n## Ablation: moving / static objects, mean position error, metres\n\n'
  cat "$out/ablation.md"
  for run in "${runs[@]}"; do
    IFS='|' read -r name title command <<< "$run"
    printf '\n## %s\n\n`%s`\n\n```\n' "$title" "$command"
    cat "$out/$name.txt"
    printf '```\n'
  done
} > share/results.md
