"""A ParaView state: a surface and its flat maps, colored by the change of areas. The left view has the map that
keeps angles, the right one the map that changes lengths as little as possible.

Load the plugin in ParaView and choose File > Load State. Or show a mesh of your own:

    GRIDFEM_MESH=scan.ply paraview --script=flatten.py

GRIDFEM_MESH names a file that ParaView reads. Without it, the state shows a ring with waves. Change Extra
Cuts of Conformal and Isometric.
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

layout = simple.CreateLayout("Flat maps")
layout.SplitHorizontal(0, 0.5)
views = [simple.CreateRenderView(), simple.CreateRenderView()]
for cell, view, kind in zip((1, 2), views, ("Conformal", "Isometric")):
    layout.AssignView(cell, view)
    chart = Parameterization(Input=mesh, MapType=kind)
    flat = simple.OutputPort(chart, 1)
    simple.RenameSource(kind, chart)
    for shown in (chart, flat):
        display = simple.Show(shown, view)
        simple.ColorBy(display, ("CELLS", "AreaDistortion"), separate=True)
    display.RescaleTransferFunctionToDataRange(False, True)
    display.SetScalarBarVisibility(view, True)

for view in views:
    simple.ResetCamera(view)
    view.CameraParallelProjection = 1
    simple.Render(view)
simple.SetActiveSource(chart)
