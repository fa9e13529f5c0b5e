"""Detail of a surface, smoothed and sharpened, everywhere, by curvature, and in one place.

    PV_PLUGIN_CONFIG_FILE=build/paraview/gridfem.plugins.xml \\
        xvfb-run -a pvpython detail.py MESH DEPTH PICTURE.png

MESH is a file that ParaView reads (.ply, .vtp, ...).
"""

import pathlib
import sys

from paraview import servermanager, simple

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))

from sheet import Layer, Tile, from_the_front, required, write_sheet

KEPT = ((1, "valleys kept"), (2, "ridges kept"), (3, "both kept"))


def shape_of(proxy):
    proxy.UpdatePipeline()
    shape = required(servermanager.Fetch(proxy))
    for name in ("NormalDisplacement", "Displacement"):
        shape.GetPointData().RemoveArray(name)
    return shape


def main():
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    simple.LoadDistributedPlugin("GridFEM", remote=False, ns=globals())
    mesh = simple.OpenDataFile(sys.argv[1])
    upper = simple.Calculator(Input=mesh, ResultArrayName="Upper")
    input_shape = shape_of(mesh)
    bounds = input_shape.GetBounds()
    middle = 0.5 * (bounds[2] + bounds[3])
    upper.Function = f"2.5*(coordsY>{middle})"
    detail = SurfaceDetail(Input=upper, Depth=int(sys.argv[2]), ScreeningWeight=2000, SmoothingScale=0.008)

    view = from_the_front(input_shape, 1.15)

    def tile(label, **properties):
        simple.SetProperties(detail, **properties)
        return Tile(label, view, [Layer(shape_of(detail))])

    smooth = tile("smoothed", DetailScale=0)
    sharp = tile("sharpened", DetailScale=2.5)
    detail.DetailScaleArray = ["POINTS", "Upper"]
    both = tile("sharp above, smooth below", DetailScale=1)
    detail.DetailScaleArray = ["POINTS", "None"]
    by_curvature = {}
    for transfer, kept in KEPT:
        detail.TransferFunction = transfer
        for word, scale in (("smoothed", 0), ("sharpened", 2.5)):
            by_curvature[word, kept] = tile(f"{word}, {kept}", DetailScale=scale)
    rows = (("smoothed", Tile("input", view, [Layer(input_shape)]), smooth),
            ("sharpened", both, sharp))
    tiles = []
    for word, first, second in rows:
        tiles += [first, second, *(by_curvature[word, kept] for _, kept in KEPT)]
    write_sheet(tiles, sys.argv[3], 5, (300, 330))


main()
