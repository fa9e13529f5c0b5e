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

    def test_modes_of_a_state_have_their_own_range(self):
        self.assertEqual(self.assert_own_range("played"), 3.0)

    def test_a_chart_of_a_state_closes_with_its_filter(self):
        for state, views in (("played", 2), ("deleted", 1)):
            plugin.clear()
            simple.LoadState(f"{FOLDER}/{state}.pvsm")
            self.assertEqual(simple.FindSource("spectrum") is not None, views == 2)
            self.assertEqual(len(simple.GetViews()), views)

    def test_modes_have_their_own_range_after_the_filter_was_brought_back(self):
        self.assertEqual(self.assert_own_range("undone"), 1.0)


if __name__ == "__main__":
    plugin.load()
    unittest.main(argv=sys.argv[:1])
