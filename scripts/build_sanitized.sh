#!/usr/bin/env bash
# build_sanitized.sh TARGET…: builds with clang, its sanitizers and what libFuzzer needs, in
# build-sanitized/.
set -euo pipefail
cd "$(dirname "$0")/.."
for target in "$@"; do
  scripts/build.sh build-sanitized "$target" -DCMAKE_BUILD_TYPE=None -DCMAKE_CXX_FLAGS="-O1 -g1" \
    -DCMAKE_C_COMPILER=clang -DCMAKE_CXX_COMPILER=clang++ -DPHONGPIPE_SANITIZE=ON \
    -DPHONGPIPE_FUZZ=ON -DPHONGPIPE_BENCHMARKS=OFF
done
