"""A scan is cleaned, and its detail enhanced, in ParaView's Python.

    PV_PLUGIN_CONFIG_FILE=build/paraview/gridfem.plugins.xml \\
        xvfb-run -a pvpython story_enhancement.py MESH DEPTH PICTURE.png

MESH is a file that ParaView reads (.ply, .vtp, ...). The story is told in
Examples/Stories/enhancement.md.
"""

import pathlib
import sys

from paraview import servermanager, simple

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))

from sheet import Layer, Tile, from_the_front, required, write_sheet

LARGE_ABSOLUTE = 3  # TransferFunction: what is across valleys and ridges stays
NOISE = 20000  # ScreeningWeight: details smaller than a 140th of the side of a square of its area
DETAIL = 4000  # the same, a 63rd


def mesh_of(proxy):
    proxy.UpdatePipeline()
    return required(servermanager.Fetch(proxy))


def bending(surface):
    """The mean curvature, in units that do not depend on the size of the mesh."""
    mesh = mesh_of(PrincipalCurvatures(Input=surface))
    return Layer(mesh, "MeanCurvature", -60 / mesh.GetLength(), 60 / mesh.GetLength())


def main():
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    simple.LoadDistributedPlugin("GridFEM", remote=False, ns=globals())
    depth = int(sys.argv[2])
    scan = simple.OpenDataFile(sys.argv[1])
    clean = SurfaceDetail(Input=scan, Depth=depth, DetailScale=0, ScreeningWeight=NOISE,
                          TransferFunction=LARGE_ABSOLUTE, SmoothingScale=0.008)
    enhanced = SurfaceDetail(Input=clean, Depth=depth, DetailScale=2, ScreeningWeight=DETAIL)
    view = from_the_front(mesh_of(scan), 1.05)
    view.direction = (0, 0, 1)  # this scan looks there
    tiles = [
        Tile("scan", view, [Layer(mesh_of(scan))]),
        Tile("cleaned", view, [Layer(mesh_of(clean))]),
        Tile("enhanced", view, [Layer(mesh_of(enhanced))]),
        Tile("scan: mean curvature", view, [bending(scan)]),
        Tile("cleaned", view, [bending(clean)]),
        Tile("enhanced", view, [bending(enhanced)]),
    ]
    write_sheet(tiles, sys.argv[3], 3, (360, 400))


main()
