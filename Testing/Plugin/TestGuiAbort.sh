# Drives the real program: a long spectrum is aborted with the button of the window. A script starts it, because
# ParaView handles no events in a filter's progress while a test script is played.
source "$(dirname "$(readlink -f "$0")")/Gui/drive.sh"

[ -n "${GRIDFEM_PRESS_ABORT:-}" ] || { echo "skipped: the abort button works from ParaView 6.1 on"; exit 77; }
XDG_CONFIG_HOME="$work" timeout 560 paraview --dr --plugins=GridFEM \
  --plugin-search-paths="$(dirname "$GRIDFEM_PLUGIN")" --script="$here/Gui/abort_spectrum.py"
