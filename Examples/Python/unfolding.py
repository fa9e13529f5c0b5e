"""A surface with folds that nearly touch unfolds, in ParaView's Python. The picture shows four
steps with plain functions above, and with connectivity-aware functions below.

    PV_PLUGIN_CONFIG_FILE=build/paraview/gridfem.plugins.xml \\
        xvfb-run -a pvpython unfolding.py MESH DEPTH PICTURE.png

MESH is a file that ParaView reads (.ply, .vtp, ...).
"""

import pathlib
import sys

from paraview import servermanager, simple

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))

from sheet import Layer, Tile, from_the_front, required, write_sheet

SHOWN = (0, 2, 4, 8)
NAMES = ("plain", "connectivity-aware")


def shape_at(flow, step):
    flow.UpdatePipeline(float(step))
    return required(servermanager.Fetch(flow))


def main():
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    simple.LoadDistributedPlugin("GridFEM", remote=False, ns=globals())
    mesh = simple.OpenDataFile(sys.argv[1])
    tiles = []
    for aware, name in enumerate(NAMES):
        flow = MeanCurvatureFlow(Input=mesh, Depth=int(sys.argv[2]), ConnectivityAware=aware,
                                 Conformalized=1, TimeStep=1e-3, NumberOfSteps=max(SHOWN))
        shapes = [shape_at(flow, step) for step in SHOWN]
        table = servermanager.Fetch(flow, idx=1)
        error = table.GetColumnByName("QuasiConformalError")
        for step, shape in zip(SHOWN, shapes):
            print(f"{name}, step {step}: quasi-conformal error {error.GetValue(step):.3f}")
            seen = from_the_front(shape, 1.15)
            tiles.append(Tile(f"{name}, step {step}", seen, [Layer(shape)]))
    write_sheet(tiles, sys.argv[3], len(SHOWN), (300, 300))


main()
