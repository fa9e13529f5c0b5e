"""A ParaView state: values from a few points, spread over a surface: harmonic in the left view, with peaks
at the points, biharmonic in the right one, smooth there.

Load the plugin in ParaView and choose File > Load State. Or show a mesh of your own:

    GRIDFEM_MESH=scan.ply paraview --script=interpolation.py

GRIDFEM_MESH names a file that ParaView reads. Without it, the state shows a ring with waves. Select
points of a surface with an array, press Copy Active Selection in the panel, and Apply.
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
few = simple.MaskPoints(
    Input=mesh, MaximumNumberofPoints=12, RandomSampling=1, GenerateVertices=1,
    SingleVertexPerCell=1)
given = simple.Calculator(
    Input=few, ResultArrayName="Given",
    Function=f"sin({9 / size}*coordsX)+cos({7 / size}*coordsY)+sin({11 / size}*coordsZ)")
simple.RenameSource("Given", given)
spread = [HarmonicInterpolation(Input=mesh, Values=given, ValueArray=["POINTS", "Given"],
                                Smoothness=smoothness, Depth=6)
          for smoothness in ("Harmonic", "Biharmonic")]
simple.RenameSource("Harmonic", spread[0])
simple.RenameSource("Biharmonic", spread[1])

layout = simple.CreateLayout("Interpolation")
layout.SplitHorizontal(0, 0.5)
views = [simple.CreateRenderView(), simple.CreateRenderView()]
for cell, view, shown in zip((1, 2), views, spread):
    layout.AssignView(cell, view)
    display = simple.Show(shown, view)
    simple.ColorBy(display, ("POINTS", "Interpolated"))
    display.SetScalarBarVisibility(view, shown is spread[1])
    balls = simple.Show(given, view)
    balls.SetRepresentationType("Point Gaussian")
    balls.GaussianRadius = 0.02 * size
    simple.ColorBy(balls, ("POINTS", "Given"))
for array in ("Interpolated", "Given"):
    colors = simple.GetColorTransferFunction(array)
    colors.RescaleTransferFunction(-2.0, 2.0)
    colors.AutomaticRescaleRangeMode = "Never"

simple.AddCameraLink(views[0], views[1], "Interpolation")
views[0].CameraPosition = [0.4, 0.5, -1.0]
views[0].CameraFocalPoint = [0.0, 0.0, 0.0]
views[0].CameraViewUp = [0.0, 1.0, 0.0]
simple.ResetCamera(views[0])
views[0].CameraParallelProjection = 1
for view in views:
    simple.Render(view)
simple.SetActiveSource(spread[0])
