"""Whether what was selected with the mouse is what distances start from and what is sharpened, and the
curve has the point that was drawn."""
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir))

from paraview import simple

import plugin

plugin.load()
simple.LoadState(sys.argv[1])
detail = simple.FindSource("SurfaceDetail1")
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
