"""Checks the filters on the ranks of a server, seen from a client. TestServer.sh runs it.

    pvpython client.py PORT RANKS FOLDER
"""
import os
import re
import sys
import unittest

import numpy
from paraview import servermanager, simple
from vtkmodules.util import numpy_support
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter

sys.path.append(os.path.join(os.environ["GRIDFEM_SOURCE_DIR"], "Testing", "Plugin"))
from plugin import choices

RANKS = int(sys.argv[2])
DEPTH = 4


def array_of(data, name):
    return numpy_support.vtk_to_numpy(data.GetPointData().GetArray(name))


class Client(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        """Reads a sphere from a file on one rank and divides it among all. ParaView's source of spheres
        would make a slit: each rank rounds the points of the seam in its own way."""
        source = vtkSphereSource()
        source.SetRadius(1.0)
        source.SetThetaResolution(40)
        source.SetPhiResolution(20)
        writer = vtkXMLPolyDataWriter()
        writer.SetInputConnection(source.GetOutputPort())
        writer.SetFileName(os.path.join(sys.argv[-1], "sphere.vtp"))
        writer.Write()
        cls.alone = source.GetOutput()
        file = simple.XMLPolyDataReader(FileName=[writer.GetFileName()])
        pieces = simple.RedistributeDataSet(Input=file)
        values = simple.Calculator(Input=pieces, ResultArrayName="f",
                                   Function="coordsX*coordsY+0.3*coordsZ")
        cls.surface = simple.Calculator(Input=values, ResultArrayName="label",
                                        Function="floor(coordsZ)")
        cls.surface.UpdatePipeline()
        cls.points = cls.surface.GetDataInformation().GetNumberOfPoints()

    def test_the_surface_is_on_all_ranks(self):
        self.assertEqual(servermanager.ActiveConnection.GetNumberOfDataPartitions(), RANKS)
        # Borders are there twice.
        self.assertEqual(self.points > self.alone.GetNumberOfPoints(), RANKS > 1)

    def test_every_filter_runs(self):
        folder = os.path.join(os.environ["GRIDFEM_SOURCE_DIR"], "Plugin")
        for panel in sorted(os.listdir(folder)):
            if not panel.endswith(".xml"):
                continue
            with open(os.path.join(folder, panel)) as text:
                name = re.search(r'<SourceProxy name="(\w+)"', text.read()).group(1)
            with self.subTest(proxy=name):
                proxy = getattr(simple, name)(Input=self.surface, **choices(name))
                for prop, value in (("Depth", DEPTH), ("NumberOfModes", 12)):
                    if prop in proxy.ListProperties():
                        proxy.SetPropertyWithName(prop, value)
                proxy.UpdatePipeline()
                data = servermanager.Fetch(proxy)
                self.assertGreater(data.GetNumberOfPoints(), 700)
                self.assertTrue(numpy.isfinite(
                    numpy_support.vtk_to_numpy(data.GetPoints().GetData())).all())
                kept = data.GetNumberOfPoints() == self.points
                self.assertEqual(kept, name not in ("ClipToOctree", "ConnectivityAwareBasis"))

    def solution_of_one_rank(self):
        """Returns points, and the solution at them."""
        from gridfem.vtkGridFEMFilters import vtkScreenedPoisson
        alone = vtkPolyData()
        alone.ShallowCopy(self.alone)
        places = numpy_support.vtk_to_numpy(alone.GetPoints().GetData())
        x, y, z = places.astype(float).T
        values = numpy_support.numpy_to_vtk(x * y + 0.3 * z, deep=1)
        values.SetName("f")
        alone.GetPointData().AddArray(values)
        solver = vtkScreenedPoisson()
        solver.SetInputDataObject(alone)
        solver.SetDepth(DEPTH)
        solver.SetTolerance(1e-12)
        solver.SetInputArrayToProcess(0, 0, 0, 0, "f")
        solver.Update()
        return places, array_of(solver.GetOutput(), "Solution")

    def test_the_solution_of_the_gathered_surface_is_that_of_one_rank(self):
        places, expected = self.solution_of_one_rank()
        ghosts = simple.GhostCells if hasattr(simple, "GhostCells") else simple.GhostCellsGenerator
        for surface in (self.surface, ghosts(Input=self.surface)):
            solver = simple.ScreenedPoisson(
                Input=surface, ValueArray=["POINTS", "f"], Depth=DEPTH, Tolerance=1e-12,
                BlocksAsOne=1)
            data = servermanager.Fetch(solver)
            self.assertEqual(data.GetFieldData().GetArray("Converged").GetValue(0), 1)
            self.assertGreaterEqual(data.GetNumberOfPoints(), self.points)
            points = numpy_support.vtk_to_numpy(data.GetPoints().GetData())
            for point, value in zip(points, array_of(data, "Solution")):
                nearest = numpy.abs(places - point).max(axis=1).argmin()
                self.assertLess(abs(value - expected[nearest]), 1e-10)  # the solver's tolerance

    def refuse_and_compute(self, solver):
        solver.ValueArray = ["POINTS", "nothing"]
        solver.UpdatePipeline()
        self.assertEqual(solver.GetDataInformation().GetNumberOfPoints(), 0)
        solver.ValueArray = ["POINTS", "f"]
        solver.UpdatePipeline()
        self.assertEqual(solver.GetDataInformation().GetNumberOfPoints(), self.points)

    def test_all_ranks_compute(self):
        places, expected = self.solution_of_one_rank()
        solver = simple.ScreenedPoisson(Input=self.surface, ValueArray=["POINTS", "f"], Depth=DEPTH,
                                        Tolerance=1e-12)
        data = servermanager.Fetch(solver)
        self.assertEqual(data.GetFieldData().HasArray("Distributed"), RANKS > 1)
        for point, value in zip(numpy_support.vtk_to_numpy(data.GetPoints().GetData()),
                                array_of(data, "Solution")):
            nearest = numpy.abs(places - point).max(axis=1).argmin()
            self.assertLess(abs(value - expected[nearest]), 1e-8)
        modes = {}
        for together in (0, 1):
            proxy = simple.LaplaceSpectrum(Input=self.surface, Depth=DEPTH, NumberOfModes=6,
                                           Tolerance=1e-10, BlocksAsOne=1 - together)
            proxy.UpdatePipeline()
            fields = servermanager.Fetch(proxy).GetFieldData()
            self.assertEqual(fields.HasArray("Distributed"), together and RANKS > 1)
            modes[together] = numpy_support.vtk_to_numpy(fields.GetArray("Eigenvalues"))
            self.assertEqual(servermanager.Fetch(proxy, idx=1).GetNumberOfRows(), len(modes[together]))
        numpy.testing.assert_allclose(modes[1], modes[0], rtol=1e-8, atol=1e-8)
        self.refuse_and_compute(solver)

    def test_modes_play(self):
        modes = simple.LaplaceSpectrum(Input=self.surface, Depth=DEPTH, NumberOfModes=6)
        modes.UpdatePipeline()
        modes.UpdatePipelineInformation()
        self.assertEqual(list(modes.TimestepValues), [1, 2, 3, 4, 5])
        ranges = set()
        for mode in (1.0, 3.0, 5.0):
            modes.UpdatePipeline(mode)
            ranges.add(servermanager.Fetch(modes).GetPointData().GetArray("Mode").GetRange())
        self.assertEqual(len(ranges), 3)
        self.assertEqual(servermanager.Fetch(modes, idx=1).GetNumberOfRows(), 6)

    def test_a_chain_with_a_basis(self):
        basis = simple.ConnectivityAwareBasis(Input=self.surface, Depth=DEPTH)
        solver = simple.ScreenedPoisson(Input=self.surface, Basis=basis, ValueArray=["POINTS", "f"])
        solver.UpdatePipeline()
        self.assertEqual(solver.GetDataInformation().GetNumberOfPoints(), self.points)
        on_clip = simple.ScreenedPoisson(Input=basis, ValueArray=["POINTS", "f"])
        on_clip.UpdatePipeline()
        self.assertGreater(on_clip.GetDataInformation().GetNumberOfPoints(), self.points)

    def test_a_refusal_leaves_the_server_alive(self):
        solver = simple.ScreenedPoisson(Input=self.surface, ValueArray=["POINTS", "f"], Depth=DEPTH,
                                        QuadratureDegree=2)
        self.refuse_and_compute(solver)


if __name__ == "__main__":
    import gridfem.vtkGridFEMFilters  # before the plugin, which makes objects of its classes
    simple.Connect("localhost", int(sys.argv[1]))
    for remote in (True, False):  # where it runs, and where its properties are known
        simple.LoadPlugin(os.environ["GRIDFEM_PLUGIN"], remote=remote, ns=vars(simple))
    done = unittest.main(argv=sys.argv[:1], exit=False)
    simple.Disconnect()
    if not done.result.wasSuccessful():
        sys.exit(1)
