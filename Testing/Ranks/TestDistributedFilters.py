"""Tests filters by all ranks together. Every rank's own piece has the answers of one rank, ghost cells
and repeated pieces included, and stages stay. If the ranks cannot compute together, rank 0 gathers."""
import re
import unittest

import numpy
from vtkmodules.util import numpy_support
from vtkmodules.vtkCommonCore import vtkIdTypeArray
from vtkmodules.vtkCommonDataModel import vtkSelection, vtkSelectionNode

import ranks

# A filter, its properties, and the tolerance of the comparison. If eigenvalues are known to 1e-12,
# their modes are known to 1e-6. Misfits of held values end at 1e-7.
CASES = {
    "gradient": ("SurfaceGradient", {}, 1e-8),
    "gradient of vectors": ("SurfaceGradient", {"arrays": {0: "v"}}, 1e-8),
    "gradient of cells": ("SurfaceGradient", {"arrays": {0: "c"}}, 1e-8),
    "heat": ("HeatDiffusion", {"DiffusionTime": 0.01}, 1e-8),
    "heat with a source": ("HeatDiffusion", {"arrays": {1: "f"}}, 1e-8),
    "heat, held": ("HeatDiffusion", {"DiffusionTime": 0.01, "arrays": {2: "mask"}}, 1e-7),
    "heat, further arrays": ("HeatDiffusion", {"arrays": {10: "v", 11: "f2"}}, 1e-8),
    "poisson": ("ScreenedPoisson", {}, 1e-8),
    "poisson, further arrays": ("ScreenedPoisson", {"arrays": {0: "c", 10: "c"}}, 1e-8),
    "poisson, held": (
        "ScreenedPoisson", {"UseValueGradient": True,
                            "arrays": {0: "v", 4: "mask"}}, 1e-7),
    "interpolation": ("ScreenedPoisson", {"ScreeningWeight": 0.0, "arrays": {4: "mask"}}, 1e-7),
    "poisson, weighed": (
        "ScreenedPoisson", {"UseValueGradient": True, "arrays": {3: "c"}}, 1e-8),
    "poisson, unknown": (
        "ScreenedPoisson", {"FillUnknown": True, "UseValueGradient": True,
                            "arrays": {0: "hole"}}, 1e-8),
    "poisson, unknown means": (
        "ScreenedPoisson", {"FillUnknown": True, "ScreeningWeight": 0.0, "arrays": {0: "hole"}}, 1e-8),
    "poisson, flux": ("ScreenedPoisson", {"arrays": {6: "f"}}, 1e-8),
    "poisson, flux in balance": (
        "ScreenedPoisson", {"ScreeningWeight": 0.0, "arrays": {6: "f"}}, 1e-8),
    "poisson, boundary": (
        "ScreenedPoisson", {"BoundaryValues": True, "ScreeningWeight": 0.0}, 1e-7),
    "poisson, all at once": (
        "ScreenedPoisson", {"BoundaryValues": True, "FillUnknown": True,
                            "arrays": {0: "hole", 3: "f2", 4: "mask", 6: "f"}}, 1e-7),
    # A boundary that functions cannot meet takes 500 iterations to 1e-13, on one rank 450. The two stages of
    # a step exchange 35,000 messages, for each of which three ranks on two busy processors wait.
    "heat, boundary": ("HeatDiffusion", {"DiffusionTime": 0.01, "BoundaryValues": True,
                                         "NumberOfSteps": 1, "Tolerance": 1e-8}, 1e-7),
    # Heat is relaxed until distances are right to some 1e-4.
    "distance": ("GeodesicDistance", {}, 2e-3),
    "distance from points": ("GeodesicDistance", {"arrays": {0: "spots"}}, 2e-3),
    "signatures": ("SpectralSignatures", {}, 1e-5),
    "gradient, hats": ("SurfaceGradient", {"FunctionSpace": 1}, 1e-8),
    "heat, hats": ("HeatDiffusion", {"FunctionSpace": 1, "DiffusionTime": 0.01}, 1e-8),
    "heat, hats, boundary": ("HeatDiffusion", {"FunctionSpace": 1, "DiffusionTime": 0.01, "BoundaryValues": True}, 1e-7),
    "poisson, hats": ("ScreenedPoisson", {"FunctionSpace": 1}, 1e-8),
    "poisson, hats, all at once": (
        "ScreenedPoisson", {"FunctionSpace": 1, "BoundaryValues": True, "FillUnknown": True,
                            "arrays": {0: "hole", 3: "f2", 4: "mask", 6: "f"}}, 1e-7),
    "distance, hats": ("GeodesicDistance", {"FunctionSpace": 1, "arrays": {0: "spots"}}, 2e-3),
    "signatures, hats": ("SpectralSignatures", {"FunctionSpace": 1}, 1e-5),
    "high pass": ("SpectralSignatures", {"FilterType": 2, "FirstMode": 3, "arrays": {0: "f"}}, 1e-5),
}
KINDS = ("last", "contiguous", "ghosts", "scattered", "one rank is empty", "all on all")
POINT_NAMES = ("f", "f2", "v", "mask", "spots", "hole")
# Filters on the bowl, which has a boundary. Their warnings are the same on one rank.
OF_BOUNDARIES = ("poisson, flux", "poisson, flux in balance", "poisson, boundary",
                 "poisson, all at once", "heat, boundary", "heat, hats, boundary",
                 "poisson, hats, all at once")
