"""A ParaView state: signatures of the points of a surface, computed from its modes. The left view
has the heat kernel signature, which is the same at points that look alike. The right view has the
biharmonic distance from a point.

Load the plugin in ParaView and choose File > Load State. Or show a mesh of your own:

    GRIDFEM_MESH=scan.ply paraview --script=signatures.py

GRIDFEM_MESH names a file that ParaView reads. Without it, the state shows a ring with waves. Change
Shown Scale or Source Point Ids of Signatures; the modes stay.
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
modes = LaplaceSpectrum(Input=mesh, Depth=5, NumberOfModes=60, AllModes=1)
simple.RenameSource("Modes", modes)
signatures = SpectralSignatures(Input=modes, Depth=5, SourcePointIds=[0])
simple.RenameSource("Signatures", signatures)

layout = simple.CreateLayout("Signatures")
layout.SplitHorizontal(0, 0.5)
views = [simple.CreateRenderView(), simple.CreateRenderView()]
for cell, view, array in zip((1, 2), views, ("Signature", "BiharmonicDistance")):
    layout.AssignView(cell, view)
    display = simple.Show(signatures, view)
    simple.ColorBy(display, ("POINTS", array))
    display.RescaleTransferFunctionToDataRange(False, True)
    display.SetScalarBarVisibility(view, True)

simple.AddCameraLink(views[0], views[1], "Signatures")
views[0].CameraPosition = [0.4, 0.5, -1.0]
views[0].CameraFocalPoint = [0.0, 0.0, 0.0]
views[0].CameraViewUp = [0.0, 1.0, 0.0]
simple.ResetCamera(views[0])
views[0].CameraParallelProjection = 1
for view in views:
    simple.Render(view)
simple.SetActiveSource(signatures)
