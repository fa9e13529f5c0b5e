"""Tests Screened Poisson by all ranks together. Every rank's own piece has the solution of one rank. If
the ranks cannot compute together, rank 0 gathers."""
import unittest

import numpy
from vtkmodules.util import numpy_support

import ranks


def made(**properties):
    return ranks.make("ScreenedPoisson", 5, Tolerance=1e-11, **properties)


def number(output, name):
    array = output.GetFieldData().GetArray(name)
    return array.GetValue(0) if array else None


class Distributed(unittest.TestCase):
    def same_as_alone(self, mesh, kind, **properties):
        mine = ranks.piece(mesh, kind)
        filter_ = made(**properties)
        warnings = []
        filter_.AddObserver("WarningEvent", lambda *_: warnings.append("a warning"))
        output, table = ranks.run(filter_, mine)
        whole = ranks.alone(lambda: ranks.run(ranks.make(
            "ScreenedPoisson", 5, Tolerance=1e-11, **properties), ranks.whole(mesh))[0])
        problems = warnings
        if number(output, "Distributed") != 1:
            problems.append("rank 0 has gathered")
        if mine.GetNumberOfPoints():
            origin = numpy_support.vtk_to_numpy(mine.GetPointData().GetArray("origin"))
            expected = ranks.arrays(whole.GetPointData())["Solution"]
            solution = ranks.arrays(output.GetPointData())["Solution"]
            problems += ranks.compare(
                {"Solution": solution}, {"Solution": expected}, origin, 1e-8, kind)
            problems += [] if output.GetNumberOfCells() == mine.GetNumberOfCells() else ["cells"]
        rows = table.GetNumberOfRows()
        if (rows > 0) != (ranks.RANK == 0):
            problems.append(f"the table has {rows} rows")
        problems += self.wrong_history(table)
        ranks.check(self, problems)

    def wrong_history(self, table):
        """Every iteration has residuals, and they fall."""
        problems = []
        for name in ("EnergyResidual", "Residual") if table.GetNumberOfRows() else ():
            values = numpy_support.vtk_to_numpy(table.GetColumnByName(name))
            if not numpy.isfinite(values).all() or values[-1] > 1e-6 * values[0] or values[0] > 10.0:
                problems.append(f"{name} is {values}")
        return problems

    def test_any_pieces(self):
        for kind in ("first", "last", "contiguous", "scattered", "one rank is empty", "ghosts",
                     "all on all"):
            with self.subTest(kind=kind):
                self.same_as_alone(ranks.ellipsoid(), kind)

    def test_other_surfaces(self):
        for mesh in (ranks.two(), ranks.bowl(), ranks.soup()):
            self.same_as_alone(mesh, "scattered", ScreeningWeight=0.0, UseValueGradient=True)

    def test_gradients_and_units(self):
        for units in (0, 1, 2):
            self.same_as_alone(ranks.ellipsoid(), "contiguous", UseValueGradient=True,
                               GradientScale=2.0, ParameterUnits=units, ConnectivityAware=False)

    def test_points_of_two_pieces_have_one_value(self):
        mine = ranks.piece(ranks.ellipsoid(), "scattered")
        output = ranks.run(made(), mine)[0]
        origin = numpy_support.vtk_to_numpy(mine.GetPointData().GetArray("origin"))
        solution = ranks.arrays(output.GetPointData())["Solution"]
        places = ranks.gathered(origin)
        values = ranks.gathered(solution)
        first = dict(zip(places[::-1], values[::-1]))
        differ = [p for p, v in zip(places, values) if first[p] != v]
        ranks.check(self, [f"point {p}" for p in differ])

    def test_rank_0_gathers_what_is_left_to_it(self):
        for properties in ({"WantedError": 0.2}, {"TrackMetric": True}):
            output = ranks.run(made(**properties), ranks.piece(ranks.bowl(), "contiguous"))[0]
            ranks.check(self, [] if number(output, "Distributed") is None and
                        number(output, "Converged") == 1 else [str(properties)])

    def test_estimates_the_errors_of_one_rank(self):
        warnings = []

        def solve(mesh):
            filter_ = ranks.make("ScreenedPoisson", 5, Tolerance=0.0)
            filter_.AddObserver("WarningEvent", lambda *_: warnings.append("a warning"))
            return ranks.run(filter_, mesh)[0]
        output = solve(ranks.piece(ranks.ellipsoid(), "contiguous"))
        problems = list(warnings)
        whole = ranks.alone(lambda: solve(ranks.whole(ranks.ellipsoid())))
        for name in ("DiscretizationError", "LargestDiscretizationError", "TrustedEstimate"):
            found, expected = number(output, name), number(whole, name)
            if not abs(found - expected) <= 0.1 * expected:
                problems.append(f"{name} is {found} instead of {expected}")
        # The iteration ends when this part remains: the default of Accuracy is a tenth.
        if not 0.0 < number(output, "AlgebraicError") <= 0.2 * number(output, "DiscretizationError"):
            problems.append(f"AlgebraicError is {number(output, 'AlgebraicError')}")
        if number(output, "Distributed") != 1 or number(output, "Converged") != 1:
            problems.append("not by all ranks, or not converged")
        ranks.check(self, problems)

    def test_what_fails_on_one_rank_fails_on_all(self):
        filter_ = made()
        for damage in ("value", "place", "array"):
            mine = ranks.piece(ranks.ellipsoid(), "contiguous")
            if ranks.RANK == ranks.RANKS - 1 and damage == "array":
                mine.GetPointData().RemoveArray("f")
            elif ranks.RANK == ranks.RANKS - 1:
                array = (mine.GetPointData().GetArray("f") if damage == "value"
                         else mine.GetPoints().GetData())
                numpy_support.vtk_to_numpy(array)[3] = numpy.nan
            messages = ranks.heard(filter_)
            output = ranks.run(filter_, mine)[0]
            problems = ["the output is not empty"] if output.GetNumberOfPoints() else []
            if len(messages) != (1 if ranks.RANK == 0 else 0):
                problems.append(f"{damage}: {len(messages)} messages: {messages}")
            ranks.check(self, problems)
        output = ranks.run(filter_, ranks.piece(ranks.ellipsoid(), "contiguous"))[0]
        ranks.check(self, [] if number(output, "Distributed") == 1 else ["not computed again"])


if __name__ == "__main__":
    ranks.main()
