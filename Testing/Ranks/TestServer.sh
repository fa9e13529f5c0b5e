#!/usr/bin/env bash
# A client that connects to a server of two ranks, as users of ParaView do.
set -euo pipefail

folder="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
work="$(mktemp -d)"
port="$(python3 -c 'import socket; s = socket.socket(); s.bind(("", 0)); print(s.getsockname()[1])')"

# Ends by itself even if this script is killed for taking too long.
timeout 110 mpiexec -n 2 pvserver --server-port="$port" > "$work/server.log" 2>&1 &
server=$!
trap 'kill "$server" 2> /dev/null || true; rm -rf "$work"' EXIT

for _ in $(seq 100); do
  grep -q "Accepting connection" "$work/server.log" && break
  sleep 0.2
done
if ! timeout 100 pvpython "$folder/client.py" "$port" "$work" > "$work/client.log" 2>&1; then
  cat "$work/client.log" "$work/server.log"
  exit 1
fi
# The client has left: both ranks end by themselves.
wait "$server"
cat "$work/client.log"
