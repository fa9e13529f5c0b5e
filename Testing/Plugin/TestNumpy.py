"""Tests the functions of the Python package: numpy arrays in, numpy arrays out, exceptions for misuse."""
import types
import unittest
import warnings

import numpy

import gridfem

OPTIONS = {"Depth": 5}


def unit_sphere(rings=30, sectors=60):
    """Returns points and triangles. The first point is the north pole, the last one the south pole."""
    polar = numpy.linspace(0, numpy.pi, rings + 1)[1:-1]
    around = numpy.linspace(0, 2 * numpy.pi, sectors, endpoint=False)
    theta, phi = numpy.meshgrid(polar, around, indexing="ij")
    belt = numpy.stack([numpy.sin(theta) * numpy.cos(phi), numpy.sin(theta) * numpy.sin(phi),
                        numpy.cos(theta)], axis=-1).reshape(-1, 3)
    points = numpy.vstack([[0, 0, 1], belt, [0, 0, -1]])
    triangles = []
    for j in range(sectors):
        k = (j + 1) % sectors
        triangles.append([0, 1 + j, 1 + k])
        for row in range(rings - 2):
            a, b = 1 + row * sectors + j, 1 + row * sectors + k
            triangles += [[a, a + sectors, b + sectors], [a, b + sectors, b]]
        last = 1 + (rings - 2) * sectors
        triangles.append([len(points) - 1, last + k, last + j])
    return points, numpy.array(triangles)


def misuses(package, points, triangles):
    """Yields messages, each with a call that has to raise it."""
    f = points[:, 2]
    none = numpy.zeros((0, 3))
    return {
        "points must be real numbers": lambda: package.spectrum(points * 1j, triangles),
        "points must be an array of numbers": lambda: package.spectrum([[0, 0, 0], [1]], triangles),
        "there is 0.5": lambda: package.spectrum(points, triangles + 0.5),
        "cells must be whole numbers; there is one that": lambda: package.spectrum(
            points, triangles * numpy.nan),
        "no result|no area": lambda: package.spectrum(none, none),
        "values must be real numbers": lambda: package.poisson(points, triangles, f.astype(str)),
        r"shape is \(1742, 3, 2\)": lambda: package.poisson(
            points, triangles, numpy.zeros((*points.shape, 2))),
        r"labels must .* their shape is \(1742, 0\)": lambda: package.signed_distance(
            points, triangles, numpy.zeros((len(points), 0))),
        "one component": lambda: package.signed_distance(points, triangles, numpy.sign(points)),
        "not true and false": lambda: package.distance(points, triangles, f > 0.5),
        "there is 0.7": lambda: package.distance(points, triangles, [0.7]),
        "sources must be ids in a row": lambda: package.distance(points, triangles, [[0, 1], [2, 3]]),
        "ids must be whole numbers, not true": lambda: package.interpolate(
            points, triangles, f > 0.5, f),
        "ids must be an array of numbers": lambda: package.interpolate(points, triangles, {0}, [1]),
        "Depth = None": lambda: package.poisson(points, triangles, f, Depth=None),
    }


