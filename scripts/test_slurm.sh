#!/usr/bin/env bash
# Tests scripts/sweep.sbatch on a Slurm of one machine, which is started here and stopped at the end, as root:
# an array of shards, one of them requeued while it runs, gives the results of a sweep in one process.
set -euo pipefail
cd "$(dirname "$0")/.."
[ $# -eq 0 ] || exec scripts/usage.sh "$0" "$@"
packages=(slurm-wlm munge)
dpkg-query -W "${packages[@]}" >/dev/null 2>&1 || {
  echo "installing ${packages[*]}"
  apt-get -q update >/dev/null && DEBIAN_FRONTEND=noninteractive apt-get -q -y --no-install-recommends \
    install "${packages[@]}" >/dev/null
}
folder=$(mktemp -d)
export SLURM_CONF=$folder/slurm.conf

ended() { [ ! -r "/proc/$1/stat" ] || [ "$(cut -d' ' -f3 "/proc/$1/stat" 2>/dev/null)" = Z ]; }
# within SECONDS COMMAND…: until the command succeeds.
within() {
  local last=$((SECONDS + $1))
  shift
  until "$@" >/dev/null 2>&1; do
    if ((SECONDS > last)); then
      echo "test_slurm.sh: gave up waiting for: $*" >&2
      tail -n 5 "$folder"/*.log >&2
      return 1
    fi
    sleep 0.1
  done
}
stop_slurm() {
  local daemon pid
  for daemon in slurmd slurmctld munged; do
    pid=$(cat "$folder/$daemon.pid" 2>/dev/null) || continue
    kill "$pid" 2>/dev/null || true
    within 20 ended "$pid" || kill -9 "$pid"
  done
  rm -rf "$folder"
}
trap stop_slurm EXIT

mkdir -p "$folder/state" "$folder/spool"
chmod 755 "$folder"
(umask 077 && head -c 1024 /dev/urandom >"$folder/munge.key")
cat >"$SLURM_CONF" <<CONF
ClusterName=phongpipe
SlurmctldHost=localhost(127.0.0.1)
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket=$folder/munge.socket
CredType=cred/munge
SlurmctldPort=26817
SlurmdPort=26818
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/slurmd.pid
SlurmctldLogFile=$folder/slurmctld.log
SlurmdLogFile=$folder/slurmd.log
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SwitchType=switch/none
MpiDefault=none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SlurmdParameters=config_overrides
SchedulerParameters=sched_min_interval=0,batch_sched_delay=0,sched_interval=1
KillWait=2
NodeName=localhost NodeAddr=127.0.0.1 CPUs=4 State=UNKNOWN
PartitionName=all Nodes=localhost Default=YES MaxTime=INFINITE State=UP
CONF
munged --force --socket="$folder/munge.socket" --key-file="$folder/munge.key" --pid-file="$folder/munged.pid" \
  --log-file="$folder/munged.log" --seed-file="$folder/munged.seed"
slurmctld -f "$SLURM_CONF"
slurmd -f "$SLURM_CONF" -N localhost
within 30 sh -c 'sinfo -h -o %T | grep -qx idle'

PHONGPIPE=$PWD/build/bin/phongpipe
export PHONGPIPE
sweep=(sphere --rtl off --vary rom_address_bits=6:13 --vary diffuse_fraction_bits=4:18 --vary seed=1:4
       --set scene.image.width=96 --set 'scene.object.0.segments=[12,8]' --vary detail=cycle)
job=$(sbatch --parsable --array=1-3 --cpus-per-task=1 --output="$folder/task-%a.txt" \
  scripts/sweep.sbatch "$folder/results" "${sweep[@]}")
within 60 test -s "$folder/results/shard-2.db"
scontrol requeue "${job}_2"
echo "shard 2 of job $job was requeued"
# Slurm waits two minutes before it starts a requeued task again, if it is not told otherwise.
within 60 sh -c "squeue -h -j ${job}_2 -t PENDING -o %i | grep -q ."
scontrol update "jobid=${job}_2" starttime=now
within 300 test -e "$folder/results/all.db"

"$PHONGPIPE" sweep "${sweep[@]}" --db "$folder/whole.db" >/dev/null
# All columns but those that a clock measured.
columns() {
  "$PHONGPIPE" export "$1" --json - | sed '/seconds"/d'
}
diff <(columns "$folder/whole.db") <(columns "$folder/results/all.db") >/dev/null || {
  echo "test_slurm.sh: the merged shards differ from the sweep in one process" >&2
  exit 1
}
echo "the shards of $("$PHONGPIPE" export "$folder/results/all.db" --json - | grep -c '"identity"') runs equal the sweep in one process"
