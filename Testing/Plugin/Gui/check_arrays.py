"""Whether the arrays that were chosen with the mouse are those that were computed on, and stitched colours
are shown as they are."""
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir))

from paraview import simple

import plugin

plugin.load()
simple.LoadState(sys.argv[1])
smoothed, steep = (simple.FindSource(f"ScreenedPoisson{k}") for k in (1, 2))
if list(smoothed.ValueArray) != ["POINTS", "colors"]:
    sys.exit(f"smoothed were {smoothed.ValueArray}")
colors = plugin.data(smoothed).GetPointData().GetArray("Solution")
if colors.GetNumberOfComponents() != 3 or not 200 < colors.GetRange(0)[1] < 255:
    sys.exit(f"no smoothed colours: {colors.GetNumberOfComponents()} {colors.GetRange(0)}")
if list(steep.GradientArray) != ["POINTS", "direction"]:
    sys.exit(f"gradients were taken from {steep.GradientArray}")
# The height of a sphere of radius 1/2; gradients twice as long make it steeper.
highest = plugin.data(steep).GetPointData().GetArray("Solution").GetRange()[1]
if not highest > 0.51:
    sys.exit(f"the gradients were not used: {highest}")
stitched = simple.FindSource("StitchColors1")
shown = [part for part in simple.GetRepresentations().values()
         if getattr(part, "Input", None) == stitched and part.Visibility]
if len(shown) != 1 or shown[0].ColorArrayName[1] != "StitchedColors" or shown[0].MapScalars:
    sys.exit(f"stitched colours are shown {[(part.ColorArrayName, part.MapScalars) for part in shown]}")
