#!/usr/bin/env bash
# Builds everything and shows it: makes a log of a simulated street, densifies it from 10 to 30 scans a second,
# measures the result against the exact truth, and draws pictures.
#   share/demo.sh [folder]     default: out/demo
set -euo pipefail
cd "$(dirname "$0")/.."
out=${1:-out/demo}

bash share/install-deps.sh
echo "Building (a few minutes the first time) ..."
mkdir -p "$out"
{ cmake --preset release && cmake --build --preset release; } > "$out/build.log" 2>&1 ||
  { tail -n 30 "$out/build.log" >&2; echo "demo: the build failed, see $out/build.log" >&2; exit 1; }
bin=build/release
rm -rf "$out/pictures"

echo "Simulating a street with a 10 Hz LiDAR and a 30 Hz camera ..."
"$bin/rawlog_tools/rawlog-simulate/rawlog-simulate" --scenario config/scenarios/demo.ini \
  --output "$out/sim.rawlog" --truth "$out/truth.rawlog" --overwrite
echo
echo "Densifying ..."
"$bin/apps/rawlog-densify/rawlog-densify" --config config/default.ini \
  --input "$out/sim.rawlog" --output "$out/dense.rawlog" \
  --report "$out/report.json" --pictures "$out/pictures" --overwrite
echo
echo "Against the truth:"
"$bin/apps/rawlog-evaluate/rawlog-evaluate" --reference "$out/truth.rawlog" --input "$out/dense.rawlog" \
  --truth-objects "$out/sim_objects.csv" --max-range 40
cat <<END

The virtual points on the camera image, coloured by depth: $out/pictures/*_CAM0.png
The same from above, with the last real scan and trails:    $out/pictures/*_from_above.png
The densified log in MRPT's viewer:                         RawLogViewer $out/dense.rawlog
END
