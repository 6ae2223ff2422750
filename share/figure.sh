# To be sourced by the scripts that make share/results.md, in the project's folder: where they work, and what they read.
out=${OUT:-out/results}
drive=${1:-}
mkdir -p "$out"

# The situations of the simulator that are measured.
scenarios() {
  local file name
  for file in config/scenarios/*.ini; do
    name=$(basename "$file" .ini)
    case $name in demo | small) ;; *) echo "$name" ;; esac
  done
}

# figure <table> <heading's beginning> <row> <column after the row's name>
figure() {
  awk -v heading="$2" -v row="$3" -v column="$4" '
    index($0, heading) == 1 { inside = 1; next }
    /^$/ { inside = 0 }
    inside && $1 == row { print $(column + 1); exit }' "$1"
}
