#!/usr/bin/env bash
# Builds and runs the benchmarks; not part of the tests.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/build.sh"

groups=()
for source in "$SOURCE"/Testing/Benchmarks/Benchmark*.cxx; do
  group="$(basename "$source" .cxx)"
  group="${group#Benchmark}"
  groups+=("${group,,}")
done

if [ "${1:-}" = "--help" ] || [ "${1:-}" = "-h" ]; then
  cat << HELP
Usage: Testing/benchmark.sh [GROUP...]

Prints the table of each group (default: all) and, for each row that has a bound, a line
  RATIO <name> <measured> <= <bound>
or >=. Exit status 0 even when a bound is missed. The group figures draws the figures of the
thesis into Testing/Benchmarks/Figures.
Groups: ${groups[*]}

Environment: GRIDFEM_DATA_DIR  folder of the real meshes (default: ../shared/data)
HELP
  exit
fi
if [ $# -gt 0 ]; then
  for group in "$@"; do
    if [[ " ${groups[*]} " != *" $group "* ]]; then
      Say "There is no group $group. There are: ${groups[*]}"
      exit 2
    fi
  done
  groups=("$@")
fi

InstallMissing "${CORE_PACKAGES[@]}" "${BENCHMARK_PACKAGES[@]}"
if [[ " ${groups[*]} " == *" figures "* ]]; then
  InstallMissing "${FIGURE_PACKAGES[@]}"
fi
# The group setup measures a filter, too; only that one needs VTK.
if [[ " ${groups[*]} " == *" setup "* ]]; then
  InstallMissing "${BUILD_PACKAGES[@]}"
  BUILD="$SOURCE/build-benchmarks-vtk"
  BuildTree BenchmarkClipFilter -DGRIDFEM_BUILD_EXAMPLES=OFF -DGRIDFEM_BUILD_TESTING=OFF \
    -DGRIDFEM_BUILD_BENCHMARKS=ON
fi
BUILD="$SOURCE/build-benchmarks"
BuildTree all -DGRIDFEM_BUILD_VTK=OFF -DGRIDFEM_MPI=ON -DGRIDFEM_BUILD_TESTING=OFF \
  -DGRIDFEM_BUILD_BENCHMARKS=ON
# One row for each number of ranks, and one of Core alone.
MeasureRanks()
{
  export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
  local ranks program="$BUILD/bin/BenchmarkRanks"
  echo "| problem | depth | ranks | functions | iterations | set-up, s | solve, s | MB before | MB |"
  echo "|---|---|---|---|---|---|---|---|---|"
  "$program" "$@" core < /dev/null
  for ranks in 1 2 4 8; do
    mpiexec --oversubscribe --bind-to none -n "$ranks" "$program" "$@" < /dev/null
  done
}

# What the rank that sends most sends in one cycle.
CountMessages()
{
  export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
  local ranks
  echo "| surface | cycle | ranks | functions | divided levels | messages | kB | sums | kB of sums | bytes / sqrt(functions per rank) |"
  echo "|---|---|---|---|---|---|---|---|---|---|"
  for ranks in 2 4 8 16; do
    mpiexec --oversubscribe --bind-to none -n "$ranks" "$BUILD/bin/BenchmarkRanks" messages "$@" < /dev/null
  done
}

# Threads that wait must not take processor time from those that work.
export OMP_WAIT_POLICY="${OMP_WAIT_POLICY:-passive}"
for group in "${groups[@]}"; do
  Say "$group"
  if [ "$group" = figures ]; then
    "$BUILD/bin/BenchmarkFigures" "$BUILD/figures" < /dev/null
    xvfb-run -a pvpython "$SOURCE/Testing/Benchmarks/draw_figures.py" "$BUILD/figures" \
      "$SOURCE/Testing/Benchmarks/Figures" < /dev/null
  elif [ "$group" = ranks ]; then
    MeasureRanks poisson torus:2400 8
    MeasureRanks spectrum torus:1200 7
    MeasureRanks hats torus:1200 7
    CountMessages torus:1200 7
    CountMessages torus:2400 8
  else
    "$BUILD/bin/Benchmark${group^}" < /dev/null
  fi
  if [ "$group" = setup ]; then
    "$SOURCE/build-benchmarks-vtk/bin/BenchmarkClipFilter" < /dev/null
  fi
done
