"""Whether the box in the panel has made one surface of the blocks."""
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir))

from paraview import simple

import plugin

plugin.load()
simple.LoadState(sys.argv[1])
distance = simple.FindSource("GeodesicDistance1")
if not distance.BlocksAsOne:
    sys.exit("the box is not ticked")
data = plugin.data(distance)
farthest = max(data.GetBlock(block).GetPointData().GetArray("Distance").GetRange()[1]
               for block in (0, 1))
if not 3.0 < farthest < 3.3:  # from pole to pole; each half by itself ends at its border
    sys.exit(f"the farthest point is {farthest} away")
