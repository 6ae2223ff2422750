#!/usr/bin/env bash
# What each switch of the estimator is worth: every on/off setting of config/default.ini turned over, in all scenarios and both
# modes, by the simulator's truth. A table of share/results.md.
#   share/ablation.sh
# Can be stopped and called again: each run leaves a line in $OUT/ablation (default: out/results/ablation) and is not run anew.
# $SEEDS draws the scenarios, default "101"; more seeds make the intervals smaller. $SWITCHES: settings to turn instead, as
# "section.name=value ...". $JOBS: runs at a time. $MODES: default "causal offline". $SCENARIOS: default: all.
. "$(dirname "$0")/runs.sh"
read -r -a seeds <<< "${SEEDS:-101}"
read -r -a modes <<< "${MODES:-causal offline}"
failed=0

# Lines of setting, turned over, and what it says of itself.
switches() {
  local setting
  if [ -n "${SWITCHES:-}" ]; then
    for setting in $SWITCHES; do printf '%s\t%s\n' "$setting" ""; done
    return
  fi
  "$(tool rawlog-densify)" --print-config | awk '
    /^#/ { told = substr($0, 3) }
    /^\[/ { section = substr($0, 2, length($0) - 2) "."; if (section == "lidar_upsampling.") section = "" }
    $2 == "=" && ($3 == "true" || $3 == "false") { print section $1 "=" ($3 == "true" ? "false" : "true") "\t" told }'
}

runs() {
  local seed scenario mode setting told
  for seed in "${seeds[@]}"; do
    for scenario in ${SCENARIOS:-$(scenarios)}; do
      for mode in "${modes[@]}"; do
        echo "ablation - $mode $scenario $seed"
        while IFS=$'\t' read -r setting told; do
          [ "$mode" = causal ] && [[ $told == offline:* ]] || echo "ablation $setting $mode $scenario $seed"
        done < <(switches)
      done
    done
  done
}
in_parallel short_run < <(runs)

runs | short_lines | awk -F, "$statistics"'
  # Of a switch in a mode: changes by which its runs differ from those with nothing turned over, in pairs.
  function change(setting, mode,   i, key, parts, base, new, value) {
    split("", count); split("", sum); split("", squares); split("", by_scenario)
    most = ""
    for (i = 1; i <= number; i++) {
      split(runs[i], parts, SUBSEP)
      if (parts[1] != mode) continue
      base = "-" SUBSEP runs[i]; new = setting SUBSEP runs[i]
      if (!(base in error) || !(new in error)) continue
      if (movers[base] > 0 && error[base] > 0 && error[new] > 0) {
        add("mm", 1000 * (error[new] - error[base]))
        add("log", log(error[new] / error[base]))
        add("log" SUBSEP parts[2], log(error[new] / error[base]))
        add("from" SUBSEP parts[2], error[base])
        add("to" SUBSEP parts[2], error[new])
        if (!(parts[2] in by_scenario)) by_scenario[parts[2]] = 1
      }
      add("false", false_movers[new] - false_movers[base])
      if (parked[base] > 0) add("parked", 100 * (told[new] / parked[new] - told[base] / parked[base]))
    }
    for (value in by_scenario)
      if (most == "" || size(mean("log" SUBSEP value)) > size(mean("log" SUBSEP most))) most = value
  }
  function size(value) { return value < 0 ? -value : value }
  function add(what, value) { count[what]++; sum[what] += value; squares[what] += value * value }
  function mean(what) { return count[what] > 0 ? sum[what] / count[what] : 0 }
  # As it stands in the table; in bold where the interval leaves out no change at all.
  function shown(what, digits, name,   half, text) {
    if (!count[what]) return "-"
    half = interval(count[what], sum[what], squares[what])
    text = sprintf("%+." digits "f", mean(what)) (half < 0 ? "" : sprintf(" ± %." digits "f", half))
    if (half < 0 || size(mean(what)) <= half) return text
    decided = decided (decided == "" ? "" : ", ") name
    return "**" text "**"
  }
  function percent(   half, low, high, text) {
    if (!count["log"]) return "-"
    half = interval(count["log"], sum["log"], squares["log"])
    text = sprintf("%+.0f %%", 100 * (exp(mean("log")) - 1))
    if (half < 0) return text
    low = mean("log") - half; high = mean("log") + half
    text = text sprintf(" (%+.0f to %+.0f)", 100 * (exp(low) - 1), 100 * (exp(high) - 1))
    if (low <= 0 && high >= 0) return text
    decided = "error"
    return "**" text "**"
  }
  FILENAME == "-" {
    key = $1 SUBSEP $2 SUBSEP $3 SUBSEP $4
    if (!(($2, $3, $4) in known)) { known[$2, $3, $4] = 1; runs[++number] = $2 SUBSEP $3 SUBSEP $4 }
    movers[key] = $6; error[key] = $7; parked[key] = $9; told[key] = $10; false_movers[key] = $11
    modes[$2] = 1
    next
  }
  { split($0, parts, "\t"); settings[++rows] = parts[1]; about[parts[1]] = parts[2] }
  END {
    split("causal offline", order, " ")
    printf "| turned over | |"
    rule = "|---|---|"
    for (m = 1; m <= 2; m++)
      if (order[m] in modes) {
        printf " %s: pairs | error of movers | mm | false movers per image | parked told to move, points of %% | decides |", order[m]
        rule = rule "---|---|---|---|---|---|"
      }
    print "\n" rule
    for (r = 1; r <= rows; r++) {
      printf "| `%s` | %s |", settings[r], about[settings[r]]
      for (m = 1; m <= 2; m++)
        if (order[m] in modes) {
          change(settings[r], order[m])
          decided = ""
          if (!count["false"]) { printf " - | - | - | - | - | - |"; continue }
          error_text = percent()
          # The same question in millimetres decides nothing a second time.
          half = interval(count["mm"], sum["mm"], squares["mm"])
          mm = sprintf("%+.1f", mean("mm")) (half < 0 ? "" : sprintf(" ± %.1f", half))
          false_text = shown("false", 2, "false movers"); parked_text = shown("parked", 1, "parked")
          printf " %d | %s | %s | %s | %s | %s |", count["false"], error_text, count["mm"] ? mm : "-", false_text, parked_text, \
            decided == "" ? "nothing" : decided
        }
      print ""
    }
    printf "\nWhere each matters most, mean error of movers, m:\n\n| turned over |"
    rule = "|---|"
    for (m = 1; m <= 2; m++) if (order[m] in modes) { printf " %s: scenario | as it is | turned over |", order[m]; rule = rule "---|---|---|" }
    print "\n" rule
    for (r = 1; r <= rows; r++) {
      printf "| `%s` |", settings[r]
      for (m = 1; m <= 2; m++)
        if (order[m] in modes) {
          change(settings[r], order[m])
          if (most == "") printf " - | - | - |"
          else printf " %s | %.3f | %.3f |", most, mean("from" SUBSEP most), mean("to" SUBSEP most)
        }
      print ""
    }
  }' - <(switches)
exit "$failed"
