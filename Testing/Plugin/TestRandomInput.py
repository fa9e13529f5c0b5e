"""Tests filters on random meshes with random arrays, further inputs and properties. Each gives a
result, or a message with the reason.

    pvpython TestRandomInput.py [FIRST_SEED NUMBER]

A crash ends the process. Its seed is in the last line that was written.
"""
import os
import random
import sys
import time
import unittest

import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.util.vtkConstants import VTK_DOUBLE, VTK_FLOAT, VTK_STRING
from vtkmodules.vtkCommonCore import (
    vtkBitArray, vtkIdTypeArray, vtkOutputWindow, vtkPoints, vtkStringArray, vtkUnsignedCharArray,
    vtkVariantArray)
from vtkmodules.vtkCommonDataModel import (
    vtkCellArray, vtkCompositeDataSet, vtkImageData, vtkMultiBlockDataSet,
    vtkPartitionedDataSetCollection, vtkPolyData, vtkSelection, vtkSelectionNode)
from vtkmodules.vtkCommonExecutionModel import vtkAlgorithm
from vtkmodules.vtkFiltersCore import vtkAppendFilter

from gridfem import vtkGridFEMFilters

SEEDS = range(1, 1001)
FOUND = (57211, 121295, 716043, 3422979)  # seeds of what longer runs have found
LONGEST = 10.0  # seconds
# Biharmonic functions of a thousand corners of one polygon, many more than there are functions: half a
# minute of one processor.
MANY_VALUES = 60.0

# Properties that a random choice must not set: the place of output, and the time of a run.
NEVER_SET = {"Depth", "NumberOfModes", "NumberOfSteps", "NumberOfThreads", "MaximumIterations",
             "WantedError", "QuadratureDegree", "ErrorCode", "AbortExecute", "ReferenceCount",
             "Debug", "ReleaseDataFlag", "Progress", "NumberOfScales"}
NEVER_SET_OF = {
    "vtkLaplaceSpectrum": {"Accuracy"},  # it chooses the depth
    "vtkSurfaceDynamics": {"TimeStep"},  # a long one takes thousands of steps of the solver
}
# The active scalars of the filters, without arrays that have NaN where nothing reaches.
MADE = {"Solution", "NormalDisplacement", "Filtered", "Mode", "Mode000", "Diffused", "Laplacian", "Bending",
        "Signature", "StitchedColors"}
NUMBERS = (0.0, 1.0, -1.0, 1e-3, 1e3, 1e-12, 1e12, float("nan"), float("inf"))
FILTERS = sorted(name for name in dir(vtkGridFEMFilters)
                 if name.startswith("vtk") and not name.endswith("Algorithm")
                 and hasattr(getattr(vtkGridFEMFilters, name), "SetDepth"))


def sphere(choice):
    rings, sectors = choice.randint(2, 14), choice.randint(3, 20)
    theta, phi = numpy.meshgrid(numpy.linspace(0.05, 3.1, rings), numpy.arange(sectors) * 6.2832 /
                                sectors, indexing="ij")
    points = numpy.stack([numpy.sin(theta) * numpy.cos(phi), numpy.sin(theta) * numpy.sin(phi),
                          numpy.cos(theta)], axis=-1).reshape(-1, 3)
    cells = [[row * sectors + j, (row + 1) * sectors + j, (row + 1) * sectors + (j + 1) % sectors,
              row * sectors + (j + 1) % sectors] for row in range(rings - 1) for j in range(sectors)]
    return points, cells


def soup(choice):
    count = choice.randint(1, 50)
    points = numpy.array([[choice.uniform(-1, 1) for _ in range(3)] for _ in range(3 * count)])
    return points, [[3 * k, 3 * k + 1, 3 * k + 2] for k in range(count)]


def tangled(choice):
    points, cells = soup(choice)
    return points, [[choice.randrange(len(points)) for _ in range(choice.randint(1, 5))]
                    for _ in cells]


def flat(choice):
    points, cells = choice.choice((soup, sphere))(choice)
    points[:, choice.randrange(3)] *= choice.choice((0.0, 1e-12, 1e-6, 1e-3))
    return points, cells


