"""Tests the functions of the Python package: numpy arrays in, numpy arrays out, exceptions for misuse."""
import types
import unittest
import warnings

import numpy

import gridfem
from gridfem import _inputs

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


def quad_torus(around=16, across=9):
    """Returns points and quads of a closed torus, of which there are as many."""
    u, v = numpy.meshgrid(numpy.linspace(0, 2 * numpy.pi, around, endpoint=False),
                          numpy.linspace(0, 2 * numpy.pi, across, endpoint=False), indexing="ij")
    radius = 2 + 0.7 * numpy.cos(v)
    points = numpy.stack([radius * numpy.cos(u), radius * numpy.sin(u), 0.7 * numpy.sin(v)], axis=-1)
    number = numpy.arange(around * across).reshape(around, across)
    right = numpy.roll(number, -1, axis=0)
    cells = numpy.stack([number, right, numpy.roll(right, -1, axis=1), numpy.roll(number, -1, axis=1)], axis=-1)
    return points.reshape(-1, 3), cells.reshape(-1, 4)


def misuses(package, points, triangles):
    """Yields messages, each with a call that has to raise it."""
    f = points[:, 2]
    on_cells = f[triangles].mean(axis=1)
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
        r"labels must have one column; its shape is \(1742, 3\)": lambda: package.signed_distance(
            points, triangles, numpy.sign(points)),
        "not true and false": lambda: package.distance(points, triangles, f > 0.5),
        "there is 0.7": lambda: package.distance(points, triangles, [0.7]),
        "sources must be ids in a row": lambda: package.distance(points, triangles, [[0, 1], [2, 3]]),
        "ids must be whole numbers, not true": lambda: package.interpolate(
            points, triangles, f > 0.5, f),
        "ids must be an array of numbers": lambda: package.interpolate(points, triangles, {0}, [1]),
        "Depth = None": lambda: package.poisson(points, triangles, f, Depth=None),
        "held has 3480 rows; there are 1742 points$": lambda: package.poisson(
            points, triangles, f, held=on_cells),
        "held has 3480 rows; there are 1742 points": lambda: package.diffuse(
            points, triangles, f, 0.1, held=on_cells),
        r"held must have one column; its shape is \(1742, 2\)": lambda: package.poisson(
            points, triangles, f, held=points[:, :2]),
        "^held needs values at points, but values has a row for each cell.$": lambda: package.poisson(
            points, triangles, on_cells, held=f),
        "^Boundary Values needs values at points, but values": lambda: package.diffuse(
            points, triangles, on_cells, 0.1, BoundaryValues=True),
        "flux has 3480 rows; there are 1742 points": lambda: package.poisson(
            points, triangles, f, flux=on_cells),
        "values has 3480 rows; there are 1742 points": lambda: package.detail(
            points, triangles, values=on_cells),
        "gradients has 3 columns. The values have 3, so 9 are needed": lambda: package.poisson(
            points, triangles, points, points),
        "^source has 3 columns instead of the 1 of the values": lambda: package.diffuse(
            points, triangles, f, 0.1, source=points),
        "colors must have a number for each point or cell; it is None": lambda: package.stitch(
            points, triangles, None, f),
        "labels must have a number for each point or cell; it is None": lambda: package.stitch(
            points, triangles, f, None),
        "vectors must have three columns": lambda: package.decompose(points, triangles, f),
        "The result has no GradientPart": lambda: package.decompose(
            points, triangles, points, HodgeDecomposition=False, **OPTIONS),
        "no property AllModes": lambda: package.spectrum(points, triangles, AllModes=False),
        "no property BlocksAsOne": lambda: package.poisson(points, triangles, BlocksAsOne=True),
        "no property Debug": lambda: package.poisson(points, triangles, Debug=True),
        "no property InputData": lambda: package.poisson(points, triangles, InputData=None),
        "no property ResultPrefix": lambda: package.poisson(points, triangles, ResultPrefix="x"),
        "^number must be an integer": lambda: package.spectrum(points, triangles, 5.5),
        "^Number Of Threads must be an integer": lambda: package.spectrum(
            points, triangles, NumberOfThreads=1.5),
        "^steps is -1; it must be from": lambda: package.flow(points, triangles, -1),
        "^sources: there is no point -1": lambda: package.distance(points, triangles, -1),
        "^ids: there is no point 1742. Choose an id from 0 to 1741": lambda: package.path(
            points, triangles, [0, 1742]),
        "^there are no ids$": lambda: package.interpolate(points, triangles, [], []),
        "all are NaN.$": lambda: package.interpolate(points, triangles, [0], [numpy.nan]),
        "all are NaN, or held is false there.$": lambda: package.poisson(points, triangles, f, held=0 * f),
        "on = 'point': must be": lambda: package.poisson(points, triangles, f, on="point"),
        "values has 1742 rows; there are 3480 cells": lambda: package.poisson(
            points, triangles, f, on="cells"),
    }


