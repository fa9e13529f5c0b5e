"""A ParaView state: eigenfunctions of a surface, one for each time step.

Load the plugin in ParaView and choose File > Load State. Or show a mesh of your own:

    GRIDFEM_MESH=output/modes.vtp paraview --script=modes.py

GRIDFEM_MESH names a .vtp file. Without it, the state shows a ring. Play the animation to step through
the modes.
"""

import os

from paraview.simple import (
    ColorBy,
    GetActiveViewOrCreate,
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
    mesh = Superquadric(
        Toroidal=1, ThetaResolution=192, PhiResolution=96, ThetaRoundness=0.6, PhiRoundness=0.6
    )
RenameSource("Mesh", mesh)

clip = ClipToOctree(Input=mesh, Depth=5)  # noqa: F821, from the plugin
basis = ConnectivityAwareBasis(Input=clip)  # noqa: F821
modes = LaplaceSpectrum(Input=mesh, Basis=basis, NumberOfModes=20)  # noqa: F821

view = GetActiveViewOrCreate("RenderView")
display = Show(modes, view)
Show(OutputPort(modes, 2), view)  # the number of the mode
ColorBy(display, ("POINTS", "Mode"))
colors = GetColorTransferFunction("Mode")
colors.ApplyPreset("Cool to Warm", True)
colors.AutomaticRescaleRangeMode = "Clamp and update every timestep"
display.RescaleTransferFunctionToDataRange(False, True)
display.SetScalarBarVisibility(view, True)
GetAnimationScene().UpdateAnimationUsingDataTimeSteps()
GetAnimationScene().AnimationTime = 5
view.CameraPosition = [1.0, 2.0, 3.0]
view.CameraFocalPoint = [0.0, 0.0, 0.0]
view.CameraViewUp = [0.0, 1.0, 0.0]
ResetCamera(view)
Render(view)
