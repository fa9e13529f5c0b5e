"""Loads a state of this folder; ends with 1 unless its source of this name has at least so many time
steps, and the point array there differs from point to point.

    pvpython check_state.py STATE.py SOURCE ARRAY STEPS
"""

import runpy
import sys

from paraview.simple import Disconnect

path, source, array, expected = sys.argv[1:]
state = runpy.run_path(path)
low, high = state[source].PointData[array].GetRange()
steps = len(getattr(state[source], "TimestepValues", []))
print(f"{steps} time steps; {array} lies between {low:.3g} and {high:.3g}")
Disconnect()  # closes the view while its display is still there
sys.exit(0 if steps >= int(expected) and low < high else 1)
