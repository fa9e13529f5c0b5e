#!/usr/bin/env bash
# Builds and runs the benchmarks; not part of the tests.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/build.sh"

if [ "${1:-}" = "--help" ] || [ "${1:-}" = "-h" ]; then
  cat << 'HELP'
Usage: Testing/benchmark.sh [--peers] [GROUP...]

Prints the table of each group (default: all) and, for each row that has a bound, a line
  RATIO <name> <measured> <= <bound>
A group is a file Testing/Benchmarks/Benchmark<GROUP>.cxx.

  --peers   also install and run the other solvers that some groups compare with
HELP
  exit
fi

packages=("${BUILD_PACKAGES[@]}" "${BENCHMARK_PACKAGES[@]}")
if [ "${1:-}" = "--peers" ]; then
  packages+=("${PEER_PACKAGES[@]}")
  shift
fi
groups=("$@")
if [ ${#groups[@]} -eq 0 ]; then
  for source in "$SOURCE"/Testing/Benchmarks/Benchmark*.cxx; do
    group="$(basename "$source" .cxx)"
    groups+=("${group#Benchmark}")
  done
fi

InstallMissing "${packages[@]}"
BUILD="$SOURCE/build-benchmarks"
BuildTree all -DGRIDFEM_BUILD_VTK=OFF -DGRIDFEM_BUILD_TESTING=OFF -DGRIDFEM_BUILD_BENCHMARKS=ON
for group in "${groups[@]}"; do
  Say "$group"
  "$BUILD/bin/Benchmark$group" < /dev/null
done
