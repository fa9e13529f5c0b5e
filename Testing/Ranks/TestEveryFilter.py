"""Tests every filter on several ranks, whose surface rank 0 gathers, against the same filter on one
rank."""
import unittest

import numpy
from vtkmodules.util import numpy_support
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkDataSetAttributes

import ranks

MESHES = {"ellipsoid": ranks.ellipsoid, "two": ranks.two, "bowl": ranks.bowl, "soup": ranks.soup}

# Another order of points and cells is another order of sums, and systems are solved to 1e-13. An
# eigenfunction is known as well as its residual, 1e-12, divided by the gap to the next eigenvalue.
ROUNDING = 1e-12
OF_MODES = 1e-10
# Factors of element matrices, which may be singular, have half of the digits.
OF_SAMPLES = 1e-6


def tolerance_of(name):
    # The steps of a flow add up, and its errors are ratios of small lengths.
    if name == "GaussianField":
        return OF_SAMPLES
    return OF_MODES if "Spectr" in name or name == "MeanCurvatureFlow" else ROUNDING


def origin(data, name, attributes):
    array = attributes(data).GetArray(name)
    return (numpy_support.vtk_to_numpy(array) if array and array.GetNumberOfTuples() else
            numpy.zeros(0, dtype=int))


def of_points(data):
    return data.GetPointData()


def of_cells(data):
    return data.GetCellData()


def coordinates(data):
    points = data.GetPoints()
    return (numpy_support.vtk_to_numpy(points.GetData()) if points and points.GetNumberOfPoints()
            else numpy.zeros((0, 3)))


def compare_own_cells(ours, theirs, data, tolerance):
    """Checks port 0 of filters that keep the points and cells."""
    problems = []
    if (ours.GetNumberOfPoints(), ours.GetNumberOfCells()) != (
            data.GetNumberOfPoints(), data.GetNumberOfCells()):
        return [f"{ours.GetNumberOfPoints()} points instead of {data.GetNumberOfPoints()}"]
    for attributes, name, what in ((of_points, "origin", "points"),
                                   (of_cells, "originCell", "cells")):
        expected = ranks.arrays(attributes(theirs))
        if not data.GetNumberOfPoints():  # names alone
            expected = {key: values[:0] for key, values in expected.items()
                        if key not in ("f", "g", "label", "c", "origin", "originCell")}
        problems += ranks.compare(ranks.arrays(attributes(ours)), expected,
                                  origin(data, name, attributes), tolerance, what)
    places = coordinates(theirs)[origin(data, "origin", of_points)]
    if data.GetNumberOfPoints() and ranks.apart(coordinates(ours), places) > tolerance:
        problems.append(f"points are {ranks.apart(coordinates(ours), places)} off")
    return problems


def compare_new_cells(ours, theirs):
    """Outputs with cells of their own are on the first rank."""
    wanted = theirs.GetNumberOfCells() if ranks.RANK == 0 else 0
    problems = []
    if ours.GetNumberOfCells() != wanted:
        problems.append(f"{ours.GetNumberOfCells()} cells instead of {wanted}")
    for attributes in (of_points, of_cells):
        missing = set(ranks.arrays(attributes(theirs))) - set(ranks.arrays(attributes(ours)))
        if missing:
            problems.append(f"arrays {missing} are missing")
    if ranks.RANK == 0:
        def sort(points):
            return points[numpy.lexsort(points.T)]
        apart = ranks.apart(sort(coordinates(ours).round(9)), sort(coordinates(theirs).round(9)))
        if apart > 2e-9:
            problems.append(f"points are {apart} off")
    return problems


def compare_tables(ours, theirs, tolerance):
    """Tables are on the first rank."""
    if ranks.RANK > 0:
        return ["a second table"] if ours.GetNumberOfRows() else []
    columns = ranks.arrays(theirs.GetRowData())
    exact = ("Mode", "Step", "Eigenvalue", "ShapeDNA", "Area", "Volume", "Time")
    return ranks.compare(ranks.arrays(ours.GetRowData()),
                         {name: columns[name] for name in columns if name in exact},
                         None, tolerance, "table")


