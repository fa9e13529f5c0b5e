#!/usr/bin/env bash
# Installs what is missing, builds everything and runs all tests.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/build.sh"

if [ "${1:-}" = "--help" ] || [ "${1:-}" = "-h" ]; then
  cat << 'HELP'
Usage: Testing/run.sh [CTEST OPTIONS]

Installs the Debian packages that are missing (as root or with sudo), builds into build/, and runs
the tests. Options go to ctest, for example: -R Clip
Without options clang also looks at Core, with warnings as errors, and tests that take long are left
out: Testing/checks.sh long runs them. The twenty slowest tests are named at the end.

Environment:
  CI=true            compiler warnings are errors, and so are tests that are skipped or missing; only
                     tests that need real meshes may be skipped, if there is no folder of them
  GRIDFEM_JOBS       compilers and tests that run at the same time (default: processors)
  GRIDFEM_DATA_DIR   folder of real meshes (default: ../shared/data beside the sources); tests that
                     need them are skipped without it
HELP
  exit
fi

# Warnings are looked for, so that clang writes no code. Files are put together and headers read once,
# because most of the time goes into headers.
CheckWithClang()
{
  local folder="$SOURCE/build-clang"
  Quietly "$BUILD/clang-configure.log" cmake -S "$SOURCE" -B "$folder" -G Ninja \
    -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_BUILD_TYPE=Debug -DGRIDFEM_NATIVE=ON -DGRIDFEM_WERROR=ON \
    -DGRIDFEM_BUILD_VTK=OFF -DGRIDFEM_CUDA=OFF -DGRIDFEM_BUILD_TESTING=OFF -DGRIDFEM_CCACHE=OFF -DCMAKE_UNITY_BUILD=ON -DCMAKE_UNITY_BUILD_BATCH_SIZE=10
  Quietly "$BUILD/clang-headers.log" cmake --build "$folder" \
    --target Filters/Core/CMakeFiles/gridfem_core.dir/cmake_pch.hxx.pch
  # Each line is the command that compiles one file.
  sed -n '/-emit-pch/d; s/\\"/"/g; s/^  "command": "\(.*\)",$/\1 -fsyntax-only/p' \
    "$folder/compile_commands.json" > "$folder/commands"
  [ -s "$folder/commands" ]
  (cd "$folder" && Quietly "$BUILD/clang.log" xargs -a commands -d '\n' -n 1 -P "$JOBS" bash -c)
}

RequireMeshes
InstallMissing "${BUILD_PACKAGES[@]}" "${TEST_PACKAGES[@]}"
BuildTree all -DGRIDFEM_BUILD_PYTHON=ON
if [ $# -eq 0 ] && command -v clang++ > /dev/null; then
  Say "Looking at Core with clang"
  CheckWithClang
fi
tests=("$@")
whole=()
[ $# -gt 0 ] || { tests=(-LE "^Long$"); whole=(whole); }
times="$BUILD/tests.xml"
status=0
rm -f "$times"
ctest --test-dir "$BUILD" --no-tests=error --output-on-failure --output-junit "$times" --timeout 300 -j "$JOBS" \
  "${tests[@]}" < /dev/null || status=$?
if [ -f "$times" ]; then
  Say "The slowest tests, in seconds"
  sed -n 's/.*<testcase name="\([^"]*\)".* time="\([^"]*\)".*/\2 \1/p' "$times" | sort -rn | sed -n 1,20p
  python3 "$SOURCE/Testing/results.py" "$times" "${whole[@]}" || status=1
fi
exit "$status"
