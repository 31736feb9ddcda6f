#!/usr/bin/env bash
# burin submit on a real Slurm: a controller and two nodes on this machine, started and stopped here.
#   slurm_test.sh BURIN
# Ends with 77 (skipped) only where Slurm is not installed, or its daemons do not start: scripts/install-dependencies
# installs it.
set -euo pipefail
burin=$1
fail() {
    [ -d "${run:-}" ] && tail -n 20 "$run"/shot/*/burin-logs/*.txt >&2
    echo "slurm_test: $1" >&2
    exit 1
}
for program in munged slurmctld slurmd sbatch scontrol squeue; do
    command -v "$program" >/dev/null || PATH=$PATH:/usr/sbin
    command -v "$program" >/dev/null || { echo "slurm_test: skipped, there is no $program (install slurm-wlm)"; exit 77; }
done
[ "$(id -u)" -eq 0 ] || { echo "slurm_test: skipped, Slurm's nodes can be started by root only"; exit 77; }

run=$(mktemp -d)
chmod 755 "$run"
stop_slurm() {
    for pid in "$run"/pid/*.pid; do [ -f "$pid" ] && kill "$(cat "$pid")" 2>/dev/null; done
    sleep 0.5
    pkill -9 -f "$run/" 2>/dev/null || true
    rm -rf "$run"
}
trap stop_slurm EXIT
mkdir "$run/pid" "$run/state" "$run/shot"
port=$((20000 + $$ % 20000))
host=$(hostname -s)
dd if=/dev/urandom of="$run/munge.key" bs=1024 count=1 2>/dev/null
chmod 400 "$run/munge.key"
munged --force --key-file="$run/munge.key" --socket="$run/munge.sock" --pid-file="$run/pid/munged.pid" \
    --log-file="$run/munged.log" --seed-file="$run/munge.seed" 2>/dev/null
cat >"$run/slurm.conf" <<CONF
ClusterName=test
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=$port
SlurmdPort=$((port + 1))
AuthType=auth/munge
AuthInfo=socket=$run/munge.sock
SlurmUser=root
SlurmdUser=root
StateSaveLocation=$run/state
SlurmdSpoolDir=$run/spool-%n
SlurmctldPidFile=$run/pid/slurmctld.pid
SlurmdPidFile=$run/pid/slurmd-%n.pid
SlurmctldLogFile=$run/slurmctld.log
SlurmdLogFile=$run/slurmd-%n.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SwitchType=switch/none
MpiDefault=none
MailProg=/bin/true
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SlurmdParameters=config_overrides
SchedulerParameters=batch_sched_delay=0,sched_min_interval=0,sched_interval=2,bf_interval=2
ReturnToService=2
SlurmdTimeout=6
KillWait=5
NodeName=n1 NodeHostname=$host NodeAddr=127.0.0.1 Port=$((port + 2)) CPUs=1 RealMemory=4000
NodeName=n2 NodeHostname=$host NodeAddr=127.0.0.1 Port=$((port + 3)) CPUs=1 RealMemory=4000
PartitionName=main Nodes=ALL Default=YES MaxTime=INFINITE State=UP
CONF
export SLURM_CONF=$run/slurm.conf
slurmctld -f "$SLURM_CONF" -c
slurmd -N n1 -f "$SLURM_CONF"
slurmd -N n2 -f "$SLURM_CONF"
for _ in $(seq 60); do [ "$(sinfo -h -o %t%D 2>/dev/null)" = idle2 ] && break; sleep 0.5; done
if [ "$(sinfo -h -o %t%D 2>/dev/null)" != idle2 ]; then
    tail -n 5 "$run"/*.log >&2
    echo "slurm_test: skipped, Slurm is installed but its daemons do not start here"
    exit 77
fi

# Waits until no job is left; tasks that are tried again would wait two minutes.
wait_for_jobs() {
    for _ in $(seq "$1"); do
        jobs=$(squeue -h -r -o '%i %r') || true
        [ -z "$jobs" ] && return
        while read -r job reason; do
            [ "$reason" = BeginTime ] && scontrol update JobId="$job" StartTime=now 2>/dev/null
        done <<<"$jobs"
        sleep 1
    done
    squeue -r >&2
    fail "jobs do not end"
}

cd "$run/shot"
cat >shot.toml <<'TOML'
[frames]
range = "1-20"
[turntable]
frames = 20
[[camera]]
eye = [3, 2, 4]
target = [0, 0, 0]
[[object]]
name = "part"
file = "part.obj"
TOML
cube='v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\nf 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n'
printf "$cube" >part.obj
submit() { "$burin" submit shot.toml -r 320x192 "$@"; }

# Nothing is submitted by --dry-run.
mkdir dry
submit -o dry/out.####.exr --chunk 4 --dry-run >dry.txt || fail "--dry-run"
grep -q '^#SBATCH --array=0-4$' dry.txt || fail "--dry-run does not print the script"
[ -z "$(squeue -h)" ] || fail "--dry-run has submitted"

# An undisturbed run, by the program alone.
mkdir alone
"$burin" render shot.toml -r 320x192 -f 1-20 -o alone/out.####.exr -q --skip-existing
same() {
    for frame in $(seq -w 1 20); do
        cmp "alone/out.00$frame.exr" "$1/out.00$frame.exr" || fail "$1: frame $frame"
    done
    [ -z "$(find "$1" -name '.*burin-*')" ] || fail "$1: temporary files are left"
}

# All frames, in chunks.
mkdir farm
submit -o farm/out.####.exr --chunk 4 >jobs.txt || fail "submit"
wait_for_jobs 120
same farm
grep -h "all frames are there" farm/burin-logs/collect_*.txt >/dev/null || fail "the last job says nothing"

# What is there is not rendered again, and what is missing is.
rm farm/out.0007.exr farm/out.0012.exr
submit -o farm/out.####.exr --chunk 4 --dry-run >again.txt
grep -q "frames='\?7,12'\? ;;" again.txt || fail "the missing frames are not all that is submitted: $(grep frames= again.txt)"
submit -o farm/out.####.exr --chunk 4 >/dev/null
wait_for_jobs 120
same farm

# A node is killed at work: the tasks it had run on the other one.
mkdir killed
submit -o killed/out.####.exr --chunk 10 -j 1 >/dev/null
for _ in $(seq 100); do [ -n "$(ls killed/*.exr 2>/dev/null)" ] && break; sleep 0.1; done
kill -9 "$(cat "$run/pid/slurmd-n1.pid")" || true
pkill -9 -f "killed/out" || true
wait_for_jobs 200
[ -n "$(ls killed/*.exr)" ] || fail "no frame of the killed job"
slurmd -N n1 -f "$SLURM_CONF"
submit -o killed/out.####.exr --chunk 10 >/dev/null || true # what is missing, if anything is
wait_for_jobs 200
same killed

# Bands of frames are joined to the files of the whole.
mkdir bands
submit -o bands/out.####.exr --chunk 10 --bands 3 >/dev/null
wait_for_jobs 200
same bands
[ "$(find bands -name '*.exr' | wc -l)" -eq 20 ] || fail "bands are left"

# A frame that cannot be rendered is named, with the command that renders it.
mkdir broken
rm part.obj
! submit -o broken/out.####.exr --chunk 20 >broken.txt 2>&1 || fail "a missing model is not noticed before"
grep -q "part.obj" broken.txt || fail "the missing model is not named"
echo "slurm_test: done"
