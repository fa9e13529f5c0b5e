"""Shared by the tests on several ranks: surfaces in pieces, filters, and one answer for all ranks.

Every rank runs the whole script. A check is collective: it fails on all ranks if it fails on one, so
that no rank goes on alone and waits for the others.
"""
import contextlib
import os
import pathlib
import re
import resource
import sys
import unittest

import numpy
from vtkmodules.numpy_interface import dataset_adapter
from vtkmodules.util import numpy_support
from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkIntArray, vtkPoints
from vtkmodules.vtkCommonDataModel import (
    vtkCellArray, vtkDataObject, vtkDataSetAttributes, vtkPolyData)
from vtkmodules.vtkParallelCore import (
    vtkCommunicator, vtkDummyController, vtkMultiProcessController)

from gridfem import vtkGridFEMFilters

CONTROLLER = vtkMultiProcessController.GetGlobalController()
RANKS = CONTROLLER.GetNumberOfProcesses()
RANK = CONTROLLER.GetLocalProcessId()

POINTS = vtkDataObject.FIELD_ASSOCIATION_POINTS


@contextlib.contextmanager
def growing_by(room):
    """Limits this process: it can grow only by so many bytes of addresses. None sets no limit."""
    free = (resource.RLIM_INFINITY, resource.RLIM_INFINITY)
    if room is not None:
        with open("/proc/self/statm", encoding="ascii") as statm:
            used = int(statm.read().split()[0]) * resource.getpagesize()
        resource.setrlimit(resource.RLIMIT_AS, (used + room, resource.RLIM_INFINITY))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_AS, free)


def proxies():
    """Returns the names of all filters of the plugin."""
    folder = pathlib.Path(os.environ["GRIDFEM_SOURCE_DIR"]) / "Plugin"
    return [re.search(r'<SourceProxy name="(\w+)"', path.read_text()).group(1)
            for path in sorted(folder.glob("*.xml"))]


def total(number):
    """Returns the sum over the ranks."""
    own, result = vtkIntArray(), vtkIntArray()
    own.InsertNextValue(number)
    result.SetNumberOfTuples(1)
    CONTROLLER.AllReduce(own, result, vtkCommunicator.SUM_OP)
    return result.GetValue(0)


def gathered(numbers):
    """Returns the numbers of all ranks in rank order."""
    own, result = vtkDoubleArray(), vtkDoubleArray()
    for number in numbers:
        own.InsertNextValue(number)
    CONTROLLER.AllGatherV(own, result)
    return numpy_support.vtk_to_numpy(result)


def check(test, problems):
    """Fails on all ranks if there is a problem on one."""
    for problem in problems[:10]:
        print(f"rank {RANK} of {RANKS}: {problem}", flush=True)
    test.assertEqual(total(len(problems)), 0, "see above")


def main():
    """Runs the tests of the script. A successful script has to end by itself, because MPI has to
    finish, too."""
    if not unittest.main(exit=False).result.wasSuccessful():
        sys.exit(1)


# --- surfaces: points, triangles ---------------------------------------------------------------

def ellipsoid(segments=24, rings=12):
    """Makes a surface without symmetries, so that its modes are no multiplets."""
    points = [(0, 0, 1)]
    for j in range(1, rings):
        angle = numpy.pi * j / rings
        for i in range(segments):
            around = 2 * numpy.pi * i / segments
            points.append((numpy.sin(angle) * numpy.cos(around),
                           numpy.sin(angle) * numpy.sin(around), numpy.cos(angle)))
    points.append((0, 0, -1))
    last = len(points) - 1
    triangles = []
    for i in range(segments):
        following = (i + 1) % segments
        triangles.append((0, 1 + i, 1 + following))
        for j in range(rings - 2):
            a, b = 1 + j * segments + i, 1 + j * segments + following
            triangles += [(a, a + segments, b), (b, a + segments, b + segments)]
        low = 1 + (rings - 2) * segments
        triangles.append((low + i, last, low + following))
    points = numpy.array(points) * (1.0, 0.8, 0.6)
    points[:, 0] += 0.1 * points[:, 1] ** 2
    return points, numpy.array(triangles)


