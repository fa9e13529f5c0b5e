"""Runs in ParaView's window: aborts a long spectrum with the button of the window, and then computes a short one.
The program ends with status 0 if the first has given nothing and the second all of its modes."""
import ctypes
import os
import sys
import traceback

sys.path.insert(0, os.path.join(os.environ["GRIDFEM_SOURCE_DIR"], "Testing", "Plugin"))

from paraview import simple

import plugin


def outputs(proxy):
    """Returns the numbers of points and of eigenvalues that a spectrum has given, without another run."""
    result = proxy.GetClientSideObject().GetOutputDataObject
    return result(0).GetNumberOfPoints(), result(1).GetNumberOfRows()


def check():
    plugin.load()
    sphere = simple.Sphere(Radius=1.0, ThetaResolution=200, PhiResolution=100)
    sphere.UpdatePipeline()
    spectrum = simple.LaplaceSpectrum(Input=sphere, Depth=6, NumberOfModes=900)
    ctypes.CDLL(os.environ["GRIDFEM_PRESS_ABORT"]).PressAbort()
    simple.Show(spectrum)
    simple.Render()
    assert outputs(spectrum) == (0, 0), f"the aborted spectrum has {outputs(spectrum)}"

    spectrum.NumberOfModes = 5
    simple.Render()
    points = sphere.GetDataInformation().GetNumberOfPoints()
    assert outputs(spectrum) == (points, 5), f"the next spectrum has {outputs(spectrum)}"
    return "aborted the first spectrum and computed the second"


# ParaView shows what Python prints in a widget.
try:
    message, status = check(), 0
except Exception:
    message, status = traceback.format_exc(), 1
os.write(1, f"{message}\n".encode())
os._exit(status)
