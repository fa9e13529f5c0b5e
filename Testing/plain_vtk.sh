#!/usr/bin/env bash
# Builds the filters against Debian's VTK, without ParaView, in a root of their own, and tests them there.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/build.sh"
BUILD="$SOURCE/build-plain-vtk${GRIDFEM_SUITE:+-$GRIDFEM_SUITE}"
ROOT="${GRIDFEM_ROOT:-$BUILD/root}"

if [ "${1:-}" = "--help" ] || [ "${1:-}" = "-h" ]; then
  cat << 'HELP'
Usage: Testing/plain_vtk.sh [CTEST OPTIONS]

Debian's ParaView and the Python of Debian's VTK exclude each other, so this makes a root of its own in
build-plain-vtk/root: this Debian with libvtk9-dev (9.1 in Debian 12) and without ParaView. It builds the
filters, the Python package and the C++ examples there with GRIDFEM_BUILD_PLUGIN=OFF, warnings being
errors, and runs the tests of what needs VTK. Options go to ctest. Later runs use the root again; to
start anew, delete it. Needs root, the network and 3 GB of disk.

Environment:
  GRIDFEM_JOBS   compilers and tests that run at the same time (default: processors)
  GRIDFEM_ROOT   another folder for the root
  GRIDFEM_SUITE  another Debian with another VTK, such as trixie (9.3), in build-plain-vtk-trixie/
HELP
  exit
fi
if [ "$(id -u)" -ne 0 ]; then
  Say "Run this as root: a root file system is made."
  exit 1
fi

mkdir -p "$BUILD"
if [ ! -f "$ROOT/made" ]; then
  InstallMissing mmdebstrap
  mkdir -p "$ROOT"
  if [ -n "$(ls -A "$ROOT")" ]; then
    Say "$ROOT is not empty, and no root that was finished here. Delete it, or take another folder."
    exit 1
  fi
  packages=("${CORE_PACKAGES[@]}" "${PLAIN_VTK_PACKAGES[@]}")
  suite="${GRIDFEM_SUITE:-$(. /etc/os-release && echo "$VERSION_CODENAME")}"
  Say "Making a root of $suite with VTK in $ROOT"
  Quietly "$BUILD/root.log" mmdebstrap --variant=apt --aptopt='APT::Install-Recommends "false"' \
    --include="$(IFS=,; echo "${packages[*]}")" "$suite" "$ROOT"
  touch "$ROOT/made"
fi

# The sources are seen in the root under their own path. These mounts end with the commands in it.
export BUILD JOBS ROOT SOURCE
InRoot()
{
  unshare --mount bash -euc '
    mkdir -p "$ROOT$SOURCE" "$ROOT/ccache"
    mount --bind "$SOURCE" "$ROOT$SOURCE"
    mount -t proc proc "$ROOT/proc"
    mount --bind /dev "$ROOT/dev"
    if command -v ccache > /dev/null; then
      mkdir -p "$(ccache -k cache_dir)"
      mount --bind "$(ccache -k cache_dir)" "$ROOT/ccache"
    fi
    exec chroot "$ROOT" env -u LC_ALL HOME=/root LANG=C.UTF-8 OMP_WAIT_POLICY=passive \
      CCACHE_DIR=/ccache CCACHE_BASEDIR="$SOURCE" CCACHE_NOHASHDIR=1 "$@"' - "$@"
}

Say "Configuring"
Quietly "$BUILD/configure.log" InRoot cmake -S "$SOURCE" -B "$BUILD" -G Ninja \
  -DCMAKE_BUILD_TYPE=Release -DGRIDFEM_WERROR=ON -DGRIDFEM_BUILD_PLUGIN=OFF
grep "VTK 9" "$BUILD/configure.log" >&2 || true
Say "Building"
Quietly "$BUILD/build.log" InRoot cmake --build "$BUILD" -j "$JOBS" \
  --target Filters/Core/all Filters/VTK/all vtkGridFEMFiltersPython Testing/VTK/all Examples/all
Say "Testing"
result=0
for folder in Testing/VTK Testing/Package Examples; do
  InRoot ctest --test-dir "$BUILD/$folder" --output-on-failure --timeout 300 -j "$JOBS" \
    --no-tests=ignore "$@" < /dev/null || result=1
done
exit $result
