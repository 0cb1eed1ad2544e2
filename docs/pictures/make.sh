#!/usr/bin/env bash
# Draws the pictures of the guides anew: docs/pictures/make.sh [PROGRAM]
set -euo pipefail
cd "$(dirname "$0")/../.."
program=$(realpath "${1:-build/release/bin/lapwing}")
pictures=$PWD/docs/pictures

# plan NAME SCRIPT [OPTION...]: exit codes 1 and 3 are about the flight, not about the picture.
plan() {
  local name=$1
  shift
  "$program" plan "$@" --svg "$pictures/plan-$name.svg" >/dev/null || (($? != 2))
}

# from_guide NAME PAGE [OPTION...]: the script of the block of that page that says picture=NAME.
from_guide() {
  local name=$1 page=$2 folder
  shift 2
  folder=$(mktemp -d)
  python3 tests/support/documents.py "$page" "$name" >"$folder/my.dolphin"
  (cd "$folder" && plan "$name" my.dolphin "$@")
  rm -r "$folder"
}

plan survey examples/survey.dolphin
plan fence examples/survey.dolphin --fence examples/car-park.geojson
plan listing2 examples/listing2.dolphin --timeout 1500
plan relay examples/relay.dolphin
for name in mission survey-area until signals; do
  from_guide "$name" docs/guide/language.md
done
