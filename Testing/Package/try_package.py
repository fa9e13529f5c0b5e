"""Testing/package.sh runs this script in pvpython, in a root with only the package and ParaView."""
import os
import sys

import numpy
from paraview import simple

simple.LoadDistributedPlugin("GridFEM", remote=False, ns=globals())
sphere = simple.Sphere(ThetaResolution=64, PhiResolution=64)
modes = simple.LaplaceSpectrum(Input=sphere, NumberOfModes=4, Depth=5)
modes.UpdatePipeline()
output = simple.servermanager.Fetch(modes)
eigenvalues = [output.GetFieldData().GetArray("Eigenvalues").GetValue(k) for k in range(4)]
if not numpy.allclose(eigenvalues, [0, 8, 8, 8], atol=0.1):  # of a sphere of radius 1/2
    sys.exit(f"wrong eigenvalues: {eigenvalues}")

sys.path.insert(0, "/usr/lib/python3/dist-packages")
import gridfem  # noqa: E402: where the package has put it

points = numpy.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], dtype=float)
distance = gridfem.distance(points, numpy.array([[0, 1, 2], [0, 2, 3]]), [0], Depth=5)
if not numpy.allclose(distance, [0, 1, 2**0.5, 1], atol=0.05):
    sys.exit(f"wrong distances: {distance}")

with open("/proc/self/maps", encoding="utf-8") as maps:
    cores = {line.split()[-1] for line in maps if "libgridfem_core" in line}
with open("/proc/cpuinfo", encoding="utf-8") as file:
    flags = next(line for line in file if line.startswith("flags")).split()
wanted = ("x86-64-v4" if "avx512vl" in flags else "x86-64-v3" if "avx2" in flags
          else "x86-64-v2" if "sse4_2" in flags else "")
if len(cores) != 1 or wanted not in min(cores):
    sys.exit(f"{cores} is loaded, not the one for {wanted}")
print("The package works, with", os.path.realpath(min(cores)))
