#!/usr/bin/env bash
# Writes logs of a short street on each release, reads them on every one and tells in a table what was found, as
# share/doc/mrpt-releases.md has it. A cell is "same" where a reader finds what the release that wrote the log does.
#   share/cross-read.sh [release ...]     default: bookworm trixie sid, the systems of share/on-debian.sh; here: this one
# BIN (default: build/release/bin) has the tools, which are built where they are missing. Logs stay in out/cross-read.
set -euo pipefail
cd "$(dirname "$0")/.."
export BIN=${BIN:-build/release/bin}
out=out/cross-read

# In a system: write <release>, read <release>. Either prints lines of release, log, what our tools find, what MRPT's do.

build() {
  [ -x "$BIN/rawlog-export" ] || { bash share/install-deps.sh && cmake --preset release && cmake --build --preset release; }
}

# written <release> <settings as one word> <rawlog-densify's arguments>
written() {
  local log="$1,$2" release=$1
  shift 2
  "$BIN/rawlog-densify" --input "$out/$release.street" --output "$out/$log.rawlog" --overwrite "$@" > "$out/said" 2>&1 ||
    printf '%s\t%s\tnot written: %s\t\n' "$release" "$log" "$(tail -n 1 "$out/said")"
}

write_logs() {
  local release=$1 set
  build > "$out/build.log" 2>&1 || { tail -n 30 "$out/build.log" >&2; exit 1; }
  "$BIN/rawlog-simulate" --scenario config/scenarios/small.ini --duration 0.5 --output "$out/$release.street" --overwrite > "$out/said"
  written "$release" by-default
  for set in carrier=pointcloud annotate=1 compression=zstd:3; do
    written "$release" $set --set $set
    written "$release" $set,for-mrpt-2.5 --set $set --for-mrpt 2.5
  done
  # The street as MRPT's own program copies it, packed as that does by itself.
  rawlog-edit --cut --to-index 1000000 -i "$out/$release.street" -o "$out/$release,rawlog-edit.rawlog" -w > "$out/said" 2>&1
}

# found_by_us <log>: scans and points, and a sum of all their bytes; or the one line that says why there are none.
found_by_us() {
  local log=$1 label points found=
  for label in LIDAR LIDAR_VIRTUAL; do
    if [[ $log == *rawlog-edit.rawlog && $label == LIDAR_VIRTUAL ]]; then # has none yet
      "$BIN/rawlog-densify" --input "$log" --output "$out/densified" --overwrite > "$out/said" 2>&1 || { tail -n 1 "$out/said"; return; }
      log=$out/densified
    fi
    rm -rf "$out/scans"
    "$BIN/rawlog-export" --input "$log" --label $label --output "$out/scans" --format bin > "$out/said" 2>&1 ||
      { tail -n 1 "$out/said"; return; }
    points=$(($(cat "$out"/scans/*.bin | wc -c) / 16)) # four numbers of four bytes each
    found+="$(find "$out/scans" -name '*.bin' | wc -l) scans, $points points, sum $(cat "$out"/scans/*.bin | cksum | cut -d ' ' -f 1); "
  done
  echo "${found%; }"
}

read_logs() {
  local log objects
  for log in "$out"/*.rawlog; do
    objects=$(timeout 60 rawlog-edit --info -i "$log" 2>&1 | tr '\r' '\n' | sed -n 's/^Overall number of objects *: *//p')
    printf '%s\t%s\t%s\t%s\n' "$1" "$(basename "$log" .rawlog)" "$(found_by_us "$log")" "${objects:-none} objects"
  done
}

# On the machine: all of them in turn.

# folder_of <release>: where its logs lie, seen from here.
folder_of() {
  if [ "$1" = here ]; then echo "$out"; else echo "${CHROOTS:-/var/tmp/lidar_upsampling}/$1/root/lidar_upsampling/$out"; fi
}

# on <release> <write or read>
on() {
  if [ "$1" = here ]; then bash share/cross-read.sh "$2" "$1"
  else bash share/on-debian.sh "$1" env BIN="$BIN" bash share/cross-read.sh "$2" "$1" 2> "$out/$1.log" || { tail "$out/$1.log" >&2; exit 1; }; fi
}

table() {
  awk -F '\t' -v releases="$*" '
    { ours[$1, $2] = $3; stock[$1, $2] = $4; if (!told[$2]++) names[++n] = $2 }
    function cell(found, reader, name, writer) {
      if (!((reader, name) in found)) return ""
      return reader != writer && found[reader, name] == found[writer, name] ? "same" : found[reader, name]
    }
    END {
      count = split(releases, release, " ")
      head = "| written on | with |"; line = "|---|---|"
      for (i = 1; i <= count; ++i) { head = head " read on " release[i] " | its rawlog-edit |"; line = line "---|---|" }
      print head "\n" line
      for (k = 1; k <= n; ++k) {
        writer = with = names[k]; sub(/,.*/, "", writer); sub(/^[^,]*,/, "", with)
        row = "| " writer " | " with " |"
        for (i = 1; i <= count; ++i)
          row = row " " cell(ours, release[i], names[k], writer) " | " cell(stock, release[i], names[k], writer) " |"
        print row
      }
    }'
}

mkdir -p "$out"
case ${1:-} in
  write) write_logs "$2"; exit ;;
  read) read_logs "$2"; exit ;;
esac
[ $# -gt 0 ] || set -- bookworm trixie sid
for release; do
  echo "Writing on $release ..." >&2
  rm -f "$(folder_of "$release")"/*.rawlog
  on "$release" write > "$out/$release.written"
done
for from; do
  for to; do
    [ "$from" = "$to" ] || cp "$(folder_of "$from")/$from",*.rawlog "$(folder_of "$to")/"
  done
done
for release; do
  echo "Reading on $release ..." >&2
  on "$release" read > "$out/$release.read"
done
for release; do cat "$out/$release.written" "$out/$release.read"; done | table "$@"
