"""Tests that the package without VTK gives the results of the filters, for the same calls."""
import importlib.util
import os
import sys
import unittest
import unittest.mock
import warnings

import numpy

import gridfem
from gridfem import vtkGridFEMFilters
from gridfem._with_vtk import has_property
from TestNumpy import areas, misuses, unit_sphere
from vtkmodules.vtkFiltersCore import vtkDelaunay3D, vtkStripper
from vtkmodules.vtkFiltersSources import vtkSphereSource


def load(name, folder):
    """Loads the package in a folder, under a name of its own."""
    spec = importlib.util.spec_from_file_location(
        name, os.path.join(folder, "__init__.py"), submodule_search_locations=[folder])
    module = importlib.util.module_from_spec(spec)
    sys.modules[name] = module
    spec.loader.exec_module(module)
    return module


def open_torus(around=40, across=20):
    """Returns points and quads of a torus that lacks a piece, so that it has a boundary."""
    u = numpy.linspace(0, 1.7 * numpy.pi, around)
    v = numpy.linspace(0, 2 * numpy.pi, across, endpoint=False)
    u, v = numpy.meshgrid(u, v, indexing="ij")
    radius = 2 + 0.6 * numpy.cos(v)
    points = numpy.stack([radius * numpy.cos(u), radius * numpy.sin(u), 0.6 * numpy.sin(v)], -1)
    row, column = numpy.meshgrid(numpy.arange(around - 1), numpy.arange(across), indexing="ij")
    corner = row * across + column
    right = row * across + (column + 1) % across
    quads = numpy.stack([corner, corner + across, right + across, right], axis=-1)
    return points.reshape(-1, 3), quads.reshape(-1, 4)


def soup(points, cells):
    """Returns the same surface with separate points for each cell, as in an STL file."""
    return points[cells].reshape(-1, 3), numpy.arange(cells.size).reshape(cells.shape)


