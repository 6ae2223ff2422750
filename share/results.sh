#!/usr/bin/env bash
# Makes share/results.md: every scenario of the simulator, and a drive of the KITTI raw set where its folder is given.
#   share/results.sh [folder of 2011_09_26_drive_0052_sync]       logs and reports go to out/results, or $OUT;
#                                                          with KEEP=1, tables that lie there are not measured anew
set -euo pipefail
cd "$(dirname "$0")/.."
. share/figure.sh
runs=()

measure() {  # <name> <title> <command's arguments ...>
  local name=$1 title=$2; shift 2
  echo "$title ..." >&2
  [ -n "${KEEP:-}" ] && [ -s "$out/$name.txt" ] || bash share/measure.sh "$@" > "$out/$name.txt"
  runs+=("$name|$title|share/measure.sh ${*/#"$drive"/2011_09_26_drive_0052_sync}")
}

if [ -n "$drive" ]; then
  for keep in 2 3 4; do
    measure "drive-$keep" "KITTI drive 0052, one scan of $keep kept" drive "$drive" "$keep" --protocol kitti-odometry
  done
fi
for name in $(scenarios); do
  measure "scenario-$name" "Scenario $name" scenario "$name"
done

for table in ablation offline; do
  [ -n "${KEEP:-}" ] && [ -s "$out/$table.md" ] || bash "share/$table.sh" "$drive" > "$out/$table.md"
done

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
  printf '\n## With the next scan (`mode=offline`): mean position error of moving and static objects, and Chamfer in view, metres\n\n'
  cat "$out/offline.md"
  for run in "${runs[@]}"; do
    IFS='|' read -r name title command <<< "$run"
    printf '\n## %s\n\n`%s`\n\n```\n' "$title" "$command"
    cat "$out/$name.txt"
    printf '```\n'
  done
} > share/results.md
