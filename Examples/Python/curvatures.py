"""Principal curvatures of a surface, raw and smoothed.

    PYTHONPATH=build/lib/python3/dist-packages \\
        pvpython curvatures.py MESH OUTPUT.vtp [PICTURE.png]

MESH is a .vtp or .ply file. OUTPUT.vtp is the mesh with the smoothed curvatures and their directions.
PICTURE.png needs a display (xvfb-run -a in front).
"""

import sys

from gridfem.vtkGridFEMFilters import vtkPrincipalCurvatures
from vtkmodules.vtkIOPLY import vtkPLYReader
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLPolyDataWriter

SCALE = 0.004  # of the root of the area


def read(path):
    reader = vtkPLYReader() if path.endswith(".ply") else vtkXMLPolyDataReader()
    reader.SetFileName(path)
    reader.Update()
    return reader.GetOutput()


def curvatures_of(mesh, scale):
    curvatures = vtkPrincipalCurvatures()
    curvatures.SetInputData(mesh)
    curvatures.SetSmoothingScale(scale)
    curvatures.Update()
    return curvatures.GetOutput()


def usual_size(mesh, name):
    """The value that nine tenths of the points do not exceed, because a few extremes would hide the
    rest."""
    array = mesh.GetPointData().GetArray(name)
    values = sorted(abs(array.GetValue(point)) for point in range(array.GetNumberOfTuples()))
    return values[9 * len(values) // 10]


def draw(raw, smooth, path):
    from sheet import Layer, Tile, View, write_sheet

    low_x, high_x, low_y, high_y, _, _ = smooth.GetBounds()
    view = View(smooth.GetCenter(), (0, 0, -1), (0, 1, 0), 1.05 * max(high_x - low_x, high_y - low_y))
    size = usual_size(smooth, "MeanCurvature")
    tiles = [
        Tile("mean curvature", view, [Layer(raw, "MeanCurvature", -size, size)]),
        Tile("smoothed", view, [Layer(smooth, "MeanCurvature", -size, size)]),
        Tile("shape index", view, [Layer(smooth, "ShapeIndex", -1, 1)]),
    ]
    write_sheet(tiles, path, 3, (360, 400), "")


def main():
    if len(sys.argv) not in (3, 4):
        sys.exit(__doc__)
    mesh = read(sys.argv[1])
    smooth = curvatures_of(mesh, SCALE)
    if smooth.GetNumberOfPoints() == 0:
        sys.exit("The filter could not do its work; the message above says why.")
    writer = vtkXMLPolyDataWriter()
    writer.SetInputData(smooth)
    writer.SetFileName(sys.argv[2])
    writer.Write()
    if len(sys.argv) == 4:
        draw(curvatures_of(mesh, 0.0), smooth, sys.argv[3])


main()
