"""A ParaView state: a surface and another pose of it. Corresponding places have the same color.

Load the plugin in ParaView and choose File > Load State. Or show a mesh of your own:

    GRIDFEM_MESH=scan.ply paraview --script=matching.py

GRIDFEM_MESH names a file that ParaView reads. Without it, the state shows a star with five arms. The right view
has the surface after a twist. Color it by Mismatch to see where the surfaces differ by more than bending.
"""

import os

from paraview import simple

simple.LoadDistributedPlugin("GridFEM", remote=False, ns=globals())

path = os.environ.get("GRIDFEM_MESH")
ball = simple.Sphere(Radius=1.0, ThetaResolution=160, PhiResolution=80)
arms = ((1, 0, 0, 1.7), (0.31, 0.95, 0, 0.6), (-0.81, 0.59, 0, 1.2), (-0.81, -0.59, 0, 0.9), (0.31, -0.95, 0, 1.4),
        (0, 0, 1, 0.3))
star = "+".join(
    f"{length}*exp(-9*((coordsX-({x}))^2+(coordsY-({y}))^2+(coordsZ-({z}))^2))" for x, y, z, length in arms)
mesh = simple.OpenDataFile(path) if path else simple.Calculator(
    Input=ball, CoordinateResults=1, Function=f"coords*(0.5+{star})")
simple.RenameSource("Mesh", mesh)
mesh.UpdatePipeline()
bounds = mesh.GetDataInformation().GetBounds()
x, y, z = ((bounds[k] + bounds[k + 1]) / 2 for k in (0, 2, 4))
size = max(bounds[1] - bounds[0], bounds[3] - bounds[2])

# A turn about the axis of z that grows with the distance from the axis, and a bend upwards.
square = f"((coordsX-({x}))^2+(coordsY-({y}))^2)/{size * size}"
turned = (f"((coordsX-({x}))*cos(1.5*{square})-(coordsY-({y}))*sin(1.5*{square}))*iHat"
          f"+((coordsX-({x}))*sin(1.5*{square})+(coordsY-({y}))*cos(1.5*{square}))*jHat"
          f"+(coordsZ-({z})+{0.8 * size}*{square})*kHat")
pose = simple.Calculator(Input=mesh, CoordinateResults=1, Function=turned)
simple.RenameSource("Pose", pose)
matched = FunctionalMap(Input=pose, Reference=mesh)
simple.RenameSource("Matched", matched)

layout = simple.CreateLayout("Matching")
layout.SplitHorizontal(0, 0.5)
views = [simple.CreateRenderView(), simple.CreateRenderView()]
for cell, view, port in zip((1, 2), views, (1, 0)):
    layout.AssignView(cell, view)
    display = simple.Show(simple.OutputPort(matched, port), view)
    simple.ColorBy(display, ("POINTS", "MatchingColors"))
    display.MapScalars = 0
    simple.ResetCamera(view)
    view.CameraParallelProjection = 1
    simple.Render(view)
simple.SetActiveSource(matched)
