#!/usr/bin/env bash
# What the next real scan is worth: errors of moving objects in both modes, by the simulator's truth. A table of share/results.md.
#   share/offline.sh
# Its runs are those of share/ablation.sh with nothing turned over; $OUT, $SEEDS, $JOBS and $SCENARIOS are as there.
. "$(dirname "$0")/runs.sh"
read -r -a seeds <<< "${SEEDS:-101}"
failed=0

runs() {
  local seed scenario mode
  for seed in "${seeds[@]}"; do
    for scenario in ${SCENARIOS:-$(scenarios)}; do
      for mode in causal offline; do echo "ablation - $mode $scenario $seed"; done
    done
  done
}
in_parallel short_run < <(runs)

echo "| | movers | mean error, m: causal | offline | ratio | 95 % below, m: causal | offline | false movers per image: causal | offline |"
echo "|---|---|---|---|---|---|---|---|---|"
runs | short_lines | awk -F, '
  !($3 in seen) { seen[$3] = 1; scenarios[++number] = $3 }
  { images[$3, $2]++; false_movers[$3, $2] += $11 }
  $6 > 0 { n[$3, $2]++; movers[$3, $2] += $6; error[$3, $2] += $7; worst[$3, $2] += $8 }
  END {
    for (i = 1; i <= number; i++) {
      c = scenarios[i] SUBSEP "causal"; o = scenarios[i] SUBSEP "offline"
      if (!n[c] || !n[o]) continue
      printf "%f\t| %s | %d | %.3f | %.3f | %.2f | %.3f | %.3f | %.2f | %.2f |\n", error[o] / n[o] / (error[c] / n[c]), scenarios[i], \
        movers[c], error[c] / n[c], error[o] / n[o], error[o] / n[o] / (error[c] / n[c]), worst[c] / n[c], worst[o] / n[o], \
        false_movers[c] / images[c], false_movers[o] / images[o]
    }
  }' | sort -t "$(printf '\t')" -k 1,1gr | cut -f 2
exit "$failed"
