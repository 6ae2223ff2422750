#!/usr/bin/env bash
# Makes share/results.md: every scenario of the simulator, as drawn by several seeds; the real drives and scenes that are found;
# what each switch and each parameter of the motion estimator is worth.
#   share/results.sh [folder ...]    folders of, or with, *_sync drives of the KITTI raw set and scenes of DDAD
# Can be stopped and called again: every run leaves its table in out/results, or $OUT, and what lies there is not measured anew,
# but for ANEW=1, which keeps the simulated logs only. $SEEDS: those that are drawn, default "101 102 103", which nothing is to be
# tuned to; $ABLATION_SEEDS: for switches and parameters, default: the first of them. $JOBS: runs at a time, default: the
# cores'. $PAGE: what is made, default share/results.md. $PARTS: "ablation offline sensitivity" or fewer, which take longest.
. "$(dirname "$0")/runs.sh"
read -r -a seeds <<< "${SEEDS:-101 102 103}"
page=${PAGE:-$project/share/results.md}
unset SET BY
failed=0
find "$OUT" -maxdepth 1 -name 'working.*' -mmin +240 -exec rm -rf {} +  # of runs that were killed
build=$(build_of_tools)
if [ -n "${ANEW:-}" ]; then rm -rf "$OUT"/*.{txt,csv,md} "$OUT"/{ablation,sensitivity}; fi

# The runs, as arguments of share/measure.sh: scenarios by seed, and what lies in the folders given.
drawn() {
  local name seed
  for seed in "${seeds[@]}"; do
    for name in ${SCENARIOS:-$(scenarios)}; do echo "scenario $name $seed"; done
  done
}
real() {
  local folder keep
  [ $# -gt 0 ] || return 0
  for folder in "$@"; do need_folder "$folder" "drives of the KITTI raw data set, or scenes of DDAD"; done
  find -L "$@" -maxdepth 4 -type d -name '*_sync' | LC_ALL=C sort -u | while read -r folder; do
    for keep in 2 3; do
      # Of a clip of five scans there is nothing between if two of three are withheld.
      [ "$keep" = 2 ] || [ "$(find -L "$folder/velodyne_points" -name '0*.bin' | wc -l)" -gt 10 ] || continue
      echo "drive $(realpath "$folder") $keep"
    done
  done
  find -L "$@" -maxdepth 4 -name 'scene_*.json' | LC_ALL=C sort -u | while read -r folder; do
    echo "ddad $(realpath "$(dirname "$folder")")"
  done
}
real "$@" > "$OUT/real.list"

# figures_of < runs: lines of group,run,row,figure,value
figures_of() {
  local words name
  while read -r -a words; do
    name=$(run_name "${words[@]}")
    [ ! -s "$OUT/$name.csv" ] || awk -v run="$name" -v group="$(title_of "${words[@]}")" '{ print group "," run "," $0 }' "$OUT/$name.csv"
  done
}
title_of() {
  case $1 in
    scenario) echo "$2" ;;
    drive) echo "$(basename "$2"): one scan of $3 kept" | sed 's|^[0-9_]*_drive_\([0-9]*\)_sync:|KITTI drive \1:|' ;;
    *) basename "$2" ;;
  esac
}

# Lines of figures_of, one or more runs to a group, as a table; the worst first.
headline_table() {
  echo "| | runs | movers | ego, m | const-v, m | paper, m | **ours**, m | ours / best other | ours: 95 % of errors below, m | velocity RMS, m/s | parked told to move | by, m | false movers per image: paper | ours | switches per object | static scene, m |"
  echo "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|"
  awk -F, "$statistics"'
    function mean(row, figure,   key) {
      key = group SUBSEP row SUBSEP figure
      return n[key] > 0 ? sum[key] / n[key] : ""
    }
    function shown(value, digits) { return value == "" ? "-" : sprintf("%." digits "f", value) }
    function with_interval(row, figure, digits,   key, half) {
      key = group SUBSEP row SUBSEP figure
      half = interval(n[key], sum[key], squares[key])
      return shown(mean(row, figure), digits) (half < 0 ? "" : sprintf(" ± %." digits "f", half))
    }
    $3 == "ours" && $4 == "images" { runs[$1]++ }
    $4 == "movers" { movers[$2 SUBSEP $3] = $5 }
    # Where nothing moves there is no error of what moves.
    $4 ~ /^(movers_|velocity_)/ && movers[$2 SUBSEP $3] == 0 { next }
    { key = $1 SUBSEP $3 SUBSEP $4; n[key]++; sum[key] += $5; squares[key] += $5 * $5 }
    END {
      for (group in runs) {
        best = ""
        split("ego constant-velocity paper", others, " ")
        for (i = 1; i <= 3; i++) {
          value = mean(others[i], "movers_mean_m")
          if (value != "" && (best == "" || value < best)) best = value
        }
        ours = mean("ours", "movers_mean_m")
        ratio = ours != "" && best > 0 ? ours / best : ""
        parked = sum[group SUBSEP "ours" SUBSEP "parked"]
        followed = sum[group SUBSEP "ours" SUBSEP "objects_followed"]
        printf "%f\t| %s | %d | %d | %s | %s | %s | **%s** | %s | %s | %s | %s | %s | %s | %s | %s | %s |\n", (ratio == "" ? -1 : ratio), \
          group, runs[group], sum[group SUBSEP "ours" SUBSEP "movers"], shown(mean("ego", "movers_mean_m"), 3), \
          shown(mean("constant-velocity", "movers_mean_m"), 3), shown(mean("paper", "movers_mean_m"), 3), \
          with_interval("ours", "movers_mean_m", 3), shown(ratio, 2), with_interval("ours", "movers_p95_m", 3), \
          with_interval("ours", "velocity_rms_m_s", 2), \
          (parked > 0 ? sprintf("%.1f %% of %d", 100 * sum[group SUBSEP "ours" SUBSEP "parked_told_to_move"] / parked, parked) : "-"), \
          (parked > 0 ? shown(mean("ours", "parked_shift_m"), 3) : "-"), shown(mean("paper", "false_movers_per_image"), 2), \
          with_interval("ours", "false_movers_per_image", 2), \
          (followed > 0 ? sprintf("%.2f", sum[group SUBSEP "ours" SUBSEP "identity_switches"] / followed) : "-"), \
          with_interval("ours", "static_scene_m", 3)
      }
    }' | sort -t "$(printf '\t')" -k 1,1gr -k 2 | cut -f 2
}

# By the withheld scans: what is known of drives without labels, and the clouds' distance.
clouds_table() {
  echo "| | moving objects: hold, m | ego | const-v | paper | **ours** | static objects: ego, m | ours | Chamfer in view: hold, m | ego | paper | **ours** | oracle |"
  echo "|---|---|---|---|---|---|---|---|---|---|---|---|---|"
  awk -F, '
    function mean(row, figure, digits,   key) {
      key = group SUBSEP row SUBSEP figure
      return n[key] > 0 ? sprintf("%." digits "f", sum[key] / n[key]) : "-"
    }
    !($1 in seen) { seen[$1] = 1; groups[++number] = $1 }
    { key = $1 SUBSEP $3 SUBSEP $4; n[key]++; sum[key] += $5 }
    END {
      for (g = 1; g <= number; g++) {
        group = groups[g]
        moving = "moving_objects_mean_m"; standing = "static_objects_mean_m"; chamfer = "chamfer_in_view_m"
        printf "| %s | %s | %s | %s | %s | **%s** | %s | %s | %s | %s | %s | **%s** | %s |\n", group, \
          mean("hold", moving, 3), mean("ego", moving, 3), mean("constant-velocity", moving, 3), mean("paper", moving, 3), \
          mean("ours", moving, 3), mean("ego", standing, 3), mean("ours", standing, 3), mean("hold", chamfer, 4), \
          mean("ego", chamfer, 4), mean("paper", chamfer, 4), mean("ours", chamfer, 4), mean("oracle", chamfer, 4)
      }
    }'
}

# From what runs print: how far positions of what was seen to move are true to their covariances.
uncertainty_table() {
  local words
  echo "| | positions | error squared by covariance, per dimension | its median | within 95 % | sigma, m | error, m |"
  echo "|---|---|---|---|---|---|---|"
  while read -r -a words; do
    awk -v title="$(title_of "${words[@]}")" '
      /^reported uncertainty of positions/ { here = 1 }
      here && $1 == "moving" { printf "| %s | %s | %s | %s | %s | %s | %s |\n", title, $2, $3, $4, $5, $6, $7; exit }' \
      "$OUT/$(run_name "${words[@]}").txt"
  done
}

# Judging by scans takes eight times as long as by labels, and differs little from seed to seed: of the first one only.
in_parallel full_run < <(sed 's/^/scans /' "$OUT/real.list"
  drawn | awk -v first="${seeds[0]}" '{ print ($3 == first ? "scans" : "labels"), $0 }')
for part in ${PARTS-ablation offline sensitivity}; do
  SEEDS=${ABLATION_SEEDS:-${seeds[0]}} bash "$project/share/$part.sh" > "$OUT/$part.md" || failed=1
done

part_of_page() {
  if [ -s "$OUT/$1.md" ]; then cat "$OUT/$1.md"; else echo "Not measured with this build: \`share/$1.sh\`."; fi
}

whole_page() {
  local builds
  cat "$project/share/results-intro.md"
  builds=$(find "$OUT" -name '*.csv' -not -path "$OUT/logs/*" -exec awk -F, '
    $1 == "run" && $2 == "build" { print $3 } NF == 14 { print $12 }' {} + | sort -u | wc -l)
  [ "$builds" -le 1 ] || printf '\n**Measured in parts, with %d builds of the tools**: `ANEW=1 share/results.sh` makes all of one.\n' "$builds"
  printf '\n## Situations that were drawn: seeds %s, the worst first\n\n' "${seeds[*]}"
  drawn | figures_of | headline_table
  printf '\n### The same, by the scans of the truth: seed %s\n\n' "${seeds[0]}"
  drawn | awk -v seed="${seeds[0]}" '$3 == seed' | figures_of | clouds_table
  printf '\n### Reported uncertainty: seed %s\n\n' "${seeds[0]}"
  drawn | awk -v seed="${seeds[0]}" '$3 == seed' | LC_ALL=C sort | uncertainty_table
  if [ -s "$OUT/real.list" ]; then
    printf '\n## Real drives and scenes, by people'"'"'s labels\n\n'
    figures_of < "$OUT/real.list" | headline_table
    printf '\n### Real drives and scenes, by the withheld scans\n\n'
    figures_of < "$OUT/real.list" | clouds_table
  fi
  printf '\n## What each switch is worth\n\n'
  part_of_page ablation
  printf '\n## With the next scan (`mode = offline`)\n\n'
  part_of_page offline
  printf '\n## What the estimator'"'"'s parameters are worth\n\n'
  part_of_page sensitivity
}
whole_page > "$OUT/results.md"
mv "$OUT/results.md" "$page"
echo "$page: $((SECONDS / 60)) min, build $build" >&2
exit "$failed"
