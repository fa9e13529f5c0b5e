"""Shared by the plugin's tests: the plugin, a surface, and access to filters and their data."""
import os
import pathlib
import re

from paraview import servermanager, simple


def _panels():
    """Returns the XML of every filter of the plugin, by its name."""
    folder = pathlib.Path(os.environ["GRIDFEM_SOURCE_DIR"]) / "Plugin"
    texts = [path.read_text() for path in sorted(folder.glob("*.xml"))]
    return {re.search(r'<SourceProxy name="(\w+)"', text).group(1): text for text in texts}


_PANELS = _panels()
PROXIES = tuple(_PANELS)

# Facts about single filters, for all tests. A filter without an entry needs none.

# Filters that compute nothing without an array: properties that choose one, for a surface with the
# point arrays `f`, any numbers, and `label`, whole numbers. Functional Map takes another surface.
CHOICES = {
    "FunctionalMap": {},
    "StitchColors": {"ColorArray": ["POINTS", "f"], "LabelArray": ["POINTS", "label"]},
    "HarmonicInterpolation": {"ValueArray": ["POINTS", "f"]}}

# The property of a filter that the window tests change, and its value in a state. Without an entry
# it is the depth.
CHANGES = {
    "ConnectivityAwareBasis": ("ConnectivityAware", "0"), "GeodesicDistance": ("SourceArray", "label"),
    "FarthestPoints": ("NumberOfPoints", "4"),
    "FunctionalMap": ("NumberOfModes", "12"), "GaussianField": ("Seed", "7"), "GeodesicPaths": ("PathType", "3"),
    "HarmonicInterpolation": ("MaskArray", "label"), "HeatDiffusion": ("NumberOfSteps", "3"),
    "LaplaceSpectrum": ("NumberOfModes", "12"), "MeanCurvatureFlow": ("NumberOfSteps", "12"),
    "Parameterization": ("MapType", "1"),
    "PrincipalCurvatures": ("SmoothingScale", "0.05"), "ScreenedPoisson": ("ScreeningWeight", "50"),
    "SpectralSignatures": ("NumberOfScales", "5"), "StitchColors": ("ReferenceLabel", "1"),
    "SurfaceDetail": ("DetailScale", "3"), "SurfaceDynamics": ("Seed", "7"), "SurfaceGradient": ("Array", "height")}

STAGES = ("Space", "System", "Hierarchy", "RightHandSide", "Solve")


# Filters that compute on the mesh itself, without a grid.
WITHOUT_GRID = ("GeodesicPaths", "Parameterization")


def depth_of(name, depth):
    """Returns the property for the depth of a filter, if it has one."""
    return {} if name in WITHOUT_GRID else {"Depth": depth}


def change_of(name):
    """Returns the property of a filter that the tests change, and its new value."""
    return CHANGES.get(name, ("Depth", "5"))


def choices(name):
    """Returns the properties that a filter needs to compute anything."""
    if name == "FunctionalMap":
        return {"Reference": simple.Calculator(Input=sphere(), CoordinateResults=1,
                                               Function="coords*(1+0.3*coordsX+0.2*coordsY*coordsZ)")}
    return CHOICES.get(name, {})


def colors_of(name):
    """Returns the array that colors a new filter, from the hints of its panel, and how. Empty if there
    is no hint."""
    hint = re.search(r'<(?:ArrayColors|ColorsLater) array="(\w+)\*?"(?! port)(?: colors="(\w+)")?', _PANELS[name])
    return hint.groups("") if hint else ("", "")


def load():
    """Loads the plugin. Its filters become functions of paraview.simple."""
    simple.LoadPlugin(os.environ["GRIDFEM_PLUGIN"], remote=False, ns=vars(simple))


def clear():
    """Deletes all of the pipeline and its views, which takes less time than a new session."""
    for proxies in simple.GetViews(), simple.GetLayouts().values(), simple.GetSources().values():
        for proxy in list(proxies):
            simple.Delete(proxy)


def sphere():
    """Makes a sphere of radius 1."""
    return simple.Sphere(Radius=1.0, ThetaResolution=40, PhiResolution=20)


def with_arrays(surface):
    """Returns the surface with the point arrays that CHOICES names."""
    values = simple.Calculator(Input=surface, ResultArrayName="f", Function="coordsX*coordsY")
    return simple.Calculator(Input=values, ResultArrayName="label", Function="floor(coordsZ)")


def selected_points(*ids):
    """Makes a selection of points, as the mouse does."""
    return simple.IDSelectionSource(
        FieldType="POINT", IDs=[number for point in ids for number in (0, point)])


def data(proxy, port=0):
    """Returns the data object of an output port, brought up to date."""
    proxy.UpdatePipeline()
    return servermanager.Fetch(proxy, idx=port)


def runs(proxy):
    """Returns how often the filter behind a proxy has run each stage."""
    counts = proxy.GetClientSideObject()
    return {stage: counts.GetNumberOfRuns(stage) for stage in STAGES}


def reruns(proxy, change):
    """Returns the stages that run again after `change`."""
    before = runs(proxy)
    change()
    proxy.UpdatePipeline()
    after = runs(proxy)
    return [stage for stage in STAGES if after[stage] != before[stage]]
