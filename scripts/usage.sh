#!/usr/bin/env bash
# usage.sh SCRIPT [--help|…]: prints the comment at the top of a script, for arguments that it does not take.
# Fails, but for --help.
set -euo pipefail
cd "$(dirname "$0")"
text() { sed -n '2,/^[^#]/s/^# \?//p' "$(basename "$1")"; }
if [ "${2:-}" = --help ] || [ "${2:-}" = -h ]; then
  text "$1"
else
  text "$1" >&2
  exit 2
fi
