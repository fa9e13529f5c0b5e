# Drives the real program: opens a file, and with every filter of the menu Surface FEM in turn applies it,
# changes what defines its result, undoes that, does it again and deletes the filter; loads the last state
# into the window; reads back the states that were saved in between, and looks at what the first Apply has
# shown. Filters that compute nothing without an array are applied without one first, as whoever tries
# them does.
source "$(dirname "$(readlink -f "$0")")/Gui/drive.sh"

panel=pqClientMainWindow/propertiesDock/propertiesPanel
properties=$panel/scrollArea/qt_scrollarea_viewport/scrollAreaWidgetContents/PropertiesFrame/ProxyPanel
menus=pqClientMainWindow/menubar

Event() { printf '  <pqevent object="%s" command="%s" arguments="%s" />\n' "$1" "$2" "${3:-}"; }
Choose() { Event "$properties/$1/ComboBox" set_string "$2"; }
Type() { Event "$properties/$1/DoubleLineEdit0" set_string "$2"; }
Slide() { Event "$properties/$1/IntRangeWidget/LineEdit" set_string "$2"; }
Apply() { Event "$panel/Accept" activate; }

# The filter's own property that is changed; check_edits.py knows the values before and after.
Change() {
  case $1 in
    ClipToOctree) Slide Depth 5 ;;
    ConnectivityAwareBasis) Event "$properties/ConnectivityAware/CheckBox" set_boolean false ;;
    GeodesicDistance) Choose SourceArray label ;;
    HarmonicInterpolation) Choose MaskArray label ;;
    HeatDiffusion) Slide NumberOfSteps 3 ;;
    LaplaceSpectrum) Slide NumberOfModes 12 ;;
    MeanCurvatureFlow) Slide NumberOfSteps 12 ;;
    PrincipalCurvatures) Type SmoothingScale 0.05 ;;
    ScreenedPoisson) Type ScreeningWeight 50 ;;
    SpectralSignatures) Slide ShownScale 0 ;;
    StitchColors) Choose KeptMean "Reference Scan" ;;
    SurfaceDetail) Event "$properties/DetailScale/DoubleRangeWidget/DoubleLineEdit" set_string 3 ;;
    SurfaceGradient) Choose Array height ;;
    *) echo "TestGuiEdits.sh does not know what to change of $1" >&2; exit 1 ;;
  esac
  Apply
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
          Apply
          Choose ColorArray colors
          Choose LabelArray label
          ;;
        HarmonicInterpolation)
          Apply
          Choose ValueArray height
          ;;
      esac
      # The panel of Principal Curvatures shows no Depth.
      [ "$filter" = PrincipalCurvatures ] || Slide Depth 4
      Apply
      Save "$filter.Shown"
      Change "$filter"
      Edit "$filter" Undo
      Edit "$filter" Redo
      Event "$menus/menu_Edit" activate actionDelete
    done
    Save "left.$1"
    Event "$menus/menu_File" activate actionFileLoadServerState
    Event pqClientMainWindow/FileLoadServerStateDialog filesSelected "$work/$1.Redo.pvsm"
    Event LoadStateOptionsDialog/widget/OKButton activate
    Save loaded
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
