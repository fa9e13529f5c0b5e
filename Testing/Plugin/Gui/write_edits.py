"""Writes the actions that TestGuiEdits.sh plays. With every filter in turn, they are Apply, a change of
the property that defines its result, undo, redo and delete. A state is saved in between. At last a
state is loaded into the window."""
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir))

from paraview import simple

import plugin
from events import MENUS, Script

plugin.load()
script = Script(sys.argv[1])


def edit_filter(name):
    proxy = getattr(simple, name)(Input=surface).SMProxy
    script.make(name)
    if name in plugin.CHOICES:  # applied without an array first, as whoever tries it does
        script.apply()
        for key, (_, array) in plugin.CHOICES[name].items():
            script.enter(proxy.GetProperty(key), array)
    depth = proxy.GetProperty("Depth")
    if depth and depth.GetPanelVisibility() == "default":
        script.enter(depth, "4")
    script.apply()
    script.save(f"{name}.Shown")
    key, value = plugin.change_of(name)
    script.enter(proxy.GetProperty(key), value)
    script.apply()
    script.edit("Undo")
    script.save(f"{name}.Undo")
    script.enter(proxy.GetProperty(key), value)
    script.apply()
    script.edit("Undo")
    script.edit("Redo")  # from ParaView 5.13 on there is none after a state was saved
    script.save(f"{name}.Redo")
    script.delete()


surface = plugin.sphere()
script.apply()  # the file
for filter_name in plugin.PROXIES:
    edit_filter(filter_name)
script.save("left")
script.event(f"{MENUS}/menu_File", "activate", "actionFileLoadServerState")
script.event("pqClientMainWindow/FileLoadServerStateDialog", "filesSelected",
             f"{script.folder}/{plugin.PROXIES[0]}.Redo.pvsm")
script.event("LoadStateOptionsDialog/widget/OKButton", "activate")
script.save("loaded")
script.write("edits")
