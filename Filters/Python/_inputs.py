"""Converts meshes of other libraries, and checks arrays."""

import numpy


class Error(ValueError):
    """An unusable input. The message gives the reason."""


def numbers(name, values):
    """Returns an array of numbers, without the types that VTK or Core do not know. Masked values become
    NaN."""
    try:
        array = numpy.ma.asanyarray(values) if numpy.ma.isMaskedArray(values) else numpy.asarray(values)
        if array.dtype.kind == "O":
            array = array.astype(float)
        if numpy.ma.is_masked(array):
            array = array.astype(float).filled(numpy.nan)
    except (TypeError, ValueError):
        raise Error(f"{name} must be an array of numbers") from None
    if array.dtype.kind not in "biuf":
        raise Error(f"{name} must be real numbers; they are of the type {array.dtype}")
    if array.dtype.kind == "f" and array.dtype.itemsize not in (4, 8):
        array = array.astype(numpy.float32 if array.dtype.itemsize < 4 else float)
    return array.astype(array.dtype.newbyteorder("="), order="C", copy=False)


def whole(name, values):
    """Returns whole numbers as 64-bit integers. A mask is refused."""
    array = numbers(name, values)
    if array.dtype.kind == "b":
        raise Error(f"{name} must be whole numbers, not true and false; numpy.flatnonzero gives the "
                    "ids where a mask is true")
    most = numpy.iinfo(numpy.int64).max
    if array.size and not (numpy.abs(array.astype(float)) < most).all():
        raise Error(f"{name} must be whole numbers; there is one that is not finite, or too large")
    if array.dtype.kind == "f" and (array != numpy.floor(array)).any():
        raise Error(f"{name} must be whole numbers; there is {array[array != numpy.floor(array)][0]}")
    return array.astype(numpy.int64)


def ids(name, values):
    """Returns ids of points as a one-dimensional array. A single id is accepted."""
    array = numpy.atleast_1d(whole(name, values))
    if array.ndim != 1:
        raise Error(f"{name} must be ids in a row; their shape is {array.shape}")
    return array


def nearest_point(name, position, points, cells):
    """Returns the id of the point nearest to a place, among the points that a cell uses."""
    points, cells = checked(points, cells)
    place = numbers(name, position).astype(float)
    if place.shape != (3,) or not numpy.isfinite(place).all():
        raise Error(f"{name} must be three finite numbers")
    used = numpy.unique(cells)
    if used.size == 0:
        raise Error("there are no cells")
    return used[numpy.argmin(((points[used] - place) ** 2).sum(axis=1))]


def checked(points, cells):
    """Returns points and cells as arrays of the right type and shape."""
    points = numbers("points", points).astype(float, copy=False)
    cells = whole("cells", cells)
    if points.ndim != 2 or points.shape[1] != 3:
        raise Error(f"points must have three columns; their shape is {points.shape}")
    if cells.ndim != 2 or cells.shape[1] < 3:
        raise Error(f"cells must have three or more columns; their shape is {cells.shape}")
    if cells.size and not (0 <= cells.min() and cells.max() < len(points)):
        raise Error(f"cells must be ids of the {len(points)} points, from 0")
    return points, cells


# Arrays whose rows are points, and arrays with one column.
_AT_POINTS = {"held", "flux"}
_OF_ONE_COLUMN = {"gradient_scale", "held", "labels", "scales", "weights"}
# In these filters the values are at points.
_WITH_VALUES_AT_POINTS = ("GaussianField", "HarmonicInterpolation", "SpectralSignatures", "SurfaceDetail")


def placed(filter_name, array, values, points, cells, on=None):
    """Returns values as an array, and the places of its rows: "points", "cells", or "either" if there are
    as many points as cells.

    on: where the caller says that they are.
    """
    if values is None:
        raise Error(f"{array} must have a number for each point or cell; it is None")
    values = numbers(array, values)
    if values.dtype == bool:
        values = values.astype(numpy.uint8)
    if values.ndim not in (1, 2) or values.size == 0:
        raise Error(f"{array} must have a number, or a row of them, for each point or cell; their shape "
                    f"is {values.shape}")
    if array in _OF_ONE_COLUMN and values.ndim == 2 and values.shape[1] != 1:
        raise Error(f"{array} must have one column; its shape is {values.shape}")
    counts = {"points": len(points), "cells": len(cells)}
    if on is not None and on not in counts:
        raise Error(f'on = {on!r}: must be "points" or "cells"')
    if array in _AT_POINTS or (array == "values" and filter_name in _WITH_VALUES_AT_POINTS):
        on = "points"
    places = [place for place, count in counts.items() if len(values) == count and on in (None, place)]
    if not places:
        wanted = f"{len(points)} points and {len(cells)} cells" if on is None else f"{counts[on]} {on}"
        raise Error(f"{array} has {len(values)} rows; there are {wanted}")
    return values, places[0] if len(places) == 1 else "either"


# The values of choices by name, in the order of their numbers.
CHOICES = {
    "Amount": ("DiffusionTime", "FWHM", "Sigma"),
    "Device": ("Automatic", "CPU", "GPU"),
    "FilterType": ("None", "LowPass", "HighPass", "BandPass", "Surrogates"),
    "FunctionSpace": ("Grid", "HatFunctions", "SmoothGrid"),
    "MapType": ("Conformal", "Isometric", "Circle"),
    "PathType": ("ToNearestSource", "InOrder", "Closed", "AllPairs"),
    "Model": ("TuringSpots", "GrayScott", "FitzHughNagumo", "AllenCahn", "Wave", "Transport",
              "Custom"),
    "ParameterUnits": ("World", "UnitArea", "UnitCube"),
    "Rescale": ("Automatic", "None", "ConstantArea", "ConstantVolume"),
    "Smoothness": ("Harmonic", "Biharmonic"),
    "TransferFunction": ("Isotropic", "LargeNegative", "LargePositive", "LargeAbsolute", "Custom")}


