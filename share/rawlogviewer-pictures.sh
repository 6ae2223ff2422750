#!/usr/bin/env bash
# Takes the screenshots of share/rawlogviewer.md anew, from the real programs, into share/pictures.
#   share/rawlogviewer-pictures.sh [build folder]     default: build/release, as share/demo.sh makes it
# Needs, besides what share/install-deps.sh --tests installs, the package imagemagick.
set -euo pipefail
cd "$(dirname "$0")/.."
build=${1:-build/release}
pictures=$PWD/share/pictures
work=$(mktemp -d)
screen() { bash share/screen-session.sh "$1" "$work/screen" "${@:2}"; }
trap 'screen end 2> /dev/null; rm -rf "$work"' EXIT

# The part of the screen as a picture: name, and width x height + left + top.
take() {
  screen shot "$work/screen.xwd"
  convert "xwd:$work/screen.xwd" -crop "$2" +repage -dither None -colors 64 -strip -define png:compression-level=9 "$pictures/$1.png"
}

log() {  # name, scenario, further settings
  "$build/bin/rawlog-simulate" --scenario "$2" --output "$work/sim.rawlog" --truth "$work/truth.rawlog" --overwrite
  "$build/bin/rawlog-densify" --config config/default.ini --input "$work/sim.rawlog" --output "$work/$1" \
    --report "$work/report.json" --overwrite "${@:3}"
}

cat config/scenarios/demo.ini - <<< $'[scenario]\nduration_s = 1.1' > "$work/street.ini"
log dense.rawlog "$work/street.ini" --set annotate=1

(cd "$work" && bash "$OLDPWD/share/screen-session.sh" start "$work/screen" RawLogViewer dense.rawlog)
screen row 25                          # the second virtual scan after the second real one
screen drag 1 700 349 0 -170           # more room for the 3D view
screen wheel 800 500 -10               # away
screen drag 1 500 500 470 0            # from behind the vehicle
screen drag 3 800 400 0 130            # and further ahead
take rawlogviewer_scan 1280x800+0+0
screen row 26                          # its objects
screen drag 1 800 500 -170 0
screen wheel 800 500 -6
screen drag 3 1000 300 -250 260
take rawlogviewer_objects 874x346+406+292
screen end

"$build/bin/rawlog-export" --input "$work/dense.rawlog" --output "$work/scene" --format 3Dscene \
  --report "$work/report.json" --index 3
mv "$work"/scene/*.3Dscene "$work/instant.3Dscene"
rm -rf "$work/screen"
screen start SceneViewer3D "$work/instant.3Dscene"
screen wheel 700 400 -20
screen drag 1 1100 400 -660 -50
screen drag 3 700 300 0 250
take sceneviewer 1280x800+0+0
screen end

log depth.rawlog config/scenarios/depth_camera.ini --set resample=none
rm -rf "$work/screen"
(cd "$work" && bash "$OLDPWD/share/screen-session.sh" start "$work/screen" RawLogViewer depth.rawlog)
screen row 12                          # the second virtual depth image
screen drag 1 700 349 0 -170
screen click 530 270                   # the tab Depth
take rawlogviewer_depth 874x390+406+250
screen end
ls -l "$pictures"
