"""A ParaView state: folds that nearly touch unfold. The left view has plain functions, the right one has
connectivity-aware functions.

Load the plugin in ParaView and choose File > Load State. Or show the knot of the main job:

    GRIDFEM_MESH=output/modes.vtp paraview --script=unfolding.py

GRIDFEM_MESH names a .vtp file. Without it, the state shows a ring, which has no folds. Play the
animation. Plain functions pull both strands together where they share a cell. Connectivity-aware
functions let them part.
"""

import os

from paraview.simple import (
    ColorBy,
    CreateLayout,
    CreateRenderView,
    GetAnimationScene,
    GetColorTransferFunction,
    LoadDistributedPlugin,
    OutputPort,
    RenameSource,
    Render,
    ResetCamera,
    Show,
    Superquadric,
    XMLPolyDataReader,
)

LoadDistributedPlugin("GridFEM", remote=False, ns=globals())

if "GRIDFEM_MESH" in os.environ:
    mesh = XMLPolyDataReader(FileName=[os.environ["GRIDFEM_MESH"]])
else:
    mesh = Superquadric(Toroidal=1, ThetaResolution=192, PhiResolution=96)
RenameSource("Mesh", mesh)


def unfold(connectivity_aware, name):
    flow = MeanCurvatureFlow(  # noqa: F821, from the plugin
        Input=mesh, Depth=5, ConnectivityAware=connectivity_aware, Conformalized=1, TimeStep=1e-3,
        NumberOfSteps=8)
    RenameSource(name, flow)
    return flow


plain = unfold(0, "Plain")
aware = unfold(1, "Connectivity-Aware")

layout = CreateLayout("Unfolding")
views = [CreateRenderView(), CreateRenderView()]
layout.SplitHorizontal(0, 0.5)
for cell, view, flow in zip((1, 2), views, (plain, aware)):
    layout.AssignView(cell, view)
    display = Show(flow, view)
    Show(OutputPort(flow, 2), view)  # the number of the step
    ColorBy(display, ("POINTS", "ConformalFactor"))
    display.SetScalarBarVisibility(view, flow is aware)
colors = GetColorTransferFunction("ConformalFactor")
colors.RescaleTransferFunction(0.2, 2.0)  # of all steps
colors.AutomaticRescaleRangeMode = "Never"
scene = GetAnimationScene()
scene.UpdateAnimationUsingDataTimeSteps()
scene.AnimationTime = 8  # the largest surface, for the camera
for view in views:
    ResetCamera(view)
    Render(view)
scene.AnimationTime = 4
