"""A ParaView state: a random field on a surface. The left view has a sample, the right one the standard
deviation of two hundred samples, which is larger at the boundary.

Load the plugin in ParaView and choose File > Load State. Or show a mesh of your own:

    GRIDFEM_MESH=terrain.ply paraview --script=gaussian_field.py

GRIDFEM_MESH names a file that ParaView reads. Without it, the state shows half a ring with waves. Change
Range, Smoothness and Seed of Sample.
"""

import os

from paraview import simple

simple.LoadDistributedPlugin("GridFEM", remote=False, ns=globals())

path = os.environ.get("GRIDFEM_MESH")
ring = simple.Superquadric(Toroidal=1, ThetaResolution=192, PhiResolution=96)
waves = "0.15*sin(7*coordsX+1)*cos(6*coordsZ)"
if path:
    mesh = simple.OpenDataFile(path)
else:
    wavy = simple.Calculator(Input=ring, CoordinateResults=1, Function=f"coords*(1+{waves})")
    mesh = simple.Clip(Input=wavy, ClipType="Plane")
    mesh.ClipType.Normal = [1, 0, 0.2]
    mesh = simple.ExtractSurface(Input=mesh)
simple.RenameSource("Mesh", mesh)
sample = GaussianField(Input=mesh, Range=0.15, Depth=6)
simple.RenameSource("Sample", sample)
statistics = GaussianField(Input=mesh, Range=0.15, Depth=6, NumberOfSamples=200, Statistics=1)
simple.RenameSource("Statistics", statistics)

layout = simple.CreateLayout("Random field")
layout.SplitHorizontal(0, 0.5)
views = [simple.CreateRenderView(), simple.CreateRenderView()]
for cell, view, source, array in zip(
        (1, 2), views, (sample, statistics), ("Sample000", "SampleStandardDeviation")):
    layout.AssignView(cell, view)
    source.UpdatePipeline()
    display = simple.Show(source, view)
    simple.ColorBy(display, ("POINTS", array), separate=True)
    display.RescaleTransferFunctionToDataRange(False, True)
    display.SetScalarBarVisibility(view, True)

simple.AddCameraLink(views[0], views[1], "Random field")
views[0].CameraPosition = [1.0, 0.6, -1.0]
views[0].CameraFocalPoint = [0.0, 0.0, 0.0]
views[0].CameraViewUp = [0.0, 1.0, 0.0]
simple.ResetCamera(views[0])
views[0].CameraParallelProjection = 1
for view in views:
    simple.Render(view)
simple.SetActiveSource(sample)
