#!/usr/bin/env bash
# Builds the documentation into one static site: docs/build.sh [OUT, out/docs if not given]. Needs ./setup.sh --docs and the program.
set -euo pipefail
cd "$(dirname "$0")/.."
out=$(realpath -m "${1:-out/docs}")
stage=$(mktemp -d)
trap 'rm -rf "$stage"' EXIT
python3 docs/tools/gather.py "$stage"
mkdocs build --strict --quiet --config-file "$stage/mkdocs.yml" --site-dir "$out"
python3 docs/tools/check_site.py "$out"
echo "documentation: $out/index.html"
