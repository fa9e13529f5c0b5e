#!/usr/bin/env bash
# A client that connects to a server, as users of ParaView do: to one process, and to two ranks.
set -euo pipefail

folder="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
work="$(mktemp -d)"
server=
trap 'kill $server 2> /dev/null || true; rm -rf "$work"' EXIT

# Serve RANKS COMMAND...: starts the server with the command, and looks at it from the client.
Serve()
{
  local ranks="$1" log="$work/server_$1.log" port
  port="$(python3 -c 'import socket; s = socket.socket(); s.bind(("", 0)); print(s.getsockname()[1])')"
  # Ends by itself even if this script is killed for taking too long.
  timeout 110 "${@:2}" --server-port="$port" > "$log" 2>&1 &
  server=$!
  for _ in $(seq 100); do
    grep -q "Accepting connection" "$log" && break
    sleep 0.2
  done
  if ! timeout 100 pvpython "$folder/client.py" "$port" "$ranks" "$work" > "$work/client.log" 2>&1; then
    cat "$work/client.log" "$log"
    exit 1
  fi
  # The client has left: all ranks end by themselves.
  wait "$server"
  cat "$work/client.log"
}

Serve 1 pvserver
Serve 2 mpiexec -n 2 pvserver
