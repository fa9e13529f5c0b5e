"""The colors of five scans of a surface, stitched to one, and a picture of before and after.

    PYTHONPATH=build/lib/python3/dist-packages \\
        xvfb-run -a pvpython stitch.py MESH DEPTH PICTURE.png

MESH is a .vtp or .ply file. Its colors, or stripes where it has none, are seen by five scanners from
five sides, each with a gain and an offset of its own.
"""

import math
import sys

from gridfem.vtkGridFEMFilters import vtkStitchColors
from vtkmodules.vtkCommonCore import vtkIntArray, vtkUnsignedCharArray
from vtkmodules.vtkCommonDataModel import vtkDataObject
from vtkmodules.vtkIOPLY import vtkPLYReader
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

SCANS = 5
GAIN = (1.0, 0.92, 1.07, 0.95, 1.04)
OFFSET = (0, 35, -25, 20, -40)
TINT = (1.0, -0.4, 0.3)  # of the offset, in red, green and blue


def read(path):
    reader = vtkPLYReader() if path.endswith(".ply") else vtkXMLPolyDataReader()
    reader.SetFileName(path)
    reader.Update()
    return reader.GetOutput()


def colors_of(mesh):
    """A function that gives the three colors of a point."""
    given = mesh.GetPointData().GetArray("RGB") or mesh.GetPointData().GetArray("RGBA")
    if given:
        return lambda point: given.GetTuple(point)[:3]
    size = max(mesh.GetBounds()[2 * k + 1] - mesh.GetBounds()[2 * k] for k in range(3))

    def stripes(point):
        return [128 + 50 * math.sin(25 * x / size) for x in mesh.GetPoint(point)]

    return stripes


def add_scans(mesh):
    """Adds the colors that the scanners see, Seen, and the number of the scanner, Scan. Each
    scanner sees a sector around the longest axis. Returns the number of this axis."""
    bounds = mesh.GetBounds()
    extent = [bounds[2 * k + 1] - bounds[2 * k] for k in range(3)]
    upright = extent.index(max(extent))
    across, along = (k for k in range(3) if k != upright)
    seen, scan = vtkUnsignedCharArray(), vtkIntArray()
    seen.SetName("Seen")
    seen.SetNumberOfComponents(3)
    scan.SetName("Scan")
    colors = colors_of(mesh)
    for point in range(mesh.GetNumberOfPoints()):
        place = [x - middle for x, middle in zip(mesh.GetPoint(point), mesh.GetCenter())]
        turn = math.atan2(place[along], place[across]) / (2 * math.pi) + 0.5
        own = min(SCANS - 1, int(SCANS * turn))
        scan.InsertNextValue(own)
        seen.InsertNextTuple(
            [min(255, max(0, round(GAIN[own] * c + OFFSET[own] * tint)))
             for c, tint in zip(colors(point), TINT)])
    mesh.GetPointData().AddArray(seen)
    mesh.GetPointData().AddArray(scan)
    return upright


def stitched(mesh, depth):
    stitch = vtkStitchColors()
    stitch.SetInputData(mesh)
    points = vtkDataObject.FIELD_ASSOCIATION_POINTS
    stitch.SetInputArrayToProcess(0, 0, 0, points, "Seen")
    stitch.SetInputArrayToProcess(1, 0, 0, points, "Scan")
    stitch.SetDepth(depth)
    stitch.Update()
    return stitch.GetOutput()


def draw(mesh, upright, path):
    from sheet import Layer, Tile, View, write_sheet

    up = [float(k == upright) for k in range(3)]
    bounds = mesh.GetBounds()
    extent = [bounds[2 * k + 1] - bounds[2 * k] for k in range(3)]
    height = 1.05 * max(extent[upright], max(x for k, x in enumerate(extent) if k != upright) * 1.3)
    tiles = []
    for side, sign in (("front", 1.0), ("back", -1.0)):
        eye = [0.0 if k == upright else sign * (0.4 if k == (upright + 2) % 3 else 1.0)
               for k in range(3)]
        view = View(mesh.GetCenter(), eye, up, height)
        for name, words in (("Seen", "five scans"), ("StitchedColors", "stitched")):
            tiles.append(Tile(f"{words}, {side}", view, [Layer(mesh, name, direct=True)]))
    write_sheet(tiles, path, 4, (240, 330))


def main():
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    mesh = read(sys.argv[1])
    upright = add_scans(mesh)
    result = stitched(mesh, int(sys.argv[2]))
    if result.GetNumberOfPoints() == 0:
        sys.exit("The filter could not do its work; the message above says why.")
    draw(result, upright, sys.argv[3])


main()
