#!/usr/bin/env bash
# How rawlog-densify's time grows with the points of a scan, the vehicles in sight, pictures a second, cameras and the length of the
# log, one at a time on a simulated street: seconds of the cores per virtual scan (and megabytes at most), as a table and drawn.
#   share/scaling.sh       writes $OUT/scaling.csv and $OUT/scaling.svg (default: out/scaling); needs GNU time
# Each run leaves its line there and is not run anew. The machine should have nothing else to do.
. "$(dirname "$0")/protocols/common.sh"
out=${OUT:-$project/out/scaling}
mkdir -p "$out"

# scenario <columns of 64 rings> <vehicles> <pictures a second> <cameras> <seconds>
scenario() {
  local i
  printf '[scenario]\nname = scaling\nduration_s = %s\nseed = 1\n[ego]\ny_m = -5.1\nspeed_mps = 6\n' "$5"
  printf '[static]\nlanes_per_direction = 3\n[lidar]\ncolumns = %s\n' "$1"
  for ((i = 0; i < $4; ++i)); do
    printf '[camera.CAM%d]\nrate_hz = %s\nwidth = 620\nheight = 186\nfx = 360\nposition_m = 0.3 0 1.65\norientation_deg = %d 0 0\n' \
      "$i" "$3" $((i * 360 / $4))
  done
  for ((i = 0; i < $2; ++i)); do  # in the lanes beside and before us, half a second of way between them
    printf '[vehicle.v%d]\nx_m = %d\ny_m = %s\nspeed_mps = %d\n' "$i" $((10 + 9 * (i / 3))) \
      "$(awk -v lane=$((i % 3)) 'BEGIN { print -1.7 - 3.4 * lane }')" $((6 + i % 3))
  done
}

# measured <of what> <its value> <scenario's numbers>: a line of the table.
measured() {
  local name=$1-$2 wall user sys kilobytes
  local log=$out/$name.rawlog
  [ ! -s "$out/$name.line" ] || { cat "$out/$name.line"; return; }
  scenario "${@:3}" > "$out/$name.ini"
  "$(tool rawlog-simulate)" --scenario "$out/$name.ini" --output "$log" --overwrite > /dev/null
  /usr/bin/time -o "$out/$name.time" -f '%e %U %S %M' "$(tool rawlog-densify)" --input "$log" --output "$out/$name-dense.rawlog" \
    --report "$out/$name.json" --overwrite > /dev/null
  read -r wall user sys kilobytes < "$out/$name.time"
  awk -v what="$1" -v value="$2" -v wall="$wall" -v cores="$user" -v sys="$sys" -v kilobytes="$kilobytes" '
    match($0, /"virtual_scans": *[0-9]+/) { split(substr($0, RSTART, RLENGTH), part, ":"); scans = part[2] + 0 }
    END { printf "%s,%s,%d,%.2f,%.1f,%.1f,%.0f\n", what, value, scans, wall, 1000 * wall / scans, 1000 * (cores + sys) / scans,
      kilobytes / 1024 }' "$out/$name.json" > "$out/$name.line"
  rm -f "$out/$name"{.rawlog,-dense.rawlog,_ego.csv,_objects.csv,_boxes.csv}
  cat "$out/$name.line"
}

runs() {
  local n
  for n in 450 900 1350 1800; do measured points $((64 * n)) "$n" 9 20 1 2; done
  for n in 3 9 18 27 36; do measured vehicles "$n" 1200 "$n" 20 1 2; done
  for n in 15 20 30 60; do measured images_per_s "$n" 1200 9 "$n" 1 2; done
  for n in 1 2 3 4 5 6 7; do measured cameras "$n" 1200 9 20 "$n" 2; done
  for n in 2 4 8 16; do measured seconds "$n" 1200 9 20 1 "$n"; done
}

{ echo "of,value,virtual_scans,wall_s,wall_ms_per_virtual_scan,cores_ms_per_virtual_scan,most_MB"; runs; } | tee "$out/scaling.csv"
gnuplot <<PLOT
set terminal svg size 1000,560 font "sans,12" background "white"
set output "$out/scaling.svg"
set datafile separator ","
set multiplot layout 2,3 title "Milliseconds of the cores per virtual scan"
set yrange [0:*]; set xrange [0:*]; unset key; set grid
do for [what in "points vehicles images_per_s cameras seconds"] {
  set xlabel (what eq "images_per_s" ? "pictures a second" : what eq "points" ? "thousand beams of a scan" : what eq "seconds" ? "seconds of log" : what)
  plot "< grep ^" . what . ", $out/scaling.csv" using (\$2 / (what eq "points" ? 1000 : 1)):6 with linespoints linewidth 2 pointtype 7 linecolor rgb "#2060a0"
}
set xlabel "seconds of log"; set title "megabytes at most"
plot "< grep ^seconds, $out/scaling.csv" using 2:7 with linespoints linewidth 2 pointtype 7 linecolor rgb "#a04020"
unset multiplot
PLOT
