#!/usr/bin/env bash
# Tests that a batch through a real Slurm gives the table of a batch without it: slurm.sh PROGRAM SOURCE_DIR
# Starts munged, slurmctld and slurmd for this user, in a temporary folder and on free ports, and stops them again.
# Exits with 77 (skipped) where Slurm is not installed.
set -euo pipefail

program=$1 source=$2
for command in munged slurmctld slurmd sbatch squeue; do
  PATH=$PATH:/usr/sbin command -v $command >/dev/null && continue
  echo "skipped: $command is not installed (Debian: slurm-wlm, munge)"
  exit 77
done
PATH=$PATH:/usr/sbin

# The paths of sockets are limited in length: use /tmp, not a folder of the build.
work=$(mktemp -d /tmp/tack_slurm.XXXXXX)
pids=()
clean_up() {
  local status=$?
  if ((status != 0)); then tail -n 40 "$work"/*.log "$work"/*.txt "$work"/*/output/*.txt 2>/dev/null || true; fi
  for pid in "${pids[@]}"; do kill "$pid" 2>/dev/null || true; done
  for pid in "${pids[@]}"; do wait "$pid" 2>/dev/null || true; done
  pkill -f "slurmstepd.*$work" 2>/dev/null || true
  rm -rf "$work"
  exit $status
}
trap clean_up EXIT
chmod 755 "$work"

free_port() {
  local port
  while port=$((20000 + RANDOM % 20000)); (: >"/dev/tcp/127.0.0.1/$port") 2>/dev/null; do :; done
  echo $port
}

dd if=/dev/urandom of="$work/munge.key" bs=128 count=1 status=none
chmod 400 "$work/munge.key"
munged --foreground --force --key-file="$work/munge.key" --socket="$work/munge.socket" --pid-file="$work/munged.pid" \
  --log-file="$work/munged.log" --seed-file="$work/munge.seed" >"$work/munged.out.log" 2>&1 &
pids+=($!)

host=$(hostname -s) user=$(id -un)
mkdir "$work/state" "$work/spool"
cat >"$work/slurm.conf" <<CONF
ClusterName=tack
SlurmctldHost=$host(127.0.0.1)
SlurmUser=$user
SlurmdUser=$user
AuthType=auth/munge
# A job that is queued again starts once its old credential has expired: after 5 s instead of 120.
AuthInfo=socket=$work/munge.socket,cred_expire=5
CredType=cred/munge
SlurmctldPort=$(free_port)
SlurmdPort=$(free_port)
SlurmctldPidFile=$work/slurmctld.pid
SlurmdPidFile=$work/slurmd.pid
StateSaveLocation=$work/state
SlurmdSpoolDir=$work/spool
SlurmctldLogFile=$work/slurmctld.log
SlurmdLogFile=$work/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SchedulerParameters=sched_interval=1,sched_min_interval=0
ReturnToService=2
MailProg=/bin/true
MaxArraySize=4
NodeName=$host NodeAddr=127.0.0.1 CPUs=$(nproc) State=UNKNOWN
PartitionName=short Nodes=$host Default=YES MaxTime=INFINITE State=UP
CONF
export SLURM_CONF=$work/slurm.conf
slurmctld -D >"$work/slurmctld.out.log" 2>&1 &
pids+=($!)
slurmd -D -N "$host" >"$work/slurmd.out.log" 2>&1 &
pids+=($!)
for ((i = 0; ; ++i)); do
  if sinfo -h -o %T 2>/dev/null | grep -q idle; then break; fi
  ((i < 300)) || { echo "the cluster does not come up"; exit 1; }
  sleep 0.1
done

# Those that a batch is to keep apart: an expectation that fails, a time limit, and all is well.
cat >"$work/batch.yaml" <<YAML
name: through_slurm
base: $source/experiments/first/hang.yaml
set: [output.frames=false, time.duration=0.1 s]
vary:
  - type: grid
    keys: {objects.cube.energies.0.young: {values: [0.05 MPa, 0.1 MPa, 0.2 MPa], as: young}}
  - {type: repeat, count: 2}
slurm: {partition: short, time: 10 min}
YAML
cd "$work"
"$program" batch batch.yaml -o here >here.txt || [[ $? == 1 ]]
"$program" batch batch.yaml -o there --slurm >there.txt || [[ $? == 1 ]]
# A folder with a name that Slurm would read otherwise.
"$program" batch batch.yaml -o "left %A 'over' # \"here\"" --slurm --no-wait >left.txt
"$program" batch batch.yaml -o 'back\slash' --slurm 2>refused.txt && exit 1
grep -q "take another folder" refused.txt
for ((i = 0; ; ++i)); do
  if [[ -z $(squeue -h) ]]; then break; fi
  ((i < 600)) || { echo "the jobs do not end"; exit 1; }
  sleep 0.1
done
mv "left %A 'over' # \"here\"" left
"$program" batch --collect left >collected.txt || [[ $? == 1 ]]

# Times and memory are measured, and stand last; all before them has to be the same.
for folder in here there left; do
  measured=$(head -n 1 $folder/results.csv | grep -o 'wall_seconds.*' | tr ',' '\n' | wc -l)
  sed -E "s/(,[^,]*){$measured}\$//" $folder/results.csv >$folder.table
done
cmp here.table there.table
cmp here.table left.table
# An array of this cluster has tasks 0 to 3: six cases take two.
grep -q '^jobs [0-9]*, [0-9]* submitted: 6 cases' there.txt
[[ $(wc -l <here.table) == 7 ]]
grep -q ',done,' here.table
grep -q ',expectation failed,' here.table
# Nothing is submitted that is done.
"$program" batch batch.yaml -o there --slurm >again.txt || [[ $? == 1 ]]
grep -q "6 of 6 cases are done already" again.txt

# A case that reaches its time limit (Slurm sends SIGUSR1 then; here scancel does) is queued again and goes on from its
# newest checkpoint, with the bits of a run at one go; each start runs the prologue.
cat >"$work/long.yaml" <<YAML
name: long
base: $source/experiments/first/hang.yaml
set: [output.frames=false, output.checkpoint_interval=10 ms, time.duration=20 s, time.step=1 ms]
slurm:
  partition: short
  time: 10 min
  requeues: 1
  prologue:
    - echo "start \$((\${SLURM_RESTART_COUNT:-0} + 1))"
vary: [{type: repeat, count: 1}]
YAML
"$program" batch long.yaml -o long --slurm --no-wait >long.txt
signalled() {  # sends SIGUSR1 once the running task has written a checkpoint newer than $1
  local newest
  for ((i = 0; ; ++i)); do
    newest=$(find long/cases -name '*.checkpoint' | sort | tail -n 1)
    if [[ -n $newest && $newest != "$1" && $(squeue -h -o %T) == RUNNING ]]; then break; fi
    ((i < 1200)) || { echo "no checkpoint after '$1'"; exit 1; }
    sleep 0.1
  done
  scancel --batch --signal=USR1 "$(squeue -h -o %A)"
}
signalled ""
for ((i = 0; ; ++i)); do
  if grep -q "queued again" long/output/slurm_*.txt; then break; fi
  ((i < 300)) || { echo "the task is not queued again"; exit 1; }
  sleep 0.1
done
signalled "$(find long/cases -name '*.checkpoint' | sort | tail -n 1)"
for ((i = 0; ; ++i)); do
  if [[ -z $(squeue -h) ]]; then break; fi
  ((i < 600)) || { echo "the task does not end"; exit 1; }
  sleep 0.1
done
grep -q "^start 1" long/output/slurm_*.txt
grep -q "^start 2" long/output/slurm_*.txt
grep -q "not queued again after 1 restart" long/output/slurm_*.txt
grep -q "resumed at step" long/output/*.txt
"$program" batch long.yaml -o none --slurm --set 'set=[output.frames=false]' 2>refused.txt && exit 1
grep -q "writes no checkpoints" refused.txt

# A calibration, which asks for its points in rounds, gives the same points through Slurm.
cat >"$work/fit.yaml" <<YAML
name: fit
experiments:
  - {base: $source/experiments/calibration/pull.yaml, set: [time.step=50 ms], data: $source/experiments/calibration/pull.csv, x: way, y: force, noise: 2%}
fit:
  strength: {keys: contact.pairs.0.adhesion.peak_traction, from: 5 kPa, to: 20 kPa}
search: {design: 4, chains: 2, evaluations: 8, polish: false}
slurm: {partition: short, time: 10 min}
YAML
"$program" calibrate fit.yaml -q -o fit_here
"$program" calibrate fit.yaml -q -o fit_there --slurm
cmp fit_here/evaluations.csv fit_there/evaluations.csv
"$program" calibrate fit.yaml -q -o fit_there --slurm
grep -q '"started": 0' fit_there/calibration.json
echo "the same table here, through Slurm, and collected later; a task that is queued again; the same calibration"
