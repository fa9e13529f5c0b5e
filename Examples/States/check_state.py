"""Loads modes.py (or another state with a source `modes`); ends with 1 unless modes 1 to 19, at least, can be shown.

    pvpython check_state.py STATE.py
"""

import runpy
import sys

from paraview.simple import Disconnect

state = runpy.run_path(sys.argv[1])
low, high = state["modes"].PointData["Mode"].GetRange()
steps = len(state["modes"].TimestepValues)
print(f"{steps} time steps; the shown mode lies between {low:.3g} and {high:.3g}")
Disconnect()  # closes the view while its display is still there
sys.exit(0 if steps >= 19 and low < 0 < high else 1)
