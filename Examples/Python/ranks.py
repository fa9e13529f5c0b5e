"""Eigenfunctions on several MPI ranks, and a picture of one beside the pieces of the ranks.

    PV_PLUGIN_CONFIG_FILE=build/paraview/gridfem.plugins.xml \\
        xvfb-run -a mpiexec -n 4 --bind-to none pvbatch ranks.py MESH DEPTH MODES.pvtp PICTURE.png

MESH is a file that ParaView reads (.ply, .vtp, ...). Without --bind-to none a rank may get only one
processor.
"""

import pathlib
import sys

from paraview import servermanager, simple

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))

from sheet import Layer, Tile, from_the_front, required, write_sheet

MODE = 9


def main():
    if len(sys.argv) != 5:
        sys.exit(__doc__)
    # PV_PLUGIN_CONFIG_FILE has loaded the plugin on every rank. One rank reads the file, then each
    # gets a piece. Files in pieces (.pvtp) come divided.
    pieces = simple.RedistributeDataSet(Input=simple.OpenDataFile(sys.argv[1]))

    # All ranks compute, and none gathers the surface; each gets its piece back, with arrays.
    modes = simple.LaplaceSpectrum(
        Input=pieces, Depth=int(sys.argv[2]), NumberOfModes=MODE + 1, AllModes=1)
    simple.SaveData(sys.argv[3], proxy=modes)

    mesh = required(servermanager.Fetch(simple.ProcessIdScalars(Input=modes)))
    ranks = mesh.GetPointData().GetArray("ProcessId").GetRange()[1] + 1
    largest = max(abs(value) for value in mesh.GetPointData().GetArray(f"Mode{MODE:03}").GetRange())
    view = from_the_front(mesh)
    write_sheet(
        [Tile(f"{ranks:.0f} ranks", view, [Layer(mesh, "ProcessId", shuffled=True)]),
         Tile(f"mode {MODE}", view, [Layer(mesh, f"Mode{MODE:03}", -largest, largest)])],
        sys.argv[4], 2, (400, 400))


main()
