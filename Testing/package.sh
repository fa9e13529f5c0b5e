#!/usr/bin/env bash
# Makes the Debian package and tries it in a new root that has nothing else.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/build.sh"
source "$(dirname "${BASH_SOURCE[0]}")/roots.sh"

if [ "${1:-}" = "--help" ] || [ "${1:-}" = "-h" ]; then
  cat << 'HELP'
Usage: Testing/package.sh [SUITE]

Makes the Debian package of a suite, such as trixie (default: this Debian), in build-package-SUITE/, for any
processor of this architecture and with Core once more for each of the newer ones. The package of another suite
is built in the root of Testing/other_paraview.sh. Then lintian looks at the package; a root with nothing but the
base of the suite is made in a temporary folder; the package is installed there, which brings ParaView along; and
it runs: the plugin in pvpython, the functions of numpy arrays, and which Core the loader takes. Needs root, the
network and 4 GB of disk.

Environment:
  GRIDFEM_ROOT           the root of another suite, where it is not build-SUITE/root
  DEBFULLNAME, DEBEMAIL  the maintainer of the package
HELP
  exit
fi
NeedRoot

SUITE="${1:-$(SuiteOfHere)}"
BUILD="$SOURCE/build-package-$SUITE"
mkdir -p "$BUILD"
mapfile -t packages < <(ParaViewPackages "$SUITE")
packages+=(dpkg-dev file lintian)
if [ "$SUITE" = "$(SuiteOfHere)" ]; then
  InstallMissing "${packages[@]}" mmdebstrap
  InSuite() { "$@"; }
else
  InstallMissing mmdebstrap
  MakeRoot "$SUITE" "${GRIDFEM_ROOT:-$SOURCE/build-$SUITE/root}" "${packages[@]}"
  InSuite() { InRoot "$@"; }
fi

Quietly "$BUILD/configure.log" InSuite cmake --preset package -S "$SOURCE" -B "$BUILD"
Say "Building"
Quietly "$BUILD/build.log" InSuite cmake --build "$BUILD" -j "$JOBS"
rm -f "$BUILD"/*.deb
Quietly "$BUILD/cpack.log" InSuite cpack --config "$BUILD/CPackConfig.cmake" -B "$BUILD"
PACKAGE="$(ls "$BUILD"/gridfem_*.deb)"
InSuite dpkg-deb --info "$PACKAGE" | grep -E "Version|Depends|Installed-Size"
# The first three: one package holds libraries, what links to them, and plugins. The last: cpack's own.
ONE_PACKAGE=link-to-shared-library-in-wrong-package,package-name-doesnt-match-sonames
ONE_PACKAGE+=,shared-library-lacks-version
InSuite lintian --allow-root --fail-on error,warning \
  --suppress-tags "$ONE_PACKAGE,maintscript-calls-ldconfig" "$PACKAGE"

PLACE="$(mktemp -d)"
trap 'rm -rf "$PLACE"' EXIT
mapfile -t options < <(RootOptions "$SUITE")
Say "Making a root of $SUITE in $PLACE, and installing the package there"
cp "$PACKAGE" "$PLACE/gridfem.deb" # the hook splits its line at spaces
cp "$SOURCE/Testing/Package/try_package.py" "$PLACE"
mmdebstrap --quiet --variant=minbase "${options[@]}" \
  --customize-hook="copy-in $PLACE/gridfem.deb $PLACE/try_package.py /srv" \
  --customize-hook='chroot "$1" apt-get install -y -qq --no-install-recommends /srv/gridfem.deb \
    paraview python3-paraview python3-numpy xvfb xauth > /dev/null 2>&1' \
  --customize-hook='chroot "$1" sh -c "PV_PLUGIN_CONFIG_FILE=\$(dpkg -L gridfem | grep plugins.xml) \
    xvfb-run -a pvpython /srv/try_package.py"' \
  "$SUITE" "$PLACE/root.tar"
Say "$(basename "$PACKAGE") works in $SUITE. Install it there as root:"
echo "apt install $PACKAGE"
