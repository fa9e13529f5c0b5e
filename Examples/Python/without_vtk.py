"""The package gridfem without VTK: meshes of numpy, PyVista, trimesh and meshio go in, numpy comes out.

    pip install .
    python3 without_vtk.py
"""

import numpy

import gridfem


def knotted_tube(around=240, across=24):
    """Points and quads of a tube along a trefoil knot, whose strands come close to each other."""
    t = numpy.linspace(0, 2 * numpy.pi, around, endpoint=False)
    knot = numpy.stack([numpy.sin(t) + 2 * numpy.sin(2 * t), numpy.cos(t) - 2 * numpy.cos(2 * t),
                        -numpy.sin(3 * t)], axis=-1)
    tangent = numpy.roll(knot, -1, axis=0) - numpy.roll(knot, 1, axis=0)
    side = numpy.cross(tangent, [0, 0, 1.0])
    side /= numpy.linalg.norm(side, axis=1)[:, None]
    upward = numpy.cross(side, tangent)
    upward /= numpy.linalg.norm(upward, axis=1)[:, None]
    angle = numpy.linspace(0, 2 * numpy.pi, across, endpoint=False)[None, :, None]
    points = knot[:, None] + 0.4 * (
        numpy.cos(angle) * side[:, None] + numpy.sin(angle) * upward[:, None])
    row, column = numpy.meshgrid(numpy.arange(around), numpy.arange(across), indexing="ij")
    corner = [(row + i) % around * across + (column + j) % across
              for i, j in ((0, 0), (0, 1), (1, 1), (1, 0))]
    return points.reshape(-1, 3), numpy.stack(corner, axis=-1).reshape(-1, 4)


def describe(points, cells):
    """Everything in one line: eigenvalues, a distance, and what smoothing does to noise."""
    eigenvalues, modes = gridfem.spectrum(points, cells, 6, Depth=6)
    steps = gridfem.distance(points, cells, sources=[0], Depth=6)
    random = numpy.random.default_rng(0)
    noisy = modes[:, 1] + 0.1 * random.standard_normal(len(points))
    smooth = gridfem.poisson(points, cells, noisy, on="points", ScreeningWeight=100, Depth=6)
    print("  eigenvalues", numpy.round(eigenvalues, 4))
    print(f"  farthest from point 0: {numpy.nanmax(steps):.2f};"
          f" noise {numpy.std(noisy - modes[:, 1]):.3f},"
          f" smoothed {numpy.std(smooth - modes[:, 1]):.3f}")
    return eigenvalues


def main():
    points, quads = knotted_tube()
    triangles = numpy.vstack([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])

    print("numpy: points and the ids of each cell's points")
    expected = describe(points, quads)

    try:
        import pyvista
        print("PyVista: a PolyData")
        surface = pyvista.make_tri_mesh(points, triangles)
        describe(*gridfem.arrays(surface))
        surface["curvature"] = gridfem.curvatures(*gridfem.arrays(surface))[1]  # to plot
    except ImportError:
        print("PyVista is not installed: gridfem.arrays(polydata) would give points and cells.")

    try:
        import trimesh
        print("trimesh: a Trimesh")
        describe(*gridfem.arrays(trimesh.Trimesh(points, triangles, process=False)))
    except ImportError:
        print("trimesh is not installed: gridfem.arrays(mesh) would give vertices and faces.")

    try:
        import meshio
        print("meshio: what it reads from any of its formats")
        mesh = meshio.Mesh(points, [("quad", quads)])
        numpy.testing.assert_allclose(describe(*gridfem.arrays(mesh)), expected)
    except ImportError:
        print("meshio is not installed: gridfem.arrays(meshio.read(file)) would give both.")

    try:
        gridfem.distance(points, quads, sources=[len(points)])
    except gridfem.Error as error:
        print("What is refused is said:", error)


if __name__ == "__main__":
    main()
