"""Seconds of a first Apply of Screened Poisson with no property touched, and of the same to a
tolerance of 1e-6, from the click to values at the points. Every mesh is in memory before.

    PV_PLUGIN_CONFIG_FILE=build/paraview/gridfem.plugins.xml \\
        xvfb-run -a pvpython time_first_apply.py MESH...
"""

import pathlib
import sys
import time

from paraview import simple

REPEATS = 3


def first_apply(reader, properties):
    """Seconds and iterations of a new filter's first run."""
    poisson = ScreenedPoisson(Input=reader)
    for name, value in properties.items():
        setattr(poisson, name, value)
    start = time.perf_counter()
    poisson.UpdatePipeline()
    seconds = time.perf_counter() - start
    fields = poisson.GetDataInformation().GetFieldDataInformation()
    iterations = fields.GetArrayInformation("Iterations").GetComponentRange(0)[1]
    simple.Delete(poisson)
    return seconds, iterations


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    simple.LoadDistributedPlugin("GridFEM", remote=False, ns=globals())
    print("| mesh | points | first Apply | iterations | to 1e-6 | iterations |")
    print("|---|---|---|---|---|---|")
    for path in sys.argv[1:]:
        reader = simple.OpenDataFile(path)
        reader.UpdatePipeline()
        cells = [pathlib.Path(path).stem, str(reader.GetDataInformation().GetNumberOfPoints())]
        for properties in ({}, {"Tolerance": 1e-6, "Accuracy": 0.0}):
            seconds, iterations = min(first_apply(reader, properties) for _ in range(REPEATS))
            cells += [f"{seconds:.2f}", f"{iterations:.0f}"]
        print("| " + " | ".join(cells) + " |", flush=True)
        simple.Delete(reader)


main()