# Filters whose points an array or a selection takes: the index of the array, and the port.
CHOICES_OF_POINTS = {"heat, held": (2, 2), "poisson, held": (4, 2), "distance from points": (0, 3)}


def made(case, depth=4, **changes):
    name, properties, _ = CASES[case]
    properties = {**properties, **changes}
    arrays = properties.pop("arrays", {})
    filter_ = ranks.make(name, depth, **properties)
    for index, array in arrays.items():
        filter_.SetInputArrayToProcess(index, 0, 0, int(array not in POINT_NAMES), array)
    return filter_


def with_vectors(data):
    """Adds arrays. `v` has three components, `f2` squares. `mask` has some points near one end, `spots`
    a few far from each other. `hole` is `f`, unknown beyond a plane, where most points lie."""
    if data.GetNumberOfPoints():
        points = numpy_support.vtk_to_numpy(data.GetPoints().GetData())
        origin = numpy_support.vtk_to_numpy(data.GetPointData().GetArray("origin"))
        ranks.add(data.GetPointData(), "v", points[:, [1, 2, 0]] ** 2)
        ranks.add(data.GetPointData(), "mask",
                  ((origin % 9 == 0) & (points[:, 0] > 0.3)).astype(numpy.uint8))
        ranks.add(data.GetPointData(), "spots", (origin % 120 == 60).astype(numpy.uint8))
        f = numpy_support.vtk_to_numpy(data.GetPointData().GetArray("f"))
        ranks.add(data.GetPointData(), "f2", f ** 2)
        ranks.add(data.GetPointData(), "hole", numpy.where(
            (points[:, 0] > 0.4) & (origin % 11 > 0), numpy.nan, f))
    return data


def selection_of(data, name, kind=vtkSelectionNode.POINT):
    """Selects the points of this rank at which an array is not 0."""
    ids = vtkIdTypeArray()
    if data.GetNumberOfPoints():
        array = numpy_support.vtk_to_numpy(data.GetPointData().GetArray(name))
        for point in numpy.flatnonzero(array):
            ids.InsertNextValue(point)
    node = vtkSelectionNode()
    node.SetFieldType(kind)
    node.SetContentType(vtkSelectionNode.INDICES)
    node.SetSelectionList(ids)
    selection = vtkSelection()
    selection.AddNode(node)
    return selection


def numbers_in(warning):
    """Returns the counted part of a warning. The rest names an object and a file."""
    return re.findall(r"(?:^|\s)(\d+)(?=\s)", warning.rsplit("):", 1)[-1])


def number(output, name):
    array = output.GetFieldData().GetArray(name)
    return array.GetValue(0) if array else None


