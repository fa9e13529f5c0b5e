# shellcheck shell=bash
# Sourced by scripts that build for another Debian, after build.sh: makes a root file system, and runs commands
# in it. The commands see the sources under their own path. Gives NeedRoot, RootOptions, MakeRoot and InRoot.

# Fails unless the caller is root, because only root can make a root file system.
NeedRoot()
{
  if [ "$(id -u)" -ne 0 ]; then
    Say "Run this as root: a root file system is made."
    return 1
  fi
}

# Prints the options that mmdebstrap needs for a suite.
RootOptions()
{
  # The date in sid's list of files can be older than apt accepts.
  [ "$1" != sid ] || printf '%s\n' --aptopt='Acquire::Check-Valid-Until "false"'
}

# Makes the root of a suite with packages, or adds the packages that a finished root lacks. InRoot uses this root.
# Usage: MakeRoot SUITE FOLDER PACKAGE...
MakeRoot()
{
  local suite="$1" missing=() options package
  ROOT="$2"
  shift 2
  mkdir -p "$BUILD" "$ROOT"
  if [ ! -f "$ROOT/made" ]; then
    InstallMissing mmdebstrap
    if [ -n "$(ls -A "$ROOT")" ]; then
      Say "$ROOT is not empty, and no root that was finished here. Delete it, or take another folder."
      return 1
    fi
    Say "Making a root of $suite in $ROOT"
    mapfile -t options < <(RootOptions "$suite")
    Quietly "$BUILD/root.log" mmdebstrap --variant=apt --aptopt='APT::Install-Recommends "false"' \
      --dpkgopt=force-unsafe-io "${options[@]}" --include="$(IFS=,; echo "$*")" "$suite" "$ROOT"
    printf '%s\n' "$@" > "$ROOT/made"
  fi
  for package in "$@"; do
    grep -qFx "$package" "$ROOT/made" || missing+=("$package")
  done
  [ ${#missing[@]} -gt 0 ] || return 0
  Say "Adding ${missing[*]} to $ROOT"
  Quietly "$BUILD/root.log" InRoot apt-get update
  Quietly "$BUILD/root.log" InRoot env DEBIAN_FRONTEND=noninteractive apt-get install -y "${missing[@]}"
  printf '%s\n' "${missing[@]}" >> "$ROOT/made"
}

# Runs a command in the root, with the folder of real meshes, if there is one. Its mounts end with it.
InRoot()
{
  ROOT="$ROOT" SOURCE="$SOURCE" MESHES="${GRIDFEM_DATA_DIR:-$SOURCE/../shared/data}" unshare --mount bash -euc '
    mkdir -p "$ROOT$SOURCE"
    mount --bind "$SOURCE" "$ROOT$SOURCE"
    if [ -d "$MESHES" ]; then
      mkdir -p "$ROOT$MESHES"
      mount --bind "$MESHES" "$ROOT$MESHES"
    fi
    mount -t proc proc "$ROOT/proc"
    mount --rbind /dev "$ROOT/dev"
    mount --rbind /sys "$ROOT/sys"
    exec chroot "$ROOT" env -u LC_ALL -u TMPDIR HOME=/root LANG=C.UTF-8 OMP_WAIT_POLICY=passive \
      PATH=/usr/sbin:/usr/bin:/sbin:/bin "$@"' - "$@"
}
