"""A ParaView state: noise is taken off an array. The left view has noisy stripes. The right view
has the result of Screened Poisson.

Load the plugin in ParaView and choose File > Load State. Or show a mesh of your own:

    GRIDFEM_MESH=scan.ply paraview --script=poisson.py

GRIDFEM_MESH names a file that ParaView reads. Without it, the state shows a ring with waves. Change
Screening Weight of Smoothed: a larger weight keeps more detail.
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
random = simple.RandomAttributes(
    Input=mesh, GeneratePointScalars=1, GeneratePointVectors=0, GenerateCellVectors=0,
    ComponentRange=[-1.0, 1.0], DataType="Double")
noisy = simple.Calculator(
    Input=random, ResultArrayName="Noisy",
    Function=f"sin({25 / size}*coordsX)+RandomPointScalars")
simple.RenameSource("Noisy", noisy)
smoothed = ScreenedPoisson(
    Input=noisy, ValueArray=["POINTS", "Noisy"], ScreeningWeight=1000, Depth=6)
simple.RenameSource("Smoothed", smoothed)

layout = simple.CreateLayout("Noise")
layout.SplitHorizontal(0, 0.5)
views = [simple.CreateRenderView(), simple.CreateRenderView()]
for cell, view, shown, array in zip((1, 2), views, (noisy, smoothed), ("Noisy", "Solution")):
    layout.AssignView(cell, view)
    display = simple.Show(shown, view)
    simple.ColorBy(display, ("POINTS", array))
    colors = simple.GetColorTransferFunction(array)
    colors.RescaleTransferFunction(-1.5, 1.5)
    colors.AutomaticRescaleRangeMode = "Never"
    display.SetScalarBarVisibility(view, True)

simple.AddCameraLink(views[0], views[1], "Noise")
views[0].CameraPosition = [0.4, 0.5, -1.0]
views[0].CameraFocalPoint = [0.0, 0.0, 0.0]
views[0].CameraViewUp = [0.0, 1.0, 0.0]
simple.ResetCamera(views[0])
views[0].CameraParallelProjection = 1
for view in views:
    simple.Render(view)
simple.SetActiveSource(smoothed)
