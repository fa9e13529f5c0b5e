"""Solves equations on the surface of a mesh, with numpy arrays in and out.

    import gridfem
    eigenvalues, modes = gridfem.spectrum(points, cells, 50)

`points` is an array of N rows with three coordinates. `cells` is an array of M rows. Each row has the
point ids of a polygon: a triangle, or any other number of corners. `gridfem.arrays(mesh)` returns both
arrays for a mesh of PyVista, trimesh or meshio. Values with N rows belong to points, values with M rows
to cells. Keyword arguments in CamelCase, such as `Depth=8` or `FunctionSpace="HatFunctions"`, are
properties of the filter that does the work. The pages in Plugin/Documentation describe them. A choice is
a name or its number. A name has no spaces and hyphens. A value out of range raises Error.

A mesh can have as many cells as points, such as a torus of quads. Values with this number of rows then
count as values at points, and the function warns. Pass `on="cells"` for values on cells. Pass
`on="points"` for values at points without a warning.

To compute on a part of a mesh, pass only its cells, such as `cells[labels == 1]`. The rest counts as cut
away. Results are NaN at points that no cell uses.

The package comes in two forms with the same functions, properties and results. The form beside
ParaView's plugin runs the filters. On several MPI ranks each rank computes alone, on its own arrays. The
filters themselves, for pipelines of VTK, are in gridfem.vtkGridFEMFilters. They work on the pieces of all
ranks together. The form that pip installs has the numerics compiled in, and needs only numpy. Python takes
whichever of the two comes first on its path. Install only one, or put the folder of the form beside the
plugin first in PYTHONPATH.
"""

import warnings

import numpy

from . import _inputs
from ._inputs import Error
from ._messages import in_words_of_functions

try:
    from ._without_vtk import solve as _solve_numbered, triangulate as _triangulate
except ImportError:
    from ._with_vtk import solve as _solve_numbered, surface, triangulate as _triangulate

__all__ = ["Error", "arrays", "curvatures", "decompose", "detail", "diffuse", "distance",
           "distance_matrix", "divergence", "dynamics", "expand", "farthest_points", "flow",
           "functional_map", "gaussian_field", "gradient", "interpolate", "krige", "parameterize", "path", "poisson",
           "signatures", "signed_distance", "spectrum", "stitch", "surrogates"]


def arrays(mesh):
    """Returns the points and cells of a mesh of PyVista, trimesh or meshio, or of any data set of VTK.

    Polygons of different numbers of corners, and strips, become triangles. A volume mesh of PyVista or
    VTK gives its surface.
    """
    return _inputs.mesh_arrays(mesh, _triangulate)


class _Results:
    """The arrays of a result by their names. An array that is missing raises Error with the warnings."""

    def __init__(self, arrays, messages):
        self.arrays = arrays
        self.messages = messages

    def __getitem__(self, name):
        try:
            return self.arrays[name]
        except KeyError:
            raise Error(" ".join([f"The result has no {name}.", *self.messages])) from None


def _solve(name, points, cells, given, properties, sources=(), on=None, observed=(), reactions=(),
           reference=None, partners=()):
    points, cells = _inputs.checked(points, cells)
    properties = _inputs.chosen(name, properties)
    arrays = {}
    for array, values in given.items():
        if values is None and array not in ("colors", "labels") and name != "SpectralSignatures":
            continue
        values, place = _inputs.placed(name, array, values, points, cells, on)
        if place == "either":
            warnings.warn(f"{array} has {len(values)} rows, and there are as many points as cells. They count "
                          'as values at points. Pass on="cells" for values on cells, or on="points" for no '
                          "warning.", RuntimeWarning, stacklevel=3)
        arrays[array] = values, place != "cells"
    try:
        results, messages = _solve_numbered(name, points, cells, arrays, properties, sources, observed, reactions,
                                           reference, partners)
    except Error as error:
        raise Error(in_words_of_functions(name, str(error), arrays)) from None
    messages = [in_words_of_functions(name, message, arrays) for message in messages]
    for message in messages:
        warnings.warn(message, RuntimeWarning, stacklevel=3)
    return _Results(results, messages)


def _vectors(vectors):
    if numpy.shape(vectors)[1:] != (3,):
        raise Error(f"vectors must have three columns; their shape is {numpy.shape(vectors)}")
    return vectors


def _pairs(points, ids, values):
    """Returns ids of points and values at them as arrays with equally many rows."""
    ids = _inputs.ids("ids", ids)
    values = numpy.atleast_1d(_inputs.numbers("values", values).astype(float))
    if len(ids) != len(values):
        raise Error(f"there are {len(ids)} ids and {len(values)} values")
    if ids.size and not (0 <= ids.min() and ids.max() < len(points)):
        raise Error(f"ids must be ids of the {len(points)} points, from 0")
    return ids, values


