# shellcheck shell=bash
# To be sourced by the scripts that make share/results.md: where they work, which runs there are, and how figures are read from them.
# Nothing is measured twice: a run leaves its figures in $OUT (default: out/results), and what lies there is taken as it is.
OUT=$(realpath -m "${OUT:-$(dirname "${BASH_SOURCE[0]}")/../out/results}")
export OUT
. "$(dirname "${BASH_SOURCE[0]}")/protocols/common.sh"

# The situations of the simulator that are measured; those that take longest first, so that none is left over at the end.
scenarios() {
  local file name
  for name in ring real_rig free_running slow_scanner crossing_crowd; do
    [ ! -e "$project/config/scenarios/$name.ini" ] || echo "$name"
  done
  for file in "$project"/config/scenarios/*.ini; do
    name=$(basename "$file" .ini)
    case $name in demo | small | ring | real_rig | free_running | slow_scanner | crossing_crowd) ;; *) echo "$name" ;; esac
  done
}

# run_name <share/measure.sh's arguments>: of its files in $OUT. Settings tell runs apart, too.
run_name() {
  local name
  case $1 in
    scenario) name=$2${3:+-$3} ;;
    drive) name=$(basename "$2")-keep-$3${4:+-camera-$4} ;;
    *) name=$(basename "$2") ;;
  esac
  name+=${SET:+,${SET// /,}}
  echo "${name//\//_}"
}

# The tools that figures come from: tables of several builds are told as such.
build_of_tools() {
  cat "$(tool rawlog-densify)" "$(tool rawlog-evaluate)" | cksum | cut -d ' ' -f 1
}

# in_parallel <function> < lines of its arguments: as many at a time as there are cores. What fails does not stop the others,
# and is made up for by the next call.
in_parallel() {
  xargs -P "${JOBS:-$(nproc)}" -L 1 bash -c '. "$0" && "$@"' "$project/share/runs.sh" "$1" ||
    { echo "$(basename "$0"): some runs failed; they are told above, and done again when called again" >&2; failed=1; }
}

# full_run <by> <share/measure.sh's arguments>: its table, unless it lies there; by what, see there.
full_run() {
  local name by=$1; shift
  name=$(run_name "$@")
  [ ! -s "$OUT/$name.txt" ] || return 0
  BY=$by TIDY=1 bash "$project/share/measure.sh" "$@" > /dev/null 2> "$OUT/$name.errors" ||
    { echo "$name failed: $(tail -n 3 "$OUT/$name.errors")" >&2; return 1; }
  rm -f "$OUT/$name.errors"
  awk -F, -v name="$name" '{ value[$2] = $3 }
    END { print name ": " value["seconds"] " s, " value["cpu_seconds"] " s of the cores" }' "$OUT/$name.csv" >&2
}

# short_run <group> <setting or -> <mode> <scenario> <seed>: judged by the truth alone, a line in $OUT/<group>/.
short_run() {
  local group=$1 setting=$2 mode=$3 scenario=$4 seed=$5 file
  file=$OUT/$group/$setting,$mode,$scenario-$seed
  mkdir -p "$OUT/$group"
  [ ! -s "$file.csv" ] || return 0
  SET="mode=$mode" && [ "$setting" = - ] || SET+=" $setting"
  BY=labels TIDY=1 SET=$SET CSV="$file.all" bash "$project/share/measure.sh" scenario "$scenario" "$seed" --no-paper \
    > /dev/null 2> "$file.errors" || { echo "$file failed: $(tail -n 3 "$file.errors")" >&2; return 1; }
  awk -F, -v run="$setting,$mode,$scenario,$seed" '
    $1 == "ours" || $1 == "run" { value[$2] = $3 }
    END {
      print run "," value["images"] "," value["movers"] "," value["movers_mean_m"] "," value["movers_p95_m"] "," value["parked"] "," \
        value["parked_told_to_move"] "," value["false_movers_per_image"] "," value["build"] "," value["seconds"] "," value["cpu_seconds"] }' \
    "$file.all" > "$file.new"
  mv "$file.new" "$file.csv"
  rm -f "$file.errors" "$file.all"
  echo "$(basename "$file"): $(cut -d , -f 13 "$file.csv") s, $(cut -d , -f 14 "$file.csv") s of the cores" >&2
}

# short_lines < runs as arguments of short_run: the lines they left.
short_lines() {
  local group setting mode scenario seed
  while read -r group setting mode scenario seed; do
    cat "$OUT/$group/$setting,$mode,$scenario-$seed.csv" 2> /dev/null || true
  done
}

# What the tables' awk programs share: the 97.5 % point of Student's t, and a mean with its interval.
statistics='
  function student(df) {
    split("12.706 4.303 3.182 2.776 2.571 2.447 2.365 2.306 2.262 2.228", quantile, " ")
    return df <= 10 ? quantile[df] : 1.96 + 2.5 / df
  }
  # Half the interval of a mean of n values, of their sum and their sum of squares; below two values there is none.
  function interval(n, sum, squares,   variance) {
    if (n < 2) return -1
    variance = (squares - sum * sum / n) / (n - 1)
    return student(n - 1) * sqrt((variance > 0 ? variance : 0) / n)
  }'
