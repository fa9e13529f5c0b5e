#!/usr/bin/env bash
# Which lines of Core its tests run; fails where they are less than nine in ten.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/build.sh"
BUILD="$SOURCE/build-coverage"

if [ "${1:-}" = "--help" ] || [ "${1:-}" = "-h" ]; then
  cat << 'HELP'
Usage: Testing/coverage.sh [CTEST OPTIONS]

Builds Core in build-coverage/, which counts how often each line runs, runs its tests, and prints the part
of its lines that has run, by folder. Options go to ctest. Takes about half an hour on two processors,
which is why continuous integration does not.
HELP
  exit
fi

InstallMissing "${CORE_PACKAGES[@]}" libgtest-dev python3
mkdir -p "$BUILD"
cd "$SOURCE"
Quietly "$BUILD/configure.log" cmake --preset coverage
Say "Building"
Quietly "$BUILD/build.log" cmake --build "$BUILD" -j "$JOBS"
find "$BUILD" -name "*.gcda" -delete
# Counting makes some tests slower than their limit, and real meshes would take hours: what has run counts all
# the same.
export GRIDFEM_DATA_DIR=/dev/null # else they are looked for beside the clone
RAN=0
ctest --test-dir "$BUILD" --output-on-failure -j "$JOBS" -E "Rules|Fuzz.Core|Package" "$@" < /dev/null || RAN=$?
python3 Testing/coverage.py "$BUILD" "$SOURCE/Filters/Core" 90
[ "$RAN" -eq 0 ] || Say "Some tests have failed, or were too slow"