def scaled(choice):
    points, cells = choice.choice((soup, sphere))(choice)
    return points * choice.choice((1e-300, 1e-150, 1e-10, 1e10, 1e100, 1e300)), cells


def far_away(choice):
    points, cells = sphere(choice)
    return points + choice.choice((1e3, 1e8, -1e12)), cells


def folded(choice):
    """Makes cells that lie upon others, flipped or not, or a hair apart."""
    points, cells = sphere(choice)
    other = points * (1 + choice.choice((0.0, 1e-8, 1e-3)))
    more = [[k + len(points) for k in cell] for cell in cells]
    return (numpy.vstack([points, other]),
            cells + cells[:5] + [cell[::-1] if choice.random() < 0.5 else cell for cell in more])


def not_a_number(choice):
    points, cells = soup(choice)
    points[choice.randrange(len(points)), choice.randrange(3)] = choice.choice(NUMBERS[-2:])
    return points, cells


def star(choice):
    corners = choice.choice((3, 5, 100, 1000))
    angle = numpy.arange(corners) * 6.2832 / corners
    radius = numpy.where(numpy.arange(corners) % 2, 1.0, choice.choice((1.0, 0.5, 0.01)))
    points = numpy.stack([radius * numpy.cos(angle), radius * numpy.sin(angle), 0 * angle], axis=-1)
    return points, [list(range(corners))]


def cubes(choice):
    points, cells = [], []
    for _ in range(choice.randint(1, 4)):
        corner = [choice.randint(0, 2) for _ in range(3)]
        first = len(points)
        points += [[corner[axis] + (k >> axis & 1) for axis in range(3)] for k in range(8)]
        cells += [[first + k for k in face] for face in (
            (0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5))]
    return numpy.array(points, dtype=float), cells


def nothing_to_solve(choice):
    points = numpy.full((4, 3), choice.random())
    return choice.choice((points, numpy.eye(4, 3))), choice.choice(
        ([], [[0], [1]], [[0, 1], [2, 3]], [[0, 0, 0]], [[]]))


MESHES = (sphere, soup, tangled, flat, scaled, far_away, folded, not_a_number, star, cubes,
          nothing_to_solve)


# Names that mean something to filters, and names that nobody gives.
KNOWN_NAMES = ("Mode000", "Mode001", "Eigenvalues", "PatchId", "PatchCellId", "PatchBasisIds", "OctreeCells",
               "OctreeCellId", "SourceCellId", "GridOrigin", "GridSpacing", "GridDepth", "vtkGhostType",
               "Normals", "Distance", "Solution", "Displacement", "UsedDepth", "NumberOfBasisFunctions",
               "WeldCoincidentPoints", "vtkOriginalPointIds", "GlobalPointIds")
ABSURD_NAMES = ("", None, " ", "%s%n%d", "a\nb", "\u03bb \u222b", "x" * 10000, "'\"<&>", "a")


def odd_values(choice, rows, columns):
    """Makes an array of a rare type."""
    kind = choice.choice(("i8", "u8", "i1", "u2", "f4", "ids", "strings", "bits", "variants"))
    numbers = [choice.choice((0, 1, 2, 7, rows, -1, 2**40)) for _ in range(rows * columns)]
    if kind in ("strings", "bits", "variants", "ids"):
        array = {"strings": vtkStringArray, "bits": vtkBitArray, "variants": vtkVariantArray,
                 "ids": vtkIdTypeArray}[kind]()
        array.SetNumberOfComponents(columns)
        for number in numbers:
            array.InsertNextValue(str(number) if kind == "strings" else
                                  number % 2 if kind == "bits" else number)
        return array
    values = numpy.array(numbers, dtype="i8").reshape(rows, columns)
    return numpy_to_vtk(values.astype(kind), deep=True)


