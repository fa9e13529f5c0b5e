"""A field of vectors on a torus taken apart, and a picture of its parts.

    PYTHONPATH=build/lib/python3/dist-packages \\
        xvfb-run -a pvpython hodge.py DEPTH PICTURE.png
"""

import math
import sys

from gridfem.vtkGridFEMFilters import vtkSurfaceGradient
from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkDataObject, vtkPolyData
from vtkmodules.vtkFiltersCore import vtkGlyph3D, vtkMaskPoints
from vtkmodules.vtkFiltersSources import vtkArrowSource

from sheet import Layer, Tile, View, required, write_sheet

RING, TUBE = 1.0, 0.45


def torus(around=160, across=80):
    points, triangles = vtkPoints(), vtkCellArray()
    for i in range(around):
        for j in range(across):
            u, v = 2 * math.pi * i / around, 2 * math.pi * j / across
            radius = RING + TUBE * math.cos(v)
            points.InsertNextPoint(
                radius * math.cos(u), radius * math.sin(u), TUBE * math.sin(v))
            a, b, c, d = (k % around * across + m % across
                          for k, m in ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)))
            for corners in ((a, b, c), (a, c, d)):
                triangles.InsertNextCell(3, corners)
    mesh = vtkPolyData()
    mesh.SetPoints(points)
    mesh.SetPolys(triangles)
    return mesh


def add_field(mesh):
    """Away from one side, in eddies, and around the hole."""
    vectors = vtkDoubleArray()
    vectors.SetName("Field")
    vectors.SetNumberOfComponents(3)
    for k in range(mesh.GetNumberOfPoints()):
        x, y, z = mesh.GetPoint(k)
        to_axis = x * x + y * y
        middle = [x - RING * x / to_axis ** 0.5, y - RING * y / to_axis ** 0.5, z]
        normal = [c / TUBE for c in middle]
        pull = [0.8, 0.0, 0.0]
        slope = [2.0 * z * y, 2.0 * z * x, 2.0 * x * y]  # of 2 x y z: four eddies on each side
        eddies = [normal[k - 2] * slope[k - 1] - normal[k - 1] * slope[k - 2] for k in range(3)]
        around = [-0.8 * y / to_axis, 0.8 * x / to_axis, 0.0]
        vectors.InsertNextTuple([sum(c) for c in zip(pull, eddies, around)])
    mesh.GetPointData().AddArray(vectors)


def arrows(mesh, array):
    """Arrows at some of the points, as long as the vectors there."""
    few = vtkMaskPoints()
    few.SetInputData(mesh)
    few.RandomModeOn()
    few.SetRandomModeType(3)  # evenly over the surface
    few.SetMaximumNumberOfPoints(650)
    arrow = vtkArrowSource()
    arrow.SetTipRadius(0.22)
    arrow.SetTipLength(0.45)
    arrow.SetShaftRadius(0.07)
    glyphs = vtkGlyph3D()
    glyphs.SetInputConnection(few.GetOutputPort())
    glyphs.SetSourceConnection(arrow.GetOutputPort())
    glyphs.SetInputArrayToProcess(1, 0, 0, vtkDataObject.FIELD_ASSOCIATION_POINTS, array)
    glyphs.SetVectorModeToUseVector()
    glyphs.SetScaleModeToScaleByVector()
    glyphs.SetScaleFactor(0.16)
    glyphs.Update()
    return glyphs.GetOutput()


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    mesh = torus()
    add_field(mesh)
    gradient = vtkSurfaceGradient()
    gradient.SetInputData(mesh)
    gradient.SetInputArrayToProcess(0, 0, 0, vtkDataObject.FIELD_ASSOCIATION_POINTS, "Field")
    gradient.SetHodgeDecomposition(True)
    gradient.SetDepth(int(sys.argv[1]))
    gradient.Update()
    parts = required(gradient.GetOutput())
    view = View((0.0, 0.0, 0.0), (0.0, -0.5, 1.0), (0.0, 1.0, 0.0), 2.9)
    tiles = []
    for array, label, color, background in (
            ("Field", "a field", (0.15, 0.15, 0.15), ""),
            ("GradientPart", "flows out of sources", (0.1, 0.1, 0.1), "Potential"),
            ("RotationPart", "turns in eddies", (0.1, 0.1, 0.1), "StreamFunction"),
            ("HarmonicPart", "goes around", (0.15, 0.15, 0.15), "")):
        low, high = parts.GetPointData().GetArray(background).GetRange() if background else (0, 1)
        tiles.append(Tile(label, view, [Layer(parts, background, low, high),
                                        Layer(arrows(parts, array), color=color)]))
    write_sheet(tiles, sys.argv[2], 4, (330, 300))


main()