# Numbers of the iteration. Rounding decides about the last iteration and the error it leaves.
OF_ITERATION = ("Residual", "ConvergenceFactor", "Iterations", "DoublePrecisionSince", "Misfit",
                "AlgebraicError", "GlobalIds", "Residuals")


def compare_fields(ours, theirs, tolerance):
    expected = {name: values for name, values in ranks.arrays(theirs.GetFieldData()).items()
                if name not in OF_ITERATION}
    tables = ("OctreeCells", "PatchCellId", "PatchBasisIds", "GridOrigin", "GridSpacing",
              "GridDepth", "NumberOfBasisFunctions", "ConnectivityAware", "WeldCoincidentPoints")
    if ours.GetNumberOfCells() == 0:
        expected = {name: values for name, values in expected.items() if name not in tables}
    return ranks.compare(ranks.arrays(ours.GetFieldData()), expected, None, tolerance, "field")


def compare(name, outputs, references, data, tolerance):
    problems = compare_fields(outputs[0], references[0], tolerance)
    if name in ranks.KEEP_NO_CELLS:
        problems += compare_new_cells(outputs[0], references[0])
    else:
        problems += compare_own_cells(outputs[0], references[0], data, tolerance)
    for ours, theirs in zip(outputs[1:], references[1:]):
        problems += (compare_tables(ours, theirs, tolerance) if ours.IsA("vtkTable")
                     else compare_new_cells(ours, theirs))
    return problems


