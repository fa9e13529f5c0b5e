# Drives the real program: a sphere, every filter of the menu Surface FEM with Apply, the state saved;
# then reads the state back and looks at the results.
source "$(dirname "$(readlink -f "$0")")/Gui/drive.sh"

Drive ApplyFilters.xml check_state.py
