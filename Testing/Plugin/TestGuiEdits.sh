# Drives the real program: opens a file, and with every filter of the menu Surface FEM in turn applies it,
# changes its Depth, undoes that, does it again and deletes the filter; reads back the states that were
# saved in between.
source "$(dirname "$(readlink -f "$0")")/Gui/drive.sh"

panel=pqClientMainWindow/propertiesDock/propertiesPanel
properties=$panel/scrollArea/qt_scrollarea_viewport/scrollAreaWidgetContents/PropertiesFrame/ProxyPanel
menus=pqClientMainWindow/menubar

Event() { printf '  <pqevent object="%s" command="%s" arguments="%s" />\n' "$1" "$2" "${3:-}"; }
Choose() { Event "$properties/$1/ComboBox" set_string "$2"; }
ApplyAt() {
  Event "$properties/Depth/IntRangeWidget/LineEdit" set_string "$1"
  Event "$panel/Accept" activate
}
Save() {
  Event "$menus/menu_File" activate actionFileSaveServerState
  Event pqClientMainWindow/FileSaveServerStateDialog filesSelected "$work/$1.pvsm"
}
Edit() {
  Event "$menus/menu_Edit" activate "actionEdit$2"
  Save "$1.$2"
}

filters=$(sed -n 's/.*<SourceProxy name="\([A-Za-z]*\)".*/\1/p' "$GRIDFEM_SOURCE_DIR"/Plugin/*.xml)
{
  echo '<pqevents>'
  Event "$panel/Accept" activate
  for filter in $filters; do
    Event "$menus/menuFilters/Surface FEM" activate "$filter"
    case $filter in
      StitchColors)
        Choose ColorArray colors
        Choose LabelArray label
        ;;
      HarmonicInterpolation) Choose ValueArray height ;;
    esac
    ApplyAt 5
    ApplyAt 4
    Edit "$filter" Undo
    Edit "$filter" Redo
    Event "$menus/menu_Edit" activate actionDelete
  done
  Save left
  echo '</pqevents>'
} > "$work/edits.xml"

pvpython "$here/Gui/write_colored_sphere.py" "$work/sphere.vtp"
Play "$work/edits.xml" --data="$work/sphere.vtp"
# shellcheck disable=SC2086 # a word for each filter
pvpython "$here/Gui/check_edits.py" "$work" $filters
