#!/usr/bin/env bash
# The whole test suite on a fresh machine: packages, format, build, end-to-end and slow tests as users' tools are built,
# then the unit tests under the address and undefined-behaviour sanitizers.
set -euo pipefail
cd "$(dirname "$0")/.."

bash share/install-deps.sh --tests

# Releases of clang-format differ in some lines; the sources are as that of Debian 12 leaves them.
if [[ $(clang-format --version) == *"version 14."* ]]; then
  git ls-files '*.h' '*.cpp' | xargs clang-format --dry-run --Werror
else
  echo "run: the format is not judged, which takes clang-format 14" >&2
fi
cmake --preset ci
cmake --build --preset ci
ctest --preset ci

cmake --preset asan
cmake --build --preset asan --target unit_tests
ctest --preset asan
# A process runs all unit tests of a folder, and ctest tells of processes only.
awk '/SKIPPED.* ms\)/ { print } /^\[  PASSED  \]/ { passed += $4 } END { print passed " unit tests passed" }' \
  build/asan/Testing/Temporary/LastTest.log
