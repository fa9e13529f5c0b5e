"""A folded surface unfolds, and measurements on it come along, in ParaView's Python.

    PV_PLUGIN_CONFIG_FILE=build/paraview/gridfem.plugins.xml \\
        xvfb-run -a pvpython story_unfolding.py MESH DEPTH PICTURE.png

MESH is a file that ParaView reads (.ply, .vtp, ...). The story is told in Examples/Stories/unfolding.md.
"""

import pathlib
import sys

from paraview import servermanager, simple

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))

from sheet import Layer, Tile, from_the_front, required, write_sheet

SHOWN = (0, 1, 3, 8)


def main():
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    simple.LoadDistributedPlugin("GridFEM", remote=False, ns=globals())
    depth = int(sys.argv[2])
    folded = simple.OpenDataFile(sys.argv[1])
    curved = PrincipalCurvatures(Input=folded, Depth=depth, SmoothingScale=0.005)
    flow = MeanCurvatureFlow(Input=curved, Depth=depth, Conformalized=1, TimeStep=1e-3,
                             NumberOfSteps=max(SHOWN))
    tiles = []
    for step in SHOWN:
        flow.UpdatePipeline(float(step))
        mesh = required(servermanager.Fetch(flow))
        area = servermanager.Fetch(flow, idx=1).GetColumnByName("Area").GetValue(0)
        bent = 60 / area**0.5
        seen = from_the_front(mesh, 1.1)
        tiles.append(Tile(f"step {step}", seen, [Layer(mesh, "MeanCurvature", -bent, bent)]))
    write_sheet(tiles, sys.argv[3], len(tiles), (320, 360))


main()
