"""Blocks as one surface, in ParaView's Python: distances on a mesh that is cut into three blocks, each
by itself and all as one.

    PV_PLUGIN_CONFIG_FILE=build/paraview/gridfem.plugins.xml \\
        xvfb-run -a pvpython blocks.py MESH DEPTH PICTURE.png

MESH is a file that ParaView reads (.ply, .vtp, ...).
"""

import pathlib
import sys

from paraview import servermanager, simple
from vtkmodules.vtkCommonTransforms import vtkTransform
from vtkmodules.vtkFiltersCore import vtkAppendPolyData, vtkContourFilter, vtkTubeFilter
from vtkmodules.vtkFiltersGeneral import vtkTransformFilter

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))

from sheet import Layer, Tile, from_the_front, write_sheet

BLOCKS = 3
INTERVALS = 24
APART = 0.06  # of the height, in the picture


def cut(surface):
    """The mesh in blocks, from the lowest to the highest; no cell is cut."""
    low, high = surface.GetDataInformation().GetBounds()[2:4]
    heights = simple.PointDatatoCellData(
        Input=simple.Calculator(Input=surface, ResultArrayName="height", Function="coordsY"))
    steps = [low + (high - low) * k / BLOCKS for k in range(BLOCKS + 1)]
    return simple.GroupDatasets(Input=[
        simple.Threshold(Input=heights, Scalars=["CELLS", "height"], LowerThreshold=lower,
                         UpperThreshold=upper)
        for lower, upper in zip(steps, steps[1:])])


def farthest(blocks):
    return max(block.GetPointData().GetArray("Distance").GetRange()[1] for block in blocks)


def drawn_apart(blocks):
    """The blocks as one data set for the picture, with room between them."""
    append = vtkAppendPolyData()
    bounds = [block.GetBounds() for block in blocks]
    height = bounds[-1][3] - bounds[0][2]
    for k, block in enumerate(blocks):
        shift = vtkTransform()
        shift.Translate(0, APART * height * k, 0)
        moved = vtkTransformFilter()
        moved.SetInputData(block)
        moved.SetTransform(shift)
        moved.Update()
        append.AddInputData(moved.GetOutput())
    append.Update()
    return append.GetOutput()


def isolines(mesh, largest):
    """The lines of equal distance, as thin tubes."""
    lines = vtkContourFilter()
    lines.SetInputData(mesh)
    lines.SetInputArrayToProcess(0, 0, 0, 0, "Distance")
    for k in range(1, INTERVALS):
        lines.SetValue(k - 1, k * largest / INTERVALS)
    tubes = vtkTubeFilter()
    tubes.SetInputConnection(lines.GetOutputPort())
    tubes.SetRadius(0.0015 * mesh.GetLength())
    tubes.Update()
    return tubes.GetOutput()


def main():
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    simple.LoadDistributedPlugin("GridFEM", remote=False, ns=globals())
    surface = simple.OpenDataFile(sys.argv[1])
    surface.UpdatePipeline()
    distance = GeodesicDistance(Input=cut(surface), Depth=int(sys.argv[2]))
    tiles = []
    for as_one, label in ((False, "every block by itself"), (True, "blocks as one surface")):
        distance.BlocksAsOne = as_one
        distance.UpdatePipeline()
        data = servermanager.Fetch(distance)
        blocks = [data.GetBlock(k) for k in range(data.GetNumberOfBlocks())]
        if not all(block.GetPointData().HasArray("Distance") for block in blocks):
            sys.exit("The filter could not do its work; the message above says why.")
        largest = farthest(blocks)
        print(f"{label}: at most {largest:.4g}")
        mesh = drawn_apart(blocks)
        tiles.append(Tile(label, from_the_front(mesh), [
            Layer(mesh, "Distance", 0.0, largest),
            Layer(isolines(mesh, largest), color=(0.1, 0.1, 0.1))]))
    write_sheet(tiles, sys.argv[3], len(tiles), (420, 440))


main()
