"""Filters on random meshes with random arrays and properties: a result, or a message that says why not.

    pvpython TestRandomInput.py [FIRST_SEED NUMBER]

A crash ends the process; its seed is in the last line that was written.
"""
import os
import random
import sys
import time
import unittest

import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.util.vtkConstants import VTK_DOUBLE, VTK_FLOAT, VTK_STRING
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData

from gridfem import vtkGridFEMFilters

SEEDS = range(1, 601)
LONGEST = 60.0  # seconds, on a machine that does other work as well

# What a random choice must not set: where output goes, how long a run may take.
NEVER_SET = {"Depth", "NumberOfModes", "NumberOfSteps", "NumberOfThreads", "MaximumIterations",
             "AccuracyDriven", "QuadratureDegree", "ErrorCode", "AbortExecute", "ReferenceCount",
             "Debug", "ReleaseDataFlag", "Progress", "NumberOfScales"}
# Of points that nothing reaches.
MAY_BE_NAN = {"Distance", "BiharmonicDistance", "Interpolated"}
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
    """Cells that lie upon others, turned over or not, or a hair apart."""
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


def with_arrays(choice, points, cells):
    data = vtkPolyData()
    coordinates = vtkPoints()
    precision = choice.choice((VTK_FLOAT, VTK_DOUBLE))
    coordinates.SetDataType(precision)
    with numpy.errstate(over="ignore"):
        coordinates.SetData(numpy_to_vtk(points.astype("f4" if precision == VTK_FLOAT else "f8"),
                                         deep=True))
    data.SetPoints(coordinates)
    kinds = {1: vtkCellArray(), 2: vtkCellArray(), 3: vtkCellArray()}
    for cell in cells:
        kinds[min(max(len(cell), 1), 3)].InsertNextCell(len(cell), cell)
    data.SetVerts(kinds[1])
    data.SetLines(kinds[2])
    data.SetPolys(kinds[3])
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


def set_at_random(choice, algorithm):
    """Returns what was set, to be told."""
    told = []
    algorithm.SetDepth(choice.choice((2, 3, 4)))
    for limit, value in (("NumberOfModes", 6), ("NumberOfSteps", 2)):
        if hasattr(algorithm, "Set" + limit):
            getattr(algorithm, "Set" + limit)(value)
    for name in sorted(set(dir(type(algorithm))) & {"Set" + p[3:] for p in dir(type(algorithm))
                                                    if p.startswith("Get")}):
        if name[3:] in NEVER_SET or name.startswith(("SetGlobal", "SetInput", "SetProgress")) or \
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
        if choice.random() < 0.5:
            array = choice.choice(("a", "b", "c", "d", "e", "f", "gap", "None", "missing", ""))
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


class RandomInput(unittest.TestCase):
    seeds = SEEDS

    def test_a_result_or_a_message(self):
        for seed in self.seeds:
            choice = random.Random(seed)
            name, make = choice.choice(FILTERS), choice.choice(MESHES)
            algorithm = getattr(vtkGridFEMFilters, name)()
            data = with_arrays(choice, *make(choice))
            told = set_at_random(choice, algorithm)
            os.write(1, f"{seed} {name} {make.__name__} {told}\n".encode())
            with self.subTest(seed=seed):
                self.check(algorithm, data)

    def check(self, algorithm, data):
        listener = Listener()
        algorithm.AddObserver("ErrorEvent", listener)
        algorithm.AddObserver("WarningEvent", listener)
        algorithm.SetInputData(data)
        start = time.monotonic()
        algorithm.Update()
        self.assertLess(time.monotonic() - start, LONGEST)
        output = algorithm.GetOutputDataObject(0)
        self.assertLessEqual(len(listener.errors), 1)
        self.assertNotEqual(bool(listener.errors), output.GetNumberOfPoints() > 0)
        if listener.errors:
            return
        converged = output.GetFieldData().GetArray("Converged")
        if converged is not None and converged.GetTuple1(0) == 1:
            scalars = output.GetPointData().GetScalars()
            if scalars is not None and scalars.GetName() not in MAY_BE_NAN:
                self.assertTrue(numpy.isfinite(vtk_to_numpy(scalars)).all())


if __name__ == "__main__":
    if len(sys.argv) == 3:
        RandomInput.seeds = range(int(sys.argv[1]), int(sys.argv[1]) + int(sys.argv[2]))
    unittest.main(argv=sys.argv[:1])