def areas(points, triangles):
    """Returns the areas of triangles."""
    corner = points[triangles]
    return numpy.linalg.norm(
        numpy.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0]), axis=1) / 2


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

    def test_values_of_weight_zero_may_be_anything(self):
        z = self.points[:, 2]
        weights = (z < 0.7).astype(float)
        solutions = [
            gridfem.poisson(*self.mesh, numpy.where(weights > 0, z, filler), weights=weights, **OPTIONS)
            for filler in (0.0, 1e30, numpy.nan)]
        for solution in solutions[1:]:
            numpy.testing.assert_array_equal(solution, solutions[0])

    def test_without_values_the_shape_is_smoothed(self):
        solution = gridfem.poisson(*self.mesh, ScreeningWeight=3.0, ParameterUnits=0, **OPTIONS)
        numpy.testing.assert_allclose(solution, 0.6 * self.points, atol=0.005)

    def test_held_points_of_a_smoothed_shape_stay(self):
        held = self.points[:, 0] > 0.5
        for call in (lambda **o: gridfem.poisson(*self.mesh, ScreeningWeight=3.0, **o),
                     lambda **o: gridfem.diffuse(*self.mesh, None, 0.1, **o)):
            moved = call(held=held, ParameterUnits=0, **OPTIONS)
            numpy.testing.assert_allclose(moved[held], self.points[held], atol=1e-6)
            self.assertLess(numpy.linalg.norm(moved[self.points[:, 0] < -0.5], axis=1).max(), 0.95)

    def test_as_many_points_as_cells(self):
        """A point of no cell changes no result, but the rows then belong to only one of the two."""
        points, cells = quad_torus()
        more = numpy.vstack([points, [[9.0, 9.0, 9.0]]])
        values, weights = numpy.sin(numpy.arange(288.0)).reshape(2, -1)
        weights = weights ** 2

        def solutions(points, values, weights, **options):
            yield gridfem.poisson(points, cells, values, weights=weights, **options, **OPTIONS)
            yield gridfem.gradient(points, cells, values, **options, **OPTIONS)[0]
            yield gridfem.detail(points, cells, scales=weights, **options, **OPTIONS)

        on_cells = list(solutions(points, values, weights, on="cells"))
        for solution, expected in zip(on_cells, solutions(more, values, weights)):
            numpy.testing.assert_array_equal(solution, expected[:-1])
        at_points = list(solutions(points, values, weights, on="points"))
        for solution, expected in zip(at_points, solutions(more, [*values, 0], [*weights, 0])):
            numpy.testing.assert_array_equal(solution, expected[:-1])
        with self.assertWarnsRegex(RuntimeWarning, "144 rows, and there are as many points as cells") as caught:
            for solution, expected in zip(solutions(points, values, weights), at_points):
                numpy.testing.assert_array_equal(solution, expected)
        self.assertEqual(caught.filename, __file__)
        with warnings.catch_warnings():  # of what belongs to points alone
            warnings.simplefilter("error")
            gridfem.poisson(points, cells, held=values > 0, **OPTIONS)
            gridfem.interpolate(points, cells, [0, 7], [1.0, 2.0], **OPTIONS)

    def test_numbers_of_other_types(self):
        expected = gridfem.poisson(*self.mesh, self.points[:, 2], **OPTIONS)
        for depth in (5.0, "5", numpy.int16(5), numpy.float32(5)):
            numpy.testing.assert_array_equal(
                gridfem.poisson(*self.mesh, self.points[:, 2], Depth=depth), expected)
        self.assertEqual(gridfem.spectrum(*self.mesh, 5.0, **OPTIONS)[0].shape, (5,))

    def test_depth_1_counts_as_2(self):
        numpy.testing.assert_array_equal(gridfem.poisson(*self.mesh, self.points[:, 2], Depth=1),
                                         gridfem.poisson(*self.mesh, self.points[:, 2], Depth=2))

    def test_distances_from_both_poles(self):
        distances = gridfem.distance(*self.mesh, [0, len(self.points) - 1], **OPTIONS)
        latitude = numpy.arccos(numpy.clip(self.points[:, 2], -1, 1))
        exact = numpy.minimum(latitude, numpy.pi - latitude)
        self.assertEqual(distances[0], 0)
        self.assertLess(numpy.abs(distances - exact).max(), 0.06)

    def test_a_distance_starts_at_the_point_nearest_to_a_position(self):
        """Also if a point of no cell is nearer."""
        points, cells = self.mesh
        lonely = numpy.vstack([points, [[0.8, 1.6, 0.2]]])
        for position in ([0.9, 1.8, 0.2], (-0.3, 0.0, -0.1)):
            with self.subTest(position=position):
                nearest = numpy.linalg.norm(points - position, axis=1).argmin()
                numpy.testing.assert_array_equal(
                    gridfem.distance(lonely, cells, position=position, **OPTIONS)[:-1],
                    gridfem.distance(lonely, cells, [nearest], **OPTIONS)[:-1])
        for position in ([0, 0], [0, 0, numpy.nan]):
            with self.assertRaisesRegex(gridfem.Error, "three finite numbers"):
                gridfem.distance(*self.mesh, position=position)

    def test_no_distance_is_below_the_straight_line(self):
        sources = numpy.arange(0, len(self.points), 9)
        distances = gridfem.distance(*self.mesh, sources, **OPTIONS)
        straight = numpy.linalg.norm(self.points[:, None] - self.points[sources], axis=2).min(1)
        self.assertTrue((distances >= (1 - 1e-14) * straight).all())
        numpy.testing.assert_array_equal(distances == 0, straight == 0)
        with self.assertRaisesRegex(gridfem.Error, "Smoothing"):
            gridfem.distance(*self.mesh, [0], Smoothing=0.5, **OPTIONS)

    def test_the_point_farthest_from_a_pole_is_the_other_one(self):
        ids, nearest, distances = gridfem.farthest_points(*self.mesh, 2, FirstPointId=0, **OPTIONS)
        self.assertEqual(ids[0], 0)
        numpy.testing.assert_allclose(self.points[ids[1]], -self.points[0], atol=0.1)
        numpy.testing.assert_array_equal(nearest[ids], ids)
        self.assertLess(abs(distances.max() - numpy.pi / 2), 0.06)

    def test_the_path_to_the_other_pole_is_half_a_great_circle(self):
        opposite = int(numpy.argmin(self.points @ self.points[0]))
        places, corners, weights = gridfem.path(*self.mesh, [0, opposite])
        length = numpy.linalg.norm(numpy.diff(places, axis=0), axis=1).sum()
        self.assertLess(abs(length - numpy.pi), 0.01)
        self.assertLess(length, numpy.pi)
        numpy.testing.assert_array_equal(places[[0, -1]], self.points[[0, opposite]])
        numpy.testing.assert_allclose(weights.sum(axis=1), 1.0, atol=1e-15)
        numpy.testing.assert_allclose(
            (weights * self.points[corners, 2]).sum(axis=1), places[:, 2], atol=1e-15)
        there_and_back, _, _ = gridfem.path(*self.mesh, [0, opposite], closed=True)
        self.assertAlmostEqual(
            numpy.linalg.norm(numpy.diff(there_and_back, axis=0), axis=1).sum(), 2 * length, places=9)
        with self.assertRaisesRegex(gridfem.Error, "two points"):
            gridfem.path(*self.mesh, [0])

    def test_the_matrix_of_distances(self):
        ids = [700, 0, 350, 700, 1200]
        matrix = gridfem.distance_matrix(*self.mesh, ids)
        angles = numpy.arccos(numpy.clip(self.points[ids] @ self.points[ids].T, -1, 1))
        numpy.testing.assert_allclose(matrix, angles, atol=0.01)
        numpy.testing.assert_array_equal(matrix, matrix.T)
        numpy.testing.assert_array_equal(matrix[[0, 3, 1], [3, 0, 1]], 0.0)
        points = numpy.vstack([self.points, self.points + 5])
        cells = numpy.vstack([self.mesh[1], self.mesh[1] + len(self.points)])
        with self.assertWarns(RuntimeWarning):
            apart = gridfem.distance_matrix(points, cells, [0, 9, len(points) - 1])
        numpy.testing.assert_array_equal(numpy.isnan(apart), [[0, 0, 1], [0, 0, 1], [1, 1, 0]])

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

    def test_a_wave_of_a_harmonic(self):
        start = self.points[:, 2]  # u'' = -2 u
        # Functions finer than the triangles would show the kinks of the start as short waves.
        options = {"ParameterUnits": 0, "Depth": 4}
        state = gridfem.dynamics(*self.mesh, "Wave", 2.0, 50, start=start, TimeStep=0.03, **options)
        omega = numpy.sqrt(2.0)
        numpy.testing.assert_allclose(state[:, 0], numpy.cos(1.5 * omega) * start, atol=0.02)
        numpy.testing.assert_allclose(state[:, 1], -omega * numpy.sin(1.5 * omega) * start, atol=0.03)
        again = gridfem.dynamics(*self.mesh, "Wave", 2.0, 50, start=state, TimeStep=0.03, **options)
        numpy.testing.assert_allclose(again[:, 0], numpy.cos(3.0 * omega) * start, atol=0.04)
        with self.assertRaisesRegex(gridfem.Error, "Velocity Array"):
            gridfem.dynamics(*self.mesh, "Transport", 1.0, 2, **OPTIONS)

    def test_random_fields_have_their_standard_deviation(self):
        fields = gridfem.gaussian_field(
            *self.mesh, 0.5, 30, ParameterUnits=0, StandardDeviation=3.0, **OPTIONS)
        self.assertEqual(fields.shape, (len(self.points), 30))
        self.assertAlmostEqual(fields.std(), 3.0, delta=0.3)
        statistics = gridfem.gaussian_field(
            *self.mesh, 0.5, 30, ParameterUnits=0, StandardDeviation=3.0, Statistics=True, **OPTIONS)
        numpy.testing.assert_allclose(
            statistics, numpy.stack([fields.mean(axis=1), fields.std(axis=1, ddof=1)], 1), atol=1e-9)
        with self.assertRaisesRegex(gridfem.Error, "distance is 0"):
            gridfem.gaussian_field(*self.mesh, 0.0, **OPTIONS)

    def test_prediction_from_values_at_some_points(self):
        ids = numpy.random.default_rng(3).choice(len(self.points), 60, replace=False)
        values = 20 + self.points[ids, 2]
        options = {"ParameterUnits": 0, **OPTIONS}
        mean, deviation, errors, likelihood, ratio = gridfem.krige(
            *self.mesh, ids, values, 1.0, 0.01, **options)
        self.assertTrue(0 < ratio < 1)  # a wave of one degree is smoother than the field
        numpy.testing.assert_allclose(mean, 20 + self.points[:, 2], atol=0.2)
        numpy.testing.assert_allclose(mean[ids], values, atol=0.03)
        self.assertLess(deviation[ids].max(), 0.015)
        self.assertGreater(deviation.max(), 0.1)
        some = numpy.delete(numpy.arange(len(ids)), 3)
        predicted = gridfem.krige(
            *self.mesh, ids[some], values[some], 1.0, 0.01, number=2, **options)[0][ids[3]]
        self.assertAlmostEqual(errors[3], values[3] - predicted, places=4)
        samples = gridfem.gaussian_field(*self.mesh, 1.0, 3, ids, values, 0.01, **options)
        numpy.testing.assert_allclose(samples[ids], values[:, None].repeat(3, 1), atol=0.06)
        # A smooth wave is unlikely with a short range.
        self.assertGreater(likelihood, gridfem.krige(
            *self.mesh, ids, values, 0.3, 0.01, number=2, **options)[3])
        with self.assertRaisesRegex(gridfem.Error, "there are 2 ids and 1 values"):
            gridfem.krige(*self.mesh, [1, 2], [1.0], 1.0)
        with self.assertRaisesRegex(gridfem.Error, "no observations"):
            gridfem.krige(*self.mesh, [], [], 1.0)

    def test_several_observations_of_one_point_count_each(self):
        """If only one place is observed, the error there is the mean of the errors of its observations."""
        point, noise, number = 700, 0.5, 400
        for values in ([2.0], [2.0, 3.5], [1.0, 2.0, 6.0, 1.0, numpy.nan]):
            known = numpy.array(values)[~numpy.isnan(values)]
            mean, deviation, errors, _, _ = gridfem.krige(
                *self.mesh, [point] * len(values), values, 0.5, noise, number, ParameterUnits=0, **OPTIONS)
            self.assertAlmostEqual(mean[point], known.mean(), places=5)
            expected = noise / numpy.sqrt(len(known))
            self.assertAlmostEqual(deviation[point] / expected, 1.0, delta=4 / numpy.sqrt(2 * number))
            self.assertEqual(len(errors), len(values))

    def test_statistics_of_a_field_with_observations(self):
        """They are the prediction and the standard deviation of its error."""
        observed = ([0, 50, 700, 50], [1.0, 2.0, 4.0, 2.5])
        options = {"ParameterUnits": 0, **OPTIONS}
        statistics = gridfem.gaussian_field(*self.mesh, 1.0, 20, *observed, 0.2, Statistics=True, **options)
        expected = gridfem.krige(*self.mesh, *observed, 1.0, 0.2, 20, **options)
        numpy.testing.assert_array_equal(statistics, numpy.stack(expected[:2], axis=1))

    def test_fewer_points_than_components(self):
        points = numpy.vstack([self.points, self.points + 5, self.points - 5])
        cells = numpy.vstack([self.triangles + k * len(self.points) for k in range(3)])
        with self.assertWarnsRegex(RuntimeWarning, "33.3 % of the points have no distance"):
            ids, nearest, distances = gridfem.farthest_points(points, cells, 2, Depth=6)
        self.assertEqual(len(ids), 2)
        numpy.testing.assert_array_equal(numpy.isnan(distances), nearest == -1)
        self.assertEqual(numpy.isnan(distances).sum(), len(self.points))
        self.assertTrue(numpy.isfinite(distances[nearest >= 0]).all())

    def test_choices_have_the_names_of_the_panel(self):
        height = self.points[:, 2]
        expected = gridfem.diffuse(*self.mesh, height, fwhm=0.4, **OPTIONS)
        numpy.testing.assert_array_equal(
            gridfem.diffuse(*self.mesh, height, 9.0, Amount="FWHM", FWHM=0.4, **OPTIONS), expected)
        with self.assertRaisesRegex(gridfem.Error, "DiffusionTime, FWHM, Sigma"):
            gridfem.diffuse(*self.mesh, height, 9.0, Amount="FullWidth", **OPTIONS)

    def test_smoothing_by_a_width(self):
        time = 0.05
        expected = gridfem.diffuse(*self.mesh, self.points, time, ParameterUnits=0, **OPTIONS)
        for amount in ({"fwhm": numpy.sqrt(16 * numpy.log(2) * time)}, {"sigma": numpy.sqrt(2 * time)}):
            numpy.testing.assert_allclose(
                gridfem.diffuse(*self.mesh, self.points, **amount, **OPTIONS), expected, atol=1e-9)
        for amounts in ({}, {"fwhm": 1.0, "sigma": 1.0}, {"time": 1.0, "fwhm": 1.0}):
            with self.assertRaisesRegex(gridfem.Error, "give one of time, fwhm and sigma"):
                gridfem.diffuse(*self.mesh, self.points, **amounts, **OPTIONS)

    def test_heat_of_a_point_is_positive(self):
        put = numpy.zeros(len(self.points))
        put[200] = 1.0
        for steps in (1, 2, 8):
            diffused = gridfem.diffuse(*self.mesh, put, 0.1, ParameterUnits=0, NumberOfSteps=steps, **OPTIONS)
            self.assertGreater(diffused.min(), -1e-3 * diffused.max())
            self.assertGreater(diffused[200], 0.87 * diffused.max())

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

    def test_scans_of_one_color(self):
        labels = (self.points[:, 2] > 0.01).astype(int)
        colors = numpy.where(labels[:, None] == 1, [200.0, 100.0, 50.0], [100.0, 50.0, 100.0])
        stitched = gridfem.stitch(*self.mesh, colors, labels, **OPTIONS)
        self.assertLess(numpy.ptp(stitched, axis=0).max(), 2.0)

    def test_colors_stay_in_range_beside_unknown_ones(self):
        given = numpy.array([0.2, numpy.nan, 1.0])
        for result, expected in (([1.2, -0.1, 0.5], [1.0, 0.0, 0.5]), ([1.2, numpy.nan, 0.5], [1.0, numpy.nan, 0.5])):
            numpy.testing.assert_array_equal(_inputs.colors_like(numpy.array(result), given), expected)
        numpy.testing.assert_array_equal(_inputs.colors_like(numpy.array([1.2]), given[1:2]), [1.2])

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

    def test_seams_and_hanging_nodes(self):
        u, v = numpy.meshgrid(numpy.linspace(0, 2 * numpy.pi, 61), numpy.linspace(0, 3, 31))
        tube = numpy.stack([numpy.cos(u), numpy.sin(u), v], axis=-1).reshape(-1, 3)
        a = (61 * numpy.arange(30)[:, None] + numpy.arange(60)).ravel()
        quads = numpy.stack([a, a + 1, a + 62, a + 61], axis=1)
        eigenvalues, _ = gridfem.spectrum(tube, quads, 4, **OPTIONS)
        numpy.testing.assert_allclose(eigenvalues, [0, 1, 1, numpy.pi ** 2 / 9], rtol=0.01, atol=1e-9)
        eigenvalues, _ = gridfem.spectrum(tube, quads, 2, WeldCoincidentPoints=False, **OPTIONS)
        self.assertAlmostEqual(eigenvalues[1], 0.25, delta=0.01)  # cut open along the seam

        # Two squares below a rectangle, which has a hanging node. Values may be on the cells.
        points = numpy.array([[0, 0, 0], [1, 0, 0], [2, 0, 0], [0, 1, 0], [1, 1, 0], [2, 1, 0],
                              [0, 2, 0], [2, 2, 0]], dtype=float)
        squares = numpy.array([[0, 1, 4, 3], [1, 2, 5, 4], [3, 5, 7, 6]])
        distance = gridfem.distance(points, squares, [0], **OPTIONS)
        numpy.testing.assert_allclose(distance, numpy.linalg.norm(points, axis=1), atol=0.1)
        solution = gridfem.poisson(points, squares, numpy.full(3, 2.0), **OPTIONS)
        numpy.testing.assert_allclose(solution, 2.0, rtol=1e-3)

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
        flat = [[0, 0], [2, 0], [2, 1], [1, 1], [1, 2], [0, 2], [-1, 0]]
        mixed = block(points=flat, faces=[6, 1, 2, 3, 4, 5, 0, 3, 0, 5, 6])  # an L and a triangle
        corners, cells = gridfem.arrays(mixed)
        self.assertEqual(cells.shape, (5, 3))
        self.assertAlmostEqual(areas(corners, cells).sum(), 4.0, delta=1e-12)
        quads = block(points=points, faces=[4, 0, 1, 2, 3, 4, 3, 2, 1, 0])
        self.assertEqual(gridfem.arrays(quads)[1].tolist(), [[0, 1, 2, 3], [3, 2, 1, 0]])
        for wrong in (points, block(points=points, cells=[])):
            with self.assertRaises(gridfem.Error):
                gridfem.arrays(wrong)

    def test_choices_have_names(self):
        points, triangles = self.mesh
        for name, number in (("Grid", 0), ("HatFunctions", 1), ("SmoothGrid", 2)):
            numpy.testing.assert_array_equal(
                gridfem.poisson(points, triangles, FunctionSpace=name, **OPTIONS),
                gridfem.poisson(points, triangles, FunctionSpace=number, **OPTIONS))
        with self.assertRaisesRegex(gridfem.Error, "one of Harmonic, Biharmonic"):
            gridfem.interpolate(points, triangles, [0], [1.0], Smoothness="Smooth")

    def test_values_out_of_range_raise(self):
        points, triangles = self.mesh
        with self.assertRaisesRegex(gridfem.Error, "number is 0; it must be from 1 to 100000"):
            gridfem.spectrum(points, triangles, 0)
        with self.assertRaisesRegex(gridfem.Error, "Depth is 15; it must be from 0 to 14"):
            gridfem.poisson(points, triangles, Depth=15)
        with self.assertRaisesRegex(gridfem.Error, "Smoothness is 2; it must be from 0 to 1"):
            gridfem.interpolate(points, triangles, [0], [1.0], Smoothness=2)

    def test_a_part_is_its_cells(self):
        points, triangles = self.mesh
        north = triangles[points[triangles, 2].min(axis=1) > -0.5]
        used = numpy.isin(numpy.arange(len(points)), north)
        distance = gridfem.distance(points, north, 0, **OPTIONS)
        numpy.testing.assert_array_equal(numpy.isfinite(distance), used)
        solution = gridfem.poisson(points, north, points[:, 2], **OPTIONS)
        numpy.testing.assert_array_equal(numpy.isfinite(solution), used)
        smooth = gridfem.poisson(points, north, **OPTIONS)
        numpy.testing.assert_array_equal(smooth[~used], points[~used])

    def test_colors_stay_colors(self):
        points, triangles = self.mesh
        colors = numpy.where(points[:, 2:] > 0, numpy.uint8([250, 128, 5]), numpy.uint8([5, 128, 250]))
        sharp = gridfem.detail(points, triangles, 4.0, values=colors, **OPTIONS)
        self.assertEqual(sharp.dtype, numpy.uint8)
        self.assertEqual((sharp.min(), sharp.max()), (0, 255))  # clamped
        diffused = gridfem.diffuse(points, triangles, colors, 1e-3, **OPTIONS)
        self.assertEqual(diffused.dtype, numpy.uint8)
        self.assertTrue((abs(diffused[:, 1].astype(int) - 128) <= 1).all())
        # A color outside of the surface stays.
        north = triangles[points[triangles, 2].min(axis=1) > -0.5]
        unused = ~numpy.isin(numpy.arange(len(points)), north)
        numpy.testing.assert_array_equal(
            gridfem.poisson(points, north, colors, **OPTIONS)[unused], colors[unused])

    def test_misuse_raises(self):
        points, triangles = self.mesh
        cases = {
            "three columns": lambda: gridfem.spectrum(points[:, :2], triangles),
            "ids of the": lambda: gridfem.spectrum(points, triangles + len(points)),
            "no property Dept": lambda: gridfem.spectrum(points, triangles, Dept=5),
            "not a finite number": lambda: gridfem.spectrum(points * numpy.nan, triangles),
            "has 7 rows": lambda: gridfem.poisson(points, triangles, numpy.ones(7)),
            "there is no point": lambda: gridfem.distance(points, triangles, len(points)),
            "no sources": lambda: gridfem.distance(points, triangles, []),
            "has the Inside Label 1": lambda: gridfem.signed_distance(points, triangles, points[:, 0] * 0),
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

    def test_warnings_name_arguments(self):
        points, cells = unit_sphere(6, 8)
        three = [numpy.vstack([array + k * step for k in range(3)])
                 for array, step in ((points, 5.0), (cells, len(points)))]
        with self.assertWarnsRegex(RuntimeWarning, "Choose points there by sources, or leave out the cells"):
            gridfem.distance(*three, 0, **OPTIONS)
        with self.assertWarnsRegex(RuntimeWarning, "3 connected components.* Choose a number above 3[.]"):
            gridfem.spectrum(*three, 2, **OPTIONS)

    def test_what_has_not_converged_warns(self):
        with self.assertWarnsRegex(RuntimeWarning, "Not converged"):
            gridfem.spectrum(*self.mesh, 20, **OPTIONS, MaximumIterations=1, Tolerance=1e-14)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            gridfem.spectrum(*self.mesh, 4, **OPTIONS)  # no group is cut


if __name__ == "__main__":
    unittest.main()
