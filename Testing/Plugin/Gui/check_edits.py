"""Whether a filter had its first depth again after undo, the second after redo, where its state loads and
computes, and nothing but the file is left after all were deleted."""
import os
import sys
from xml.etree import ElementTree

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir))

from paraview import simple

import plugin

plugin.load()
folder, filters = sys.argv[1], sys.argv[2:]
if set(filters) != set(plugin.PROXIES):
    sys.exit(f"the filters are {filters}")


def sources(path):
    """Names and proxies of the pipeline in a state."""
    root = ElementTree.parse(path)
    proxies = {proxy.get("id"): proxy for proxy in root.iter("Proxy") if proxy.get("type")}
    items = root.findall(".//ProxyCollection[@name='sources']/Item")
    return {item.get("name"): proxies[item.get("id")] for item in items}


for name in filters:
    for step, depth in (("Undo", "5"), ("Redo", "4")):
        found = sources(f"{folder}/{name}.{step}.pvsm")
        if set(found) != {"sphere.vtp", name + "1"}:
            sys.exit(f"{name}: after {step} there are {sorted(found)}")
        value = found[name + "1"].find("Property[@name='Depth']/Element").get("value")
        if value != depth:
            sys.exit(f"{name}: after {step} Depth is {value}")
    simple.LoadState(f"{folder}/{name}.Redo.pvsm")
    if plugin.data(simple.FindSource(name + "1")).GetNumberOfPoints() == 0:
        sys.exit(f"{name}: nothing comes out of the state")
    simple.ResetSession()
left = sources(f"{folder}/left.pvsm")
if set(left) != {"sphere.vtp"}:
    sys.exit(f"left are {sorted(left)}")
