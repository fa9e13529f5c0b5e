"""Renders the pictures of the README from the main job's output for the trefoil knot.

    PYTHONPATH=build/lib/python3/dist-packages xvfb-run -a \\
        pvpython Examples/Python/readme_pictures.py output Examples/Pictures
"""

import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))

from contact_sheet import TITLE, read, tiles_of
from gridfem.vtkGridFEMFilters import (
    vtkClipToOctree,
    vtkConnectivityAwareBasis,
    vtkScreenedPoisson,
)
from sheet import Layer, Tile, View, view_of, write_sheet
from vtkmodules.vtkCommonDataModel import vtkDataObject, vtkSphere
from vtkmodules.vtkFiltersCore import vtkClipPolyData, vtkPolyDataConnectivityFilter

# One of the three places where strands of the knot cross, one above the other, and a bend.
CROSSING = (-2.0, 0.0, 0.0)
BEND = View((2.4, 0.0, 0.0), (0.6, -0.1, 0.79), (-0.79, 0.0, 0.6), 3.0)


BASIS_TITLE = "One basis function where two strands nearly touch, seen from between them"
CONNECTIVITY_TITLE = "Stripes fitted on a coarse grid (depth 4), where two strands nearly touch"
LOWER, UPPER = -1.0, 1.0


def strand(mesh, side):
    """One of the two strands at the crossing, alone."""
    ball = vtkSphere()
    ball.SetCenter(CROSSING)
    ball.SetRadius(1.5)
    clip = vtkClipPolyData()
    clip.SetInputData(mesh)
    clip.SetClipFunction(ball)
    clip.InsideOutOn()
    pieces = vtkPolyDataConnectivityFilter()
    pieces.SetInputConnection(clip.GetOutputPort())
    pieces.SetExtractionModeToClosestPointRegion()
    pieces.SetClosestPoint(CROSSING[0], CROSSING[1], 1.4 * side)
    pieces.Update()
    return pieces.GetOutput()


def seen_from_other(side):
    """The face of a strand that the other strand touches."""
    return View(CROSSING, (0.0, 0.0, -side), (0.0, 1.0, 0.0), 3.1)


def basis_filter(knot, depth, aware):
    basis = vtkConnectivityAwareBasis()
    basis.SetInputData(knot)
    basis.SetDepth(depth)
    basis.SetConnectivityAware(aware)
    return basis


def projected(knot, aware):
    """The stripes as a coarse function space shows them."""
    poisson = vtkScreenedPoisson()
    poisson.SetInputData(0, knot)
    poisson.SetDepth(4)
    poisson.SetConnectivityAware(aware)
    points = vtkDataObject.FIELD_ASSOCIATION_POINTS
    poisson.SetInputArrayToProcess(0, 0, 0, points, "Stripes")
    poisson.SetScreeningWeight(1e5)
    poisson.Update()
    return poisson.GetOutput()


def function_at_crossing(knot, aware):
    """A basis function of the grid corner between the strands."""
    basis = basis_filter(knot, 4, aware)
    basis.Update()
    basis.SetBasisId(basis.GetOutputDataObject(1).FindPoint(CROSSING))
    basis.Update()
    return basis.GetOutput()


def clip_tiles(knot):
    depth = 4
    clip = vtkClipToOctree()
    clip.SetInputData(knot)
    clip.SetDepth(depth)
    clip.Update()
    basis = basis_filter(knot, depth, True)
    basis.Update()
    cells = Layer(clip.GetOutputDataObject(2), wireframe=True, color=(0.35, 0.45, 0.6))
    patches = Layer(basis.GetOutput(), "PatchId", shuffled=True, edges=True)
    return [
        Tile("a surface and its octree cells", view_of(knot, 4 / 3), [Layer(knot), cells]),
        Tile("clipped to the cells; one color, one patch", BEND, [patches]),
    ]


def connectivity_tiles(knot):
    view = seen_from_other(LOWER)
    meshes = (knot, projected(knot, False), projected(knot, True))
    given, plain, aware = (strand(mesh, LOWER) for mesh in meshes)
    return [
        Tile("given on the lower strand", view, [Layer(given, "Stripes", 0, 1)]),
        Tile("plain: the strand above shows", view, [Layer(plain, "Solution", 0, 1)]),
        Tile("connectivity-aware", view, [Layer(aware, "Solution", 0, 1)]),
    ]


def basis_tiles(knot):
    tiles = []
    for space, aware in (("plain", False), ("connectivity-aware", True)):
        function = function_at_crossing(knot, aware)
        for name, side in (("lower", LOWER), ("upper", UPPER)):
            layer = Layer(strand(function, side), "BasisFunction", -0.6, 0.6)
            tiles.append(Tile(f"{space}: {name} strand", seen_from_other(side), [layer]))
    return tiles


def poisson_tiles(solution):
    view = view_of(solution, 4 / 3)
    return [
        Tile("given: stripes with noise", view, [Layer(solution, "NoisyStripes", -0.2, 1.2)]),
        Tile("Screened Poisson", view, [Layer(solution, "Solution", -0.2, 1.2)]),
    ]


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    output, pictures = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
    pictures.mkdir(parents=True, exist_ok=True)
    solution = read(output / "poisson.vtp")
    modes = tiles_of(read(output / "modes.vtp"), 24)[1:24:2]
    write_sheet(modes, pictures / "modes.png", 4, (200, 185), TITLE)
    write_sheet(poisson_tiles(solution), pictures / "poisson.png", 2, (400, 300))
    write_sheet(clip_tiles(solution), pictures / "clip.png", 2, (400, 300))
    write_sheet(basis_tiles(solution), pictures / "basis.png", 4, (225, 215), BASIS_TITLE)
    write_sheet(connectivity_tiles(solution), pictures / "connectivity.png", 3, (300, 270), CONNECTIVITY_TITLE)


if __name__ == "__main__":
    main()
