"""Writes three spheres with a bump (one without arrays, one with one array, one with colors), and the
actions that TestGuiFirstApply.sh plays with them. Every filter is applied with no property touched,
except for the depth. States are saved in between."""
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir))

from paraview import simple
from vtkmodules.vtkCommonCore import vtkUnsignedCharArray
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter

import plugin
from events import FIRST, NEXT, PLACE, PROPERTIES, TIME, Script

DEPTH = "4"
CHOSEN_DEPTH = ("ClipToOctree",)  # the window chooses it
PAIRS = (("one", ("ScreenedPoisson", "HeatDiffusion", "SurfaceGradient")),
         ("colors", ("ScreenedPoisson", "HeatDiffusion", "StitchColors")))

plugin.load()
folder = sys.argv[1]
script = Script(folder)


def write_surfaces():
    sphere = simple.Sphere(Radius=1.0, ThetaResolution=60, PhiResolution=30)
    bump = simple.Calculator(
        Input=sphere, CoordinateResults=1, Function="coords*(1+0.3*exp(2*coordsZ-2))")
    surface = plugin.data(bump)
    surface.GetPointData().Initialize()
    colors = vtkUnsignedCharArray()
    colors.SetName("RGB")
    colors.SetNumberOfComponents(3)
    for point in range(surface.GetNumberOfPoints()):
        colors.InsertNextTuple3(*(round(100 * (c + 1.3) / 1.3) for c in surface.GetPoint(point)))
    height = plugin.data(simple.Calculator(Input=sphere, ResultArrayName="height", Function="coordsZ"))
    for name, array in (("raw", None), ("one", height.GetPointData().GetArray("height")), ("colors", colors)):
        data = surface.NewInstance()
        data.DeepCopy(surface)
        if array:
            data.GetPointData().AddArray(array)
        if name == "colors":
            data.GetPointData().SetActiveScalars("RGB")
        writer = vtkXMLPolyDataWriter()
        writer.SetFileName(f"{folder}/{name}.vtp")
        writer.SetInputData(data)
        writer.Write()


def first_apply(name, state, words="", **values):
    """Applies a filter of the menu, or the filter that the search finds by words."""
    if words:
        script.search(words)
    else:
        script.make(name)
    for key, value in values.items():
        script.enter(getattr(simple, name)(Input=surface).SMProxy.GetProperty(key), value)
    script.apply()
    script.save(state)


def look_at_modes():
    """Three modes and back to the first, then all of them, with another one chosen in the toolbar."""
    first_apply("LaplaceSpectrum", "raw.LaplaceSpectrum", "vibration", Depth=DEPTH, NumberOfModes="8")
    for button in (NEXT, NEXT, NEXT, FIRST):
        script.event(f"{TIME}{button}", "activate")
    script.save("raw.ModesPlayed")
    script.event(f"{PROPERTIES}/AllModes/CheckBox", "set_boolean", "true")
    script.apply()
    script.save("raw.AllModes")
    script.event("pqClientMainWindow/variableToolbar/displayColor/Variables", "set_string", "Mode003")
    script.save("raw.OtherMode")
    script.delete()
    script.save("raw.Closed")


def choose_sources():
    """The distance from the points of another source, which is chosen in the panel."""
    script.make("GeodesicDistance")
    script.event(f"{PROPERTIES}/Sources/1QComboBox0", "set_string", "raw.vtp")
    script.apply()
    script.save("colors.Sources")
    script.delete()


def choose_reference():
    """The map to another source, which is chosen in the panel."""
    script.select(len(PAIRS))  # colors.vtp
    script.make("FunctionalMap")
    script.event(f"{PROPERTIES}/Reference/1QComboBox0", "set_string", "raw.vtp")
    for key, value in (("NumberOfModes", "12"), ("Depth", DEPTH)):
        script.enter(simple.FunctionalMap(Input=surface).SMProxy.GetProperty(key), value)
    script.apply()
    script.save("colors.Reference")


def choose_position():
    """The distance from a handle in the view, which is placed by its coordinates."""
    script.make("GeodesicDistance")
    script.event(f"{PROPERTIES}/UseSourcePosition/CheckBox", "set_boolean", "true")
    for axis, value in zip("XYZ", PLACE):
        script.event(f"{PROPERTIES}/InteractiveHandle/worldPosition{axis}", "set_string", str(value))
    script.apply()
    script.save("colors.Position")
    script.delete()


write_surfaces()
surface = plugin.sphere()
script.apply()  # raw.vtp
look_at_modes()
for filter_name in plugin.PROXIES:
    if filter_name != "LaplaceSpectrum":
        depth = getattr(simple, filter_name)(Input=surface).SMProxy.GetProperty("Depth")
        has_depth = depth and depth.GetPanelVisibility() == "default"
        first_apply(filter_name, f"raw.{filter_name}",
                    **({"Depth": DEPTH} if has_depth and filter_name not in CHOSEN_DEPTH else {}))
        script.delete()
for file, filters in PAIRS:
    script.open(f"{folder}/{file}.vtp")
    script.apply()
    for filter_name in filters:
        first_apply(filter_name, f"{file}.{filter_name}", Depth=DEPTH)
        script.delete()
choose_position()
choose_sources()  # ParaView selects nothing after it
choose_reference()
script.write("first")
