#!/usr/bin/env bash
# Measures what the README says about speed, as ratios within one run, on an otherwise idle machine.
# Benchmarks take turns, seven each, and medians are compared, for machines are never quite idle.
set -euo pipefail
cd "$(dirname "$0")/.."
[ $# -eq 0 ] || exec scripts/usage.sh "$0" "$@"
scripts/install.sh
scripts/build.sh build all -DCMAKE_BUILD_TYPE=Release
csv=$(mktemp -d)
trap 'rm -rf "$csv"' EXIT
for name in model rtl systemc; do
  build/bin/${name}_bench --benchmark_format=csv --benchmark_repetitions=7 --benchmark_min_time=0.1 \
    --benchmark_enable_random_interleaving=true --benchmark_report_aggregates_only=true \
    >"$csv/$name" 2>/dev/null
done
# name, iterations, real time (ms), …, items per second in column 7
value() { awk -F, -v name="\"$2_median\"" -v column="$3" '$1 == name { printf "%.6g", $column }' "$csv/$1"; }
ratio() { awk -v a="$1" -v b="$2" 'BEGIN { printf "%.2f", a / b }'; }
rate() { value "$1" "$2" 7; }

echo "model, AVX2 or better, over Phong in double: 64-pixel spans $(ratio "$(rate model model/best/64)" "$(rate model phong_in_double/64)"), the pawn's spans $(ratio "$(rate model model/best/0)" "$(rate model phong_in_double/0)")"
echo "model, portable, over Phong in double:       64-pixel spans $(ratio "$(rate model model/portable/64)" "$(rate model phong_in_double/64)"), the pawn's spans $(ratio "$(rate model model/portable/0)" "$(rate model phong_in_double/0)")"
echo "RTL compared with the model over bare RTL:   $(ratio "$(rate rtl compared/real_time)" "$(rate rtl bare)") ($(rate rtl bare) pixels/s bare)"
bare_ms=$(awk -v rate="$(rate rtl bare)" 'BEGIN { print 1281288 / rate * 1000 }')  # for the pawn's pixels
echo "SystemC by span over bare RTL, pawn frame:   $(ratio "$(value systemc by_span/manual_time 3)" "$bare_ms")"
echo "SystemC by clock over by span, pawn frame:   $(ratio "$(value systemc by_clock/manual_time 3)" "$(value systemc by_span/manual_time 3)") ($(value systemc by_span/manual_time 3) ms by span)"
for detail in span cycle; do
  echo "SystemC of a matt pawn by $detail: everything over the effects it needs $(ratio "$(value systemc "matt/all/$detail/manual_time" 3)" "$(value systemc "matt/derived/$detail/manual_time" 3)")"
done
echo "image size, pixels/s of the model's frame and of SystemC by span:"
for size in 256 512 1024 2048 4096; do
  echo "  $size²  $(rate systemc "model_at_size/$size")  $(rate systemc "by_span_at_size/$size/manual_time")"
done
pictures=$csv/pictures
for _ in 1 2 3 4 5 6 7; do
  TIMEFORMAT=%R
  { time build/bin/phongpipe verify pawn --out "$pictures" >/dev/null; } 2>>"$csv/verify"
done
seconds=$(sort -n "$csv/verify" | sed -n 4p)
echo "verify pawn at 2048², start to end with pictures: $seconds s, $(ratio "$seconds" "$(awk -v ms="$bare_ms" 'BEGIN { print ms / 1000 }')") times the bare RTL loop"
