"""What every filter makes of real meshes, at two depths and with hat functions, with all other
properties as in the panel: the table Plugin/Documentation/RealMeshes.md.

    export GRIDFEM_SOURCE_DIR=. GRIDFEM_PLUGIN=build/lib/paraview-5.11/plugins/GridFEM/GridFEM.so
    export PYTHONPATH=Testing/Plugin PV_PLUGIN_CONFIG_FILE=build/lib/paraview-5.11/plugins/gridfem.plugins.xml
    xvfb-run -a pvpython Testing/outcomes.py MESH... > table.md

Every mesh has a process of its own, so that a crash is an outcome, too."""
import collections
import json
import math
import os
import pathlib
import subprocess
import sys
import time

WAYS = ({"Depth": 5}, {"Depth": 6}, {"Depth": 5, "FunctionSpace": 1})
WORDS = ("converged", "warned", "refused", "NaN", "crashed")


def name_of(way):
    return f"hats over depth {way['Depth']}" if "FunctionSpace" in way else f"depth {way['Depth']}"


def has_nan(output):
    """Whether a floating-point array of a data set has a number that is none."""
    from vtkmodules.util.numpy_support import vtk_to_numpy
    for attributes in output.GetPointData(), output.GetCellData():
        for index in range(attributes.GetNumberOfArrays()):
            array = attributes.GetArray(index)
            if array and array.GetNumberOfValues() and not math.isfinite(
                    float(vtk_to_numpy(array).sum(dtype="d"))):
                return True
    return False


def outcome(proxy, messages):
    import plugin
    output = plugin.data(proxy)
    if messages["ErrorEvent"]:
        return "refused", messages["ErrorEvent"][0]
    if has_nan(output):
        return "NaN", ""
    if messages["WarningEvent"]:
        return "warned", messages["WarningEvent"][0]
    return "converged", ""


def prepared(simple, path):
    """The surface of a file as a source, with a smooth array, labels, and a mask of a few points."""
    import numpy
    from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
    import plugin
    mesh = plugin.data(simple.ExtractSurface(Input=simple.OpenDataFile(path)))
    points = vtk_to_numpy(mesh.GetPoints().GetData())
    low, high = points.min(axis=0), points.max(axis=0)
    x, y, z = ((points - low) / (high - low).max()).T
    for name, values in (("f", numpy.sin(6 * x) * y), ("label", numpy.floor(4 * z)),
                         ("mask", (numpy.arange(len(x)) % max(1, len(x) // 100) == 0) * 1.0)):
        array = numpy_to_vtk(values.astype("d"), deep=True)
        array.SetName(name)
        mesh.GetPointData().AddArray(array)
    source = simple.TrivialProducer()
    source.GetClientSideObject().SetOutput(mesh)
    return source


def run(simple, name, source, way):
    """The outcome of one filter on one surface, with its message."""
    import plugin
    from vtkmodules.util.vtkConstants import VTK_STRING
    proxy = getattr(simple, name)(Input=source)
    choices = {**plugin.CHOICES.get(name, {}), **way}
    if name == "HarmonicInterpolation":
        choices["MaskArray"] = ["POINTS", "mask"]
    for key, value in choices.items():
        if proxy.GetProperty(key) is not None:
            setattr(proxy, key, value)
    if "FunctionSpace" in way and proxy.GetProperty("FunctionSpace") is None:
        simple.Delete(proxy)
        return None
    messages = collections.defaultdict(list)
    for event in ("ErrorEvent", "WarningEvent"):
        def listen(_, kind, text):
            messages[kind].append(text)
        listen.CallDataType = VTK_STRING
        proxy.GetClientSideObject().AddObserver(event, listen)
    begin = time.time()
    word, message = outcome(proxy, messages)
    simple.Delete(proxy)
    return {"filter": name, "way": name_of(way), "word": word, "seconds": time.time() - begin,
            "message": message.split("): ", 1)[-1].strip()}


def run_mesh(path):
    """Prints a line for each filter and way."""
    from paraview import simple
    import plugin
    from vtkmodules.vtkCommonCore import vtkOutputWindow, vtkStringOutputWindow
    vtkOutputWindow.SetInstance(vtkStringOutputWindow())
    plugin.load()
    surface = prepared(simple, path)
    for way in WAYS:
        for name in plugin.PROXIES:
            result = run(simple, name, surface, way)
            if result:
                os.write(1, (json.dumps(result) + "\n").encode())


def results_of(path):
    program = [os.readlink("/proc/self/exe"), __file__, "--one", path]
    process = subprocess.run(program, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, check=False)
    results = [json.loads(line) for line in process.stdout.decode().splitlines()
               if line.startswith("{")]
    if process.returncode != 0:
        results.append({"filter": "after these", "way": "", "word": "crashed", "seconds": 0.0,
                        "message": f"exit status {process.returncode}"})
    return results


def write_tables(results):
    """results: per mesh."""
    counts = collections.Counter()
    for mesh in results:
        counts.update((r["filter"], r["way"], r["word"]) for r in results[mesh])
    ways = [name_of(way) for way in WAYS]
    words = [word for word in WORDS if any(key[2] == word for key in counts)]
    print("| filter | " + " | ".join(f"{way}: {', '.join(words)}" for way in ways) + " |")
    print("|---" * (1 + len(ways)) + "|")
    for name in sorted({key[0] for key in counts}):
        cells = [" / ".join(str(counts[name, way, word]) for word in words) for way in ways]
        print(f"| {name} | " + " | ".join(cells) + " |")
    print("\n| mesh | filter | | | message |\n|---|---|---|---|---|")
    for mesh, of_mesh in results.items():
        for r in of_mesh:
            if r["word"] != "converged":
                print(f"| {mesh} | {r['filter']} | {r['way']} | {r['word']} | {r['message']} |")


if __name__ == "__main__":
    if sys.argv[1] == "--one":
        run_mesh(sys.argv[2])
    else:
        everything = {}
        for path in sys.argv[1:]:
            begin = time.time()
            everything[pathlib.Path(path).name] = results_of(path)
            os.write(2, f"{path}: {time.time() - begin:.0f} s\n".encode())
        write_tables(everything)
