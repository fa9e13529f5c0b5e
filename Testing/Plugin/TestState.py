"""Tests that a pipeline of all filters survives a state file, in ParaView's format and as Python."""
import os
import pathlib
import tempfile
import unittest
from xml.etree import ElementTree

from paraview import simple, smstate

import plugin


def build():
    """Returns names of connected filters, with properties that are not the defaults. The other filters
    of the plugin keep their defaults."""
    surface = plugin.sphere()
    simple.RenameSource("surface", surface)
    values = simple.Calculator(Input=surface, ResultArrayName="f", Function="coordsX*coordsY")
    clip = simple.ClipToOctree(
        Input=values, Depth=4, Level=-1, GenerateQuadraturePoints=1, QuadratureDegree="6")
    basis = simple.ConnectivityAwareBasis(Input=clip, Level=3, BasisId=5)
    poisson = simple.ScreenedPoisson(
        Input=values, Basis=basis, ValueArray=["POINTS", "f"], ScreeningWeight=7.0,
        ParameterUnits="World", UseValueGradient=1, GradientScale=2.0)
    spectrum = simple.LaplaceSpectrum(
        Input=values, Basis=basis, NumberOfModes=5, Mode=3)
    signatures = simple.SpectralSignatures(
        Input=values, Basis=basis, Sources=surface, NumberOfModes=9, NumberOfScales=3,
        SourcePointIds=[3, 4], FilterType="Low Pass", LastMode=4, ValueArray=["POINTS", "f"])
    distance = simple.GeodesicDistance(
        Input=values, Depth=4, Sources=surface, SourcePointIds=[3, 4], Smoothing=2.5,
        SourceArray=["POINTS", "f"],
        Selection=plugin.selected_points(7))
    hats = simple.ScreenedPoisson(
        Input=values, Depth=4, ValueArray=["POINTS", "f"], FunctionSpace="Hat Functions",
        WantedError=0.4, Accuracy=0.2)
    both = simple.LaplaceSpectrum(
        Input=values, Depth=4, NumberOfModes=5, Mode=2, FunctionSpace="Hat Functions",
        Accuracy=0.4)
    labels = simple.Calculator(Input=values, ResultArrayName="label", Function="floor(coordsZ)")
    stitch = simple.StitchColors(
        Input=labels, Basis=basis, ColorArray=["POINTS", "Normals"], LabelArray=["POINTS", "label"],
        ReferenceLabel=0, KeepDetails=0)
    spread = simple.HarmonicInterpolation(
        Input=labels, Depth=4, ValueArray=["POINTS", "f"], MaskArray=["POINTS", "label"])
    curvatures = simple.PrincipalCurvatures(Input=values, Depth=4, SmoothingScale=0.05)
    detail = simple.SurfaceDetail(
        Input=values, Basis=basis, DetailScaleArray=["POINTS", "f"], DetailScale=0.5,
        TransferFunction="Custom", KeepVolume=1, OutsideScale=0.9, TransitionWidth=0.1,
        Selection=plugin.selected_points(3, 4, 5))
    detail.CustomTransferFunction.Points = [-1, 0.3, 0.5, 0, 0.2, 0, 0.5, 0, 2, 0.8, 0.5, 0]
    gradient = simple.SurfaceGradient(Input=values, Depth=4, Array=["POINTS", "f"])
    heat = simple.HeatDiffusion(
        Input=values, Depth=4, Array=["POINTS", "f"], NumberOfSteps=3, DiffusionTime=0.02)
    flow = simple.MeanCurvatureFlow(Input=values, Depth=4, NumberOfSteps=2, TimeStep=0.125)
    made = {"clip": clip, "basis": basis, "poisson": poisson, "hats": hats, "spectrum": spectrum, "both": both,
            "signatures": signatures, "curvatures": curvatures, "gradient": gradient, "detail": detail,
            "stitch": stitch, "spread": spread, "distance": distance, "heat": heat, "flow": flow}
    types = {proxy.SMProxy.GetXMLName() for proxy in made.values()}
    for name in sorted(set(plugin.PROXIES) - types):
        made[name] = getattr(simple, name)(
            Input=labels, **plugin.depth_of(name, 4), **plugin.choices(name))
    for name, proxy in made.items():
        simple.RenameSource(name, proxy)
    return list(made)


