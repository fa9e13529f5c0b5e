"""Checks the pictures and arrays of TestGuiFirstApply.sh. Every view shows a surface that is changed
only gently and has the array of the input. The colors do not depend on earlier filters.
"""
import functools
import math
import os
import sys
import types
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir))

from paraview import simple

import plugin
from events import PLACE

FOLDER = sys.argv[1]
RESULTS = {"ScreenedPoisson": "Solution", "HeatDiffusion": "Diffused", "SurfaceGradient": "Gradient",
           "StitchColors": "StitchedColors"}
CHOICES = {"ScreenedPoisson": "ValueArray", "HeatDiffusion": "Array", "SurfaceGradient": "Array",
           "StitchColors": "ColorArray"}


def colors_of(surface):
    """Returns what colors a surface: the name of an array, the ends of its color map, and whether the
    map is used."""
    name = surface.ColorArrayName[1]
    points = surface.LookupTable.RGBPoints if surface.LookupTable else [None] * 4
    return name, (points[0], points[-4]), surface.MapScalars


@functools.lru_cache(maxsize=None)
def look(state, name=""):
    """Loads a state and returns what there is to see, with what a filter puts out. To load takes a
    second, so this is done once for all tests."""
    plugin.clear()
    simple.LoadState(f"{FOLDER}/{state}.pvsm")
    parts = [part for view in simple.GetViews() for part in view.Representations
             if getattr(part, "Visibility", 0)]
    seen = types.SimpleNamespace(
        time=simple.GetAnimationScene().AnimationTime,
        views=(len(simple.GetViews()), len(simple.GetViewsInLayout())),
        axes=[(part.XArrayName, part.UseIndexForXAxis) for part in parts if hasattr(part, "XArrayName")])
    if not name:
        return seen
    proxy = simple.FindSource(name + "1")
    surfaces = [part for part in parts if hasattr(part, "ColorArrayName")
                and part.Input in (proxy, simple.OutputPort(proxy, 0))]
    assert len(surfaces) == 1, f"{state}: {len(surfaces)} surfaces are shown"
    proxy.UpdatePipeline(seen.time)
    seen.array, seen.ends, seen.maps = colors_of(surfaces[0])
    result = proxy.GetClientSideObject().GetOutputDataObject(0)
    seen.data = result.NewInstance()
    seen.data.ShallowCopy(result)
    keys = ("ValueArray", "Array", "ColorArray", "KnownValues")
    seen.chosen = {key: list(getattr(proxy, key)) for key in keys if hasattr(proxy, key)}
    seen.sources = getattr(proxy, "Sources", None) == simple.FindSource("raw.vtp")
    return seen


def range_of(seen, array):
    return seen.data.GetPointData().GetArray(array).GetRange()


