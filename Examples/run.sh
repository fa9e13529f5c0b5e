#!/usr/bin/env bash
# The main job: octree, basis, Poisson solution, Laplace spectrum and flow of a mesh.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../Testing/build.sh"

if [ "${1:-}" = "--help" ] || [ "${1:-}" = "-h" ]; then
  cat << 'HELP'
Usage: Examples/run.sh [MESH] [--depth N] [--modes K] [--output DIR]

Installs the Debian packages that are missing (as root or with sudo), builds the programs, the plugin
and the Python package into build/, and runs the main job on MESH (.ply .obj .stl .vtp .vtk), or without
one on a trefoil-knot tube whose strands nearly touch. The results and pictures of the eigenfunctions go
to DIR (default: output/).

  --depth N     2^N cells along the longest side, 2 to 14
  --modes K     number of eigenfunctions
  --output DIR  folder for the results
HELP
  exit
fi

# The folder is needed here too; the program checks the rest of the arguments.
output="$SOURCE/output"
arguments=()
while [ $# -gt 0 ]; do
  case "$1" in
    --output)
      [ $# -gt 1 ] || { Say "--output needs a folder"; exit 2; }
      output="$2"
      shift
      ;;
    --output=*) output="${1#--output=}" ;;
    *) arguments+=("$1") ;;
  esac
  shift
done

InstallMissing "${BUILD_PACKAGES[@]}"
BuildTree "gridfem_main_job GridFEM vtkGridFEMFiltersPython" # with the plugin and the Python package
# Threads that spin while they wait would starve each other on a busy machine.
export OMP_WAIT_POLICY="${OMP_WAIT_POLICY:-passive}"
"$BUILD/bin/gridfem_main_job" "${arguments[@]}" --output "$output"

Say "Rendering the eigenfunctions"
if command -v xvfb-run > /dev/null; then
  xvfb-run -a pvpython "$SOURCE/Examples/Python/contact_sheet.py" "$output" < /dev/null
else
  pvpython "$SOURCE/Examples/Python/contact_sheet.py" "$output" < /dev/null
fi
Say "The results are in $output"
