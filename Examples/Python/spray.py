"""Detail in one place: points near one point are selected and sharpened, and the rest is smoothed.

    PV_PLUGIN_CONFIG_FILE=build/paraview/gridfem.plugins.xml \\
        xvfb-run -a pvpython spray.py MESH DEPTH PICTURE.png

MESH is a file that ParaView reads (.ply, .vtp, ...). In ParaView's window, select with the mouse
and press Copy Active Selection in the panel of Surface Detail.
"""

import pathlib
import sys

from paraview import servermanager, simple

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))

from sheet import Layer, Tile, View, from_the_front, required, write_sheet

PLACE = (0.5, 0.835)  # across and up, as parts of what is seen from the front
RADIUS = 0.17  # of the height


def fetch(proxy):
    proxy.UpdatePipeline()
    return required(servermanager.Fetch(proxy))


def in_front(bounds):
    """A place before the mesh."""
    low_x, high_x, low_y, high_y, low_z, _ = bounds
    return [low_x + PLACE[0] * (high_x - low_x), low_y + PLACE[1] * (high_y - low_y), low_z]


def main():
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    simple.LoadDistributedPlugin("GridFEM", remote=False, ns=globals())
    depth = int(sys.argv[2])
    mesh = simple.OpenDataFile(sys.argv[1])
    shape = fetch(mesh)
    bounds = shape.GetBounds()
    height = bounds[3] - bounds[2]
    place = simple.PointSource(Center=in_front(bounds), Radius=0)
    distance = GeodesicDistance(Input=mesh, Depth=depth, Sources=place)
    near = simple.SelectionQuerySource(ElementType=0, QueryString=f"Distance < {RADIUS * height}")
    detail = SurfaceDetail(
        Input=distance, Depth=depth, ScreeningWeight=4000, Selection=near, TransitionWidth=0.03)

    whole = from_the_front(shape, 1.1)
    middle = (whole.center[0], bounds[2] + 0.77 * height, whole.center[2])
    view = View(middle, whole.direction, whole.up, 0.56 * height)

    def tile(label, array="", **properties):
        simple.SetProperties(detail, **properties)
        return Tile(label, view, [Layer(fetch(detail), array)])

    tiles = [
        Tile("input", view, [Layer(shape)]),
        tile("selected, with a transition", "Selected", DetailScale=1, OutsideScale=1),
        tile("selection sharpened", DetailScale=3, OutsideScale=1),
        tile("and the rest smoothed", DetailScale=3, OutsideScale=0),
    ]
    write_sheet(tiles, sys.argv[3], 4, (400, 400))


main()
