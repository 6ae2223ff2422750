#!/usr/bin/env bash
# Tells snakemake how a job of Slurm stands: running, success or failed. A job that Slurm knows no more, by its accounting.
state=$(scontrol show job --oneliner "$1" 2> /dev/null | sed -n 's/.* JobState=\([A-Z_]*\).*/\1/p')
[ -n "$state" ] || state=$(sacct --noheader --parsable2 --allocations --format=state --jobs "$1" 2> /dev/null | head -n 1)
# Of a job that nobody knows snakemake learns as failed, unless nobody answers.
if [ -z "$state" ] && squeue --noheader > /dev/null 2>&1; then state=UNKNOWN; fi
case $state in
  COMPLETED) echo success ;;
  PENDING | CONFIGURING | RUNNING | COMPLETING | SUSPENDED | REQUEUED | "") echo running ;;
  *) echo failed ;;
esac
