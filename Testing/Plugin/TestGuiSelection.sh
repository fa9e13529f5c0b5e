# Drives the real program: points selected with the mouse, copied into the panels of two filters, and a
# curve drawn in its editor; then reads the saved state back and looks at the results.
source "$(dirname "$(readlink -f "$0")")/Gui/drive.sh"

pvpython "$here/Gui/write_colored_sphere.py" "$work/sphere.vtp"
Drive SelectAndDraw.xml check_selection.py --data="$work/sphere.vtp"
