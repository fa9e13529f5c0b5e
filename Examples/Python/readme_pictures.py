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
from vtkmodules.vtkCommonDataModel import vtkDataObject

# One of the three places where strands of the knot cross, looked at from outside.
CROSSING = View((-2.0, 0.0, 0.0), (-0.91, -0.0, 0.42), (0.42, 0.0, 0.91), 3.4)
COARSE = 5


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
    poisson.SetDepth(COARSE)
    poisson.SetConnectivityAware(aware)
    points = vtkDataObject.FIELD_ASSOCIATION_POINTS
    poisson.SetInputArrayToProcess(0, 0, 0, points, "Stripes")
    poisson.SetScreeningWeight(1e6)
    poisson.Update()
    return poisson.GetOutput()


def function_at_crossing(knot, aware):
    """The basis function of the grid corner next to the crossing."""
    basis = basis_filter(knot, COARSE, aware)
    basis.Update()
    basis.SetBasisId(basis.GetOutputDataObject(1).FindPoint(CROSSING.centre))
    basis.Update()
    return basis.GetOutput()


def clip_tiles(knot):
    clip = vtkClipToOctree()
    clip.SetInputData(knot)
    clip.SetDepth(COARSE)
    basis = basis_filter(knot, COARSE, True)
    basis.Update()
    clip.Update()
    cells = Layer(clip.GetOutputDataObject(2), wireframe=True, color=(0.35, 0.45, 0.6))
    patches = Layer(basis.GetOutput(), "PatchId", shuffled=True, edges=True)
    near = View(CROSSING.centre, CROSSING.direction, CROSSING.up, 2.6)
    return [
        Tile("the surface and its octree cells", view_of(knot, 4 / 3), [Layer(knot), cells]),
        Tile("clipped to the cells: every patch its own colour", near, [patches]),
    ]


def connectivity_tiles(knot):
    plain, aware = projected(knot, False), projected(knot, True)
    return [
        Tile("given: stripes", CROSSING, [Layer(knot, "Stripes", 0, 1)]),
        Tile("plain functions: strands mix", CROSSING, [Layer(plain, "Solution", 0, 1)]),
        Tile("connectivity-aware functions", CROSSING, [Layer(aware, "Solution", 0, 1)]),
    ]


def basis_tiles(knot):
    near = View(CROSSING.centre, CROSSING.direction, CROSSING.up, 2.0)
    labels = ("plain: one function, on both strands", "connectivity-aware: one for each strand")
    return [
        Tile(label, near, [Layer(function_at_crossing(knot, aware), "BasisFunction", -0.5, 0.5)])
        for label, aware in zip(labels, (False, True))
    ]


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
    write_sheet(modes, pictures / "modes.png", 4, (210, 189), TITLE)
    write_sheet(poisson_tiles(solution), pictures / "poisson.png", 2, (400, 300))
    write_sheet(clip_tiles(solution), pictures / "clip.png", 2, (400, 300))
    write_sheet(basis_tiles(solution), pictures / "basis.png", 2, (400, 300))
    write_sheet(connectivity_tiles(solution), pictures / "connectivity.png", 3, (300, 270))


if __name__ == "__main__":
    main()
