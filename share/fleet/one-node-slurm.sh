#!/usr/bin/env bash
# A Slurm of this machine alone, to try the workflow on: munge, slurmctld and slurmd with a configuration of their own, without systemd.
#   share/fleet/one-node-slurm.sh start     as root, Debian packages munge and slurm-wlm; then: export SLURM_CONF=<what it prints>
#   share/fleet/one-node-slurm.sh stop      ends them and all jobs
set -euo pipefail
folder=${SLURM_FOLDER:-/run/one-node-slurm}
socket=/run/munge/munge.socket.2  # the one that Slurm's library asks

write_configuration() {
  local host memory
  host=$(hostname -s)
  memory=$(awk '/^MemTotal/ { print int($2 / 1024 * 0.9) }' /proc/meminfo)
  cat > "$folder/slurm.conf" << CONF
ClusterName=one
SlurmctldHost=$host(127.0.0.1)
SlurmUser=root
AuthType=auth/munge
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/slurmd.pid
SlurmctldLogFile=$folder/slurmctld.log
SlurmdLogFile=$folder/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/affinity
SelectType=select/cons_tres
SelectTypeParameters=CR_Core_Memory
MpiDefault=none
ReturnToService=2
NodeName=$host NodeAddr=127.0.0.1 CPUs=$(nproc) RealMemory=$memory State=UNKNOWN
PartitionName=all Nodes=$host Default=YES MaxTime=INFINITE State=UP
CONF
}

start() {
  [ ! -e "$folder" ] || { echo "one-node-slurm: $folder is there; run: $0 stop" >&2; exit 1; }
  for program in munged slurmctld slurmd; do
    command -v "$program" > /dev/null || { echo "one-node-slurm: $program is missing (packages munge, slurm-wlm)" >&2; exit 1; }
  done
  mkdir -p "$folder"/{state,spool}
  write_configuration
  if ! munge -n 2> /dev/null | unmunge > /dev/null 2>&1; then  # else the machine's own serves
    install -d -o munge -g munge /run/munge "$folder/munge"
    setpriv --reuid munge --regid munge --clear-groups munged --socket="$socket" --pid-file="$folder/munge/pid" \
      --log-file="$folder/munge/log" --seed-file="$folder/munge/seed"
  fi
  export SLURM_CONF=$folder/slurm.conf
  slurmctld
  slurmd -N "$(hostname -s)"
  for _ in $(seq 60); do
    if sinfo --noheader --format=%t 2> /dev/null | grep -q idle; then echo "$SLURM_CONF"; return; fi
    sleep 0.5
  done
  tail -n 5 "$folder"/*.log >&2
  echo "one-node-slurm: the node did not come up" >&2
  exit 1
}

stop() {
  local pid
  [ -d "$folder" ] || { echo "one-node-slurm: there is none in $folder" >&2; exit 1; }
  SLURM_CONF=$folder/slurm.conf scancel --user="$(id -un)" 2> /dev/null || true
  for pid in "$folder"/{slurmd,slurmctld}.pid "$folder/munge/pid"; do
    [ ! -s "$pid" ] || end "$(cat "$pid")"
  done
  rm -rf "$folder"
}

end() {
  kill "$1" 2> /dev/null || return 0
  for _ in $(seq 40); do
    kill -0 "$1" 2> /dev/null || return 0
    sleep 0.25
  done
  kill -9 "$1"
}

case ${1:-} in
  start | stop) "$1" ;;
  *) sed -n '3,4s/^# *//p' "$0" >&2; exit 2 ;;
esac
