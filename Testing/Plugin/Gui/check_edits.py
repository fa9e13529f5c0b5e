"""Checks the filters after TestGuiEdits.sh. Each was shown alone, colored by its result over the range
of that array, with its chart and titles, at the time of its result. It had its first value again
after undo and the second after redo, and its state loads and computes. After all were deleted, only
the file is left, and a state brings all of it back into the window. Shown/ in the current folder has
the views after the first Apply."""
import math
import os
import sys
from xml.etree import ElementTree

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir))

import numpy
from paraview import simple
from vtkmodules.util import numpy_support
from vtkmodules.vtkIOImage import vtkPNGReader

import plugin

plugin.load()
folder = sys.argv[1]


def sources(path):
    """Returns names and proxies of the pipeline in a state."""
    root = ElementTree.parse(path)
    proxies = {proxy.get("id"): proxy for proxy in root.iter("Proxy") if proxy.get("type")}
    items = root.findall(".//ProxyCollection[@name='sources']/Item")
    return {item.get("name"): proxies[item.get("id")] for item in items}


def value_of(proxy, name):
    """Returns the value of a property with one value. If the property chooses an array, the array's
    name comes last."""
    return proxy.findall(f"Property[@name='{name}']/Element")[-1].get("value")


# The ports that are shown in the 3D view, if it is not port 0 alone.
SURFACES = {"FunctionalMap": [0, 1], "GeodesicPaths": [0, 1], "Parameterization": [0, 1], "ClipToOctree": [0, 2]}
# The series of a chart that opens beside a filter, and the titles of its axes.
CHARTS = {"LaplaceSpectrum": ["Eigenvalue"], "MeanCurvatureFlow": ["Sphericity"]}
# Filters that tell in the view what is shown.
LABELED = ("LaplaceSpectrum", "MeanCurvatureFlow")
TITLES = {"LaplaceSpectrum": ("Mode", "Eigenvalue"),
          "MeanCurvatureFlow": ("Step", "Sphericity")}


def visible(view_type):
    """Returns the representations that are visible in views of a type."""
    return [part for view in simple.GetViews() if view.SMProxy.GetXMLName() == view_type
            for part in view.Representations if getattr(part, "Visibility", 0)]


def check_picture(name):
    """Checks that the window's layout shows a lit surface, which does not fill it."""
    os.makedirs("Shown", exist_ok=True)
    path = f"Shown/{name}.png"
    simple.SaveScreenshot(path, simple.GetLayout(), ImageResolution=[800, 500])
    reader = vtkPNGReader()
    reader.SetFileName(path)
    reader.Update()
    pixels = numpy_support.vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars())[:, :3]
    _, counts = numpy.unique(pixels, axis=0, return_counts=True)
    background = counts.max() / counts.sum()
    if len(counts) < 50 or not 0.2 < background < 0.97:
        sys.exit(f"{path} has {len(counts)} colors, and one on {100 * background:.0f} % of it")


def check_shown(name):
    simple.LoadState(f"{folder}/{name}.Shown.pvsm")
    source = simple.FindSource(name + "1")
    charts = [list(chart.SeriesVisibility) for chart in visible("XYChartView")]
    if charts != ([CHARTS[name]] if name in CHARTS else []):
        sys.exit(f"{name}: charts show {charts}")
    titles = {(view.BottomAxisTitle, view.LeftAxisTitle) for view in simple.GetViews("XYChartView")
              if any(getattr(part, "Visibility", 0) for part in view.Representations)}
    if titles != ({TITLES[name]} if name in TITLES else set()):
        sys.exit(f"{name}: the axes are called {titles}")
    time = simple.GetAnimationScene().AnimationTime
    if name == "MeanCurvatureFlow" and time != source.NumberOfSteps:
        sys.exit(f"{name}: shown is time {time}")
    check_picture(name)
    seen = visible("RenderView")
    surfaces = [part for part in seen if hasattr(part, "ColorArrayName")]
    inputs = [part.SMProxy.GetProperty("Input") for part in surfaces]
    if ([shown.GetOutputPortForConnection(0) for shown in inputs] != SURFACES.get(name, [0])
            or any(shown.GetProxy(0) != source.SMProxy for shown in inputs)):
        sys.exit(f"{name}: {len(surfaces)} surfaces are shown")
    if name == "GeodesicPaths" and not (surfaces[1].RenderLinesAsTubes and surfaces[0].Opacity < 1):
        sys.exit("the paths are lines that cannot be seen")
    labels = [part for part in seen if part.SMProxy.GetXMLName() == "TextSourceRepresentation"]
    if len(labels) != (name in LABELED):
        sys.exit(f"{name}: {len(labels)} labels are shown")
    source.UpdatePipeline(simple.GetActiveView().ViewTime)
    if source.GetDataInformation().GetNumberOfPoints() == 0:
        sys.exit(f"{name}: nothing comes out of the state")
    association, array = surfaces[0].ColorArrayName
    wanted_array, colors = plugin.colors_of(name)
    if name == "FunctionalMap":  # shows its input, because it has no Reference
        wanted_array = ""
    if (array or "") != wanted_array:
        sys.exit(f"{name}: colored by {array}")
    if surfaces[0].Representation != "Surface":
        sys.exit(f"{name}: shown as {surfaces[0].Representation}")
    if name == "StitchColors" and (surfaces[0].MapScalars or len(seen) != 1):
        sys.exit(f"{name}: the colors are not shown as they are")
    if not array or not surfaces[0].MapScalars:  # the shape alone, or unchanged colors
        return
    if len(seen) != len(surfaces) + len(labels) + 1:
        sys.exit(f"{name}: no color bar is shown")
    data = source.PointData if association == "POINTS" else source.CellData
    component = -1 if data[array].GetNumberOfComponents() > 1 else 0
    wanted = data[array].GetRange(component)
    if colors == "diverging" and component == 0:
        largest = max(abs(end) for end in wanted)
        wanted = (-largest, largest)
    points = surfaces[0].LookupTable.RGBPoints
    between = (points[0], points[-4])
    if not all(math.isclose(a, b, rel_tol=1e-5, abs_tol=1e-9) for a, b in zip(wanted, between)):
        sys.exit(f"{name}: colors between {between}, values between {wanted}")


for name in plugin.PROXIES:
    check_shown(name)
    plugin.clear()
    changed, after = plugin.change_of(name)
    before = value_of(sources(f"{folder}/{name}.Shown.pvsm")[name + "1"], changed)
    if before == after:
        sys.exit(f"{name}: {changed} was {after} before it was changed")
    for step, wanted in (("Undo", before), ("Redo", after)):
        found = sources(f"{folder}/{name}.{step}.pvsm")
        if set(found) != {"sphere.vtp", name + "1"}:
            sys.exit(f"{name}: after {step} there are {sorted(found)}")
        value = value_of(found[name + "1"], changed)
        if value != wanted:
            sys.exit(f"{name}: after {step} {changed} is {value}")
loaded = sources(f"{folder}/loaded.pvsm")
first = plugin.PROXIES[0]
again = sources(f"{folder}/{first}.Redo.pvsm")
changed, after = plugin.change_of(first)
if {name: proxy.get("type") for name, proxy in loaded.items()} != {
        name: proxy.get("type") for name, proxy in again.items()} or (
            value_of(loaded[first + "1"], changed) != after):
    sys.exit(f"the window has loaded {sorted(loaded)}")
left = sources(f"{folder}/left.pvsm")
if set(left) != {"sphere.vtp"}:
    sys.exit(f"left are {sorted(left)}")
