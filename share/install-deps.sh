#!/usr/bin/env bash
# Installs the packages of Debian 12 or newer that lidar_upsampling needs; does nothing when all are there.
#   share/install-deps.sh           to build and run
#   share/install-deps.sh --tests   also what the tests and benchmarks use
set -euo pipefail

packages=(
  g++ cmake ninja-build help2man
  libmrpt-dev mrpt-apps libopencv-dev libceres-dev libeigen3-dev libgeographiclib-dev libtbb-dev
  libnanoflann-dev libcli11-dev nlohmann-json3-dev libtinyxml2-dev zlib1g-dev libisal-dev libdeflate-dev libzstd-dev libjpeg-dev pkgconf gnuplot-nox
)
case "${1:-}" in
  "") ;;
  --tests) packages+=(libgtest-dev libbenchmark-dev clang-format xvfb x11-apps xdotool chromium
      dpkg-dev lintian man-db hunspell hunspell-en-gb) ;;
  *) echo "usage: $0 [--tests]" >&2; exit 2 ;;
esac

missing=()
for package in "${packages[@]}"; do
  status=$(dpkg-query --show --showformat='${db:Status-Status}' "$package" 2>/dev/null || true)
  [ "$status" = installed ] || missing+=("$package")
done
[ ${#missing[@]} -gt 0 ] || exit 0

if [ "$(id -u)" = 0 ]; then as_root=(); else as_root=(sudo); fi
if [ ${#as_root[@]} -gt 0 ] && ! command -v sudo >/dev/null; then
  echo "install-deps: these packages are missing and sudo is not there to install them: ${missing[*]}" >&2
  exit 1
fi
echo "Installing: ${missing[*]}"
# On a terminal apt shows how far it is; elsewhere only what goes wrong is of use.
if [ -t 1 ]; then quiet=() shown=/dev/stdout; else quiet=(-qq) shown=/dev/null; fi
"${as_root[@]}" apt-get update "${quiet[@]}" > "$shown"
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y "${quiet[@]}" --no-install-recommends \
  "${missing[@]}" > "$shown"
