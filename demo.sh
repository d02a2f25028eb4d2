#!/usr/bin/env bash
# Installs what is missing, builds Release, runs the default scene into out/demo and says where the report is.
set -euo pipefail
cd "$(dirname "$0")"
./setup.sh
cmake --preset release -Wno-dev
cmake --build --preset release --target diurna
build/release/diurna run scenes/jacksboro/scene.toml --out out/demo --resume
echo "report: $PWD/out/demo/report.html"
