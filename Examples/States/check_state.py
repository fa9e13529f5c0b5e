"""Loads a state of this folder and draws it; ends with 1 unless its source of this name has at least so
many time steps, the point array there differs from point to point, and every view shows more than its
background.

    pvpython check_state.py STATE.py SOURCE ARRAY STEPS PICTURE.png
"""

import runpy
import sys

from paraview import servermanager, simple
from vtkmodules.vtkRenderingCore import vtkWindowToImageFilter


def colors(view):
    """How many colours a view shows."""
    simple.Render(view)
    image = vtkWindowToImageFilter()
    image.SetInput(view.SMProxy.GetRenderWindow())
    image.Update()
    pixels = image.GetOutput().GetPointData().GetScalars()
    step = max(1, pixels.GetNumberOfTuples() // 20000)
    return len({pixels.GetTuple(k) for k in range(0, pixels.GetNumberOfTuples(), step)})


path, name, array, expected, picture = sys.argv[1:]
runpy.run_path(path)
source = simple.FindSource(name)
low, high = source.PointData[array].GetRange()
steps = len(getattr(source, "TimestepValues", []))
shown = [colors(view) for view in simple.GetViews() if view.IsA("vtkSMRenderViewProxy")]
print(f"{steps} time steps; {array} lies between {low:.3g} and {high:.3g}; {shown} colours")
simple.SaveScreenshot(picture, simple.GetLayout(), ImageResolution=[1200, 560])
simple.Disconnect()  # closes the view while its display is still there
sys.exit(0 if steps >= int(expected) and low < high and min(shown) > 20 else 1)
