# To be sourced.
# figure <table> <heading's beginning> <row> <column after the row's name>
figure() {
  awk -v heading="$2" -v row="$3" -v column="$4" '
    index($0, heading) == 1 { inside = 1; next }
    /^$/ { inside = 0 }
    inside && $1 == row { print $(column + 1); exit }' "$1"
}
