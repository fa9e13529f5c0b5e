"""What the plugin's tests share: the plugin, a surface, and access to filters and their data."""
import os
import pathlib
import re

from paraview import servermanager, simple


def _panels():
    """The XML of every filter of the plugin, by its name."""
    folder = pathlib.Path(os.environ["GRIDFEM_SOURCE_DIR"]) / "Plugin"
    texts = [path.read_text() for path in sorted(folder.glob("*.xml"))]
    return {re.search(r'<SourceProxy name="(\w+)"', text).group(1): text for text in texts}


_PANELS = _panels()
PROXIES = tuple(_PANELS)

# What is known here of single filters, for all tests; one that is not named works without.

# Filters that compute nothing without an array: properties that choose one, for a surface with the
# point arrays `f`, any numbers, and `label`, whole ones.
CHOICES = {
    "StitchColors": {"ColorArray": ["POINTS", "f"], "LabelArray": ["POINTS", "label"]},
    "HarmonicInterpolation": {"ValueArray": ["POINTS", "f"]}}

# What is changed of a filter in the window, and the value as it stands in a state; else its depth.
CHANGES = {
    "ConnectivityAwareBasis": ("ConnectivityAware", "0"), "GeodesicDistance": ("SourceArray", "label"),
    "FarthestPoints": ("NumberOfPoints", "4"),
    "HarmonicInterpolation": ("MaskArray", "label"), "HeatDiffusion": ("NumberOfSteps", "3"),
    "LaplaceSpectrum": ("NumberOfModes", "12"), "MeanCurvatureFlow": ("NumberOfSteps", "12"),
    "PrincipalCurvatures": ("SmoothingScale", "0.05"), "ScreenedPoisson": ("ScreeningWeight", "50"),
    "SpectralSignatures": ("NumberOfScales", "5"), "StitchColors": ("ReferenceLabel", "1"),
    "SurfaceDetail": ("DetailScale", "3"), "SurfaceGradient": ("Array", "height")}

STAGES = ("Space", "System", "Hierarchy", "RightHandSide", "Solve")


def change_of(name):
    """The property of a filter that is changed, and its new value."""
    return CHANGES.get(name, ("Depth", "5"))


def colors_of(name):
    """By which array the hints of a filter's panel colour it first, and how; empty where they say nothing."""
    hint = re.search(r'class="vtkSM(?:ArrayColors|ColorsLater)" array="(\w+)"(?: colors="(\w+)")?', _PANELS[name])
    return hint.groups("") if hint else ("", "")


def load():
    """Loads the plugin; its filters become functions of paraview.simple."""
    simple.LoadPlugin(os.environ["GRIDFEM_PLUGIN"], remote=False, ns=vars(simple))


def sphere():
    """A sphere of radius 1."""
    return simple.Sphere(Radius=1.0, ThetaResolution=40, PhiResolution=20)


def with_arrays(surface):
    """The surface with the point arrays that CHOICES names."""
    values = simple.Calculator(Input=surface, ResultArrayName="f", Function="coordsX*coordsY")
    return simple.Calculator(Input=values, ResultArrayName="label", Function="floor(coordsZ)")


def selected_points(*ids):
    """A selection of points, as the mouse makes it."""
    return simple.IDSelectionSource(
        FieldType="POINT", IDs=[number for point in ids for number in (0, point)])


def data(proxy, port=0):
    """The data object of an output port, brought up to date."""
    proxy.UpdatePipeline()
    return servermanager.Fetch(proxy, idx=port)


def runs(proxy):
    """How often the filter behind a proxy has run each stage."""
    counts = proxy.GetClientSideObject()
    return {stage: counts.GetNumberOfRuns(stage) for stage in STAGES}


def reruns(proxy, change):
    """The stages that run again after `change`."""
    before = runs(proxy)
    change()
    proxy.UpdatePipeline()
    after = runs(proxy)
    return [stage for stage in STAGES if after[stage] != before[stage]]
