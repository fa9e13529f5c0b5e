# For ParaView 6.1 and newer. Drives the real program: a long spectrum is aborted with the button of the
# window. A script starts it, because ParaView handles no events in a filter's progress while a test script
# is played.
source "$(dirname "$(readlink -f "$0")")/Gui/drive.sh"

XDG_CONFIG_HOME="$work" timeout 560 paraview --dr --plugins=GridFEM \
  --plugin-search-paths="$(dirname "$GRIDFEM_PLUGIN")" --script="$here/Gui/abort_spectrum.py"
