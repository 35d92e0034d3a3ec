#!/usr/bin/env bash
# Installs what is missing, builds, verifies the teapot and the pawn, and leaves pictures and results in
# out/. Exits with the status of `phongpipe verify`.
set -euo pipefail
cd "$(dirname "$0")/.."
[ $# -eq 0 ] || exec scripts/usage.sh "$0" "$@"
scripts/install.sh
scripts/build.sh build program -DCMAKE_BUILD_TYPE=Release
mkdir -p out
status=0
build/bin/phongpipe verify teapot pawn --out out --json out/verify.json || status=$?
echo "Look at out/: verify.html, teapot-result.png, teapot-error.png, pawn-result.png, pawn-error.png, verify.json"
exit $status
