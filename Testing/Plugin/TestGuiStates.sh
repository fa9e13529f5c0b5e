# Drives the real program with filters that the user has not made in it: a script with values that are the
# defaults, and a state whose filter is played, deleted and brought back by undo. Then it opens an example, which
# asks whether it may close the pipeline. All in one window.
source "$(dirname "$(readlink -f "$0")")/Gui/drive.sh"

pvpython "$here/Gui/write_states.py" "$work"
Play "$work/states.xml"
pvpython "$here/Gui/check_states.py" "$work"
