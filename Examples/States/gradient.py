"""A ParaView state: a field of vectors taken apart. The left view has the flow out of sources with
its potential. The right view has the eddies with their stream function.

Load the plugin in ParaView and choose File > Load State. Or show a mesh of your own:

    GRIDFEM_MESH=scan.ply paraview --script=gradient.py

GRIDFEM_MESH names a file that ParaView reads. Without it, the state shows a ring with waves. Choose
other vectors of your own as Array of Parts.
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
field = simple.Calculator(
    Input=mesh, ResultArrayName="Field",
    Function=f"iHat*(1+cos({12 / size}*coordsY))+jHat*sin({9 / size}*coordsX)+"
             f"kHat*sin({7 / size}*coordsY)")
simple.RenameSource("Field", field)
parts = SurfaceGradient(Input=field, Array=["POINTS", "Field"], HodgeDecomposition=1, Depth=6)
simple.RenameSource("Parts", parts)

layout = simple.CreateLayout("Hodge")
layout.SplitHorizontal(0, 0.5)
views = [simple.CreateRenderView(), simple.CreateRenderView()]
for cell, view, array, vectors in zip(
        (1, 2), views, ("Potential", "StreamFunction"), ("GradientPart", "RotationPart")):
    layout.AssignView(cell, view)
    display = simple.Show(parts, view)
    simple.ColorBy(display, ("POINTS", array))
    display.RescaleTransferFunctionToDataRange(False, True)
    display.SetScalarBarVisibility(view, True)
    arrows = simple.Glyph(
        Input=parts, GlyphType="Arrow", OrientationArray=["POINTS", vectors],
        ScaleArray=["POINTS", vectors], ScaleFactor=0.06 * size, MaximumNumberOfSamplePoints=2000)
    simple.RenameSource(vectors, arrows)
    display = simple.Show(arrows, view)
    display.ColorArrayName, display.DiffuseColor = [None, ""], [0.1, 0.1, 0.1]

simple.AddCameraLink(views[0], views[1], "Hodge")
views[0].CameraPosition = [0.4, 0.5, -1.0]
views[0].CameraFocalPoint = [0.0, 0.0, 0.0]
views[0].CameraViewUp = [0.0, 1.0, 0.0]
simple.ResetCamera(views[0])
views[0].CameraParallelProjection = 1
for view in views:
    simple.Render(view)
simple.SetActiveSource(parts)
