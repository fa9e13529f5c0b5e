"""Solves equations on the surface of a mesh, with numpy arrays in and out.

    import gridfem
    eigenvalues, modes = gridfem.spectrum(points, cells, 50)

`points` is an array of N rows with three coordinates. `cells` is an array of M rows with the point ids
of a polygon each: triangles, or any other number of corners. `gridfem.arrays(mesh)` gives both for a
mesh of PyVista, trimesh or meshio. Values with N rows belong to points, values with M rows to cells.
Keyword arguments in capitals, such as `Depth=8` or `FunctionSpace=1`, are properties of the filter that
does the work. The pages in Plugin/Documentation describe them.

The package comes in two forms with the same functions and results. The form beside ParaView's plugin
runs the filters. On several MPI ranks each rank computes alone, on its own arrays. The filters
themselves, for pipelines of VTK, are in gridfem.vtkGridFEMFilters. They work on the pieces of all ranks
together. The form that pip installs has the numerics compiled in, and needs only numpy. It takes the
properties that change the result of a function.
"""

import numpy

from . import _inputs
from ._inputs import Error, arrays

try:
    from ._without_vtk import solve as _solve
except ImportError:
    from ._with_vtk import solve as _solve, surface

__all__ = ["Error", "arrays", "curvatures", "decompose", "detail", "diffuse", "distance",
           "divergence", "farthest_points", "flow", "gradient", "interpolate", "poisson", "signatures",
           "signed_distance", "spectrum", "stitch"]


def spectrum(points, cells, number=20, **properties):
    """Computes the smallest eigenvalues of the Laplace operator, and the eigenfunctions.

    Returns the eigenvalues (K), in one over squared length, and their functions at the points (N, K).
    The mean square of a function is one over the area. K is `number`, or less on a surface with fewer
    functions.
    """
    results = _solve("LaplaceSpectrum", points, cells, {}, {"NumberOfModes": number, **properties})
    return results["Eigenvalues"], results["Modes"]


def signatures(points, cells, number=100, **properties):
    """Computes the heat kernel and the wave kernel signature of every point, from `number` modes.

    Both have a column for each of NumberOfScales times or frequencies, from small features to the whole
    shape.
    """
    results = _solve("SpectralSignatures", points, cells, {}, {"NumberOfModes": number, **properties})
    return results["HeatKernelSignature"], results["WaveKernelSignature"]


def poisson(points, cells, values=None, gradients=None, weights=None, held=None, gradient_scale=None,
            flux=None, **properties):
    """Computes a function that is close to given values, with gradients close to given gradients.

    values: N or M rows; None takes the coordinates. gradients: a vector for each column of the
    values; None takes zero, which smooths. weights: weights of the values. held: true at points
    where the values stay. gradient_scale: a factor on the gradients. flux: the slope of the
    solution out of the surface, at the points of its boundary. ScreeningWeight determines how much
    values count. UseValueGradient and GradientScale sharpen. FillUnknown fills in NaN.
    """
    given = {"values": values, "gradients": gradients, "weights": weights, "held": held,
             "gradient_scale": gradient_scale, "flux": flux}
    return _solve("ScreenedPoisson", points, cells, given, properties)["Solution"]


def distance(points, cells, sources, nearest=False, **properties):
    """Computes the distance along the surface from the nearest of the points with the ids `sources`.

    nearest: also returns the id of the nearest source. It is -1 at points that no source reaches.
    """
    sources = _inputs.ids("sources", sources)
    if sources.size == 0:
        raise Error("there are no sources")
    results = _solve("GeodesicDistance", points, cells, {},
                     {"NearestSource": bool(nearest), **properties}, sources)
    if nearest:
        return results["Distance"], results["NearestSource"].astype(numpy.int64)
    return results["Distance"]


def signed_distance(points, cells, labels, inside=1, **properties):
    """Computes the distance along the surface from the border of a label, negative inside.

    labels: integers on points or cells. inside: the label of the inside.
    """
    return _solve("GeodesicDistance", points, cells, {"labels": labels},
                  {"Signed": True, "InsideLabel": int(_inputs.whole("inside", inside)), **properties})["Distance"]


def farthest_points(points, cells, number, **properties):
    """Finds points spread evenly over the surface, each as far as possible from those before it.

    Returns three arrays. The first has the ids of the found points in the order in which they were
    found. The others have, for each point of the mesh, the id of the nearest found point and the
    distance from it. FirstPointId is the first found point.
    """
    results = _solve("FarthestPoints", points, cells, {}, {"NumberOfPoints": number, **properties})
    ids, nearest = (results[name].astype(numpy.int64) for name in ("FarthestPoints", "NearestPoint"))
    return ids, nearest, results["Distance"]


