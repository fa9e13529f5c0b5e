# Drives the real program: a sphere, every filter of the menu Surface FEM with Apply, the state saved;
# then reads the state back and looks at the results.
set -eu
here=$(dirname "$(readlink -f "$0")")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

command -v paraview > /dev/null || { echo "skipped: no paraview program"; exit 77; }
sed "s|@STATE@|$work/gui.pvsm|" "$here/Gui/ApplyFilters.xml" > "$work/events.xml"
XDG_CONFIG_HOME="$work" timeout 400 paraview --dr \
  --plugins GridFEM --plugin-search-paths "$(dirname "$GRIDFEM_PLUGIN")" \
  --test-directory="$work" --test-script="$work/events.xml" --exit
pvpython "$here/Gui/check_state.py" "$work/gui.pvsm"
