"""A ParaView state: shortest paths along a surface. The left view has the paths from one point to five others,
colored by their length up to each point. The right view has the closed line through all six.

Load the plugin in ParaView and choose File > Load State. Or show a mesh of your own:

    GRIDFEM_MESH=scan.ply paraview --script=path.py

GRIDFEM_MESH names a file that ParaView reads. Without it, the state shows a ring with waves. To draw
paths of your own, select points of Mesh, show the panel of Paths, and press Copy Active Selection.
"""

import os

from paraview import servermanager, simple

simple.LoadDistributedPlugin("GridFEM", remote=False, ns=globals())

path = os.environ.get("GRIDFEM_MESH")
ring = simple.Superquadric(Toroidal=1, ThetaResolution=192, PhiResolution=96)
waves = "0.25*sin(11*coordsX+1)*cos(9*coordsZ)"
mesh = simple.OpenDataFile(path) if path else simple.Calculator(
    Input=ring, CoordinateResults=1, Function=f"coords*(1+{waves})")
simple.RenameSource("Mesh", mesh)

# Six points far from each other.
found = servermanager.Fetch(FarthestPoints(Input=mesh, NumberOfPoints=6, Depth=6))
array = found.GetFieldData().GetArray("FarthestPoints")
ids = [int(array.GetValue(k)) for k in range(array.GetNumberOfTuples())]
size = found.GetLength()

layout = simple.CreateLayout("Paths")
layout.SplitHorizontal(0, 0.5)
views = [simple.CreateRenderView(), simple.CreateRenderView()]
for cell, view, kind, name in zip((1, 2), views, ("To Nearest Source", "Closed"), ("Paths", "Loop")):
    layout.AssignView(cell, view)
    paths = GeodesicPaths(Input=mesh, TargetPointIds=ids, PathType=kind)
    simple.RenameSource(name, paths)
    simple.Show(paths, view)
    lines = simple.Tube(Input=simple.OutputPort(paths, 1), Radius=0.004 * size)
    simple.RenameSource(f"Lines of {name}", lines)
    display = simple.Show(lines, view)
    simple.ColorBy(display, ("POINTS", "ArcLength"), separate=True)
    display.RescaleTransferFunctionToDataRange(False, True)
    display.SetScalarBarVisibility(view, True)

simple.AddCameraLink(views[0], views[1], "Paths")
views[0].CameraPosition = [0.4, 0.5, -1.0]
views[0].CameraFocalPoint = [0.0, 0.0, 0.0]
views[0].CameraViewUp = [0.0, 1.0, 0.0]
simple.ResetCamera(views[0])
views[0].CameraParallelProjection = 1
for view in views:
    simple.Render(view)
simple.SetActiveSource(paths)
