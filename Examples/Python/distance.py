"""Distances along a surface, in ParaView's Python: isolines from one point and from four, and the
regions of eight. Each point is as far as possible from the points before it.

    PV_PLUGIN_CONFIG_FILE=build/paraview/gridfem.plugins.xml \\
        xvfb-run -a pvpython distance.py MESH DEPTH PICTURE.png

MESH is a file that ParaView reads (.ply, .vtp, ...).
"""

import pathlib
import sys

from paraview import servermanager, simple
from vtkmodules.vtkCommonCore import vtkIntArray
from vtkmodules.vtkFiltersCore import vtkContourFilter, vtkTubeFilter

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))

from sheet import Layer, Tile, from_the_front, required, write_sheet

INTERVALS = 24


def isolines(mesh, largest):
    """The lines of equal distance, as thin tubes."""
    lines = vtkContourFilter()
    lines.SetInputData(mesh)
    lines.SetInputArrayToProcess(0, 0, 0, 0, "Distance")
    for k in range(1, INTERVALS):
        lines.SetValue(k - 1, k * largest / INTERVALS)
    tubes = vtkTubeFilter()
    tubes.SetInputConnection(lines.GetOutputPort())
    tubes.SetRadius(0.0012 * mesh.GetLength())
    tubes.Update()
    return tubes.GetOutput()


def add_regions(mesh, sources):
    """The point array Region: the number of the nearest source in the list, for few colors."""
    nearest = mesh.GetPointData().GetArray("NearestPoint")
    number = {source: k for k, source in enumerate(sources)}
    region = vtkIntArray()
    region.SetName("Region")
    for p in range(mesh.GetNumberOfPoints()):
        region.InsertNextValue(number.get(nearest.GetValue(p), -1))
    mesh.GetPointData().AddArray(region)


def main():
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    simple.LoadDistributedPlugin("GridFEM", remote=False, ns=globals())
    surface = simple.OpenDataFile(sys.argv[1])
    distance = FarthestPoints(Input=surface, Depth=int(sys.argv[2]))
    tiles = []
    for count, label in ((1, "distance from one point"), (4, "from four points"),
                         (8, "nearest of eight points")):
        distance.NumberOfPoints = count
        distance.UpdatePipeline()
        mesh = required(servermanager.Fetch(distance))
        largest = mesh.GetFieldData().GetArray("Radius").GetValue(0)
        print(f"{label}: at most {largest:.4g}")
        colors = Layer(mesh, "Distance", 0.0, largest)
        if count == 8:
            points = mesh.GetFieldData().GetArray("FarthestPoints")
            add_regions(mesh, [points.GetValue(k) for k in range(points.GetNumberOfTuples())])
            colors = Layer(mesh, "Region", shuffled=True)
        layers = [colors,
                  Layer(isolines(mesh, largest), color=(0.1, 0.1, 0.1))]
        tiles.append(Tile(label, from_the_front(mesh), layers))
    write_sheet(tiles, sys.argv[3], len(tiles), (420, 440))


main()
