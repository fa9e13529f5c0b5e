#!/usr/bin/env bash
# Builds everything for the ParaView of another Debian, in a root of its own, and tests it there.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/build.sh"
source "$(dirname "${BASH_SOURCE[0]}")/roots.sh"

if [ $# -eq 0 ] || [ "$1" = "--help" ] || [ "$1" = "-h" ]; then
  cat << 'HELP'
Usage: Testing/other_paraview.sh SUITE [CTEST OPTIONS]

SUITE is bookworm (ParaView 5.11), trixie (5.13) or sid (6.1), or one of them followed by -vtk: that Debian
with its VTK and without ParaView. Debian's ParaView and the Python of Debian's VTK exclude each other.

Makes the root in build-SUITE/root, builds there with warnings as errors, and runs the tests of the numerics,
filters, plugin, window, ranks, package and examples. A later run goes on where the last one has stopped. It
runs a group of tests again if something was built or if the group has failed. The end names the failed and
skipped tests, and fills in the line of the suite in the README. With options for ctest, all groups run with
them, and the README stays as it is. To start anew, delete build-SUITE/. Needs root, the network and 8 GB.

Environment:
  GRIDFEM_JOBS    compilers and tests that run at the same time (default: processors)
  GRIDFEM_ROOT    another folder for the root
  GRIDFEM_GROUPS  only these groups of tests, such as "Plugin Examples", and the README stays as it is
HELP
  exit
fi
NeedRoot

SUITE="$1"
shift
DEBIAN="${SUITE%-vtk}"
BUILD="$SOURCE/build-$SUITE"
mkdir -p "$BUILD/tested"
started=$SECONDS
Stage() { Say "$SUITE, $((SECONDS - started)) s: $*"; }

options=(-DCMAKE_BUILD_TYPE=Release -DGRIDFEM_NATIVE=ON -DGRIDFEM_WERROR=ON -DGRIDFEM_CCACHE=OFF
  -DCMAKE_UNITY_BUILD=ON -DCMAKE_UNITY_BUILD_BATCH_SIZE=10)
if [ "$SUITE" = "$DEBIAN" ]; then
  mapfile -t packages < <(ParaViewPackages "$DEBIAN")
  packages+=("${RUN_PACKAGES[@]}")
  options+=(-DGRIDFEM_BUILD_PYTHON=ON)
  targets=(all)
  groups=(Core Parallel VTK Fuzz Plugin Ranks Package Examples)
else
  packages=("${CORE_PACKAGES[@]}" "${PLAIN_VTK_PACKAGES[@]}")
  options+=(-DGRIDFEM_BUILD_PLUGIN=OFF)
  targets=(Filters/Core/all Filters/VTK/all vtkGridFEMFiltersPython Testing/VTK/all Examples/all)
  groups=(VTK Package Examples)
fi

MakeRoot "$DEBIAN" "${GRIDFEM_ROOT:-$BUILD/root}" "${packages[@]}"
# Usage: VersionOf NAME PACKAGE: prints the name and the version of the package, if it is installed.
VersionOf()
{
  local version
  version="$(InRoot dpkg-query -W -f '${Version}\n' "$2" 2> /dev/null | sed -n '1s/^[0-9]*://; 1s/[-+~].*//p')"
  [ -z "$version" ] || echo "$1 $version"
}
versions="$({
  VersionOf ParaView paraview
  VersionOf VTK libvtk9-dev
  VersionOf GCC g++
  VersionOf Eigen libeigen3-dev
  VersionOf Python python3
} | paste -sd, | sed 's/,/, /g')"
Stage "the root is there, with $versions"

Quietly "$BUILD/configure.log" InRoot cmake -S "$SOURCE" -B "$BUILD" -G Ninja "${options[@]}"
Stage "configured"
Quietly "$BUILD/build.log" InRoot cmake --build "$BUILD" -j "$JOBS" --target "${targets[@]}"
grep -q "no work to do" "$BUILD/build.log" || rm -f "$BUILD"/tested/*
Stage "built"

# Usage: RunGroup GROUP [CTEST OPTION...]
RunGroup()
{
  local group="$1" folder="$BUILD/Testing/$1" result="$BUILD/tested/$1"
  shift
  [ "$group" != Examples ] || folder="$BUILD/Examples"
  [ $# -gt 0 ] || set -- -LE "^Long$"
  [ ! -f "$result.passed" ] || return 0
  if InRoot ctest --test-dir "$folder" --output-on-failure --output-junit "$result.xml" --timeout 300 \
    -j "$JOBS" --no-tests=ignore "$@" > "$result.log" 2>&1 < /dev/null; then
    touch "$result.passed"
  fi
}

[ -z "${GRIDFEM_GROUPS:-}" ] || read -ra groups <<< "$GRIDFEM_GROUPS"
for group in "${groups[@]}"; do
  RunGroup "$group" "$@"
  [ $# -eq 0 ] || rm -f "$BUILD/tested/$group.passed"
  Stage "$group: $(python3 "$SOURCE/Testing/tested.py" "$BUILD/tested/$group.xml")"
done
row=()
if [ $# -eq 0 ] && [ -z "${GRIDFEM_GROUPS:-}" ]; then
  row=(--row "$SUITE" "$versions" "$SOURCE/README.md")
fi
exec python3 "$SOURCE/Testing/tested.py" "$BUILD"/tested/*.xml "${row[@]}"
