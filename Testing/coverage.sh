#!/usr/bin/env bash
# Which lines of Core its tests run; fails where they are less than nine in ten.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/build.sh"
BUILD="$SOURCE/build-coverage"

if [ "${1:-}" = "--help" ] || [ "${1:-}" = "-h" ]; then
  cat << 'HELP'
Usage: Testing/coverage.sh [CTEST OPTIONS]

Builds Core in build-coverage/, which counts how often each line of it runs, runs its tests and random problems,
and prints the part of its lines that has run, by folder. Options go to ctest. Takes seven minutes on two
processors, of which tests take two. GRIDFEM_JOBS: processes at the same time.

Left out: real meshes, which not every machine has; the tests of filters, of the Python package and of MPI
ranks, for which more has to be built, and which run the rest of Core's Problems/, and what is for ranks alone.
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
Say "Testing"
export GRIDFEM_DATA_DIR=/dev/null # else real meshes are looked for beside the clone
RAN=0
ctest --test-dir "$BUILD" --output-on-failure -j "$JOBS" -E "^Rules[.]" "$@" < /dev/null || RAN=$?
python3 Testing/coverage.py "$BUILD" "$SOURCE/Filters/Core" 90
exit "$RAN"