def add_odd_arrays(choice, data):
    """Adds arrays of wrong lengths, odd types and absurd names, on points, cells and the data set."""
    attributes = (data.GetPointData(), data.GetCellData(), data.GetFieldData())
    for _ in range(choice.choice((0, 0, 1, 3, 6))):
        where = choice.randrange(3)
        rows = (data.GetNumberOfPoints(), data.GetNumberOfCells(), choice.randint(0, 5))[where]
        if choice.random() < 0.3:
            rows = choice.choice((0, 1, max(rows - 1, 0), rows + 1, 2 * rows))
        array = odd_values(choice, rows, choice.choice((1, 1, 2, 3, 6, 8)))
        name = choice.choice(choice.choice((KNOWN_NAMES, ABSURD_NAMES)))
        if name is not None:
            array.SetName(name)
        attributes[where].AddArray(array)
        if where < 2 and name is not None and choice.random() < 0.3:
            attributes[where].SetActiveAttribute(name, choice.randrange(3))


def set_cells(choice, data, cells):
    """Stores cells as vertices, lines and polygons by their lengths, or all as polygons, or as strips."""
    kinds = {1: vtkCellArray(), 2: vtkCellArray(), 3: vtkCellArray(), 4: vtkCellArray()}
    style = choice.choice(("by length", "by length", "polygons", "strips", "mixed"))
    for cell in cells:
        kind = min(max(len(cell), 1), 3)
        if style == "polygons":
            kind = 3
        elif style == "strips" and kind == 3 or style == "mixed" and choice.random() < 0.3:
            kind = 4 if style == "strips" else choice.choice((3, 4))
        kinds[kind].InsertNextCell(len(cell), cell)
    data.SetVerts(kinds[1])
    data.SetLines(kinds[2])
    data.SetPolys(kinds[3])
    data.SetStrips(kinds[4])


def with_arrays(choice, points, cells):
    data = vtkPolyData()
    coordinates = vtkPoints()
    precision = choice.choice((VTK_FLOAT, VTK_DOUBLE))
    coordinates.SetDataType(precision)
    with numpy.errstate(over="ignore"):
        coordinates.SetData(numpy_to_vtk(points.astype("f4" if precision == VTK_FLOAT else "f8"),
                                         deep=True))
    data.SetPoints(coordinates)
    set_cells(choice, data, cells)
    for attributes, rows in ((data.GetPointData(), len(points)),
                             (data.GetCellData(), data.GetNumberOfCells())):
        for name, columns, kind in (("a", 1, "f8"), ("b", 3, "f4"), ("c", 1, "i4"), ("d", 9, "f8"),
                                    ("e", 4, "u1"), ("f", 6, "f8"), ("gap", 1, "f8")):
            if rows == 0:
                continue
            values = numpy.array([[choice.uniform(-3, 3) for _ in range(columns)]
                                  for _ in range(rows)])
            if name == "gap":
                values[choice.randrange(rows)] = numpy.nan
            array = numpy_to_vtk(values.astype("i8").astype(kind) if kind in ("i4", "u1")
                                 else values.astype(kind), deep=True)
            array.SetName(name)
            attributes.AddArray(array)
    return data


def block(choice):
    """Makes a block of composite data: nothing, a surface, or a data set that is none."""
    kind = choice.choice(("none", "surface", "surface", "surface", "grid", "image"))
    if kind == "none":
        return None
    if kind == "image":
        image = vtkImageData()
        image.SetDimensions(3, 3, choice.choice((1, 2)))
        return image
    data = with_arrays(choice, *choice.choice(MESHES)(choice))
    if kind == "surface":
        add_odd_arrays(choice, data)
        return data
    grid = vtkAppendFilter()
    grid.SetInputData(data)
    grid.Update()
    return grid.GetOutput()


def composite(choice):
    blocks = [block(choice) for _ in range(choice.randint(0, 3))]
    if choice.random() < 0.5:
        data = vtkMultiBlockDataSet()
        for k, one in enumerate(blocks):
            data.SetBlock(k, one)
        return data
    data = vtkPartitionedDataSetCollection()
    for k, one in enumerate(blocks):
        data.SetPartition(k, choice.randrange(2), one)
    return data


