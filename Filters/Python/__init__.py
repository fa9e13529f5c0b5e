"""Equations on the surface of a mesh, with numpy arrays in and out.

    import gridfem
    eigenvalues, modes = gridfem.spectrum(points, cells, 50)

`points` is an array of N rows with three coordinates, `cells` one of M rows with the point ids of a
polygon each: triangles, or any other number of corners. Values belong to points when they have N
rows, else to cells when they have M. Names in capitals are properties of the filter that does the
work, which the pages in Plugin/Documentation describe: `Depth=8`, `FunctionSpace=1`.

On several MPI ranks each one computes alone, on the arrays that it gives. The filters themselves, for
pipelines of VTK, are in gridfem.vtkGridFEMFilters; they work on the pieces of all ranks together.
"""

import contextlib
import warnings

import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.util.vtkConstants import VTK_STRING
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkDataObject, vtkPolyData
from vtkmodules.vtkParallelCore import vtkDummyController, vtkMultiProcessController

from gridfem import vtkGridFEMFilters

__all__ = ["Error", "curvatures", "detail", "diffuse", "distance", "flow", "interpolate", "poisson",
           "spectrum", "stitch", "surface"]

_POINTS = vtkDataObject.FIELD_ASSOCIATION_POINTS
_CELLS = vtkDataObject.FIELD_ASSOCIATION_CELLS


class Error(ValueError):
    """An input that cannot be computed on; the message says why."""


def surface(points, cells):
    """A vtkPolyData of polygons."""
    points = numpy.ascontiguousarray(points, dtype=float)
    cells = numpy.ascontiguousarray(cells, dtype=numpy.int64)
    if points.ndim != 2 or points.shape[1] != 3:
        raise Error(f"points must have three columns; their shape is {points.shape}")
    if cells.ndim != 2 or cells.shape[1] < 3:
        raise Error(f"cells must have three or more columns; their shape is {cells.shape}")
    if cells.size and not (0 <= cells.min() and cells.max() < len(points)):
        raise Error(f"cells must be ids of the {len(points)} points, from 0")
    coordinates = vtkPoints()
    coordinates.SetData(numpy_to_vtk(points, deep=True))
    polygons = vtkCellArray()
    polygons.SetData(cells.shape[1], numpy_to_vtkIdTypeArray(cells.ravel(), deep=True))
    data = vtkPolyData()
    data.SetPoints(coordinates)
    data.SetPolys(polygons)
    return data


def _add(data, name, values):
    """Adds values to points or cells, and says to which."""
    values = numpy.ascontiguousarray(values)
    if values.dtype == bool:
        values = values.astype(numpy.uint8)
    array = numpy_to_vtk(values, deep=True)
    array.SetName(name)
    if len(values) == data.GetNumberOfPoints():
        data.GetPointData().AddArray(array)
        return _POINTS
    if len(values) == data.GetNumberOfCells():
        data.GetCellData().AddArray(array)
        return _CELLS
    raise Error(f"{name} has {len(values)} rows; there are {data.GetNumberOfPoints()} points and "
                f"{data.GetNumberOfCells()} cells")


@contextlib.contextmanager
def _alone():
    """Without the other MPI ranks."""
    everybody = vtkMultiProcessController.GetGlobalController()
    vtkMultiProcessController.SetGlobalController(vtkDummyController())
    try:
        yield
    finally:
        vtkMultiProcessController.SetGlobalController(everybody)


def _run(name, points, cells, arrays, properties, sources=()):
    """The filter after its run.

    arrays: per index of SetInputArrayToProcess, name and values; values may be None.
    """
    algorithm = getattr(vtkGridFEMFilters, "vtk" + name)()
    messages = []
    observe = _Collector(messages)
    algorithm.AddObserver("ErrorEvent", observe)
    algorithm.AddObserver("WarningEvent", observe)
    data = surface(points, cells)
    for index, (array, values) in enumerate(arrays):
        if values is not None:
            algorithm.SetInputArrayToProcess(index, 0, 0, _add(data, array, values), array)
    for key, value in properties.items():
        if not hasattr(algorithm, "Set" + key):
            raise Error(f"{name} has no property {key}")
        getattr(algorithm, "Set" + key)(value)
    for point in sources:
        algorithm.AddSourcePointId(int(point))
    algorithm.SetInputData(data)
    with _alone():
        algorithm.Update()
    texts = [text for kind, text in messages if kind == "ErrorEvent"]
    if texts:
        raise Error(texts[0])
    for _, text in messages:
        warnings.warn(text, RuntimeWarning, stacklevel=3)
    return algorithm


class _Collector:
    """Takes the messages of a filter instead of printing them."""

    CallDataType = VTK_STRING

    def __init__(self, messages):
        self.messages = messages

    def __call__(self, caller, event, text):
        # VTK puts file, line and object in front of the message.
        self.messages.append((event, text.rsplit("): ", 1)[-1].strip()))


