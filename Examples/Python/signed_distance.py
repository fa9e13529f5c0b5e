"""Signed distances from curves, in ParaView's Python: from a slice of a surface, and from the border of
a region.

    PV_PLUGIN_CONFIG_FILE=build/paraview/gridfem.plugins.xml \\
        xvfb-run -a pvpython signed_distance.py MESH DEPTH PICTURE.png

MESH is a file that ParaView reads (.ply, .vtp, ...).
"""

import pathlib
import sys

from paraview import servermanager, simple
from vtkmodules.vtkFiltersCore import vtkContourFilter, vtkTubeFilter

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))

from sheet import Layer, Tile, from_the_front, required, write_sheet

INTERVALS = 12  # on each side


def isolines(mesh, values, radius):
    """Lines of equal distance, as tubes; the radius is a part of the size of the mesh."""
    lines = vtkContourFilter()
    lines.SetInputData(mesh)
    lines.SetInputArrayToProcess(0, 0, 0, 0, "Distance")
    for k, value in enumerate(values):
        lines.SetValue(k, value)
    tubes = vtkTubeFilter()
    tubes.SetInputConnection(lines.GetOutputPort())
    tubes.SetRadius(radius * mesh.GetLength())
    tubes.Update()
    return tubes.GetOutput()


def tile(label, distance):
    """Colors that are white at the curve, the curve, and isolines on both sides."""
    mesh = required(servermanager.Fetch(distance))
    low, high = mesh.GetPointData().GetArray("Distance").GetRange()
    print(f"{label}: from {low:.4g} to {high:.4g}")
    largest = max(-low, high)
    levels = [k * largest / INTERVALS for k in range(-INTERVALS, INTERVALS + 1) if k != 0]
    layers = [Layer(mesh, "Distance", -largest, largest),
              Layer(isolines(mesh, levels, 0.0012), color=(0.1, 0.1, 0.1)),
              Layer(isolines(mesh, [0.0], 0.003), color=(0.95, 0.75, 0.1))]
    return Tile(label, from_the_front(mesh), layers)


def main():
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    simple.LoadDistributedPlugin("GridFEM", remote=False, ns=globals())
    surface = simple.OpenDataFile(sys.argv[1])
    surface.UpdatePipeline()
    bounds = surface.GetDataInformation().GetBounds()
    low, high = bounds[0::2], bounds[1::2]
    center = [(a + b) / 2 for a, b in zip(low, high)]

    cut = simple.Slice(Input=surface)
    cut.SliceType.Origin = center
    cut.SliceType.Normal = [0.2, 1.0, 0.1]
    from_slice = GeodesicDistance(Input=surface, Sources=cut, Signed=1, Depth=int(sys.argv[2]))

    labels = simple.Calculator(Input=surface, ResultArrayName="Label",
                               Function=f"if(coordsX > {center[0]}, 1, 0)")
    from_label = GeodesicDistance(Input=labels, Signed=1, LabelArray=["POINTS", "Label"],
                                  Depth=int(sys.argv[2]))
    tiles = [tile("from a slice", from_slice), tile("from the border of a label", from_label)]
    write_sheet(tiles, sys.argv[3], len(tiles), (420, 440))


main()
