"""Seconds from a change of a property of Surface Detail to the new picture in a view of ParaView.

    PV_PLUGIN_CONFIG_FILE=build/paraview/gridfem.plugins.xml \\
        xvfb-run -a pvpython time_detail.py MESH DEPTH
"""

import statistics
import sys
import time

from paraview import simple

REPEATS = 5


def seconds(run):
    start = time.perf_counter()
    run()
    return time.perf_counter() - start


def selection(first):
    """2,000 points in a row."""
    return simple.IDSelectionSource(
        FieldType="POINT", IDs=[number for point in range(first, first + 2000) for number in (0, point)])


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    simple.LoadDistributedPlugin("GridFEM", remote=False, ns=globals())
    detail = SurfaceDetail(Input=simple.OpenDataFile(sys.argv[1]), Depth=int(sys.argv[2]))
    view = simple.CreateRenderView(ViewSize=[1000, 800])
    first = seconds(detail.UpdatePipeline)
    simple.ColorBy(simple.Show(detail, view), None)
    simple.ResetCamera(view)
    simple.Render(view)
    print(f"{detail.GetDataInformation().GetNumberOfPoints()} points, first run {first:.2f} s")

    def measure(name, change):
        filtered, drawn = [], []
        for k in range(REPEATS):
            change(k)
            filtered.append(seconds(detail.UpdatePipeline))
            drawn.append(seconds(lambda: simple.Render(view)))
        both = [a + b for a, b in zip(filtered, drawn)]
        print(f"{name:32} {statistics.median(both):.2f} s, of which the filter takes "
              f"{statistics.median(filtered):.2f}")

    def setting(name, start, step):
        return lambda k: setattr(detail, name, start + step * k)

    def select(k):
        detail.Selection = selection(1000 * k)

    measure("DetailScale", setting("DetailScale", 0.5, 0.1))
    measure("ScreeningWeight", setting("ScreeningWeight", 2000, 100))
    measure("Selection", select)
    simple.SetProperties(detail, Selection=None, TransferFunction="Large Positive")
    detail.UpdatePipeline()
    measure("Anisotropy", setting("Anisotropy", 3, 0.5))
    simple.Delete(view)


main()
