"""Calls the numerics, which are compiled into the module _core. VTK is not needed."""

import importlib

import numpy

from ._formulas import rates
from ._inputs import Error, colors_like, number, result_like


def _levels():
    """Returns the x86-64 levels of this processor, the best first."""
    try:
        from numpy._core._multiarray_umath import __cpu_features__ as features
    except ImportError:
        from numpy.core._multiarray_umath import __cpu_features__ as features
    if features.get("X86_V4") or features.get("AVX512_SKX"):
        yield "v4"
    if features.get("X86_V3") or (features.get("AVX2") and features.get("FMA3")):
        yield "v3"
    yield "v2"


def _load():
    """Returns the module for this machine, or the best of the modules for kinds of processors."""
    for folder in ("", *(level + "." for level in _levels())):
        try:
            return importlib.import_module(f".{folder}_core", __package__)
        except ModuleNotFoundError:
            pass
    raise ImportError("This package has no module _core for this processor.")


_core = _load()


def _matrix(values):
    return numpy.asarray(values, dtype=float).reshape(len(values), -1)


def _out_of_memory(name, properties):
    """Returns a message with advice that fits the filter."""
    if name in ("GeodesicPaths", "Parameterization"):  # have no grid
        return "Out of memory: use a mesh with fewer polygons."
    depth = properties.get("Depth", _core.properties(name)["Depth"][0])
    if depth == 0:
        return "Out of memory: choose a small Depth instead of 0."
    return f"Out of memory at Depth {depth:g}: choose a smaller Depth."


def triangulate(corners):
    """Returns the triangles of a polygon, which may be concave, as rows of its corners."""
    return _core.triangulate(corners)


def solve(name, points, cells, arrays, properties, sources=(), observed=(), reactions=(),
          reference=None, partners=()):
    """Returns the arrays that the filter of this name would give, by their names, and warnings.

    arrays: values and whether they are at points, by name. sources: ids of points. observed: the
    values of Gaussian Field at these points. reactions: the formulas of Surface Dynamics.
    reference: points and cells of the reference of Functional Map. partners: its points for the sources.
    """
    for key in properties.keys() - _core.properties(name).keys():
        raise Error(f"{name} has no property {key}")
    numbers = {key: number(key, value) for key, value in properties.items()}
    try:
        results, messages = _core.solve(
            name, points, cells,
            {array: (_matrix(values), on_points) for array, (values, on_points) in arrays.items()},
            numbers,
            [int(source) for source in sources],
            [float(value) for value in observed],
            rates(reactions) if reactions else None, len(reactions),
            reference, [int(partner) for partner in partners])
    except MemoryError:
        raise Error(_out_of_memory(name, properties)) from None
    except ValueError as error:
        raise Error(str(error)) from None
    results = {array: values[:, 0] if values.shape[1] == 1 and array not in ("Modes", "Samples", "Surrogates") else values
               for array, values in results.items()}
    for array in {"Solution", "Diffused", "Interpolated", "Filtered"} & results.keys():
        if "values" in arrays:
            results[array] = result_like(results[array], *arrays["values"])
    if "Surrogates" in results and arrays["values"][0].dtype == numpy.float32:
        results["Surrogates"] = results["Surrogates"].astype(numpy.float32)
    if "StitchedColors" in results:
        results["StitchedColors"] = colors_like(results["StitchedColors"], arrays["colors"][0])
    return results, messages
