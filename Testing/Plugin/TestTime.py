"""Tests a surface that grows with time, through every filter, forward and backward."""
import unittest

import gridfem.vtkGridFEMFilters  # before the plugin, which makes objects of its classes
from paraview import simple

import plugin

DEPTH = 4
TIMES = (1.0, 2.0, 3.0)
FORWARDS_AND_BACKWARDS = (1.0, 2.0, 3.0, 2.0, 1.0)

STEPS = """
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline as pipeline
info = self.GetOutputInformation(0)
info.Set(pipeline.TIME_STEPS(), [1, 2, 3], 3)
info.Set(pipeline.TIME_RANGE(), [1, 3], 2)
"""

SPHERE = """
from vtkmodules.vtkCommonDataModel import vtkDataObject
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline as pipeline
info = self.GetOutputInformation(0)
time = info.Get(pipeline.UPDATE_TIME_STEP()) if info.Has(pipeline.UPDATE_TIME_STEP()) else 1
source = vtkSphereSource()
source.SetRadius(time)
source.SetThetaResolution(40)
source.SetPhiResolution(20)
source.Update()
self.GetPolyDataOutput().ShallowCopy(source.GetOutput())
self.GetPolyDataOutput().GetInformation().Set(vtkDataObject.DATA_TIME_STEP(), time)
"""


def label(proxy):
    """Returns the text that ParaView shows in the view of a filter."""
    return proxy.GetClientSideObject().GetOutputDataObject(2).GetValueByName(0, "Text").ToString()


def growing_sphere():
    """Makes, at the times 1, 2 and 3, a sphere whose radius is the time."""
    return simple.ProgrammableSource(
        OutputDataSetType="vtkPolyData", Script=SPHERE, ScriptRequestInformation=STEPS)


class TestTime(unittest.TestCase):
    def setUp(self):
        self.surface = growing_sphere()

    def tearDown(self):
        simple.ResetSession()

    def largest_x(self, proxy):
        return proxy.GetDataInformation().GetBounds()[1]

    def test_every_filter_follows_the_surface(self):
        own = {"LaplaceSpectrum": {"AllModes": 1, "NumberOfModes": 9},
               "ScreenedPoisson": {"ValueArray": ["POINTS", "f"]},
               "SpectralSignatures": {"NumberOfModes": 9}, **plugin.CHOICES}
        surface = plugin.with_arrays(self.surface)
        for name in plugin.PROXIES:
            if name in ("MeanCurvatureFlow", "HeatDiffusion", "SurfaceDynamics"):
                continue  # times are always its own steps
            proxy = getattr(simple, name)(
                Input=surface, **plugin.depth_of(name, DEPTH), **own.get(name, {}))
            for time in FORWARDS_AND_BACKWARDS:
                with self.subTest(proxy=name, time=time):
                    proxy.UpdatePipeline(time)
                    self.assertAlmostEqual(self.largest_x(proxy), time, delta=0.05 * time)

    def first_eigenvalue(self, proxy):
        return proxy.GetClientSideObject().GetOutputDataObject(1).GetColumnByName(
            "Eigenvalue").GetValue(1)

    def test_eigenvalues_scale_through_signatures(self):
        modes = simple.LaplaceSpectrum(
            Input=self.surface, Depth=DEPTH, AllModes=1, NumberOfModes=9)
        signatures = simple.SpectralSignatures(Input=modes, NumberOfScales=3)
        for time in FORWARDS_AND_BACKWARDS:
            signatures.UpdatePipeline(time)
            for proxy in (modes, signatures):
                self.assertAlmostEqual(self.first_eigenvalue(proxy) * time**2, 2.0, delta=0.1)
        self.assertEqual(plugin.runs(signatures)["Solve"], 0)

    def test_the_steps_of_the_surface_are_handed_on(self):
        modes = simple.LaplaceSpectrum(Input=self.surface, Depth=DEPTH, NumberOfModes=6)
        modes.UpdatePipelineInformation()
        self.assertEqual(list(modes.TimestepValues), [1, 2, 3, 4, 5])
        modes.Mode = 2
        modes.UpdatePipelineInformation()
        self.assertEqual(list(modes.TimestepValues), list(TIMES))
        modes.AllModes = 1
        modes.UpdatePipelineInformation()
        self.assertEqual(list(modes.TimestepValues), list(TIMES))

    def test_stepping_through_modes_does_not_change_the_surface(self):
        modes = simple.LaplaceSpectrum(Input=self.surface, Depth=DEPTH, NumberOfModes=6)
        for mode in (1.0, 3.0, 2.0, 5.0):
            self.surface.UpdatePipeline(mode)  # as the view does that shows the surface, too
            modes.UpdatePipeline(mode)
            self.assertAlmostEqual(self.first_eigenvalue(modes), 2.0, delta=0.1)
            self.assertAlmostEqual(self.largest_x(modes), 1.0, delta=0.05)
            table = modes.GetClientSideObject().GetOutputDataObject(1)
            eigenvalue = table.GetColumnByName("Eigenvalue").GetValue(int(mode))
            self.assertEqual(label(modes), f"Mode {mode:.0f}, eigenvalue {eigenvalue:.4g}")
        self.assertEqual(plugin.runs(modes)["Solve"], 1)
        modes.AllModes = 1
        modes.UpdatePipeline()
        self.assertEqual(label(modes), "")

    def test_stepping_through_a_flow_does_not_change_the_surface(self):
        flow = simple.MeanCurvatureFlow(Input=self.surface, Depth=DEPTH, NumberOfSteps=4)
        sizes = {}
        for step in (1.0, 3.0, 2.0, 3.0):
            self.surface.UpdatePipeline(step)
            flow.UpdatePipeline(step)
            size = self.largest_x(flow)
            self.assertEqual(sizes.setdefault(step, size), size)
            self.assertRegex(label(flow), rf"Step {step:.0f}, sphericity (1|0\.\d+)$")
        self.assertLess(sizes[1.0], 1.0)
        self.assertLess(sizes[2.0], sizes[1.0])
        self.assertLess(sizes[3.0], sizes[2.0])
        self.assertEqual(plugin.runs(flow)["Space"], 1)


if __name__ == "__main__":
    plugin.load()
    unittest.main()
