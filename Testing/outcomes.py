"""Runs every filter on real meshes, at two depths and with hat functions, with all other properties
as in the panel. Prints the page Plugin/Documentation/RealMeshes.md.

    export GRIDFEM_SOURCE_DIR=. GRIDFEM_PLUGIN=build/paraview/GridFEM/GridFEM.so
    export PYTHONPATH=Testing/Plugin PV_PLUGIN_CONFIG_FILE=build/paraview/gridfem.plugins.xml
    xvfb-run -a pvpython Testing/outcomes.py MESH... > Plugin/Documentation/RealMeshes.md

MESH: files that ParaView reads, and .off. Every mesh has a process of its own, so that a crash is an
outcome, too."""
import collections
import json
import os
import pathlib
import re
import subprocess
import sys
import time

import numpy

WAYS = ({"Depth": 5}, {"Depth": 6}, {"Depth": 5, "FunctionSpace": 1})
WORDS = ("converged", "in part", "warned", "refused", "NaN", "crashed")

# Filters whose values are NaN on components without known values or sources.
IN_PARTS = ("FarthestPoints", "GeodesicDistance", "HarmonicInterpolation")

PAGE = """# On real meshes

This page shows how the filters of its table cope with {surfaces} real surfaces of {fewest:,} to {most:,} triangles: scans, machine
parts, terrain, anatomy and broken files. They have up to {components:,} components. They are closed and open, of
high genus, not manifold, not oriented or unwelded, and some have slivers or only slivers.

The table counts the surfaces on which a filter converged, warned or refused, with all other properties
as in its panel. A number alone counts the surfaces on which it converged. "In part" means that some
values are not a number, as expected. Distances are missing on components without a source. Interpolated
values are missing on components without a known value. Both are missing at points that only triangles
without area use.

{counts}

A flow ends early if a part of the surface shrinks to a point or a line within the ten steps. Three dots
stand for numbers that differ from surface to surface.

| filter | | what it says | where |
|---|---|---|---|
{messages}

`Testing/outcomes.py` makes this page."""


def name_of(way):
    return f"hats over depth {way['Depth']}" if "FunctionSpace" in way else f"depth {way['Depth']}"


def nan_of(output):
    """Returns the places of NaN in the floating-point arrays of a surface: per array of points, for
    each point; True for any other array that has one."""
    from vtkmodules.util.numpy_support import vtk_to_numpy
    found = []
    for attributes in output.GetPointData(), output.GetCellData():
        for index in range(attributes.GetNumberOfArrays()):
            array = attributes.GetArray(index)
            if array and array.GetNumberOfValues():
                values = vtk_to_numpy(array).astype("d").reshape(array.GetNumberOfTuples(), -1)
                if not numpy.isfinite(values).all():
                    found.append(~numpy.isfinite(values).all(axis=1)
                                 if attributes.IsA("vtkPointData") else True)
    return found


def is_of_whole_parts(output, is_none):
    """Whether no triangle with an area has a number at one corner and none at another."""
    from vtkmodules.util.numpy_support import vtk_to_numpy
    points = vtk_to_numpy(output.GetPoints().GetData()).astype("d")
    offsets = vtk_to_numpy(output.GetPolys().GetOffsetsArray())
    corners = vtk_to_numpy(output.GetPolys().GetConnectivityArray())
    for polygon in numpy.split(corners, offsets[1:-1]):
        if len(set(is_none[polygon])) > 1:
            sides = points[polygon] - points[polygon[0]]
            area = numpy.linalg.norm(numpy.cross(sides[:-1], sides[1:]).sum(axis=0))
            if area > 1e-10 * (sides ** 2).sum():
                return False
    return True


def outcome(proxy, messages):
    import plugin
    output = plugin.data(proxy)
    if messages["ErrorEvent"]:
        return "refused", messages["ErrorEvent"][0]
    places = nan_of(output)
    in_parts = bool(places) and all(
        place is not True and is_of_whole_parts(output, place) for place in places)
    is_expected = in_parts and proxy.GetXMLName() in IN_PARTS
    if places and not (is_expected or any("NaN" in text for text in messages["WarningEvent"])):
        return "NaN", ""
    if messages["WarningEvent"]:
        return "warned", messages["WarningEvent"][0]
    if places:
        return "in part", ""
    return "converged", ""


def read_off(path):
    """The polygons of an OFF file; neither ParaView nor meshio reads polygons with more than three
    corners."""
    from vtkmodules.vtkCommonCore import vtkPoints
    from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
    text = re.sub("#.*", "", pathlib.Path(path).read_text(encoding="ascii"))
    words = iter(text.split()[1:])
    numbers = [int(next(words)) for _ in ("points", "polygons", "edges")]
    points, polygons = vtkPoints(), vtkCellArray()
    points.SetDataTypeToDouble()
    for _ in range(numbers[0]):
        points.InsertNextPoint([float(next(words)) for _ in "xyz"])
    for _ in range(numbers[1]):
        corners = [int(next(words)) for _ in range(int(next(words)))]
        polygons.InsertNextCell(len(corners), corners)
    mesh = vtkPolyData()
    mesh.SetPoints(points)
    mesh.SetPolys(polygons)
    return mesh


