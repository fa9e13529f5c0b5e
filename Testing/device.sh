#!/usr/bin/env bash
# Tests the cycles on the GPU of this machine, and measures them.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/build.sh"

if [ "${1:-}" = "--help" ] || [ "${1:-}" = "-h" ]; then
  cat << 'HELP'
Usage: Testing/device.sh [--build | --run FOLDER]

Builds Core, the GPU library and two programs in build-device/. Runs the tests of devices on the GPU,
and again with compute-sanitizer if it is installed. Then prints a table of times and RATIO lines.

  --build        only builds, for x86-64-v3 (AVX2)
  --run FOLDER   only runs the programs of --build. FOLDER contains build-device/ and the real
                 meshes. No compiler is needed

Environment:
  GRIDFEM_DATA_DIR   folder of real meshes (default: ../shared/data beside the sources)
HELP
  exit
fi

Build()
{
  InstallMissing "${CORE_PACKAGES[@]}" libgtest-dev
  local folder="$SOURCE/build-device"
  mkdir -p "$folder"
  Say "Building"
  Quietly "$folder/configure.log" cmake -S "$SOURCE" -B "$folder" -G Ninja -DCMAKE_BUILD_TYPE=Release \
    -DGRIDFEM_BUILD_VTK=OFF -DGRIDFEM_MPI=OFF -DGRIDFEM_NATIVE=OFF -DCMAKE_CXX_FLAGS=-march=x86-64-v3 \
    -DCMAKE_BUILD_RPATH_USE_ORIGIN=ON -DCMAKE_UNITY_BUILD=ON -DCMAKE_UNITY_BUILD_BATCH_SIZE=10
  Quietly "$folder/build.log" cmake --build "$folder" -j "$JOBS" \
    --target TestDeviceHierarchy MeasureDevice gridfem_cuda
}

# Usage: Run FOLDER MESHES
Run()
{
  export GRIDFEM_DEVICE_LIBRARY="$1/lib/libgridfem_cuda.so" GRIDFEM_DATA_DIR="$2"
  nvidia-smi --query-gpu=name,driver_version --format=csv,noheader
  "$1/bin/TestDeviceHierarchy" --gtest_brief=1
  if command -v compute-sanitizer > /dev/null; then
    compute-sanitizer --error-exitcode 1 "$1/bin/TestDeviceHierarchy" --gtest_brief=1
  else
    Say "compute-sanitizer is not installed"
  fi
  "$1/bin/MeasureDevice" "$2"
}

case "${1:-}" in
  --build) Build ;;
  --run) Run "$2/build-device" "$2" ;;
  *)
    Build
    Run "$SOURCE/build-device" "${GRIDFEM_DATA_DIR:-$SOURCE/../shared/data}"
    ;;
esac