class FirstApply(unittest.TestCase):
    def assert_symmetric(self, seen):
        """Asserts that the colors go as far as the values, with 0 in the middle."""
        low, high = range_of(seen, seen.array)
        begin, end = seen.ends
        self.assertEqual(begin, -end)
        self.assertAlmostEqual(end, max(-low, high), delta=1e-6 * end)

    def test_nothing_is_empty(self):
        for name in plugin.PROXIES:
            with self.subTest(filter=name):
                self.assertGreaterEqual(look(f"raw.{name}", name).data.GetNumberOfPoints(), 1682)

    def test_a_shape_is_smoothed_gently_and_colored_by_its_own_change(self):
        for name in ("ScreenedPoisson", "HeatDiffusion", "SurfaceDetail"):
            with self.subTest(filter=name):
                seen = look(f"raw.{name}", name)
                self.assertEqual(seen.array, "NormalDisplacement")
                self.assert_symmetric(seen)
                farthest = max(abs(end) for end in range_of(seen, "NormalDisplacement"))
                self.assertGreater(farthest, 0)
                self.assertLess(farthest, 0.02 * 2)  # of the diameter

    def test_an_example_of_values_is_interpolated(self):
        seen = look("raw.HarmonicInterpolation", "HarmonicInterpolation")
        table = seen.chosen["KnownValues"]
        self.assertEqual(table[1::2], [0, 1, 2, 3])
        self.assertEqual(seen.array, "Interpolated")
        values = seen.data.GetPointData().GetArray("Interpolated")
        for point, value in zip(table[0::2], table[1::2]):
            self.assertAlmostEqual(values.GetTuple1(int(point)), value, delta=1e-5)

    def test_both_surfaces_of_a_map_have_matching_colors(self):
        plugin.clear()
        simple.LoadState(f"{FOLDER}/colors.Reference.pvsm")
        parts = [part for view in simple.GetViews() for part in view.Representations
                 if getattr(part, "Visibility", 0) and hasattr(part, "ColorArrayName")]
        inputs = [part.SMProxy.GetProperty("Input") for part in parts]
        matched = simple.FindSource("FunctionalMap1").SMProxy
        shown = [part for part, of in zip(parts, inputs) if of.GetProxy(0) == matched]
        self.assertEqual([part.SMProxy.GetProperty("Input").GetOutputPortForConnection(0) for part in shown], [0, 1])
        for part in shown:
            self.assertEqual(list(part.ColorArrayName), ["POINTS", "MatchingColors"])
            self.assertEqual(part.MapScalars, 0)

    def test_the_array_of_the_input_is_chosen(self):
        for file, array in (("one", "height"), ("colors", "RGB")):
            for name, key in CHOICES.items():
                if os.path.exists(f"{FOLDER}/{file}.{name}.pvsm"):
                    with self.subTest(file=file, filter=name):
                        seen = look(f"{file}.{name}", name)
                        self.assertEqual(seen.chosen[key], ["POINTS", array])
                        if name != "StitchColors":  # it lacks labels, and passes on
                            self.assertEqual(seen.array, RESULTS[name])
                            self.assertEqual(seen.maps, int(array != "RGB"))

    def test_modes_have_their_own_range_whatever_was_played(self):
        seen = look("raw.ModesPlayed", "LaplaceSpectrum")
        self.assertEqual(seen.time, 1)
        self.assert_symmetric(seen)

    def test_all_modes_are_colored(self):
        for state, array in (("raw.AllModes", "Mode001"), ("raw.OtherMode", "Mode003")):
            seen = look(state, "LaplaceSpectrum")
            self.assertEqual(seen.array, array)
            self.assert_symmetric(seen)

    def test_the_chart_of_the_flow_has_the_steps_of_the_animation(self):
        seen = look("raw.MeanCurvatureFlow", "MeanCurvatureFlow")
        self.assertEqual(seen.axes, [("Step", 0)])
        self.assertEqual(seen.time, 10)

    def test_charts_close_with_their_filter(self):
        for state, name, views in (("raw.LaplaceSpectrum", "LaplaceSpectrum", 2), ("raw.Closed", "", 1),
                                   ("raw.PrincipalCurvatures", "PrincipalCurvatures", 1)):
            self.assertEqual(look(state, name).views, (views, views))

    def test_sources_are_chosen_in_the_panel(self):
        seen = look("colors.Sources", "GeodesicDistance")
        self.assertTrue(seen.sources)
        self.assertEqual(range_of(seen, "Distance"), (0, 0))  # the same points

    def test_a_distance_starts_at_the_handle_in_the_view(self):
        seen = look("colors.Position", "GeodesicDistance")
        points = seen.data.GetPoints()
        farness = [math.dist(points.GetPoint(k), PLACE) for k in range(points.GetNumberOfPoints())]
        distance = seen.data.GetPointData().GetArray("Distance")
        zeros = [k for k in range(len(farness)) if distance.GetTuple1(k) == 0]
        self.assertEqual(zeros, [farness.index(min(farness))])


if __name__ == "__main__":
    plugin.load()
    unittest.main(argv=sys.argv[:1])
