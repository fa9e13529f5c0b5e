# Drives the real program: colours smoothed, and a gradient array used, both chosen with the mouse in
# the lists of the panel; then reads the saved state back and looks at the results.
source "$(dirname "$(readlink -f "$0")")/Gui/drive.sh"

pvpython "$here/Gui/write_colored_sphere.py" "$work/sphere.vtp"
Drive ChooseArrays.xml check_arrays.py --data="$work/sphere.vtp"
