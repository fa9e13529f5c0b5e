"""Checks that the states of UsePanels.xml hold the choices made with the mouse, and compute with them."""
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir))

from paraview import simple

import plugin


def load(name):
    """Returns the filters of a state, in the order of the pipeline."""
    simple.ResetSession()
    simple.LoadState(f"{sys.argv[1]}/{name}.pvsm")
    return [proxy for proxy in simple.GetSources().values() if proxy.SMProxy.GetXMLName() in plugin.PROXIES]


def only(filters, name):
    found = [proxy for proxy in filters if proxy.SMProxy.GetXMLName() == name]
    if len(found) != 1:
        sys.exit(f"the state has {len(found)} of {name}")
    return found[0]


def check_selection():
    """Distances start from the selected points, and these points are sharpened. The curve has the drawn
    point."""
    detail = only(load("selection"), "SurfaceDetail")
    arrays = plugin.data(detail).GetPointData()
    selected, distance, moved = (
        [arrays.GetArray(name).GetTuple1(point) for point in range(arrays.GetNumberOfTuples())]
        for name in ("Selected", "Distance", "NormalDisplacement"))
    sources = [point for point, value in enumerate(distance) if value == 0]
    if not 3 < len(sources) < len(distance) / 4:
        sys.exit(f"distances start from {len(sources)} of {len(distance)} points")
    inside = [point for point, value in enumerate(selected) if value == 1]
    if inside != sources:
        sys.exit(f"sharpened are {inside}, sources are {sources}")
    far = max(abs(m) for m, d in zip(moved, distance) if d > 0.5)
    near = max(abs(moved[point]) for point in inside)
    if not far < 0.05 * near:
        sys.exit(f"what is far from the selection has moved by {far}, the selection by {near}")
    points = list(detail.CustomTransferFunction.Points)
    if len(points) != 16 or not 0.3 < points[8] < 0.7 or points[:4] != [-1, 1, 0.5, 0]:
        sys.exit(f"the curve has the points {points}")


def check_arrays():
    """The filters have computed on the chosen arrays, and stitched colors are shown unchanged."""
    filters = load("arrays")
    stitched = only(filters, "StitchColors")
    steep = stitched.Input
    smoothed = steep.Input
    if list(smoothed.ValueArray) != ["POINTS", "colors"]:
        sys.exit(f"smoothed were {smoothed.ValueArray}")
    colors = plugin.data(smoothed).GetPointData().GetArray("Solution")
    if colors.GetNumberOfComponents() != 3 or not 200 < colors.GetRange(0)[1] < 255:
        sys.exit(f"no smoothed colors: {colors.GetNumberOfComponents()} {colors.GetRange(0)}")
    if list(steep.GradientArray) != ["POINTS", "direction"]:
        sys.exit(f"gradients were taken from {steep.GradientArray}")
    # The height of a sphere of radius 1/2. Gradients twice as long make it steeper.
    highest = plugin.data(steep).GetPointData().GetArray("Solution").GetRange()[1]
    if not highest > 0.51:
        sys.exit(f"the gradients were not used: {highest}")
    shown = [part for part in simple.GetRepresentations().values()
             if getattr(part, "Input", None) == stitched and part.Visibility]
    if len(shown) != 1 or shown[0].ColorArrayName[1] != "StitchedColors" or shown[0].MapScalars:
        sys.exit(f"stitched colors are shown {[(part.ColorArrayName, part.MapScalars) for part in shown]}")


def check_chain():
    """In the state each filter is on the filter before, and the last filter has the arrays of
    all."""
    spectrum = only(load("chain"), "LaplaceSpectrum")
    names = []
    proxy = spectrum
    while proxy.SMProxy.GetXMLName() in plugin.PROXIES:
        names.append(proxy.SMProxy.GetXMLName())
        proxy = proxy.Input
    if names != ["LaplaceSpectrum", "ScreenedPoisson", "ConnectivityAwareBasis", "ClipToOctree"]:
        sys.exit(f"the chain is {names}")
    arrays = plugin.data(spectrum).GetPointData()
    for name in ("Solution", "Mode"):
        if not arrays.HasArray(name):
            sys.exit(f"no array {name}")


def check_blocks():
    """The check box in the panel has made one surface of the blocks."""
    distance = only(load("blocks"), "GeodesicDistance")
    if not distance.BlocksAsOne:
        sys.exit("the box is not ticked")
    data = plugin.data(distance)
    farthest = max(data.GetBlock(block).GetPointData().GetArray("Distance").GetRange()[1] for block in (0, 1))
    if not 3.0 < farthest < 3.3:  # from pole to pole; each half by itself ends at its border
        sys.exit(f"the farthest point is {farthest} away")


plugin.load()
check_selection()
check_arrays()
check_chain()
check_blocks()
