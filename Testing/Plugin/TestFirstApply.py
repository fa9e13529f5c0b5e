"""Tests the first view of a filter that is applied to a mesh with all its defaults."""
import unittest

from paraview import servermanager, simple
from paraview.modules.vtkRemotingViews import vtkSMParaViewPipelineControllerWithRendering

import plugin

DEPTH = 4

# The arrays that color a filter by the hints of its panel. A filter without an entry may show
# any array of its output.
COLORED_BY = {
    "ClipToOctree": ("CELLS", "OctreeCellColor"),
    "ConnectivityAwareBasis": ("CELLS", "PatchColor"),
    "FarthestPoints": ("POINTS", "Distance"),
    "FunctionalMap": ("POINTS", "MatchingColors"),
    "GaussianField": ("POINTS", "Sample000"),
    "GeodesicDistance": ("POINTS", "Distance"),
    "GeodesicPaths": (None, ""),  # the lines have the colors
    "HarmonicInterpolation": ("POINTS", "Interpolated"),
    "HeatDiffusion": ("POINTS", "NormalDisplacement"),
    "LaplaceSpectrum": ("POINTS", "Mode"),
    "MeanCurvatureFlow": (None, ""),  # the shape itself moves
    "Parameterization": ("CELLS", "AreaDistortion"),
    "PrincipalCurvatures": ("POINTS", "Bending"),
    "ScreenedPoisson": ("POINTS", "NormalDisplacement"),
    "SpectralSignatures": ("POINTS", "Signature"),
    "StitchColors": ("POINTS", "StitchedColors"),
    "SurfaceDetail": ("POINTS", "NormalDisplacement"),
    "SurfaceDynamics": ("POINTS", "U"),
    "SurfaceGradient": ("POINTS", "Laplacian")}
ZERO_IN_THE_MIDDLE = ("AreaDistortion", "Bending", "Mode", "NormalDisplacement", "Sample000")

# Signed arrays that a filter has besides the one that colors it first.
SIGNED = {"PrincipalCurvatures": ("MeanCurvature", "GaussianCurvature", "ShapeIndex", "MinimumCurvature",
                                  "MaximumCurvature"),
          "SurfaceGradient": ("Laplacian",)}

SHOWN_PORTS = {"ClipToOctree": {0, 2}, "FunctionalMap": {0, 1}, "GeodesicPaths": {0, 1}, "LaplaceSpectrum": {0, 1, 2},
               "MeanCurvatureFlow": {0, 1, 2}, "Parameterization": {0, 1}}


