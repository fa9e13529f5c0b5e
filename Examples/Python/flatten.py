"""Flat maps of a surface, in ParaView's Python: one keeps angles, one changes lengths as little as possible. The same
squares are seen on the surface and on the flat map.

    PV_PLUGIN_CONFIG_FILE=build/lib/paraview-5.11/plugins/gridfem.plugins.xml \\
        xvfb-run -a pvpython flatten.py MESH CUTS PICTURE.png

MESH is a file that ParaView reads (.ply, .vtp, ...). CUTS is the number of extra cuts.
"""

import math
import pathlib
import sys

from paraview import servermanager, simple
from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))

from sheet import Layer, Tile, from_the_front, required, write_sheet

SQUARES = 24  # along the side of the texture


def with_squares(flat):
    """Adds the cell array Squares, whose value alternates between the squares of the texture."""
    texture = flat.GetPointData().GetTCoords()
    squares = vtkDoubleArray()
    squares.SetName("Squares")
    for k in range(flat.GetNumberOfCells()):
        corners = [texture.GetTuple(flat.GetCell(k).GetPointId(i)) for i in range(3)]
        u, v = (math.floor(SQUARES * sum(c[axis] for c in corners) / 3) for axis in range(2))
        squares.InsertNextValue((u + v) % 2)
    flat.GetCellData().AddArray(squares)
    return flat


def in_space(flat):
    """The flat mesh moved back onto the surface, open along its cuts."""
    surface = vtkPolyData()
    surface.ShallowCopy(flat)
    points = vtkPoints()
    points.SetData(flat.GetPointData().GetArray("SurfacePosition"))
    surface.SetPoints(points)
    return surface


def main():
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    simple.LoadDistributedPlugin("GridFEM", remote=False, ns=globals())
    surface = simple.OpenDataFile(sys.argv[1])
    tiles = []
    for kind, label in (("Conformal", "keeps angles"), ("Isometric", "nearly keeps lengths")):
        chart = Parameterization(Input=surface, MapType=kind, ExtraCuts=int(sys.argv[2]))
        chart.UpdatePipeline()
        mesh = required(servermanager.Fetch(chart))
        flat = required(servermanager.Fetch(chart, idx=1))
        flipped = mesh.GetFieldData().GetArray("FlippedTriangles").GetRange()[1]
        print(f"{label}: area distortion {flat.GetCellData().GetArray('AreaDistortion').GetRange()}, {flipped:g} flipped")
        surface_in_space = in_space(with_squares(flat))
        for data, name in ((surface_in_space, label), (flat, "")):
            tiles.append(Tile(name, from_the_front(data), [Layer(data, "Squares", 0.0, 1.0, sequential=True)]))
    write_sheet(tiles, sys.argv[3], 2, (420, 400))


main()
