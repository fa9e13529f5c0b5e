"""The whole pipeline in ParaView: read, clip, build one basis, let two solvers share it, write.

    PV_PLUGIN_CONFIG_FILE=build/paraview/gridfem.plugins.xml \\
        pvpython pipeline.py MESH.vtp DEPTH SMOOTH.vtp MODES.vtp

With an installed GridFEM, use the path of the installed gridfem.plugins.xml.
"""

import sys

from paraview.simple import LoadDistributedPlugin, SaveData, XMLPolyDataReader

LoadDistributedPlugin("GridFEM", remote=False, ns=globals())

if len(sys.argv) != 5:
    sys.exit(__doc__)

mesh = XMLPolyDataReader(FileName=[sys.argv[1]])

# 2^Depth cells lie along the longest side of the mesh.
clip = ClipToOctree(Input=mesh, Depth=int(sys.argv[2]))  # noqa: F821, from the plugin
basis = ConnectivityAwareBasis(Input=clip)  # noqa: F821

# A solver takes the mesh and the basis; its output has the mesh's own points and cells. No array is
# chosen here, so the filter smooths the coordinates.
smooth = ScreenedPoisson(Input=mesh, Basis=basis, ScreeningWeight=1000)  # noqa: F821
modes = LaplaceSpectrum(Input=mesh, Basis=basis, NumberOfModes=10, AllModes=1)  # noqa: F821

# ParaView runs every needed filter once. Clip and basis serve both solvers.
SaveData(sys.argv[3], proxy=smooth)
SaveData(sys.argv[4], proxy=modes)

if 0 in (f.GetDataInformation().GetNumberOfPoints() for f in (smooth, modes)):
    sys.exit("A filter could not do its work; ParaView said above why.")
