"""A surface that flows to a sphere, in ParaView's Python: four of its steps as one picture.

    PV_PLUGIN_CONFIG_FILE=build/paraview/gridfem.plugins.xml \\
        xvfb-run -a pvpython flow.py MESH DEPTH PICTURE.png

MESH is a file that ParaView reads (.ply, .vtp, ...).
"""

import pathlib
import sys

from paraview import servermanager, simple

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))

from sheet import Layer, Tile, View, required, write_sheet

SHOWN = (0, 2, 6, 30)


def shape_at(flow, step):
    flow.UpdatePipeline(float(step))
    return required(servermanager.Fetch(flow))


def extents(shape):
    """Along x and y, of which the picture shows the plane."""
    bounds = shape.GetBounds()
    return bounds[1] - bounds[0], bounds[3] - bounds[2]


def main():
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    simple.LoadDistributedPlugin("GridFEM", remote=False, ns=globals())
    mesh = simple.OpenDataFile(sys.argv[1])
    flow = MeanCurvatureFlow(Input=mesh, Depth=int(sys.argv[2]), Conformalized=1, TimeStep=2e-3,
                             NumberOfSteps=max(SHOWN))
    shapes = [shape_at(flow, step) for step in SHOWN]
    table = servermanager.Fetch(flow, idx=1)
    sphericity = table.GetColumnByName("Sphericity")
    error = table.GetColumnByName("QuasiConformalError")
    for step in range(table.GetNumberOfRows()):
        print(f"step {step}: sphericity {sphericity.GetValue(step):.4f}, "
              f"quasi-conformal error {error.GetValue(step):.4f}")
    height = 1.1 * max(extent for shape in shapes for extent in extents(shape))
    tiles = []
    for step, shape in zip(SHOWN, shapes):
        label = f"step {step}: sphericity {sphericity.GetValue(step):.3f}"
        seen = View(shape.GetCenter(), (0, 0, -1), (0, 1, 0), height)
        tiles.append(Tile(label, seen, [Layer(shape)]))
    write_sheet(tiles, sys.argv[3], len(tiles), (300, 300))


main()
