#!/usr/bin/env bash
# build.sh FOLDER TARGET [CMAKE-OPTION…]: configures where it was not and builds one target; shows the
# compiler's output only when it fails.
set -euo pipefail
cd "$(dirname "$0")/.."
[ $# -ge 2 ] || exec scripts/usage.sh "$0" "$@"
folder=$1 target=$2
shift 2
log=$folder/build.log
mkdir -p "$folder"
if [ ! -f "$folder/build.ninja" ]; then
  cmake -S . -B "$folder" -G Ninja "$@" >"$log" 2>&1 || { cat "$log" >&2; exit 1; }
  echo "building in $folder/ (the first time takes minutes)"
fi
cmake --build "$folder" --target "$target" >"$log" 2>&1 || { tail -n 60 "$log" >&2; exit 1; }
