#!/usr/bin/env bash
# What looks at the code besides compilers and tests.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/build.sh"

if [ "${1:-}" = "--help" ] || [ $# -eq 0 ]; then
  cat << 'HELP'
Usage: Testing/checks.sh STEP...

  cppcheck   all of Filters
  tidy       clang-tidy, with the checks of .clang-tidy, over the sources of Filters that differ from
             origin/main, or from GRIDFEM_SINCE where that names another commit
  tidy-all   the same over all of Filters, some hours of one processor
  sanitize   random problems of Core with the address and undefined-behaviour sanitizers, in
             build-sanitize/; GRIDFEM_CASES: how many, of GRIDFEM_SEED on (default: 1000 from 1)
  threads    ThreadSanitizer, with clang, on the tests of Core and random problems, in build-threads/
  coverage   which lines of Core its tests run, in build-coverage/; fails where they are less than nine in ten
  long       the tests that continuous integration leaves out: limits of memory, upgrades, the wheel, a user
             without a home folder, and 8,000 more random problems
  ranks      the tests of ranks on two and four of them; every other run has them on three
  valgrind   leaks and wrong memory on some tests of Core and of the filters, and on random problems, in
             build-valgrind/
  all        all but tidy-all

Installs what is missing, and fails where something is found. GRIDFEM_JOBS: processes at the same time.
Continuous integration runs none of them, because they take from minutes to hours.
HELP
  exit
fi

# Configures and builds for a check in a folder of its own, without VTK unless an option says otherwise.
# Usage: BuildFor FOLDER TARGETS [-DOPTION=VALUE...]
BuildFor()
{
  local folder="$1" targets
  read -ra targets <<< "$2"
  shift 2
  mkdir -p "$folder"
  Quietly "$folder/configure.log" cmake -S "$SOURCE" -B "$folder" -G Ninja -DGRIDFEM_BUILD_VTK=OFF \
    -DCMAKE_BUILD_TYPE=RelWithDebInfo "$@"
  Say "Building in $folder"
  Quietly "$folder/build.log" cmake --build "$folder" --target "${targets[@]}" -j "$JOBS"
}

Cppcheck()
{
  InstallMissing cppcheck
  # What its parser does not know, templates called by name and macros of VTK and pybind11, are no
  # findings. Points of clipping are made without values, because there are many.
  cppcheck -j "$JOBS" --quiet --std=c++17 --language=c++ --enable=warning,performance,portability \
    --suppress=unknownMacro --suppress=internalAstError --suppress=syntaxError \
    --suppress=uninitMemberVar:*/Grid/Clip.h --inline-suppr --error-exitcode=1 \
    -I "$SOURCE/Filters/Core" -I "$SOURCE/Filters/VTK" "$SOURCE/Filters"
}

# Usage: Tidy FILE...: names the sources of Filters among the files, and looks at them.
Tidy()
{
  local file sources=()
  for file in "$@"; do
    if [[ "$file" == Filters/*.cxx ]] && [ -f "$SOURCE/$file" ]; then
      sources+=("$SOURCE/$file")
    fi
  done
  Say "clang-tidy: ${#sources[@]} sources"
  [ ${#sources[@]} -gt 0 ] || return 0
  InstallMissing "${BUILD_PACKAGES[@]}" "${TEST_PACKAGES[@]}" clang-tidy
  BuildTree all -DGRIDFEM_BUILD_PYTHON=ON # makes compile_commands.json, and headers
  printf '%s\0' "${sources[@]}" |
    xargs -0 -n 1 -P "$JOBS" clang-tidy -p "$BUILD" --quiet --warnings-as-errors='*'
}

TidyChanged()
{
  local since files
  since="$(git -C "$SOURCE" merge-base HEAD "${GRIDFEM_SINCE:-origin/main}")"
  mapfile -t files < <(git -C "$SOURCE" diff --name-only "$since")
  Tidy "${files[@]}"
}

TidyAll()
{
  local files
  mapfile -t files < <(git -C "$SOURCE" ls-files Filters)
  Tidy "${files[@]}"
}

Threads()
{
  local folder="$SOURCE/build-threads"
  InstallMissing "${CORE_PACKAGES[@]}" clang libomp-dev libgtest-dev
  BuildFor "$folder" all -DCMAKE_CXX_COMPILER=clang++ \
    -DCMAKE_CXX_FLAGS="-fsanitize=thread -O1"
  # Without libomp's archer every barrier is a false alarm.
  export OMP_TOOL_LIBRARIES=libarcher.so
  export TSAN_OPTIONS=ignore_noninstrumented_modules=1
  ctest --test-dir "$folder" --output-on-failure -j "$JOBS" -E "^Rules[.]|^Fuzz[.](Core|More|Defects|MoreDefects)$" < /dev/null
  "$folder/bin/FuzzCore" 1 500
}

Sanitize()
{
  local folder="$SOURCE/build-sanitize"
  InstallMissing "${CORE_PACKAGES[@]}" libgtest-dev
  mkdir -p "$folder"
  (cd "$SOURCE" && Quietly "$folder/configure.log" cmake --preset sanitize)
  Say "Building in $folder"
  Quietly "$folder/build.log" cmake --build "$folder" --target FuzzCore -j "$JOBS"
  "$folder/bin/FuzzCore" "${GRIDFEM_SEED:-1}" "${GRIDFEM_CASES:-1000}"
  "$folder/bin/FuzzCore" defects "${GRIDFEM_SEED:-1}" "${GRIDFEM_CASES:-1000}"
}

Long()
{
  InstallMissing "${BUILD_PACKAGES[@]}" "${TEST_PACKAGES[@]}"
  BuildTree all -DGRIDFEM_BUILD_PYTHON=ON
  ctest --test-dir "$BUILD" --output-on-failure --timeout 300 -j "$JOBS" -L "^Long$" < /dev/null
}

Ranks()
{
  local failed=0
  InstallMissing "${BUILD_PACKAGES[@]}" "${TEST_PACKAGES[@]}"
  BuildTree all -DGRIDFEM_BUILD_PYTHON=ON -DGRIDFEM_TEST_RANKS="2;4"
  ctest --test-dir "$BUILD" --output-on-failure -R "^(Parallel|Ranks)[.].*On[24]$" < /dev/null || failed=1
  BuildTree all -DGRIDFEM_BUILD_PYTHON=ON -UGRIDFEM_TEST_RANKS
  return $failed
}

# Usage: UnderValgrind PROGRAM [ARGUMENT...]
UnderValgrind()
{
  Say "valgrind: $*"
  OMP_NUM_THREADS=1 valgrind --quiet --error-exitcode=1 --leak-check=full --show-leak-kinds=definite \
    --errors-for-leak-kinds=definite "$SOURCE/build-valgrind/bin/$1" "${@:2}"
}

Valgrind()
{
  local tests="TestGrouping TestSparseMatrix TestPatchLevel TestHatMatrices TestConjugateGradients" test
  tests+=" TestPipeline TestSelection TestOtherDataSets TestGhostCells TestHostileProperties TestBlocksAsOne"
  tests+=" TestMetricArray TestTime"
  InstallMissing "${BUILD_PACKAGES[@]}" valgrind
  # It does not know AVX-512.
  BuildFor "$SOURCE/build-valgrind" "$tests FuzzCore" -DGRIDFEM_BUILD_VTK=ON \
    -DGRIDFEM_BUILD_PLUGIN=ON -DGRIDFEM_NATIVE=OFF
  for test in $tests; do
    UnderValgrind "$test" --gtest_brief=1 --gtest_filter="-*Threads*:*Large*"
  done
  UnderValgrind FuzzCore 1 20
}

for step in "$@"; do
  case "$step" in
    cppcheck) Cppcheck ;;
    tidy) TidyChanged ;;
    tidy-all) TidyAll ;;
    sanitize) Sanitize ;;
    threads) Threads ;;
    coverage) "$SOURCE/Testing/coverage.sh" ;;
    long) Long ;;
    ranks) Ranks ;;
    valgrind) Valgrind ;;
    all)
      Cppcheck
      TidyChanged
      Sanitize
      Threads
      "$SOURCE/Testing/coverage.sh"
      Long
      Ranks
      Valgrind
      ;;
    *)
      Say "There is no step $step; see --help"
      exit 1
      ;;
  esac
  Say "$step: nothing found"
done
