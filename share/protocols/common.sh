# What the scripts of this folder share; sourced by them.
# Tools are taken from $BUILD, build/release, build/dev or the PATH; logs and reports go to out/protocols/<protocol>, or $OUT.
set -euo pipefail
project=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
protocol=$(basename "$0" .sh)
out=${OUT:-$project/out/protocols/$protocol}
mkdir -p "$out"
config=$project/config/default.ini
comparisons=()

tool() {
  local place places=("$project"/build/{release,dev}/bin/"$1")
  [ -z "${BUILD:-}" ] || places=("$BUILD/bin/$1" "${places[@]}")
  for place in "${places[@]}"; do
    if [ -x "$place" ]; then echo "$place"; return; fi
  done
  command -v "$1" || { echo "$protocol: $1 is not built; run: cmake --preset release && cmake --build --preset release" >&2; exit 1; }
}

need_folder() {
  [ -d "$1" ] || { echo "$protocol: there is no folder $1 ($2)" >&2; exit 1; }
}

# densify_withheld <name> [options of rawlog-densify]: every second scan of <name>.rawlog is withheld, and made
# again from the images.
densify_withheld() {
  local name=$1; shift
  "$(tool rawlog-decimate)" --input "$out/$name.rawlog" --output "$out/$name-thinned.rawlog" \
    --label LIDAR --keep-every 2 --overwrite
  "$(tool rawlog-densify)" --config "$config" --input "$out/$name-thinned.rawlog" \
    --output "$out/$name-dense.rawlog" --report "$out/$name-report.json" --overwrite "$@"
  comparisons+=(--reference "$out/$name.rawlog" --input "$out/$name-dense.rawlog")
}

# print_table [options of rawlog-evaluate]: all that was densified, judged together.
print_table() {
  "$(tool rawlog-evaluate)" "${comparisons[@]}" --config "$config" --json "$out/errors.json" "$@"
}

# sequences_table <folder with sequences/ and poses/> [sequence ...]: this protocol's table on KITTI odometry.
sequences_table() {
  local root=${1:?usage: $0 <folder with sequences/ and poses/> [sequence ...]} sequence; shift
  need_folder "$root/sequences" "the KITTI odometry data set"
  config=$project/config/kitti.ini
  [ $# -gt 0 ] || set -- 02 03 04 05 06 07 08 09 10
  for sequence in "$@"; do
    "$(tool kitti2rawlog)" --sequence "$root/sequences/$sequence" --output "$out/$sequence.rawlog" --overwrite
    densify_withheld "$sequence"
  done
  print_table --protocol "$protocol"
}

# tracking_logs_table <folder of tracking logs> [log ...]: this protocol's table on Argoverse 1.
tracking_logs_table() {
  local root=${1:?usage: $0 <folder of tracking logs> [log ...]} log; shift
  need_folder "$root" "Argoverse 1 tracking logs"
  [ $# -gt 0 ] || { cd "$root"; set -- *; cd - > /dev/null; }
  for log in "$@"; do
    "$(tool argoverse2rawlog)" --log "$root/$log" --output "$out/$log.rawlog" --boxes "$out/${log}_boxes.csv" \
      --truth-objects "$out/${log}_objects.csv" --overwrite
    densify_withheld "$log" --detections "$out/${log}_boxes.csv"
    comparisons+=(--truth-objects "$out/${log}_objects.csv")
  done
  print_table --protocol "$protocol"
}
