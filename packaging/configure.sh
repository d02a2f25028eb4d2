#!/usr/bin/env bash
# Configures build/release for those who use the program rather than change it, and prints how many compilers fit into the memory.
set -euo pipefail
cd "$(dirname "$0")/.."
cmake --preset release -Wno-dev >/dev/null
cores=$(nproc)
gigabytes=$(awk '/MemTotal/ {print int($2 / 1e6)}' /proc/meminfo)
jobs=$((gigabytes / 2 < cores ? gigabytes / 2 : cores))
echo $((jobs > 1 ? jobs : 1))
