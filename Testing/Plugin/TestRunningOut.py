"""Memory that runs out: under every limit a filter gives one message and empty outputs, or its result,
and goes on to work when there is room again. The limit is that of `ulimit -v`, counted from what the
process has when the filter starts; small ones stop the first stages, larger ones the last.

    pvpython TestRunningOut.py MEGABYTES

is what the test of the first run in a process starts."""
import os
import resource
import subprocess
import sys
import unittest

import gridfem.vtkGridFEMFilters  # before the plugin, which makes objects of its classes
from paraview import simple
from vtkmodules.util.vtkConstants import VTK_STRING
from vtkmodules.vtkCommonCore import vtkOutputWindow, vtkStringOutputWindow
from vtkmodules.vtkFiltersSources import vtkSphereSource

import plugin

MEGABYTE = 1 << 20
STEPS = 5  # limits below the one that was enough
OPTIONS = {
    "LaplaceSpectrum": {"NumberOfModes": 8},
    "MeanCurvatureFlow": {"NumberOfSteps": 2},
    "SpectralSignatures": {"NumberOfModes": 8}}


def address_space():
    """Bytes of addresses that the process has, which is what the limit counts."""
    with open("/proc/self/statm", encoding="ascii") as statm:
        return int(statm.read().split()[0]) * resource.getpagesize()


class Limit:
    """While it holds, the process can grow by so many bytes."""

    def __init__(self, room):
        self.room = room

    def __enter__(self):
        resource.setrlimit(resource.RLIMIT_AS, (address_space() + self.room, resource.RLIM_INFINITY))

    def __exit__(self, *_):
        resource.setrlimit(resource.RLIMIT_AS, (resource.RLIM_INFINITY, resource.RLIM_INFINITY))


class Outcome:
    """What one run gave: its messages, whether all outputs are empty, the stages that were done."""

    def __init__(self, algorithm, room=None):
        self.errors = []

        def listen(_, __, text):
            self.errors.append(text)

        listen.CallDataType = VTK_STRING
        observer = algorithm.AddObserver("ErrorEvent", listen)
        before = [algorithm.GetNumberOfRuns(stage) for stage in plugin.STAGES]
        algorithm.Modified()
        if room is None:
            algorithm.Update()
        else:
            with Limit(room):
                algorithm.Update()
        algorithm.RemoveObserver(observer)
        after = [algorithm.GetNumberOfRuns(stage) for stage in plugin.STAGES]
        self.stages = sum(b - a for a, b in zip(before, after))
        ports = range(algorithm.GetNumberOfOutputPorts())
        self.is_empty = not any(
            algorithm.GetOutputDataObject(port).GetNumberOfElements(kind) > 0
            for port in ports for kind in (0, 1, 6))  # points, cells, rows


def first_run(room):
    """What a new process does: no thread has been started yet, and no memory is left from before."""
    sphere = vtkSphereSource()
    sphere.SetThetaResolution(160)
    sphere.SetPhiResolution(160)
    sphere.Update()
    algorithm = gridfem.vtkGridFEMFilters.vtkScreenedPoisson()
    algorithm.SetInputData(sphere.GetOutput())
    algorithm.SetDepth(6)
    algorithm.SetNumberOfThreads(2)  # on one processor, too
    for outcome in Outcome(algorithm, room), Outcome(algorithm):
        says = outcome.errors[0].rsplit("): ", 1)[-1].strip() if outcome.errors else ""
        os.write(1, f"{len(outcome.errors)} {outcome.is_empty} {says}\n".encode())


class TestRunningOut(unittest.TestCase):
    def make(self, name):
        sphere = simple.Sphere(Radius=1.0, ThetaResolution=160, PhiResolution=160)
        options = {**plugin.CHOICES.get(name, {}), **OPTIONS.get(name, {})}
        proxy = getattr(simple, name)(
            Input=plugin.with_arrays(sphere), Depth=6, KeepStages=0, **options)
        proxy.UpdatePipeline()  # without a limit: loads libraries and makes threads
        return proxy.GetClientSideObject()

    def tearDown(self):
        simple.ResetSession()

    def run_out(self, algorithm, room):
        """Whether so much room is too little; then one message and empty outputs are what it gives."""
        outcome = Outcome(algorithm, room)
        if not outcome.errors:
            self.assertFalse(outcome.is_empty, room)
            return False
        self.assertEqual(len(outcome.errors), 1, outcome.errors)
        self.assertIn("memory", outcome.errors[0])
        self.assertTrue(outcome.is_empty, room)
        if outcome.stages not in self.stages:
            again = Outcome(algorithm)
            self.assertFalse(again.errors or again.is_empty, room)
        self.stages.append(outcome.stages)
        return True

    def test_every_filter_under_every_limit(self):
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
        for policy in {}, {"OMP_WAIT_POLICY": "passive"}:
            environment = {key: os.environ[key] for key in os.environ if key != "OMP_WAIT_POLICY"}
            for megabytes in 0, 4, 12, 24, 60:
                with self.subTest(room=megabytes, **policy):
                    run = subprocess.run(
                        [os.readlink("/proc/self/exe"), __file__, str(megabytes)], env={**environment, **policy},
                        stdout=subprocess.PIPE, check=False, timeout=120)
                    lines = run.stdout.decode().splitlines()
                    self.assertEqual(run.returncode, 0, lines)
                    self.assertRegex(lines[0], "^1 True .*memory")
                    self.assertEqual(lines[1].strip(), "0 False")


if __name__ == "__main__":
    if len(sys.argv) == 2 and sys.argv[1].isdigit():
        first_run(int(sys.argv[1]) * MEGABYTE)
    else:
        plugin.load()
        unittest.main()