def two():
    """Makes two components."""
    points, triangles = ellipsoid(16, 8)
    return (numpy.concatenate([points, 0.5 * points + (2.5, 0, 0)]),
            numpy.concatenate([triangles, triangles + len(points)]))


def bowl():
    """Makes half of the surface, which has a boundary."""
    points, triangles = ellipsoid()
    return points, triangles[(points[triangles][:, :, 2] > -0.05).all(axis=1)]


def soup():
    """Makes triangles with corners of their own, as in STL files."""
    points, triangles = ellipsoid(16, 8)
    return points[triangles].reshape(-1, 3), numpy.arange(3 * len(triangles)).reshape(-1, 3)


def sheets(gap=0.003, segments=12):
    """Makes two squares with a thin gap, in planes of the grid."""
    steps = numpy.arange(segments + 1) / segments
    x, y = (axis.ravel() for axis in numpy.meshgrid(steps, steps))
    a = (numpy.arange(segments)[:, None] * (segments + 1) + numpy.arange(segments)).ravel()
    around = a + segments + 1
    triangles = numpy.concatenate([numpy.stack([a, a + 1, around + 1], axis=1),
                                   numpy.stack([a, around + 1, around], axis=1)])
    points = numpy.stack([x, y, 0.0 * x], axis=1)
    return (numpy.concatenate([points, points + [0.0, 0.0, gap]]),
            numpy.concatenate([triangles, triangles[:, ::-1] + len(points)]))


def triangle():
    """Makes fewer cells than there are ranks."""
    return numpy.array([(0.4, 0.0, 0.0), (1.0, 0.1, 0.0), (0.2, 0.9, 0.3)]), numpy.array([(0, 1, 2)])


# --- pieces -----------------------------------------------------------------------------------