def results(names):
    """Returns every setting and the range of every point array, to compare before and after."""
    found = {}
    for name in names:
        proxy = simple.FindSource(name)
        proxy.UpdatePipeline()
        for key in proxy.ListProperties():
            prop = proxy.SMProxy.GetProperty(key)
            if not prop.IsA("vtkSMProxyProperty") and not prop.GetInformationOnly():
                found[name, key] = str(proxy.GetPropertyValue(key))
        if name == "detail":
            found[name, "curve"] = list(proxy.CustomTransferFunction.Points)
        arrays = proxy.PointData
        for array in arrays.keys():
            found[name, "array", array] = arrays[array].GetRange()
    return found


def number(text):
    """Returns the number that a text tells, or the text. Versions of ParaView write 0.000001 or 1e-06."""
    try:
        return float(text)
    except ValueError:
        return text


def settings(path):
    """Returns the numbers and words of every filter of the plugin in a state file, by name and
    property."""
    root = ElementTree.parse(path)
    names = {item.get("id"): item.get("name")
             for item in root.findall(".//ProxyCollection[@name='sources']/Item")}
    found = {}
    for proxy in root.iter("Proxy"):
        if proxy.get("type") in plugin.PROXIES and proxy.get("id") in names:
            for key in proxy.findall("Property"):
                found[names[proxy.get("id")], key.get("name")] = [
                    number(element.get("value")) for element in key.findall("Element")]
    return found


class TestState(unittest.TestCase):
    def check(self, suffix, save, load):
        names = build()
        expected = results(names)
        self.assertIn(("poisson", "array", "Solution"), expected)
        self.assertIn(("basis", "array", "BasisFunction"), expected)
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "state" + suffix)
            save(path)
            simple.ResetSession()
            self.assertIsNone(simple.FindSource("poisson"))
            load(path)
        self.assertEqual(results(names), expected)
        basis = simple.FindSource("poisson").Basis
        self.assertEqual(basis.SMProxy, simple.FindSource("basis").SMProxy)
        simple.ResetSession()

    def test_paraview_state(self):
        self.check(".pvsm", simple.SaveState, simple.LoadState)

    def test_python_state(self):
        def write(path):
            with open(path, "w") as script:
                script.write(smstate.get_state())

        def run(path):
            with open(path) as script:
                exec(compile(script.read(), path, "exec"), {})

        self.check(".py", write, run)

    def test_states_of_releases(self):
        states = sorted((pathlib.Path(__file__).resolve().parent / "States").glob("*.pvsm"))
        self.assertTrue(states)
        for path in states:
            saved = settings(path)
            self.assertLessEqual({("poisson", "ScreeningWeight"), ("flow", "TimeStep")}, set(saved))
            simple.LoadState(str(path))
            with tempfile.TemporaryDirectory() as folder, self.subTest(state=path.name):
                for name in {name for name, _ in saved}:
                    proxy = simple.FindSource(name)
                    proxy.UpdatePipeline()
                    self.assertGreater(proxy.GetDataInformation().GetNumberOfPoints(), 0, name)
                again = os.path.join(folder, "again.pvsm")
                simple.SaveState(again)
                now = settings(again)
                kept = {key: value for key, value in saved.items() if key in now}
                self.assertGreater(len(kept), len(saved) / 2)  # ParaView leaves out removed properties
                self.assertEqual({key: now[key] for key in kept}, kept)
            simple.ResetSession()


if __name__ == "__main__":
    plugin.load()
    unittest.main()
