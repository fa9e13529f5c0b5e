"""A pipeline of all filters survives a state file, in ParaView's format and as Python."""
import os
import tempfile
import unittest

from paraview import simple, smstate

import plugin


def build():
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
        Input=values, Basis=basis, NumberOfModes=5, Mode=3, Cycle="W", Smoother="Gauss-Seidel")
    signatures = simple.SpectralSignatures(
        Input=values, Basis=basis, Sources=surface, NumberOfModes=9, NumberOfScales=3,
        SourcePointIds=[3, 4], FilterType="Low Pass", LastMode=4, ValueArray=["POINTS", "f"])
    distance = simple.GeodesicDistance(
        Input=values, Depth=4, Sources=surface, SourcePointIds=[3, 4], Smoothing=2.5,
        SourceArray=["POINTS", "f"], Unreachable="Infinity",
        Selection=plugin.selected_points(7))
    hats = simple.ScreenedPoisson(
        Input=values, Depth=4, ValueArray=["POINTS", "f"], FunctionSpace="Hat Functions",
        Iteration="Cycles", Smoother="Gauss-Seidel in Slices",
        SweepsPerSynchronisation=2, NumberOfSweeps=3, CoarsestSize=100)
    both = simple.LaplaceSpectrum(
        Input=values, Depth=4, NumberOfModes=5, Mode=2, FunctionSpace="Hat Functions",
        CompareFunctionSpaces=1)
    labels = simple.Calculator(Input=values, ResultArrayName="label", Function="floor(coordsZ)")
    stitch = simple.StitchColors(
        Input=labels, Basis=basis, ColorArray=["POINTS", "Normals"], LabelArray=["POINTS", "label"],
        KeptMean="Reference Scan", ReferenceLabel=-1, KeepDetails=0)
    spread = simple.HarmonicInterpolation(
        Input=labels, Depth=4, ValueArray=["POINTS", "f"], MaskArray=["POINTS", "label"])
    curvatures = simple.PrincipalCurvatures(Input=values, Depth=4, SmoothingScale=0.05)
    detail = simple.SurfaceDetail(
        Input=values, Basis=basis, DetailScaleArray=["POINTS", "f"], DetailScale=0.5,
        TransferFunction="Custom", KeepVolume=1, OutsideScale=0.9, TransitionWidth=0.1,
        CyclesPerApply=2, Selection=plugin.selected_points(3, 4, 5))
    detail.CustomTransferFunction.Points = [-1, 0.3, 0.5, 0, 0.2, 0, 0.5, 0, 2, 0.8, 0.5, 0]
    for name, proxy in (("clip", clip), ("basis", basis), ("poisson", poisson), ("hats", hats),
                        ("spectrum", spectrum), ("both", both), ("signatures", signatures),
                        ("curvatures", curvatures), ("detail", detail), ("stitch", stitch),
                        ("spread", spread), ("distance", distance)):
        simple.RenameSource(name, proxy)


def results():
    """Every setting and the range of every point array, to compare before and after."""
    found = {}
    for name in ("clip", "basis", "poisson", "hats", "spectrum", "both", "signatures",
                 "curvatures", "detail", "stitch", "spread", "distance"):
        proxy = simple.FindSource(name)
        proxy.UpdatePipeline()
        for key in proxy.ListProperties():
            if key not in ("Input", "Basis", "Sources", "Values", "Selection",
                           "CustomTransferFunction", "TimestepValues"):
                found[name, key] = str(proxy.GetPropertyValue(key))
        if name == "detail":
            found[name, "curve"] = list(proxy.CustomTransferFunction.Points)
        arrays = proxy.PointData
        for array in arrays.keys():
            found[name, "array", array] = arrays[array].GetRange()
    return found


class TestState(unittest.TestCase):
    def check(self, suffix, save, load):
        build()
        expected = results()
        self.assertIn(("poisson", "array", "Solution"), expected)
        self.assertIn(("basis", "array", "BasisFunction"), expected)
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "state" + suffix)
            save(path)
            simple.ResetSession()
            self.assertIsNone(simple.FindSource("poisson"))
            load(path)
        self.assertEqual(results(), expected)
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


if __name__ == "__main__":
    plugin.load()
    unittest.main()
