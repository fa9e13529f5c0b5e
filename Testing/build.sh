# shellcheck shell=bash disable=SC2034
# Sourced by the run scripts: installs what is missing, configures and builds.
# Gives SOURCE and BUILD (the two folders), Say, InstallMissing and BuildTree.

SOURCE="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
BUILD="$SOURCE/build"
JOBS="${GRIDFEM_JOBS:-$(nproc)}"

CORE_PACKAGES=(cmake ninja-build g++ libeigen3-dev)
# What runs the tests on a build, and what looks at the sources besides.
RUN_PACKAGES=(openmpi-bin python3-pybind11 python3-numpy python3-pip python3-setuptools python3-wheel
  python3-meshio)
TEST_PACKAGES=(clang-format clang libomp-dev "${RUN_PACKAGES[@]}")
BENCHMARK_PACKAGES=(libbenchmark-dev pkg-config libsuitesparse-dev libhypre-dev libpetsc-real-dev
  libspectra-dev libopenblas-dev libopenmpi-dev openmpi-bin slepc-dev libcgal-dev)
PLAIN_VTK_PACKAGES=(ca-certificates libvtk9-dev python3-vtk9 python3-dev python3-numpy
  libopenmpi-dev libcli11-dev libgtest-dev)
FIGURE_PACKAGES=(paraview python3-paraview xvfb xauth)

# Prints the packages that building for the ParaView of a Debian or Ubuntu takes.
ParaViewPackages()
{
  local packages=("${CORE_PACKAGES[@]}" paraview paraview-dev python3-paraview libopenmpi-dev python3-dev
    libcli11-dev libgtest-dev cmark-gfm xvfb xauth)
  case "$1" in
    bookworm | jammy | noble) packages+=(libqt5svg5 qttools5-dev qttools5-dev-tools) ;;
    trixie) packages+=(qt6-svg-plugins qt6-tools-dev qt6-tools-dev-tools) ;;
    # ParaView 6 of Debian is built on the VTK of Debian.
    *) packages+=(qt6-svg-plugins qt6-tools-dev qt6-tools-dev-tools libvtk9-dev libjsoncpp-dev) ;;
  esac
  printf '%s\n' "${packages[@]}"
}

# The name of this Debian or Ubuntu, such as bookworm; empty elsewhere.
SuiteOfHere() { (. /etc/os-release 2> /dev/null && echo "${VERSION_CODENAME:-}") || true; }

mapfile -t BUILD_PACKAGES < <(ParaViewPackages "$(SuiteOfHere)")

Say() { printf '%s\n' "-- $*" >&2; }

# A mistyped folder would skip the tests that need it.
RequireMeshes()
{
  if [ -n "${GRIDFEM_DATA_DIR:-}" ] && [ ! -d "$GRIDFEM_DATA_DIR" ]; then
    Say "GRIDFEM_DATA_DIR is no folder: $GRIDFEM_DATA_DIR"
    return 1
  fi
}

# Runs a command with its output kept in a file; shows the end of that only when the command fails.
Quietly()
{
  local log="$1"
  shift
  if ! "$@" > "$log" 2>&1 < /dev/null; then
    tail -n 60 "$log" >&2
    Say "That did not work: $* (all of its output: $log)"
    return 1
  fi
}

IsInstalled()
{
  [ "$(dpkg-query -W -f='${Status}' "$1" 2> /dev/null)" = "install ok installed" ]
}

# Installs the given Debian packages that are missing.
InstallMissing()
{
  if ! command -v dpkg-query > /dev/null || ! command -v apt-get > /dev/null; then
    Say "This is not Debian or Ubuntu. Needed are what these packages hold there: $*"
    return
  fi
  local missing=() package
  for package in "$@"; do
    IsInstalled "$package" || missing+=("$package")
  done
  [ ${#missing[@]} -gt 0 ] || return 0

  local root=()
  if [ "$(id -u)" -ne 0 ]; then
    if ! command -v sudo > /dev/null; then
      Say "Install these as root, then run this again: ${missing[*]}"
      return 1
    fi
    root=(sudo)
  fi
  mkdir -p "$BUILD"
  Say "Installing ${missing[*]}"
  [ ${#root[@]} -eq 0 ] || sudo -v
  Quietly "$BUILD/install.log" "${root[@]}" apt-get update
  Quietly "$BUILD/install.log" "${root[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get install -y --no-install-recommends "${missing[@]}"
}

# Configures when options differ from the last time, then builds what has changed.
# Usage: BuildTree "TARGETS" [-DOPTION=VALUE...]
BuildTree()
{
  local targets
  read -ra targets <<< "$1"
  shift
  # From nothing, libraries take half of the time when ten files are compiled at a time.
  local ci=OFF
  [ "${CI:-}" != "true" ] || ci=ON
  local options=(-DCMAKE_BUILD_TYPE=Release -DGRIDFEM_NATIVE=ON "$@" "-DGRIDFEM_WERROR=$ci" "-DCMAKE_UNITY_BUILD=$ci"
    -DCMAKE_UNITY_BUILD_BATCH_SIZE=10)
  mkdir -p "$BUILD"
  if [ ! -f "$BUILD/build.ninja" ] ||
    [ "${options[*]}" != "$(cat "$BUILD/options" 2> /dev/null)" ]; then
    Say "Configuring"
    Quietly "$BUILD/configure.log" cmake -S "$SOURCE" -B "$BUILD" -G Ninja "${options[@]}"
    printf '%s\n' "${options[*]}" > "$BUILD/options"
  fi
  Say "Building"
  # Ninja's own status line on a terminal; in a log only what goes wrong.
  if [ -t 2 ]; then
    cmake --build "$BUILD" --target "${targets[@]}" -j "$JOBS" >&2
  else
    Quietly "$BUILD/build.log" cmake --build "$BUILD" --target "${targets[@]}" -j "$JOBS"
  fi
}
