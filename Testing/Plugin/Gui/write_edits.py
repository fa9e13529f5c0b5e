"""Writes the actions that TestGuiEdits.sh plays. With every filter in turn, they are Apply, a change of
the property that defines its result, undo, redo and delete. A state is saved in between. At last a
state is loaded into the window."""
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir))

from paraview import simple

import plugin

PANEL = "pqClientMainWindow/propertiesDock/propertiesPanel"
PROPERTIES = PANEL + "/scrollArea/qt_scrollarea_viewport/scrollAreaWidgetContents/PropertiesFrame/ProxyPanel"
MENUS = "pqClientMainWindow/menubar"

plugin.load()
folder = sys.argv[1]
events = []


def event(widget, command, arguments=""):
    events.append(f'  <pqevent object="{widget}" command="{command}" arguments="{arguments}" />')


def apply():
    event(f"{PANEL}/Accept", "activate")


def save(name):
    event(f"{MENUS}/menu_File", "activate", "actionFileSaveServerState")
    event("pqClientMainWindow/FileSaveServerStateDialog", "filesSelected", f"{folder}/{name}.pvsm")


def edit(name, what):
    event(f"{MENUS}/menu_Edit", "activate", f"actionEdit{what}")
    save(f"{name}.{what}")


def enter(prop, value):
    """Gives a property a value, in the widget that panels have for its kind."""
    widget, command = f"{PROPERTIES}/{prop.GetXMLName()}", "set_string"
    choices = prop.FindDomain("vtkSMEnumerationDomain")
    numbers = prop.FindDomain("vtkSMDoubleRangeDomain")
    if choices:
        event(f"{widget}/ComboBox", command, choices.GetEntryTextForValue(int(value)))
    elif prop.FindDomain("vtkSMArrayListDomain"):
        event(f"{widget}/ComboBox", command, value)
    elif prop.FindDomain("vtkSMBooleanDomain"):
        event(f"{widget}/CheckBox", "set_boolean", "true" if value == "1" else "false")
    elif not numbers:
        has_range = prop.FindDomain("vtkSMIntRangeDomain").GetMaximumExists(0)
        event(f"{widget}/IntRangeWidget/LineEdit" if has_range else f"{widget}/LineEdit0", command, value)
    elif numbers.GetMaximumExists(0):
        event(f"{widget}/DoubleRangeWidget/DoubleLineEdit", command, value)
    else:
        event(f"{widget}/DoubleLineEdit0", command, value)


def edit_filter(name):
    proxy = getattr(simple, name)(Input=surface).SMProxy
    event(f"{MENUS}/menuFilters/Surface FEM", "activate", name)
    if name in plugin.CHOICES:  # applied without an array first, as whoever tries it does
        apply()
        for key, (_, array) in plugin.CHOICES[name].items():
            enter(proxy.GetProperty(key), array)
    depth = proxy.GetProperty("Depth")
    if depth.GetPanelVisibility() == "default":
        enter(depth, "4")
    apply()
    save(f"{name}.Shown")
    key, value = plugin.change_of(name)
    enter(proxy.GetProperty(key), value)
    apply()
    edit(name, "Undo")
    edit(name, "Redo")
    event(f"{MENUS}/menu_Edit", "activate", "actionDelete")


surface = plugin.sphere()
apply()  # the file
for filter_name in plugin.PROXIES:
    edit_filter(filter_name)
save("left")
event(f"{MENUS}/menu_File", "activate", "actionFileLoadServerState")
event("pqClientMainWindow/FileLoadServerStateDialog", "filesSelected", f"{folder}/{plugin.PROXIES[0]}.Redo.pvsm")
event("LoadStateOptionsDialog/widget/OKButton", "activate")
save("loaded")
with open(f"{folder}/edits.xml", "w", encoding="utf-8") as file:
    file.write("\n".join(["<pqevents>", *events, "</pqevents>\n"]))
