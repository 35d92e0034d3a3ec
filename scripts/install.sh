#!/usr/bin/env bash
# install.sh [ci|fuzz|synthesis]: installs the Debian packages that are missing; says nothing where none is.
set -euo pipefail
packages=(
  g++ cmake ninja-build ccache pkg-config git
  verilator yosys iverilog
  libsystemc-dev libcli11-dev libtomlplusplus-dev libeigen3-dev libfmt-dev
  nlohmann-json3-dev libpng-dev zlib1g-dev libsqlitecpp-dev libmuparser-dev libpugixml-dev
  nettle-dev libseccomp-dev
  node-d3
  libgtest-dev librapidcheck-dev libbenchmark-dev
)
case "${1:-}" in
  ci) packages+=(clang-format clang-tidy clang libclang-rt-dev) ;;
  fuzz) packages+=(clang libclang-rt-dev) ;;
  synthesis) packages+=(nextpnr-ice40) ;;
esac

missing=()
for package in "${packages[@]}"; do
  dpkg-query -W -f '${Status}' "$package" 2>/dev/null | grep -q 'ok installed' || missing+=("$package")
done
[ ${#missing[@]} -eq 0 ] && exit 0

as_root=()
if [ "$(id -u)" -ne 0 ]; then
  if ! command -v sudo >/dev/null; then
    echo "install.sh: as root, run: apt-get install ${missing[*]}" >&2
    exit 1
  fi
  as_root=(sudo)
fi
echo "installing ${missing[*]}"
log=$(mktemp)
if ! { "${as_root[@]}" apt-get -q update &&
       "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
         apt-get -q -y --no-install-recommends install "${missing[@]}"; } >"$log" 2>&1; then
  tail -n 20 "$log" >&2
  echo "install.sh: apt-get failed; the whole output is in $log" >&2
  exit 1
fi
rm -f "$log"
