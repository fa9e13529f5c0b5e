"""A ParaView state: stripes that spread along a surface as heat does. The left view has the stripes, the
right one a time step.

Load the plugin in ParaView and choose File > Load State. Or show a mesh of your own:

    GRIDFEM_MESH=scan.ply paraview --script=diffusion.py

GRIDFEM_MESH names a file that ParaView reads. Without it, the state shows a ring with waves. Play the
animation, or change Diffusion Time of Diffused.
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
stripes = simple.Calculator(
    Input=mesh, ResultArrayName="Stripes",
    Function=f"sin({20 / (high_y - low_y)}*(coordsY-({low_y}))) > 0 ? 1 : -1")
simple.RenameSource("Stripes", stripes)
diffused = HeatDiffusion(
    Input=stripes, Depth=6, Array=["POINTS", "Stripes"], DiffusionTime=4e-3, NumberOfSteps=20)
simple.RenameSource("Diffused", diffused)

layout = simple.CreateLayout("Diffusion")
layout.SplitHorizontal(0, 0.5)
views = [simple.CreateRenderView(), simple.CreateRenderView()]
for cell, view, shown, array in zip((1, 2), views, (stripes, diffused), ("Stripes", "Diffused")):
    layout.AssignView(cell, view)
    display = simple.Show(shown, view)
    simple.ColorBy(display, ("POINTS", array))
    colors = simple.GetColorTransferFunction(array)
    colors.RescaleTransferFunction(-1.0, 1.0)
    colors.AutomaticRescaleRangeMode = "Never"
    display.SetScalarBarVisibility(view, shown is diffused)
simple.GetAnimationScene().UpdateAnimationUsingDataTimeSteps()
simple.GetAnimationScene().AnimationTime = 5

simple.AddCameraLink(views[0], views[1], "Diffusion")
views[0].CameraPosition = [0.4, 0.5, -1.0]
views[0].CameraFocalPoint = [0.0, 0.0, 0.0]
views[0].CameraViewUp = [0.0, 1.0, 0.0]
simple.ResetCamera(views[0])
views[0].CameraParallelProjection = 1
for view in views:
    simple.Render(view)
simple.SetActiveSource(diffused)
