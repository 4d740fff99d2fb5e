#!/usr/bin/env bash
# A Slurm of one machine for one command:   slurm_fixture.sh FOLDER COMMAND [ARGUMENT...]
#
# Starts munged, slurmctld and slurmd on the loopback as whoever calls, with every file below FOLDER; runs COMMAND with
# SLURM_CONF set; ends the jobs and the three daemons that it started, by their pid files; exits as COMMAND did. Exits
# with 77 where Slurm is not installed. Nothing of the machine's own Slurm or munge is read or changed.
#
#   SEAPILE_SLURM_PORT        of slurmctld; slurmd has the next one. Default: by the number of this process
#   SEAPILE_SLURM_CPUS        processors that the node claims to have, whatever the machine has (8)
#   SEAPILE_SLURM_MEMORY      memory that it claims [MB] (4000)
#   SEAPILE_SLURM_ARRAY_SIZE  MaxArraySize (4: an array has few tasks, so that a small study needs several)
set -euo pipefail
PATH=$PATH:/usr/sbin:/sbin
(($# >= 2)) || { sed -n '2,4p' "$0" >&2; exit 2; }
for program in munged slurmctld slurmd sbatch scontrol; do
  command -v "$program" > /dev/null || { echo "slurm_fixture: $program is not installed" >&2; exit 77; }
done

mkdir -p "$1"
folder=$(realpath "$1")
shift
port=${SEAPILE_SLURM_PORT:-$((20000 + $$ % 120 * 100))}
host=$(hostname -s)
user=$(id -un)
daemons=(slurmd slurmctld munged)  # in the order in which they are stopped
mkdir -p "$folder"/{log,pid,state,spool}
mkdir -p -m 700 "$folder/munge"
chmod 755 "$folder" "$folder"/{log,pid,state,spool}  # munged refuses a socket below a folder that others may write

is_up() { [ -s "$folder/pid/$1" ] && kill -0 "$(cat "$folder/pid/$1")" 2> /dev/null; }

# wait_until SECONDS COMMAND...: false when it has not become true by then.
wait_until() {
  local tries=$(($1 * 10))
  shift
  until "$@" > /dev/null 2>&1; do
    ((tries-- > 0)) || return 1
    sleep 0.1
  done
}

queue_is_empty() { [ -z "$(squeue --noheader)" ]; }

stop() {
  if is_up slurmctld && is_up slurmd; then
    # A job outlives slurmd, so that none may be left when it goes.
    squeue --noheader --format=%i 2> /dev/null | xargs --no-run-if-empty scancel 2> /dev/null || true
    wait_until 15 queue_is_empty || true
  fi
  local daemon pid
  for daemon in "${daemons[@]}"; do
    is_up "$daemon" || continue
    pid=$(cat "$folder/pid/$daemon")
    kill "$pid" || true
    wait_until 10 eval "! kill -0 $pid" || kill -KILL "$pid" || true
    rm -f "$folder/pid/$daemon"
  done
}

fail() {
  echo "slurm_fixture: $1" >&2
  tail -n 20 "$folder"/log/*.log >&2 || true
  exit 1
}

# Addresses: without the two No...InAddrAny the daemons would listen to the whole network. Containers have no control
# groups: processes are found by their parents, and memory is sampled each second. No database of accounts.
# EnforcePartLimits makes sbatch refuse what could never run. config_overrides lets the node claim more than it has.
cat > "$folder/slurm.conf" << CONF
ClusterName=seapile
SlurmUser=$user
SlurmdUser=$user
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=$port
SlurmdPort=$((port + 1))
CommunicationParameters=NoInAddrAny,NoCtldInAddrAny
AuthType=auth/munge
AuthInfo=socket=$folder/pid/munge.socket
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool
SlurmctldPidFile=$folder/pid/slurmctld
SlurmdPidFile=$folder/pid/slurmd
SlurmctldLogFile=$folder/log/slurmctld.log
SlurmdLogFile=$folder/log/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
MpiDefault=none
JobAcctGatherType=jobacct_gather/linux
JobAcctGatherFrequency=task=1
JobAcctGatherParams=OverMemoryKill
AccountingStorageType=accounting_storage/none
JobCompType=jobcomp/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core_Memory
SchedulerType=sched/backfill
SchedulerParameters=sched_interval=1,bf_interval=1,batch_sched_delay=0
MaxArraySize=${SEAPILE_SLURM_ARRAY_SIZE:-4}
EnforcePartLimits=ALL
ReturnToService=2
KillWait=3
SlurmdParameters=config_overrides
NodeName=$host NodeAddr=127.0.0.1 CPUs=${SEAPILE_SLURM_CPUS:-8} RealMemory=${SEAPILE_SLURM_MEMORY:-4000}
PartitionName=main Nodes=$host Default=YES State=UP
CONF
# Left to find out by itself which control groups there are, slurmd does not start where there are none.
echo CgroupPlugin=cgroup/v1 > "$folder/cgroup.conf"
export SLURM_CONF=$folder/slurm.conf

trap stop EXIT
trap 'exit 143' TERM HUP
trap 'exit 130' INT
head --bytes=1024 /dev/urandom > "$folder/munge/key"
chmod 400 "$folder/munge/key"
munged --key-file="$folder/munge/key" --seed-file="$folder/munge/seed" --socket="$folder/pid/munge.socket" \
  --pid-file="$folder/pid/munged" --log-file="$folder/log/munged.log" --num-threads=2 || fail "munged did not start"
wait_until 5 munge --socket="$folder/pid/munge.socket" --no-input || fail "munged does not answer"
slurmctld -c || fail "slurmctld did not start"
wait_until 10 sh -c 'scontrol ping | grep -q "is UP"' || fail "slurmctld does not answer"
slurmd -N "$host" || fail "slurmd did not start"
wait_until 30 sh -c 'sinfo --noheader --format=%t | grep -qx idle' || fail "the node did not become idle"

set +e
"$@"
exit $?
