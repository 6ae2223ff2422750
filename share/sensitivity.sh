#!/usr/bin/env bash
# How much hangs on the parameters of the motion estimator: each number of some sections of config/default.ini times 0.7 and
# times 1.4, causal, in three scenarios, by the simulator's truth. A table of share/results.md.
#   share/sensitivity.sh
# Can be stopped and called again: each run leaves a line in $OUT/sensitivity (default: out/results/sensitivity) and is not run
# anew. $SEEDS draws the scenarios, default "101". $SCENARIOS: others. $PARAMETERS: "section.name ...", only these. $JOBS: runs
# at a time.
. "$(dirname "$0")/runs.sh"
read -r -a seeds <<< "${SEEDS:-101}"
read -r -a names <<< "${SCENARIOS:-motorway crossing_crowd real_rig}"
sections="points klt object_tracks object_motion.sigma_px"  # or single settings
failed=0
mkdir -p "$OUT/sensitivity"

# Lines of setting, its value, and the settings with 0.7 and 1.4 of it; - where it takes no such value.
parameters() {
  local setting value factor changed line
  "$(tool rawlog-densify)" --print-config | awk -v sections=" $sections " -v wanted=" ${PARAMETERS:-} " '
    /^\[/ { section = substr($0, 2, length($0) - 2) }
    (index(sections, " " section " ") || index(sections, " " section "." $1 " ")) && $2 == "=" && $3 ~ /^[0-9.e+-]+$/ && $3 != 0 {
      if (wanted == "  " || index(wanted, " " section "." $1 " ")) print section "." $1, $3
    }' | while read -r setting value; do
      line="$setting $value"
      for factor in 0.7 1.4; do
        changed=$(awk -v value="$value" -v factor="$factor" 'BEGIN { printf "%.6g", value * factor }')
        case $(refusal "$setting=$changed") in
          "") ;;
          *"whole number"*)
            changed=$(awk -v value="$changed" 'BEGIN { printf "%.0f", value }')
            [[ $(refusal "$setting=$changed") != *"odd number"* ]] || changed=$((changed + 1))
            [ "$changed" != "$value" ] && [ -z "$(refusal "$setting=$changed")" ] || changed=- ;;
          *) changed=- ;;
        esac
        line+=" $changed"
      done
      echo "$line"
    done
}
# What rawlog-densify says against a setting; it reads settings before logs.
refusal() {
  "$(tool rawlog-densify)" --set "$1" --input "$OUT/no such log" --output "$OUT/none.rawlog" 2>&1 | grep '\[.*\] .* = ' || true
}
list=$(parameters)

runs() {
  local seed scenario setting value less more
  for seed in "${seeds[@]}"; do
    for scenario in "${names[@]}"; do
      echo "sensitivity - causal $scenario $seed"
      while read -r setting value less more; do
        for value in "$less" "$more"; do
          [ "$value" = - ] || echo "sensitivity $setting=$value causal $scenario $seed"
        done
      done <<< "$list"
    done
  done
}
in_parallel short_run < <(runs)

echo "Scenarios: ${names[*]}; seeds: ${seeds[*]}. What moves the error most comes first; \"-\": the setting takes no such value."
echo
echo "| parameter | value | x 0.7: error of movers | false movers per image | most, in | x 1.4: error of movers | false movers per image | most, in |"
echo "|---|---|---|---|---|---|---|---|"
runs | short_lines | awk '
  function size(value) { return value < 0 ? -value : value }
  FILENAME == "-" {
    split($0, part, ",")
    key = part[1] SUBSEP part[3] SUBSEP part[4]
    if (part[1] == "-") runs[++number] = part[3] SUBSEP part[4]
    if (part[6] > 0) error[key] = part[7]
    false_movers[key] = part[11]
    next
  }
  function cells(setting,   i, n, sum, change, most, where, extra, pairs) {
    for (i = 1; i <= number; i++) {
      if (!((setting SUBSEP runs[i]) in false_movers)) continue
      pairs++
      extra += false_movers[setting, runs[i]] - false_movers["-", runs[i]]
      if (!(error["-", runs[i]] > 0) || !(error[setting, runs[i]] > 0)) continue
      change = log(error[setting, runs[i]] / error["-", runs[i]])
      n++
      sum += change
      if (where == "" || size(change) > size(most)) { most = change; where = runs[i]; sub(SUBSEP, " ", where) }
    }
    if (!pairs) return " - | - | - |"
    if (n && size(sum / n) > largest) largest = size(sum / n)
    return (n ? sprintf(" %+.1f %%", 100 * (exp(sum / n) - 1)) : " -") sprintf(" | %+.2f |", extra / pairs) \
      (n ? sprintf(" %s: %+.0f %% |", where, 100 * (exp(most) - 1)) : " - |")
  }
  {
    largest = 0
    row = cells($1 "=" $3) cells($1 "=" $4)
    printf "%f\t| `%s` | %s |%s\n", largest, $1, $2, row
  }' - <(echo "$list") | sort -t "$(printf '\t')" -k 1,1gr -k 2 | cut -f 2
exit "$failed"
