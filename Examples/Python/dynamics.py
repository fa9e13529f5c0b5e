"""Patterns that grow and waves that run on a surface, in ParaView's Python: four models as one picture.

    PV_PLUGIN_CONFIG_FILE=build/lib/paraview-5.11/plugins/gridfem.plugins.xml \\
        xvfb-run -a pvpython dynamics.py MESH DEPTH PICTURE.png

MESH is a file that ParaView reads (.ply, .vtp, ...).
"""

import pathlib
import sys

from paraview import servermanager, simple

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))

from sheet import Layer, Tile, from_the_front, required, write_sheet

# The model, its pattern length, and the step that is shown.
SHOWN = (("Turing Spots", 0.07, 30), ("Gray-Scott", 0.1, 40), ("FitzHugh-Nagumo", 0.13, 30), ("Wave", 0.1, 5))


def main():
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    simple.LoadDistributedPlugin("GridFEM", remote=False, ns=globals())
    surface = simple.OpenDataFile(sys.argv[1])
    tiles = []
    for model, length, step in SHOWN:
        dynamics = SurfaceDynamics(
            Input=surface, Depth=int(sys.argv[2]), Model=model, PatternLength=length, NumberOfSteps=step)
        mesh = required(servermanager.Fetch(dynamics))
        low, high = mesh.GetPointData().GetArray("U").GetRange()
        print(f"{model}: U from {low:.3f} to {high:.3f}")
        if low < 0.0:
            low, high = -max(-low, high), max(-low, high)
        layer = Layer(mesh, "U", low, high, sequential=low >= 0.0)
        tiles.append(Tile(model, from_the_front(mesh), [layer]))
    write_sheet(tiles, sys.argv[3], 2, (420, 400))


main()