class DistributedFilters(unittest.TestCase):
    def same_as_alone(self, case, mesh, kind):
        mine = with_vectors(ranks.piece(mesh, kind))
        filter_ = made(case)
        problems = []
        warnings = ranks.heard(filter_, "WarningEvent")
        outputs = ranks.run(filter_, mine)
        of_one = made(case)
        expected_warnings = ranks.heard(of_one, "WarningEvent")
        whole = ranks.alone(lambda: ranks.run(of_one, with_vectors(ranks.whole(mesh)))[0])
        if [numbers_in(text) for text in warnings] != [
                numbers_in(text) for text in expected_warnings * (ranks.RANK == 0)]:
            problems.append(f"the warnings are {warnings} instead of {expected_warnings}")
        output = outputs[0]
        if number(output, "Distributed") != 1 or number(output, "Converged") != 1:
            problems.append("rank 0 has gathered, or not converged")
        if output.GetNumberOfCells() != mine.GetNumberOfCells():
            problems.append("not the cells of the input")
        if mine.GetNumberOfPoints():
            for data, own, name in (
                    (whole.GetPointData(), output.GetPointData(), "origin"),
                    (whole.GetCellData(), output.GetCellData(), "originCell")):
                places = numpy_support.vtk_to_numpy(own.GetArray(name))
                problems += ranks.compare(
                    ranks.arrays(own), ranks.arrays(data), places, CASES[case][2],
                    f"{case}, {kind}")
        problems += self.parted_points(mine, output, whole)
        for name in ("HeatTimes", "WaveEnergies", "DiffusionTime", "Step", "given"):
            expected, found = number(whole, name), number(output, name)
            if expected is not None and not (found and abs(found - expected) <= 1e-8 * expected):
                problems.append(f"{name} is {found} instead of {expected}")
        names = sorted(ranks.arrays(output.GetFieldData()))
        if names != sorted([*ranks.arrays(whole.GetFieldData()), "Distributed"]):
            problems.append(f"the field arrays are {names}")
        if len(outputs) > 1 and (outputs[1].GetNumberOfRows() > 0) != (ranks.RANK == 0):
            problems.append(f"the table has {outputs[1].GetNumberOfRows()} rows")
        ranks.check(self, problems)

    @staticmethod
    def parted_points(mine, output, whole):
        """Points at which pieces meet have the same bits."""
        given = ranks.arrays(mine.GetPointData())
        places = ranks.gathered(given.get("origin", []))
        order = numpy.argsort(places)
        is_same = numpy.diff(places[order]) == 0
        problems = []
        for name, values in ranks.arrays(whole.GetPointData()).items():
            own = ranks.arrays(output.GetPointData()).get(name, values[:0]).reshape(-1, values[:1].size)
            for component in range(own.shape[1]):
                bits = ranks.gathered(own[:, component])[order].view(numpy.int64)
                if (is_same & (numpy.diff(bits) != 0)).any():
                    problems.append(f"{name} differs at a point of two pieces")
        return problems

    def test_any_pieces(self):
        for number_of_case, case in enumerate(CASES):
            others = [kind for kind in KINDS if kind != "ghosts"]
            for kind in ("ghosts", others[number_of_case % len(others)]):
                mesh = ranks.bowl() if case in OF_BOUNDARIES else ranks.ellipsoid()
                with self.subTest(case=case, kind=kind):
                    self.same_as_alone(case, mesh, kind)

    def test_other_surfaces(self):
        for case in ("gradient", "heat", "poisson, held"):
            for mesh, kind in ((ranks.two(), "ghosts"), (ranks.bowl(), "contiguous"),
                               (ranks.soup(), "scattered"), (ranks.sheets(), "scattered"),
                               (ranks.triangle(), "contiguous")):
                with self.subTest(case=case, kind=kind):
                    self.same_as_alone(case, mesh, kind)

    def test_depth_may_be_automatic(self):
        for case in ("poisson", "poisson, hats", "signatures"):
            mine = with_vectors(ranks.piece(ranks.ellipsoid(), "contiguous"))
            output = ranks.run(made(case, 0), mine)[0]
            whole = ranks.alone(
                lambda case=case: ranks.run(made(case, 0), with_vectors(ranks.whole(ranks.ellipsoid())))[0])
            problems = [] if number(output, "Distributed") == 1 else ["rank 0 has gathered"]
            if number(output, "UsedDepth") != number(whole, "UsedDepth"):
                problems.append(f"{case}: {number(output, 'UsedDepth')} is used, not {number(whole, 'UsedDepth')}")
            places = numpy_support.vtk_to_numpy(mine.GetPointData().GetArray("origin"))
            problems += ranks.compare(ranks.arrays(output.GetPointData()),
                                      ranks.arrays(whole.GetPointData()), places, CASES[case][2], case)
            ranks.check(self, problems)

    def test_modes_of_the_input(self):
        for kind in ("contiguous", "ghosts", "one rank is empty"):
            modes = ranks.make("LaplaceSpectrum", 4, NumberOfModes=12)
            carrier = ranks.run(modes, ranks.piece(ranks.ellipsoid(), kind))[0]
            carrier.GetFieldData().RemoveArray("Distributed")  # which passes through
            together = made("high pass")
            problems = ranks.heard(together, "WarningEvent")
            output = ranks.run(together, carrier)[0]
            expected = ranks.run(made("high pass", gathers=True), carrier)[0]
            if number(output, "Distributed") != 1 or together.GetNumberOfRuns("Solve"):
                problems.append("rank 0 has gathered, or modes were computed")
            theirs = {name: values for name, values in ranks.arrays(expected.GetPointData()).items()
                      if "Signature" in name or name == "Filtered"}
            if carrier.GetNumberOfPoints():
                problems += [] if len(theirs) == 4 else [f"{list(theirs)}"]
                problems += ranks.compare(
                    ranks.arrays(output.GetPointData()), theirs, None, 1e-8, kind)
            ranks.check(self, problems)

    def test_modes_of_another_shape(self):
        modes = ranks.make("LaplaceSpectrum", 4, NumberOfModes=12)
        carrier = ranks.run(modes, ranks.piece(ranks.ellipsoid(), "contiguous"))[0]
        moved = carrier.NewInstance()
        moved.DeepCopy(carrier)
        if moved.GetNumberOfPoints():
            numpy_support.vtk_to_numpy(moved.GetPoints().GetData())[:, 2] *= 2.0
        filter_ = made("signatures")
        warnings = ranks.heard(filter_, "WarningEvent")
        output = ranks.run(filter_, moved)[0]
        problems = [] if number(output, "Converged") == 1 else ["modes were not computed"]
        if len(warnings) != (1 if ranks.RANK == 0 else 0) or output.GetPointData().HasArray("Mode003"):
            problems.append(f"the warnings are {warnings}")
        ranks.check(self, problems)

    def test_a_selection_takes_points_of_all_ranks(self):
        for case, (index, port) in CHOICES_OF_POINTS.items():
            for kind, is_on_one in (("ghosts", False), ("one rank is empty", False), ("scattered", True)):
                mine = with_vectors(ranks.piece(ranks.ellipsoid(), kind))
                name = "spots" if case == "distance from points" else "mask"
                selects = not is_on_one or ranks.RANK == 0
                if not selects:
                    numpy_support.vtk_to_numpy(mine.GetPointData().GetArray(name))[:] = 0
                by_array = ranks.run(made(case), mine)[0]
                expected = ranks.arrays(by_array.GetPointData())
                filter_ = made(case)
                filter_.SetInputArrayToProcess(index, 0, 0, 0, "")
                filter_.SetInputDataObject(port, selection_of(mine, name) if selects else None)
                output = ranks.run(filter_, mine)[0]
                problems = [] if number(output, "Distributed") == 1 else [f"{case}: rank 0 has gathered"]
                problems += ranks.compare(
                    ranks.arrays(output.GetPointData()), expected, None, 0.0, f"{case}, {kind}")
                ranks.run(filter_, mine)
                if filter_.GetNumberOfRuns("Solve") != (2 if case == "heat, held" else 1):
                    problems.append(f"{case}: solved again")
                ranks.check(self, problems)

    def test_a_selection_of_one_process_takes_its_points_alone(self):
        mine = with_vectors(ranks.piece(ranks.ellipsoid(), "contiguous"))
        spots = numpy_support.vtk_to_numpy(mine.GetPointData().GetArray("spots"))
        spots[:] = 0
        spots[[3, 20]] = 1
        selection = selection_of(mine, "spots")
        selection.GetNode(0).GetProperties().Set(vtkSelectionNode.PROCESS_ID(), ranks.RANKS - 1)
        filter_ = made("distance")
        filter_.SetInputDataObject(3, selection)
        found = ranks.arrays(ranks.run(filter_, mine)[0].GetPointData())
        if ranks.RANK < ranks.RANKS - 1:
            spots[:] = 0
        expected = ranks.run(made("distance from points"), mine)[0]
        ranks.check(self, ranks.compare(
            {"Distance": found["Distance"]}, {"Distance": ranks.arrays(expected.GetPointData())["Distance"]},
            None, 0.0, "distance"))

    def test_a_selection_of_one_rank_that_cannot_be_evaluated(self):
        for case, (index, port) in CHOICES_OF_POINTS.items():
            filter_ = made(case)
            filter_.SetInputArrayToProcess(index, 0, 0, 0, "")
            mine = with_vectors(ranks.piece(ranks.ellipsoid(), "contiguous"))
            of_rows = ranks.RANK == ranks.RANKS - 1
            filter_.SetInputDataObject(port, selection_of(
                mine, "mask", vtkSelectionNode.ROW if of_rows else vtkSelectionNode.POINT))
            messages = ranks.heard(filter_, "ErrorEvent")
            ranks.run(filter_, mine)
            told = ["points or of cells" in text for text in messages]
            ranks.check(
                self, [] if told == [True] * (ranks.RANK == 0) else [f"{case}: {messages}"])

    def test_stages_stay(self):
        stages = ("Space", "System", "RightHandSide", "Hierarchy", "Solve")
        mine = with_vectors(ranks.piece(ranks.ellipsoid(), "contiguous"))
        for case, change, expected in (
                ("poisson", lambda f: f.SetScreeningWeight(50.0), (1, 1, 1, 2, 2)),
                ("poisson", lambda f: f.SetInputArrayToProcess(0, 0, 0, 0, "v"), (1, 1, 2, 1, 2)),
                ("poisson", lambda f: f.SetConnectivityAware(False), (2, 2, 2, 2, 2)),
                ("poisson", lambda f: None, (1, 1, 1, 1, 1)),
                ("heat", lambda f: f.SetDiffusionTime(0.03), (1, 1, 1, 2, 4)),
                ("heat", lambda f: f.UpdateTimeStep(1.0), (1, 1, 1, 1, 2)),
                ("gradient", lambda f: f.SetInputArrayToProcess(0, 0, 0, 0, "v"), (1, 1, 0, 0, 2))):
            filter_ = made(case)
            ranks.run(filter_, mine)
            change(filter_)
            output = ranks.run(filter_, mine)[0]
            runs = tuple(filter_.GetNumberOfRuns(stage) for stage in stages)
            problems = [] if runs == expected else [f"{case}: runs are {runs}, not {expected}"]
            problems += [] if number(output, "Distributed") == 1 else ["rank 0 has gathered"]
            ranks.check(self, problems)

    def test_a_change_on_one_rank_is_one_of_all(self):
        filter_ = made("poisson")
        mine = ranks.piece(ranks.ellipsoid(), "scattered")
        first = ranks.run(filter_, mine)[0].GetPointData().GetArray("Solution")
        first = numpy_support.vtk_to_numpy(first).copy()
        if ranks.RANK == ranks.RANKS - 1:
            values = mine.GetPointData().GetArray("f")
            numpy_support.vtk_to_numpy(values)[:] += 1.0
            values.Modified()
        second = ranks.run(filter_, mine)[0].GetPointData().GetArray("Solution")
        runs = [filter_.GetNumberOfRuns(stage) for stage in ("Space", "RightHandSide", "Solve")]
        problems = [] if runs == [1, 2, 2] else [f"runs are {runs}"]
        if (numpy_support.vtk_to_numpy(second) == first).all():
            problems.append("nothing has changed")
        ranks.check(self, problems)

    def test_rank_0_gathers_what_is_left_to_it(self):
        for case, properties in (
                ("gradient of vectors", {"HodgeDecomposition": True}),
                ("poisson", {"TrackMetric": True}),
                ("signatures", {"FunctionSpace": 1, "WeldCoincidentPoints": False}),
                ("heat", {"WeldCoincidentPoints": False}),
                ("distance", {"NearestSource": True})):
            filter_ = made(case, **properties)
            warnings = ranks.heard(filter_, "WarningEvent")
            mine = with_vectors(ranks.piece(ranks.bowl(), "contiguous"))
            output = ranks.run(filter_, mine)[0]
            problems = []
            if number(output, "Distributed") is not None or number(output, "Converged") != 1:
                problems.append(f"{case}: not gathered, or not converged")
            problems += warnings
            ranks.check(self, problems)
        filter_ = made("signatures")
        filter_.AddSourcePointId(3)
        warnings = ranks.heard(filter_, "WarningEvent")
        output = ranks.run(filter_, ranks.piece(ranks.ellipsoid(), "contiguous"))[0]
        problems = [] if output.GetPointData().HasArray("BiharmonicDistance") else ["no distance"]
        problems += warnings
        ranks.check(self, problems)

    def test_no_boundary_is_told(self):
        for case in ("poisson, boundary", "poisson, flux", "heat, boundary"):
            filter_ = made(case, **(
                {"ScreeningWeight": 1.0} if case == "poisson, boundary" else {}))
            warnings = ranks.heard(filter_, "WarningEvent")
            output = ranks.run(
                filter_, with_vectors(ranks.piece(ranks.ellipsoid(), "scattered")))[0]
            told = ["has no boundary" in text for text in warnings]
            problems = [] if told == [True] * (ranks.RANK == 0) else [f"{case}: {warnings}"]
            problems += [] if number(output, "Distributed") == 1 else ["rank 0 has gathered"]
            ranks.check(self, problems)

    def test_a_wrong_weight_of_one_rank_is_refused(self):
        filter_ = made("poisson, weighed")
        mine = with_vectors(ranks.piece(ranks.ellipsoid(), "contiguous"))
        if ranks.RANK == ranks.RANKS - 1:
            numpy_support.vtk_to_numpy(mine.GetCellData().GetArray("c"))[2] = -1.0
        messages = ranks.heard(filter_, "ErrorEvent")
        ranks.run(filter_, mine)
        told = ["weight of the values" in text for text in messages]
        ranks.check(self, [] if told == [True] * (ranks.RANK == 0) else [f"{messages}"])

    def test_nothing_held_is_refused(self):
        for case in ("poisson, held", "heat, held"):
            filter_ = made(case)
            messages = ranks.heard(filter_, "ErrorEvent")
            mine = with_vectors(ranks.piece(ranks.ellipsoid(), "contiguous"))
            if mine.GetNumberOfPoints():
                numpy_support.vtk_to_numpy(mine.GetPointData().GetArray("mask"))[:] = 0
            ranks.run(filter_, mine)
            known = ["is known at a point" in text for text in messages]
            ranks.check(
                self, [] if known == [True] * (ranks.RANK == 0) else [f"{case}: {messages}"])

    def test_from_all_to_rank_0_and_back(self):
        filter_ = made("poisson")
        mine = ranks.piece(ranks.ellipsoid(), "contiguous")
        found = []
        for distributed in (True, False, True, False):
            filter_.SetBlocksAsOne(not distributed)
            output = ranks.run(filter_, mine)[0]
            problems = [] if (number(output, "Distributed") == 1) == distributed else ["not so"]
            found.append(ranks.arrays(output.GetPointData()))
            problems += ranks.compare(found[-1], {"Solution": found[0]["Solution"]}, None, 1e-8, "")
            ranks.check(self, problems)

    def test_what_fails_on_one_rank_fails_on_all(self):
        for case in ("gradient of vectors", "heat", "signatures", "high pass"):
            filter_ = made(case)
            for damage in ("value", "place", "array"):
                mine = with_vectors(ranks.piece(ranks.ellipsoid(), "contiguous"))
                name = "v" if case == "gradient of vectors" else "f"
                if ranks.RANK == ranks.RANKS - 1 and damage == "array":
                    mine.GetPointData().RemoveArray(name)
                elif ranks.RANK == ranks.RANKS - 1:
                    array = (mine.GetPointData().GetArray(name) if damage == "value"
                             else mine.GetPoints().GetData())
                    numpy_support.vtk_to_numpy(array)[3] = float("nan")
                if case == "signatures" and damage != "place":
                    continue  # it looks at no array
                messages = ranks.heard(filter_, "ErrorEvent")
                output = ranks.run(filter_, mine)[0]
                filter_.RemoveObservers("ErrorEvent")
                problems = ["the output is not empty"] if output.GetNumberOfPoints() else []
                if len(messages) != (1 if ranks.RANK == 0 else 0):
                    problems.append(f"{case}, {damage}: {len(messages)} messages: {messages}")
                ranks.check(self, problems)
            output = ranks.run(
                filter_, with_vectors(ranks.piece(ranks.ellipsoid(), "contiguous")))[0]
            ranks.check(self, [] if number(output, "Distributed") == 1 else ["not computed again"])


if __name__ == "__main__":
    ranks.main()
