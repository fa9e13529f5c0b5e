"""Tests inputs on other ports, chains of filters, and composite data."""
import os
import tempfile
import unittest

import numpy
from vtkmodules.util import numpy_support
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import (
    VTK_POLY_LINE, VTK_VERTEX, vtkCellArray, vtkMultiBlockDataSet, vtkPartitionedDataSet,
    vtkPartitionedDataSetCollection, vtkPolyData, vtkUnstructuredGrid)
from vtkmodules.vtkIOParallelXML import vtkXMLPPolyDataWriter
from vtkmodules.vtkIOXML import vtkXMLPPolyDataReader

import gridfem
import ranks

LAST = ranks.RANKS - 1
ROUNDING = 1e-12


def result(output, name):
    array = output.GetPointData().GetArray(name)
    return numpy_support.vtk_to_numpy(array) if array and array.GetNumberOfTuples() else (
        numpy.zeros(0))


def expect(output, reference, name, data, tolerance=ROUNDING):
    """Returns problems with an array at the points of `data`."""
    if data.GetNumberOfPoints() == 0:
        return []
    if not output.GetPointData().HasArray(name):
        return [f"{name} is missing"]
    places = numpy_support.vtk_to_numpy(data.GetPointData().GetArray("origin"))
    expected = numpy_support.vtk_to_numpy(reference.GetPointData().GetArray(name))
    apart = ranks.apart(result(output, name), expected[places])
    return [] if apart <= tolerance * numpy.nanmax(abs(expected)) else [f"{name} is {apart} off"]


def places(points, values=()):
    """Makes points of an unstructured grid, with values."""
    grid = vtkUnstructuredGrid()
    where = vtkPoints()
    where.SetDataTypeToDouble()
    for point in points:
        where.InsertNextPoint(*point)
    grid.SetPoints(where)
    for k in range(len(points)):
        grid.InsertNextCell(VTK_VERTEX, 1, [k])
    if len(values):
        ranks.add(grid.GetPointData(), "v", numpy.array(values))
        grid.GetPointData().SetActiveScalars("v")
    return grid


