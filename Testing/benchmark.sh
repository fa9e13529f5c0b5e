#!/usr/bin/env bash
# Builds and runs the benchmarks; not part of the tests.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/build.sh"

page=false
if [ "${1:-}" = "--page" ]; then
  page=true
  shift
fi
groups=()
for source in "$SOURCE"/Testing/Benchmarks/Benchmark*.cxx; do
  group="$(basename "$source" .cxx)"
  group="${group#Benchmark}"
  groups+=("${group,,}")
done

if [ "${1:-}" = "--help" ] || [ "${1:-}" = "-h" ]; then
  cat << HELP
Usage: Testing/benchmark.sh [--page] [GROUP...]

Prints the table of each group (default: all) and, for each row that has a bound, a line
  RATIO <name> <measured> <= <bound>
or >=. Exit status 0 even when a bound is missed. The group figures draws the figures of the
thesis into Testing/Benchmarks/Figures.
--page also keeps the output of each group, with day, processor and commit, in
Testing/Benchmarks/Measured, and writes it into Testing/Benchmarks/README.md. No number there is
typed by hand.
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
OnRanks()
{
  OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 \
    mpiexec --oversubscribe --bind-to none -n "$1" "$BUILD/bin/BenchmarkRanks" "${@:2}" < /dev/null
}

# Bounds of the rows of MeasureRanks.
CompareRanks()
{
  awk -F ' *[|] *' -v name="$1" '
    { seconds[$4] = $7 + $8; iterations[$4] = $6; memory[$4] = $10 }
    END {
      if (!seconds[2] || !seconds["Core"]) {
        print "There is no row of two ranks, or none of Core" > "/dev/stderr"
        exit 1
      }
      printf "RATIO two_ranks_seconds_over_two_threads_%s %.4g <= 1.2\n", name, seconds[2] / seconds["Core"]
      printf "RATIO eight_ranks_memory_over_one_%s %.4g <= 0.25\n", name, memory[8] / memory[1]
      printf "RATIO eight_ranks_iterations_over_one_%s %.4g <= 1.3\n", name, iterations[8] / iterations[1]
    }'
}

# One row for each number of ranks, and two of Core alone, by one thread and by all.
MeasureRanks()
{
  local ranks
  echo "| problem | depth | ranks | functions | iterations | set-up, s | solve, s | MB before | MB |"
  echo "|---|---|---|---|---|---|---|---|---|"
  {
    taskset -c 0 "$BUILD/bin/BenchmarkRanks" "$@" core < /dev/null
    "$BUILD/bin/BenchmarkRanks" "$@" core < /dev/null
    for ranks in 1 2 4 8; do
      OnRanks "$ranks" "$@"
    done
  } | tee "$BUILD/ranks"
  CompareRanks "${1}_${2%%.*}" < "$BUILD/ranks"
}

# The hat functions of a surface on the same ranks by ours and by algebraic multigrid.
MeasurePeersOnRanks()
{
  local ranks
  echo "| hats of $1, by | ranks | iterations | set-up, s | solve, s | both, s | difference |"
  echo "|---|---|---|---|---|---|---|"
  for ranks in 1 2 4; do
    OnRanks "$ranks" peers "$@"
  done
}

# What the rank that sends most sends in one cycle.
CountMessages()
{
  local ranks
  echo "| surface | cycle | ranks | functions | divided levels | messages | kB | sums | kB of sums | bytes / sqrt(functions per rank) |"
  echo "|---|---|---|---|---|---|---|---|---|---|"
  for ranks in 2 4 8 16; do
    OnRanks "$ranks" messages "$@"
  done
}

# Waiting threads must not take processor time from working threads.
export OMP_WAIT_POLICY="${OMP_WAIT_POLICY:-passive}"
Measure()
{
  local group="$1"
  if [ "$group" = figures ]; then
    "$BUILD/bin/BenchmarkFigures" "$BUILD/figures" < /dev/null
    xvfb-run -a pvpython "$SOURCE/Testing/Benchmarks/draw_figures.py" "$BUILD/figures" \
      "$SOURCE/Testing/Benchmarks/Figures" < /dev/null
  elif [ "$group" = ranks ]; then
    MeasureRanks poisson torus:3225 8
    MeasureRanks spectrum torus:1200 7
    MeasureRanks hats torus:1200 7
    MeasureRanks hats "${GRIDFEM_DATA_DIR:-$SOURCE/../shared/data}/armadillo_100k.ply" 7
    MeasurePeersOnRanks torus:1200 7
    MeasurePeersOnRanks "${GRIDFEM_DATA_DIR:-$SOURCE/../shared/data}/armadillo_100k.ply" 7
    CountMessages torus:1200 7
    CountMessages torus:2400 8
  else
    "$BUILD/bin/Benchmark${group^}" < /dev/null
  fi
  if [ "$group" = setup ]; then
    "$SOURCE/build-benchmarks-vtk/bin/BenchmarkClipFilter" < /dev/null
  fi
}

for group in "${groups[@]}"; do
  Say "$group"
  Measure "$group" | tee "$BUILD/$group.txt"
  if [ "$page" = true ]; then
    python3 "$SOURCE/Testing/Benchmarks/page.py" keep "$group" < "$BUILD/$group.txt"
    python3 "$SOURCE/Testing/Benchmarks/page.py"
  fi
done
