#!/usr/bin/env bash
# One measurement of share/results.md, from log to table.
#   share/measure.sh scenario <name>                a file of config/scenarios, without its ending
#   share/measure.sh drive <folder> <K>             a drive of the KITTI raw set of which every K-th scan is kept
# Further arguments go to rawlog-evaluate. Logs and reports go to out/results, or $OUT; settings of rawlog-densify
# may be given as $SET, for instance SET="preset=paper mode=causal".
. "$(dirname "$0")/protocols/common.sh"
out=${OUT:-$project/out/results}
settings=()
for setting in ${SET:-}; do settings+=(--set "$setting"); done
kind=${1:?usage: $0 scenario <name> | drive <folder> <K>}; shift
mkdir -p "$out"

case $kind in
  scenario)
    name=${1:?which scenario?}; shift
    full=$out/$name-truth.rawlog thin=$out/$name.rawlog
    [ -e "$full" ] && [ "$full" -nt "$project/config/scenarios/$name.ini" ] || "$(tool rawlog-simulate)" --scenario "$project/config/scenarios/$name.ini" \
      --output "$thin" --truth "$full" --overwrite > /dev/null
    judge=(--truth-objects "$out/${name}_objects.csv" --max-range 40)
    ;;
  drive)
    folder=${1:?which folder?} keep=${2:?keep every which scan?}; shift 2
    need_folder "$folder" "a drive of the KITTI raw data set"
    config=$project/config/kitti.ini
    name=drive-keep-$keep full=$out/drive.rawlog thin=$out/$name.rawlog judge=()
    "$(tool kitti2rawlog)" --drive "$folder" --output "$full" --overwrite > /dev/null
    "$(tool rawlog-decimate)" --input "$full" --output "$thin" --label LIDAR --keep-every "$keep" --overwrite > /dev/null
    ;;
  *) echo "usage: $0 scenario <name> | drive <folder> <K>" >&2; exit 2 ;;
esac

# Points on the sensor's beams are other points than the key scan's. So the objects' motions are measured on the same scans
# with every point its own (a depth camera's, too), which tells them exactly, and Chamfer on what users get.
measured() {  # <ending> <rawlog-evaluate's arguments ...> -- <rawlog-densify's arguments ...>
  local dense=$out/$name-$1.rawlog more=(); shift
  while [ "$1" != -- ]; do more+=("$1"); shift; done
  "$(tool rawlog-densify)" --config "$config" --input "$thin" --output "$dense" --report "$out/$name-report.json" --overwrite \
    "${settings[@]}" "${@:2}" > "$out/$name-densify.txt"
  "$(tool rawlog-evaluate)" --reference "$full" --input "$dense" --config "$config" "${judge[@]}" \
    --report "$out/$name-report.json" --json "$out/$name.json" "${more[@]}"
}
if [[ " ${SET:-} " == *" resample="* ]]; then  # one of them is asked for
  measured dense "$@" --
  exit
fi
measured dense "$@" -- > "$out/$name-on-beams.txt"
measured moved -- --set resample=none --set carrier=3drangescan > "$out/$name-moved.txt"
awk -v RS= 'FNR == 1 { file++ }
  { lines = split($0, line, "\n") }
  file == 1 {
    for (i = 1; i <= lines; i++) if (line[i] ~ /beats ours: Chamfer/) beaten = beaten line[i] "\n"
    if (/^running time/) time = $0
    else if (!/^([A-Z_]+:|moving|static|points of|scene flow|objects left|a baseline|reported|told to move)/) clouds = clouds $0 "\n\n"
    next
  }
  /^Chamfer/ { printf "%s", clouds; next }
  /^running time/ { print time "\n"; next }
  { for (i = 1; i <= lines; i++) if (line[i] !~ /beats ours: Chamfer/) print line[i] }
  /(^|\n)a baseline beats ours/ { printf "%s", beaten; beaten = "" }
  { print "" }
  END { printf "%s", beaten }' "$out/$name-on-beams.txt" "$out/$name-moved.txt"
