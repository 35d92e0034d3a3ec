#!/usr/bin/env bash
# Installs what is missing, builds everything and runs all tests.
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/install.sh
scripts/build.sh build all -DCMAKE_BUILD_TYPE=Release
ctest --test-dir build --output-on-failure --progress -j "$(nproc)" "$@"
