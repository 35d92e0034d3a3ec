#!/usr/bin/env bash
# generate.sh [BUILD-FOLDER]: writes the files that are generated from the model's sources: hw/constants.svh.
set -euo pipefail
cd "$(dirname "$0")/.."
build=${1:-build}
[ -d "$build" ] || exec scripts/usage.sh "$0" "$@"
cmake --build "$build" --target generate_constants >/dev/null
"$build/bin/generate_constants" > hw/constants.svh
