"""A surface that flows to a sphere, in ParaView's Python: four of its steps as one picture.

    PV_PLUGIN_CONFIG_FILE=build/lib/paraview-5.11/plugins/gridfem.plugins.xml \\
        xvfb-run -a pvpython flow.py MESH DEPTH PICTURE.png

MESH is a file that ParaView reads (.ply, .vtp, ...).
"""

import pathlib
import sys

from paraview import servermanager, simple

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))

from sheet import Layer, Tile, View, view_of, write_sheet

SHOWN = (0, 2, 6, 30)


def shape_at(flow, step):
    flow.UpdatePipeline(float(step))
    shape = servermanager.Fetch(flow)
    if shape.GetNumberOfPoints() == 0:
        sys.exit("The filter could not do its work; the message above says why.")
    return shape


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
    view = view_of(shapes[0])
    tiles = []
    for step, shape in zip(SHOWN, shapes):
        label = f"step {step}: sphericity {sphericity.GetValue(step):.3f}"
        seen = View(shape.GetCenter(), view.direction, view.up, view.height)
        tiles.append(Tile(label, seen, [Layer(shape)]))
    write_sheet(tiles, sys.argv[3], len(tiles), (300, 300))


main()
