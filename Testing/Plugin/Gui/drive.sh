# Sourced by the tests that drive the real program: plays events in it and looks at the state that they
# have saved.
set -eu
here=$(dirname "$(readlink -f "$0")")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

command -v paraview > /dev/null || { echo "skipped: no paraview program"; exit 77; }

# Play EVENTS.xml [OPTION OF PARAVIEW...]
# Fails also if ParaView shows an error, which is red in the window.
Play() {
  # From ParaView 5.12 on, a menu has its submenus only after it was opened.
  sed -i '/menuFilters.Surface FEM/i\  <pqevent object="pqClientMainWindow/menubar" command="activate" arguments="menuFilters" />' "$1"
  local status=0
  XDG_CONFIG_HOME="$work" timeout 560 paraview --dr "${@:2}" \
    --plugins=GridFEM --plugin-search-paths="$(dirname "$GRIDFEM_PLUGIN")" \
    --test-directory="$work" --test-script="$1" --exit > "$work/messages" 2>&1 || status=$?
  cat "$work/messages"
  if grep -F "ERR|" "$work/messages" > "$work/errors"; then
    echo "the window shows $(wc -l < "$work/errors") errors in red"
    return 1
  fi
  return "$status"
}
