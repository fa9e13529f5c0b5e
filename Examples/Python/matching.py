"""Corresponding places of two poses of a surface, in ParaView's Python. The second pose is bent and has fewer
triangles. Corresponding places have the same color, and distances measured on the first pose arrive on the
second.

    PV_PLUGIN_CONFIG_FILE=build/lib/paraview-5.11/plugins/gridfem.plugins.xml \\
        xvfb-run -a pvpython matching.py MESH DEPTH PICTURE.png

MESH is a file that ParaView reads (.ply, .vtp, ...).
"""

import dataclasses
import math
import pathlib
import sys

from paraview import servermanager, simple
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkFiltersCore import vtkQuadricDecimation, vtkTriangleFilter

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))

from sheet import Layer, Tile, required, view_of, write_sheet

ANGLE = 1.2  # between both ends


def bent(mesh):
    """Returns the mesh with fewer triangles, and bent."""
    triangles = vtkTriangleFilter()
    triangles.SetInputData(mesh)
    coarser = vtkQuadricDecimation()
    coarser.SetInputConnection(triangles.GetOutputPort())
    coarser.SetTargetReduction(0.6)
    coarser.Update()
    data = coarser.GetOutput()
    bounds = data.GetBounds()
    (length, along), (_, across), _ = sorted(((bounds[2 * k + 1] - bounds[2 * k], k) for k in range(3)), reverse=True)
    center, radius = data.GetCenter(), length / ANGLE
    points = vtkPoints()
    for k in range(data.GetNumberOfPoints()):
        point = list(data.GetPoint(k))
        angle = (point[along] - center[along]) / radius
        from_axis = radius - (point[across] - center[across])
        point[along] = from_axis * math.sin(angle)
        point[across] = radius - from_axis * math.cos(angle)
        points.InsertNextPoint(point)
    data.SetPoints(points)
    data.GetPointData().Initialize()
    return data


def source(data):
    """Makes a source of the pipeline that has the data."""
    producer = simple.TrivialProducer()
    producer.GetClientSideObject().SetOutput(data)
    return producer


def upright(view):
    """Turns a view so that y points up."""
    return view if view.up[1] > 0 else dataclasses.replace(view, up=[-x for x in view.up])


def main():
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    simple.LoadDistributedPlugin("GridFEM", remote=False, ns=globals())
    depth = int(sys.argv[2])
    mesh = simple.ExtractSurface(Input=simple.OpenDataFile(sys.argv[1]))
    pose = source(bent(servermanager.Fetch(mesh)))
    distance = GeodesicDistance(Input=mesh, Depth=depth)
    matched = FunctionalMap(Input=pose, Reference=distance, Depth=depth)
    matched.UpdatePipeline()
    found = required(servermanager.Fetch(matched))
    reference = servermanager.Fetch(matched, idx=1)
    print(f"mismatch {found.GetFieldData().GetArray('MeanMismatch').GetValue(0):.3f}")
    farthest = reference.GetPointData().GetArray("Distance").GetRange()[1]
    tiles = []
    for data, label in ((reference, "a surface"), (found, "another pose and mesh")):
        view = upright(view_of(data, 1.3))
        tiles.append(Tile(label, view, [Layer(data, "MatchingColors", direct=True)]))
        tiles.append(Tile("", view, [Layer(data, "Distance", 0.0, farthest, sequential=True)]))
    write_sheet(tiles, sys.argv[3], 2, (420, 320))


main()
