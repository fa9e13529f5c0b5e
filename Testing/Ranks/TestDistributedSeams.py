"""Tests surfaces whose borders coincide except for rounding, or have hanging nodes, or faces that are there
twice, in pieces. All ranks together have the modes of one rank. Rank 0 gathers a surface with hanging
nodes."""
import unittest

import numpy
from vtkmodules.util import numpy_support

import ranks

MODES = 6


def tube(around=36, along=12):
    """Makes a tube around z, with a side of its own at either end of the angle."""
    angle, height = numpy.meshgrid(numpy.linspace(0, 2 * numpy.pi, around + 1),
                                   numpy.linspace(0, 3, along + 1))
    points = numpy.stack([numpy.cos(angle), numpy.sin(angle), height], axis=-1).reshape(-1, 3)
    return points, squares(around, along)


def squares(columns, rows):
    a = (numpy.arange(rows)[:, None] * (columns + 1) + numpy.arange(columns)).ravel()
    above = a + columns + 1
    return numpy.concatenate([numpy.stack([a, a + 1, above + 1], axis=1),
                              numpy.stack([a, above + 1, above], axis=1)])


def rectangle(left, right, columns, rows):
    x, y = numpy.meshgrid(numpy.linspace(left, right, columns + 1), numpy.linspace(0, 1, rows + 1))
    return numpy.stack([x, y, 0 * x], axis=-1).reshape(-1, 3), squares(columns, rows)


def halves():
    """Makes a rectangle of two halves. The right one is twice as fine."""
    left, right = rectangle(0, 0.7, 8, 8), rectangle(0.7, 1.4, 16, 16)
    return (numpy.concatenate([left[0], right[0]]),
            numpy.concatenate([left[1], right[1] + len(left[0])]))


class Seams(unittest.TestCase):
    def same_as_alone(self, mesh, kind, distributed, exact, **properties):
        output = ranks.run(ranks.make("LaplaceSpectrum", 5, NumberOfModes=MODES, **properties),
                           ranks.piece(mesh, kind))[0]
        whole = ranks.alone(lambda: ranks.run(
            ranks.make("LaplaceSpectrum", 5, NumberOfModes=MODES, **properties),
            ranks.whole(mesh))[0])
        found, expected = (numpy_support.vtk_to_numpy(
            data.GetFieldData().GetArray("Eigenvalues")) for data in (output, whole))
        problems = []
        if ranks.apart(found, expected) > 1e-8 * expected.max():
            problems.append(f"values {found} instead of {expected}")
        if ranks.apart(expected[:len(exact)], numpy.array(exact)) > 0.03 * max(exact):
            problems.append(f"values {expected} instead of {exact}")
        array = output.GetFieldData().GetArray("Distributed")
        if (array is not None and array.GetValue(0) == 1) != distributed:
            problems.append(f"distributed: {not distributed}")
        ranks.check(self, problems)

    def test_a_tube_is_closed_along_its_seam(self):
        first = (numpy.pi / 3) ** 2
        for kind in ("contiguous", "scattered", "ghosts", "one rank is empty"):
            for space in (0, 1):
                with self.subTest(kind=kind, space=space):
                    self.same_as_alone(tube(), kind, True, [0, 1, 1, first], FunctionSpace=space)

    def test_rank_0_gathers_hanging_nodes(self):
        exact = [numpy.pi ** 2 * number for number in (0, 1 / 1.96, 1, 1 + 1 / 1.96)]
        for kind in ("contiguous", "ghosts"):
            with self.subTest(kind=kind):
                self.same_as_alone(halves(), kind, False, exact)

    def test_a_clip_in_pieces_is_the_clip_of_one(self):
        def triangles(mesh):
            return ranks.run(ranks.make("ClipToOctree"), mesh)[0].GetNumberOfPolys()
        for mesh, kind in ((tube(), "scattered"), (halves(), "contiguous")):
            whole = ranks.alone(lambda mesh=mesh: triangles(ranks.whole(mesh)))
            found = ranks.total(triangles(ranks.piece(mesh, kind)))
            ranks.check(self, [] if found == whole else [f"{found} triangles instead of {whole}"])

    def test_faces_that_are_there_twice_are_counted(self):
        """Each face follows its copy, so that a piece has both."""
        points, cells = tube()
        twice = points, numpy.repeat(cells, 2, axis=0)
        for kind in ("contiguous", "one rank is empty"):
            with self.subTest(kind=kind):
                self.same_as_alone(twice, kind, True, [0, 1, 1, (numpy.pi / 3) ** 2])
                output = ranks.run(ranks.make("LaplaceSpectrum", 4), ranks.piece(twice, kind))[0]
                found = output.GetFieldData().GetArray("CopiedTriangles").GetValue(0)
                ranks.check(self, [] if found == len(cells) else [f"{found} of {len(cells)} copies"])


if __name__ == "__main__":
    ranks.main()
