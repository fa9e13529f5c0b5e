"""Checks the notes and states of TestGuiStates.sh."""
import json
import os
import sys
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir))

from paraview import simple

import plugin

FOLDER = sys.argv[1]


def notes(where):
    with open(f"{FOLDER}/{where}.json", encoding="utf-8") as file:
        return json.load(file)


class States(unittest.TestCase):
    def assert_own_range(self, state):
        """Asserts that the colors go as far as the values of the mode, with 0 in the middle."""
        plugin.clear()
        simple.LoadState(f"{FOLDER}/{state}.pvsm")
        spectrum = simple.FindSource("spectrum")
        spectrum.UpdatePipeline(simple.GetAnimationScene().AnimationTime)
        low, high = spectrum.PointData["Mode"].GetRange()
        self.assertNotAlmostEqual(low, -high)
        points = simple.GetColorTransferFunction("Mode").RGBPoints
        self.assertEqual(points[0], -points[-4])
        self.assertAlmostEqual(points[-4], max(-low, high), delta=1e-6 * high)
        return simple.GetAnimationScene().AnimationTime

    def test_a_script_gets_the_same_in_the_window_as_without_it(self):
        self.assertEqual(notes("window"), notes("here"))
        self.assertEqual(notes("window")["opacity"], 1.0)
        self.assertEqual(notes("window")["blocks"], ["FIELD", "vtkBlockColors"])

    def test_modes_of_a_state_have_their_own_range(self):
        self.assertGreater(self.assert_own_range("played"), 1.0)

    def test_another_array_colors_the_picture_of_a_state_that_has_lost_its_array(self):
        plugin.clear()
        simple.LoadState(f"{FOLDER}/all.pvsm")
        shown = [part for view in simple.GetViews("RenderView") for part in view.Representations
                 if hasattr(part, "ColorArrayName") and part.Visibility]
        self.assertEqual([part.ColorArrayName[1] for part in shown], ["Mode001"])

    def test_a_chart_of_a_state_closes_with_its_filter(self):
        for state, views in (("played", 2), ("deleted", 1)):
            plugin.clear()
            simple.LoadState(f"{FOLDER}/{state}.pvsm")
            self.assertEqual(simple.FindSource("spectrum") is not None, views == 2)
            self.assertEqual(len(simple.GetViews()), views)

    @unittest.skipIf(simple.GetParaViewVersion() >= (5, 13),
                     "undo does not bring a deleted filter of ParaView itself back, either")
    def test_modes_have_their_own_range_after_the_filter_was_brought_back(self):
        self.assert_own_range("undone")

    def test_a_basis_for_several_filters_has_their_depth(self):
        plugin.clear()
        simple.LoadState(f"{FOLDER}/basis.pvsm")
        self.assertEqual(simple.FindSource("ConnectivityAwareBasis1").Depth, 7)

    def test_an_example_takes_the_place_of_the_pipeline_only_if_the_user_agrees(self):
        for state, is_kept in (("kept", True), ("example", False)):
            plugin.clear()
            simple.LoadState(f"{FOLDER}/{state}.pvsm")
            self.assertEqual(simple.FindSource("surface") is not None, is_kept)
            paths = [proxy for proxy in simple.GetSources().values()
                     if proxy.SMProxy.GetXMLName() == "GeodesicPaths"]
            self.assertEqual(bool(paths), not is_kept)
        self.assertGreater(plugin.data(paths[0], 1).GetNumberOfLines(), 0)


if __name__ == "__main__":
    plugin.load()
    unittest.main(argv=sys.argv[:1])