def diffuse(points, cells, values, time, held=None, source=None, **properties):
    """Computes values after heat has spread for a time, a squared length in ParameterUnits, in 8 steps.

    held: where it is true at the points, the values stay. With BoundaryValues they also stay along the
    boundary. source: added per unit of time.
    """
    return _solve("HeatDiffusion", points, cells, {"values": values, "held": held, "source": source},
                  {"DiffusionTime": time, "NumberOfSteps": 8, **properties})["Diffused"]


def interpolate(points, cells, ids, values, **properties):
    """Computes the smoothest function with the given values at the points with the given ids."""
    ids = _inputs.ids("ids", ids)
    values = numpy.atleast_1d(_inputs.numbers("values", values).astype(float))
    if len(ids) != len(values):
        raise Error(f"there are {len(ids)} ids and {len(values)} values")
    points, cells = _inputs.checked(points, cells)
    if ids.size and not (0 <= ids.min() and ids.max() < len(points)):
        raise Error(f"ids must be ids of the {len(points)} points, from 0")
    known = numpy.full((len(points), *values.shape[1:]), numpy.nan)
    known[ids] = 0.0
    numpy.add.at(known, ids, values)
    known.T[..., ids] /= numpy.bincount(ids)[ids]  # the mean of several values at one point
    return _solve(
        "HarmonicInterpolation", points, cells, {"values": known}, properties)["Interpolated"]


def stitch(points, cells, colors, labels, **properties):
    """Computes colors of several scans without the jumps between them. `labels` numbers the scans."""
    return _solve("StitchColors", points, cells, {"colors": colors, "labels": labels},
                  properties)["StitchedColors"]


def curvatures(points, cells, **properties):
    """Computes minimum and maximum curvature at the points, in one over length, and their directions.

    Returns arrays of the shapes (N), (N), (N, 3), (N, 3). Convex is positive.
    """
    results = _solve("PrincipalCurvatures", points, cells, {}, properties)
    return tuple(results[name] for name in (
        "MinimumCurvature", "MaximumCurvature", "MinimumCurvatureDirection",
        "MaximumCurvatureDirection"))


def gradient(points, cells, values=None, **properties):
    """Computes the gradient along the surface and the Laplacian of values, both at the points.

    values: N or M rows; None takes the coordinates. Returns arrays of the shapes (N, 3 C) and (N, C)
    for C columns of values. The gradient of the first column comes first.
    """
    results = _solve("SurfaceGradient", points, cells, {"values": values}, properties)
    return results["Gradient"], results["Laplacian"]


def divergence(points, cells, vectors, **properties):
    """Computes the divergence of vectors along the surface and their curl about its normal, at points.

    vectors: N or M rows of three numbers.
    """
    if numpy.shape(vectors)[1:] != (3,):
        raise Error(f"vectors must have three columns; their shape is {numpy.shape(vectors)}")
    results = _solve("SurfaceGradient", points, cells, {"values": vectors}, properties)
    return results["Divergence"], results["Curl"]


def decompose(points, cells, vectors, **properties):
    """Splits vectors along the surface into three parts, at the points (N, 3).

    The first part flows out of sources, the second turns in eddies, and the third runs around handles
    and holes. vectors: N or M rows of three numbers.
    """
    results = _solve("SurfaceGradient", points, cells, {"values": vectors},
                     {"HodgeDecomposition": True, **properties})
    return results["GradientPart"], results["RotationPart"], results["HarmonicPart"]


def detail(points, cells, scale=2.0, values=None, scales=None, **properties):
    """Computes the points of the surface with its details enlarged (scale above 1) or removed (scale 0).

    values: numbers at the points. With values, the function returns them with scaled details
    instead of the points. scales: factors on the scale, at points or cells.
    """
    results = _solve("SurfaceDetail", points, cells, {"values": values, "scales": scales},
                     {"DetailScale": scale, **properties})
    return results["Points" if values is None else "Filtered"]


def flow(points, cells, steps=10, **properties):
    """Moves the points of the surface by steps of mean-curvature flow, each of length TimeStep."""
    return _solve(
        "MeanCurvatureFlow", points, cells, {}, {"NumberOfSteps": steps, **properties})["Points"]
