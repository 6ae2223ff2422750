#!/usr/bin/env bash
# Builds everything and shows it: makes a log of a simulated street, densifies it from 10 to 30 scans a second,
# measures the result against the exact truth, and makes a film, pictures and a page. What is there already is not made again.
#   share/demo.sh [folder]     default: out/demo
set -euo pipefail
cd "$(dirname "$0")/.."
out=${1:-out/demo}
bin=build/release/bin
mkdir -p "$out"

if [ ! -x "$bin/rawlog-evaluate" ]; then
  cat <<END
The first time this installs packages (some 0.5 GB to load, 3 GB of disk) and builds, which takes about ten minutes on two cores;
then it runs for a minute or two. What is made already is not made again. The build's log: $out/build.log
END
fi
bash share/install-deps.sh
build() { cmake --preset release && cmake --build --preset release; }
echo "Building ..."
if [ -t 1 ]; then
  build 2>&1 | tee "$out/build.log" | while IFS= read -r line; do
    if [[ $line == \[* ]]; then printf '\r\033[K%.*s' "$((${COLUMNS:-80} - 1))" "$line"; fi
  done || { tail -n 30 "$out/build.log" >&2; echo "demo: the build failed, see $out/build.log" >&2; exit 1; }
  printf '\r\033[K'
else
  build > "$out/build.log" 2>&1 ||
    { tail -n 30 "$out/build.log" >&2; echo "demo: the build failed, see $out/build.log" >&2; exit 1; }
fi

# Whether a file is newer than all that it is made from.
is_made() {
  local from
  for from in "${@:2}"; do [ "$1" -nt "$from" ] || return 1; done
}

if ! is_made "$out/truth.rawlog" "$bin/rawlog-simulate" config/scenarios/demo.ini || [ ! -e "$out/sim.rawlog" ]; then
  echo "Simulating a street with a 10 Hz LiDAR and a 30 Hz camera ..."
  "$bin/rawlog-simulate" --scenario config/scenarios/demo.ini --output "$out/sim.rawlog" --truth "$out/truth.rawlog" --overwrite \
    > "$out/simulation.txt"
fi
dense=("$bin/rawlog-densify" config/default.ini "$out/sim.rawlog")
if ! { is_made "$out/dense.rawlog" "${dense[@]}" && is_made "$out/report.json" "${dense[@]}" && is_made "$out/film.mp4" "${dense[@]}"; }; then
  echo "Densifying it, and drawing ..."
  rm -rf "$out/pictures"
  "$bin/rawlog-densify" --config config/default.ini --input "$out/sim.rawlog" --output "$out/dense.rawlog" --overwrite \
    --report "$out/report.json" --pictures "$out/pictures" --film "$out/film.mp4" > "$out/densification.txt"
fi
judged=("$bin/rawlog-evaluate" "$out/dense.rawlog" "$out/report.json" "$out/truth.rawlog")
if ! { is_made "$out/page.html" "${judged[@]}" && is_made "$out/figures.csv" "${judged[@]}"; }; then
  echo "Judging it by the truth ..."
  "$bin/rawlog-evaluate" --reference "$out/truth.rawlog" --input "$out/dense.rawlog" --truth-objects "$out/sim_objects.csv" \
    --report "$out/report.json" --max-range 40 --csv "$out/figures.csv" --html "$out/page.html" > "$out/tables.txt"
fi

echo
awk -F, -v out="$out" '
  { value[$1, $2] = $3 }
  function figure(row, name, digits) { return sprintf("%." digits "f", value[row, name]) }
  function both(row) { return figure(row, "movers_mean_m", 3) " (" figure(row, "movers_median_m", 3) ")" }
  function line(title, a, b, c, d) { printf "| %s | %s | %s | %s | **%s** |\n", title, a, b, c, d }
  END {
    print "| demo street, objects within 40 m | ego-motion alone | constant velocity | published method | ours |\n|---|---|---|---|---|"
    line("all moving objects in view: mean (median) error, m", both("ego"), both("constant-velocity"), both("paper"), both("ours"))
    n = "false_movers_per_image"
    line("told to move that do not, per image", figure("ego", n, 2), figure("constant-velocity", n, 2), figure("paper", n, 2), figure("ours", n, 2))
    n = "chamfer_in_view_m"
    line("distance of the point clouds in view (Chamfer), m; ours are cast again on the sensor'"'"'s beams", figure("ego", n, 3), figure("constant-velocity", n, 3), figure("paper", n, 3), figure("ours", n, 3))
    ours = value["ours", "movers_mean_m"]
    printf "\nMade: %s/dense.rawlog, a log with a virtual scan beside every image between two real scans.\n", out
    printf "Its moving objects are %.1f cm off, %.1f times nearer than with constant velocity, %.1f times nearer than by the published method.\n",
      100 * ours, value["constant-velocity", "movers_mean_m"] / ours, value["paper", "movers_mean_m"] / ours
    printf "Open %s/film.mp4, %s/page.html (all tables and plots), or: RawLogViewer %s/dense.rawlog\n", out, out, out
  }' "$out/figures.csv"
