#!/usr/bin/env bash
# Opens a trace with its view in GTKWave, on a screen that nobody sees: a fixed-point word must be
# shown with its binary point, and as the value that the trace holds.
set -euo pipefail
cd "$(dirname "$0")/.."
[ $# -eq 0 ] || exec scripts/usage.sh "$0" "$@"
trap 'echo "test_waves.sh: the command in line $LINENO failed" >&2' ERR
missing=()
for package in gtkwave xvfb xauth; do
  dpkg-query -W -f '${Status}' "$package" 2>/dev/null | grep -q 'ok installed' || missing+=("$package")
done
if [ ${#missing[@]} -gt 0 ]; then
  as_root=()
  [ "$(id -u)" -eq 0 ] || as_root=(sudo)
  { "${as_root[@]}" apt-get -q update &&
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
      apt-get -q -y --no-install-recommends install "${missing[@]}"; } >/dev/null
fi
program=$PWD/build/bin/phongpipe
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
"$program" trace sphere --worst -o t.fst >report
"$program" trace sphere --worst -o t.vcd >/dev/null
"$program" trace sphere --worst -o t.fst >/dev/null  # its view, not that of the VCD
"$program" verify sphere --json result.json >/dev/null
cycle=$(sed -n 's/.*enters .* in cycle //p' report)
name='phongpipe.rtl.pixel_datapath.channel[0].diffuse.diffuse_series.s4_v[9:-16]'
python3 - "$cycle" >expected <<'PYTHON'
# "time value": in the middle of the cycle, of the register as the VCD has it.
import json, re, sys
cycle = int(sys.argv[1])
code, value, time, shown = None, None, 0, None
period = round(1000 * json.load(open("result.json"))["clock_ns"])  # ps
scopes = []
for line in open("t.vcd"):
    words = line.split()
    if words[0] == "$scope": scopes.append(words[2])
    elif words[0] == "$upscope": scopes.pop()
    elif words[0] == "$var" and words[4] == "s4_v" and scopes[1:] == ["rtl", "pixel_datapath", "channel[0]", "diffuse", "diffuse_series"]:
        code = words[3]
    elif line[0] == "#": time = int(line[1:])
    elif line[0] == "b" and words[1] == code and time <= cycle * period: shown = words[0][1:]
word = int(shown, 2)
if shown[0] == "1": word -= 1 << len(shown)
print(cycle * period + period // 4, word / 65536)
PYTHON
read -r time value <expected
cat >look.tcl <<TCL
gtkwave::setMarker $time
set out [open shown w]
puts \$out [gtkwave::getTraceValueAtMarkerFromName {$name}]
close \$out
gtkwave::/File/Quit
exit
TCL
timeout 60 xvfb-run -a gtkwave t.fst t.gtkw -S look.tcl >gtkwave.log 2>&1 || { cat gtkwave.log >&2; exit 1; }
python3 -c "
shown, value = open('shown').read().strip(), $value
assert '.' in shown, 'no binary point in ' + shown
assert float(shown) == value, f'{shown} is not {value}'
print('GTKWave shows', shown)"
