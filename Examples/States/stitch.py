"""A ParaView state: the colors of two scans made one. The left view has the colors of two
scanners, one of them too bright and too red. The right view has the result of Stitch Colors.

Load the plugin in ParaView and choose File > Load State. Or show a mesh of your own:

    GRIDFEM_MESH=scan.ply paraview --script=stitch.py

GRIDFEM_MESH names a file that ParaView reads. Without it, the state shows a ring with waves. Change
Blend Width or Reference Label of Stitched.
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
scan = simple.Calculator(
    Input=mesh, ResultArrayName="Scan", Function=f"coordsX > {(low_x + high_x) / 2} ? 1 : 0")
seen = simple.Calculator(
    Input=scan, ResultArrayName="Seen",
    Function=f"(0.45+0.2*sin({40 / size}*coordsY))*(iHat+jHat)"
             f"+(0.5+0.2*cos({25 / size}*coordsX))*kHat+Scan*(0.3*iHat+0.15*jHat+0.1*kHat)")
simple.RenameSource("Seen", seen)
stitched = StitchColors(
    Input=seen, ColorArray=["POINTS", "Seen"], LabelArray=["POINTS", "Scan"], Depth=6)
simple.RenameSource("Stitched", stitched)

layout = simple.CreateLayout("Stitch")
layout.SplitHorizontal(0, 0.5)
views = [simple.CreateRenderView(), simple.CreateRenderView()]
for cell, view, shown, array in zip((1, 2), views, (seen, stitched), ("Seen", "StitchedColors")):
    layout.AssignView(cell, view)
    display = simple.Show(shown, view)
    simple.ColorBy(display, ("POINTS", array))
    display.MapScalars = 0
    display.SetScalarBarVisibility(view, False)

simple.AddCameraLink(views[0], views[1], "Stitch")
views[0].CameraPosition = [0.4, 0.5, -1.0]
views[0].CameraFocalPoint = [0.0, 0.0, 0.0]
views[0].CameraViewUp = [0.0, 1.0, 0.0]
simple.ResetCamera(views[0])
views[0].CameraParallelProjection = 1
for view in views:
    simple.Render(view)
simple.SetActiveSource(stitched)
