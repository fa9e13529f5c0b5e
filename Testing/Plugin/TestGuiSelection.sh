# Drives the real program: points selected with the mouse, copied into the panels of two filters, and a
# curve drawn in its editor; then reads the saved state back and looks at the results.
set -eu
here=$(dirname "$(readlink -f "$0")")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

command -v paraview > /dev/null || { echo "skipped: no paraview program"; exit 77; }
pvpython "$here/Gui/write_colored_sphere.py" "$work/sphere.vtp"
sed "s|@STATE@|$work/gui.pvsm|" "$here/Gui/SelectAndDraw.xml" > "$work/events.xml"
XDG_CONFIG_HOME="$work" timeout 400 paraview --dr --data="$work/sphere.vtp" \
  --plugins GridFEM --plugin-search-paths "$(dirname "$GRIDFEM_PLUGIN")" \
  --test-directory="$work" --test-script="$work/events.xml" --exit
pvpython "$here/Gui/check_selection.py" "$work/gui.pvsm"
