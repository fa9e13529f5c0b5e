# Drives the real program: the box that makes one surface of blocks, which the panel shows for composite
# data; then reads the saved state back and looks at the results.
source "$(dirname "$(readlink -f "$0")")/Gui/drive.sh"

pvpython "$here/Gui/write_blocks.py" "$work/blocks.vtm"
Drive JoinBlocks.xml check_blocks.py --data="$work/blocks.vtm"