def owners(cells, kind):
    """Returns the rank of every cell. -1 means that all ranks have it."""
    number = numpy.arange(cells)
    others = [rank for rank in range(RANKS) if rank != 1]
    return {
        "first": 0 * number,
        "last": 0 * number + RANKS - 1,
        "contiguous": number * RANKS // cells,
        "ghosts": number * RANKS // cells,
        "scattered": number % RANKS,
        "one rank is empty": numpy.array(others)[number * len(others) // cells],
        "all on all": 0 * number - 1}[kind]


KINDS = ("first", "last", "contiguous", "ghosts", "scattered", "one rank is empty", "all on all")


def add(attributes, name, values):
    array = numpy_support.numpy_to_vtk(numpy.ascontiguousarray(values), deep=1)
    array.SetName(name)
    attributes.AddArray(array)
    return array


def ids(values):
    array = numpy_support.numpy_to_vtkIdTypeArray(
        numpy.ascontiguousarray(values, dtype=numpy.int64), deep=1)
    return array


def surface(points, triangles, point_ids, cell_ids, global_ids=False):
    """Returns a surface with the arrays `f` and `label`, which depend on the place, `c` of cells, and
    the places of its points and cells in the whole."""
    data = vtkPolyData()
    places = vtkPoints()
    places.SetDataTypeToDouble()
    places.SetData(numpy_support.numpy_to_vtk(numpy.ascontiguousarray(points), deep=1))
    data.SetPoints(places)
    cells = vtkCellArray()
    for triangle in triangles:
        cells.InsertNextCell(3, [int(corner) for corner in triangle])
    data.SetPolys(cells)
    x, y, z = numpy.array(points).reshape(-1, 3).T
    add(data.GetPointData(), "f", x * y + 0.3 * z)
    add(data.GetPointData(), "label", numpy.floor(2 * z).astype(numpy.int32))
    add(data.GetPointData(), "origin", numpy.array(point_ids, dtype=numpy.int64))
    add(data.GetCellData(), "c", 0.5 * numpy.array(cell_ids, dtype=float))
    add(data.GetCellData(), "originCell", numpy.array(cell_ids, dtype=numpy.int64))
    add(data.GetFieldData(), "given", numpy.array([7.0]))
    if global_ids:
        for attributes, values in ((data.GetPointData(), point_ids),
                                   (data.GetCellData(), cell_ids)):
            array = ids(values)
            array.SetName("global")
            attributes.SetGlobalIds(array)
    return data


def whole(mesh, global_ids=False):
    points, triangles = mesh
    return surface(points, triangles, numpy.arange(len(points)), numpy.arange(len(triangles)),
                   global_ids)


def piece(mesh, kind, global_ids=False):
    """Returns this rank's piece. Ghosts are the cells that touch it."""
    points, triangles = mesh
    owner = owners(len(triangles), kind)
    own = (owner == RANK) | (owner < 0)
    if not own.any():
        return vtkPolyData()
    touched = numpy.zeros(len(points), dtype=bool)
    touched[triangles[own]] = True
    held = own | touched[triangles].any(axis=1) if kind == "ghosts" else own
    cell_ids = numpy.flatnonzero(held)
    point_ids, corners = numpy.unique(triangles[cell_ids], return_inverse=True)
    data = surface(points[point_ids], corners.reshape(-1, 3), point_ids, cell_ids, global_ids)
    if kind == "ghosts":
        name = vtkDataSetAttributes.GhostArrayName()
        add(data.GetCellData(), name, numpy.where(
            own[cell_ids], 0, vtkDataSetAttributes.DUPLICATECELL).astype(numpy.uint8))
        first = numpy.full(len(points), RANKS)
        numpy.minimum.at(first, triangles.ravel(), numpy.repeat(owner, 3))
        add(data.GetPointData(), name, numpy.where(
            first[point_ids] == RANK, 0, vtkDataSetAttributes.DUPLICATEPOINT).astype(numpy.uint8))
    return data


# --- filters ----------------------------------------------------------------------------------

# The properties, besides Depth and a Tolerance of 1e-13, that a filter needs to give comparable
# numbers.
CHOICES = {
    "ScreenedPoisson": {"ScreeningWeight": 100.0},
    "LaplaceSpectrum": {"NumberOfModes": 5, "AllModes": True, "Tolerance": 1e-12},
    "FunctionalMap": {"NumberOfModes": 10},
    "SpectralSignatures": {"NumberOfModes": 8, "Tolerance": 1e-12},
    "MeanCurvatureFlow": {"NumberOfSteps": 2},
    "HeatDiffusion": {"NumberOfSteps": 2},
    "SurfaceDynamics": {"NumberOfSteps": 2, "PatternLength": 1.0}}
ARRAYS = {
    "ScreenedPoisson": ["f"], "StitchColors": ["f", "label"], "HeatDiffusion": ["f"],
    "SurfaceGradient": ["f"], "HarmonicInterpolation": ["g"], "GaussianField": ["g"]}
KEEP_NO_CELLS = ("ClipToOctree", "ConnectivityAwareBasis")


def make(name, depth=4, hats=False, gathers=False, **properties):
    """Makes a filter of the plugin.

    gathers: rank 0 gathers the surface, although ranks could compute together.
    """
    made = getattr(vtkGridFEMFilters, "vtk" + name)()
    made.SetDepth(depth)
    made.SetNumberOfThreads(1)
    made.SetMaximumIterations(500)
    made.SetBlocksAsOne(gathers)
    if hats:
        made.SetFunctionSpace(made.HatFunctions)
    for key, value in {"Tolerance": 1e-13, **CHOICES.get(name, {}), **properties}.items():
        getattr(made, "Set" + key)(value)
    for index, array in enumerate(ARRAYS.get(name, [])):
        made.SetInputArrayToProcess(index, 0, 0, POINTS, array)
    if name == "FunctionalMap":
        points, triangles = ellipsoid()
        made.SetInputDataObject(2, whole((1.1 * points, triangles)))
    return made


def prepare(data):
    """Adds `g`: the values of `f` at every seventh point, unknown at the others."""
    if data.GetNumberOfPoints() > 0:
        origin = numpy_support.vtk_to_numpy(data.GetPointData().GetArray("origin"))
        f = numpy_support.vtk_to_numpy(data.GetPointData().GetArray("f"))
        add(data.GetPointData(), "g", numpy.where(origin % 7 == 0, f, numpy.nan))
    return data


def run(filter_, data):
    """Runs a filter and returns its outputs. All ranks have to call it, also those whose piece is
    unchanged."""
    filter_.SetInputDataObject(0, data)
    filter_.Modified()
    filter_.Update()
    return [filter_.GetOutputDataObject(port) for port in range(filter_.GetNumberOfOutputPorts())]


def heard(filter_, event="ErrorEvent"):
    """Returns a list that receives all messages of a filter from now on."""
    texts = []

    def hear(_, __, text=None):
        texts.append(text)
    hear.CallDataType = "string0"
    filter_.AddObserver(event, hear)
    return texts


def alone(compute):
    """Returns the result of a function if this process is the only one."""
    vtkMultiProcessController.SetGlobalController(vtkDummyController())
    try:
        return compute()
    finally:
        vtkMultiProcessController.SetGlobalController(CONTROLLER)


# --- comparison -------------------------------------------------------------------------------

# Numbers of a map. A symmetric surface has several maps, and rounding decides between them.
OF_MAPS = ("FunctionalMap", "MatchingColors", "MeanMismatch", "Mismatch", "ReferenceCorners", "ReferencePlace",
           "ReferenceWeights")


def arrays(attributes):
    """Returns arrays of numbers by their names. Leaves out ghost flags, times, numbers of maps, and ids of
    points, which count through the gathered surface."""
    wrapped = dataset_adapter.DataSetAttributes(attributes, None, None)
    names = [attributes.GetArrayName(k) for k in range(attributes.GetNumberOfArrays())]
    left_out = (vtkDataSetAttributes.GhostArrayName(), "global", "Seconds", "NearestPoint",
                "FarthestPoints", *OF_MAPS)
    return {name: numpy.array(wrapped[name], dtype=float) for name in names
            if attributes.GetArray(name) and name not in left_out}


def apart(ours, theirs):
    """Returns the largest difference. Infinite if only one of two numbers is NaN."""
    if not ours.size:
        return 0.0
    differences = abs(ours - theirs)
    differences[numpy.isnan(ours) & numpy.isnan(theirs)] = 0.0
    differences[ours == theirs] = 0.0  # infinite ones, too
    return numpy.where(numpy.isnan(differences), numpy.inf, differences).max()


# Differences of places, rounded as places are: a step may be far smaller than the surface, whose
# size is about one.
OF_PLACES = ("Displacement",)

# Errors are estimated from solutions after a cycle or two, which sweeps in single precision leave
# right to six digits where they begin from other last digits.
OF_ESTIMATES = 1e-6


def compare(ours, theirs, places, tolerance, what):
    """Returns problems with arrays at places of the whole arrays. Modes may have the other sign."""
    problems = []
    for name, values in theirs.items():
        if name not in ours:
            problems.append(f"{what}: {name} is missing")
            continue
        expected = values[places] if places is not None else values
        size = abs(numpy.nan_to_num(values)).max() if values.size else 0.0
        if name in OF_PLACES:
            size = max(size, 1.0)
        allowed = max(tolerance, OF_ESTIMATES) if name.endswith("Error") else tolerance
        signs = (1.0, -1.0) if re.fullmatch(r"Mode\d*", name) else (1.0,)
        if ours[name].shape != expected.shape:
            problems.append(f"{what}: {name} has the shape {ours[name].shape}")
            continue
        off = min(apart(ours[name], sign * expected) for sign in signs)
        if not off <= allowed * size:
            problems.append(f"{what}: {name} is {off} off, of {size}")
    return problems
