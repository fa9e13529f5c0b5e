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


def placed(name, values, points, cells):
    """Returns values as an array, and whether they belong to the points. Otherwise they belong to the
    cells."""
    values = numbers(name, values)
    if values.dtype == bool:
        values = values.astype(numpy.uint8)
    if values.ndim not in (1, 2) or values.size == 0:
        raise Error(f"{name} must have a number, or a row of them, for each point or cell; their shape "
                    f"is {values.shape}")
    if len(values) not in (len(points), len(cells)):
        raise Error(f"{name} has {len(values)} rows; there are {len(points)} points and "
                    f"{len(cells)} cells")
    return values, len(values) == len(points)


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


def _rows(polygons):
    """Returns one array of the polygons. Polygons of different sizes become triangles, as fans."""
    polygons = [numpy.asarray(polygon) for polygon in polygons]
    if len({len(polygon) for polygon in polygons}) > 1:
        polygons = [polygon[[0, k, k + 1]] for polygon in polygons
                    for k in range(1, len(polygon) - 1)]
    return numpy.array(polygons, dtype=numpy.int64)


def arrays(mesh):
    """Returns the points and cells of a mesh of PyVista, trimesh or meshio, or of a vtkPolyData.

    Polygons of different numbers of corners become triangles.
    """
    if hasattr(mesh, "vertices") and hasattr(mesh, "faces"):  # trimesh.Trimesh
        points, cells = mesh.vertices, mesh.faces
    elif hasattr(mesh, "points") and hasattr(mesh, "faces"):  # pyvista.PolyData
        points, cells = mesh.points, _rows(_from_counted(mesh.faces))
    elif hasattr(mesh, "points") and hasattr(mesh, "cells"):  # meshio.Mesh
        points = mesh.points
        cells = _rows([polygon for block in mesh.cells
                       if block.type in ("triangle", "quad", "polygon") for polygon in block.data])
    elif hasattr(mesh, "GetPolys"):  # vtkPolyData
        from vtkmodules.util.numpy_support import vtk_to_numpy
        points = vtk_to_numpy(mesh.GetPoints().GetData())
        offsets = vtk_to_numpy(mesh.GetPolys().GetOffsetsArray())
        ids = vtk_to_numpy(mesh.GetPolys().GetConnectivityArray())
        cells = _rows(numpy.split(ids, offsets[1:-1]))
    else:
        raise Error(f"{type(mesh).__name__} is not a mesh with points and faces, vertices and faces, "
                    "or points and cells")
    points = numpy.asarray(points, dtype=float)
    if points.ndim == 2 and points.shape[1] == 2:  # meshio's form in the plane
        points = numpy.column_stack([points, numpy.zeros(len(points))])
    cells = numpy.asarray(cells, dtype=numpy.int64)
    if cells.size == 0:
        raise Error("The mesh has no polygons.")
    return points, cells
