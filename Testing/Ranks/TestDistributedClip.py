"""Tests the clip and the basis by all ranks together. In rank order, they have the triangles, octree
cells, quadrature points and functions of one rank."""
import unittest

import numpy
from vtkmodules.util import numpy_support
from vtkmodules.vtkCommonCore import vtkPoints, vtkStringArray
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData

import ranks

MESHES = (ranks.ellipsoid, ranks.two, ranks.bowl, ranks.soup, ranks.sheets, ranks.triangle)
LEVELS = (14, 3, 2, 1, 0)
TABLES = ("OctreeCells", "PatchCellId", "PatchBasisIds", "NumberOfBasisFunctions", "GridOrigin",
          "GridSpacing", "GridDepth", "ConnectivityAware", "WeldCoincidentPoints", "given")


def made(name, **properties):
    return ranks.make(name, 4, **properties)


def field(output, name):
    array = output.GetFieldData().GetArray(name)
    return None if array is None else numpy_support.vtk_to_numpy(array)


def rows_of_triangles(output):
    """Returns, for each triangle, its cell arrays, and the places and point arrays at its corners."""
    if output.GetNumberOfCells() == 0:
        return numpy.zeros((0, 0)), []
    corners = numpy_support.vtk_to_numpy(output.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    columns, names = [], []
    cells = ranks.arrays(output.GetCellData())
    for name in ("OctreeCellId", "originCell", "PatchId", "c", "SourceCellId", "OctreeCellColor",
                 "PatchColor"):
        if name in cells:
            columns.append(cells[name])
            names.append(name)
    points = {"place": numpy_support.vtk_to_numpy(output.GetPoints().GetData()),
              **ranks.arrays(output.GetPointData())}
    for name in ("place", "f", "label", "BasisFunction"):
        if name in points:
            at_corners = points[name].reshape(len(points["place"]), -1)[corners].reshape(
                len(corners), -1)
            columns += list(at_corners.T)
            names += at_corners.shape[1] * [name]
    return numpy.column_stack(columns), names


def of_all_ranks(rows):
    """Returns the rows of all ranks in rank order. Ranks without rows do not know their length."""
    width = int(ranks.gathered([rows.shape[1]]).max())
    return ranks.gathered(rows.ravel()).reshape(-1, max(width, 1))


def sorted_rows(rows):
    return rows[numpy.lexsort(numpy.round(rows.T[::-1], 9))]


def apart(ours, theirs, what, tolerance=1e-12):
    if ours.shape != theirs.shape:
        return [f"{what}: {ours.shape} instead of {theirs.shape}"]
    difference = ranks.apart(ours, theirs)
    return [] if difference <= tolerance else [f"{what}: {difference} off"]


class DistributedClip(unittest.TestCase):
    def compare_meshes(self, output, whole, kind, case):
        """Triangles have the order of one rank if the pieces have the order of the mesh."""
        theirs, names = rows_of_triangles(whole)
        ours = of_all_ranks(rows_of_triangles(output)[0])
        problems = []
        if kind == "scattered":  # triangles have other numbers, and patches of a cell with them
            ours, theirs = (
                rows[:, [k for k, name in enumerate(names)
                         if name not in ("PatchId", "PatchColor", "SourceCellId")]]
                for rows in (ours, theirs))
        problems += apart(sorted_rows(ours), sorted_rows(theirs), f"{case}: triangles")
        for name in TABLES:
            expected = field(whole, name)
            found = field(output, name)
            if expected is None or (kind == "scattered" and name in ("PatchCellId", "PatchBasisIds")):
                continue
            if found is None:
                problems.append(f"{case}: no {name}")
                continue
            problems += apart(found.astype(float), expected.astype(float), f"{case}: {name}")
        if field(output, "Distributed") is None:
            problems.append(f"{case}: rank 0 has gathered")
        used = numpy.unique(numpy_support.vtk_to_numpy(
            output.GetPolys().GetConnectivityArray())) if output.GetNumberOfCells() else []
        if len(used) != output.GetNumberOfPoints():
            problems.append(f"{case}: points without triangles")
        return problems

    def test_clips_as_one_rank(self):
        for mesh in MESHES:
            for kind in ranks.KINDS:
                with self.subTest(mesh=mesh.__name__, kind=kind):
                    outputs = ranks.run(made("ClipToOctree", Level=-1), ranks.piece(mesh(), kind))
                    whole = ranks.alone(lambda: ranks.run(
                        ranks.make("ClipToOctree", 4, Level=-1), ranks.whole(mesh())))
                    case = f"{mesh.__name__}, {kind}"
                    problems = self.compare_meshes(outputs[0], whole[0], kind, case)
                    problems += self.wrong_points_or_cells(outputs, whole, case)
                    ranks.check(self, problems)

    def wrong_points_or_cells(self, outputs, whole, case):
        def quadrature(output):
            if not output.GetNumberOfPoints():
                return numpy.zeros((0, 4))
            places = numpy_support.vtk_to_numpy(output.GetPoints().GetData())
            return numpy.column_stack([places, ranks.arrays(output.GetPointData())["Weight"]])

        def octree(output):
            boxes = [output.GetCell(k).GetBounds() for k in range(output.GetNumberOfCells())]
            return numpy.array(boxes).reshape(-1, 6)
        problems = apart(sorted_rows(of_all_ranks(quadrature(outputs[1]))),
                         sorted_rows(quadrature(whole[1])), f"{case}: quadrature points")
        return problems + apart(sorted_rows(of_all_ranks(octree(outputs[2]))),
                                sorted_rows(octree(whole[2])), f"{case}: octree cells")

    def functions(self, output):
        """Returns, for each function, its number, place, area and component, once, and the numbers of
        patches."""
        points = ranks.arrays(output.GetPointData())
        rows = numpy.zeros((0, 6))
        patches = numpy.zeros(0)
        if output.GetNumberOfPoints():
            places = numpy_support.vtk_to_numpy(output.GetPoints().GetData())
            rows = numpy.column_stack([points["BasisId"], places, points["SupportArea"],
                                       points["Component"]])
            patches = ranks.arrays(output.GetCellData())["PatchId"]
        return rows, patches

    def test_builds_the_basis_of_one_rank(self):
        for mesh in MESHES:
            for kind in ("contiguous", "ghosts", "one rank is empty", "all on all", "last"):
                for level in LEVELS:
                    if level < 14 and kind != "contiguous":
                        continue
                    case = f"{mesh.__name__}, {kind}, level {level}"
                    with self.subTest(case):
                        ranks.check(self, self.wrong_basis(mesh(), kind, level, case))

    def test_plain_functions_have_the_components_of_one_rank(self):
        """Coarse functions join sheets, of which each rank sees its own."""
        for mesh in (ranks.sheets(), ranks.two()):
            for level in (14, 3, 2, 1):
                ranks.check(self, self.wrong_basis(
                    mesh, "contiguous", level, f"plain, level {level}", ConnectivityAware=False))

    def wrong_basis(self, mesh, kind, level, case, **others):
        properties = {"Level": level, "BasisId": 5 if level > 1 else 0, **others}
        outputs = ranks.run(made("ConnectivityAwareBasis", **properties), ranks.piece(mesh, kind))
        whole = ranks.alone(lambda: ranks.run(
            ranks.make("ConnectivityAwareBasis", 4, **properties), ranks.whole(mesh)))
        problems = self.compare_meshes(outputs[0], whole[0], kind, case)
        rows, patches = self.functions(outputs[1])
        expected_rows, expected_patches = self.functions(whole[1])
        rows = of_all_ranks(rows)
        # Functions between two ranks are on both, the same on both sides.
        same = numpy.unique(numpy.round(rows, 12), axis=0)
        problems += apart(same, numpy.unique(numpy.round(expected_rows, 12), axis=0),
                          f"{case}: functions", 2e-12)
        return problems + apart(numpy.sort(ranks.gathered(patches)), expected_patches,
                                f"{case}: patches")

    def test_scattered_pieces_have_as_many_functions(self):
        for mesh in MESHES:
            for aware in (True, False):
                filter_ = made("ConnectivityAwareBasis", ConnectivityAware=aware)
                output = ranks.run(filter_, ranks.piece(mesh(), "scattered"))[0]
                whole = ranks.alone(lambda: ranks.run(
                    ranks.make("ConnectivityAwareBasis", 4, ConnectivityAware=aware),
                    ranks.whole(mesh()))[0])
                ranks.check(self, self.compare_meshes(output, whole, "scattered", mesh.__name__))

    def test_a_solver_that_gathers_takes_the_basis(self):
        mesh = ranks.ellipsoid()
        basis = ranks.run(made("ConnectivityAwareBasis"), ranks.piece(mesh, "contiguous"))[0]
        output = ranks.run(ranks.make("ScreenedPoisson", 7, gathers=True), basis)[0]
        problems = self.same_solution(output, self.solved_alone(mesh), "gathered")
        ranks.check(self, [problem for problem in problems if "Distributed" not in problem])

    def same_solution(self, output, whole, case):
        """A point on both ranks has one solution. Each rank has the points of the surface."""
        def solution(data):
            if not data.GetNumberOfPoints():
                return numpy.zeros((0, 4))
            return numpy.column_stack([
                numpy_support.vtk_to_numpy(data.GetPoints().GetData()),
                ranks.arrays(data.GetPointData())["Solution"]])
        expected = {tuple(row[:3]): row[3] for row in solution(whole)}
        ours = solution(output)
        found = [(row[3], expected[tuple(row[:3])]) for row in ours if tuple(row[:3]) in expected]
        off = max((abs(a - b) for a, b in found), default=0.0)
        problems = [] if off <= 1e-8 else [f"{case}: {off} off"]
        if len(found) < 0.05 * len(ours):
            problems.append(f"{case}: {len(found)} of {len(ours)} points are known")
        for name in ("Distributed", "Converged", "UsedDepth"):
            number = field(output, name)
            wanted = field(whole, name)[0] if name == "UsedDepth" else 1
            if number is None or number[0] != wanted:
                problems.append(f"{case}: {name} is {number}")
        return problems

    def solved_alone(self, mesh, **properties):
        return ranks.alone(lambda: ranks.run(
            ranks.make("ScreenedPoisson", 4, **properties), ranks.whole(mesh))[0])

    def test_solvers_take_the_basis_of_all_ranks(self):
        """Solves on the clipped mesh, and beside the mesh that it was made of."""
        for mesh in (ranks.ellipsoid(), ranks.sheets(), ranks.two()):
            whole = self.solved_alone(mesh)
            data = ranks.piece(mesh, "contiguous")
            basis = made("ConnectivityAwareBasis")
            clipped = ranks.run(basis, data)[0]
            solver = ranks.make("ScreenedPoisson", 6)
            problems = self.same_solution(ranks.run(solver, clipped)[0], whole, "on the clip")
            beside = ranks.make("ScreenedPoisson", 6)
            beside.SetInputDataObject(1, clipped)
            problems += self.same_solution(ranks.run(beside, data)[0], whole, "beside")
            ranks.check(self, problems)

    def test_hats_take_the_grid_of_the_basis(self):
        mesh = ranks.ellipsoid()
        data = ranks.piece(mesh, "contiguous")
        clipped = ranks.run(made("ConnectivityAwareBasis"), data)[0]
        beside = ranks.make("ScreenedPoisson", 6, hats=True)
        beside.SetInputDataObject(1, clipped)
        whole = ranks.alone(lambda: ranks.run(
            ranks.make("ScreenedPoisson", 4, hats=True), ranks.whole(mesh))[0])
        ranks.check(self, self.same_solution(ranks.run(beside, data)[0], whole, "hats"))

    def test_a_basis_of_another_mesh_is_refused(self):
        other = ranks.run(made("ConnectivityAwareBasis"), ranks.piece(ranks.bowl(), "contiguous"))[0]
        solver = ranks.make("ScreenedPoisson", 6)
        solver.SetInputDataObject(1, other)
        messages = ranks.heard(solver)
        output = ranks.run(solver, ranks.piece(ranks.ellipsoid(), "contiguous"))[0]
        problems = ["not empty"] if output.GetNumberOfPoints() else []
        if ranks.RANK == 0 and (len(messages) != 1 or "another mesh" not in messages[0]):
            problems.append(str(messages))
        ranks.check(self, problems)

    def part_of(self, whole, kind):
        """Returns the triangles of a clipped mesh that a rank has read from a file, with their points."""
        owner = ranks.owners(whole.GetNumberOfCells(), kind)
        own = numpy.flatnonzero((owner == ranks.RANK) | (owner < 0))
        part = vtkPolyData()
        corners = numpy_support.vtk_to_numpy(whole.GetPolys().GetConnectivityArray()).reshape(-1, 3)
        # A triangle that is a point, with a point of its own, belongs to nothing.
        a, b, c = (numpy_support.vtk_to_numpy(whole.GetPoints().GetData())[corners[own, k]]
                   for k in range(3))
        own = own[numpy.abs(b - a).max(axis=1) + numpy.abs(c - a).max(axis=1) > 0.0]
        if not len(own):
            return part
        points, places = numpy.unique(corners[own], return_inverse=True)
        coordinates = vtkPoints()
        coordinates.SetData(numpy_support.numpy_to_vtk(
            numpy_support.vtk_to_numpy(whole.GetPoints().GetData())[points], deep=1))
        part.SetPoints(coordinates)
        cells = vtkCellArray()
        for triangle in places.reshape(-1, 3):
            cells.InsertNextCell(3, [int(corner) for corner in triangle])
        part.SetPolys(cells)
        for given, kept, chosen in ((whole.GetPointData(), part.GetPointData(), points),
                                    (whole.GetCellData(), part.GetCellData(), own)):
            for k in range(given.GetNumberOfArrays()):
                values = numpy_support.vtk_to_numpy(given.GetArray(k))[chosen]
                ranks.add(kept, given.GetArrayName(k), values)
        part.GetFieldData().ShallowCopy(whole.GetFieldData())
        return part

    def test_reads_a_clip_and_a_basis_in_any_pieces(self):
        """Reads as from a file that another number of ranks has written, in single precision as well."""
        for mesh in (ranks.ellipsoid, ranks.sheets, ranks.bowl):
            for single in (False, True):
                data = ranks.whole(mesh())
                if single:
                    data.GetPoints().SetData(numpy_support.numpy_to_vtk(numpy_support.vtk_to_numpy(
                        data.GetPoints().GetData()).astype(numpy.float32), deep=1))
                clip, basis, solved, spread = ranks.alone(lambda data=data: self.clipped_alone(data))
                for kind in ranks.KINDS:
                    if kind == "ghosts":
                        continue
                    case = f"{mesh.__name__}, {kind}, {'single' if single else 'double'}"
                    piece = self.part_of(clip, kind)
                    output = ranks.run(made("ConnectivityAwareBasis", BasisId=7), piece)[0]
                    problems = self.wrong_tables(output, basis, kind, case)
                    if spread is not None and not single:
                        problems += self.wrong_spread(output, spread, case)
                    solver = ranks.make("ScreenedPoisson", 6)
                    problems += self.same_solution(
                        ranks.run(solver, self.part_of(basis, kind))[0], solved, case)
                    ranks.check(self, problems)

    def clipped_alone(self, data):
        clip = self.part_of(ranks.run(ranks.make("ClipToOctree", 4), data)[0], "all on all")
        basis = ranks.run(ranks.make("ConnectivityAwareBasis", 4), clip)[0]
        solved = ranks.run(ranks.make("ScreenedPoisson", 4), basis)[0]
        spread = ranks.run(ranks.make("ConnectivityAwareBasis", 4, BasisId=7), clip)[0]
        return clip, basis, solved, spread

    def wrong_tables(self, output, basis, kind, case):
        if not output.GetNumberOfCells():
            return []
        problems = [] if field(output, "Distributed") is not None else [f"{case}: gathered"]
        tables = ["OctreeCells", "NumberOfBasisFunctions", "ConnectivityAware"]
        # The number of a triangle decides which patch of a cell comes first.
        if kind != "scattered":
            tables += ["PatchCellId", "PatchBasisIds"]
        for name in tables:
            problems += apart(field(output, name).astype(float), field(basis, name).astype(float),
                              f"{case}: {name}")
        return problems

    def wrong_spread(self, output, spread, case):
        """Evaluates a basis function at the points of the piece. Numbers of functions follow the
        numbers of patches."""
        if not output.GetNumberOfPoints() or "scattered" in case:
            return []

        def values(data):
            places = numpy_support.vtk_to_numpy(data.GetPoints().GetData())
            return dict(zip(map(tuple, places), ranks.arrays(data.GetPointData())["BasisFunction"]))
        expected = values(spread)
        off = max(abs(value - expected[place]) for place, value in values(output).items())
        return [] if off <= 1e-12 else [f"{case}: BasisFunction is {off} off"]

    def test_a_clip_has_its_own_depth(self):
        """The depth of the basis counts, whatever Depth is, also 0."""
        clip = ranks.run(made("ClipToOctree"), ranks.piece(ranks.ellipsoid(), "contiguous"))[0]
        for depth in (0, 9):
            output = ranks.run(
                ranks.make("ConnectivityAwareBasis", depth), clip)[0]
            found = field(output, "UsedDepth")
            ranks.check(self, [] if found is not None and found[0] == 4 else [f"depth {found}"])

    def test_cells_count_as_in_the_gathered_surface(self):
        """Vertices come before polygons, also the vertices of a rank that has nothing else. Ids of
        points are left out."""
        data = ranks.piece(ranks.bowl(), "one rank is empty", global_ids=True)
        data.GetCellData().SetGlobalIds(None)
        data.GetCellData().RemoveArray("global")
        if not data.GetNumberOfPoints():
            places = vtkPoints()
            places.SetDataTypeToDouble()
            places.InsertNextPoint(0.0, 0.0, 0.0)
            data.SetPoints(places)
            data.GetPointData().SetGlobalIds(ranks.ids([10 ** 6]))
            data.GetPointData().GetGlobalIds().SetName("global")
        vertices = vtkCellArray()
        vertices.InsertNextCell(1, [0])
        arrays = data.GetCellData()
        for k in reversed(range(arrays.GetNumberOfArrays())):
            arrays.RemoveArray(k)
        data.SetVerts(vertices)
        together = ranks.run(made("ClipToOctree"), data)[0]
        gathered = ranks.run(ranks.make("ClipToOctree", 4, gathers=True), data)[0]

        def sources(output):
            array = output.GetCellData().GetArray("SourceCellId")
            return numpy.zeros(0) if array is None else numpy_support.vtk_to_numpy(array)
        ours = numpy.sort(ranks.gathered(sources(together)))
        theirs = numpy.sort(ranks.gathered(sources(gathered)))
        problems = apart(ours, theirs, "source cells")
        if together.GetPointData().HasArray("global"):
            problems.append("cut points have ids of others")
        ranks.check(self, problems)

    def test_what_a_filter_that_gathers_makes_is_not_of_all(self):
        clip = ranks.run(made("ClipToOctree"), ranks.piece(ranks.ellipsoid(), "contiguous"))[0]
        output = ranks.run(ranks.make("HeatDiffusion", 4, gathers=True), clip)[0]
        ranks.check(self, ["Distributed is still there"] if field(output, "Distributed") is not None
                    else [])

    def test_arrays_change_without_a_new_clip(self):
        filter_ = made("ClipToOctree")
        data = ranks.piece(ranks.ellipsoid(), "contiguous")
        before = vtkPolyData()
        before.ShallowCopy(ranks.run(filter_, data)[0])
        if data.GetNumberOfPoints():
            f = numpy_support.vtk_to_numpy(data.GetPointData().GetArray("f"))
            f += 1.0
            data.GetPointData().GetArray("f").Modified()
        after = ranks.run(filter_, data)[0]
        problems = [] if filter_.GetNumberOfRuns("Space") == 1 else ["clipped again"]
        if after.GetNumberOfPoints():
            change = (ranks.arrays(after.GetPointData())["f"] -
                      ranks.arrays(before.GetPointData())["f"])
            problems += apart(change, numpy.ones_like(change), "f", 1e-12)
        ranks.check(self, problems)

    def test_arrays_of_any_type(self):
        """Text and bytes arrive unchanged. Numbers of different types become double. An array that one
        rank lacks is left out."""
        data = ranks.piece(ranks.bowl(), "contiguous")
        cells = data.GetNumberOfCells()
        if cells:
            names = vtkStringArray()
            names.SetName("names")
            for cell in numpy_support.vtk_to_numpy(data.GetCellData().GetArray("originCell")):
                names.InsertNextValue(f"cell {int(cell)}")
            data.GetCellData().AddArray(names)
            ranks.add(data.GetCellData(), "mixed", numpy.arange(cells).astype(
                numpy.float32 if ranks.RANK else numpy.int16))
            if ranks.RANK:
                ranks.add(data.GetCellData(), "partial", numpy.arange(cells))
        output = ranks.run(made("ClipToOctree"), data)[0]
        problems = []
        if output.GetNumberOfCells():
            names = output.GetCellData().GetAbstractArray("names")
            origins = numpy_support.vtk_to_numpy(output.GetCellData().GetArray("originCell"))
            if names is None or [names.GetValue(k) for k in range(len(origins))] != [
                    f"cell {int(cell)}" for cell in origins]:
                problems.append("the names are not those of the cells")
            mixed = output.GetCellData().GetArray("mixed")
            if mixed is None or mixed.GetDataTypeAsString() != "double":
                problems.append("the array of two types is not double")
            if output.GetCellData().HasArray("partial"):
                problems.append("an array that one rank lacks is there")
        ranks.check(self, problems)

    def test_what_fails_on_one_rank_fails_on_all(self):
        cases = {"BasisId": lambda: (made("ConnectivityAwareBasis", BasisId=10 ** 9),
                                     ranks.piece(ranks.ellipsoid(), "contiguous")),
                 "degree": lambda: (made("ClipToOctree", QuadratureDegree=3),
                                    ranks.piece(ranks.ellipsoid(), "contiguous"))}

        def broken():
            data = ranks.piece(ranks.ellipsoid(), "contiguous")
            if ranks.RANK == ranks.RANKS - 1:
                numpy_support.vtk_to_numpy(data.GetPoints().GetData())[2] = numpy.nan
            return made("ClipToOctree"), data
        cases["place"] = broken
        for case, make in cases.items():
            filter_, data = make()
            messages = ranks.heard(filter_)
            output = ranks.run(filter_, data)[0]
            problems = [f"{case}: not empty"] if output.GetNumberOfPoints() else []
            if len(messages) != (1 if ranks.RANK == 0 else 0):
                problems.append(f"{case}: {messages}")
            ranks.check(self, problems)


if __name__ == "__main__":
    ranks.main()
