# Drives the real program: points selected with the mouse and a curve drawn in its editor, arrays chosen in the
# lists of the panel, a chain of filters, and the box for one surface of blocks. Then it reads the saved states
# back and looks at the results. All in one window.
source "$(dirname "$(readlink -f "$0")")/Gui/drive.sh"

pvpython "$here/Gui/write_colored_sphere.py" "$work/sphere.vtp"
pvpython "$here/Gui/write_blocks.py" "$work/blocks.vtm"
sed "s|@FOLDER@|$work|" "$here/Gui/UsePanels.xml" > "$work/events.xml"
Play "$work/events.xml" --data="$work/sphere.vtp"
pvpython "$here/Gui/check_panels.py" "$work"
