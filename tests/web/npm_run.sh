#!/usr/bin/env bash
# Run one npm script of a package. usage: npm_run.sh DIR SCRIPT
set -euo pipefail
[ -d "$1/node_modules" ] || { echo "the packages of $1 are not installed: ./lapwing test does it"; exit 77; }
[ "$2" != e2e ] || command -v chromium >/dev/null || { echo "chromium is not installed"; exit 77; }
exec npm --prefix "$1" run --silent "$2"
