#!/usr/bin/env bash
# Draws the pictures of the guide anew: docs/pictures/make.sh [PROGRAM]
set -euo pipefail
cd "$(dirname "$0")/../.."
program=${1:-build/release/bin/lapwing}

# plan NAME SCRIPT [OPTION...]: exit codes 1 and 3 are about the flight, not about the picture.
plan() {
  local name=$1
  shift
  "$program" plan "$@" --svg "docs/pictures/plan-$name.svg" >/dev/null || (($? != 2))
}

plan survey examples/survey.dolphin
plan fence examples/survey.dolphin --fence examples/car-park.geojson
plan listing2 examples/listing2.dolphin --timeout 1500
