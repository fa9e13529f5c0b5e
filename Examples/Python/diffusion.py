"""Stripes that spread along a surface, in ParaView's Python: four time steps as one picture.

    PV_PLUGIN_CONFIG_FILE=build/paraview/gridfem.plugins.xml \\
        xvfb-run -a pvpython diffusion.py MESH DEPTH PICTURE.png

MESH is a file that ParaView reads (.ply, .vtp, ...).
"""

import pathlib
import sys

from paraview import servermanager, simple

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))

from sheet import Layer, Tile, from_the_front, required, write_sheet

STRIPES = 8
SHOWN = (1, 3, 8, 20)


def main():
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    simple.LoadDistributedPlugin("GridFEM", remote=False, ns=globals())
    surface = simple.OpenDataFile(sys.argv[1])
    surface.UpdatePipeline()
    low, high = surface.GetDataInformation().GetBounds()[2:4]
    stripes = simple.Calculator(
        Input=surface, ResultArrayName="stripes",
        Function=f"sin({6.2832 * STRIPES / (high - low)}*(coordsY-({low}))) > 0 ? 1 : -1")
    diffusion = HeatDiffusion(
        Input=stripes, Depth=int(sys.argv[2]), Array=["POINTS", "stripes"], DiffusionTime=4e-3,
        NumberOfSteps=max(SHOWN))
    tiles = []
    for step in SHOWN:
        diffusion.UpdatePipeline(float(step))
        mesh = required(servermanager.Fetch(diffusion))
        values = mesh.GetPointData().GetArray("Diffused").GetRange()
        print(f"step {step}: values from {values[0]:.4f} to {values[1]:.4f}")
        layer = Layer(mesh, "Diffused", -1.0, 1.0)
        tiles.append(Tile(f"step {step} of {max(SHOWN)}", from_the_front(mesh), [layer]))
    write_sheet(tiles, sys.argv[3], len(tiles), (300, 300))


main()
