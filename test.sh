#!/usr/bin/env bash
# Installs what is missing, builds Release, runs every test. Arguments go to ctest (./test.sh -R planck).
set -euo pipefail
cd "$(dirname "$0")"
./setup.sh --tests
cmake --preset release -Wno-dev
cmake --build --preset release
ctest --preset release "$@"
