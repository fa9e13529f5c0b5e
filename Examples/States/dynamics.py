"""A ParaView state: spots that grow on a surface, and spiral waves beside them.

Load the plugin in ParaView and choose File > Load State. Or show a mesh of your own:

    GRIDFEM_MESH=scan.ply paraview --script=dynamics.py

GRIDFEM_MESH names a file that ParaView reads. Without it, the state shows a ring with waves. Play the
animation, or change Model of Spots.
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
spots = SurfaceDynamics(Input=mesh, Depth=6, PatternLength=0.15, NumberOfSteps=30)
simple.RenameSource("Spots", spots)
spirals = SurfaceDynamics(
    Input=mesh, Depth=6, Model="FitzHugh-Nagumo", PatternLength=0.25, NumberOfSteps=30)
simple.RenameSource("Spirals", spirals)

layout = simple.CreateLayout("Dynamics")
layout.SplitHorizontal(0, 0.5)
views = [simple.CreateRenderView(), simple.CreateRenderView()]
for cell, view, shown in zip((1, 2), views, (spots, spirals)):
    layout.AssignView(cell, view)
    display = simple.Show(shown, view)
    simple.ColorBy(display, ("POINTS", "U"), separate=True)
    display.SetScalarBarVisibility(view, True)
simple.GetAnimationScene().UpdateAnimationUsingDataTimeSteps()
simple.GetAnimationScene().AnimationTime = 30

simple.AddCameraLink(views[0], views[1], "Dynamics")
views[0].CameraPosition = [0.4, 0.5, -1.0]
views[0].CameraFocalPoint = [0.0, 0.0, 0.0]
views[0].CameraViewUp = [0.0, 1.0, 0.0]
simple.ResetCamera(views[0])
views[0].CameraParallelProjection = 1
for view in views:
    simple.Render(view)
simple.SetActiveSource(spots)
