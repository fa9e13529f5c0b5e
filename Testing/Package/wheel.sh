#!/usr/bin/env bash
# Usage: wheel.sh PYTHON FOLDER: packs the sources, builds the wheel of them without a network, installs it
# into the folder and tests it there. GRIDFEM_BUILD_DIR: where CMake has built its module already; else all is compiled,
# as `pip install .` does.
set -euo pipefail
python="$1"
folder="$2"
source="$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)"

rm -rf "$folder"
mkdir -p "$folder"
(cd "$source" && "$python" setup.py --quiet sdist --dist-dir "$folder")
tar xzf "$folder"/gridfem-*.tar.gz -C "$folder"
"$python" -m pip --disable-pip-version-check wheel "$folder"/gridfem-*/ --wheel-dir "$folder" --no-deps \
  --no-index --no-build-isolation
"$python" -m pip --disable-pip-version-check install "$folder"/gridfem-*.whl --target \
  "$folder/site" --no-deps --no-index
cd "$folder"
"$python" "$source/Testing/Package/TestWheel.py" "$folder/site" "$source/Testing/Plugin"
