"""Renders the eigenfunctions that the main job wrote as one picture, modes.png.

    xvfb-run -a pvpython contact_sheet.py OUTPUT [--modes N]

OUTPUT is the folder of the main job. Every tile shows one mode, blue where it is negative and red
where it is positive, with its number and its eigenvalue.
"""

import argparse
import math
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))

from sheet import Layer, Tile, view_of, write_sheet
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

TILE = (300, 270)
TITLE = "Eigenfunctions of the Laplace operator on the surface: blue negative, red positive; " \
    "with eigenvalues"


def read(path):
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(str(path))
    reader.Update()
    return reader.GetOutput()


def tiles_of(mesh, count):
    eigenvalues = mesh.GetFieldData().GetArray("Eigenvalues")
    view = view_of(mesh, TILE[0] / TILE[1])
    tiles = []
    for i in range(min(count, eigenvalues.GetNumberOfTuples())):
        name = f"Mode{i:03d}"
        largest = max(abs(x) for x in mesh.GetPointData().GetArray(name).GetRange()) or 1.0
        label = f"mode {i}:  {eigenvalues.GetValue(i):.4g}"
        tiles.append(Tile(label, view, [Layer(mesh, name, -largest, largest)]))
    return tiles


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("output", type=pathlib.Path, help="the folder of the main job")
    parser.add_argument("--modes", type=int, default=48, help="show at most this many")
    arguments = parser.parse_args()

    source = arguments.output / "modes.vtp"
    if not source.is_file():
        sys.exit(f"{source} is not there; run the main job first.")
    mesh = read(source)
    if not mesh.GetFieldData().HasArray("Eigenvalues"):
        sys.exit(f"{source} holds no modes; it is not an output of the main job.")
    tiles = tiles_of(mesh, arguments.modes)
    columns = math.ceil(math.sqrt(1.4 * len(tiles)))
    title = TITLE if columns > 3 else ""
    write_sheet(tiles, arguments.output / "modes.png", columns, TILE, title)


if __name__ == "__main__":
    main()
