#!/usr/bin/env bash
# Usage: upgrade.sh: builds a file of Core with the functions of the run scripts, as a user who is not root,
# in a folder with a space: in a folder that an older release has built, once more, and in a new one.
set -euo pipefail
source="$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)"

# In the folder of the system for what is temporary, because nobody else may be let into this one.
if [ "${1:-}" != "--here" ]; then
  place="$(mktemp -d)"
  trap 'rm -rf "$place"' EXIT
  clone="$place/a clone"
  mkdir -p "$clone/Filters" "$clone/Testing/Package"
  cp -r "$source"/CMakeLists.txt "$source"/CMake "$source"/{LICENSE,README.md,CHANGELOG.md} "$clone"
  cp -r "$source"/Filters/{Core,Device} "$clone/Filters"
  cp "$source/Testing/build.sh" "$clone/Testing"
  cp "$source/Testing/Package/upgrade.sh" "$clone/Testing/Package"
  chmod -R u=rwX,go=rX "$place"
  user=()
  if [ "$(id -u)" -eq 0 ]; then
    chown -R 65534:65534 "$place"
    user=(setpriv --reuid=65534 --regid=65534 --clear-groups)
  fi
  cd "$place"
  # BuildTree keeps the output of what is no terminal.
  "${user[@]}" env -u CCACHE_DIR HOME=/nonexistent bash "$clone/Testing/Package/upgrade.sh" --here 2>&1 | cat
  exit
fi

source "$source/Testing/build.sh"
unset CI # which compiles several files at a time
JOBS=1
OBJECTS=Filters/Core/CMakeFiles/gridfem_core.dir/Base
OPTIONS=(-DGRIDFEM_BUILD_VTK=OFF -DGRIDFEM_BUILD_TESTING=OFF -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON)

Fail()
{
  Say "$*"
  exit 1
}

# The packages are there, so that neither root nor sudo is asked for.
InstallMissing "${CORE_PACKAGES[@]}"

# An older release, with other files and other options.
mv "$SOURCE/Filters/Core/Base/ShortWaits.cxx" "$SOURCE/kept.cxx"
echo "int GoneSince() { return 0; }" > "$SOURCE/Filters/Core/Base/GoneSince.cxx"
BuildTree "$OBJECTS/GoneSince.cxx.o" "${OPTIONS[@]}" -DGRIDFEM_NATIVE=OFF -DGRIDFEM_GONE_SINCE=ON
rm "$SOURCE/Filters/Core/Base/GoneSince.cxx"
mv "$SOURCE/kept.cxx" "$SOURCE/Filters/Core/Base/ShortWaits.cxx"

# First with the options that it had, as after `git pull`, then with the options of this release.
for newer in "-DGRIDFEM_NATIVE=OFF -DGRIDFEM_GONE_SINCE=ON" "-DGRIDFEM_NATIVE=ON"; do
  read -ra newer <<< "$newer"
  BuildTree "$OBJECTS/ShortWaits.cxx.o" "${OPTIONS[@]}" "${newer[@]}"
  [ -f "$BUILD/$OBJECTS/ShortWaits.cxx.o" ] || Fail "A new file is not built in an old folder"
  ! grep -q GoneSince "$BUILD/build.ninja" || Fail "An old file is still built"
  BuildTree "$OBJECTS/ShortWaits.cxx.o" "${OPTIONS[@]}" "${newer[@]}"
  grep -q "no work to do" "$BUILD/build.log" || Fail "A second run builds again"
done

rm -r "$BUILD"
BuildTree "$OBJECTS/ShortWaits.cxx.o" "${OPTIONS[@]}"
[ -f "$BUILD/$OBJECTS/ShortWaits.cxx.o" ] || Fail "Nothing is built in a new folder"
