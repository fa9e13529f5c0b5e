#!/usr/bin/env bash
# A surface that one rank refuses, because its process may not grow so far: four ranks compute on it, each
# under the same limit.
set -euo pipefail

folder="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
megabytes=125
export OMP_NUM_THREADS=1 # stacks of threads count

Expect()
{
  local ranks="$1" pattern="$2" output
  output="$(timeout 50 mpiexec -n "$ranks" pvbatch --symmetric "$folder/running_out.py" "$megabytes" each 2>&1)" || {
    echo "$output"
    exit 1
  }
  echo "$ranks ranks: $(tail -n 1 <<< "$output")"
  grep -q "$pattern" <<< "$output"
}

Expect 1 "Depth 7 .*needs about .* GB of memory, but only .* GB are free"
Expect 4 "^computed"
