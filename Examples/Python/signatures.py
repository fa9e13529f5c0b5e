"""Signatures, distances and a smoothed shape of a surface, from its eigenfunctions.

    PYTHONPATH=build/lib/python3/dist-packages \\
        pvpython signatures.py MESH DEPTH OUTPUT.vtp [PICTURE.png]

MESH is a .vtp or .ply file. OUTPUT.vtp is the mesh with the heat and wave kernel signatures,
the distances from its first point, and Filtered, the shape of its first 40 modes. PICTURE.png needs a
display (xvfb-run -a in front).
"""

import math
import sys

from gridfem.vtkGridFEMFilters import vtkSpectralSignatures
from vtkmodules.vtkIOPLY import vtkPLYReader
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLPolyDataWriter


def read(path):
    reader = vtkPLYReader() if path.endswith(".ply") else vtkXMLPolyDataReader()
    reader.SetFileName(path)
    reader.Update()
    return reader.GetOutput()


def signatures_of(mesh, depth):
    signatures = vtkSpectralSignatures()
    signatures.SetInputData(mesh)
    signatures.SetDepth(depth)
    signatures.SetNumberOfScales(16)
    signatures.AddSourcePointId(0)
    signatures.SetFilterType(vtkSpectralSignatures.LowPass)
    signatures.SetLastMode(40)
    signatures.Update()
    return signatures.GetOutput()


def moved(mesh):
    """The mesh at its filtered places."""
    shape = mesh.NewInstance()
    shape.ShallowCopy(mesh)
    points = mesh.GetPoints().NewInstance()
    points.SetData(mesh.GetPointData().GetArray("Filtered"))
    shape.SetPoints(points)
    return shape


def logarithm(mesh, name, component):
    """Adds the logarithm of one component, which shows a signature best. Returns its name and
    range."""
    source = mesh.GetPointData().GetArray(name)
    values = source.NewInstance()
    values.SetName(f"log {name} {component}")
    for point in range(source.GetNumberOfTuples()):
        values.InsertNextValue(math.log(source.GetComponent(point, component)))
    mesh.GetPointData().AddArray(values)
    return values.GetName(), *values.GetRange()


def draw(mesh, path):
    from sheet import Layer, Tile, view_of, write_sheet

    view = view_of(mesh)
    tiles = []
    for component, word in ((2, "small"), (8, "middle")):
        layer = Layer(mesh, *logarithm(mesh, "HeatKernelSignature", component))
        tiles.append(Tile(f"heat kernel, {word} time", view, [layer]))
    farthest = mesh.GetPointData().GetArray("BiharmonicDistance").GetRange()[1]
    layer = Layer(mesh, "BiharmonicDistance", 0, farthest)
    tiles.append(Tile("biharmonic distance", view, [layer]))
    tiles.append(Tile("the shape of 41 modes", view, [Layer(moved(mesh))]))
    write_sheet(tiles, path, 4, (340, 300), "")


def main():
    if len(sys.argv) not in (4, 5):
        sys.exit(__doc__)
    result = signatures_of(read(sys.argv[1]), int(sys.argv[2]))
    if result.GetNumberOfPoints() == 0:
        sys.exit("The filter could not do its work; the message above says why.")
    writer = vtkXMLPolyDataWriter()
    writer.SetInputData(result)
    writer.SetFileName(sys.argv[3])
    writer.Write()
    if len(sys.argv) == 5:
        draw(result, sys.argv[4])


main()
