# Drives the real program: opens a file, and with every filter of the menu Surface FEM in turn applies it,
# changes what defines its result, undoes that, does it again and deletes the filter; loads the last state
# into the window; reads back the states that were saved in between, and looks at what the first Apply has
# shown. Filters that compute nothing without an array are applied without one first, as whoever tries
# them does. All in one window: charts open beside two of them, and what comes next has to be seen all the
# same.
source "$(dirname "$(readlink -f "$0")")/Gui/drive.sh"

pvpython "$here/Gui/write_colored_sphere.py" "$work/sphere.vtp"
pvpython "$here/Gui/write_edits.py" "$work"
Play "$work/edits.xml" --data="$work/sphere.vtp"
pvpython "$here/Gui/check_edits.py" "$work"
