"""A ParaView state: detail in one place, as with a spray can. The left view has the input and the
selection. The right view has the selection sharpened and the rest smoothed.

Load the plugin in ParaView and choose File > Load State. Or show a mesh of your own, such as a scan:

    GRIDFEM_MESH=scan.ply paraview --script=spray.py

GRIDFEM_MESH names a file that ParaView reads. Without it, the state shows a ring with waves. Select
other points or cells in the left view, press Copy Active Selection in the panel of Detail, and Apply.
"""

import os

from paraview.simple import (
    AddCameraLink,
    Calculator,
    ColorBy,
    CreateLayout,
    CreateRenderView,
    GetColorTransferFunction,
    LoadDistributedPlugin,
    OpenDataFile,
    PointSource,
    RenameSource,
    Render,
    ResetCamera,
    SelectionQuerySource,
    SetActiveSource,
    Show,
    Superquadric,
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
mesh.UpdatePipeline()
low_x, high_x, low_y, high_y, low_z, high_z = mesh.GetDataInformation().GetBounds()

# The points near a place in front of the upper part.
place = PointSource(
    Center=[(low_x + high_x) / 2, low_y + 0.835 * (high_y - low_y), low_z], Radius=0.0)
RenameSource("Place", place)
distance = GeodesicDistance(Input=mesh, Sources=place, Depth=7)  # noqa: F821, from the plugin
RenameSource("Distance", distance)
near = SelectionQuerySource(
    ElementType=0, QueryString=f"Distance < {0.17 * (high_y - low_y)}")
unchanged, detail = (
    SurfaceDetail(  # noqa: F821
        Input=distance, Depth=7, ScreeningWeight=4000, TransitionWidth=0.03, Selection=near,
        DetailScale=inside, OutsideScale=outside)
    for inside, outside in ((1.0, 1.0), (3.0, 0.0)))
RenameSource("Selected", unchanged)
RenameSource("Detail", detail)

layout = CreateLayout("Spray can")
layout.SplitHorizontal(0, 0.5)
views = [CreateRenderView(), CreateRenderView()]
for cell, view, shown in zip((1, 2), views, (unchanged, detail)):
    layout.AssignView(cell, view)
    display = Show(shown, view)
    if shown is unchanged:
        ColorBy(display, ("POINTS", "Selected"))
        GetColorTransferFunction("Selected").RescaleTransferFunction(-1.0, 1.0)
        display.SetScalarBarVisibility(view, False)
    else:
        display.ColorArrayName = [None, ""]
AddCameraLink(views[0], views[1], "SprayCan")
views[0].CameraPosition = [0.0, 0.0, -1.0]
views[0].CameraFocalPoint = [0.0, 0.0, 0.0]
views[0].CameraViewUp = [0.0, 1.0, 0.0]
ResetCamera(views[0])
for view in views:
    Render(view)
SetActiveSource(detail)
