#!/usr/bin/env bash
# Every C++ source is formatted as .clang-format says. usage: check_format.sh REPO
set -euo pipefail
cd "$1"
command -v clang-format-19 >/dev/null || { echo "clang-format-19 is not installed"; exit 77; }
git ls-files '*.cpp' '*.hpp' | xargs -r clang-format-19 --dry-run --Werror
