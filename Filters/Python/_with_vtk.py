"""Calls the filters, in the VTK that they were built with."""

import contextlib
import re

import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.util.vtkConstants import VTK_STRING
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonCore import vtkIdList
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkDataObject, vtkPolyData, vtkPolygon
from vtkmodules.vtkCommonExecutionModel import vtkPolyDataAlgorithm
from vtkmodules.vtkParallelCore import vtkDummyController, vtkMultiProcessController

from . import vtkGridFEMFilters
from ._inputs import Error, checked, number

_POINTS = vtkDataObject.FIELD_ASSOCIATION_POINTS
_CELLS = vtkDataObject.FIELD_ASSOCIATION_CELLS

# The indices of SetInputArrayToProcess by filter, and those of all other filters.
_INDICES = {
    "ScreenedPoisson": {"values": 0, "gradients": 1, "gradient_scale": 2, "weights": 3, "held": 4, "flux": 6},
    "HeatDiffusion": {"values": 0, "source": 1, "held": 2},
    "SurfaceDetail": {"values": 0, "scales": 1},
    "SurfaceDynamics": {"start": 0, "velocity": 1}}
_OTHER_INDICES = {"values": 0, "colors": 0, "labels": 1}

# Results in several point arrays, whose names begin with these words.
_STEMS = {"Modes": "Mode", "Samples": "Sample", "Surrogates": "Surrogate"}

# Properties of pipelines, which the functions do not have: of all filters, and of single ones.
_OF_PIPELINES = {"AllModes", "BlocksAsOne", "Mode", "TimeFrom", "UseSourcePosition"}
_OF_PIPELINES_BY_FILTER = {
    "GeodesicPaths": {"Device", "MaximumIterations", "Tolerance"}, "LaplaceSpectrum": {"TrackMetric"},
    "Parameterization": {"Device", "MaximumIterations", "Tolerance"}, "ScreenedPoisson": {"TrackMetric"}}


def surface(points, cells):
    """Makes a vtkPolyData of polygons."""
    points, cells = checked(points, cells)
    coordinates = vtkPoints()
    coordinates.SetData(numpy_to_vtk(points, deep=True))
    polygons = vtkCellArray()
    polygons.SetData(cells.shape[1], numpy_to_vtkIdTypeArray(cells.ravel(), deep=True))
    data = vtkPolyData()
    data.SetPoints(coordinates)
    data.SetPolys(polygons)
    return data


@contextlib.contextmanager
def _alone():
    """Computes without the other MPI ranks."""
    everybody = vtkMultiProcessController.GetGlobalController()
    vtkMultiProcessController.SetGlobalController(vtkDummyController())
    try:
        yield
    finally:
        vtkMultiProcessController.SetGlobalController(everybody)


class _Collector:
    """Takes the messages of a filter instead of printing them."""

    CallDataType = VTK_STRING

    def __init__(self, messages):
        self.messages = messages

    def __call__(self, caller, event, text):
        # VTK puts file, line and object in front of the message.
        self.messages.append((event, text.rsplit("): ", 1)[-1].strip()))


class _Results:
    """Gives the arrays of outputs by their names. The first output that has the name counts."""

    def __init__(self, outputs):
        self.output = outputs[0]
        self.outputs = [output for output in outputs if output.IsA("vtkPolyData")]
        self.tables = [output for output in outputs if output.IsA("vtkTable")]

    def _columns(self, stem):
        """Returns all point arrays whose names begin with the stem, side by side, or None without any."""
        points = self.output.GetPointData()
        names = [points.GetArrayName(k) for k in range(points.GetNumberOfArrays())]
        columns = [self[name] for name in names if name.startswith(stem)]
        return numpy.column_stack(columns) if columns else None

    def __getitem__(self, name):
        if name == "Points":
            return vtk_to_numpy(self.output.GetPoints().GetData()).copy()
        if name == "State":
            points = self.output.GetPointData()
            return numpy.column_stack([self["U"], self["V"]]) if points.HasArray("V") else self["U"]
        if name in _STEMS:
            columns = self._columns(_STEMS[name])
            if columns is None and name == "Samples":
                columns = numpy.column_stack([self["Prediction"], self["PredictionStandardDeviation"]])
            if columns is None:
                raise KeyError(name)
            return columns
        if name == "FlatPoints":
            flat = vtk_to_numpy(self.outputs[-1].GetPoints().GetData())[:, :2]
            return flat - flat.min(axis=0)
        if name == "FlatTriangles":
            return vtk_to_numpy(self.outputs[-1].GetPolys().GetConnectivityArray()).reshape(-1, 3).copy()
        if name == "Distortion":
            cells = self.outputs[-1].GetCellData()
            return numpy.column_stack([vtk_to_numpy(cells.GetArray(kind + "Distortion"))
                                       for kind in ("Angle", "Area")])
        attributes = [data for output in self.outputs for data in (
            output.GetPointData(), output.GetCellData(), output.GetFieldData())]
        attributes += [table.GetRowData() for table in self.tables]
        found = next((a for a in attributes if a.HasArray(name)), None)
        if found is None:
            raise KeyError(name)
        return vtk_to_numpy(found.GetArray(name)).copy()


