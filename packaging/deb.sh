#!/usr/bin/env bash
# Builds the Debian packages of the program and of its libraries, and prints how to install them. Needs root once, for packages
# that are missing (./setup.sh --packages). A first build takes about 10 minutes on two processors.
set -euo pipefail
cd "$(dirname "$0")/.."
./setup.sh --packages
jobs=$(packaging/configure.sh)
cmake --build --preset release --parallel "$jobs" --target diurna pages
(cd build/release && cpack >/dev/null)
packages=(build/release/packages/diurna_*.deb)
printf '%s\n' build/release/packages/*.deb
echo "install the program: sudo apt-get install ./${packages[-1]}"
