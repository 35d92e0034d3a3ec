#!/usr/bin/env bash
# test_pages.sh [FOLDER]: makes a report of a small sweep and one of 10,000 runs, and tests the pages in
# headless Chromium. Screenshots stay in FOLDER, if it is given. Installs what is missing of Chromium,
# Node and playwright-core; NODE_PATH may tell where the latter is.
set -euo pipefail
cd "$(dirname "$0")/.."
case "${1:-}" in -*) exec scripts/usage.sh "$0" "$@" ;; esac
missing=()
for package in chromium nodejs npm python3; do
  command -v "${package/nodejs/node}" >/dev/null || missing+=("$package")
done
if [ ${#missing[@]} -gt 0 ]; then
  as_root=()
  if [ "$(id -u)" -ne 0 ]; then as_root=(sudo); fi
  "${as_root[@]}" apt-get -q update
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get -q -y --no-install-recommends install "${missing[@]}"
fi
program=${PHONGPIPE:-$PWD/build/bin/phongpipe}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
trap 'echo "test_pages.sh: the command in line $LINENO failed" >&2' ERR
shots=${1:-$work}
mkdir -p "$shots"
export NODE_PATH=${NODE_PATH:-$work/node_modules}
node -e 'require("playwright-core")' 2>/dev/null ||
  npm install --prefix "$work" --no-audit --no-fund --loglevel error playwright-core >/dev/null

"$program" sweep sphere --set scene.image.width=96 --set scene.image.height=96 \
  --set 'scene.object.0.segments=[12,8]' --vary rom_address_bits=5:9 \
  --vary diffuse_fraction_bits=4,8,16 --rtl off --db "$work/sweep.db" >/dev/null
"$program" report "$work/sweep.db" -o "$work/sweep.html" >/dev/null
python3 testbench/tests/reports/many_runs.py "$work/sweep.db" "$work/many.db"
"$program" report "$work/many.db" -o "$work/many.html" >/dev/null
cp "$work/sweep.db" "$work/crashed.db"
python3 testbench/tests/reports/crashed_runs.py "$work/crashed.db"
"$program" report "$work/crashed.db" -o "$work/crashed.html" >/dev/null
# A scene with a hostile name, and a folder for the / in it.
mkdir "$work/<"
cp testbench/scenes/sphere.toml "$work/</script><b>x.toml"
(cd "$work" && "$program" sweep '</script><b>x.toml' --vary rom_address_bits=8,9 --vary budget=1,100 \
  --rtl off --db failed.db >/dev/null) || [ $? -eq 1 ]
(cd "$work" && "$program" report failed.db -o failed.html >/dev/null)
small=(--set scene.image.width=96 --set scene.image.height=96)
"$program" compare sphere "${small[@]}" --out "$work" >/dev/null
"$program" verify sphere torus "${small[@]}" --budget 1000 --out "$work" >/dev/null

node testbench/tests/reports/page_test.cjs \
  "$work/sweep.html" "$work/many.html" "$work/failed.html" "$work/crashed.html" \
  "$work/sphere-methods.html" "$work/verify.html" "$shots"

# The hardware that the page saves is the hardware of the run's command.
"$program" verify sphere --hardware "$shots/run.toml" --set scene.image.width=96 \
  --set scene.image.height=96 --set 'scene.object.0.segments=[12,8]' --json "$work/toml.json" >/dev/null
eval "$(sed "s|^phongpipe|'$program'|" "$shots/run.command") --json '$work/command.json'" >/dev/null
hash_of() { grep -o '"configuration_hash": "[0-9a-f]*"' "$1"; }
[ "$(hash_of "$work/toml.json")" = "$(hash_of "$work/command.json")" ] || {
  echo "test_pages.sh: the saved hardware is not that of the command" >&2
  exit 1
}
echo "the saved hardware is that of the command"
