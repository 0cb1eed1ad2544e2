#!/usr/bin/env bash
# Run one npm script of the browser app. usage: npm_run.sh WEB_DIR SCRIPT
set -euo pipefail
[ -d "$1/node_modules" ] || { echo "the browser app's packages are not installed: ./lapwing build installs them"; exit 77; }
[ "$2" != e2e ] || command -v chromium >/dev/null || { echo "chromium is not installed"; exit 77; }
exec npm --prefix "$1" run --silent "$2"
