"""Runs the scripts that are named one after the other, as the tests do. Each takes a mesh and a depth, and draws
a picture into the folder.

    pvpython draw_all.py MESH DEPTH FOLDER SCRIPT...
"""

import pathlib
import runpy
import sys

from paraview import simple

mesh, depth, folder, *scripts = sys.argv[1:]
for script in map(pathlib.Path, scripts):
    print(script.stem, flush=True)
    sys.argv = [str(script), mesh, depth, f"{folder}/{script.stem}.png"]
    sys.path.insert(0, str(script.parent))
    runpy.run_path(str(script), run_name="__main__")
    simple.ResetSession()