def selection(choice):
    data = vtkSelection()
    for _ in range(choice.randint(0, 2)):
        node = vtkSelectionNode()
        node.SetContentType(choice.choice((vtkSelectionNode.INDICES, vtkSelectionNode.GLOBALIDS,
                                           vtkSelectionNode.FRUSTUM)))
        node.SetFieldType(choice.choice((vtkSelectionNode.POINT, vtkSelectionNode.CELL,
                                         vtkSelectionNode.ROW)))
        chosen = vtkIdTypeArray()
        for _ in range(choice.randint(0, 5)):
            chosen.InsertNextValue(choice.choice((0, 1, 2, 5, -1, 10**9)))
        node.SetSelectionList(chosen)
        data.AddNode(node)
    return data


def further_input(choice, algorithm, port, data):
    """Makes the input of a port beyond the first. Returns its kind, for the report."""
    wanted = algorithm.GetInputPortInformation(port).Get(vtkAlgorithm.INPUT_REQUIRED_DATA_TYPE())
    if wanted == "vtkSelection":
        algorithm.SetInputDataObject(port, selection(choice))
    elif wanted == "vtkPolyData":  # a basis, of this surface or of another one
        basis = vtkGridFEMFilters.vtkConnectivityAwareBasis()
        basis.SetDepth(choice.choice((2, 3, 4)))
        basis.AddObserver("ErrorEvent", Listener())
        other = choice.random() < 0.3 or not data.IsA("vtkPolyData")
        basis.SetInputData(with_arrays(choice, *sphere(choice)) if other else data)
        basis.Update()
        algorithm.SetInputDataObject(port, basis.GetOutput())
        wanted = "another basis" if other else "basis"
    else:
        points = with_arrays(choice, *choice.choice(MESHES)(choice))
        if choice.random() < 0.5:
            add_odd_arrays(choice, points)
        algorithm.SetInputDataObject(port, points)
    return port, wanted


def set_at_random(choice, algorithm):
    """Sets properties. Returns the values, for the report."""
    told = []
    never = NEVER_SET | NEVER_SET_OF.get(algorithm.GetClassName(), set())
    algorithm.SetDepth(choice.choice((2, 3, 4)))
    for limit, value in (("NumberOfModes", 6), ("NumberOfSteps", 2)):
        if hasattr(algorithm, "Set" + limit):
            getattr(algorithm, "Set" + limit)(value)
    for name in sorted(set(dir(type(algorithm))) & {"Set" + p[3:] for p in dir(type(algorithm))
                                                    if p.startswith("Get")}):
        if name[3:] in never or name.startswith(("SetGlobal", "SetInput", "SetProgress")) or \
                choice.random() > 0.15:
            continue
        try:
            current = getattr(algorithm, "Get" + name[3:])()
        except TypeError:
            continue  # wants arguments
        if isinstance(current, (bool, int)):
            told.append((name, choice.choice((0, 1, 2, 3, -1))))
        elif isinstance(current, float):
            told.append((name, choice.choice(NUMBERS)))
        else:
            continue
        getattr(algorithm, name)(told[-1][1])
    for index in range(6):
        if choice.random() < (0.5 if index else 0.8):
            array = choice.choice(("a", "b", "c", "d", "e", "f", "gap", "None", "missing", "",
                                   choice.choice(KNOWN_NAMES)))
            told.append((index, choice.choice((0, 0, 0, 1, 2)), array))
            algorithm.SetInputArrayToProcess(index, 0, 0, *told[-1][1:])
    if hasattr(algorithm, "AddSourcePointId") and choice.random() < 0.5:
        told.append(("AddSourcePointId", choice.choice((0, 1, -1, 10**9))))
        algorithm.AddSourcePointId(told[-1][1])
    return told


class Listener:
    CallDataType = VTK_STRING

    def __init__(self):
        self.errors = []

    def __call__(self, caller, event, text):
        if event == "ErrorEvent":
            self.errors.append(text)


