#!/usr/bin/env bash
# synthesize.sh: places and routes the RTL in many configurations and writes the cards of the iCE40
# devices in hw/technology (an hour). synthesize.sh units: only the units of hw/units, the rest of
# the cards stays (three minutes). synthesize.sh check: places and routes two presets and
# fails where one is slower or larger than its card says.
set -euo pipefail
cd "$(dirname "$0")/.."
case "${1:-}" in "" | units | check) ;; *) exec scripts/usage.sh "$0" "$@" ;; esac
scripts/install.sh synthesis
scripts/build.sh build synthesize_cards
if [ "${1:-}" = check ]; then
  build/bin/synthesize_cards --check
  # What a user measures is what the card says.
  scripts/build.sh build phongpipe
  luts() { build/bin/phongpipe verify sphere --hardware paper-8k --json - "$@" | grep -o '"luts": [0-9]*' | head -n 1; }
  measured=$(luts --synthesize)
  if [ "$measured" != "$(luts)" ]; then
    echo "synthesize.sh: verify --synthesize measures $measured, the card says $(luts)" >&2
    exit 1
  fi
elif [ "${1:-}" = units ]; then
  build/bin/synthesize_cards --units hw/technology
else
  build/bin/synthesize_cards hw/technology
fi
