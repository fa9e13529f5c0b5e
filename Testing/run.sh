#!/usr/bin/env bash
# Installs what is missing, builds everything and runs all tests.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/build.sh"

if [ "${1:-}" = "--help" ] || [ "${1:-}" = "-h" ]; then
  cat << 'HELP'
Usage: Testing/run.sh [CTEST OPTIONS]

Installs the Debian packages that are missing (as root or with sudo), builds into build/, and runs
the tests. Options go to ctest, for example: -R Clip
Without options Core is also compiled with clang, into build-clang/, with warnings as errors.

Environment:
  CI=true            compiler warnings are errors
  GRIDFEM_JOBS       compilers and tests that run at the same time (default: processors)
  GRIDFEM_DATA_DIR   folder of real meshes; tests that need them are skipped without it
HELP
  exit
fi

InstallMissing "${BUILD_PACKAGES[@]}" "${TEST_PACKAGES[@]}"
BuildTree all -DGRIDFEM_BUILD_PYTHON=ON
if [ $# -eq 0 ] && command -v clang++ > /dev/null; then
  Say "Compiling Core with clang"
  # Neither optimised nor for a debugger: warnings are what is looked for.
  Quietly "$BUILD/clang-configure.log" cmake -S "$SOURCE" -B "$SOURCE/build-clang" -G Ninja \
    -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS_DEBUG= -DGRIDFEM_WERROR=ON \
    -DGRIDFEM_BUILD_VTK=OFF -DGRIDFEM_BUILD_TESTING=OFF
  Quietly "$BUILD/clang-build.log" cmake --build "$SOURCE/build-clang" -j "$JOBS"
fi
ctest --test-dir "$BUILD" --output-on-failure --timeout 300 -j "$JOBS" "$@" < /dev/null
