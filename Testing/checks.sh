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
  files      every file compiled alone, for any processor, with the benchmarks, in build-files/:
             continuous integration puts files together, which hides a missing include
  sanitize   the tests of Core and random problems with the address and undefined-behavior sanitizers,
             in build-sanitize/; GRIDFEM_CASES: how many, of GRIDFEM_SEED on (default: 1000 from 1)
  sanitize-filters
             the same with filters on damaged data, tests of filters, and the tests of ranks, in
             build-sanitize-filters/
  threads    ThreadSanitizer, with clang, on the tests of Core and random problems, in build-threads/
  coverage   which lines of Core its tests run, in build-coverage/; fails where they are less than nine in ten
  mutants    deliberate errors, each of which must fail a test, in a copy of the sources in build-mutants/
  long       the tests that continuous integration leaves out: limits of memory, upgrades, the wheel, a user
             without a home folder, and more random problems and damaged data
  ranks      the tests of ranks on two and four of them; every other run has them on three
  valgrind   leaks and wrong memory on some tests of Core and of the filters, and on random problems, in
             build-valgrind/
  plain      other_paraview.sh SUITE-vtk: the filters without ParaView, with this Debian's VTK
  package    package.sh: the Debian package
  all        all but tidy-all; goes on after a failure, and ends with a table of the results

Installs what is missing, and fails where something is found. GRIDFEM_JOBS: processes at the same time.
Continuous integration runs none of them, because they take from minutes to hours.
HELP
  exit
fi

# Configures and builds for a check in a folder of its own, without VTK and ten files at a time unless an
# option says otherwise.
# Usage: BuildFor FOLDER TARGETS [-DOPTION=VALUE...]
BuildFor()
{
  local folder="$1" targets
  read -ra targets <<< "$2"
  shift 2
  mkdir -p "$folder"
  Quietly "$folder/configure.log" cmake -S "$SOURCE" -B "$folder" -G Ninja -DGRIDFEM_BUILD_VTK=OFF -DGRIDFEM_NATIVE=ON \
    -DCMAKE_UNITY_BUILD=ON -DCMAKE_UNITY_BUILD_BATCH_SIZE=10 -DCMAKE_BUILD_TYPE=RelWithDebInfo "$@"
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
  ctest --test-dir "$folder" --no-tests=error --output-on-failure -j "$JOBS" -E "^Rules[.]|^Fuzz[.](Core|More|Defects|MoreDefects)$" < /dev/null
  "$folder/bin/FuzzCore" 1 500
}

Sanitize()
{
  local folder="$SOURCE/build-sanitize"
  InstallMissing "${CORE_PACKAGES[@]}" libgtest-dev
  mkdir -p "$folder"
  (cd "$SOURCE" && Quietly "$folder/configure.log" cmake --preset sanitize)
  Say "Building in $folder"
  Quietly "$folder/build.log" cmake --build "$folder" -j "$JOBS"
  # Some tests ask for more memory than there is, and catch the exception.
  export ASAN_OPTIONS=allocator_may_return_null=1
  ctest --test-dir "$folder" --no-tests=error --output-on-failure --timeout 1200 -j "$JOBS" \
    -E "^Rules[.]|^Fuzz[.](Core|More|Defects|MoreDefects)$" < /dev/null
  "$folder/bin/FuzzCore" "${GRIDFEM_SEED:-1}" "${GRIDFEM_CASES:-1000}"
  "$folder/bin/FuzzCore" defects "${GRIDFEM_SEED:-1}" "${GRIDFEM_CASES:-1000}"
}

# MPI and VTK keep memory to the end of a program.
SanitizeFilters()
{
  local folder="$SOURCE/build-sanitize-filters" test
  local tests="TestFailureRule TestPipeline TestGhostCells TestSelection TestOtherDataSets TestBlocksAsOne"
  tests+=" TestDataMessage"
  InstallMissing "${BUILD_PACKAGES[@]}" "${TEST_PACKAGES[@]}"
  BuildFor "$folder" "$tests FuzzFilters Testing/Parallel/all" -DGRIDFEM_BUILD_VTK=ON -DGRIDFEM_BUILD_PLUGIN=ON \
    -DCMAKE_CXX_FLAGS_RELWITHDEBINFO="-O1 -g1" -DCMAKE_CXX_FLAGS="$(SanitizeFlags)"
  export ASAN_OPTIONS=detect_leaks=0
  for test in $tests; do
    "$folder/bin/$test" --gtest_brief=1
  done
  "$folder/bin/FuzzFilters" "${GRIDFEM_SEED:-1}" "${GRIDFEM_CASES:-1000}"
  ctest --test-dir "$folder" --no-tests=error --output-on-failure --timeout 1200 -R "^Parallel[.]" < /dev/null
}