class Engines(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        cls.core = load("gridfem_core", os.environ["GRIDFEM_PYTHON_DIR"])
        points, triangles = unit_sphere()
        cls.meshes = {"ellipsoid": (points * [1.0, 1.3, 0.7], triangles), "torus": open_torus(),
                      "soup": soup(*open_torus(30, 16))}

    def compare(self, call):
        """call: takes a package, a mesh, and options.

        Both engines round in the same way except for the last digit. If single precision corrects a
        solution, such a digit becomes 6e-8 of the last correction, which is small itself.
        """
        for name, (points, cells) in self.meshes.items():
            for space in (0, 1):
                with self.subTest(mesh=name, FunctionSpace=space), warnings.catch_warnings():
                    warnings.simplefilter("ignore")
                    options = {"Depth": 4, "FunctionSpace": space}
                    theirs = call(gridfem, points, cells, **options)
                    ours = call(self.core, points, cells, **options)
                    if not isinstance(ours, tuple):
                        theirs, ours = (theirs,), (ours,)
                    for a, b in zip(theirs, ours):
                        self.assertEqual(a.dtype, b.dtype)
                        self.assertEqual(a.shape, b.shape)
                        numpy.testing.assert_allclose(
                            b, a, rtol=1e-10, atol=1e-10 * max(1.0, numpy.nanmax(numpy.abs(a))))

    def test_spectrum(self):
        self.compare(lambda g, p, c, **o: g.spectrum(p, c, 8, **o)[0])
        self.compare(lambda g, p, c, **o: g.spectrum(p, c, 8, **o)[1])
        self.compare(lambda g, p, c, **o: g.spectrum(p, c, 8, ZeroBoundaryValues=True, **o)[0])

    def test_signatures(self):
        self.compare(lambda g, p, c, **o: g.signatures(p, c, 10, NumberOfScales=3, **o))

    def test_functional_map(self):
        points, triangles = self.meshes["ellipsoid"]
        bumps = 1 + 0.8 * numpy.exp(-6 * ((points - (0.6, 0.7, 0.4)) ** 2).sum(axis=1))
        surface = points * bumps[:, None]
        reference = 2 * surface + 1
        for landmarks in ((), [(3, 3), (9, 9)]):
            theirs, ours = (g.functional_map(surface, triangles, reference, triangles, landmarks, 20, Depth=4)
                            for g in (gridfem, self.core))
            for a, b in zip(theirs, ours):
                self.assertEqual((a.dtype, a.shape), (b.dtype, b.shape))
            places, corners, weights, mismatch, matrix = ours
            numpy.testing.assert_allclose(places, theirs[0], atol=1e-6)
            numpy.testing.assert_allclose((weights[:, :, None] * reference[corners]).sum(axis=1), places, atol=1e-12)
            self.assertLess(numpy.linalg.norm(places - reference, axis=1).mean(), 0.02)
            self.assertLess(mismatch.max(), 0.1)
            self.assertGreaterEqual(len(matrix), 20)
        for package in (gridfem, self.core):
            for landmarks, message in (([1, 2], "two columns"), ([(1, 10 ** 6)], "landmarks has the point 1000000"),
                                       ([(0.5, 1)], "there is 0.5")):
                with self.assertRaisesRegex(package.Error, message):
                    package.functional_map(surface, triangles, reference, triangles, landmarks, Depth=4)

    def test_expansions_and_surrogates(self):
        for columns in (0, slice(0, 2)):
            self.compare(lambda g, p, c, **o: g.expand(p, c, p[:, columns], 12, **o))
            self.compare(lambda g, p, c, **o: (g.surrogates(p, c, p[:, columns], 3, 12, Seed=4, **o),))
        self.compare(lambda g, p, c, **o: (g.surrogates(p, c, p[:, 0], 1, 12, **o),))
        self.compare(lambda g, p, c, **o: (
            g.surrogates(p, c, p[:, 0].astype(numpy.float32), 2, 12, **o).astype(float),))
        points, cells = self.meshes["ellipsoid"]
        for package in (gridfem, self.core):
            for function in (package.expand, package.surrogates):
                with self.assertRaisesRegex(package.Error, "values must have a number"):
                    function(points, cells, None)
            single = package.surrogates(points, cells, points[:, 0].astype(numpy.float32), 1, 8, Depth=4)
            self.assertEqual(single.dtype, numpy.float32)

    def test_the_depth_for_an_accuracy(self):
        self.compare(lambda g, p, c, **o: g.poisson(
            p, c, numpy.sin(4 * p[:, 0]), WantedError=0.03, **o))
        self.compare(lambda g, p, c, **o: g.spectrum(
            p, c, 5, **{**o, "Accuracy": 0.03})[0])

    def test_poisson(self):
        self.compare(lambda g, p, c, **o: g.poisson(p, c, p[:, 2], **o))
        self.compare(lambda g, p, c, **o: g.poisson(p, c, p[:, :2].astype("f"), Tolerance=1e-6, **o))
        self.compare(lambda g, p, c, **o: g.poisson(p, c, p, UseValueGradient=True, **o))
        self.compare(lambda g, p, c, **o: g.poisson(p, c, UseValueGradient=True, **o))
        self.compare(lambda g, p, c, **o: g.poisson(p, c, p[c].mean(axis=1)[:, 0], p[c[:, 0]], **o))

    def test_poisson_with_conditions(self):
        self.compare(lambda g, p, c, **o: g.poisson(p, c, p[:, 0], weights=p[:, 1] ** 2, **o))
        self.compare(lambda g, p, c, **o: g.poisson(p, c, p, held=p[:, 0] > 0.9, ScreeningWeight=1, **o))
        self.compare(lambda g, p, c, **o: g.diffuse(p, c, p, 0.01, held=p[:, 0] > 0.9, NumberOfSteps=2, **o))
        self.compare(lambda g, p, c, **o: g.poisson(p, c, held=p[:, 0] > 0.9, ScreeningWeight=1, **o))
        self.compare(lambda g, p, c, **o: g.diffuse(
            p, c, None, 0.01, held=p[:, 0] > 0.9, NumberOfSteps=2, **o))
        self.compare(lambda g, p, c, **o: g.poisson(p, c, p[:, 2], BoundaryValues=True, **o))
        self.compare(lambda g, p, c, **o: g.poisson(p, c, p[:, 2], flux=p[:, 0], ScreeningWeight=0.5, **o))
        self.compare(lambda g, p, c, **o: g.poisson(
            p, c, p[:, 0] ** 2, UseValueGradient=True, gradient_scale=1 + p[:, 1] ** 2, **o))
        self.compare(lambda g, p, c, **o: g.diffuse(p, c, p[:, 2], 0.01, source=p[:, 0] ** 2, **o))
        self.compare(lambda g, p, c, **o: g.poisson(
            p, c, numpy.where(p[:, 0] > 0, p[:, 1], numpy.nan), FillUnknown=True, **o))

    def test_distance(self):
        self.compare(lambda g, p, c, **o: g.distance(p, c, [0, len(p) // 2], **o))
        self.compare(lambda g, p, c, **o: g.distance(p, c, 5, Smoothing=3.0, **o))

    def test_nearest_source(self):
        self.compare(lambda g, p, c, **o: g.distance(p, c, [0, len(p) // 2], nearest=True, **o))

    def test_farthest_points(self):
        self.compare(lambda g, p, c, **o: g.farthest_points(p, c, 6, **o))
        self.compare(lambda g, p, c, **o: g.farthest_points(p, c, 3, FirstPointId=7, **o))

    def test_path(self):
        self.compare(lambda g, p, c, **o: g.path(p, c, [0, len(p) // 2, len(p) // 3]))
        self.compare(lambda g, p, c, **o: g.path(p, c, [2, 9, len(p) // 2], closed=True))

    def test_distance_matrix(self):
        self.compare(lambda g, p, c, **o: g.distance_matrix(p, c, [9, 0, len(p) // 2, 9]))

    def test_gaussian_field(self):
        for smoothness in (1, 2, 3):
            self.compare(lambda g, p, c, **o: g.gaussian_field(p, c, 0.3, 3, Smoothness=smoothness, **o))
        self.compare(lambda g, p, c, **o: g.gaussian_field(p, c, 0.3, 9, Statistics=True, Seed=5, **o))
        self.compare(lambda g, p, c, **o: g.gaussian_field(p, c, 0.3, 2, [0, 7], [3.0, 5.0], 0.1, **o))
        self.compare(lambda g, p, c, **o: g.gaussian_field(
            p, c, 0.3, 9, [0, 7, 0], [3.0, 5.0, 2.0], 0.1, Statistics=True, **o))

    def test_dynamics(self):
        for model in ("TuringSpots", "GrayScott", "FitzHughNagumo", "AllenCahn", "Wave"):
            self.compare(lambda g, p, c, **o: g.dynamics(p, c, model, 0.5, 2, Seed=3, Tolerance=1e-12, **o))
        self.compare(lambda g, p, c, **o: g.dynamics(
            p, c, "Transport", 0.5, 2, start=p[:, 0], velocity=p[:, [1, 2, 0]], Tolerance=1e-12, **o))
        for reactions in (("0.1 - u + u^2*v", "0.9 - u^2*v"), ("u*(1-u)",),
                          ("-u^2*u + if((u > 0.4) and (v < 0.7), sin(u), -u)", "min(u, v, 0.5)/3 - 1e-1*exp(-v)"),
                          ("-pow(u, 2)*((u > 0.1) and (u < 5) and (u != 7))", " ")):
            self.compare(lambda g, p, c, **o: g.dynamics(
                p, c, "Custom", 0.5, 2, reactions=reactions, Tolerance=1e-12, **o))

    def test_krige(self):
        self.compare(lambda g, p, c, **o: g.krige(
            p, c, [0, 7, len(p) // 2, 7], [1.0, 2.0, 5.0, 3.0], 0.3, 0.1, number=9, **o))

    def test_signed_distance(self):
        self.compare(lambda g, p, c, **o: g.signed_distance(p, c, p[:, 0] > 0.1, **o))
        self.compare(lambda g, p, c, **o: g.signed_distance(
            p, c, 5 * (p[c[:, 0], 0] > 0.1), 0, **o))

    def test_diffuse(self):
        self.compare(lambda g, p, c, **o: g.diffuse(p, c, p[:, 2], 0.01, **o))
        self.compare(lambda g, p, c, **o: g.diffuse(p, c, p[:, 2], fwhm=0.3, **o))
        frames = numpy.sin(numpy.arange(20.0))
        self.compare(lambda g, p, c, **o: g.diffuse(p, c, p[:, 2:] * frames, sigma=0.2, **o))

    def test_interpolate(self):
        for smoothness in (0, 1):
            self.compare(lambda g, p, c, **o: g.interpolate(
                p, c, [0, 7, len(p) // 2], [1.0, 2.0, 5.0], Smoothness=smoothness, **o))

    def test_stitch(self):
        def colors(values):
            return (100 + 90 * numpy.sin(3 * values)).astype(numpy.uint8)

        self.compare(lambda g, p, c, **o: g.stitch(p, c, colors(p), p[:, 1] > 0, **o))
        self.compare(lambda g, p, c, **o: g.stitch(
            p, c, 0.1 + 0.001 * numpy.arange(len(c)), p[c[:, 0], 1] > 0, BlendWidth=0.1, **o))

    def test_automatic_depth(self):
        for points, cells in self.meshes.values():
            theirs, ours = (g.poisson(points, cells, points[:, 0], Depth=0)
                            for g in (gridfem, self.core))
            numpy.testing.assert_allclose(ours, theirs, rtol=1e-9, atol=1e-9)

    def test_curvatures(self):
        self.compare(lambda g, p, c, **o: g.curvatures(p, c, **o)[:2])
        self.compare(lambda g, p, c, **o: g.curvatures(p, c, SmoothingScale=0.02, **o)[:2])

    def test_detail(self):
        self.compare(lambda g, p, c, **o: g.detail(p, c, 1.5, **o))
        self.compare(lambda g, p, c, **o: g.detail(p, c, 1.5, scales=1 + p[:, 0] ** 2, **o))
        self.compare(lambda g, p, c, **o: g.detail(p, c, 0.5, values=numpy.sin(5 * p[:, 0]), **o))
        for transfer in range(1, 5):
            self.compare(lambda g, p, c, **o: g.detail(
                p, c, TransferFunction=transfer, KeepVolume=True, **o))

    def test_flow(self):
        self.compare(lambda g, p, c, **o: g.flow(p, c, 3, **o))
        self.compare(lambda g, p, c, **o: g.flow(p, c, 3, Conformalized=True, **o))
        self.compare(lambda g, p, c, **o: g.flow(p, c, 2, TrackMetric=False, **o))
        self.compare(lambda g, p, c, **o: g.flow(p, c, 2, FixedBoundary=True, **o))

    def test_parameterization(self):
        for kind in ("Conformal", "Isometric", "Circle"):
            for index in range(4):
                self.compare(lambda g, p, c, **o: g.parameterize(p, c, MapType=kind)[index])

    def test_gradient(self):
        self.compare(lambda g, p, c, **o: g.gradient(p, c, p[:, :2] ** 2, **o))
        self.compare(lambda g, p, c, **o: g.gradient(p, c, p[c[:, 0], 0], Tolerance=1e-6, **o))
        self.compare(lambda g, p, c, **o: g.gradient(p, c, **o))
        self.compare(lambda g, p, c, **o: g.divergence(p, c, p[:, [1, 2, 0]], **o))
        self.compare(lambda g, p, c, **o: g.decompose(p, c, p[:, [1, 2, 0]], **o))

    def test_polygons(self):
        angles = numpy.linspace(0, 2 * numpy.pi, 10, endpoint=False)
        radius = numpy.where(numpy.arange(10) % 2, 1.0, 0.4)  # a star
        star = numpy.stack([radius * numpy.cos(angles), radius * numpy.sin(angles), 0 * angles], -1)
        cells = [numpy.arange(10)]
        for space in (0, 1):
            theirs, ours = (g.spectrum(star, cells, 3, Depth=4, FunctionSpace=space)[0]
                            for g in (gridfem, self.core))
            numpy.testing.assert_allclose(ours, theirs, rtol=1e-12, atol=1e-12)

    def test_properties_have_the_defaults_and_ranges_of_the_filters(self):
        module = sys.modules["gridfem_core._without_vtk"]._core
        for name in ("FarthestPoints", "FunctionalMap", "GaussianField", "GeodesicDistance", "GeodesicPaths",
                     "HarmonicInterpolation", "HeatDiffusion",
                     "LaplaceSpectrum", "MeanCurvatureFlow", "Parameterization", "PrincipalCurvatures",
                     "ScreenedPoisson", "SpectralSignatures", "StitchColors",
                     "SurfaceDetail", "SurfaceDynamics", "SurfaceGradient"):
            algorithm = getattr(vtkGridFEMFilters, "vtk" + name)()
            known = module.properties(name)
            self.assertEqual(known.keys(), {method[3:] for method in dir(algorithm) if method.startswith("Set")
                                            and has_property(algorithm, name, method[3:])})
            for key, (standard, least, most) in known.items():
                with self.subTest(filter=name, property=key):
                    self.assertEqual(standard, getattr(algorithm, "Get" + key)())
                    if hasattr(algorithm, f"Get{key}MinValue"):
                        self.assertEqual(least, getattr(algorithm, f"Get{key}MinValue")())
                        self.assertEqual(most, getattr(algorithm, f"Get{key}MaxValue")())

    def test_running_out_of_memory_gives_advice_that_fits_the_function(self):
        points, triangles = self.meshes["ellipsoid"]
        module = sys.modules["gridfem_core._without_vtk"]._core
        with unittest.mock.patch.object(module, "solve", side_effect=MemoryError):
            for call, message in (
                    (lambda g: g.distance(points, triangles, [0], Depth=9), "at Depth 9: choose a smaller"),
                    (lambda g: g.spectrum(points, triangles, Depth=0), "choose a small Depth instead of 0"),
                    (lambda g: g.path(points, triangles, [0, 9]), "memory: use a mesh with fewer polygons"),
                    (lambda g: g.parameterize(points, triangles), "memory: use a mesh with fewer polygons")):
                with self.assertRaisesRegex(self.core.Error, message):
                    call(self.core)

    def test_the_module_reads_nothing_outside_of_its_arrays(self):
        module = sys.modules["gridfem_core._without_vtk"]._core
        points, cells = self.meshes["ellipsoid"]

        def rows(count, columns=1):
            return numpy.ones((count, columns))

        for arrays in ({"held": (rows(len(cells)), False)}, {"held": (rows(len(points), 2), True)},
                       {"held": (rows(7), True)}, {"values": (rows(len(points)), False)}):
            with self.subTest(arrays), self.assertRaisesRegex(ValueError, "row|number for each point"):
                module.solve("ScreenedPoisson", points, cells, arrays, {"Depth": 3}, [], [])
        with self.assertRaisesRegex(ValueError, "values needs a row for each point"):
            module.solve(
                "HarmonicInterpolation", points, cells, {"values": (rows(len(cells)), False)},
                {"Depth": 3}, [], [])

    def test_arrays_of_other_data_sets_of_vtk(self):
        """The surface of a volume mesh, and triangles of strips."""
        ball, volume, strips = vtkSphereSource(), vtkDelaunay3D(), vtkStripper()
        ball.Update()
        for filter_ in (volume, strips):
            filter_.SetInputConnection(ball.GetOutputPort())
            filter_.Update()
        self.assertGreater(strips.GetOutput().GetNumberOfStrips(), 0)
        expected = areas(*gridfem.arrays(ball.GetOutput())).sum()
        for package in (gridfem, self.core):
            for data in (volume.GetOutput(), strips.GetOutput()):
                points, cells = package.arrays(data)
                self.assertEqual(cells.shape[1], 3)
                self.assertAlmostEqual(areas(points, cells).sum(), expected, delta=1e-6)

    def test_choices_are_as_many_as_the_filters_have(self):
        owners = {"Amount": "HeatDiffusion", "Device": "ScreenedPoisson",
                  "FilterType": "SpectralSignatures", "Rescale": "MeanCurvatureFlow",
                  "Smoothness": "HarmonicInterpolation", "TransferFunction": "SurfaceDetail",
                  "FunctionSpace": "ScreenedPoisson", "MapType": "Parameterization", "Model": "SurfaceDynamics",
                  "PathType": "GeodesicPaths", "ParameterUnits": "ScreenedPoisson"}
        choices = sys.modules["gridfem_core._inputs"].CHOICES
        self.assertEqual(choices.keys(), owners.keys())
        for choice, names in choices.items():
            owner = getattr(vtkGridFEMFilters, "vtk" + owners[choice])
            self.assertEqual(getattr(owner(), f"Get{choice}MaxValue")(), len(names) - 1)

    def test_a_number_takes_no_choice_of_another_filter(self):
        points, triangles = self.meshes["ellipsoid"]
        for package in (gridfem, self.core):
            with self.assertRaisesRegex(package.Error, "Smoothness = 'Biharmonic': must be a number"):
                package.gaussian_field(points, triangles, 0.5, Smoothness="Biharmonic", Depth=4)

    def test_colors_of_both_are_the_same(self):
        points, triangles = unit_sphere()
        colors = (127.5 * (points + 1)).astype(numpy.uint8)
        for call in (lambda g: g.poisson(points, triangles, colors, Depth=5),
                     lambda g: g.detail(points, triangles, 3.0, values=colors, Depth=5)):
            ours, theirs = call(self.core), call(gridfem)
            self.assertEqual(ours.dtype, theirs.dtype)
            numpy.testing.assert_allclose(ours.astype(int), theirs.astype(int), atol=1)  # rounding

    def test_arrays_of_a_surface_are_those_it_was_made_of(self):
        for points, cells in self.meshes.values():
            for given, expected in zip(self.core.arrays(gridfem.surface(points, cells)),
                                       (points, cells)):
                numpy.testing.assert_array_equal(given, expected)

    def test_messages(self):
        points, triangles = unit_sphere()
        calls = {
            "refused values": lambda g: g.poisson(points, triangles, points[:, 0] / 0 * 0),
            "no values": lambda g: g.interpolate(points, triangles, [0], [numpy.nan]),
            "source": lambda g: g.distance(points, triangles, len(points)),
            "property": lambda g: g.detail(points, triangles, Dept=3),
            "range": lambda g: g.detail(points, triangles, SmoothingScale=-1.0),
            "degree": lambda g: g.flow(points, triangles, QuadratureDegree=3),
            "symbol": lambda g: g.dynamics(points, triangles, "Custom", reactions=("u", "u*w")),
            "blank": lambda g: g.dynamics(points, triangles, "Custom", reactions=(" ", "v")),
            "undefined": lambda g: g.dynamics(points, triangles, "Custom", reactions="log(u - 9)", steps=1),
            "variable": lambda g: g.dynamics(points, triangles, "Custom", reactions="u*v"),
            "no reactions": lambda g: g.dynamics(points, triangles, "Custom"),
            "named reactions": lambda g: g.dynamics(points, triangles, "Wave", reactions="u"),
            "gradients": lambda g: g.poisson(points, triangles, points, points),
            "error": lambda g: g.poisson(
                points, triangles, points, FunctionSpace=1, WantedError=1e-6),
            "accuracy": lambda g: g.spectrum(
                points, triangles, 5, FunctionSpace=1, Accuracy=2e-3),
            "plane": lambda g: g.spectrum(points * [1, 1, 0] * 0, triangles),
            "iterations": lambda g: g.spectrum(
                points, triangles, 9, Depth=4, MaximumIterations=1, Tolerance=1e-14)}
        for name, call in calls.items():
            with self.subTest(name), numpy.errstate(all="ignore"):
                self.assertEqual(self.message(gridfem, call), self.message(self.core, call))

    def message(self, package, call):
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            try:
                call(package)
            except package.Error as error:
                return str(error)
        return [str(warning.message) for warning in caught]

    def test_misuse_of_arrays_raises(self):
        for message, call in misuses(self.core, *unit_sphere()).items():
            with self.subTest(message=message), self.assertRaisesRegex(self.core.Error, message):
                call()


if __name__ == "__main__":
    if "GRIDFEM_PYTHON_DIR" not in os.environ:
        sys.exit(77)
    unittest.main()
