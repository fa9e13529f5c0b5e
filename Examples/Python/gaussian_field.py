"""Random fields on a surface, rough and smooth, with short and long range.

    PV_PLUGIN_CONFIG_FILE=build/lib/paraview-5.11/plugins/gridfem.plugins.xml \\
        xvfb-run -a pvpython gaussian_field.py MESH DEPTH PICTURE.png

MESH is a file that ParaView reads (.ply, .vtp, ...). The picture has a row for each smoothness and a
column for each range. All samples have one seed.
"""

import pathlib
import sys

from paraview import servermanager, simple

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))

from sheet import Layer, Tile, from_the_front, required, write_sheet

RANGES = (0.05, 0.15, 0.5)  # of the side of a square with the area of the surface


def fetch(proxy):
    proxy.UpdatePipeline()
    return required(servermanager.Fetch(proxy))


def main():
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    simple.LoadDistributedPlugin("GridFEM", remote=False, ns=globals())
    mesh = simple.OpenDataFile(sys.argv[1])
    view = from_the_front(fetch(mesh))
    tiles = []
    for smoothness in (1, 3):
        for distance in RANGES:
            field = GaussianField(
                Input=mesh, Depth=int(sys.argv[2]), Smoothness=smoothness, Range=distance)
            tiles.append(Tile(f"smoothness {smoothness}, range {distance}", view,
                              [Layer(fetch(field), "Sample000", -2.5, 2.5)]))
            simple.Delete(field)
    write_sheet(tiles, sys.argv[3], len(RANGES), (330, 400), "Samples of random fields")


main()