class FirstApply(unittest.TestCase):

    def setUp(self):
        self.surface = plugin.sphere()

    def tearDown(self):
        simple.ResetSession()

    def apply(self, name, surface=None, **properties):
        surface = surface or self.surface
        if name in plugin.CHOICES:
            surface = plugin.with_arrays(surface)
        proxy = getattr(simple, name)(
            Input=surface, **plugin.choices(name), **properties)
        for prop, value in (("Depth", DEPTH), ("NumberOfModes", 16)):
            if prop in proxy.ListProperties():
                proxy.SetPropertyWithName(prop, value)
        proxy.UpdatePipeline()
        return proxy

    def test_every_filter_colors_by_what_it_is_for(self):
        view = simple.CreateRenderView()
        for name in plugin.PROXIES:
            with self.subTest(proxy=name):
                proxy = self.apply(name)
                association, array = simple.Show(proxy, view).ColorArrayName
                wanted, colors = plugin.colors_of(name)
                self.assertEqual(array, wanted)
                self.assertEqual((association, array), COLORED_BY.get(name, (association, array)))
                if array in ZERO_IN_THE_MIDDLE:
                    self.assertEqual(colors, "diverging")
                if array:
                    data = {"POINTS": proxy.PointData, "CELLS": proxy.CellData}[association]
                    self.assertIn(array, data.keys())

    def test_a_colored_input_changes_no_choice(self):
        """The input's own active array does not hide the result."""
        colored = simple.Calculator(Input=self.surface, ResultArrayName="f", Function="coordsX*coordsY")
        view = simple.CreateRenderView()
        for name in plugin.PROXIES:
            wanted, _ = plugin.colors_of(name)
            if wanted and wanted == COLORED_BY.get(name, (None, wanted))[1]:
                with self.subTest(proxy=name):
                    shown = simple.Show(self.apply(name, colored), view)
                    self.assertEqual(shown.ColorArrayName[1], wanted)

    def test_only_what_helps_is_opened(self):
        controller = vtkSMParaViewPipelineControllerWithRendering()
        for name in plugin.PROXIES:
            with self.subTest(proxy=name):
                proxy = self.apply(name)
                opened = {port for port in range(proxy.SMProxy.GetNumberOfOutputPorts())
                          if controller.GetPreferredViewType(proxy.SMProxy, port) != "None"}
                self.assertEqual(opened, SHOWN_PORTS.get(name, {0}))

    def test_the_spectrum_has_as_many_modes_as_asked_for_in_a_marked_line(self):
        spectrum = simple.LaplaceSpectrum(Input=self.surface, Depth=DEPTH)
        self.assertEqual(plugin.data(spectrum, 1).GetNumberOfRows(), 20)
        chart = simple.Show(simple.OutputPort(spectrum, 1), simple.CreateView("XYChartView"))
        styles = list(chart.SeriesLineStyle)
        marks = list(chart.SeriesMarkerStyle)
        self.assertEqual(styles[styles.index("Eigenvalue") + 1], "0")
        self.assertEqual(marks[marks.index("Eigenvalue") + 1], "4")

    def test_axes_of_charts_have_titles_and_keep_those_of_the_user(self):
        for name, bottom, left in (("LaplaceSpectrum", "Mode", "Eigenvalue"),
                                   ("MeanCurvatureFlow", "Step", "Sphericity"),
                                   ("ScreenedPoisson", "Iteration", "log10 of the relative error")):
            proxy = self.apply(name)
            for own in ("", "mine"):
                with self.subTest(proxy=name, own=own):
                    view = simple.CreateView("XYChartView")
                    view.LeftAxisTitle = own
                    simple.Show(simple.OutputPort(proxy, 1), view)
                    view.Update()
                    self.assertEqual((view.BottomAxisTitle, view.LeftAxisTitle), (bottom, own or left))
                    view.BottomAxisTitle = ""
                    view.Update()
                    self.assertEqual(view.BottomAxisTitle, "")

    def test_a_script_keeps_its_time_and_its_view(self):
        flow = simple.MeanCurvatureFlow(Input=self.surface, Depth=DEPTH)
        simple.Show(flow, simple.CreateRenderView())
        chart = simple.CreateView("XYChartView")
        simple.Show(simple.OutputPort(flow, 1), chart)
        chart.Update()
        self.assertEqual(simple.GetActiveView(), chart)
        self.assertEqual(simple.GetAnimationScene().AnimationTime, 0.0)

    def test_components_of_signatures_bear_their_times(self):
        array = plugin.data(self.apply("SpectralSignatures")).GetPointData().GetArray(
            "HeatKernelSignature")
        self.assertRegex(array.GetComponentName(0), r"^t = [0-9.e+-]+$")

    def test_other_data_sets_and_blocks(self):
        other = simple.Sphere(Center=[5, 0, 0], ThetaResolution=40, PhiResolution=20)
        grid = simple.AppendDatasets(Input=[self.surface])
        blocks = simple.GroupDatasets(Input=[grid, other])
        for name in plugin.PROXIES:
            if name in plugin.CHOICES:
                continue
            with self.subTest(proxy=name):
                self.assertGreater(plugin.data(self.apply(name, grid)).GetNumberOfPoints(), 700)
                data = plugin.data(self.apply(name, blocks))
                self.assertEqual(data.GetNumberOfBlocks(), 2)
                sizes = [data.GetBlock(block).GetNumberOfPoints() for block in (0, 1)]
                self.assertGreater(min(sizes), 700)

    def test_blocks_have_the_steps_of_the_filter(self):
        blocks = simple.GroupDatasets(
            Input=[self.surface, simple.Sphere(Center=[5, 0, 0], ThetaResolution=40,
                                               PhiResolution=20)])
        flow = simple.MeanCurvatureFlow(Input=blocks, Depth=DEPTH, NumberOfSteps=3, TimeStep=2e-3)
        sizes = []
        for step in (0, 3, 1):
            flow.UpdatePipeline(float(step))
            data = servermanager.Fetch(flow)
            bounds = [data.GetBlock(block).GetBounds() for block in (0, 1)]
            sizes.append([box[1] - box[0] for box in bounds])
        flow.UpdatePipelineInformation()
        self.assertEqual(list(flow.TimestepValues), [0, 1, 2, 3])
        for start, last, first in zip(*sizes):
            self.assertLess(last, first)
            self.assertLess(first, start)
        modes = simple.LaplaceSpectrum(Input=blocks, Depth=DEPTH, NumberOfModes=9)
        ranges = set()
        for mode in (1, 4, 8):
            modes.UpdatePipeline(float(mode))
            ranges.add(servermanager.Fetch(modes).GetBlock(1).GetPointData().GetArray(
                "Mode").GetRange())
        self.assertEqual(len(ranges), 3)

    def test_blocks_as_one_surface(self):
        """Halves of a sphere: every filter returns each half, and distances cross the border."""
        middle = simple.PointDatatoCellData(Input=simple.Calculator(
            Input=self.surface, ResultArrayName="z", Function="coordsZ"))
        blocks = simple.GroupDatasets(Input=[
            simple.Threshold(Input=middle, Scalars=["CELLS", "z"], LowerThreshold=low,
                             UpperThreshold=low + 2) for low in (-2, 0)])
        for name in plugin.PROXIES:
            if name in plugin.CHOICES:
                continue
            with self.subTest(proxy=name):
                proxy = self.apply(name, blocks, BlocksAsOne=1)
                data = plugin.data(proxy)
                sizes = [data.GetBlock(block).GetNumberOfPoints() for block in (0, 1)]
                if name in ("ClipToOctree", "ConnectivityAwareBasis"):
                    self.assertGreater(sizes[0], 700)
                    self.assertEqual(sizes[1], 0)
                else:
                    self.assertGreater(min(sizes), 300)
        distance = plugin.data(self.apply("GeodesicDistance", blocks, BlocksAsOne=1))
        farthest = [distance.GetBlock(block).GetPointData().GetArray("Distance").GetRange()[1]
                    for block in (0, 1)]
        self.assertAlmostEqual(max(farthest), 3.14, delta=0.1)

    def test_a_block_without_the_array_is_passed_on_and_the_others_are_solved(self):
        values = simple.Calculator(Input=self.surface, ResultArrayName="f", Function="coordsX")
        blocks = simple.GroupDatasets(Input=[simple.Sphere(Center=[5, 0, 0]), values])
        poisson = simple.ScreenedPoisson(Input=blocks, ValueArray=["POINTS", "f"], Depth=DEPTH)
        data = plugin.data(poisson)
        self.assertGreater(data.GetBlock(0).GetNumberOfPoints(), 0)
        self.assertFalse(data.GetBlock(0).GetPointData().HasArray("Solution"))
        self.assertTrue(data.GetBlock(1).GetPointData().HasArray("Solution"))


