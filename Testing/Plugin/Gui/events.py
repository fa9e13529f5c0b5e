"""Actions in ParaView's window, in the form that its test player plays."""
from paraview import simple

PANEL = "pqClientMainWindow/propertiesDock/propertiesPanel"
PROPERTIES = PANEL + "/scrollArea/qt_scrollarea_viewport/scrollAreaWidgetContents/PropertiesFrame/ProxyPanel"
MENUS = "pqClientMainWindow/menubar"
TIME = "pqClientMainWindow/VCRToolbar/1QToolButton"
FIRST, NEXT = 0, 4  # buttons of the toolbar for the time
PLACE = (2.0, -1.5, 0.3)  # of the handle in the view


class Script:
    """A list of actions. States are saved in a folder."""

    def __init__(self, folder):
        self.folder = folder
        self.events = []

    def event(self, widget, command, arguments=""):
        self.events.append(f'  <pqevent object="{widget}" command="{command}" arguments="{arguments}" />')

    def apply(self):
        self.event(f"{PANEL}/Accept", "activate")

    def open(self, path):
        self.event(f"{MENUS}/menu_File", "activate", "actionFileOpen")
        self.event("pqClientMainWindow/FileOpenDialog", "filesSelected", path)

    def save(self, name):
        self.event(f"{MENUS}/menu_File", "activate", "actionFileSaveServerState")
        self.event("pqClientMainWindow/FileSaveServerStateDialog", "filesSelected", f"{self.folder}/{name}.pvsm")

    def load(self, name):
        """Loads a state or a script of the folder."""
        self.event(f"{MENUS}/menu_File", "activate", "actionFileLoadServerState")
        self.event("pqClientMainWindow/FileLoadServerStateDialog", "filesSelected", f"{self.folder}/{name}")

    def select(self, *rows):
        """Selects in the pipeline browser: the number of a source, of a filter on it, and so on."""
        place = "".join(f"/{row}:0" for row in (0, *rows))
        for command, buttons in (("mousePress", "1,1"), ("mouseRelease", "1,0")):
            self.event("pqClientMainWindow/pipelineBrowserDock/pipelineBrowser", command, f"{buttons},0,50,10,{place}")

    def edit(self, what):
        self.event(f"{MENUS}/menu_Edit", "activate", f"actionEdit{what}")

    def delete(self):
        self.event(f"{MENUS}/menu_Edit", "activate", "actionDelete")

    def make(self, name):
        """Makes a filter on what is active."""
        self.event(f"{MENUS}/menuFilters/Surface FEM", "activate", name)

    def search(self, words):
        """Makes the first filter on what is active that ParaView's search finds by words."""
        if simple.GetParaViewVersion() >= (5, 13):
            dialog = "pqClientMainWindow/QuickLaunchDialogExtended"
            self.event(f"{MENUS}/menuFilters", "activate", "quickLaunchAction")
            self.event(f"{dialog}/Request", "set_string", words)
            self.event(f"{dialog}/CreateProxy", "activate")
            return
        self.event(f"{MENUS}/menuFilters", "activate", "Search...&#9;Ctrl+Space")
        for letter in words:
            self.event("pqClientMainWindow/QuickLaunchDialog", "keyEvent", f"6:{ord(letter.upper())}:0:{letter}:0:1")
        self.event("pqClientMainWindow/QuickLaunchDialog", "keyEvent", "6:16777220:0:&#13;:0:1")

    def example(self, name):
        """Chooses an example of the Help menu."""
        self.event(f"{MENUS}/menu_Help/SurfaceFEMExamples", "activate", name)

    def answer(self, dialog, button):
        """Presses a button of a dialog, by its number."""
        self.event(f"pqClientMainWindow/{dialog}/qt_msgbox_buttonbox/1QPushButton{button}", "activate")

    def enter(self, prop, value):
        """Gives a property a value, in the widget that panels have for its kind."""
        widget, command = f"{PROPERTIES}/{prop.GetXMLName()}", "set_string"
        choices = prop.FindDomain("vtkSMEnumerationDomain")
        numbers = prop.FindDomain("vtkSMDoubleRangeDomain")
        if choices:
            self.event(f"{widget}/ComboBox", command, choices.GetEntryTextForValue(int(value)))
        elif prop.FindDomain("vtkSMArrayListDomain"):
            self.event(f"{widget}/ComboBox", command, value)
        elif prop.FindDomain("vtkSMBooleanDomain"):
            self.event(f"{widget}/CheckBox", "set_boolean", "true" if value == "1" else "false")
        elif not numbers:
            has_range = prop.FindDomain("vtkSMIntRangeDomain").GetMaximumExists(0)
            self.event(f"{widget}/IntRangeWidget/LineEdit" if has_range else f"{widget}/LineEdit0", command, value)
        elif numbers.GetMaximumExists(0):
            self.event(f"{widget}/DoubleRangeWidget/DoubleLineEdit", command, value)
        else:
            self.event(f"{widget}/DoubleLineEdit0", command, value)

    def write(self, name):
        with open(f"{self.folder}/{name}.xml", "w", encoding="utf-8") as file:
            file.write("\n".join(["<pqevents>", *self.events, "</pqevents>\n"]))
