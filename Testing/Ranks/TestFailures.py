"""Tests that a failure on one rank ends the run on all, with one message of rank 0, which gathers the
surface."""
import unittest

import numpy
from vtkmodules.util import numpy_support
from vtkmodules.vtkCommonCore import vtkCommand, vtkIdTypeArray, vtkPoints
from vtkmodules.vtkCommonDataModel import (
    VTK_TETRA, vtkPolyData, vtkSelection, vtkSelectionNode, vtkUnstructuredGrid)

import ranks

LAST = ranks.RANKS - 1


class Failures(unittest.TestCase):
    def run_and_listen(self, filter_, data):
        """Returns the messages of a run, and whether all outputs are empty."""
        messages = ranks.heard(filter_)
        outputs = ranks.run(filter_, data)
        sizes = [output.GetNumberOfElements(kind) for output in outputs for kind in (0, 1)]
        return messages, not any(sizes)

    def refused(self, filter_, data, text):
        messages, is_empty = self.run_and_listen(filter_, data)
        problems = [] if is_empty else ["an output is not empty"]
        if len(messages) != (1 if ranks.RANK == 0 else 0):
            problems.append(f"{len(messages)} messages: {messages}")
        if ranks.RANK == 0 and messages and text not in messages[0]:
            problems.append(f"the message is {messages[0]}")
        if filter_.GetErrorCode() == 0:
            problems.append("no error code")
        ranks.check(self, problems)

    def computed(self, filter_, data):
        messages, is_empty = self.run_and_listen(filter_, data)
        problems = [f"messages {messages}"] if messages else []
        if is_empty and data.GetNumberOfPoints():
            problems.append("nothing was computed")
        ranks.check(self, problems)

    def good(self):
        return ranks.piece(ranks.ellipsoid(), "contiguous")

    def test_a_bad_number_on_one_rank(self):
        filter_ = ranks.make("ScreenedPoisson", gathers=True)
        data = self.good()
        if ranks.RANK == LAST:
            numpy_support.vtk_to_numpy(data.GetPointData().GetArray("f"))[9] = numpy.nan
        self.refused(filter_, data, "'f' has a NaN")
        self.computed(filter_, self.good())

    def test_more_than_the_first_rank_can_gather(self):
        filter_ = ranks.make("ScreenedPoisson", gathers=True)
        data = ranks.piece(ranks.ellipsoid(300, 150), "last")
        with ranks.growing_by(4 << 20 if ranks.RANK == 0 else None):  # the surface takes 6 MB
            self.refused(filter_, data, "What rank 0 gathers needs about")
        self.computed(filter_, self.good())

    def test_a_selection(self):
        """A rank would evaluate the query only on its own part of the surface."""
        ids = vtkIdTypeArray()
        ids.InsertNextValue(3)
        node = vtkSelectionNode()
        node.SetFieldType(vtkSelectionNode.POINT)
        node.SetContentType(vtkSelectionNode.INDICES)
        node.SetSelectionList(ids)
        selection = vtkSelection()
        selection.AddNode(node)
        for name, port in (("SurfaceDetail", 2), ("GeodesicDistance", 3)):
            filter_ = ranks.make(name, gathers=True)
            filter_.SetInputDataObject(port, selection)
            self.refused(filter_, self.good(), "one MPI rank only")
            filter_.SetInputDataObject(port, None)
            self.computed(filter_, self.good())

    def test_an_array_that_one_rank_lacks(self):
        filter_ = ranks.make("ScreenedPoisson", gathers=True)
        data = self.good()
        if ranks.RANK == LAST:
            data.GetPointData().RemoveArray("f")
        self.refused(filter_, data, f"lacks this array: 'f' (rank {LAST})")
        data = self.good()
        if ranks.RANK == LAST:
            data.GetPointData().RemoveArray("label")
        self.computed(filter_, data)  # not asked for

    def test_an_array_that_nobody_has(self):
        filter_ = ranks.make("ScreenedPoisson", gathers=True)
        filter_.SetInputArrayToProcess(0, 0, 0, ranks.POINTS, "nothing")
        self.refused(filter_, self.good(), "'nothing' does not exist")

    def test_a_wrong_property(self):
        filter_ = ranks.make("ScreenedPoisson", gathers=True, QuadratureDegree=3)
        self.refused(filter_, self.good(), "3")
        filter_.SetQuadratureDegree(2)
        self.computed(filter_, self.good())

    def test_a_cell_with_a_wrong_point_on_one_rank(self):
        data = self.good()
        if ranks.RANK == LAST:
            data.GetPolys().InsertNextCell(3, [0, 1, 100000])
            for name in ("c", "originCell"):
                data.GetCellData().RemoveArray(name)
        self.refused(ranks.make("ClipToOctree", gathers=True), data, f"On rank {LAST}: ")

    def test_global_ids_of_two_places(self):
        data = ranks.piece(ranks.ellipsoid(), "contiguous", global_ids=True)
        if ranks.RANK == LAST:
            numbers = numpy_support.vtk_to_numpy(data.GetPointData().GetGlobalIds())
            numbers[:] = numbers[::-1].copy()
        self.refused(ranks.make("ScreenedPoisson", gathers=True), data, "global point id")

    def test_no_surface_anywhere(self):
        data = self.good()
        data.SetPolys(None)
        for name in ("c", "originCell"):
            data.GetCellData().RemoveArray(name)
        self.refused(ranks.make("ScreenedPoisson", gathers=True), data, "no polygons")
        filter_ = ranks.make("ScreenedPoisson", gathers=True)
        messages, is_empty = self.run_and_listen(filter_, vtkPolyData())
        ranks.check(self, messages + ([] if is_empty else ["not empty"]))

    def test_a_volume_in_pieces(self):
        volume = vtkUnstructuredGrid()
        points = vtkPoints()
        for corner in ((0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)):
            points.InsertNextPoint(corner[0] + ranks.RANK, *corner[1:])
        volume.SetPoints(points)
        volume.InsertNextCell(VTK_TETRA, 4, range(4))
        filter_ = ranks.make("ClipToOctree", gathers=True)
        self.refused(filter_, volume, "Extract Surface")
        if ranks.RANK > 0:
            volume = vtkUnstructuredGrid()
        messages, is_empty = self.run_and_listen(filter_, volume)
        problems = messages + (["empty"] if is_empty == (ranks.RANK == 0) else [])
        ranks.check(self, problems)

    def test_an_abort_on_one_rank(self):
        for rank in {0, LAST}:
            filter_ = ranks.make("ScreenedPoisson", gathers=True)
            filter_.SetAbortExecute(1 if ranks.RANK == rank else 0)
            messages, is_empty = self.run_and_listen(filter_, self.good())
            ranks.check(self, messages + ([] if is_empty else ["not empty"]))
            filter_.Modified()
            self.computed(filter_, self.good())

    def test_an_abort_while_the_first_rank_computes(self):
        filter_ = ranks.make("ScreenedPoisson", gathers=True)
        aborted_at = []

        def abort(*_):
            if ranks.RANK == 0 and 0.0 < filter_.GetProgress() < 1.0 and not aborted_at:
                aborted_at.append(filter_.GetProgress())
                filter_.SetAbortExecute(1)
        filter_.AddObserver(vtkCommand.ProgressEvent, abort)
        messages, is_empty = self.run_and_listen(filter_, self.good())
        problems = messages + ([] if is_empty else ["not empty"])
        if ranks.RANK == 0 and not aborted_at:
            problems.append("nothing was aborted")
        ranks.check(self, problems)
        filter_.Modified()
        self.computed(filter_, self.good())

    def test_an_abort_on_any_rank_while_all_compute(self):
        for name in ("ScreenedPoisson", "LaplaceSpectrum", "SpectralSignatures", "SurfaceGradient",
                     "HeatDiffusion", "GeodesicDistance", "ClipToOctree", "ConnectivityAwareBasis"):
            for rank in {0, LAST}:
                filter_ = ranks.make(name)
                aborted_at = []

                def abort(*_, filter_=filter_, aborted_at=aborted_at, rank=rank):
                    if ranks.RANK == rank and filter_.GetProgress() > 0.1 and not aborted_at:
                        aborted_at.append(filter_.GetProgress())
                        filter_.SetAbortExecute(1)
                observer = filter_.AddObserver(vtkCommand.ProgressEvent, abort)
                messages, is_empty = self.run_and_listen(filter_, self.good())
                filter_.RemoveObserver(observer)
                problems = messages + ([] if is_empty else [f"{name}: not empty"])
                if ranks.RANK == rank and not (aborted_at and aborted_at[0] < 0.95):
                    problems.append(f"{name}: aborted at {aborted_at}")
                ranks.check(self, problems)
                filter_.Modified()
                self.computed(filter_, self.good())


if __name__ == "__main__":
    ranks.main()
