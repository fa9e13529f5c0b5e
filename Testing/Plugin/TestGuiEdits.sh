# Drives the real program: opens a file, and with every filter of the menu Surface FEM in turn applies it,
# changes its Depth, undoes that, does it again and deletes the filter; reads back the states that were
# saved in between, and looks at what the first Apply has shown. Filters that compute nothing without an
# array are applied without one first, as whoever tries them does.
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

# Edits FILTER...: all of it, with one filter after the other
Edits() {
  local filter
  {
    echo '<pqevents>'
    Event "$panel/Accept" activate
    for filter; do
      Event "$menus/menuFilters/Surface FEM" activate "$filter"
      case $filter in
        StitchColors)
          ApplyAt 4
          Choose ColorArray colors
          Choose LabelArray label
          ;;
        HarmonicInterpolation)
          ApplyAt 4
          Choose ValueArray height
          ;;
      esac
      ApplyAt 4
      Save "$filter.Shown"
      ApplyAt 5
      Edit "$filter" Undo
      Edit "$filter" Redo
      Event "$menus/menu_Edit" activate actionDelete
    done
    Save "left.$1"
    echo '</pqevents>'
  } > "$work/edits.xml"
  Play "$work/edits.xml" --data="$work/sphere.vtp"
}

pvpython "$here/Gui/write_colored_sphere.py" "$work/sphere.vtp"
filters=$(sed -n 's/.*<SourceProxy name="\([A-Za-z]*\)".*/\1/p' "$GRIDFEM_SOURCE_DIR"/Plugin/*.xml)
# All in one window: charts open beside two of them, and what comes next has to be seen all the same.
# shellcheck disable=SC2086 # a word for each filter
Edits $filters
# shellcheck disable=SC2086
pvpython "$here/Gui/check_edits.py" "$work" $filters
