#!/usr/bin/env bash
# Installs what is missing, builds the program and its tests, and runs them all.
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/install.sh
scripts/build.sh build all_tests -DCMAKE_BUILD_TYPE=Release
ctest --test-dir build --output-on-failure --progress -j "$(nproc)" "$@"