def surface_of(path):
    """The polygons of a file."""
    from paraview import simple
    import plugin
    if path.endswith(".off"):
        return read_off(path)
    return plugin.data(simple.ExtractSurface(Input=simple.OpenDataFile(path)))


def size_of(mesh):
    from vtkmodules.vtkFiltersCore import vtkCleanPolyData, vtkPolyDataConnectivityFilter
    welded = vtkCleanPolyData()
    welded.SetInputData(mesh)
    parts = vtkPolyDataConnectivityFilter()
    parts.SetInputConnection(welded.GetOutputPort())
    parts.SetExtractionModeToAllRegions()
    parts.Update()
    return {"triangles": mesh.GetNumberOfPolys(), "components": parts.GetNumberOfExtractedRegions()}


def prepared(mesh):
    """A surface as a source, with a smooth array, labels, and a mask of a few points."""
    from paraview import simple
    from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
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
    """Prints a line of its size, and one for each filter and way."""
    from paraview import simple
    import plugin
    from vtkmodules.vtkCommonCore import vtkOutputWindow, vtkStringOutputWindow
    vtkOutputWindow.SetInstance(vtkStringOutputWindow())
    plugin.load()
    mesh = surface_of(path)
    source = prepared(mesh)

    def tell(result):
        os.write(1, (json.dumps(result) + "\n").encode())

    tell(size_of(mesh))
    for way in WAYS:
        for name in plugin.PROXIES:
            result = run(simple, name, source, way)
            if result:
                tell(result)


def results_of(path):
    """The size of a mesh, and its outcomes."""
    program = [os.readlink("/proc/self/exe"), __file__, "--one", path]
    process = subprocess.run(program, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, check=False)
    if process.returncode > 0:
        sys.exit(process.stderr)
    lines = [json.loads(line) for line in process.stdout.splitlines() if line.startswith("{")]
    if not lines:
        sys.exit(f"{path} ends the program before any filter runs: signal {-process.returncode}")
    size, *results = lines
    if process.returncode < 0:
        results.append({"filter": "what follows these", "way": "", "word": "crashed", "seconds": 0.0,
                        "message": f"signal {-process.returncode}"})
    return size, results


def title_of(name):
    """The name of a filter as the pages have it, such as Clip To Octree."""
    return re.sub(r"(?<=[a-z])(?=[A-Z])", " ", name).replace("Connectivity Aware", "Connectivity-Aware")


def in_common(messages):
    """One message for several that differ in numbers alone."""
    number = r"\d+(?:\.\d+)?(?:e[-+]?\d+)?"
    texts = [re.split(f"({number})", message) for message in messages]
    return "".join(parts[0] if len(set(parts)) == 1 else "…" for parts in zip(*texts))


def counts_of(results):
    """The table of how many surfaces had which outcome."""
    counts = collections.Counter(
        (r["filter"], r["way"], r["word"]) for of_mesh in results.values() for r in of_mesh)
    ways = [name_of(way) for way in WAYS]
    lines = ["| filter | " + " | ".join(ways) + " |", "|---" * (1 + len(ways)) + "|"]
    for name in sorted({key[0] for key in counts}):
        cells = [", ".join(f"{counts[name, way, word]} {word}".removesuffix(" converged")
                           for word in WORDS if counts[name, way, word]) for way in ways]
        lines.append(f"| {title_of(name)} | " + " | ".join(cells) + " |")
    return "\n".join(lines)


def messages_of(results):
    """The table of all that did not simply converge: one line for a message, whatever its numbers."""
    alike = collections.defaultdict(list)
    for mesh, of_mesh in results.items():
        for r in of_mesh:
            if r["word"] not in ("converged", "in part"):
                words = re.sub(r"\d+(?:\.\d+)?(?:e[-+]?\d+)?", "#", r["message"])
                alike[r["filter"], r["word"], words].append((mesh, r["way"], r["message"]))
    filters = collections.defaultdict(list)
    for (name, word, _), cases in sorted(alike.items()):
        ways = collections.defaultdict(list)
        for mesh, way, _ in cases:
            ways[mesh].append(way)
        meshes = collections.defaultdict(list)
        for mesh, of_mesh in ways.items():
            meshes[", ".join(of_mesh)].append(mesh)
        where = "; ".join(f"{', '.join(names)} ({way})" for way, names in meshes.items())
        message = in_common([message for _, _, message in cases])
        filters[word, message, where].append(title_of(name))
    return "\n".join(f"| {', '.join(names)} | {' | '.join(key)} |" for key, names in filters.items())


def write_page(sizes, results):
    """sizes, results: per mesh."""
    triangles = [size["triangles"] for size in sizes.values()]
    print(PAGE.format(
        surfaces=len(sizes), fewest=min(triangles), most=max(triangles),
        components=max(size["components"] for size in sizes.values()), counts=counts_of(results),
        messages=messages_of(results)))


if __name__ == "__main__":
    if sys.argv[1] == "--one":
        run_mesh(sys.argv[2])
    else:
        sizes, everything = {}, {}
        for path in sys.argv[1:]:
            begin = time.time()
            mesh = pathlib.Path(path).stem
            sizes[mesh], everything[mesh] = results_of(path)
            os.write(2, f"{path}: {time.time() - begin:.0f} s\n".encode())
        write_page(sizes, everything)
