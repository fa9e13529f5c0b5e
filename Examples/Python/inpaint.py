"""A field with holes, filled in, and a picture of it.

    PYTHONPATH=build/lib/python3/dist-packages \\
        xvfb-run -a pvpython inpaint.py MESH DEPTH PICTURE.png

MESH is a .vtp or .ply file. The script deletes a fifth of the values of a smooth field, near some
points.
"""

import math
import sys

from gridfem.vtkGridFEMFilters import vtkScreenedPoisson
from vtkmodules.vtkCommonCore import vtkDoubleArray
from vtkmodules.vtkCommonDataModel import vtkDataObject
from vtkmodules.vtkIOPLY import vtkPLYReader
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

from sheet import Layer, Tile, from_the_front, required, write_sheet

HOLES = 40
LOST = 0.2  # part of the points


def read(path):
    reader = vtkPLYReader() if path.endswith(".ply") else vtkXMLPolyDataReader()
    reader.SetFileName(path)
    reader.Update()
    return reader.GetOutput()


def add_array(mesh, name, values):
    array = vtkDoubleArray()
    array.SetName(name)
    for value in values:
        array.InsertNextValue(value)
    mesh.GetPointData().AddArray(array)


def field_of(mesh):
    """A wave or so along each axis, from -1 to 1."""
    bounds = mesh.GetBounds()
    size = max(bounds[2 * k + 1] - bounds[2 * k] for k in range(3))
    field = []
    for point in range(mesh.GetNumberOfPoints()):
        x, y, z = ((c - m) / size for c, m in zip(mesh.GetPoint(point), mesh.GetCenter()))
        field.append(math.sin(7 * y + 3 * z) * math.cos(5 * x))
    return field


def is_lost(mesh):
    """Whether a point is one of the nearest to the centers of the holes."""
    points = [mesh.GetPoint(point) for point in range(mesh.GetNumberOfPoints())]
    centers = points[::max(1, len(points) // HOLES)]
    nearest = [min(math.dist(point, center) for center in centers) for point in points]
    radius = sorted(nearest)[int(LOST * len(points))]
    return [distance < radius for distance in nearest]


def filled(mesh, depth):
    poisson = vtkScreenedPoisson()
    poisson.SetInputData(mesh)
    poisson.SetInputArrayToProcess(0, 0, 0, vtkDataObject.FIELD_ASSOCIATION_POINTS, "Known")
    poisson.FillUnknownOn()
    poisson.SetParameterUnits(vtkScreenedPoisson.UnitArea)
    poisson.SetScreeningWeight(1e5)  # what is known stays
    poisson.SetDepth(depth)
    poisson.Update()
    return poisson.GetOutput()


def main():
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    mesh = read(sys.argv[1])
    field, lost = field_of(mesh), is_lost(mesh)
    add_array(mesh, "Field", field)
    add_array(mesh, "Known", [math.nan if hole else value for value, hole in zip(field, lost)])
    result = required(filled(mesh, int(sys.argv[2])))
    solution = result.GetPointData().GetArray("Solution")
    squares = [(solution.GetValue(point) - field[point]) ** 2 for point, hole in enumerate(lost) if hole]
    error = math.sqrt(sum(squares) / len(squares))
    print(f"{len(squares)} of {len(field)} values filled in, root mean square error {error:.4f}")
    view = from_the_front(mesh)
    write_sheet([Tile("a fifth is lost", view, [Layer(mesh, "Known")]),
                 Tile("filled in", view, [Layer(result, "Solution")]),
                 Tile("as it was", view, [Layer(mesh, "Field")])], sys.argv[3], 3, (320, 330))


main()