def _known(points, ids, values):
    """Returns the values at all points, NaN where they are unknown. Several values at one point give
    their mean."""
    ids, values = _pairs(points, ids, values)
    if ids.size == 0:
        raise Error("there are no ids")
    known = numpy.full((len(points), *values.shape[1:]), numpy.nan)
    known[ids] = 0.0
    numpy.add.at(known, ids, values)
    known.T[..., ids] /= numpy.bincount(ids)[ids]
    return known


def _random_field(points, cells, properties, ids, values):
    """Solves with an observation for each pair of an id and a value. NaN is no observation."""
    ids, values = _pairs(points, ids, values)
    if values.shape != ids.shape:
        raise Error(f"values must be numbers in a row; their shape is {values.shape}")
    is_known = ~numpy.isnan(values)
    if ids.size and not is_known.any():
        raise Error("no value is known: all are NaN")
    return _solve("GaussianField", points, cells, {}, properties, ids[is_known],
                  observed=values[is_known])


def spectrum(points, cells, number=20, **properties):
    """Computes the smallest eigenvalues of the Laplace operator, and the eigenfunctions.

    Returns the eigenvalues (K), in one over squared length, and their functions at the points (N, K).
    The mean square of a function is one over the area. K is `number`, or less on a surface with fewer
    functions. With ZeroBoundaryValues the functions are 0 on the boundary.
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


def expand(points, cells, values, number=100, **properties):
    """Expands values at the points in the eigenfunctions of the Laplace operator.

    Returns the eigenvalues (K), the coefficients (K, or K rows for values with columns), and the errors
    that remain after each mode, as fractions of the error after the constants. K is `number`, or more to
    complete a group of equal eigenvalues. See `spectrum` for the unit of the eigenvalues and the size of
    the eigenfunctions.
    """
    results = _solve("SpectralSignatures", points, cells, {"values": values},
                     {"NumberOfModes": number, "FilterType": "LowPass", "LastMode": 0, **properties})
    return results["Eigenvalue"], results["Coefficient"], results["RemainingError"]


def surrogates(points, cells, values, count=10, number=100, **properties):
    """Makes random maps that are as smooth as the given values at the points.

    Returns an array (count, N), or (count, N, C) for values with C columns. The first `number` modes are
    taken in groups of 3, 5, 7 and so on. In each group the maps have the energy of the values, and the same
    products between the columns. The part of the values that no mode describes is missing. `expand` tells
    its size. Another Seed gives other maps.
    """
    results = _solve("SpectralSignatures", points, cells, {"values": values},
                     {"NumberOfModes": number, "FilterType": "Surrogates", "NumberOfSurrogates": count,
                      **properties})
    maps = results["Surrogates"].reshape(len(points), -1, *numpy.shape(values)[1:])
    return numpy.moveaxis(maps, 1, 0)


def poisson(points, cells, values=None, gradients=None, weights=None, held=None, gradient_scale=None,
            flux=None, on=None, **properties):
    """Computes a function that is close to given values, with gradients close to given gradients.

    values: N or M rows. None takes the coordinates.
    gradients: a vector for each column of the values. None takes zero, which smooths.
    weights: weights of the values. Values of weight 0 may be NaN.
    held: true at points where the values stay. It has N rows.
    gradient_scale: a factor on the gradients.
    flux: the slope of the solution out of the surface, at the points of its boundary.
    ScreeningWeight determines how much values count. UseValueGradient and GradientScale sharpen.
    FillUnknown fills in NaN.
    on: "points" or "cells", where the arrays are if N = M.
    """
    given = {"values": values, "gradients": gradients, "weights": weights, "held": held,
             "gradient_scale": gradient_scale, "flux": flux}
    return _solve("ScreenedPoisson", points, cells, given, properties, on=on)["Solution"]


def distance(points, cells, sources=(), nearest=False, position=None, **properties):
    """Computes the distance along the surface from the nearest of the points with the ids `sources`.

    nearest: also returns the id of the nearest source. It is -1 at points that no source reaches.
    position: a place in space. The point of the mesh nearest to it is also a source.
    """
    sources = _inputs.ids("sources", sources)
    if position is not None:
        sources = numpy.append(sources, _inputs.nearest_point("position", position, points, cells))
    if sources.size == 0:
        raise Error("there are no sources")
    results = _solve("GeodesicDistance", points, cells, {},
                     {"NearestSource": bool(nearest), **properties}, sources)
    if nearest:
        return results["Distance"], results["NearestSource"].astype(numpy.int64)
    return results["Distance"]


def signed_distance(points, cells, labels, inside=1, on=None, **properties):
    """Computes the distance along the surface from the border of a label, negative inside.

    labels: integers on points or cells. inside: the label of the inside.
    """
    return _solve("GeodesicDistance", points, cells, {"labels": labels},
                  {"Signed": True, "InsideLabel": int(_inputs.whole("inside", inside)), **properties},
                  on=on)["Distance"]


def farthest_points(points, cells, number, **properties):
    """Finds points spread evenly over the surface, each as far as possible from the points before it.

    Returns three arrays. The first has the ids of the found points in the order in which they were
    found. The others have, for each point of the mesh, the id of the nearest found point and the
    distance from it: -1 and NaN on components without a found point. FirstPointId is the first found point.
    """
    results = _solve("FarthestPoints", points, cells, {}, {"NumberOfPoints": number, **properties})
    ids, nearest = (results[name].astype(numpy.int64) for name in ("FarthestPoints", "NearestPoint"))
    return ids, nearest, results["Distance"]


def distance_matrix(points, cells, ids, **properties):
    """Computes the distances along the surface between all points with the given ids, exactly on its triangles.

    Returns a symmetric array (K, K) for K ids. The distance between points of different connected
    components is NaN. A RuntimeWarning tells how many distances may be too large, because the search on a
    very large mesh gave up. `distance` is faster for distances to all points of the surface.
    """
    ids = _inputs.ids("ids", ids)
    if ids.size == 0:
        raise Error("there are no ids")
    found, number = numpy.unique(ids, return_inverse=True)
    matrix = numpy.full((found.size, found.size), numpy.nan)
    numpy.fill_diagonal(matrix, 0.0)
    results = _solve("GeodesicPaths", points, cells, {}, {"PathType": "AllPairs", **properties}, found)
    if found.size > 1:  # the path of a single point leads to the farthest
        ends = (numpy.searchsorted(found, results[name].astype(numpy.int64))
                for name in ("SourceId", "TargetId"))
        source, target = ends
        matrix[source, target] = matrix[target, source] = results["Length"]
    return matrix[number][:, number]


def path(points, cells, ids, closed=False, **properties):
    """Computes the shortest path along the surface through the points with the given ids, in their order.

    closed: the path returns from the last point to the first. Between two given points the path is the
    shortest, exactly on the triangles. If the search on a very large mesh gives up, a RuntimeWarning says so.
    Then no path nearby is shorter, but a path elsewhere may be. Returns arrays of the shapes (K, 3), (K, 3),
    (K, 3): places along the path, the corners of the triangle around each place, and their weights. The
    length is `numpy.linalg.norm(numpy.diff(places, axis=0), axis=1).sum()`. Values at the points of the mesh
    become `(weights * values[corners]).sum(axis=1)` along the path.
    """
    ids = _inputs.ids("ids", ids)
    if ids.size < 2:
        raise Error("a path leads through two points or more")
    results = _solve("GeodesicPaths", points, cells, {},
                     {"PathType": "Closed" if closed else "InOrder", **properties}, ids)
    if results["UnreachedTargets"].size:
        raise Error(f"no path leads to the point {int(results['UnreachedTargets'][0])}, which is on "
                    "another connected component")
    corners, weights = results["CornerIds"].astype(numpy.int64), results["CornerWeights"]
    places = (weights[:, :, None] * numpy.asarray(points, dtype=float)[corners]).sum(axis=1)
    return places, corners, weights


def parameterize(points, cells, **properties):
    """Flattens the surface: maps it to the plane.

    MapType is Conformal, Isometric or Circle. Returns four arrays. The first has the flat vertices (K, 2).
    The second has the triangles between them (T, 3). The third has the point of the mesh at each vertex;
    vertices on a cut share points. The last has the distortion of each triangle (T, 2): the angle in
    degrees, which is 180 if the triangle is flipped, and the binary logarithm of the area's change.
    """
    results = _solve("Parameterization", points, cells, {}, properties)
    triangles, origin = (results[name].astype(numpy.int64) for name in ("FlatTriangles", "SurfacePoint"))
    return results["FlatPoints"], triangles, origin, results["Distortion"]


def functional_map(points, cells, reference_points, reference_cells, landmarks=(), number=100, **properties):
    """Maps the surface to a reference of about the same shape, by `number` modes of both.

    landmarks: pairs of ids of corresponding points, (K, 2): on the surface and on the reference. Returns
    five arrays. The first has the corresponding place on the reference for each point (N, 3). The next two
    have the points of the reference around this place (N, 3) and their weights (N, 3). Values at the points
    of the reference become `(weights * values[corners]).sum(axis=1)` on the surface. The fourth has the
    mismatch of the modes (N,): 0 for surfaces that differ only by bending, about 1 for unrelated ones. The
    last is the matrix of the map between modes. Points that no cell uses have NaN, and -1 in the corners.
    A RuntimeWarning tells if the surfaces match in several ways, or not at all.
    """
    pairs = _inputs.ids("landmarks", numpy.asarray(landmarks, dtype=object).ravel() if len(landmarks) else ())
    if len(landmarks) and numpy.shape(landmarks)[1:] != (2,):
        raise Error(f"landmarks must have two columns; their shape is {numpy.shape(landmarks)}")
    reference = _inputs.checked(reference_points, reference_cells)
    results = _solve("FunctionalMap", points, cells, {}, {"NumberOfModes": number, **properties}, pairs[::2],
                     reference=reference, partners=pairs[1::2])
    corners = results["ReferenceCorners"].astype(numpy.int64)
    return (results["ReferencePlace"], corners, results["ReferenceWeights"], results["Mismatch"],
            results["FunctionalMap"])


def diffuse(points, cells, values, time=None, held=None, source=None, fwhm=None, sigma=None, on=None,
            **properties):
    """Computes values after heat has spread, in 8 steps: smooths them by a Gaussian along the surface.

    Give one of three amounts. time: a squared length in ParameterUnits. fwhm: the full width of the
    Gaussian at half of its maximum. sigma: its standard deviation. The widths are in the unit of the
    points. Each column of values, such as a frame of a series, is smoothed by itself. held: true at
    points where the values stay. With BoundaryValues they also stay along the boundary. source: added per
    unit of time.
    """
    amounts = {"DiffusionTime": time, "FWHM": fwhm, "Sigma": sigma}
    given = [number for number, amount in enumerate(amounts.values()) if amount is not None]
    if len(given) != 1:
        raise Error("give one of time, fwhm and sigma")
    amount = {"Amount": given[0], **{key: value for key, value in amounts.items() if value is not None}}
    return _solve("HeatDiffusion", points, cells, {"values": values, "held": held, "source": source},
                  {**amount, "NumberOfSteps": 8, **properties}, on=on)["Diffused"]


def dynamics(points, cells, model, length=0.1, steps=20, start=None, velocity=None, reactions=None,
             **properties):
    """Computes patterns, waves or transport on the surface, and returns the last of `steps` time steps.

    model: "TuringSpots", "GrayScott", "FitzHughNagumo", "AllenCahn", "Wave", "Transport" or "Custom". length:
    the PatternLength in ParameterUnits. start: one or two columns at time 0. None takes noise, or a bump for
    Wave and Transport. velocity: three columns, for Transport. TimeStep is the time between two steps.
    reactions, for Custom: the rates as formulas, ("0.1 - u + u^2*v", "0.9 - u^2*v") of two species or
    "u*(1-u)" of one. Diffusivity and DiffusivityV spread them.
    Returns u and v (N, 2), or u (N,) where there is one unknown. The result can be the start of the next
    call.
    """
    formulas = (reactions,) if isinstance(reactions, str) else tuple(reactions or ())
    if len(formulas) == 2 and not str(formulas[1]).strip():
        formulas = formulas[:1]
    if (model in ("Custom", 6)) != (0 < len(formulas) < 3):
        raise Error("Custom takes one or two reactions, and the other models take none.")
    return _solve("SurfaceDynamics", points, cells, {"start": start, "velocity": velocity},
                  {"Model": model, "PatternLength": length, "NumberOfSteps": steps, **properties},
                  reactions=formulas)["State"]


def gaussian_field(points, cells, distance, number=1, ids=(), values=(), noise=0.0, **properties):
    """Samples random fields with mean 0 whose values at nearby points are alike (N, number).

    distance: the Range in ParameterUnits. Values farther apart hardly depend on each other. Smoothness
    chooses between rough and smooth samples. Another Seed gives other samples. With Statistics the result
    has two columns: mean and standard deviation of the samples. values: observed values at the points with
    these ids. Every sample then agrees with the observations, up to `noise`, and `krige` predicts from the
    observations. With Statistics the result then has the prediction and the standard deviation of its error.
    noise: the standard deviation of the errors of the observations. Several observations of one point count
    each.
    """
    return _random_field(points, cells, {"Range": distance, "NumberOfSamples": number,
                                         "ObservationNoise": noise, **properties}, ids, values)["Samples"]


def krige(points, cells, ids, values, distance, noise=0.0, number=100, **properties):
    """Predicts a field everywhere from observed values at the points with the given ids (kriging).

    distance: the Range in ParameterUnits. Values farther apart hardly depend on each other. noise: the
    standard deviation of the errors of the values. Several values of one point count each. Pass the
    StandardDeviation of the field (default 1). The returned standard deviation is proportional to
    StandardDeviation, and noise is weighed against it.

    Returns five results. The first two are the prediction (N) and the standard deviation of its error (N),
    estimated from `number` samples. The third has the leave-one-out errors (K): a value minus its
    prediction from all others, or the mean for several values of one point. The fourth is the logarithm of
    the likelihood of the values. Compare it for several distances: the distance with the largest likelihood
    suits the values best. The fifth is the leave-one-out ratio: the root mean square of the errors, each
    divided by its expected standard deviation. It is near 1 if StandardDeviation, distance and noise suit
    the values.
    """
    if numpy.size(ids) == 0:
        raise Error("there are no observations")
    results = _random_field(points, cells, {"Range": distance, "ObservationNoise": noise,
                                            "NumberOfSamples": number, "Statistics": True, **properties},
                            ids, values)
    return (results["Prediction"], results["PredictionStandardDeviation"],
            results["LeaveOneOutError"][_inputs.ids("ids", ids)], results["LogLikelihood"][0],
            results["LeaveOneOutRatio"][0])


def interpolate(points, cells, ids, values, **properties):
    """Computes the smoothest function with the given values at the points with the given ids."""
    points, cells = _inputs.checked(points, cells)
    return _solve("HarmonicInterpolation", points, cells, {"values": _known(points, ids, values)},
                  properties)["Interpolated"]


def stitch(points, cells, colors, labels, on=None, **properties):
    """Computes colors of several scans without the jumps between them. `labels` numbers the scans."""
    return _solve("StitchColors", points, cells, {"colors": colors, "labels": labels},
                  properties, on=on)["StitchedColors"]


def curvatures(points, cells, **properties):
    """Computes minimum and maximum curvature at the points, in one over length, and their directions.

    Returns arrays of the shapes (N), (N), (N, 3), (N, 3). The curvature of a convex surface is positive.
    """
    results = _solve("PrincipalCurvatures", points, cells, {}, properties)
    return tuple(results[name] for name in (
        "MinimumCurvature", "MaximumCurvature", "MinimumCurvatureDirection",
        "MaximumCurvatureDirection"))


def gradient(points, cells, values=None, on=None, **properties):
    """Computes the gradient along the surface and the Laplacian of values, both at the points.

    values: N or M rows; None takes the coordinates. Returns arrays of the shapes (N, 3 C) and (N, C)
    for C columns of values. The gradient of the first column comes first.
    """
    results = _solve("SurfaceGradient", points, cells, {"values": values}, properties, on=on)
    return results["Gradient"], results["Laplacian"]


def divergence(points, cells, vectors, on=None, **properties):
    """Computes the divergence of vectors along the surface and their curl about its normal, at points.

    vectors: N or M rows of three numbers.
    """
    results = _solve("SurfaceGradient", points, cells, {"values": _vectors(vectors)}, properties, on=on)
    return results["Divergence"], results["Curl"]


def decompose(points, cells, vectors, on=None, **properties):
    """Splits vectors along the surface into three parts, at the points (N, 3).

    The first part flows out of sources, the second turns in eddies, and the third runs around handles
    and holes. vectors: N or M rows of three numbers.
    """
    results = _solve("SurfaceGradient", points, cells, {"values": _vectors(vectors)},
                     {"HodgeDecomposition": True, **properties}, on=on)
    return results["GradientPart"], results["RotationPart"], results["HarmonicPart"]


def detail(points, cells, scale=2.0, values=None, scales=None, on=None, **properties):
    """Computes the points of the surface with its details enlarged (scale above 1) or removed (scale 0).

    values: numbers at the points. With values, the function returns them with scaled details
    instead of the points. scales: factors on the scale, at points or cells.
    """
    results = _solve("SurfaceDetail", points, cells, {"values": values, "scales": scales},
                     {"DetailScale": scale, **properties}, on=on)
    return results["Points" if values is None else "Filtered"]


def flow(points, cells, steps=10, **properties):
    """Moves the points of the surface by steps of mean-curvature flow, each of length TimeStep."""
    return _solve(
        "MeanCurvatureFlow", points, cells, {}, {"NumberOfSteps": steps, **properties})["Points"]
