"""Tests Laplace Spectrum by all ranks together. Every rank's own piece has the modes of one rank. If
the ranks cannot compute together, rank 0 gathers."""
import unittest

import numpy
from vtkmodules.util import numpy_support

import ranks

MODES = 8


def made(**properties):
    return ranks.make("LaplaceSpectrum", 4, **{
        "NumberOfModes": MODES, "Tolerance": 1e-11, **properties})


def number(output, name):
    array = output.GetFieldData().GetArray(name)
    return array.GetValue(0) if array else None


def values_of(output):
    return numpy_support.vtk_to_numpy(output.GetFieldData().GetArray("Eigenvalues"))


class DistributedSpectrum(unittest.TestCase):
    def same_as_alone(self, mesh, kind, **properties):
        mine = ranks.piece(mesh, kind)
        output, table, _ = ranks.run(made(**properties), mine)
        whole = ranks.alone(lambda: ranks.run(made(**properties), ranks.whole(mesh))[0])
        problems = [] if number(output, "Distributed") == 1 else ["rank 0 has gathered"]
        problems += [] if number(output, "Converged") == 1 else ["not converged"]
        expected = values_of(whole)
        found = values_of(output)
        if found.shape != expected.shape or ranks.apart(found, expected) > 1e-8 * expected.max():
            problems.append(f"values {found} instead of {expected}")
        if mine.GetNumberOfPoints():
            origin = numpy_support.vtk_to_numpy(mine.GetPointData().GetArray("origin"))
            theirs = ranks.arrays(whole.GetPointData())
            simple = {f"Mode{k:03}": theirs[f"Mode{k:03}"] for k in range(len(expected))
                      if self.is_simple(expected, k)}
            problems += ranks.compare(ranks.arrays(output.GetPointData()), simple, origin, 1e-4,
                                      kind)
            problems += [] if output.GetNumberOfCells() == mine.GetNumberOfCells() else ["cells"]
        rows = table.GetNumberOfRows()
        if rows != (len(expected) if ranks.RANK == 0 else 0):
            problems.append(f"the table has {rows} rows")
        ranks.check(self, problems)

    @staticmethod
    def is_simple(values, k):
        """The mode is far from its neighbors, so that it is unique up to its sign."""
        gaps = numpy.diff(values)
        return 0 < k < len(values) - 1 and min(gaps[k - 1], gaps[k]) > 0.05 * values[k]

    def test_any_pieces(self):
        for kind in ("last", "scattered", "one rank is empty", "ghosts", "all on all"):
            with self.subTest(kind=kind):
                self.same_as_alone(ranks.ellipsoid(), kind)

    def test_other_surfaces(self):
        for mesh in (ranks.two(), ranks.bowl(), ranks.soup()):
            self.same_as_alone(mesh, "scattered")

    def test_hat_functions(self):
        for mesh, kind in ((ranks.ellipsoid(), "contiguous"), (ranks.bowl(), "ghosts")):
            self.same_as_alone(mesh, kind, FunctionSpace=1)

    def test_zero_on_the_boundary(self):
        for kind, space in (("scattered", 0), ("one rank is empty", 0), ("ghosts", 1)):
            with self.subTest(kind=kind, space=space):
                self.same_as_alone(ranks.bowl(), kind, ZeroBoundaryValues=1, FunctionSpace=space)

    def test_time_steps_compute_nothing(self):
        filter_ = made(AllModes=False)
        mine = ranks.piece(ranks.ellipsoid(), "contiguous")
        filter_.SetInputDataObject(0, mine)
        events = []
        filter_.AddObserver("ProgressEvent", lambda *_: events.append(1))
        shown = []
        problems = []
        for time in (1.0, 3.0, 2.0, 3.0):
            before = len(events)
            filter_.UpdateTimeStep(time)
            output = filter_.GetOutputDataObject(0)
            shown.append(ranks.arrays(output.GetPointData())["Mode"])
            if number(output, "Distributed") != 1:
                problems.append("rank 0 has gathered")
            if len(shown) > 1 and len(events) - before > 3:
                problems.append(f"time {time}: {len(events) - before} events")
            if output.GetInformation().Get(output.DATA_TIME_STEP()) != time:
                problems.append(f"time {time} is not on the output")
        if not (shown[1] == shown[3]).all() or (shown[0] == shown[1]).all():
            problems.append("not the modes of their times")
        mine.GetPoints().Modified()
        before = len(events)
        filter_.UpdateTimeStep(1.0)
        if len(events) - before <= 3:
            problems.append("a surface that has changed computes nothing")
        ranks.check(self, problems)

    def test_rank_0_gathers_what_is_left_to_it(self):
        for properties in ({"WeldCoincidentPoints": False}, {"Accuracy": 0.4}):
            output = ranks.run(made(**properties), ranks.piece(ranks.bowl(), "contiguous"))[0]
            ranks.check(self, [] if number(output, "Distributed") is None and
                        number(output, "Converged") == 1 else [str(properties)])
        filter_ = made()
        for together in (True, False, True):
            filter_.SetBlocksAsOne(not together)
            output = ranks.run(filter_, ranks.piece(ranks.bowl(), "ghosts"))[0]
            ranks.check(self, [] if (number(output, "Distributed") == 1) == together and
                        number(output, "Converged") == 1 else [str(together)])

    def test_what_fails_on_one_rank_fails_on_all(self):
        filter_ = made()
        mine = ranks.piece(ranks.ellipsoid(), "contiguous")
        if ranks.RANK == ranks.RANKS - 1:
            numpy_support.vtk_to_numpy(mine.GetPoints().GetData())[3] = numpy.nan
        messages = ranks.heard(filter_)
        output = ranks.run(filter_, mine)[0]
        problems = ["the output is not empty"] if output.GetNumberOfPoints() else []
        if len(messages) != (1 if ranks.RANK == 0 else 0):
            problems.append(f"{len(messages)} messages: {messages}")
        ranks.check(self, problems)
        output = ranks.run(filter_, ranks.piece(ranks.ellipsoid(), "contiguous"))[0]
        ranks.check(self, [] if number(output, "Distributed") == 1 else ["not computed again"])


if __name__ == "__main__":
    ranks.main()
