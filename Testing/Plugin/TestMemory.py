"""Tests that filters free their memory when they are deleted, and after every run if asked to. It
counts the process' own memory, as the system reports it, beyond the data in the pipeline."""
import re
import unittest

import gridfem.vtkGridFEMFilters  # before the plugin, which makes objects of its classes
from paraview import simple

import plugin

MEGABYTE = 1 << 20

# Few modes and steps are enough, because the test is about the data that stays.
OPTIONS = {
    "LaplaceSpectrum": {"NumberOfModes": 8},
    "MeanCurvatureFlow": {"NumberOfSteps": 2},
    "SpectralSignatures": {"NumberOfModes": 8}}


def resident():
    """Returns the bytes of the process that are in memory."""
    with open("/proc/self/status") as status:
        return 1024 * int(re.search(r"VmRSS:\s+(\d+)", status.read()).group(1))


def make(name, surface):
    return getattr(simple, name)(
        Input=surface, **plugin.depth_of(name, 6), **plugin.choices(name), **OPTIONS.get(name, {}))


def update_all_ports(proxy):
    for port in range(proxy.SMProxy.GetNumberOfOutputPorts()):
        simple.OutputPort(proxy, port).UpdatePipeline()


class TestMemory(unittest.TestCase):
    def setUp(self):
        self.surface = simple.Sphere(Radius=1.0, ThetaResolution=240, PhiResolution=240)
        self.surface.UpdatePipeline()

    def tearDown(self):
        simple.ResetSession()

    def test_deleted_filters_leave_nothing(self):
        for name in plugin.PROXIES:
            with self.subTest(proxy=name):
                growth = []
                for _ in range(3):  # the first run loads libraries and makes threads
                    before = resident()
                    proxy = make(name, self.surface)
                    update_all_ports(proxy)
                    during = resident()
                    simple.Delete(proxy)
                    del proxy
                    after = resident()
                    growth.append(after / before)
                print(f"{name}: {before / MEGABYTE:.0f} MB before, {during / MEGABYTE:.0f} with "
                      f"it, {after / MEGABYTE:.0f} after")
                self.assertLess(min(growth[1:]), 1.05)

    def test_without_kept_stages_only_data_stays(self):
        for name in plugin.PROXIES:
            with self.subTest(proxy=name):
                data = 0
                for releases in (False, True):  # a filter that releases its data cannot say how large they were
                    before = resident()
                    proxy = make(name, self.surface)
                    proxy.GetClientSideObject().SetReleaseDataFlag(releases)
                    update_all_ports(proxy)
                    held = resident() - before
                    ports = range(proxy.SMProxy.GetNumberOfOutputPorts())
                    data = max(data, sum(1024 * proxy.GetClientSideObject().GetOutputDataObject(port)
                                         .GetActualMemorySize() for port in ports))
                    simple.Delete(proxy)
                    del proxy
                print(f"{name}: {held / MEGABYTE:.0f} MB held, {data / MEGABYTE:.0f} of data")
                # Allocators round up and keep a little: the largest share is 4 MB.
                self.assertLess(held, 1.3 * data + 4 * MEGABYTE)


if __name__ == "__main__":
    plugin.load()
    unittest.main()
