"""What the plugin's tests share: the plugin, a surface, and access to filters and their data."""
import os
import pathlib
import re

from paraview import servermanager, simple


def _filters():
    """Per filter of the plugin: whether it takes a basis, as solvers do."""
    folder = pathlib.Path(os.environ["GRIDFEM_SOURCE_DIR"]) / "Plugin"
    texts = [path.read_text() for path in sorted(folder.glob("*.xml"))]
    return {re.search(r'<SourceProxy name="(\w+)"', text).group(1): "@Basis@" in text
            for text in texts}


_FILTERS = _filters()
PROXIES = tuple(_FILTERS)
SOLVERS = tuple(name for name, takes_basis in _FILTERS.items() if takes_basis)

# Filters that compute nothing without an array: properties that choose one, for a surface with the
# point arrays `f`, any numbers, and `label`, whole ones.
CHOICES = {
    "StitchColors": {"ColorArray": ["POINTS", "f"], "LabelArray": ["POINTS", "label"]},
    "HarmonicInterpolation": {"ValueArray": ["POINTS", "f"]}}

STAGES = ("Space", "System", "Hierarchy", "RightHandSide", "Solve")


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
