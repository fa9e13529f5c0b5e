"""Loads all states of this folder one after the other, at depth 4 to save time, and draws them
small. Ends with 1 if a state has too few time steps, if the point array of its source is constant,
or if a view shows only its background.

    pvpython check_states.py FOLDER

writes the pictures into the folder. GRIDFEM_MESH names the mesh.
"""

import pathlib
import re
import sys

from paraview import simple
from vtkmodules.vtkRenderingCore import vtkWindowToImageFilter

# For each state a source, an array of points at one of its ports, and the time steps that it has at least.
STATES = {
    "curvatures": ("Curvatures", "ShapeIndex", 0),
    "detail": ("smoothed, everywhere", "NormalDisplacement", 0),
    "diffusion": ("Diffused", "Diffused", 20),
    "distance": ("Distance", "Distance", 0),
    "dynamics": ("Spots", "U", 30),
    "farthest": ("Points", "Distance", 0),
    "gradient": ("Parts", "StreamFunction", 0),
    "interpolation": ("Biharmonic", "Interpolated", 0),
    "matching": ("Matched", "Mismatch", 0),
    "modes": ("LaplaceSpectrum1", "Mode", 19),
    "octree": ("Basis", "BasisFunction", 0),
    "flatten": ("Conformal", "TCoords", 0),
    "path": ("Lines of Paths", "ArcLength", 0),
    "poisson": ("Smoothed", "Solution", 0),
    "gaussian_field": ("Sample", "Sample000", 0),
    "signatures": ("Signatures", "BiharmonicDistance", 0),
    "spray": ("Detail", "Selected", 0),
    "stitch": ("Stitched", "StitchedColors", 0),
    "unfolding": ("Connectivity-Aware", "ConformalFactor", 9),
}


def load(name):
    path = pathlib.Path(__file__).with_name(f"{name}.py")
    text = re.sub(r"\bDepth=\d+", "Depth=4", path.read_text(encoding="utf-8"))
    exec(compile(text, str(path), "exec"), {"__name__": "__main__", "__file__": str(path)})


def clear():
    """Deletes all that a state has made."""
    for proxies in simple.GetViews(), simple.GetLayouts().values(), simple.GetSources().values():
        for proxy in list(proxies):
            simple.Delete(proxy)


def colors(view):
    """How many colors a view shows."""
    view.ViewSize = [200, 150]
    simple.Render(view)
    image = vtkWindowToImageFilter()
    image.SetInput(view.SMProxy.GetRenderWindow())
    image.Update()
    pixels = image.GetOutput().GetPointData().GetScalars()
    return len({pixels.GetTuple(k) for k in range(pixels.GetNumberOfTuples())})


def is_as_expected(name, picture):
    source_name, array, expected = STATES[name]
    load(name)
    source = simple.FindSource(source_name)
    found = [simple.OutputPort(source, port).PointData[array]
             for port in range(source.SMProxy.GetNumberOfOutputPorts())]
    low, high = next(information for information in found if information).GetRange()
    steps = len(getattr(source, "TimestepValues", []))
    shown = [colors(view) for view in simple.GetViews() if view.IsA("vtkSMRenderViewProxy")]
    print(f"{name}: {steps} time steps; {array} lies between {low:.3g} and {high:.3g}; {shown} colors",
          flush=True)
    simple.SaveScreenshot(str(picture), simple.GetLayout(), ImageResolution=[400, 150])
    clear()
    return steps >= expected and low < high and min(shown) > 20


# Every state loads the plugin, which takes as long as its filters. Here it is loaded once.
filters = {"simple": simple}
simple.LoadDistributedPlugin("GridFEM", remote=False, ns=filters)
simple.LoadDistributedPlugin = lambda *_, ns, **__: ns.update(filters)
folder = pathlib.Path(sys.argv[1])
wrong = [name for name in STATES if not is_as_expected(name, folder / f"state_{name}.png")]
simple.Disconnect()  # closes the views while their display is still there
sys.exit(f"not as expected: {', '.join(wrong)}" if wrong else 0)
