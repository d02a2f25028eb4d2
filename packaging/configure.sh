#!/usr/bin/env bash
# Configures build/release for those who use the program rather than change it, and prints how many compilers fit into the memory.
# On up to 4 processors a first build has large batches of sources: a third less processor time, up to 4 GB for each compiler. A build
# folder that exists keeps its settings.
set -euo pipefail
cd "$(dirname "$0")/.."
cores=$(nproc)
gigabytes=$(awk '/MemTotal/ {print int($2 / 1e6)}' /proc/meminfo)
batch=()
if [ ! -d build/release ] && [ "$cores" -le 4 ] && [ "$gigabytes" -ge 11 ]; then
    batch=(-DDIURNA_BATCH=120)
fi
cmake --preset release -Wno-dev "${batch[@]}" >/dev/null
jobs=$((gigabytes / 4 < cores ? gigabytes / 4 : cores))
echo $((jobs > 1 ? jobs : 1))
