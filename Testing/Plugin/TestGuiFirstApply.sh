# Drives the real program: every filter is applied with no property touched to a surface without arrays, and
# several filters to one with an array and to one with colors. The saved states tell what was chosen,
# what is shown, and how it is colored. All in one window.
source "$(dirname "$(readlink -f "$0")")/Gui/drive.sh"

pvpython "$here/Gui/write_first.py" "$work"
Play "$work/first.xml" --data="$work/raw.vtp"
pvpython "$here/Gui/check_first.py" "$work"
