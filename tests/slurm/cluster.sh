#!/usr/bin/env bash
# A Slurm of two nodes on this machine, for tests: cluster.sh start FOLDER, cluster.sh stop FOLDER. Needs root. Between them
# SLURM_CONF=FOLDER/slurm.conf leads sbatch and the others there.
set -euo pipefail
folder=$(realpath -m "$2")

pids() { cat "$folder"/*.pid 2>/dev/null || true; }

stop() {
    for pid in $(pids); do kill "$pid" 2>/dev/null || true; done
    for _ in $(seq 50); do
        for pid in $(pids); do kill -0 "$pid" 2>/dev/null && sleep 0.1; done
    done
    for pid in $(pids); do kill -KILL "$pid" 2>/dev/null || true; done
}

start() {
    mkdir -p "$folder"/{state,spool-n1,spool-n2}
    dd if=/dev/urandom of="$folder/munge.key" bs=1024 count=1 status=none
    chmod 400 "$folder/munge.key"
    munged --force --key-file="$folder/munge.key" --socket="$folder/munge.socket" --pid-file="$folder/munged.pid" \
        --log-file="$folder/munged.log" --seed-file="$folder/munged.seed"
    local host memory
    host=$(hostname -s)
    memory=$(awk '/MemTotal/ { print int($2 / 1024 / 2) }' /proc/meminfo)
    cat >"$folder/slurm.conf" <<CONF
ClusterName=try
SlurmctldHost=$host
SlurmctldPort=16817
SlurmUser=root
AuthInfo=socket=$folder/munge.socket
MpiDefault=none
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SwitchType=switch/none
ReturnToService=2
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU_Memory
JobAcctGatherType=jobacct_gather/none
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/slurmd-%n.pid
SlurmdSpoolDir=$folder/spool-%n
StateSaveLocation=$folder/state
SlurmctldLogFile=$folder/slurmctld.log
SlurmdLogFile=$folder/slurmd-%n.log
NodeName=n1 NodeHostname=$host Port=17001 CPUs=1 RealMemory=$memory
NodeName=n2 NodeHostname=$host Port=17002 CPUs=1 RealMemory=$memory
PartitionName=all Nodes=ALL Default=YES State=UP
CONF
    export SLURM_CONF="$folder/slurm.conf"
    slurmctld -c
    slurmd -N n1
    slurmd -N n2
    for _ in $(seq 100); do
        [ "$(sinfo -h -t idle -o %D 2>/dev/null)" = 2 ] && return
        sleep 0.2
    done
    echo "cluster.sh: the nodes do not come up: $folder/slurm*.log" >&2
    stop
    exit 1
}

"$1"