def triangulate(corners):
    """Returns the triangles of a polygon, which may be concave, as rows of its corners."""
    polygon = vtkPolygon()
    polygon.GetPoints().SetData(numpy_to_vtk(corners, deep=True))
    polygon.GetPointIds().SetNumberOfIds(len(corners))
    for k in range(len(corners)):
        polygon.GetPointIds().SetId(k, k)
    triangles = vtkIdList()
    polygon.Triangulate(0, triangles, vtkPoints())  # VTK 9.6 has no other
    return numpy.array([triangles.GetId(k) for k in range(triangles.GetNumberOfIds())],
                       dtype=numpy.int64).reshape(-1, 3)


def has_property(algorithm, name, key):
    """Returns whether a filter has a property with a number that changes its result."""
    of_pipelines = _OF_PIPELINES | _OF_PIPELINES_BY_FILTER.get(name, set())
    return (key not in of_pipelines and hasattr(algorithm, "Set" + key)
            and not hasattr(vtkPolyDataAlgorithm, "Set" + key) and _number_of(algorithm, key) is not None)


def _number_of(algorithm, key):
    """Returns the value of a property, or None if it is no number."""
    try:
        value = getattr(algorithm, "Get" + key)()
    except (AttributeError, TypeError):  # there is none, or it takes arguments
        return None
    return value if isinstance(value, (int, float)) else None


def _set(algorithm, name, key, value):
    """Sets a property. Raises Error for one that does not exist, and for a value of another type."""
    if not has_property(algorithm, name, key):
        raise Error(f"{name} has no property {key}")
    value = number(key, value)
    kind = type(_number_of(algorithm, key))
    if kind is int and numpy.isfinite(value) and value != numpy.floor(value):
        label = re.sub("(?<=[a-z])(?=[A-Z])", " ", key)
        raise Error(f"{label} must be an integer.")
    try:
        getattr(algorithm, "Set" + key)(kind(value))
    except (ValueError, OverflowError) as error:
        raise Error(f"{key} = {value!r}: {error}") from None


def solve(name, points, cells, arrays, properties, sources=(), observed=(), reactions=(),
          reference=None, partners=()):
    """Returns the arrays that the filter gives, by their names, and its warnings.

    arrays: values and whether they are at points, by name. sources: ids of points. observed: the
    values of Gaussian Field at these points. reactions: the formulas of Surface Dynamics.
    reference: points and cells of the reference of Functional Map. partners: its points for the sources.
    """
    algorithm = getattr(vtkGridFEMFilters, "vtk" + name)()
    messages = []
    observe = _Collector(messages)
    algorithm.AddObserver("ErrorEvent", observe)
    algorithm.AddObserver("WarningEvent", observe)
    data = surface(points, cells)
    for array, (values, on_points) in arrays.items():
        column = numpy_to_vtk(values, deep=True)
        column.SetName(array)
        (data.GetPointData() if on_points else data.GetCellData()).AddArray(column)
        index = _INDICES.get(name, _OTHER_INDICES)[array]
        algorithm.SetInputArrayToProcess(index, 0, 0, _POINTS if on_points else _CELLS, array)
    if name == "LaplaceSpectrum":
        algorithm.AllModesOn()
    for key, value in properties.items():
        _set(algorithm, name, key, value)
    if reactions:
        algorithm.SetReactionU(reactions[0])
        algorithm.SetReactionV("".join(reactions[1:]))
    if name == "GaussianField":
        for point, value in zip(sources, observed):
            algorithm.AddObservation(int(point), float(value))
    elif name == "FunctionalMap":
        for point, partner in zip(sources, partners):
            algorithm.AddLandmark(int(point), int(partner))
        algorithm.SetInputData(2, surface(*reference))
    else:
        for point in sources:
            algorithm.AddSourcePointId(int(point))
    algorithm.SetInputData(data)
    with _alone():
        algorithm.Update()
    texts = [text for kind, text in messages if kind == "ErrorEvent"]
    if texts:
        raise Error(texts[0])
    warnings = [text for _, text in messages]
    if algorithm.GetOutput().GetNumberOfPoints() == 0:
        raise Error(" ".join(["there is no result: the input has no points, or the run was aborted", *warnings]))
    return _Results([algorithm.GetOutputDataObject(port)
                     for port in range(algorithm.GetNumberOfOutputPorts())]), warnings
