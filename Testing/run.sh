#!/usr/bin/env bash
# Installs what is missing, builds everything and runs all tests.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/build.sh"

if [ "${1:-}" = "--help" ] || [ "${1:-}" = "-h" ]; then
  cat << 'HELP'
Usage: Testing/run.sh [CTEST OPTIONS]

Installs the Debian packages that are missing (as root or with sudo), builds into build/, and runs
the tests. Options go to ctest, for example: -R Clip

Environment:
  CI=true            compiler warnings are errors
  GRIDFEM_JOBS       compilers and tests that run at the same time (default: processors)
  GRIDFEM_DATA_DIR   folder of real meshes; tests that need them are skipped without it
HELP
  exit
fi

InstallMissing "${BUILD_PACKAGES[@]}" "${TEST_PACKAGES[@]}"
BuildTree all
ctest --test-dir "$BUILD" --output-on-failure --timeout 300 -j "$JOBS" "$@" < /dev/null
