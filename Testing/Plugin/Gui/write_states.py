"""Writes a script, a state with a spectrum, and the actions that TestGuiStates.sh plays with them. The
script makes every filter with the defaults and notes what it has got. It runs here as well, so that both
notes can be compared."""
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir))

from paraview import simple

import plugin
from events import NEXT, PROPERTIES, TIME, Script

YES, NO = 0, 1  # buttons of a question

SCRIPT = '''
import json
from paraview import simple
sphere = simple.Sphere(Radius=1.0, ThetaResolution=40, PhiResolution=20)
surface = simple.Calculator(Input=sphere, ResultArrayName="height", Function="coordsZ")
view = simple.CreateRenderView()
shown = simple.Show(surface, view)
simple.ColorBy(shown, ("POINTS", "height"))
noted = {{}}
for name in {names}:
    proxy = getattr(simple, name)(Input=surface)
    for key in proxy.ListProperties():
        prop = proxy.SMProxy.GetProperty(key)
        if not prop.IsA("vtkSMProxyProperty") and not prop.GetInformationOnly():
            noted[name + "." + key] = str(proxy.GetPropertyValue(key))
paths = simple.GeodesicPaths(Input=surface)
paths.UpdatePipeline()
noted["opacity"] = simple.Show(paths, view).Opacity
blocks = simple.GroupDatasets(Input=[surface, simple.Transform(Input=surface)])
heat = simple.HeatDiffusion(Input=blocks, Array=["POINTS", "height"], Depth=4)
shown = simple.Show(heat, view)
simple.SetActiveSource(sphere)  # the window asks about the colors of blocks if they are active
simple.ColorBy(shown, ("FIELD", "vtkBlockColors"))
simple.Render(view)
heat.DiffusionTime = 0.002
simple.Render(view)
noted["blocks"] = list(shown.ColorArrayName)
with open("{folder}/" + WHERE + ".json", "w") as file:
    json.dump(noted, file)
for proxies in simple.GetViews(), simple.GetLayouts().values(), simple.GetSources().values():
    for proxy in list(proxies):
        simple.Delete(proxy)
'''


def write_script():
    """Writes the script for the window, and runs it here."""
    text = SCRIPT.format(names=plugin.PROXIES, folder=script.folder)
    exec(compile("WHERE = 'here'" + text, "script", "exec"), {})
    with open(f"{script.folder}/script.py", "w", encoding="utf-8") as file:
        file.write("WHERE = 'window'" + text)


def write_state():
    """Writes a state with a spectrum that is shown at its first mode, beside the chart."""
    surface = simple.Calculator(Input=plugin.sphere(), CoordinateResults=1,
                                Function="coords*(1+0.3*exp(2*coordsZ-2))")
    simple.RenameSource("surface", surface)
    spectrum = simple.LaplaceSpectrum(registrationName="spectrum", Input=surface, Depth=4, NumberOfModes=8)
    view = simple.CreateRenderView()
    spectrum.UpdatePipeline(1.0)
    simple.GetAnimationScene().UpdateAnimationUsingDataTimeSteps()
    simple.GetAnimationScene().AnimationTime = 1.0
    simple.Show(spectrum, view)
    chart = simple.CreateView("XYChartView")
    simple.Show(simple.OutputPort(spectrum, 1), chart)
    layout = simple.CreateLayout()
    for shown in view, chart:
        simple.AssignViewToLayout(view=shown, layout=layout)
    simple.SaveState(f"{script.folder}/spectrum.pvsm")


plugin.load()
script = Script(sys.argv[1])
write_script()
write_state()
script.load("script.py")
script.load("spectrum.pvsm")
script.event(f"{TIME}{NEXT}", "activate")
script.event(f"{TIME}{NEXT}", "activate")
script.save("played")
script.select(0, 0, 0)  # on the surface, on the sphere
script.event(f"{PROPERTIES}/AllModes/CheckBox", "set_boolean", "true")
script.apply()
script.save("all")
script.event(f"{PROPERTIES}/AllModes/CheckBox", "set_boolean", "false")
script.apply()
script.delete()
script.save("deleted")
script.edit("Undo")
script.event(f"{TIME}{NEXT}", "activate")
script.save("undone")
script.select(0, 0)  # the surface
script.make("ConnectivityAwareBasis")
script.save("basis")
for button, state in ((NO, "kept"), (YES, "example")):
    script.example("path")
    script.answer("OpenExample", button)
    script.save(state)
script.write("states")
