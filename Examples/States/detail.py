"""A ParaView state: a surface smoothed (above) and sharpened (below). The columns keep nothing,
valleys, ridges, and both.

Load the plugin in ParaView and choose File > Load State. Or show a mesh of your own, such as a scan:

    GRIDFEM_MESH=scan.ply paraview --script=detail.py

GRIDFEM_MESH names a file that ParaView reads. Without it, the state shows a ring with waves. The eight
filters share one basis. Change Detail Scale or Transfer Function of any of them; with Auto Apply on, the
surface follows.
"""

import os

from paraview.simple import (
    AddCameraLink,
    Calculator,
    CreateLayout,
    CreateRenderView,
    LoadDistributedPlugin,
    OpenDataFile,
    RenameSource,
    Render,
    ResetCamera,
    Show,
    Superquadric,
    Text,
)

LoadDistributedPlugin("GridFEM", remote=False, ns=globals())

if "GRIDFEM_MESH" in os.environ:
    mesh = OpenDataFile(os.environ["GRIDFEM_MESH"])
else:
    ring = Superquadric(Toroidal=1, ThetaResolution=384, PhiResolution=192)
    upright = "coordsX*iHat-coordsZ*jHat+coordsY*kHat"
    waves = "0.012*sin(70*coordsX)*sin(70*coordsY)*sin(70*coordsZ)"
    mesh = Calculator(Input=ring, CoordinateResults=1, Function=f"({upright})*(1+{waves})")
RenameSource("Mesh", mesh)
basis = ConnectivityAwareBasis(Input=mesh, Depth=7)  # noqa: F821, from the plugin

KEPT = ("Isotropic", "Large Negative", "Large Positive", "Large Absolute")
WORDS = ("everywhere", "valleys kept", "ridges kept", "both kept")

layout = CreateLayout("Detail")
rows = layout.SplitVertical(0, 0.5)
views, details = [], []


def columns(cell):
    """Four cells beside each other."""
    left = layout.SplitHorizontal(cell, 0.5)
    first, third = (layout.SplitHorizontal(half, 0.5) for half in (left, left + 1))
    return first, first + 1, third, third + 1


for row, (word, scale) in enumerate((("smoothed", 0.0), ("sharpened", 2.5))):
    for cell, transfer, kept in zip(columns(rows + row), KEPT, WORDS):
        detail = SurfaceDetail(  # noqa: F821
            Input=mesh, Basis=basis, DetailScale=scale, ScreeningWeight=2000, SmoothingScale=0.008,
            TransferFunction=transfer)
        label = f"{word}, {kept}"
        RenameSource(label, detail)
        view = CreateRenderView()
        view.OrientationAxesVisibility = 0
        layout.AssignView(cell, view)
        Show(detail, view).ColorArrayName = [None, ""]
        words = Show(Text(Text=label), view)
        words.WindowLocation, words.FontSize = "Lower Center", 10
        details.append(detail)
        views.append(view)

for k, view in enumerate(views[1:]):
    AddCameraLink(views[0], view, f"Detail{k}")
smoothed = details[0]
views[0].CameraPosition = [0.0, 0.0, -1.0]
views[0].CameraFocalPoint = [0.0, 0.0, 0.0]
views[0].CameraViewUp = [0.0, 1.0, 0.0]
ResetCamera(views[0])
for view in views:
    Render(view)
