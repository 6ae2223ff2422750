#!/usr/bin/env bash
# What densification buys for maps and SLAM: makes share/mapping-study.md, or one of its tables.
#   share/mapping-study.sh [folder of 2011_09_26_drive_0052_sync]      all of it; without the folder, the simulated part
#   share/mapping-study.sh maps scenario <name> | drive <folder>       maps at the true poses
#   share/mapping-study.sh paths level <name> | scenario <name> | drive <folder>       paths of stock icp-slam
# `level` is the scenario seen by eight nearly level beams, which do not meet the road nearby. Logs go to out/mapping-study,
# or $OUT; with KEEP=1, tables that lie there are not measured anew.
. "$(dirname "$0")/protocols/common.sh"
out=${OUT:-$project/out/mapping-study}
page=$project/share/mapping-study.md
config=$project/config/default.ini
mkdir -p "$out"

# prepare <kind> <name or folder>: full.rawlog, what is true, and the logs thinned to every second and third scan.
prepare() {
  local kind=$1 name=$2 keep
  truth=()
  work=$out/$kind-$(basename "$name")
  mkdir -p "$work"
  case $kind in
    scenario | level)
      cp "$project/config/scenarios/$name.ini" "$work/scenario.ini"
      if [ "$kind" = level ]; then
        printf '\n[lidar]\nrings = 8\nfov_up_deg = 4\nfov_down_deg = -1\n' >> "$work/scenario.ini"
      fi
      "$(tool rawlog-simulate)" --scenario "$work/scenario.ini" --output "$work/full.rawlog" \
        --truth "$work/every-image.rawlog" --overwrite > /dev/null
      truth=(--truth-objects "$work/full_objects.csv")
      ;;
    drive)
      need_folder "$name" "a drive of the KITTI raw data set"
      config=$project/config/kitti.ini
      "$(tool kitti2rawlog)" --drive "$name" --output "$work/full.rawlog" --overwrite > /dev/null
      ;;
    *) sed -n '2,8p' "$0" >&2; exit 2 ;;
  esac
  for keep in 2 3; do
    "$(tool rawlog-decimate)" --input "$work/full.rawlog" --output "$work/every-$keep.rawlog" --label LIDAR \
      --keep-every "$keep" --overwrite > /dev/null
  done
}

# densify <K> <name> [settings ...]: every-<K>-<name>.rawlog
densify() {
  local keep=$1 name=$2 setting settings=(); shift 2
  for setting in "$@"; do settings+=(--set "$setting"); done
  "$(tool rawlog-densify)" --config "$config" --input "$work/every-$keep.rawlog" \
    --output "$work/every-$keep-$name.rawlog" --overwrite "${settings[@]}" > /dev/null
}

maps() {
  local keep inputs
  prepare "$@"
  inputs=("$work/full.rawlog")
  # What perfect virtual scans would have made.
  [ "$1" = drive ] || inputs+=("$work/every-image.rawlog")
  for keep in 2 3; do
    densify "$keep" moved resample=none
    densify "$keep" moved-drop resample=none objects=drop
    densify "$keep" beam resample=beam
    densify "$keep" beam-drop resample=beam objects=drop
    inputs+=("$work/every-$keep"{,-moved,-moved-drop,-beam,-beam-drop}.rawlog)
  done
  "$(tool rawlog-map-compare)" --reference "$work/full.rawlog" "${truth[@]}" --input "${inputs[@]}"
}

# icp_slam <log>: <log's stem>.simplemap. What cannot be matched is not in it.
icp_slam() {
  local stem=$work/$1
  rm -rf "$stem-slam" && mkdir "$stem-slam"
  ( cd "$stem-slam" && icp-slam "$project/config/icp-slam.ini" "$stem.rawlog" < /dev/null > log.txt 2>&1 )
  mv "$stem-slam/LOG_ICP-SLAM/_finalmap_.simplemap" "$stem.simplemap"
}

paths() {
  local keep log maps=()
  prepare "$@"
  # With poses in the log, virtual scans would hand them on to icp-slam: here the camera has to find the way.
  for keep in 2 3; do
    densify "$keep" moved resample=none ego_motion.source=camera
    densify "$keep" beam resample=beam ego_motion.source=camera
  done
  for log in full every-2 every-2-moved every-2-beam every-3 every-3-moved every-3-beam; do
    icp_slam "$log"
    maps+=("$work/$log.simplemap")
  done
  "$(tool rawlog-map-compare)" --reference "$work/full.rawlog" "${truth[@]}" --simplemap "${maps[@]}"
}

section() {  # <title> <command's arguments ...>
  local title=$1; shift
  echo "$title ..." >&2
  local table
  table=$out/$1-$2-$(basename "$3").md
  printf '\n### %s\n\n`share/mapping-study.sh %s`\n\n' "$title" "${*/#"$drive"/2011_09_26_drive_0052_sync}"
  [ -n "${KEEP:-}" ] && [ -s "$table" ] || bash "$0" "$@" > "$table"
  cat "$table"
}

whole_page() {
  cat "$project/share/mapping-study-intro.md"
  printf '\n## Maps at the true poses\n'
  section "Oncoming traffic, 15 m/s" maps scenario oncoming
  section "Turning at a crossing" maps scenario turning
  section "A queue in town" maps scenario queue
  [ -z "$drive" ] || section "KITTI drive 0052" maps drive "$drive"
  printf '\n## Paths of icp-slam\n'
  section "Oncoming traffic, level beams" paths level oncoming
  section "We turn, level beams" paths level rotating_ego
  section "A queue in town, level beams" paths level queue
  [ -z "$drive" ] || section "KITTI drive 0052" paths drive "$drive"
}

case ${1:-} in
  maps | paths) "$@" ;;
  *)
    drive=${1:-}
    command -v icp-slam > /dev/null || { echo "$0: icp-slam is missing (apt install mrpt-apps)" >&2; exit 1; }
    whole_page > "$out/page.md"
    mv "$out/page.md" "$page"
    ;;
esac
