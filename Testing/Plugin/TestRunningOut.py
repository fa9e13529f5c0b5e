"""Tests filters that run out of memory. Under every limit a filter gives one message and empty
outputs, or its result, and works again when there is room. The limit is the limit of `ulimit -d`,
counted from the memory of the process at the filter's start. Small limits stop the first stages,
and larger limits stop the last."""
import os
import pathlib
import subprocess
import unittest

import gridfem.vtkGridFEMFilters  # before the plugin, which makes objects of its classes
from paraview import simple
from vtkmodules.vtkCommonCore import vtkOutputWindow, vtkStringOutputWindow

import plugin
from running_out import MEGABYTE, Outcome, take_arrays_from_the_system

STEPS = 8  # limits below the first sufficient limit
OPTIONS = {
    "LaplaceSpectrum": {"NumberOfModes": 8},
    "MeanCurvatureFlow": {"NumberOfSteps": 2},
    "SpectralSignatures": {"NumberOfModes": 8}}


class TestRunningOut(unittest.TestCase):
    def make(self, name):
        sphere = simple.Sphere(Radius=1.0, ThetaResolution=120, PhiResolution=120)
        options = {**plugin.depth_of(name, 5), **plugin.choices(name), **OPTIONS.get(name, {})}
        proxy = getattr(simple, name)(
            Input=plugin.with_arrays(sphere), **options)
        algorithm = proxy.GetClientSideObject()
        algorithm.ReleaseDataFlagOn()  # so that every run is the same
        proxy.UpdatePipeline()  # without a limit: loads libraries and makes threads
        return algorithm

    def tearDown(self):
        simple.ResetSession()

    def run_out(self, algorithm, room):
        """Whether this room is too small. Then the filter must give one message and empty outputs."""
        outcome = Outcome(algorithm, room, plugin.STAGES)
        if not outcome.errors:
            self.assertFalse(outcome.is_empty, room)
            return False
        self.assertEqual(len(outcome.errors), 1, outcome.errors)
        self.assertIn("memory", outcome.errors[0])
        if algorithm.GetClassName()[3:] in plugin.WITHOUT_GRID:
            self.assertNotIn("Depth", outcome.errors[0])
        self.assertTrue(outcome.is_empty, room)
        if outcome.stages not in self.stages:
            again = Outcome(algorithm)
            self.assertFalse(again.errors or again.is_empty, room)
        self.stages.append(outcome.stages)
        return True

    def test_every_filter_under_every_limit(self):
        take_arrays_from_the_system()
        silent = vtkStringOutputWindow()
        usual = vtkOutputWindow.GetInstance()
        vtkOutputWindow.SetInstance(silent)
        self.addCleanup(vtkOutputWindow.SetInstance, usual)
        for name in plugin.PROXIES:
            with self.subTest(proxy=name):
                algorithm = self.make(name)
                self.stages = []  # done at each limit that was too small
                enough = MEGABYTE
                while self.run_out(algorithm, enough):
                    self.assertLess(enough, 4096 * MEGABYTE)
                    enough *= 2
                for step in range(STEPS):
                    self.run_out(algorithm, enough * step // STEPS)
                told = f"{name}: {enough / MEGABYTE:.0f} MB are enough; with less, stages done: {self.stages}\n"
                os.write(1, told.encode())  # print goes to VTK's window
                self.assertGreaterEqual(len(self.stages), 1)  # else no limit was felt

    def test_the_first_run_of_a_process(self):
        script = pathlib.Path(__file__).with_name("running_out.py")
        for policy in {}, {"OMP_WAIT_POLICY": "passive"}:
            environment = {key: os.environ[key] for key in os.environ if key != "OMP_WAIT_POLICY"}
            for megabytes in 0, 4, 12, 24, 60:
                with self.subTest(room=megabytes, **policy):
                    run = subprocess.run(
                        [os.readlink("/proc/self/exe"), script, str(megabytes)], env={**environment, **policy},
                        stdout=subprocess.PIPE, check=False, timeout=120)
                    lines = run.stdout.decode().splitlines()
                    self.assertEqual(run.returncode, 0, lines)
                    self.assertRegex(lines[0], "^1 True .*memory")
                    self.assertEqual(lines[1].strip(), "0 False")


if __name__ == "__main__":
    plugin.load()
    unittest.main()
