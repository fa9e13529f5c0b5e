#!/usr/bin/env bash
# Test of the main job where files cannot grow, as on a full disk: it names the file and fails.
# Usage: full_disk.sh PROGRAM FOLDER
set -euo pipefail
program="$1"
folder="$2"

trap '' XFSZ # so that a write beyond the limit is an error, as on a full disk, and no signal
for kilobytes in 0 1 64 1024 4096 unlimited; do
  rm -rf "$folder"
  result=0
  message="$( (ulimit -f "$kilobytes" && exec "$program" --depth 4 --modes 4 --output "$folder") \
    2>&1 > /dev/null < /dev/null)" || result=$?
  written="$(find "$folder" -type f | wc -l)"
  echo "$kilobytes kB: exit code $result, $written files, '$message'"
  case "$kilobytes:$result:$written:$message" in
    unlimited:0:14:) ;;
    [0-9]*:1:*"The file $folder/"*" is incomplete. Is the disk full?"*) ;;
    *)
      echo "This is wrong."
      exit 1
      ;;
  esac
done
