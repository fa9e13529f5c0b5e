"""Whether a state saved by the program holds all filters of ApplyFilters.xml, and they give results."""
import os
import pathlib
import re
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir))

from paraview import simple

import plugin

plugin.load()
simple.LoadState(sys.argv[1])
found = {key[0] for key in simple.GetSources()}
events = pathlib.Path(__file__).with_name("ApplyFilters.xml").read_text()
wanted = {name + "1" for name in re.findall(r'Surface FEM" command="activate" arguments="(\w+)"', events)}
if not wanted <= found:
    sys.exit(f"not in the state: {sorted(wanted - found)}")
arrays = plugin.data(simple.FindSource("LaplaceSpectrum1")).GetPointData()
for name in ("Solution", "Mode"):
    if not arrays.HasArray(name):
        sys.exit(f"no array {name}")
