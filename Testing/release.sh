#!/usr/bin/env bash
# Puts together everything that a release consists of.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/build.sh"

if [ "${1:-}" = "--help" ] || [ "${1:-}" = "-h" ]; then
  cat << 'HELP'
Usage: Testing/release.sh [SUITE...]

Writes into build-release/ the files of a release of the version in CMakeLists.txt:

  gridfem-VERSION.tar.gz     the sources of the last commit
  gridfem_VERSION..._*.deb   the Debian package of each suite, by package.sh (default: bookworm trixie)
  NOTES.md                   the section of CHANGELOG.md about this version
  SHA256SUMS                 checksums of all other files

Refuses changes that are not committed, and a version without a section in CHANGELOG.md. Needs what
package.sh needs, and the maintainer of the packages in DEBFULLNAME and DEBEMAIL.
HELP
  exit
fi

cd "$SOURCE"
if [ -n "$(git status --porcelain)" ]; then
  Say "Commit all changes first: a release has the sources of a commit"
  exit 1
fi
if [ -z "${DEBFULLNAME:-}" ] || [ -z "${DEBEMAIL:-}" ]; then
  Say "Set DEBFULLNAME and DEBEMAIL to the name and the address of the maintainer"
  exit 1
fi
VERSION="$(sed -n 's/^project(GridFEM VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)"
NOTES="$(awk -v start="## $VERSION " 'index($0, "## ") == 1 { inside = index($0, start) == 1 } inside' CHANGELOG.md)"
if [ -z "$NOTES" ]; then
  Say "CHANGELOG.md has no section ## $VERSION"
  exit 1
fi

[ $# -gt 0 ] || set -- bookworm trixie
RELEASE="$SOURCE/build-release"
rm -rf "$RELEASE"
mkdir "$RELEASE"
printf '%s\n' "$NOTES" > "$RELEASE/NOTES.md"
git archive --format=tar.gz --prefix="gridfem-$VERSION/" -o "$RELEASE/gridfem-$VERSION.tar.gz" HEAD
for suite in "$@"; do
  "$SOURCE/Testing/package.sh" "$suite"
  cp "$SOURCE/build-package-$suite/"gridfem_*.deb "$RELEASE"
done
(cd "$RELEASE" && sha256sum -- *.tar.gz *.deb NOTES.md > SHA256SUMS)
Say "GridFEM $VERSION is in $RELEASE"
