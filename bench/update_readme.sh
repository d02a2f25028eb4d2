#!/usr/bin/env bash
# Puts the table that validation_bench prints between the two marks in the README.
set -euo pipefail
cd "$(dirname "$0")/.."
cmake --build --preset release --target validation_bench >&2
table=$(mktemp)
trap 'rm -f "$table"' EXIT
build/release/validation_bench >"$table"
sed -i -e "/<!-- validation -->/,/<!-- end -->/{/<!-- validation -->/r $table" -e '/<!-- validation -->\|<!-- end -->/!d}' README.md