# Properties of filters that are numbers, although another filter has a choice of the name.
NUMBERS = {("GaussianField", "Smoothness")}


def chosen(filter_name, properties):
    """Returns properties of a filter with numbers in place of the names of choices."""
    numbered = dict(properties)
    for name, value in properties.items():
        if isinstance(value, str) and name in CHOICES and (filter_name, name) not in NUMBERS:
            if value not in CHOICES[name]:
                raise Error(f"{name} = {value!r}: must be one of {', '.join(CHOICES[name])}")
            numbered[name] = CHOICES[name].index(value)
    return numbered


def number(name, value):
    """Returns the value of a property as a float."""
    try:
        return float(value)
    except (TypeError, ValueError):
        raise Error(f"{name} = {value!r}: must be a number") from None


def colors_like(colors, given):
    """Returns an array with the type and in the range of the given array."""
    if numpy.issubdtype(given.dtype, numpy.integer):
        limits = numpy.iinfo(given.dtype)
        colors = numpy.round(numpy.clip(colors, limits.min, limits.max))
    else:
        known = given[~numpy.isnan(given)]
        if known.size and 0 <= known.min() and known.max() <= 1:
            colors = numpy.clip(colors, 0, 1)
    return colors.astype(given.dtype)


def result_like(result, given, on_points):
    """Returns a solution in the type of the values: bytes for colors, float32, or float64.

    Colors are clamped and rounded. Points without a solution keep their given color, or become black.
    """
    if given.dtype == numpy.uint8 and given.ndim == 2 and given.shape[1] in (3, 4):
        unsolved = numpy.isnan(result)
        if unsolved.any():
            result = numpy.where(unsolved, given if on_points else 0, result)
        return colors_like(result, given)
    return result.astype(numpy.float32) if given.dtype == numpy.float32 else result


def _from_counted(faces):
    """Returns rows of ids from a list in which the number of corners stands before the ids of each
    face."""
    faces = numpy.asarray(faces).ravel()
    polygons = []
    place = 0
    while place < len(faces):
        polygons.append(faces[place + 1:place + 1 + faces[place]])
        place += 1 + faces[place]
    return polygons


def _rows(points, polygons, triangulate):
    """Returns one array of the polygons. Polygons of different sizes become triangles."""
    polygons = [numpy.asarray(polygon, dtype=numpy.int64) for polygon in polygons]
    if len({len(polygon) for polygon in polygons}) > 1:
        polygons = [triangle for polygon in polygons if len(polygon) > 2
                    for triangle in polygon[triangulate(_in_space(points)[polygon])]]
    return numpy.array(polygons, dtype=numpy.int64)


def _in_space(points):
    """Returns points with three coordinates. Points with two coordinates, as in meshio, get z = 0."""
    points = numpy.asarray(points, dtype=float)
    if points.ndim == 2 and points.shape[1] == 2:
        points = numpy.column_stack([points, numpy.zeros(len(points))])
    return points


def _of_vtk(data):
    """Returns points and polygons of a data set of VTK: of its surface, with strips as triangles."""
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkCommonDataModel import vtkPolyData
    from vtkmodules.vtkFiltersCore import vtkTriangleFilter
    from vtkmodules.vtkFiltersGeometry import vtkDataSetSurfaceFilter
    if not isinstance(data, vtkPolyData):
        surface = vtkDataSetSurfaceFilter()
        surface.SetInputData(data)
        surface.Update()
        data = surface.GetOutput()
    if data.GetNumberOfStrips() or len(numpy.unique(numpy.diff(
            vtk_to_numpy(data.GetPolys().GetOffsetsArray())))) > 1:
        triangles = vtkTriangleFilter()
        triangles.SetInputData(data)
        triangles.PassVertsOff()
        triangles.PassLinesOff()
        triangles.Update()
        data = triangles.GetOutput()
    if not data.GetNumberOfPolys():
        raise Error("The mesh has no polygons.")
    ids = vtk_to_numpy(data.GetPolys().GetConnectivityArray())
    return (vtk_to_numpy(data.GetPoints().GetData()),
            ids.reshape(data.GetNumberOfPolys(), -1))


def mesh_arrays(mesh, triangulate):
    """Returns the points and cells of a mesh.

    triangulate: returns the triangles of one polygon as rows of its corners, from their coordinates.
    """
    if hasattr(mesh, "IsA") and mesh.IsA("vtkDataSet"):  # also PyVista's
        points, cells = _of_vtk(mesh)
    elif hasattr(mesh, "vertices") and hasattr(mesh, "faces"):  # trimesh.Trimesh
        points, cells = mesh.vertices, mesh.faces
    elif hasattr(mesh, "points") and hasattr(mesh, "faces"):  # in the form of pyvista.PolyData
        points = mesh.points
        cells = _rows(points, _from_counted(mesh.faces), triangulate)
    elif hasattr(mesh, "points") and all(hasattr(block, "type") for block in getattr(mesh, "cells", [0])):
        points = mesh.points  # meshio.Mesh
        cells = _rows(points, [polygon for block in mesh.cells
                               if block.type in ("triangle", "quad", "polygon")
                               for polygon in block.data], triangulate)
    else:
        raise Error(f"{type(mesh).__name__} is no mesh with points and faces, vertices and faces, or "
                    "points and blocks of cells. PyVista's extract_surface() makes one of a volume mesh.")
    points = _in_space(points)
    cells = numpy.asarray(cells, dtype=numpy.int64)
    if cells.size == 0:
        raise Error("The mesh has no polygons.")
    return points, cells
