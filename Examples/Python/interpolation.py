"""Colors from twelve points, spread over a surface, and a picture of them.

    PYTHONPATH=build/lib/python3/dist-packages \\
        xvfb-run -a pvpython interpolation.py MESH DEPTH PICTURE.png

MESH is a .vtp or .ply file.
"""

import colorsys
import sys

from gridfem.vtkGridFEMFilters import vtkHarmonicInterpolation
from vtkmodules.vtkCommonCore import vtkPoints, vtkUnsignedCharArray
from vtkmodules.vtkCommonDataModel import vtkDataObject, vtkPolyData
from vtkmodules.vtkFiltersCore import vtkGlyph3D
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkIOPLY import vtkPLYReader
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

from sheet import Layer, Tile, View, required, write_sheet

COLORS = 12


def read(path):
    reader = vtkPLYReader() if path.endswith(".ply") else vtkXMLPolyDataReader()
    reader.SetFileName(path)
    reader.Update()
    return reader.GetOutput()


def far_apart(mesh, count):
    """Points of the mesh, each the farthest from the points before it."""
    points = [mesh.GetPoint(k) for k in range(mesh.GetNumberOfPoints())]
    chosen, nearest = [points[0]], [float("inf")] * len(points)
    while len(chosen) < count:
        last = chosen[-1]
        nearest = [min(d, sum((a - b) ** 2 for a, b in zip(p, last)))
                   for d, p in zip(nearest, points)]
        chosen.append(points[nearest.index(max(nearest))])
    return chosen


def colored_points(places):
    """Twelve bright colors at twelve places."""
    points, colors = vtkPoints(), vtkUnsignedCharArray()
    colors.SetName("Color")
    colors.SetNumberOfComponents(3)
    for k, place in enumerate(places):
        points.InsertNextPoint(place)
        colors.InsertNextTuple(
            [255 * c for c in colorsys.hsv_to_rgb(k * 0.61803398875 % 1.0, 0.9, 0.95)])
    data = vtkPolyData()
    data.SetPoints(points)
    data.GetPointData().AddArray(colors)
    return data


def spread(mesh, places, depth, smoothness):
    interpolation = vtkHarmonicInterpolation()
    interpolation.SetInputData(0, mesh)
    interpolation.SetInputData(2, places)
    points = vtkDataObject.FIELD_ASSOCIATION_POINTS
    interpolation.SetInputArrayToProcess(2, 2, 0, points, "Color")
    interpolation.SetSmoothness(smoothness)
    interpolation.SetDepth(depth)
    interpolation.Update()
    return interpolation.GetOutput()


def as_bytes(mesh):
    """The mesh with its interpolated colors as bytes."""
    colors = vtkUnsignedCharArray()
    colors.SetName("Color")
    colors.SetNumberOfComponents(3)
    values = mesh.GetPointData().GetArray("Interpolated")
    for point in range(values.GetNumberOfTuples()):
        colors.InsertNextTuple([min(255, max(0, c)) for c in values.GetTuple(point)])
    mesh.GetPointData().AddArray(colors)
    return mesh


def dots(places, size):
    """A small ball at every place."""
    ball = vtkSphereSource()
    ball.SetRadius(0.02 * size)
    places.GetPointData().SetActiveScalars("Color")
    glyphs = vtkGlyph3D()
    glyphs.SetInputData(places)
    glyphs.SetSourceConnection(ball.GetOutputPort())
    glyphs.SetScaleModeToDataScalingOff()
    glyphs.SetColorModeToColorByScalar()
    glyphs.Update()
    return glyphs.GetOutput()


def upright(mesh, size):
    """With y upward, as scans often stand, a little from above."""
    return View(mesh.GetCenter(), (0.0, 0.3, 0.95), (0.0, 1.0, 0.0), 1.1 * size)


def main():
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    mesh, depth = read(sys.argv[1]), int(sys.argv[2])
    places = colored_points(far_apart(mesh, COLORS))
    bounds = mesh.GetBounds()
    size = max(bounds[2 * k + 1] - bounds[2 * k] for k in range(3))
    balls = Layer(dots(places, size), "Color", direct=True)
    view = upright(mesh, size)
    tiles = [Tile("given at twelve points", view, [Layer(mesh), balls])]
    for smoothness, name in ((vtkHarmonicInterpolation.Harmonic, "harmonic"),
                             (vtkHarmonicInterpolation.Biharmonic, "biharmonic")):
        result = required(spread(mesh, places, depth, smoothness))
        tiles.append(Tile(name, view, [Layer(as_bytes(result), "Color", direct=True), balls]))
    write_sheet(tiles, sys.argv[3], 3, (320, 290))


main()
