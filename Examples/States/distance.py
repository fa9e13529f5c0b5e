"""A ParaView state: distances along a surface. The left view has isolines around one point, the right one
the distance from a slice, with a sign.

Load the plugin in ParaView and choose File > Load State. Or show a mesh of your own:

    GRIDFEM_MESH=scan.ply paraview --script=distance.py

GRIDFEM_MESH names a file that ParaView reads. Without it, the state shows a ring with waves. Change
Source Point Ids of Distance, or move the plane of Slice.
"""

import os

from paraview import simple

simple.LoadDistributedPlugin("GridFEM", remote=False, ns=globals())

path = os.environ.get("GRIDFEM_MESH")
ring = simple.Superquadric(Toroidal=1, ThetaResolution=192, PhiResolution=96)
waves = "0.25*sin(11*coordsX+1)*cos(9*coordsZ)"
mesh = simple.OpenDataFile(path) if path else simple.Calculator(
    Input=ring, CoordinateResults=1, Function=f"coords*(1+{waves})")
simple.RenameSource("Mesh", mesh)
mesh.UpdatePipeline()
low_x, high_x, low_y, high_y, low_z, high_z = mesh.GetDataInformation().GetBounds()
size = max(high_x - low_x, high_y - low_y, high_z - low_z)
distance = GeodesicDistance(Input=mesh, SourcePointIds=[0], Depth=6)
simple.RenameSource("Distance", distance)
cut = simple.Slice(Input=mesh)
cut.SliceType.Origin = [(low_x + high_x) / 2, (low_y + high_y) / 2, (low_z + high_z) / 2]
cut.SliceType.Normal = [1.0, 0.4, 0.0]
simple.RenameSource("Slice", cut)
signed = GeodesicDistance(Input=mesh, Sources=cut, Signed=1, Depth=6)
simple.RenameSource("Signed", signed)

layout = simple.CreateLayout("Distance")
layout.SplitHorizontal(0, 0.5)
views = [simple.CreateRenderView(), simple.CreateRenderView()]
for cell, view, shown in zip((1, 2), views, (distance, signed)):
    layout.AssignView(cell, view)
    display = simple.Show(shown, view)
    simple.ColorBy(display, ("POINTS", "Distance"), separate=True)
    display.RescaleTransferFunctionToDataRange(False, True)
    display.SetScalarBarVisibility(view, True)
    shown.UpdatePipeline()
    low, high = shown.PointData["Distance"].GetRange()
    lines = simple.Contour(
        Input=shown, ContourBy=["POINTS", "Distance"],
        Isosurfaces=[low + k * (high - low) / 24 for k in range(1, 24)])
    display = simple.Show(lines, view)
    display.ColorArrayName, display.DiffuseColor = [None, ""], [0.1, 0.1, 0.1]

simple.AddCameraLink(views[0], views[1], "Distance")
views[0].CameraPosition = [0.4, 0.5, -1.0]
views[0].CameraFocalPoint = [0.0, 0.0, 0.0]
views[0].CameraViewUp = [0.0, 1.0, 0.0]
simple.ResetCamera(views[0])
views[0].CameraParallelProjection = 1
for view in views:
    simple.Render(view)
simple.SetActiveSource(distance)
