"""Flat maps of a surface, in ParaView's Python: one keeps angles, one changes lengths as little as possible. Colors
show the change of areas.

    PV_PLUGIN_CONFIG_FILE=build/lib/paraview-5.11/plugins/gridfem.plugins.xml \\
        xvfb-run -a pvpython flatten.py MESH CUTS PICTURE.png

MESH is a file that ParaView reads (.ply, .vtp, ...). CUTS is the number of extra cuts.
"""

import pathlib
import sys

from paraview import servermanager, simple

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))

from sheet import Layer, Tile, from_the_front, required, write_sheet


def main():
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    simple.LoadDistributedPlugin("GridFEM", remote=False, ns=globals())
    surface = simple.OpenDataFile(sys.argv[1])
    tiles = []
    for kind, label in (("Conformal", "keeps angles"), ("Isometric", "nearly keeps lengths")):
        chart = Parameterization(Input=surface, MapType=kind, ExtraCuts=int(sys.argv[2]))
        chart.UpdatePipeline()
        mesh = required(servermanager.Fetch(chart))
        flat = required(servermanager.Fetch(chart, idx=1))
        flipped = mesh.GetFieldData().GetArray("FlippedTriangles").GetRange()[1]
        print(f"{label}: area distortion {flat.GetCellData().GetArray('AreaDistortion').GetRange()}, {flipped:g} flipped")
        tiles.append(Tile(label, from_the_front(flat), [Layer(flat, "AreaDistortion", -4.0, 4.0)]))
    write_sheet(tiles, sys.argv[3], len(tiles), (420, 440))


main()