class Numpy(unittest.TestCase):

    def setUp(self):
        self.points, self.triangles = unit_sphere()
        self.mesh = (self.points, self.triangles)

    def test_spectrum_of_the_sphere(self):
        eigenvalues, modes = gridfem.spectrum(*self.mesh, 9, **OPTIONS)
        numpy.testing.assert_allclose(eigenvalues, [0] + 3 * [2] + 5 * [6], rtol=0.01, atol=1e-9)
        self.assertEqual(modes.shape, (len(self.points), 9))
        numpy.testing.assert_allclose(modes[:, 0] ** 2, 1 / (4 * numpy.pi), rtol=0.01)

    def test_poisson_of_a_harmonic(self):
        # w (u - f) = Laplace u with Laplace z = -2 z: u = w / (w + 2) f.
        solution = gridfem.poisson(*self.mesh, self.points[:, 2], ScreeningWeight=3.0,
                                   ParameterUnits=0, **OPTIONS)
        numpy.testing.assert_allclose(solution, 0.6 * self.points[:, 2], atol=0.005)
        gradients = numpy.array([0, 0, 1]) - self.points[:, 2:] * self.points
        solution = gridfem.poisson(*self.mesh, 0 * self.points[:, 2], gradients, ScreeningWeight=0.0,
                                   **OPTIONS)
        numpy.testing.assert_allclose(solution, self.points[:, 2], atol=0.01)

    def test_without_values_the_shape_is_smoothed(self):
        solution = gridfem.poisson(*self.mesh, ScreeningWeight=3.0, ParameterUnits=0, **OPTIONS)
        numpy.testing.assert_allclose(solution, 0.6 * self.points, atol=0.005)

    def test_distances_from_both_poles(self):
        distances = gridfem.distance(*self.mesh, [0, len(self.points) - 1], **OPTIONS)
        latitude = numpy.arccos(numpy.clip(self.points[:, 2], -1, 1))
        exact = numpy.minimum(latitude, numpy.pi - latitude)
        self.assertEqual(distances[0], 0)
        self.assertLess(numpy.abs(distances - exact).max(), 0.06)

    def test_the_point_farthest_from_a_pole_is_the_other_one(self):
        ids, nearest, distances = gridfem.farthest_points(*self.mesh, 2, FirstPointId=0, **OPTIONS)
        self.assertEqual(ids[0], 0)
        numpy.testing.assert_allclose(self.points[ids[1]], -self.points[0], atol=0.1)
        numpy.testing.assert_array_equal(nearest[ids], ids)
        self.assertLess(abs(distances.max() - numpy.pi / 2), 0.06)

    def test_latitude_is_signed(self):
        labels = numpy.where(self.points[:, 2] > -1e-9, 4, 2)  # half a ring below the equator
        latitude = numpy.arcsin(numpy.clip(self.points[:, 2], -1, 1)) + numpy.pi / 60
        for inside, sign in ((2, 1), (4, -1)):
            distances = gridfem.signed_distance(*self.mesh, labels, inside, **OPTIONS)
            self.assertLess(numpy.abs(distances - sign * latitude).max(), 0.03)

    def test_heat_of_a_harmonic(self):
        diffused = gridfem.diffuse(*self.mesh, self.points[:, 2], 0.5, ParameterUnits=0, **OPTIONS)
        numpy.testing.assert_allclose(
            diffused, numpy.exp(-1.0) * self.points[:, 2], atol=0.005)

    def test_interpolation_between_two_circles(self):
        # Harmonic functions of the latitude are linear functions of log tan(theta / 2).
        theta = numpy.arccos(numpy.clip(self.points[:, 2], -1, 1))
        inner = 8 * numpy.pi / 30  # a ring of points
        known = numpy.flatnonzero(numpy.abs(theta - numpy.pi / 2) > numpy.pi / 2 - inner - 1e-9)
        exact = numpy.log(numpy.tan(numpy.clip(theta, inner, numpy.pi - inner) / 2))
        values = gridfem.interpolate(*self.mesh, known, exact[known], **OPTIONS, FunctionSpace=1)
        self.assertLess(numpy.abs(values - exact).max(), 0.005)

    def test_curvatures_of_the_sphere(self):
        lowest, highest, first, second = gridfem.curvatures(*self.mesh)
        numpy.testing.assert_allclose(lowest, 1, atol=0.02)
        numpy.testing.assert_allclose(highest, 1, atol=0.02)
        numpy.testing.assert_allclose(numpy.sum(first * second, axis=1), 0, atol=1e-9)

    def test_derivatives_on_the_sphere(self):
        slope = numpy.array([0, 0, 1]) - self.points[:, 2:] * self.points  # of z
        gradient, laplacian = gridfem.gradient(*self.mesh, self.points[:, 2], **OPTIONS)
        numpy.testing.assert_allclose(gradient, slope, atol=0.05)
        numpy.testing.assert_allclose(laplacian, -2 * self.points[:, 2], atol=0.2)
        divergence, curl = gridfem.divergence(*self.mesh, slope, **OPTIONS)
        numpy.testing.assert_allclose(divergence, -2 * self.points[:, 2], atol=0.2)
        numpy.testing.assert_allclose(curl, 0, atol=0.2)
        parts = gridfem.decompose(*self.mesh, slope, **OPTIONS)
        for part, expected in zip(parts, (slope, 0, 0)):
            numpy.testing.assert_allclose(part, expected + 0 * slope, atol=0.05)

    def test_scans_of_one_colour(self):
        labels = (self.points[:, 2] > 0.01).astype(int)
        colors = numpy.where(labels[:, None] == 1, [200.0, 100.0, 50.0], [100.0, 50.0, 100.0])
        stitched = gridfem.stitch(*self.mesh, colors, labels, **OPTIONS)
        self.assertLess(numpy.ptp(stitched, axis=0).max(), 2.0)

    def test_surfaces_that_move(self):
        smooth = gridfem.detail(*self.mesh, 0.0, ScreeningWeight=3.0, ParameterUnits=0, **OPTIONS)
        numpy.testing.assert_allclose(
            numpy.linalg.norm(smooth, axis=1), 0.6, atol=0.005)
        height = self.points[:, 2]
        numpy.testing.assert_allclose(
            gridfem.detail(*self.mesh, 0.0, values=height, ScreeningWeight=3.0, ParameterUnits=0, **OPTIONS),
            0.6 * height, atol=0.01)
        warmed = gridfem.diffuse(*self.mesh, 0 * height, 0.1, source=numpy.ones(len(height)),
                                 ParameterUnits=0, **OPTIONS)
        numpy.testing.assert_allclose(warmed, 0.1, atol=1e-5)  # the same source everywhere: u = t
        flowing = gridfem.flow(*self.mesh, 10, TimeStep=0.01, ParameterUnits=0, **OPTIONS)
        numpy.testing.assert_allclose(
            numpy.linalg.norm(flowing, axis=1), numpy.sqrt(1 - 4 * 0.1), atol=0.02)

    def test_polygons_and_values_on_cells(self):
        points = numpy.array([[i, j, 0] for i in range(9) for j in range(9)], dtype=float)
        corner = numpy.array([9 * i + j for i in range(8) for j in range(8)])
        squares = corner[:, None] + [0, 9, 10, 1]
        solution = gridfem.poisson(points, squares, numpy.arange(64) // 8 + 0.5, **OPTIONS)
        self.assertEqual(solution.shape, (81,))
        self.assertAlmostEqual(solution.mean(), 4.0, delta=0.01)

    def test_meshes_of_other_libraries(self):
        points, triangles = self.mesh
        counted = numpy.column_stack([numpy.full(len(triangles), 3), triangles]).ravel()
        block = types.SimpleNamespace
        meshes = {
            "trimesh": block(vertices=points, faces=triangles),
            "pyvista": block(points=points, faces=counted),
            "meshio": block(points=points, cells=[block(type="vertex", data=[[0]]),
                                                  block(type="triangle", data=triangles)])}
        for name, mesh in meshes.items():
            with self.subTest(name):
                given = gridfem.arrays(mesh)
                numpy.testing.assert_array_equal(given[0], points)
                numpy.testing.assert_array_equal(given[1], triangles)
        mixed = block(points=points, faces=[3, 0, 1, 2, 4, 0, 1, 2, 3])
        self.assertEqual(gridfem.arrays(mixed)[1].tolist(), [[0, 1, 2], [0, 1, 2], [0, 2, 3]])
        quads = block(points=points, faces=[4, 0, 1, 2, 3, 4, 3, 2, 1, 0])
        self.assertEqual(gridfem.arrays(quads)[1].tolist(), [[0, 1, 2, 3], [3, 2, 1, 0]])
        for wrong in (points, block(points=points, cells=[])):
            with self.assertRaises(gridfem.Error):
                gridfem.arrays(wrong)

    def test_misuse_raises(self):
        points, triangles = self.mesh
        cases = {
            "three columns": lambda: gridfem.spectrum(points[:, :2], triangles),
            "ids of the": lambda: gridfem.spectrum(points, triangles + len(points)),
            "no property Dept": lambda: gridfem.spectrum(points, triangles, Dept=5),
            "not a finite number": lambda: gridfem.spectrum(points * numpy.nan, triangles),
            "has 7 rows": lambda: gridfem.poisson(points, triangles, numpy.ones(7)),
            "no polygon of the mesh has": lambda: gridfem.distance(points, triangles, len(points)),
            "no sources": lambda: gridfem.distance(points, triangles, []),
            "no border": lambda: gridfem.signed_distance(points, triangles, points[:, 0] * 0),
            "must be integers": lambda: gridfem.signed_distance(points, triangles, points[:, 0]),
            "2 ids and 3 values": lambda: gridfem.interpolate(points, triangles, [0, 1], [1, 2, 3])}
        for message, call in cases.items():
            with self.subTest(message=message), self.assertRaisesRegex(gridfem.Error, message):
                call()

    def test_arrays_of_other_kinds(self):
        """Any container with the same numbers gives the same result."""
        points, triangles = self.mesh
        values = points[:, 2].astype("f4")
        expected = gridfem.poisson(points, triangles, values, **OPTIONS)
        for kind in (">f4", "f8", "f16", "O"):
            with self.subTest(kind):
                solution = gridfem.poisson(points, triangles, values.astype(kind), **OPTIONS)
                numpy.testing.assert_array_equal(solution.astype("f4"), expected)
        short = values.astype("f2")
        numpy.testing.assert_array_equal(
            gridfem.poisson(points, triangles, short, **OPTIONS),
            gridfem.poisson(points, triangles, short.astype("f4"), **OPTIONS))
        hidden = numpy.ma.masked_array(numpy.where(points[:, 2] > 0.9, 1e9, points[:, 2]),
                                       points[:, 2] > 0.9)
        filled = gridfem.poisson(points, triangles, hidden, FillUnknown=True, **OPTIONS)
        self.assertLess(numpy.abs(filled).max(), 2)

    def test_several_values_at_a_point_count_as_their_mean(self):
        ids, values = [0, 40, 0, 900], [[0.0, 1], [5, 2], [2, 3], [7, 8]]
        numpy.testing.assert_array_equal(
            gridfem.interpolate(*self.mesh, ids, values, **OPTIONS),
            gridfem.interpolate(*self.mesh, [0, 40, 900], [[1.0, 2], [5, 2], [7, 8]], **OPTIONS))

    def test_misuse_of_arrays_raises(self):
        for message, call in misuses(gridfem, *self.mesh).items():
            with self.subTest(message=message), self.assertRaisesRegex(gridfem.Error, message):
                call()

    def test_what_has_not_converged_warns(self):
        with self.assertWarnsRegex(RuntimeWarning, "Not converged"):
            gridfem.spectrum(*self.mesh, 20, **OPTIONS, MaximumIterations=1, Tolerance=1e-14)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            gridfem.spectrum(*self.mesh, 4, **OPTIONS)  # no group is cut


if __name__ == "__main__":
    unittest.main()
