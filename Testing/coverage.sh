#!/usr/bin/env bash
# Which lines of Core its tests run; fails where they are less than nine in ten.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/build.sh"
COUNTED="$SOURCE/build-coverage"

if [ "${1:-}" = "--help" ] || [ "${1:-}" = "-h" ]; then
  cat << 'HELP'
Usage: Testing/coverage.sh

Builds in build-coverage/ a library of Core that counts how often each of its lines runs, runs the tests of
Core and random problems, which are those of build/, with it, and prints the part of its lines that has run,
by folder. Takes five minutes on two processors where build/ is there. GRIDFEM_JOBS: processes at the
same time.

Measured: 96 % of all lines, 93 % of Krylov/, 94 % or more of every other folder.
Left out are real meshes, which not every machine has, and the tests of filters, of the Python package and of
MPI ranks: so what Core does for ranks alone (Grid/CellRegion.cxx, Multigrid/DistributedLevel.cxx) counts as not
run.
HELP
  exit
fi

InstallMissing "${BUILD_PACKAGES[@]}" "${TEST_PACKAGES[@]}"
BuildTree all -DGRIDFEM_BUILD_PYTHON=ON
mkdir -p "$COUNTED"
cd "$SOURCE"
# Its flags count in functions of Core alone, not of Eigen, and without atomic additions, which made tests
# forty times as slow: threads may lose a count, but a line that has run keeps one.
Quietly "$COUNTED/configure.log" cmake --preset coverage
Say "Building what counts"
Quietly "$COUNTED/build.log" cmake --build "$COUNTED" --target gridfem_core -j "$JOBS"
find "$COUNTED" -name "*.gcda" -delete # of a library that has changed they could not be added to
Say "Counting"
export GRIDFEM_DATA_DIR=/dev/null # else real meshes are looked for beside the clone
LD_LIBRARY_PATH="$(dirname "$(find "$COUNTED" -name "libgridfem_core.so" | head -n 1)")"
export LD_LIBRARY_PATH
# Each program once with all of its tests: when one ends it adds to the counts of every file of Core.
for test in Testing/Core/*/Test*.cxx; do
  echo "$BUILD/bin/$(basename "$test" .cxx)"
done > "$COUNTED/programs"
Quietly "$COUNTED/tests.log" xargs -a "$COUNTED/programs" -d '\n' -n 1 -P "$JOBS" timeout 600
Quietly "$COUNTED/random.log" "$BUILD/bin/FuzzCore" 1 1000
python3 Testing/coverage.py "$COUNTED" "$SOURCE/Filters/Core" 90