class EveryFilter(unittest.TestCase):
    def compare(self, name, mesh, kind, global_ids=False, hats=False, tolerance=None):
        if tolerance is None:
            tolerance = tolerance_of(name)
        case = (name, mesh.__name__, kind, "ids" if global_ids else "", "hats" if hats else "")
        reference = ranks.make(name, hats=hats)
        references = ranks.alone(
            lambda: ranks.run(reference, ranks.prepare(ranks.whole(mesh(), global_ids))))
        filter_ = ranks.make(name, hats=hats, gathers=True)
        data = ranks.prepare(ranks.piece(mesh(), kind, global_ids))
        outputs = ranks.run(filter_, data)
        problems = compare(name, outputs, references, data, tolerance)
        ranks.check(self, [f"{case}: {problem}" for problem in problems])

    def test_every_filter_with_ghosts(self):
        for name in ranks.proxies():
            with self.subTest(name=name):
                self.compare(name, ranks.ellipsoid, "ghosts")

    def test_global_ids_give_the_same_bits(self):
        for name in ranks.proxies():
            with self.subTest(name=name):
                self.compare(name, ranks.ellipsoid, "scattered", global_ids=True, tolerance=0.0)

    def test_hat_functions(self):
        for name in ranks.proxies():
            if name not in ranks.KEEP_NO_CELLS:
                with self.subTest(name=name):
                    self.compare(name, ranks.ellipsoid, "contiguous", hats=True)

    def test_every_distribution(self):
        for kind in ranks.KINDS:
            for name in ("ScreenedPoisson", "ClipToOctree", "MeanCurvatureFlow"):
                with self.subTest(kind=kind, name=name):
                    exact = kind in ("first", "last", "all on all")
                    self.compare(name, ranks.ellipsoid, kind, tolerance=0.0 if exact else None)

    def test_every_mesh(self):
        for mesh in MESHES.values():
            for kind in ("ghosts", "scattered"):
                with self.subTest(mesh=mesh.__name__, kind=kind):
                    self.compare("ScreenedPoisson", mesh, kind)
                    self.compare("GeodesicDistance", mesh, kind, hats=True)

    def border_problems(self, data, filter_, name):
        """Returns the differences between the two sides of a border, bit for bit."""
        output = ranks.run(filter_, data)[0]
        values = numpy_support.vtk_to_numpy(output.GetPointData().GetArray(name))
        pairs = numpy.column_stack([origin(output, "origin", of_points), values])
        everywhere = ranks.gathered(pairs.ravel()).reshape(-1, 2)
        order = everywhere[numpy.argsort(everywhere[:, 0], kind="stable")]
        again = order[1:, 0] == order[:-1, 0]
        problems = [] if again.sum() > 20 else ["there are no borders"]
        apart = ranks.apart(order[1:, 1][again], order[:-1, 1][again])
        return problems + ([f"{apart} between two sides of a border"] if apart > 0.0 else [])

    def test_values_on_borders_are_the_same_on_both_sides(self):
        for kind in ("contiguous", "ghosts", "scattered"):
            for hats in (False, True):
                data = ranks.piece(ranks.ellipsoid(), kind)
                ranks.check(self, self.border_problems(
                    data, ranks.make("ScreenedPoisson", hats=hats, gathers=True), "Solution"))

    def test_arrays_of_one_side_keep_border_points_apart_and_make_no_slit(self):
        """The values differ at borders, as normals do that a filter made on every rank alone."""
        for hats in (False, True):
            data = ranks.piece(ranks.ellipsoid(), "contiguous")
            ranks.add(data.GetPointData(), "side", numpy.full(data.GetNumberOfPoints(),
                                                              float(ranks.RANK)))
            filter_ = ranks.make("ScreenedPoisson", hats=hats, gathers=True)
            problems = self.border_problems(data, filter_, "Solution")
            reference = ranks.make("ScreenedPoisson", hats=hats)
            references = ranks.alone(lambda: ranks.run(reference, ranks.whole(ranks.ellipsoid())))
            ranks.check(self, problems + compare(
                "ScreenedPoisson", [filter_.GetOutputDataObject(0)], references[:1], data, ROUNDING))

    def test_vertices_come_before_polygons(self):
        data = ranks.piece(ranks.ellipsoid(), "ghosts")
        vertices = vtkCellArray()
        vertices.InsertNextCell(1, [0])
        data.SetVerts(vertices)
        arrays = data.GetCellData()
        for name in ("c", "originCell", vtkDataSetAttributes.GhostArrayName()):
            values = numpy_support.vtk_to_numpy(arrays.GetArray(name))
            ranks.add(arrays, name, numpy.concatenate([[0], values]).astype(values.dtype))
        output = ranks.run(ranks.make("SurfaceGradient", gathers=True), data)[0]
        alone = ranks.alone(
            lambda: ranks.run(ranks.make("SurfaceGradient"), ranks.whole(ranks.ellipsoid()))[0])
        ours, theirs = (numpy_support.vtk_to_numpy(surface.GetCellData().GetArray("Gradient"))
                        for surface in (output, alone))
        off = ranks.apart(ours[1:], theirs[origin(data, "originCell", of_cells)[1:]])
        is_right = numpy.isnan(ours[0]).all() and off <= ROUNDING * abs(theirs).max()  # a vertex has none
        ranks.check(self, [] if is_right else [f"{off} off, and {ours[0]} at the vertex"])

    def test_more_ranks_than_cells(self):
        def triangle():
            return numpy.array([(0, 0, 0), (1, 0, 0), (0, 1, 0.2)]), numpy.array([(0, 1, 2)])
        for kind in ("scattered", "ghosts", "last"):
            self.compare("ScreenedPoisson", triangle, kind)

    def test_ids_beyond_32_bits(self):
        data = ranks.prepare(ranks.piece(ranks.ellipsoid(), "scattered", global_ids=True))
        large = 1 << 40
        for attributes in (data.GetPointData(), data.GetCellData()):
            if attributes.GetGlobalIds():
                numpy_support.vtk_to_numpy(attributes.GetGlobalIds())[:] += large
        output = ranks.run(ranks.make("ScreenedPoisson", gathers=True), data)[0]
        reference = ranks.alone(
            lambda: ranks.run(ranks.make("ScreenedPoisson"), ranks.whole(ranks.ellipsoid())))
        ranks.check(self, compare("ScreenedPoisson", [output], reference[:1], data, 0.0))


if __name__ == "__main__":
    ranks.main()
