#!/usr/bin/env bash
# One measurement of share/results.md, from log to table.
#   share/measure.sh scenario <name> [seed]         a file of config/scenarios, without its ending; a seed draws another situation
#                                                   of the kind, none takes it as written
#   share/measure.sh drive <folder> <K> [cameras]   a drive of the KITTI raw set of which every K-th scan is kept; cameras as for
#                                                   kitti2rawlog, default: 2, or 3 where there is no 2
#   share/measure.sh ddad <folder>                  a scene of DDAD of which every second scan is kept
# Further arguments go to rawlog-evaluate. Settings of rawlog-densify may be given as $SET, for instance
# SET="preset=paper mode=causal". With BY=motions no Chamfer distance is measured, which takes half the time; with BY=labels
# the simulator's truth or people's labels alone judge, no scans, which takes an eighth.
# In $OUT (default: out/results) it leaves <run>.txt, what it prints, and <run>.csv, the headline as row,figure,value ($CSV:
# there), and without TIDY=1 what was densified and the reports. Logs are simulated or imported once, to $OUT/logs.
. "$(dirname "$0")/runs.sh"
usage() { sed -n '3,7s/^# *//p' "$0" >&2; exit 2; }
settings=() truth=() range=()
for setting in ${SET:-}; do settings+=(--set "$setting"); done
kind=${1:-} began=$SECONDS
by=${BY:-scans}
[[ $by =~ ^(scans|motions|labels)$ ]] || { echo "measure: BY=$by is none of scans, motions, labels" >&2; exit 2; }

# What a simulated log depends on. A binary older than its sources counts as itself: the log is made again when it is built.
simulator_version() {
  local binary sources=$project/rawlog_tools/rawlog-simulate
  binary=$(tool rawlog-simulate)
  find "$sources" \( -name '*.cpp' -o -name '*.h' \) -print0 | LC_ALL=C sort -z | xargs -0 cat | cksum
  [ -z "$(find "$sources" -name '*.cpp' -newer "$binary")" ] || cksum < "$binary"
}

# made_once <name> <what it depends on> <command ...>: the folder $logs, filled by the command with $new for its name, unless
# that was done. One process at a time; a folder that is there is whole.
made_once() {
  local from=$2 new
  logs=$OUT/logs/$1 new=$OUT/logs/$1.new; shift 2
  mkdir -p "$OUT/logs"
  exec 9> "$logs.lock"
  flock 9
  if [ "$from" != "$(cat "$logs/made-from" 2> /dev/null)" ]; then
    rm -rf "$new" && mkdir "$new"
    "$@" "$new"
    echo "$from" > "$new/made-from"
    rm -rf "$logs" && mv "$new" "$logs"
  fi
  exec 9>&-
}

simulate() {
  "$(tool rawlog-simulate)" --scenario "$project/config/scenarios/$name.ini" "${seed[@]}" --output "$1/thin.rawlog" \
    --truth "$1/full.rawlog" > /dev/null
}
thin() {  # <folder> <K>
  "$(tool rawlog-decimate)" --input "$1/full.rawlog" --output "$1/thin.rawlog" --label LIDAR --keep-every "$2" > /dev/null
}
import_drive() {
  local labels=()
  if [ -d "$folder/oxts" ] && { [ -e "$folder/label_02.txt" ] || [ -e "$folder/tracklet_labels.xml" ]; }; then
    labels=(--truth-objects "$1/thin_objects.csv")
  fi
  "$(tool kitti2rawlog)" --drive "$folder" --cameras "$cameras" --output "$1/full.rawlog" "${labels[@]}" > /dev/null
  thin "$1" "$keep"
}
import_scene() {
  "$(tool dgp2rawlog)" --scene "$folder" --output "$1/full.rawlog" --truth-objects "$1/thin_objects.csv" > /dev/null
  thin "$1" 2
}

