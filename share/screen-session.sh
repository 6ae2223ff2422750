#!/usr/bin/env bash
# Runs a program with windows on a screen of its own, works it by mouse, and takes pictures of the screen.
#   screen-session.sh start  <folder> <program> [argument ...]   the folder is new; it keeps the session's state
#   screen-session.sh row    <folder> <n>                        RawLogViewer: chooses the log's n-th entry, counted from 0
#   screen-session.sh click  <folder> <x> <y>                    in pixels of the screen, which the window fills
#   screen-session.sh drag   <folder> <button> <x> <y> <dx> <dy>
#   screen-session.sh wheel  <folder> <x> <y> <clicks>           negative: towards the user
#   screen-session.sh shot   <folder> <file.xwd>
#   screen-session.sh end    <folder>
# A step returns when the picture stands still; one that shows no effect within a minute fails.
# Needs the packages xvfb, x11-apps and xdotool. What is not ended ends by itself after ten minutes.
set -euo pipefail

width=1280 height=800 row_height=17 chosen=c8c800

fail() { echo "screen-session: $*" >&2; exit 1; }

# Again if a window closes while it is looked at, as a program's welcome does.
shot() {
  for _ in $(seq 40); do
    xwd -root -silent -out "$1" 2> "$folder/xwd.log" && return
    sleep 0.1
  done
  fail "no picture of the screen: $(cat "$folder/xwd.log")"
}

use_display() { DISPLAY=:$(cat "$folder/display"); export DISPLAY; }

# Until the picture stands still and, if one is given, is not that one.
settle() {
  local before=${1:-} still=0
  for _ in $(seq 240); do
    shot "$folder/now.xwd"
    if cmp -s "$folder/now.xwd" "$folder/last.xwd"; then still=$((still + 1)); else still=0; fi
    mv "$folder/now.xwd" "$folder/last.xwd"
    if [ $still -ge 3 ] && { [ -z "$before" ] || ! cmp -s "$folder/last.xwd" "$before"; }; then return; fi
    sleep 0.25
  done
  fail "the picture did not change within a minute, or never stood still"
}

# Settings of its own: the user's are not touched, no tip of the day stands in front, and nothing blinks.
make_home() {
  mkdir -p "$folder/home/.RawLogViewer" "$folder/home/.config/gtk-3.0"
  printf '[tips]\nshow = false\n' > "$folder/home/.RawLogViewer/config.cfg"
  printf '[Settings]\ngtk-cursor-blink = 0\ngtk-enable-animations = 0\n' > "$folder/home/.config/gtk-3.0/settings.ini"
}

# As a process group, so that end takes its children along.
in_background() {
  local log=$1
  shift
  setsid timeout 600 "$@" > "$log" 2>&1 < /dev/null &
  echo $! >> "$folder/pids"
}

start() {
  mkdir -p "$folder"
  make_home
  in_background "$folder/xvfb.log" sh -c \
    "exec Xvfb -displayfd 3 -screen 0 ${width}x${height}x24 -nolisten tcp -noreset 3> '$folder/display'"
  for _ in $(seq 300); do [ -s "$folder/display" ] && break; sleep 0.1; done
  [ -s "$folder/display" ] || fail "Xvfb did not start: $(cat "$folder/xvfb.log")"
  use_display
  shot "$folder/empty.xwd"
  in_background "$folder/program.log" env HOME="$folder/home" XDG_CONFIG_HOME="$folder/home/.config" \
    LIBGL_ALWAYS_SOFTWARE=1 NO_AT_BRIDGE=1 "$@"
  fill_screen "$(basename "$1")"
}

# The program's largest window; without a window manager it has to be told more than once. One that closes between
# two commands is left out.
fill_screen() {
  local area=0 best window WIDTH HEIGHT
  for _ in $(seq 300); do
    area=0
    for window in $(xdotool search --onlyvisible --class "$1" 2>/dev/null || true); do
      WIDTH=0 HEIGHT=0
      eval "$(xdotool getwindowgeometry --shell "$window" 2>/dev/null | grep -E '^(WIDTH|HEIGHT)=')"
      [ $((WIDTH * HEIGHT)) -gt $area ] && area=$((WIDTH * HEIGHT)) best=$window
    done
    [ $area -ge $((width * height)) ] && break
    [ $area -gt 40000 ] && xdotool windowmove "$best" 0 0 windowsize "$best" $width $height 2> "$folder/xdotool.log" || true
    sleep 0.2
  done
  [ $area -ge $((width * height)) ] || fail "no window of $1 within a minute: $(cat "$folder/program.log")"
  settle "$folder/empty.xwd"
}

# Lines of the last picture, in hexadecimal digits: blue, green, red, and in some servers a fourth byte.
lines() {
  tail -c $((4 * width * height)) "$folder/last.xwd" | tail -c +$((4 * width * $1 + 1)) | od -An -v -t x1 -w$((4 * width)) | tr -d ' '
}

# The list of entries begins where the left edge is white first. While a log is being loaded nothing can be chosen.
row() {
  local top y
  for _ in $(seq 60); do
    top=$(lines 0 | awk '/^ffffffffffff/ && !top { top = NR } END { print top }')
    if [ -n "$top" ]; then
      y=$((top + row_height + row_height * $1 + row_height / 2))
      [ "$(lines $y | awk -v colour=$chosen 'NR == 1 { print gsub(colour, "") }')" -gt 100 ] && return
      xdotool mousemove 100 $y click 1
    fi
    sleep 0.25
    settle
  done
  fail "entry $1 could not be chosen within a minute"
}

act() {
  shot "$folder/before.xwd"
  xdotool "$@"
  settle "$folder/before.xwd"
}

# By small steps: programs take the first movement only of a fast one.
drag() {
  local steps=() i
  for i in $(seq 25); do steps+=(mousemove $(($2 + $4 * i / 25)) $(($3 + $5 * i / 25)) sleep 0.1); done
  act mousemove "$2" "$3" mousedown "$1" sleep 0.1 "${steps[@]}" mouseup "$1"
}

end() {
  local group
  while read -r group; do kill -- "-$group" 2>/dev/null || true; done < <(tac "$folder/pids")
}

[ $# -ge 2 ] || { sed -n '2,11s/^# *//p' "$0" >&2; exit 2; }
what=$1 folder=$(realpath -m "$2")
shift 2
case $what in
  start) start "$@" ;;
  end) end ;;
  *)
    use_display
    case $what in
      row) row "$1" ;;
      click) act mousemove "$1" "$2" click 1 ;;
      drag) drag "$@" ;;
      wheel) act mousemove "$1" "$2" click --repeat "${3#-}" --delay 50 "$([ "$3" -gt 0 ] && echo 4 || echo 5)" ;;
      shot) shot "$1" ;;
      *) fail "'$what' is none of start, row, click, drag, wheel, shot, end" ;;
    esac ;;
esac
