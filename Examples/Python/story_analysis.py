"""Finds the limbs of a scan in ParaView's Python: the tips by eigenfunctions, and the regions
around them by distances along the surface.

    PV_PLUGIN_CONFIG_FILE=build/paraview/gridfem.plugins.xml \\
        xvfb-run -a pvpython story_analysis.py MESH DEPTH TIPS PICTURE.png

MESH is a file that ParaView reads (.ply, .vtp, ...), TIPS how many tips to look for at most. The story is told
in Examples/Stories/analysis.md.
"""

import pathlib
import sys

from paraview import servermanager, simple
from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkIntArray
from vtkmodules.vtkFiltersCore import vtkAppendPolyData
from vtkmodules.vtkFiltersSources import vtkSphereSource

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))

from sheet import Layer, Tile, from_the_front, required, write_sheet

MODES = 60
SCALE = 5  # of 16: times after which heat has left a finger, but not a hand
APART = 0.2  # of the longest distance on the surface: two tips are farther from each other


def mesh_of(proxy):
    proxy.UpdatePipeline()
    return required(servermanager.Fetch(proxy))


def add_heat(mesh):
    """The point array Heat: the heat kernel signature at one of its times."""
    signature = mesh.GetPointData().GetArray("HeatKernelSignature")
    heat = vtkDoubleArray()
    heat.SetName("Heat")
    heat.SetNumberOfTuples(mesh.GetNumberOfPoints())
    heat.CopyComponent(0, signature, SCALE)
    mesh.GetPointData().AddArray(heat)


def summits(mesh):
    """The points that keep more heat than their neighbors, the hottest first."""
    heat = mesh.GetPointData().GetArray("Heat").GetValue
    is_summit = [True] * mesh.GetNumberOfPoints()
    for k in range(mesh.GetNumberOfCells()):
        cell = mesh.GetCell(k)
        corners = [cell.GetPointId(c) for c in range(cell.GetNumberOfPoints())]
        hottest = max(corners, key=heat)
        for corner in corners:
            is_summit[corner] &= corner == hottest
    return sorted((p for p, found in enumerate(is_summit) if found), key=heat, reverse=True)


def find_tips(signatures, mesh, depth, count):
    """Returns the hottest summits, each far from the summits before it, and the filter with the
    distances from them."""
    candidates = summits(mesh)
    tips = [candidates[0]]
    distance = GeodesicDistance(Input=signatures, Depth=depth, SourcePointIds=tips, NearestSource=1)
    longest = mesh_of(distance).GetPointData().GetArray("Distance").GetRange()[1]
    while len(tips) < count:
        reached = mesh_of(distance).GetPointData().GetArray("Distance")
        tip = next((p for p in candidates if reached.GetValue(p) > APART * longest), None)
        if tip is None:
            break
        tips.append(tip)
        distance.SourcePointIds = tips
    return tips, distance


def add_regions(mesh, tips):
    """The point array Region: the number of the nearest tip, -1 where none is reached."""
    nearest = mesh.GetPointData().GetArray("NearestSource")
    number = {tip: k for k, tip in enumerate(tips)}
    regions = vtkIntArray()
    regions.SetName("Region")
    for p in range(mesh.GetNumberOfPoints()):
        regions.InsertNextValue(number.get(nearest.GetValue(p), -1))
    mesh.GetPointData().AddArray(regions)


def balls(mesh, points):
    append = vtkAppendPolyData()
    for point in points:
        ball = vtkSphereSource()
        ball.SetCenter(mesh.GetPoint(point))
        ball.SetRadius(0.015 * mesh.GetLength())
        append.AddInputConnection(ball.GetOutputPort())
    append.Update()
    return append.GetOutput()


def main():
    if len(sys.argv) != 5:
        sys.exit(__doc__)
    simple.LoadDistributedPlugin("GridFEM", remote=False, ns=globals())
    depth, count = int(sys.argv[2]), int(sys.argv[3])
    scan = simple.OpenDataFile(sys.argv[1])
    signatures = SpectralSignatures(Input=scan, Depth=depth, NumberOfModes=MODES)
    mesh = mesh_of(signatures)
    add_heat(mesh)
    low, high = mesh.GetPointData().GetArray("Heat").GetRange()
    view = from_the_front(mesh, 1.05)
    tips, distance = find_tips(signatures, mesh, depth, count)
    print("tips:", *tips)
    split = mesh_of(distance)
    add_regions(split, tips)
    smooth = SpectralSignatures(Input=scan, Depth=depth, NumberOfModes=MODES, FilterType=1, LastMode=30)
    tiles = [
        Tile("heat that stays", view, [Layer(mesh, "Heat", low, 0.5 * (low + high))]),
        Tile(f"{len(tips)} tips", view, [Layer(mesh), Layer(balls(mesh, tips), color=(0.76, 0.16, 0.15))]),
        Tile("regions of the tips", view, [Layer(split, "Region", shuffled=True)]),
        Tile("the shape of 31 modes", view, [Layer(mesh_of(smooth))]),
    ]
    write_sheet(tiles, sys.argv[4], len(tiles), (330, 360))


main()
