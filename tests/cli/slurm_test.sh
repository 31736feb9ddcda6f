#!/usr/bin/env bash
# burin submit on a real Slurm: a controller and two nodes on this machine, started and stopped here.
#   slurm_test.sh BURIN
# Ends with 77 (skipped) only where Slurm is not installed, which scripts/install-dependencies does, or where nobody but
# root may start its daemons.
set -euo pipefail
burin=$1
fail() {
    tail -n 20 "${run:-/nonexistent}"/shot/*/burin-logs/*.txt >&2 2>/dev/null || true
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
# Of the jobs of this test, and of its daemons.
processes_of_jobs() { { grep -lzxF "SLURM_CONF=$run/slurm.conf" /proc/[0-9]*/environ 2>/dev/null || true; } | cut -d / -f 3; }
parent_of() { sed -n 's/^PPid:[[:space:]]*//p' "/proc/$1/status" 2>/dev/null; }
stop_slurm() {
    for pid in "$run"/pid/*.pid; do
        [ -f "$pid" ] && tr '\0' ' ' <"/proc/$(cat "$pid")/cmdline" 2>/dev/null | grep -q "$run" && kill "$(cat "$pid")"
    done
    sleep 0.5
    for pid in $(processes_of_jobs); do kill -9 "$pid" 2>/dev/null || true; done
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
    tail -n 5 "$run"/*.log >&2 || true
    fail "Slurm is installed, but its daemons do not start"
fi

# Waits until no job is left. Tasks that are tried again would wait two minutes; but within the second in which they were
# ended nodes refuse them.
wait_for_jobs() {
    for _ in $(seq "$1"); do
        jobs=$(squeue -h -r -o '%i %r %S') || jobs=unknown
        [ -z "$jobs" ] && return
        while read -r job reason start; do
            [ "$reason" = BeginTime ] && [ "$start" != N/A ] && [ $(($(date -d "$start" +%s) - $(date +%s))) -gt 10 ] &&
                scontrol update JobId="$job" StartTime=now+3 2>/dev/null
        done <<<"$jobs"
        sleep 1
    done
    squeue -r >&2
    fail "jobs do not end"
}

# wait_until SECONDS COMMAND...
wait_until() {
    local end=$((SECONDS + $1))
    shift
    until "$@"; do
        [ "$SECONDS" -lt "$end" ] || fail "not within its time: $*"
        sleep 0.02
    done
}

# Of a folder with what submit has printed.
collecting_job() { sed -n 's/.*, then \([0-9]*\)$/\1/p' "$1/jobs.txt"; }
says_collecting_job() {
    scontrol -o show job "$(collecting_job "$1")" | grep -q "JobState=$2" || fail "$1: the last job is not $2"
    grep -qx "$3" "$1"/burin-logs/collect_"$(collecting_job "$1")".txt || fail "$1: the last job does not say '$3'"
}
# starts FOLDER TASK NUMBERS: how often a task was begun.
starts() {
    local seen
    seen=$(sed -n "s/^task $2: .*, start \([0-9]*\)$/\1/p" "$1"/burin-logs/*_"$2".txt | xargs)
    [ "$seen" = "$3" ] || fail "$1: task $2 was begun as '$seen', not '$3'"
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
# same FOLDER WHOLE: has the files of an undisturbed run, and no others.
same() {
    for frame in $(seq -w 1 20); do
        cmp "$2/out.00$frame.exr" "$1/out.00$frame.exr" || fail "$1: frame $frame"
    done
    [ -z "$(find "$1" -name '.*burin-*')" ] || fail "$1: temporary files are left"
}

# All frames, in chunks.
mkdir farm
submit -o farm/out.####.exr --chunk 4 >jobs.txt || fail "submit"
wait_for_jobs 120
same farm alone
grep -h "all frames are there" farm/burin-logs/collect_*.txt >/dev/null || fail "the last job says nothing"

# What is there is not rendered again, and what is missing is.
rm farm/out.0007.exr farm/out.0012.exr
submit -o farm/out.####.exr --chunk 4 --dry-run >again.txt
grep -q "frames='\?7,12'\? ;;" again.txt || fail "the missing frames are not all that is submitted: $(grep frames= again.txt)"
submit -o farm/out.####.exr --chunk 4 >/dev/null
wait_for_jobs 120
same farm alone

# A node dies at work. The array alone does the rest, on the other node or when it is back: nothing is submitted again,
# and frames that are there are not drawn again.
mkdir large
render_large() { "$burin" render shot.toml -r 2560x1600 -f 1-20 -q --skip-existing -j 1 "$@"; }
render_large -o large/out.####.exr
# kill_node NAME: as if its power were cut.
kill_node() {
    local pids=("$(cat "$run/pid/slurmd-$1.pid")") pid
    for pid in $(processes_of_jobs); do
        grep -qzx "SLURMD_NODENAME=$1" "/proc/$pid/environ" 2>/dev/null || continue
        # What watches over a task is the parent of its script.
        grep -q slurmstepd "/proc/$(parent_of "$pid")/comm" 2>/dev/null && pids+=("$(parent_of "$pid")")
        pids+=("$pid")
    done
    kill -9 "${pids[@]}" 2>/dev/null || true
}
node_is() { sinfo -h -N -n "$1" -o %t | grep -q "^$2"; }
# kill_at_work FOLDER: submits a job, and kills the node of one task once two of its frames are there. Sets task.
kill_at_work() {
    mkdir "$1"
    "$burin" submit shot.toml -r 2560x1600 -f 1-20 -o "$1/out.####.exr" --chunk 10 -j 1 >"$1/jobs.txt"
    wait_until 60 eval '[ -n "$(squeue -h -r -t R -w n1 -o %K)" ]'
    task=$(squeue -h -r -t R -w n1 -o %K)
    local first=$((task * 10 + 1))
    wait_until 60 [ -f "$(printf '%s/out.%04d.exr' "$1" $((first + 1)))" ]
    kill_node n1
    done_of_task=0
    for frame in $(seq "$first" $((first + 9))); do
        [ ! -f "$(printf '%s/out.%04d.exr' "$1" "$frame")" ] || done_of_task=$((done_of_task + 1))
    done
}
for try in 1 2 3; do # on a slow machine the task may have ended before it is killed
    kill_at_work "killed$try"
    [ "$done_of_task" -lt 10 ] && break
    slurmd -N n1 -f "$SLURM_CONF"
    wait_for_jobs 200
done
[ "$done_of_task" -lt 10 ] || fail "no node was killed at work"
stat -c '%n %i %y' killed$try/*.exr >there.txt
wait_until 60 node_is n1 down
slurmd -N n1 -f "$SLURM_CONF"
wait_until 60 node_is n1 '\(idle\|alloc\|mix\)'
wait_for_jobs 200
same killed$try large
while read -r name inode time; do
    [ "$(stat -c '%n %i %y' "$name")" = "$name $inode $time" ] || fail "$name was there, and was drawn again"
done <there.txt
[ "$(wc -l <there.txt)" -ge 2 ] || fail "no frame was there when the node was killed"
grep -q "^task $task: .*, start 2$" killed$try/burin-logs/*_"$task".txt || fail "the task was not begun anew"
says_collecting_job killed$try COMPLETED "all frames are there"

# A task that fails once is tried again, alone.
mkdir -p once/out.0014.exr # what stands in the way of a frame
submit -o once/out.####.exr --chunk 10 >once/jobs.txt
has_failed() { grep -qs "out.0014.exr: is a folder" once/burin-logs/*_1.txt; }
wait_until 60 has_failed
rmdir once/out.0014.exr
wait_for_jobs 200
same once alone
starts once 1 "1 2"
starts once 0 "1"
says_collecting_job once COMPLETED "all frames are there"

# Tasks that fail always are given up. What is missing is named, with the command that renders it.
mkdir -p always/out.{0007,0012,0013,0014}.exr
submit -o always/out.####.exr --chunk 10 --keep-going >always/jobs.txt
wait_for_jobs 200
starts always 0 "1 2"
starts always 1 "1 2"
says_collecting_job always FAILED "missing: 7,12-14"
scontrol -o show job "$(collecting_job always)" | grep -q 'ExitCode=1:0' || fail "the last job does not end with 1"
rmdir always/out.{0007,0012,0013,0014}.exr
command=$(sed -n 's/^render them: //p' always/burin-logs/collect_*.txt)
[ -n "$command" ] || fail "the command for missing frames is not named"
rm always/burin-logs/collect_*.txt
eval "$command" >always/jobs.txt || fail "the command for missing frames fails: $command"
wait_for_jobs 200
same always alone
says_collecting_job always COMPLETED "all frames are there"

# Bands of frames are joined to the files of the whole.
mkdir bands
submit -o bands/out.####.exr --chunk 10 --bands 3 >/dev/null
wait_for_jobs 200
same bands alone
[ "$(find bands -name '*.exr' | wc -l)" -eq 20 ] || fail "bands are left"

# A frame that cannot be rendered is named, with the command that renders it.
mkdir broken
rm part.obj
! submit -o broken/out.####.exr --chunk 20 >broken.txt 2>&1 || fail "a missing model is not noticed before"
grep -q "part.obj" broken.txt || fail "the missing model is not named"
echo "slurm_test: done"
