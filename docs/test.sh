#!/usr/bin/env bash
# Runs what the pages tell readers to type, and compares what they quote: docs/test.sh [PAGE.md...], all pages if none is given.
set -euo pipefail
cd "$(dirname "$0")/.."
exec python3 docs/tools/try_pages.py "$@"
