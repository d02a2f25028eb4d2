#!/usr/bin/env bash
# Puts the tables that validation_bench, atmosphere_bench and methods_table.py print between their marks in README.md and
# docs/validation.md.
set -euo pipefail
cd "$(dirname "$0")/.."
cmake --build --preset release --target validation_bench atmosphere_bench >&2
table=$(mktemp)
trap 'rm -f "$table"' EXIT

# fill MARK: lines after <!-- MARK --> up to the next <!-- end --> become the table, on each page that has the mark.
fill() {
    sed -i -e "/<!-- $1 -->/,/<!-- end -->/{/<!-- $1 -->/r $table" \
        -e "/<!-- $1 -->\|<!-- end -->/!d}" README.md docs/validation.md
}
build/release/validation_bench >"$table"
fill validation
if build/release/atmosphere_bench accuracy >"$table"; then fill accuracy; fi
bench/methods_table.py >"$table"
fill methods
