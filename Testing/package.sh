#!/usr/bin/env bash
# Makes the Debian package and tries it in a new root that has nothing else.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/build.sh"
BUILD="$SOURCE/build-package"

if [ "${1:-}" = "--help" ] || [ "${1:-}" = "-h" ]; then
  cat << 'HELP'
Usage: Testing/package.sh

Makes the Debian package in build-package/, for any processor of this architecture and with Core once
more for each of the newer ones; has lintian look at it; makes a root with nothing but the base of this
Debian in a temporary folder; installs the package there, which brings ParaView along; and runs it: the
plugin in pvpython, the functions of numpy arrays, and which Core the loader takes. Needs root, the
network and 4 GB of disk.
HELP
  exit
fi
if [ "$(id -u)" -ne 0 ]; then
  Say "Run this as root: a root file system is made."
  exit 1
fi

InstallMissing "${BUILD_PACKAGES[@]}" dpkg-dev file lintian mmdebstrap
mkdir -p "$BUILD"
cd "$SOURCE"
Quietly "$BUILD/configure.log" cmake --preset package
Say "Building"
Quietly "$BUILD/build.log" cmake --build "$BUILD" -j "$JOBS"
(cd "$BUILD" && rm -f ./*.deb && cpack > cpack.log)
PACKAGE="$(ls "$BUILD"/gridfem_*.deb)"
dpkg-deb --info "$PACKAGE" | grep -E "Version|Depends|Installed-Size"
# The first three: one package holds libraries, what links to them, and plugins. The last: cpack's own.
ONE_PACKAGE=link-to-shared-library-in-wrong-package,package-name-doesnt-match-sonames
ONE_PACKAGE+=,shared-library-lacks-version
lintian --allow-root --fail-on error,warning \
  --suppress-tags "$ONE_PACKAGE,maintscript-calls-ldconfig" "$PACKAGE"

ROOT="$(mktemp -d)"
trap 'rm -rf "$ROOT"' EXIT
SUITE="$(. /etc/os-release && echo "$VERSION_CODENAME")"
Say "Making a root of $SUITE in $ROOT, and installing the package there"
cp "$PACKAGE" "$BUILD/gridfem.deb"
mmdebstrap --quiet --variant=minbase \
  --customize-hook="copy-in $BUILD/gridfem.deb $SOURCE/Testing/Package/try_package.py /srv" \
  --customize-hook='chroot "$1" apt-get install -y -qq --no-install-recommends /srv/gridfem.deb \
    paraview python3-paraview python3-numpy xvfb xauth > /dev/null 2>&1' \
  --customize-hook='chroot "$1" sh -c "PV_PLUGIN_CONFIG_FILE=\$(dpkg -L gridfem | grep plugins.xml) \
    xvfb-run -a pvpython /srv/try_package.py"' \
  "$SUITE" "$ROOT/root.tar"
