"""Tests blocks as one surface. Every filter, on one rank or on several with blocks of their own, gives
its result on the whole surface."""
import unittest

import numpy
from vtkmodules.vtkCommonDataModel import vtkMultiBlockDataSet, vtkPolyData

import ranks
import TestEveryFilter as every


def part(mesh, cells):
    """Returns some cells of a mesh with their points."""
    points, triangles = mesh
    point_ids, corners = numpy.unique(triangles[cells], return_inverse=True)
    return ranks.prepare(
        ranks.surface(points[point_ids], corners.reshape(-1, 3), point_ids, cells))


def blocks(mesh, cells):
    """Makes two blocks with the cells, one of them in a group, and an empty block."""
    parts = [part(mesh, half) for half in numpy.array_split(cells, 2)]
    group = vtkMultiBlockDataSet()
    group.SetBlock(0, parts[1])
    data = vtkMultiBlockDataSet()
    data.SetBlock(0, parts[0])
    data.SetBlock(1, vtkPolyData())
    data.SetBlock(2, group)
    return data, parts


def leaves(output):
    return [output.GetBlock(0), output.GetBlock(2).GetBlock(0)]


def compare_others(ours, theirs, is_first, tolerance):
    """Tables, and outputs with cells of their own, are in the first block of the first rank."""
    if not is_first:
        count = ours.GetNumberOfRows() if ours.IsA("vtkTable") else ours.GetNumberOfCells()
        return [f"{ours.GetClassName()} once more"] if count else []
    return (every.compare_tables(ours, theirs, tolerance) if ours.IsA("vtkTable")
            else every.compare_new_cells(ours, theirs))


class BlocksAsOne(unittest.TestCase):
    def problems(self, name, mesh, cells, reference, is_first_rank, **properties):
        tolerance = every.tolerance_of(name)
        data, parts = blocks(mesh, cells)
        filter_ = ranks.make(name, gathers=True, **properties)
        outputs = ranks.run(filter_, data)
        problems = []
        if outputs[0].GetBlock(1) and outputs[0].GetBlock(1).GetNumberOfPoints():
            problems.append("the empty block has points")
        for index, own in enumerate(parts):
            is_first = is_first_rank and index == 0
            first = leaves(outputs[0])[index]
            others = outputs[1:]
            if name in ranks.KEEP_NO_CELLS:
                others = outputs
            else:
                problems += every.compare_own_cells(first, reference[0], own, tolerance)
                problems += every.compare_fields(first, reference[0], tolerance)
            for ours, theirs in zip(others, reference[-len(others):]):
                problems += compare_others(leaves(ours)[index], theirs, is_first, tolerance)
        return problems

    def reference(self, name, mesh, **properties):
        return ranks.alone(lambda: ranks.run(
            ranks.make(name, **properties), ranks.prepare(ranks.whole(mesh))))

    def own_cells(self, mesh):
        owner = ranks.owners(len(mesh[1]), "contiguous")
        return numpy.flatnonzero(owner == ranks.RANK)

    def test_every_filter_on_all_ranks(self):
        mesh = ranks.ellipsoid()
        for name in ranks.proxies():
            with self.subTest(name=name):
                found = self.problems(name, mesh, self.own_cells(mesh),
                                      self.reference(name, mesh), ranks.RANK == 0)
                ranks.check(self, [f"{name}: {problem}" for problem in found])

    def test_every_filter_on_one_rank(self):
        mesh = ranks.ellipsoid()
        everything = numpy.arange(len(mesh[1]))
        for name in ranks.proxies():
            if ranks.RANK > 0:
                break
            for hats in (False,) if name in ranks.KEEP_NO_CELLS else (False, True):
                with self.subTest(name=name, hats=hats):
                    reference = self.reference(name, mesh, hats=hats)
                    found = ranks.alone(lambda: self.problems(
                        name, mesh, everything, reference, True, hats=hats))
                    self.assertEqual(found, [])

    def test_nothing_is_gathered_again(self):
        mesh = ranks.ellipsoid()
        data, _ = blocks(mesh, self.own_cells(mesh))
        filter_ = ranks.make("ScreenedPoisson", gathers=True)
        ranks.run(filter_, data)
        filter_.SetScreeningWeight(3.0)
        ranks.run(filter_, data)
        runs = filter_.GetNumberOfRuns("Space")
        ranks.check(self, [] if runs == (ranks.RANK == 0) else [f"{runs} runs"])


if __name__ == "__main__":
    ranks.main()
