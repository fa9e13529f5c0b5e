"""The whole pipeline with VTK alone: read, clip, build one basis, let two solvers share it, write.

    PYTHONPATH=build/lib/python3/dist-packages python3 pipeline_vtk.py \\
        MESH.vtp DEPTH SMOOTH.vtp MODES.vtp

Use the Python of the VTK that GridFEM was built with. For ParaView's VTK, use the python3 of the
system or pvpython.
"""

import sys

from gridfem.vtkGridFEMFilters import (
    vtkClipToOctree,
    vtkConnectivityAwareBasis,
    vtkLaplaceSpectrum,
    vtkScreenedPoisson,
)
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLPolyDataWriter


def write(solver, path):
    writer = vtkXMLPolyDataWriter()
    writer.SetInputConnection(solver.GetOutputPort())
    writer.SetFileName(path)
    if not writer.Write() or solver.GetOutput().GetNumberOfPoints() == 0:
        sys.exit(f"{path} could not be made; VTK said above why.")


if len(sys.argv) != 5:
    sys.exit(__doc__)

reader = vtkXMLPolyDataReader()
reader.SetFileName(sys.argv[1])

# 2^Depth cells lie along the longest side of the mesh.
clip = vtkClipToOctree()
clip.SetInputConnection(reader.GetOutputPort())
clip.SetDepth(int(sys.argv[2]))

basis = vtkConnectivityAwareBasis()
basis.SetInputConnection(clip.GetOutputPort())

# A solver takes the mesh on port 0 and the basis on port 1; its output has the mesh's own points
# and cells. No array is chosen here, so the filter smooths the coordinates.
poisson = vtkScreenedPoisson()
poisson.SetInputConnection(0, reader.GetOutputPort())
poisson.SetInputConnection(1, basis.GetOutputPort())
poisson.SetScreeningWeight(1000)

spectrum = vtkLaplaceSpectrum()
spectrum.SetInputConnection(0, reader.GetOutputPort())
spectrum.SetInputConnection(1, basis.GetOutputPort())
spectrum.SetNumberOfModes(10)
spectrum.AllModesOn()  # Mode000 to Mode009; else the array Mode, one mode per time step

# The clip and the basis run once, for both.
write(poisson, sys.argv[3])
write(spectrum, sys.argv[4])