# Those of the preset.
SanitizeFlags()
{
  sed -n 's/.*"CMAKE_CXX_FLAGS": "\(-fsanitize=address[^"]*\)".*/\1/p' "$SOURCE/CMakePresets.json"
}

Files()
{
  InstallMissing "${BUILD_PACKAGES[@]}" "${TEST_PACKAGES[@]}" "${BENCHMARK_PACKAGES[@]}"
  BuildFor "$SOURCE/build-files" all -DGRIDFEM_BUILD_VTK=ON -DGRIDFEM_BUILD_PYTHON=ON \
    -DGRIDFEM_BUILD_BENCHMARKS=ON -DGRIDFEM_NATIVE=OFF -DGRIDFEM_WERROR=ON \
    -DCMAKE_UNITY_BUILD=OFF -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON -DCMAKE_BUILD_TYPE=Debug
}

# The errors are made in a copy, so that the sources stay as they are.
Mutants()
{
  local copy="$SOURCE/build-mutants/source"
  InstallMissing "${BUILD_PACKAGES[@]}" "${TEST_PACKAGES[@]}" rsync
  mkdir -p "$copy"
  rsync -a --delete --exclude "/build*" --exclude .git "$SOURCE/" "$copy"
  Quietly "$SOURCE/build-mutants/configure.log" cmake -S "$copy" -B "$copy/build" -G Ninja \
    -DCMAKE_BUILD_TYPE=Release -DGRIDFEM_NATIVE=ON
  python3 "$copy/Testing/mutants.py" "$copy"
}

Long()
{
  InstallMissing "${BUILD_PACKAGES[@]}" "${TEST_PACKAGES[@]}"
  BuildTree all -DGRIDFEM_BUILD_PYTHON=ON
  ctest --test-dir "$BUILD" --no-tests=error --output-on-failure --timeout 300 -j "$JOBS" -L "^Long$" < /dev/null
}

Ranks()
{
  local failed=0
  InstallMissing "${BUILD_PACKAGES[@]}" "${TEST_PACKAGES[@]}"
  BuildTree all -DGRIDFEM_BUILD_PYTHON=ON -DGRIDFEM_TEST_RANKS="2;4"
  ctest --test-dir "$BUILD" --no-tests=error --output-on-failure -R "^(Parallel|Ranks)[.].*On[24]$" < /dev/null || failed=1
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

# Runs one step after the other, and prints the rows of the table in CONTRIBUTING.md.
All()
{
  local failed=0 step begin result rows=() commit
  commit="$(git -C "$SOURCE" rev-parse --short HEAD)"
  for step in cppcheck tidy files sanitize sanitize-filters threads coverage mutants long ranks valgrind plain \
    package; do
    begin=$SECONDS
    result="nothing found"
    "$SOURCE/Testing/checks.sh" "$step" || { result="failed"; failed=1; }
    rows+=("| $step | $result | $(date +%F) | $commit | $(((SECONDS - begin + 59) / 60)) |")
  done
  printf '%s\n' "| step | result | day | commit | minutes |" "|---|---|---|---|---|" "${rows[@]}"
  return $failed
}

RequireMeshes
for step in "$@"; do
  case "$step" in
    cppcheck) Cppcheck ;;
    tidy) TidyChanged ;;
    tidy-all) TidyAll ;;
    files) Files ;;
    sanitize) Sanitize ;;
    sanitize-filters) SanitizeFilters ;;
    threads) Threads ;;
    coverage) "$SOURCE/Testing/coverage.sh" ;;
    mutants) Mutants ;;
    long) Long ;;
    ranks) Ranks ;;
    valgrind) Valgrind ;;
    plain) "$SOURCE/Testing/other_paraview.sh" "$(SuiteOfHere)-vtk" ;;
    package) "$SOURCE/Testing/package.sh" ;;
    all) All ;;
    *)
      Say "There is no step $step; see --help"
      exit 1
      ;;
  esac
  Say "$step: nothing found"
done