class OtherPorts(unittest.TestCase):
    def test_a_basis_made_on_the_ranks_serves_solvers_on_them(self):
        data = ranks.piece(ranks.ellipsoid(), "ghosts")

        def shared(data):
            basis = ranks.make("ConnectivityAwareBasis", gathers=True)
            basis.SetInputDataObject(0, data)
            solver = ranks.make("ScreenedPoisson", gathers=True)
            solver.SetBasisConnection(basis.GetOutputPort())
            return ranks.run(solver, data)[0], solver.GetNumberOfRuns("Space")
        reference, _ = ranks.alone(lambda: shared(ranks.whole(ranks.ellipsoid())))
        output, _ = shared(data)
        ranks.check(self, expect(output, reference, "Solution", data))

    def test_a_basis_that_one_rank_has_read(self):
        mesh = ranks.ellipsoid()
        for rank in {0, LAST}:
            def basis():
                return ranks.run(ranks.make("ConnectivityAwareBasis", gathers=True), ranks.whole(mesh))[0]
            alone = ranks.alone(basis)
            given = vtkPolyData()
            if ranks.RANK == rank:
                given.DeepCopy(alone)
            for kind in ("first", "last", "contiguous"):  # whatever the order of points
                data = ranks.piece(mesh, kind)
                solver = ranks.make("ScreenedPoisson", gathers=True)
                solver.SetInputDataObject(1, given)
                output = ranks.run(solver, data)[0]
                reference = ranks.alone(
                    lambda: ranks.run(ranks.make("ScreenedPoisson", gathers=True), ranks.whole(mesh))[0])
                ranks.check(self, expect(output, reference, "Solution", data))

    def test_a_basis_that_was_saved(self):
        """All ranks or one make the basis, and all or one read it."""
        mesh = ranks.ellipsoid()
        data = ranks.piece(mesh, "contiguous")
        reference = ranks.alone(
            lambda: ranks.run(ranks.make("ScreenedPoisson", gathers=True), ranks.whole(mesh))[0])

        def saved(name, pieces, piece, together):
            basis = ranks.run(
                ranks.make("ConnectivityAwareBasis", gathers=not together), data)[0]
            path = os.path.join(folder, name)
            writer = vtkXMLPPolyDataWriter()
            writer.SetFileName(path)
            writer.SetInputDataObject(basis)
            writer.SetNumberOfPieces(pieces)
            writer.SetStartPiece(piece)
            writer.SetEndPiece(piece)
            if pieces == 1:
                writer.SetController(None)
            if pieces > 1 or ranks.RANK == 0:
                writer.Write()
            ranks.CONTROLLER.Barrier()
            return path

        def read(path, pieces, piece):
            reader = vtkXMLPPolyDataReader()
            reader.SetFileName(path)
            reader.UpdatePiece(piece, pieces, 0)
            return reader.GetOutput()

        def solved(basis, surface, together=False):
            solver = ranks.make("ScreenedPoisson", gathers=not together)
            solver.SetInputDataObject(1, basis)
            return ranks.run(solver, surface)[0]

        with tempfile.TemporaryDirectory() as own:
            letters = ranks.gathered([ord(letter) for letter in own if ranks.RANK == 0])
            folder = "".join(chr(int(letter)) for letter in letters)
            for name, pieces, piece, together in (
                    ("all.pvtp", ranks.RANKS, ranks.RANK, False), ("one.pvtp", 1, 0, False),
                    ("together.pvtp", ranks.RANKS, ranks.RANK, True)):
                path = saved(name, pieces, piece, together)
                problems = []
                for all_compute in (False, True):
                    output = solved(read(path, ranks.RANKS, ranks.RANK), data, all_compute)
                    problems += expect(output, reference, "Solution", data)
                output = ranks.alone(lambda: solved(read(path, 1, 0), ranks.whole(mesh)))
                problems += expect(output, reference, "Solution", ranks.whole(mesh))
                ranks.check(self, problems)

    def test_a_basis_of_another_mesh_is_refused_on_all_ranks(self):
        basis = ranks.make("ConnectivityAwareBasis", gathers=True)
        basis.SetInputDataObject(0, ranks.piece(ranks.two(), "contiguous"))
        solver = ranks.make("ScreenedPoisson", gathers=True)
        solver.SetBasisConnection(basis.GetOutputPort())
        messages = []
        solver.AddObserver("ErrorEvent", lambda *_: messages.append(1))
        output = ranks.run(solver, ranks.piece(ranks.ellipsoid(), "contiguous"))[0]
        problems = ["not empty"] if output.GetNumberOfPoints() else []
        if len(messages) != (ranks.RANK == 0):
            problems.append(f"{len(messages)} messages")
        ranks.check(self, problems)

    def test_a_chain_of_clip_basis_and_solver(self):
        def chain(data):
            clip, basis = ranks.make("ClipToOctree", gathers=True), ranks.make("ConnectivityAwareBasis", gathers=True)
            solver = ranks.make("ScreenedPoisson", gathers=True)
            clip.SetInputDataObject(0, data)
            basis.SetInputConnection(clip.GetOutputPort())
            solver.SetInputConnection(basis.GetOutputPort())
            solver.Update()
            return solver.GetOutputDataObject(0)
        reference = ranks.alone(lambda: chain(ranks.whole(ranks.ellipsoid())))
        output = chain(ranks.piece(ranks.ellipsoid(), "contiguous"))
        ours, theirs = result(output, "Solution"), result(reference, "Solution")
        problems = []
        if ranks.RANK == 0 and not ranks.apart(numpy.sort(ours), numpy.sort(theirs)) < ROUNDING:
            problems.append("the solution on the clipped mesh differs")
        if ranks.RANK > 0 and ours.size:
            problems.append("points on a rank that has none")
        ranks.check(self, problems)

    def test_reports_of_earlier_runs_go(self):
        for gathers in (False, True):
            with self.subTest(gathers=gathers):
                data = ranks.piece(ranks.ellipsoid(), "contiguous")
                ranks.add(data.GetFieldData(), "Misfit", numpy.array([7.0]))
                fields = ranks.run(ranks.make("ScreenedPoisson", gathers=gathers), data)[0].GetFieldData()
                ranks.check(self, [name for name, is_there in (("Misfit", False), ("given", True), (
                    "Converged", True)) if bool(fields.HasArray(name)) != is_there])

    def test_sources_wherever_they_are(self):
        mesh = ranks.ellipsoid()
        sources = [(1, 0, 0), (0, 0, 0.6), (-1, 0.1, 0)]
        data = ranks.piece(mesh, "contiguous")

        def distance(data, given):
            filter_ = ranks.make("GeodesicDistance", hats=True)
            filter_.SetInputDataObject(2, given)
            return ranks.run(filter_, data)[0]
        reference = ranks.alone(lambda: distance(ranks.whole(mesh), places(sources)))
        parts = {
            "first": sources if ranks.RANK == 0 else [],
            "last": sources if ranks.RANK == LAST else [],
            "all": sources,
            "divided": [s for k, s in enumerate(sources) if k % ranks.RANKS == ranks.RANK]}
        for where, own in parts.items():
            with self.subTest(where=where):
                output = distance(data, places(own))
                ranks.check(self, expect(output, reference, "Distance", data))

    def test_lines_of_unstructured_grids_wherever_they_are(self):
        mesh = ranks.ellipsoid()
        data = ranks.piece(mesh, "contiguous")

        def line():
            grid = places([(1, 0, 0), (0.7, 0.5, 0.1), (0, 0.8, 0)])
            grid.InsertNextCell(VTK_POLY_LINE, 3, [0, 1, 2])
            return grid

        def distance(data, given):
            filter_ = ranks.make("GeodesicDistance", hats=True)
            filter_.SetInputDataObject(2, given)
            return ranks.run(filter_, data)[0]
        reference = ranks.alone(lambda: distance(ranks.whole(mesh), line()))
        at_points = ranks.alone(
            lambda: distance(ranks.whole(mesh), places([(1, 0, 0), (0.7, 0.5, 0.1), (0, 0.8, 0)])))
        apart = ranks.apart(result(reference, "Distance"), result(at_points, "Distance"))
        output = distance(data, line() if ranks.RANK == LAST else places([]))
        ranks.check(self, expect(output, reference, "Distance", data) + (
            [] if apart > 1e-2 else ["lines do not count"]))

    def test_given_values_on_every_rank_count_once(self):
        mesh = ranks.ellipsoid()
        given = [(1, 0, 0), (0, 0, 0.6), (-1, 0.1, 0), (0, -0.8, 0)]
        data = ranks.piece(mesh, "contiguous")

        def interpolated(data):
            filter_ = ranks.make("HarmonicInterpolation")
            filter_.SetInputArrayToProcess(0, 0, 0, ranks.POINTS, "None")
            filter_.SetInputDataObject(2, places(given, [1.0, 2.0, 3.0, 4.0]))
            return ranks.run(filter_, data)[0]
        reference = ranks.alone(lambda: interpolated(ranks.whole(mesh)))
        ranks.check(self, expect(interpolated(data), reference, "Interpolated", data))

    def test_observations_on_borders_count_once(self):
        mesh = ranks.ellipsoid()
        points = numpy.array([(1, 0, 0), (0.7, 0.5, 0.1), (0, 0.8, 0), (-0.7, 0.5, 0), (-1, 0.1, 0)])
        data = ranks.piece(mesh, "contiguous")

        def lines(first, last):
            polyline = vtkPolyData()
            where = vtkPoints()
            where.SetDataTypeToDouble()
            for point in points[first:last + 1]:
                where.InsertNextPoint(*point)
            polyline.SetPoints(where)
            cells = vtkCellArray()
            for k in range(last - first):
                cells.InsertNextCell(2, [k, k + 1])
            polyline.SetLines(cells)
            ranks.add(polyline.GetPointData(), "v", numpy.sin(3.0 * points[first:last + 1, 0]))
            polyline.GetPointData().SetActiveScalars("v")
            return polyline

        def predicted(data, observations):
            filter_ = ranks.make("GaussianField")
            filter_.SetInputArrayToProcess(0, 0, 0, ranks.POINTS, "None")
            filter_.SetRange(1.0)
            filter_.SetObservationNoise(0.3)
            filter_.SetInputDataObject(2, observations)
            return ranks.run(filter_, data)[0]
        reference = ranks.alone(lambda: predicted(ranks.whole(mesh), lines(0, 4)))
        last = len(points) - 1
        own = [last * k // ranks.RANKS for k in (ranks.RANK, ranks.RANK + 1)]
        output = predicted(data, lines(*own))
        ranks.check(self, expect(output, reference, "Prediction", data))


class Arrays(unittest.TestCase):
    def test_arrays_of_numpy_are_those_of_one_rank(self):
        problems = []
        for rank in range(ranks.RANKS):
            if ranks.RANK == rank:  # the others do not even know
                points, triangles = ranks.ellipsoid()
                eigenvalues, modes = gridfem.spectrum((1 + rank) * points, triangles, 4, Depth=4)
                shape = gridfem.flow(points, triangles, 2, Depth=4)
                if modes.shape[0] != len(points) or shape.shape != points.shape:
                    problems.append("arrays of another surface")
                scaled = (1 + rank) ** 2 * eigenvalues[1:]
                if not numpy.allclose(scaled, gridfem.spectrum(points, triangles, 4, Depth=4)[0][1:],
                                      rtol=1e-4):
                    problems.append(f"eigenvalues {eigenvalues}")
        ranks.check(self, problems)


class Composite(unittest.TestCase):
    MESHES = (ranks.ellipsoid, ranks.bowl, ranks.two)
    # Results of all ranks together, to the tolerance of the solver, and results that rank 0 gathers.
    RESULTS = {"ScreenedPoisson": ("Solution", 1e-8), "HarmonicInterpolation": ("Interpolated", ROUNDING)}

    def references(self, name="ScreenedPoisson"):
        return [ranks.alone(lambda mesh=mesh: ranks.run(
            ranks.make(name), ranks.prepare(ranks.whole(mesh())))[0]) for mesh in self.MESHES]

    def expect_blocks(self, leaves, references, pieces, name="ScreenedPoisson"):
        array, tolerance = self.RESULTS[name]
        problems = []
        for leaf, reference, data in zip(leaves, references, pieces):
            if data.GetNumberOfPoints():
                problems += ["a block is missing"] if leaf is None else expect(
                    leaf, reference, array, data, tolerance)
        ranks.check(self, problems)

    def pieces(self):
        """The second block is on the last rank only."""
        return [ranks.prepare(ranks.piece(mesh(), kind))
                for mesh, kind in zip(self.MESHES, ("contiguous", "last", "ghosts"))]

    def test_blocks_that_some_ranks_have_not(self):
        pieces = self.pieces()
        blocks = vtkMultiBlockDataSet()
        inner = vtkMultiBlockDataSet()
        blocks.SetBlock(0, pieces[0])
        if pieces[1].GetNumberOfPoints():
            inner.SetBlock(1, pieces[1])
            blocks.SetBlock(1, inner)
        blocks.SetBlock(2, pieces[2] if ranks.RANK != 1 or ranks.RANKS == 1 else pieces[2])
        for name in self.RESULTS:
            output = ranks.run(ranks.make(name), blocks)[0]
            inner = output.GetBlock(1)
            leaves = [output.GetBlock(0), inner.GetBlock(1) if inner else None, output.GetBlock(2)]
            self.expect_blocks(leaves, self.references(name), pieces, name)

    def test_partitions_that_some_ranks_have_not(self):
        pieces = self.pieces()
        sets = vtkPartitionedDataSetCollection()
        for index, data in enumerate(pieces):
            partitions = vtkPartitionedDataSet()
            if data.GetNumberOfPoints():
                partitions.SetPartition(0, data)
            sets.SetPartitionedDataSet(index, partitions)
        for name in self.RESULTS:
            output = ranks.run(ranks.make(name), sets)[0]
            leaves = [output.GetPartitionedDataSet(k).GetPartition(0)
                      if output.GetPartitionedDataSet(k).GetNumberOfPartitions() else None
                      for k in range(3)]
            self.expect_blocks(leaves, self.references(name), pieces, name)

    def test_a_rank_without_any_block(self):
        data = ranks.piece(ranks.ellipsoid(), "first")
        blocks = vtkMultiBlockDataSet()
        if ranks.RANK == 0:
            blocks.SetBlock(0, data)
        output = ranks.run(ranks.make("ScreenedPoisson"), blocks)[0]
        self.expect_blocks([output.GetBlock(0)], self.references(), [data])

    def test_a_block_that_fails_leaves_the_others(self):
        pieces = self.pieces()
        pieces[0].GetPointData().RemoveArray("f")
        blocks = vtkMultiBlockDataSet()
        for index, data in enumerate(pieces):
            if data.GetNumberOfPoints():
                blocks.SetBlock(index, data)
        filter_ = ranks.make("ScreenedPoisson")
        messages = []
        filter_.AddObserver("ErrorEvent", lambda *_: messages.append(1))
        output = ranks.run(filter_, blocks)[0]
        problems = []
        if len(messages) != (ranks.RANK == 0):
            problems.append(f"{len(messages)} messages")
        if output.GetBlock(0).GetNumberOfPoints():
            problems.append("the first block is not empty")
        ranks.check(self, problems)
        self.expect_blocks([output.GetBlock(1), output.GetBlock(2)], self.references()[1:],
                           pieces[1:])

    def test_blocks_on_one_rank_and_a_piece_on_another_are_refused(self):
        if ranks.RANKS == 1:
            return
        data = ranks.piece(ranks.ellipsoid(), "contiguous")
        if ranks.RANK == 0:
            blocks = vtkMultiBlockDataSet()
            blocks.SetBlock(0, data)
            data = blocks
        filter_ = ranks.make("ScreenedPoisson")
        messages = []
        filter_.AddObserver("ErrorEvent", lambda *_: messages.append(1))
        ranks.run(filter_, data)
        ranks.check(self, [] if len(messages) == (ranks.RANK == 0) else [f"{len(messages)} messages"])


if __name__ == "__main__":
    ranks.main()