class ColorMaps(unittest.TestCase):
    """The colors of the arrays: a map for each name, made when a filter first has the array."""

    def setUp(self):
        self.view = simple.CreateRenderView()
        sphere = plugin.sphere()
        # Higher above than below, so that ranges are not even by themselves.
        self.surface = simple.Calculator(
            Input=sphere, ResultArrayName="moved", CoordinateResults=1,
            Function="coords*(1+0.3*exp(2*coordsZ-2))")

    def tearDown(self):
        simple.ResetSession()

    def show(self, proxy):
        proxy.UpdatePipeline()
        shown = simple.Show(proxy, self.view)
        shown.RescaleTransferFunctionToDataRange(True, False)  # as Apply does: grow, unless locked
        return shown.LookupTable

    @staticmethod
    def limits(colors):
        return colors.RGBPoints[0], colors.RGBPoints[-4]

    def assert_fits(self, colors, proxy, name):
        """Asserts that the colors of a signed array go as far as its values, with 0 in the middle."""
        low, high = self.limits(colors)
        data = plugin.data(proxy).GetPointData().GetArray(name).GetRange()
        self.assertNotAlmostEqual(data[0], -data[1])
        self.assertEqual(low, -high)
        self.assertAlmostEqual(high, max(-data[0], data[1]), delta=1e-6 * high)  # single precision

    @staticmethod
    def color_by(shown, name):
        """Colors by a point array, as the list in the toolbar does."""
        shown.SetScalarColoring(name, servermanager.GetAssociationFromString("POINTS"))
        shown.RescaleTransferFunctionToDataRange(True, False)

    def test_every_mode_has_its_own_range_whatever_was_shown_before(self):
        spectrum = simple.LaplaceSpectrum(Input=self.surface, Depth=DEPTH, NumberOfModes=6, Mode=1)
        for mode in (1, 4, 2, 1):
            spectrum.Mode = mode
            self.assert_fits(self.show(spectrum), spectrum, "Mode")
        spectrum.Mode = -1
        for time in (4.0, 1.0):
            spectrum.UpdatePipeline(time)
            colors = simple.Show(spectrum, self.view).LookupTable
            low, high = self.limits(colors)
            data = spectrum.PointData["Mode"].GetRange()
            self.assertEqual(low, -high)
            self.assertAlmostEqual(high, max(-data[0], data[1]), delta=1e-6 * high)

    def test_all_modes_have_zero_in_the_middle_and_the_constant_is_not_first(self):
        spectrum = simple.LaplaceSpectrum(
            Input=self.surface, Depth=DEPTH, NumberOfModes=6, AllModes=1)
        self.assertEqual(plugin.data(spectrum).GetPointData().GetScalars().GetName(), "Mode001")
        shown = simple.Show(spectrum, self.view)
        for name in ("Mode001", "Mode004"):
            self.color_by(shown, name)
            self.assert_fits(shown.LookupTable, spectrum, name)

    def test_zero_is_in_the_middle_for_every_signed_array(self):
        values = simple.Calculator(Input=self.surface, ResultArrayName="f", Function="exp(coordsX)")
        for name, arrays in SIGNED.items():
            proxy = getattr(simple, name)(Input=values)
            if name == "SurfaceGradient":
                proxy.Array = ["POINTS", "f"]
                proxy.Depth = DEPTH
            self.show(proxy)
            shown = simple.Show(proxy, self.view)
            for array in arrays:
                with self.subTest(array=array):
                    self.color_by(shown, array)
                    self.assert_fits(shown.LookupTable, proxy, array)

    def test_a_filter_does_not_inherit_the_range_of_a_deleted_one(self):
        """The range of one that is still visible counts, and only as long as it is."""
        large = simple.SurfaceDetail(Input=self.surface, Depth=DEPTH, DetailScale=5)
        self.show(large)
        small = simple.SurfaceDetail(Input=self.surface, Depth=DEPTH, DetailScale=1.1)
        colors = self.show(small)
        self.assert_fits(colors, large, "NormalDisplacement")
        simple.Hide(large, self.view)
        small.DetailScale = 1.2
        self.assert_fits(self.show(small), small, "NormalDisplacement")
        for proxy in (large, small):
            simple.Delete(proxy)
        last = simple.SurfaceDetail(Input=self.surface, Depth=DEPTH, DetailScale=1.05)
        self.assert_fits(self.show(last), last, "NormalDisplacement")

    def test_the_range_of_an_input_that_stays_visible_counts(self):
        """Apply hides the input in the active view. Another view still shows it."""
        large = simple.SurfaceDetail(Input=self.surface, Depth=DEPTH, DetailScale=5)
        self.show(large)
        other = simple.CreateRenderView()
        simple.Show(large, other)
        simple.SetActiveView(self.view)
        small = simple.SurfaceDetail(Input=large, Depth=DEPTH, DetailScale=1.1)
        self.assert_fits(self.show(small), large, "NormalDisplacement")
        for view in other, self.view:
            simple.Hide(large, view)
        small.DetailScale = 1.2
        self.assert_fits(self.show(small), small, "NormalDisplacement")

    def test_results_with_a_prefix_have_the_colors(self):
        for prefix in ("first_", "a b."):
            with self.subTest(prefix=prefix):
                detail = simple.SurfaceDetail(Input=self.surface, Depth=DEPTH, ResultPrefix=prefix)
                for scale in (5, 1.1):
                    detail.DetailScale = scale
                    self.assert_fits(self.show(detail), detail, prefix + "NormalDisplacement")
                distance = simple.GeodesicDistance(Input=self.surface, Depth=DEPTH, ResultPrefix=prefix)
                self.assertEqual(len(self.show(distance).RGBPoints), 4 * 40)  # twenty stripes

    def test_magnitudes_run_from_dark_to_light(self):
        values = simple.Calculator(Input=self.surface, ResultArrayName="f", Function="coordsX")
        gradient = simple.SurfaceGradient(Input=values, Array=["POINTS", "f"], Depth=DEPTH)
        shown = simple.Show(gradient, self.view)
        self.assertEqual(shown.ColorArrayName[1], "Gradient")
        self.assertEqual(self.brightness(shown.LookupTable), sorted(self.brightness(shown.LookupTable)))

    def test_a_range_of_the_user_is_left_alone(self):
        spectrum = simple.LaplaceSpectrum(Input=self.surface, Depth=DEPTH, NumberOfModes=6, Mode=1)
        colors = self.show(spectrum)
        colors.RescaleTransferFunction(-7.0, 8.0)
        spectrum.Mode = 3
        self.show(spectrum)
        self.assertEqual(self.limits(colors), (-7.0, 8.0))
        colors.RescaleTransferFunction(-0.25, 0.25)
        colors.AutomaticRescaleRangeMode = "Never"
        spectrum.Mode = 2
        self.show(spectrum)
        self.assertEqual(self.limits(colors), (-0.25, 0.25))

    def test_a_color_map_of_the_user_is_left_alone(self):
        colors = simple.GetColorTransferFunction("Distance")
        colors.ApplyPreset("Black-Body Radiation", True)  # a name of all versions
        expected = list(colors.RGBPoints)[1:4]
        shown = self.show(simple.GeodesicDistance(Input=self.surface, Depth=DEPTH))
        self.assertEqual(list(shown.RGBPoints)[1:4], expected)

    @staticmethod
    def brightness(colors):
        points = list(colors.RGBPoints)
        return [sum(points[k + 1:k + 4]) for k in range(0, len(points), 4)]

    def test_distances_run_from_dark_to_light_in_stripes(self):
        """Each stripe has two ends of one color. The plain and the shaded stripes become lighter."""
        colors = self.show(simple.GeodesicDistance(Input=self.surface, Depth=DEPTH))
        brightness = self.brightness(colors)
        self.assertEqual(brightness[0::2], brightness[1::2])
        stripes = brightness[0::2]
        self.assertEqual(len(stripes), 20)
        for kind in (stripes[0::2], stripes[1::2]):
            self.assertEqual(kind, sorted(kind))
        for plain, shaded in zip(stripes[2::2], stripes[1::2]):
            self.assertLess(shaded, 0.9 * plain)
        self.assertEqual(self.limits(colors)[0], 0.0)

    def test_signed_distances_are_zero_in_the_middle(self):
        line = simple.Slice(Input=self.surface)
        line.SliceType.Origin = [0.4, 0, 0]
        colors = self.show(simple.GeodesicDistance(
            Input=self.surface, Sources=line, Signed=1, Depth=DEPTH))
        low, high = self.limits(colors)
        self.assertLess(low, 0.0)
        self.assertEqual(low, -high)

    def test_whole_numbers_have_a_color_each(self):
        for proxy, sizes in ((simple.ClipToOctree(Input=self.surface, Depth=DEPTH), {8}),
                             (simple.ConnectivityAwareBasis(Input=self.surface, Depth=DEPTH), {8, 16})):
            colors = self.show(proxy)
            self.assertIn(colors.NumberOfTableValues, sizes)
            self.assertEqual(self.limits(colors), (0, colors.NumberOfTableValues - 1))
            table = {tuple(colors.RGBPoints[k + 1:k + 4]) for k in range(0, len(colors.RGBPoints), 4)}
            self.assertEqual(len(table), colors.NumberOfTableValues)


if __name__ == "__main__":
    plugin.load()
    unittest.main()