def on_surface(data):
    """Returns the points of polygons with an area. Results may be NaN at the others."""
    points = vtk_to_numpy(data.GetPoints().GetData()).astype(float)
    ghosts = vtkUnsignedCharArray.SafeDownCast(data.GetCellData().GetAbstractArray("vtkGhostType"))
    used = numpy.zeros(len(points), bool)
    for cell in range(data.GetNumberOfCells()):
        if data.GetCell(cell).GetCellDimension() < 2 or (ghosts and ghosts.GetTuple1(cell)):
            continue
        ids = [data.GetCell(cell).GetPointId(k) for k in range(data.GetCell(cell).GetNumberOfPoints())]
        if len(set(ids)) < len(ids):
            continue  # a spike between two visits of a corner has no area
        corners = points[ids] - points[ids[0]]
        area = numpy.linalg.norm(numpy.cross(corners[1:-1], corners[2:]).sum(axis=0))
        used[ids] |= area > 1e-9 * (corners ** 2).sum(axis=1).max()
    return used


class RandomInput(unittest.TestCase):
    seeds = SEEDS

    def test_a_result_or_a_message(self):
        for seed in [*self.seeds, *FOUND]:
            choice = random.Random(seed)
            name, make = choice.choice(FILTERS), choice.choice(MESHES)
            algorithm = getattr(vtkGridFEMFilters, name)()
            data = composite(choice) if choice.random() < 0.1 else with_arrays(choice, *make(choice))
            told = set_at_random(choice, algorithm)
            os.write(1, f"{seed} {name} {make.__name__} {told} {data.GetClassName()}\n".encode())
            if data.IsA("vtkPolyData") and choice.random() < 0.4:
                add_odd_arrays(choice, data)
            for port in range(1, algorithm.GetNumberOfInputPorts()):
                if choice.random() < 0.2:
                    os.write(1, f"{further_input(choice, algorithm, port, data)}\n".encode())
            with self.subTest(seed=seed):
                self.check(algorithm, data)

    def check(self, algorithm, data):
        inside = Listener()  # what VTK finds wrong with how it is used
        tag = vtkOutputWindow.GetInstance().AddObserver("ErrorEvent", inside)
        try:
            self.check_run(algorithm, data)
        finally:
            vtkOutputWindow.GetInstance().RemoveObserver(tag)
        self.assertEqual(inside.errors, [])

    def check_run(self, algorithm, data):
        listener = Listener()
        algorithm.AddObserver("ErrorEvent", listener)
        algorithm.AddObserver("WarningEvent", listener)
        algorithm.SetInputDataObject(0, data)
        start, used = time.monotonic(), time.process_time()
        algorithm.Update()
        # A machine that does other work makes the first longer, several threads the second.
        longest = MANY_VALUES if algorithm.IsA("vtkHarmonicInterpolation") else LONGEST
        self.assertLess(min(time.monotonic() - start, time.process_time() - used), longest)
        output = algorithm.GetOutputDataObject(0)
        if isinstance(data, vtkCompositeDataSet):
            iterator = output.NewIterator()
            iterator.InitTraversal()
            while not iterator.IsDoneWithTraversal():
                self.check_numbers(iterator.GetCurrentDataObject())
                iterator.GoToNextItem()
            return
        self.assertLessEqual(len(listener.errors), 1)
        self.assertNotEqual(bool(listener.errors), output.GetNumberOfPoints() > 0)
        if not listener.errors:
            self.check_numbers(output)

    def check_numbers(self, output):
        converged = output.GetFieldData().GetArray("Converged")
        if converged is not None and converged.GetTuple1(0) == 1:
            scalars = output.GetPointData().GetScalars()
            if scalars is not None and scalars.GetName() in MADE:
                values = vtk_to_numpy(scalars)[on_surface(output)]
                self.assertTrue(numpy.isfinite(values).all())


if __name__ == "__main__":
    if len(sys.argv) == 3:
        FOUND = ()
        RandomInput.seeds = range(int(sys.argv[1]), int(sys.argv[1]) + int(sys.argv[2]))
    unittest.main(argv=sys.argv[:1])