def _at_points(algorithm, name):
    return vtk_to_numpy(algorithm.GetOutput().GetPointData().GetArray(name)).copy()


def _moved_points(algorithm):
    return vtk_to_numpy(algorithm.GetOutput().GetPoints().GetData()).copy()


def spectrum(points, cells, number=20, **properties):
    """The smallest eigenvalues of the Laplace operator, and the eigenfunctions.

    Returns eigenvalues (K), in one over squared length, and their functions at the points (N, K),
    of mean square one over the area. K may be larger than `number`, because groups of equal
    eigenvalues are not cut.
    """
    algorithm = _run("LaplaceSpectrum", points, cells, [],
                     {"NumberOfModes": number, "AllModes": True, **properties})
    output = algorithm.GetOutput()
    eigenvalues = vtk_to_numpy(output.GetFieldData().GetArray("Eigenvalues")).copy()
    modes = [_at_points(algorithm, f"Mode{mode:03}") for mode in range(len(eigenvalues))]
    return eigenvalues, numpy.column_stack(modes)


def poisson(points, cells, values=None, gradients=None, weights=None, held=None, **properties):
    """The function nearest to values whose gradients are nearest to given ones.

    values: N or M rows; None takes the coordinates. gradients: a vector for each of their columns;
    None takes zero, which smooths. weights: of the values. held: where it is true at the points,
    the values stay. ScreeningWeight says how much values count, UseValueGradient and GradientScale
    sharpen, FillUnknown fills in NaN.
    """
    arrays = [("values", values), ("gradients", gradients), ("", None), ("weights", weights),
              ("held", held)]
    return _at_points(_run("ScreenedPoisson", points, cells, arrays, properties), "Solution")


def distance(points, cells, sources, **properties):
    """The distance along the surface from the nearest of the points with the ids `sources`."""
    sources = numpy.atleast_1d(sources)
    if sources.size == 0:
        raise Error("no sources")
    algorithm = _run("GeodesicDistance", points, cells, [], properties, sources)
    return _at_points(algorithm, "Distance")


def diffuse(points, cells, values, time, **properties):
    """Values after heat has spread for a time, a squared length in ParameterUnits, in 8 steps."""
    algorithm = _run("HeatDiffusion", points, cells, [("values", values)],
                     {"DiffusionTime": time, "NumberOfSteps": 8, **properties})
    return _at_points(algorithm, "Diffused")


def interpolate(points, cells, ids, values, **properties):
    """The smoothest function with the given values at the points with the given ids."""
    ids = numpy.atleast_1d(ids)
    values = numpy.asarray(values, dtype=float)
    if len(ids) != len(values):
        raise Error(f"there are {len(ids)} ids and {len(values)} values")
    if ids.size and not (0 <= ids.min() and ids.max() < len(points)):
        raise Error(f"ids must be those of the {len(points)} points, from 0")
    known = numpy.full((len(points), *values.shape[1:]), numpy.nan)
    known[ids] = values
    algorithm = _run("HarmonicInterpolation", points, cells, [("values", known)], properties)
    return _at_points(algorithm, "Interpolated")


def stitch(points, cells, colors, labels, **properties):
    """Colours of several scans without the jumps between them; `labels` says which scan."""
    algorithm = _run("StitchColors", points, cells, [("colors", colors), ("labels", labels)],
                     properties)
    data = algorithm.GetOutput()
    attributes = data.GetPointData() if len(colors) == len(points) else data.GetCellData()
    return vtk_to_numpy(attributes.GetArray("StitchedColors")).copy()


def curvatures(points, cells, **properties):
    """Minimum and maximum curvature at the points, in one over length, and their directions.

    Returns arrays of the shapes (N), (N), (N, 3), (N, 3); convex is positive.
    """
    algorithm = _run("PrincipalCurvatures", points, cells, [], properties)
    return tuple(_at_points(algorithm, name) for name in (
        "MinimumCurvature", "MaximumCurvature", "MinimumCurvatureDirection",
        "MaximumCurvatureDirection"))


def detail(points, cells, scale=2.0, **properties):
    """The points of the surface with its details enlarged (scale above 1) or taken away (0)."""
    return _moved_points(
        _run("SurfaceDetail", points, cells, [], {"DetailScale": scale, **properties}))


def flow(points, cells, steps=10, **properties):
    """The points of the surface after steps of mean-curvature flow, each of length TimeStep."""
    algorithm = _run("MeanCurvatureFlow", points, cells, [], {"NumberOfSteps": steps, **properties})
    with _alone():
        algorithm.UpdateTimeStep(float(steps))
    return _moved_points(algorithm)
