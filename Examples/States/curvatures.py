"""A ParaView state: how a surface bends. The left view has the mean curvature, blue in hollows and
red on bulges. The right view has the shape index, which distinguishes valleys from ridges of any size.

Load the plugin in ParaView and choose File > Load State. Or show a mesh of your own:

    GRIDFEM_MESH=scan.ply paraview --script=curvatures.py

GRIDFEM_MESH names a file that ParaView reads. Without it, the state shows a ring with waves. Change
Smoothing Scale of Curvatures for a noisy scan.
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
curvatures = PrincipalCurvatures(Input=mesh, SmoothingScale=0.004)
simple.RenameSource("Curvatures", curvatures)

layout = simple.CreateLayout("Curvatures")
layout.SplitHorizontal(0, 0.5)
views = [simple.CreateRenderView(), simple.CreateRenderView()]
for cell, view, array in zip((1, 2), views, ("Bending", "ShapeIndex")):
    layout.AssignView(cell, view)
    display = simple.Show(curvatures, view)
    simple.ColorBy(display, ("POINTS", array))
    display.RescaleTransferFunctionToDataRange(False, True)
    display.SetScalarBarVisibility(view, True)

simple.AddCameraLink(views[0], views[1], "Curvatures")
views[0].CameraPosition = [0.4, 0.5, -1.0]
views[0].CameraFocalPoint = [0.0, 0.0, 0.0]
views[0].CameraViewUp = [0.0, 1.0, 0.0]
simple.ResetCamera(views[0])
views[0].CameraParallelProjection = 1
for view in views:
    simple.Render(view)
simple.SetActiveSource(curvatures)
