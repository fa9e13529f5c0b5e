"""Calls the filters, in the VTK that they were built with."""

import contextlib
import warnings

import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.util.vtkConstants import VTK_STRING
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonCore import vtkIdList
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkDataObject, vtkPolyData, vtkPolygon
from vtkmodules.vtkParallelCore import vtkDummyController, vtkMultiProcessController

from . import vtkGridFEMFilters
from ._inputs import Error, checked, placed

_POINTS = vtkDataObject.FIELD_ASSOCIATION_POINTS
_CELLS = vtkDataObject.FIELD_ASSOCIATION_CELLS

# The indices of SetInputArrayToProcess by filter, and those of all other filters.
_INDICES = {
    "ScreenedPoisson": {"values": 0, "gradients": 1, "gradient_scale": 2, "weights": 3, "held": 4, "flux": 6},
    "HeatDiffusion": {"values": 0, "source": 1, "held": 2},
    "SurfaceDetail": {"values": 0, "scales": 1}}
_OTHER_INDICES = {"values": 0, "colors": 0, "labels": 1}


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

    def __getitem__(self, name):
        if name == "Points":
            return vtk_to_numpy(self.output.GetPoints().GetData()).copy()
        if name == "Modes":
            count = self.output.GetFieldData().GetArray("Eigenvalues").GetNumberOfTuples()
            return numpy.column_stack([self[f"Mode{mode:03}"] for mode in range(count)])
        if name == "Samples":
            points = self.output.GetPointData()
            names = [points.GetArrayName(k) for k in range(points.GetNumberOfArrays())]
            names = ([name for name in names if name.startswith("Sample")]
                     or ["Prediction", "PredictionStandardDeviation"])
            return numpy.column_stack([self[name] for name in names])
        if name == "FlatPoints":
            flat = vtk_to_numpy(self.outputs[-1].GetPoints().GetData())[:, :2]
            return flat - flat.min(axis=0)
        if name == "FlatTriangles":
            return vtk_to_numpy(self.outputs[-1].GetPolys().GetConnectivityArray()).reshape(-1, 3).copy()
        if name == "Distortion":
            cells = self.outputs[-1].GetCellData()
            return numpy.column_stack([vtk_to_numpy(cells.GetArray(kind + "Distortion"))
                                       for kind in ("Angle", "Area")])
        attributes = (data for output in self.outputs for data in (
            output.GetPointData(), output.GetCellData(), output.GetFieldData()))
        found = next(a for a in attributes if a.HasArray(name))
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


def _set(algorithm, name, key, value):
    """Sets a property. Raises Error for one that does not exist, and for a value of another type."""
    if not hasattr(algorithm, "Set" + key):
        raise Error(f"{name} has no property {key}")
    try:
        getattr(algorithm, "Set" + key)(value)
    except (TypeError, OverflowError) as error:
        raise Error(f"{key} = {value!r}: {error}") from None


def solve(name, points, cells, arrays, properties, sources=(), observed=()):
    """Returns the arrays that the filter gives, by their names.

    arrays: the values by name; they may be None. sources: ids of points. observed: the values of
    Gaussian Field at these points.
    """
    algorithm = getattr(vtkGridFEMFilters, "vtk" + name)()
    messages = []
    observe = _Collector(messages)
    algorithm.AddObserver("ErrorEvent", observe)
    algorithm.AddObserver("WarningEvent", observe)
    data = surface(points, cells)
    for array, values in arrays.items():
        if values is None:
            continue
        values, on_points = placed(array, values, points, cells)
        column = numpy_to_vtk(values, deep=True)
        column.SetName(array)
        (data.GetPointData() if on_points else data.GetCellData()).AddArray(column)
        index = _INDICES.get(name, _OTHER_INDICES)[array]
        algorithm.SetInputArrayToProcess(index, 0, 0, _POINTS if on_points else _CELLS, array)
    if name == "LaplaceSpectrum":
        algorithm.AllModesOn()
    for key, value in properties.items():
        _set(algorithm, name, key, value)
    if name == "GaussianField":
        for point, value in zip(sources, observed):
            algorithm.AddObservation(int(point), float(value))
    else:
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
    if algorithm.GetOutput().GetNumberOfPoints() == 0:
        raise Error("there is no result: the input has no points, or the run was aborted")
    return _Results([algorithm.GetOutputDataObject(port)
                     for port in range(algorithm.GetNumberOfOutputPorts())])
