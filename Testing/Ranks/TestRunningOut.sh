#!/usr/bin/env bash
# Memory that runs out on one rank alone: each run ends soon, with a result or one message, and the ranks
# go on. Small limits are refused, large ones are enough.
set -euo pipefail

folder="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
refused=0
computed=0
for megabytes in 0 32 48 1000; do
  code=0
  output="$(timeout 50 mpiexec -n 2 pvbatch --symmetric "$folder/running_out.py" "$megabytes" 2>&1)" ||
    code=$?
  echo "$megabytes MB: $(tail -n 1 <<< "$output")"
  if [ "$code" = 0 ] && grep -q "^computed" <<< "$output"; then
    computed=$((computed + 1))
  elif [ "$code" = 0 ] && grep -q "Rank 1: .*memory" <<< "$output"; then
    refused=$((refused + 1))
  else
    echo "exit code $code:"
    echo "$output"
    exit 1
  fi
done
if [ "$refused" -lt 2 ] || [ "$computed" -lt 1 ]; then
  echo "$refused limits were refused, $computed were enough"
  exit 1
fi
