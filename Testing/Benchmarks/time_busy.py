"""Seconds that a new weight of Screened Poisson takes, alone and beside two processes that compute. Run with
no variables of OpenMP set, as users do:

    PV_PLUGIN_CONFIG_FILE=build/paraview/gridfem.plugins.xml pvpython time_busy.py MESH DEPTH
"""

import statistics
import subprocess
import sys
import time

from paraview import simple

REPEATS = 9
BOUND = 3.0


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    simple.LoadDistributedPlugin("GridFEM", remote=False, ns=globals())
    solver = ScreenedPoisson(Input=simple.OpenDataFile(sys.argv[1]), Depth=int(sys.argv[2]))
    solver.UpdatePipeline()
    weight = 100.0

    def seconds():
        nonlocal weight
        taken = []
        for _ in range(REPEATS):
            weight *= 1.1
            solver.ScreeningWeight = weight
            start = time.perf_counter()
            solver.UpdatePipeline()
            taken.append(time.perf_counter() - start)
        return statistics.median(taken)

    alone = seconds()
    others = [subprocess.Popen(["sh", "-c", "while :; do :; done"]) for _ in range(2)]
    try:
        busy = seconds()
    finally:
        for other in others:
            other.kill()
    print(f"{solver.GetDataInformation().GetNumberOfPoints()} points, a new weight: {alone:.3f} s alone, "
          f"{busy:.3f} s beside two busy processes")
    print(f"RATIO weight_change_beside_two_busy_processes {busy / alone:.3g} <= {BOUND:g}")


main()
