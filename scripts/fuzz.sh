#!/usr/bin/env bash
# fuzz.sh SECONDS [TARGET…]: fuzzes what reads files, each target of testbench/fuzz/ for SECONDS, two at
# a time, under the address and undefined-behaviour sanitizers. Ends with a table: executions, edges
# covered, findings. Inputs that were worth keeping are added to build-fuzz/corpus/TARGET.
set -euo pipefail
cd "$(dirname "$0")/.."
case "${1:-}" in "" | *[!0-9]*) exec scripts/usage.sh "$0" "$@" ;; esac
seconds=$1
shift
scripts/install.sh fuzz
folder=build-fuzz
scripts/build.sh "$folder" fuzz_targets -DCMAKE_BUILD_TYPE=None -DCMAKE_CXX_FLAGS="-O1 -g1" \
  -DCMAKE_C_COMPILER=clang -DCMAKE_CXX_COMPILER=clang++ -DPHONGPIPE_SANITIZE=ON \
  -DPHONGPIPE_FUZZ=ON -DPHONGPIPE_TESTS=OFF -DPHONGPIPE_BENCHMARKS=OFF
targets=("$@")
if [ ${#targets[@]} -eq 0 ]; then
  for source in testbench/fuzz/*_fuzz.cpp; do targets+=("$(basename "$source" _fuzz.cpp)"); done
fi

declare -A shipped=([scene]=testbench/scenes [hardware]=hw/presets [technology]=hw/technology
                    [plan]=testbench/sweeps)
declare -A dictionary=([scene]=toml [hardware]=toml [technology]=toml [plan]=toml [capsule]=toml)
mkdir -p "$folder/findings"
if [ -w /dev/shm ]; then export TMPDIR=/dev/shm; fi  # some targets write each input to a file

fuzz() {
  local target=$1 corpora=("$folder/corpus/$1")
  mkdir -p "${corpora[0]}"
  for seeds in "testbench/fuzz/corpus/$target" ${2:+"$2"}; do
    if [ -d "$seeds" ]; then corpora+=("$seeds"); fi
  done
  local words=testbench/fuzz/dictionaries/$3.dict options=()
  if [ -f "$words" ]; then options+=("-dict=$words"); fi
  "$folder/bin/${target}_fuzz" "${corpora[@]}" "${options[@]}" -max_total_time="$seconds" \
    -timeout=30 -rss_limit_mb=1024 -max_len=65536 -artifact_prefix="$folder/findings/$target-" \
    -print_final_stats=1 >"$folder/findings/$target.log" 2>&1
}
failed=0
running=()
for target in "${targets[@]}"; do
  fuzz "$target" "${shipped[$target]:-}" "${dictionary[$target]:-$target}" &
  running+=($!)
  if [ ${#running[@]} -eq "$(nproc)" ]; then
    wait "${running[0]}" || failed=1
    running=("${running[@]:1}")
  fi
done
for process in "${running[@]}"; do wait "$process" || failed=1; done

printf '%-12s %12s %8s %9s\n' target executions edges findings
for target in "${targets[@]}"; do
  log=$folder/findings/$target.log
  printf '%-12s %12s %8s %9s\n' "$target" \
    "$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")" \
    "$(grep -o 'cov: [0-9]*' "$log" | tail -n 1 | cut -d' ' -f2)" \
    "$(find "$folder/findings" -name "$target-*" | wc -l)"
done
if [ $failed -ne 0 ]; then
  echo "fuzz.sh: a finding, or a target that did not start; see $folder/findings/" >&2
  exit 1
fi
