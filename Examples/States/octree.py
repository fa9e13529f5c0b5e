"""A ParaView state: how a surface is laid into an octree. The left view has the cut surface and its
cells, the right one a basis function, which lives on one connected piece of its support.

Load the plugin in ParaView and choose File > Load State. Or show a mesh of your own:

    GRIDFEM_MESH=scan.ply paraview --script=octree.py

GRIDFEM_MESH names a file that ParaView reads. Without it, the state shows a ring with waves. Change
Depth of the source Clip, or Basis Id of Basis, and press Apply.
"""

import os

from paraview import servermanager, simple

simple.LoadDistributedPlugin("GridFEM", remote=False, ns=globals())

path = os.environ.get("GRIDFEM_MESH")
ring = simple.Superquadric(Toroidal=1, ThetaResolution=192, PhiResolution=96)
waves = "0.25*sin(11*coordsX+1)*cos(9*coordsZ)"
mesh = simple.OpenDataFile(path) if path else simple.Calculator(
    Input=ring, CoordinateResults=1, Function=f"coords*(1+{waves})")
simple.RenameSource("Mesh", mesh)
clip = ClipToOctree(Input=mesh, Depth=4)
simple.RenameSource("Clip", clip)
basis = ConnectivityAwareBasis(Input=clip)
simple.RenameSource("Basis", basis)

# The function in front that lives on the largest part of the surface.
functions = servermanager.Fetch(basis, idx=1)
area = functions.GetPointData().GetArray("SupportArea")
middle = functions.GetCenter()[2]
front = (k for k in range(functions.GetNumberOfPoints()) if functions.GetPoint(k)[2] < middle)
ids = functions.GetPointData().GetArray("BasisId")
basis.BasisId = ids.GetValue(max(front, key=area.GetValue))

layout = simple.CreateLayout("Octree")
layout.SplitHorizontal(0, 0.5)
views = [simple.CreateRenderView(), simple.CreateRenderView()]
for cell, view in zip((1, 2), views):
    layout.AssignView(cell, view)
cut = simple.Show(clip, views[0])
cut.SetRepresentationType("Surface")
simple.ColorBy(cut, ("CELLS", "OctreeCellColor"))
cells = simple.Show(simple.OutputPort(clip, 2), views[0])
cells.SetRepresentationType("Wireframe")
cells.ColorArrayName, cells.AmbientColor = [None, ""], [0.1, 0.1, 0.1]
function = simple.Show(basis, views[1])
simple.ColorBy(function, ("POINTS", "BasisFunction"))
function.RescaleTransferFunctionToDataRange(False, True)
function.SetScalarBarVisibility(views[1], True)

simple.AddCameraLink(views[0], views[1], "Octree")
views[0].CameraPosition = [0.4, 0.5, -1.0]
views[0].CameraFocalPoint = [0.0, 0.0, 0.0]
views[0].CameraViewUp = [0.0, 1.0, 0.0]
simple.ResetCamera(views[0])
views[0].CameraParallelProjection = 1
for view in views:
    simple.Render(view)
simple.SetActiveSource(clip)
