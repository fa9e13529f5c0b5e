# Drives the real program: a sphere, a long chain of filters of the menu Surface FEM with Apply, the state
# saved; then reads the state back and looks at the results. TestGuiEdits.sh has every filter alone.
source "$(dirname "$(readlink -f "$0")")/Gui/drive.sh"

Drive ApplyFilters.xml check_state.py
