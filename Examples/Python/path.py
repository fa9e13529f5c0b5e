"""Shortest paths along a surface, in ParaView's Python: from one point to others, and a closed line through
all of them. The points are far from each other.

    PV_PLUGIN_CONFIG_FILE=build/lib/paraview-5.11/plugins/gridfem.plugins.xml \\
        xvfb-run -a pvpython path.py MESH DEPTH PICTURE.png

MESH is a file that ParaView reads (.ply, .vtp, ...). DEPTH is for the choice of the points.
"""

import pathlib
import sys

from paraview import servermanager, simple
from vtkmodules.vtkFiltersCore import vtkTubeFilter

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))

from sheet import RED, Layer, Tile, from_the_front, required, write_sheet

POINTS = 6


def tubes(lines, radius):
    """The lines, thick enough to be seen."""
    tube = vtkTubeFilter()
    tube.SetInputData(lines)
    tube.SetRadius(radius)
    tube.SetNumberOfSides(12)
    tube.Update()
    return tube.GetOutput()


def main():
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    simple.LoadDistributedPlugin("GridFEM", remote=False, ns=globals())
    surface = simple.OpenDataFile(sys.argv[1])
    found = servermanager.Fetch(
        FarthestPoints(Input=surface, NumberOfPoints=POINTS, Depth=int(sys.argv[2])))
    array = required(found).GetFieldData().GetArray("FarthestPoints")
    ids = [int(array.GetValue(k)) for k in range(array.GetNumberOfTuples())]
    path = GeodesicPaths(Input=surface, TargetPointIds=ids)
    tiles = []
    for kind, label in (("To Nearest Source", "from one point to the others"),
                        ("Closed", "through all points and back")):
        path.PathType = kind
        path.UpdatePipeline()
        mesh = required(servermanager.Fetch(path))
        lines = required(servermanager.Fetch(path, idx=1))
        lengths = lines.GetCellData().GetArray("Length")
        print(f"{label}: " + ", ".join(f"{lengths.GetValue(k):.4g}" for k in range(lengths.GetNumberOfTuples())))
        layers = [Layer(mesh), Layer(tubes(lines, 0.003 * mesh.GetLength()), color=RED)]
        tiles.append(Tile(label, from_the_front(mesh), layers))
    write_sheet(tiles, sys.argv[3], len(tiles), (420, 440))


main()