case $kind in
  scenario)
    name=${2:-} seed=()
    [ -e "$project/config/scenarios/$name.ini" ] || { echo "measure: there is no scenario '$name'" >&2; usage; }
    if [[ ${3:-} =~ ^[0-9]+$ ]]; then seed=(--seed "$3"); fi
    run=$(run_name scenario "$name" "${seed[@]:1}")
    made_once "$name${seed[1]:+-${seed[1]}}" "$(cksum < "$project/config/scenarios/$name.ini") $(simulator_version)" simulate
    shift $((2 + ${#seed[@]} / 2))
    range=(--max-range 40)
    ;;
  drive)
    folder=${2:-} keep=${3:-} cameras=2
    [[ $keep =~ ^[0-9]+$ ]] || usage
    need_folder "$folder" "a drive of the KITTI raw data set"
    [ -d "$folder/image_02" ] || cameras=3
    if [[ ${4:-} =~ ^[0-3](,[0-3])*$ ]]; then
      cameras=$4 run=$(run_name drive "$folder" "$keep" "$4"); shift 4
    else
      run=$(run_name drive "$folder" "$keep"); shift 3
    fi
    config=$project/config/kitti.ini
    made_once "$(basename "$folder")-keep-$keep-camera-$cameras" "$(realpath "$folder") $(cksum < "$(tool kitti2rawlog)")" import_drive
    ;;
  ddad)
    folder=${2:-}
    need_folder "$folder" "a scene of DDAD"
    run=$(run_name ddad "$folder"); shift 2
    made_once "$(basename "$folder")" "$(realpath "$folder") $(cksum < "$(tool dgp2rawlog)")" import_scene
    ;;
  *) usage ;;
esac
if [ -e "$logs/thin_objects.csv" ]; then truth=(--truth-objects "$logs/thin_objects.csv"); fi
[ "$by" = labels ] || truth+=(--reference "$logs/full.rawlog")

work=$(mktemp -d "$OUT/working.XXXXXX")
trap 'rm -rf "$work"' EXIT

measured() {  # <ending> <rawlog-evaluate's arguments ...> -- <rawlog-densify's arguments ...>
  local stem=$work/$1 more=(); shift
  while [ "$1" != -- ]; do more+=("$1"); shift; done
  "$(tool rawlog-densify)" --config "$config" --input "$logs/thin.rawlog" --output "$stem.rawlog" --report "$stem-report.json" \
    "${settings[@]}" "${@:2}" > "$stem-densify.txt"
  "$(tool rawlog-evaluate)" --input "$stem.rawlog" --config "$config" "${truth[@]}" "${range[@]}" --report "$stem-report.json" \
    --csv "$stem.csv" "${more[@]}" > "$stem.txt"
}

# Points on the sensor's beams are other points than the key scan's. So the objects' motions are measured on the same scans
# with every point its own (a depth camera's, too), which tells them exactly, and Chamfer on what users get.
every_point=(--set resample=none --set carrier=3drangescan)
if [[ " ${SET:-} " == *" resample="* ]]; then  # one of them is asked for
  measured dense "$@" --
  mv "$work/dense.txt" "$work/run.txt"
  mv "$work/dense.csv" "$work/run.csv"
elif [ "$by" = labels ]; then
  measured moved "$@" -- "${every_point[@]}"
  mv "$work/moved.txt" "$work/run.txt"
  mv "$work/moved.csv" "$work/run.csv"
else
  measured moved --no-chamfer "$@" -- "${every_point[@]}"
  touch "$work"/on-beams.{txt,csv}
  [ "$by" = motions ] || measured on-beams "$@" --
  awk -v RS= -v clouds='^(Chamfer|protocol|running time)' -v beaten='beats ours: Chamfer' '
    { on_beams = FILENAME ~ /on-beams.txt$/
      text = losses = ""
      lines = split($0, line, "\n")
      for (i = 1; i <= lines; i++)
        if (line[i] ~ /baseline beats ours/) { if ((line[i] ~ beaten) == on_beams) losses = losses line[i] "\n" }
        else if (($0 ~ clouds) == on_beams) text = text line[i] "\n"
      if (text != "") print text
      lost = lost losses }
    END { printf "%s", lost }' "$work"/{moved,on-beams}.txt > "$work/run.txt"
  awk '(FILENAME ~ /on-beams.csv$/) == /,chamfer_/' "$work"/{moved,on-beams}.csv > "$work/run.csv"
fi
times > "$work/times"
printf 'run,build,%s\nrun,seconds,%d\nrun,cpu_seconds,%.0f\n' "$(build_of_tools)" $((SECONDS - began)) \
  "$(awk 'NR == 2 { gsub(/[ms]/, " "); print 60 * ($1 + $3) + $2 + $4 }' "$work/times")" >> "$work/run.csv"
cat "$work/run.txt"
if [ -z "${TIDY:-}" ]; then
  for file in "$work"/{dense,moved,on-beams}*; do
    [ ! -e "$file" ] || mv "$file" "$OUT/$run-${file##*/}"
  done
fi
mv "$work/run.csv" "${CSV:-$OUT/$run.csv}"
[ -n "${CSV:-}" ] || mv "$work/run.txt" "$OUT/$run.txt"
