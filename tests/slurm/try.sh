#!/usr/bin/env bash
# Shares out a run and a sweep by `diurna slurm` on a real Slurm of two nodes, ends a task in its middle and has it queued again,
# and compares what comes of it with one process's, byte by byte. Needs root and setup.sh --slurm.
set -euo pipefail
cd "$(dirname "$0")/../.."
here=$PWD
program=$here/build/release/diurna
work=$(mktemp -d)
finish() {
    "$here/tests/slurm/cluster.sh" stop "$work/cluster"
    rm -rf "$work"
}
trap finish EXIT
"$here/tests/slurm/cluster.sh" start "$work/cluster"
export SLURM_CONF=$work/cluster/slurm.conf DIURNA_STAGES=off

cp -r scenes/jacksboro "$work/it's a scene"
cd "$work/it's a scene"
few=(--set time.step_s=3600 --set terrain.tolerance_m=5 --set time.frame_every_s=3600)

wait_for() { # the job's end, which must be a good one
    local state
    for _ in $(seq 600); do
        state=$(scontrol show job "$1" | grep -o "JobState=[A-Z_]*" | sort -u | paste -sd' ')
        case $state in
        JobState=COMPLETED) return ;;
        *FAILED* | *CANCELLED* | *TIMEOUT* | *OUT_OF_MEMORY* | *NODE_FAIL*) break ;;
        esac
        sleep 0.5
    done
    echo "try.sh: job $1 ended as $state" >&2
    tail -n 5 "$2"/*.log >&2
    exit 1
}

same() { # except for what describes the run itself
    diff -rq -x report.html -x manifest.json -x ledger.jsonl "$1" "$2"
    "$program" verify "$2"
}

"$program" run scene.toml "${few[@]}" --out "$work/whole" >/dev/null 2>&1
"$program" slurm scene.toml "${few[@]}" --out "$work/out" --scripts "$work/jobs" --shards 3 --cpus 1
last=$("$work/jobs/submit.sh")
for _ in $(seq 300); do # until a task has left its first pictures
    ls "$work"/jobs/part-[12]/frames/*.exr >/dev/null 2>&1 && break
    sleep 0.2
done
scontrol requeue "$((last - 1))_2"
wait_for "$last" "$work/jobs"
grep -q REQUEUE "$work/jobs/shard-2.log"
same "$work/whole" "$work/out"

cat >>scene.toml <<'SWEEP'
[[sweep.axis]]
key = "terrain.material"
values = ["grass", "sand"]
[[sweep.axis]]
key = "scene.seed"
values = [1, 2]
SWEEP
few+=(--set time.frame_every_s=43200)
"$program" run scene.toml "${few[@]}" --out "$work/swept" >/dev/null 2>&1
"$program" slurm scene.toml "${few[@]}" --out "$work/shared" --scripts "$work/sweep jobs" --shards 2 --cpus 1
wait_for "$("$work/sweep jobs/submit.sh")" "$work/sweep jobs"
diff -rq "$work/swept" "$work/shared"
echo "shared out by Slurm: the bytes of one process"
