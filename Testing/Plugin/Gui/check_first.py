"""Checks the pictures and arrays of TestGuiFirstApply.sh. Every view shows a surface that is changed
only gently and has the array of the input. The colors do not depend on earlier filters.
"""
import os
import sys
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir))

from paraview import simple

import plugin

FOLDER = sys.argv[1]
RESULTS = {"ScreenedPoisson": "Solution", "HeatDiffusion": "Diffused", "SurfaceGradient": "Gradient",
           "StitchColors": "StitchedColors"}
CHOICES = {"ScreenedPoisson": "ValueArray", "HeatDiffusion": "Array", "SurfaceGradient": "Array",
           "StitchColors": "ColorArray"}


class FirstApply(unittest.TestCase):
    def load(self, state, name):
        """Returns a filter of a state, and the representation that shows it."""
        simple.ResetSession()
        simple.LoadState(f"{FOLDER}/{state}.pvsm")
        proxy = simple.FindSource(name + "1")
        shown = [part for view in simple.GetViews() for part in view.Representations
                 if getattr(part, "Visibility", 0) and hasattr(part, "ColorArrayName")
                 and part.Input in (proxy, simple.OutputPort(proxy, 0))]
        self.assertEqual(len(shown), 1)
        proxy.UpdatePipeline(simple.GetAnimationScene().AnimationTime)
        return proxy, shown[0]

    def assert_symmetric(self, proxy, shown):
        """Asserts that the colors go as far as the values, with 0 in the middle."""
        low, high = proxy.PointData[shown.ColorArrayName[1]].GetRange()
        points = shown.LookupTable.RGBPoints
        self.assertEqual(points[0], -points[-4])
        self.assertAlmostEqual(points[-4], max(-low, high), delta=1e-6 * points[-4])

    def test_nothing_is_empty(self):
        for name in plugin.PROXIES:
            with self.subTest(filter=name):
                proxy, _ = self.load(f"raw.{name}", name)
                self.assertGreaterEqual(proxy.GetDataInformation().GetNumberOfPoints(), 1682)

    def test_a_shape_is_smoothed_gently_and_colored_by_its_own_change(self):
        for name in ("ScreenedPoisson", "HeatDiffusion", "SurfaceDetail"):
            with self.subTest(filter=name):
                proxy, shown = self.load(f"raw.{name}", name)
                self.assertEqual(shown.ColorArrayName[1], "NormalDisplacement")
                self.assert_symmetric(proxy, shown)
                farthest = max(abs(end) for end in proxy.PointData["NormalDisplacement"].GetRange())
                self.assertGreater(farthest, 0)
                self.assertLess(farthest, 0.02 * 2)  # of the diameter

    def test_an_example_of_values_is_interpolated(self):
        proxy, shown = self.load("raw.HarmonicInterpolation", "HarmonicInterpolation")
        table = list(proxy.KnownValues)
        self.assertEqual(table[1::2], [0, 1, 2, 3])
        self.assertEqual(shown.ColorArrayName[1], "Interpolated")
        values = plugin.data(proxy).GetPointData().GetArray("Interpolated")
        for point, value in zip(table[0::2], table[1::2]):
            self.assertAlmostEqual(values.GetTuple1(int(point)), value, delta=1e-5)

    def test_the_array_of_the_input_is_chosen(self):
        for file, array in (("one", "height"), ("colors", "RGB")):
            for name, key in CHOICES.items():
                if os.path.exists(f"{FOLDER}/{file}.{name}.pvsm"):
                    with self.subTest(file=file, filter=name):
                        proxy, shown = self.load(f"{file}.{name}", name)
                        self.assertEqual(list(getattr(proxy, key)), ["POINTS", array])
                        if name != "StitchColors":  # it lacks labels, and passes on
                            self.assertEqual(shown.ColorArrayName[1], RESULTS[name])
                            self.assertEqual(shown.MapScalars, int(array != "RGB"))

    def test_modes_have_their_own_range_whatever_was_played(self):
        proxy, shown = self.load("raw.ModesPlayed", "LaplaceSpectrum")
        self.assertEqual(simple.GetAnimationScene().AnimationTime, 1)
        self.assert_symmetric(proxy, shown)

    def test_all_modes_are_colored(self):
        for state, array in (("raw.AllModes", "Mode001"), ("raw.OtherMode", "Mode003")):
            proxy, shown = self.load(state, "LaplaceSpectrum")
            self.assertEqual(shown.ColorArrayName[1], array)
            self.assert_symmetric(proxy, shown)

    def test_the_chart_of_the_flow_has_the_steps_of_the_animation(self):
        self.load("raw.MeanCurvatureFlow", "MeanCurvatureFlow")
        charts = [part for view in simple.GetViews() for part in view.Representations
                  if hasattr(part, "XArrayName")]
        self.assertEqual([(chart.XArrayName, chart.UseIndexForXAxis) for chart in charts], [("Step", 0)])
        self.assertEqual(simple.GetAnimationScene().AnimationTime, 10)

    def test_charts_close_with_their_filter(self):
        for state, views in (("raw.LaplaceSpectrum", 2), ("raw.Closed", 1), ("raw.PrincipalCurvatures", 1)):
            simple.ResetSession()
            simple.LoadState(f"{FOLDER}/{state}.pvsm")
            self.assertEqual(len(simple.GetViews()), views)
            self.assertEqual(len(simple.GetViewsInLayout()), views)

    def test_sources_are_chosen_in_the_panel(self):
        proxy, _ = self.load("colors.Sources", "GeodesicDistance")
        self.assertEqual(proxy.Sources, simple.FindSource("raw.vtp"))
        self.assertEqual(proxy.PointData["Distance"].GetRange(), (0, 0))  # the same points

    def test_an_example_of_the_help_menu_is_loaded(self):
        simple.ResetSession()
        simple.LoadState(f"{FOLDER}/example.pvsm")
        paths = [proxy for proxy in simple.GetSources().values() if proxy.SMProxy.GetXMLName() == "GeodesicPaths"]
        self.assertGreater(len(paths), 0)
        self.assertGreater(plugin.data(paths[0], 1).GetNumberOfLines(), 0)


if __name__ == "__main__":
    plugin.load()
    unittest.main(argv=sys.argv[:1])
