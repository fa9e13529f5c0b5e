"""Geodesic Distance beside vtkDijkstraGraphGeodesicPath, which goes along edges: seconds from the
mesh to distances at all points, and errors in the longest distance, on a unit sphere.

    PV_PLUGIN_CONFIG_FILE=build/paraview/gridfem.plugins.xml \\
        xvfb-run -a pvpython time_geodesic_path.py
"""

import time

import numpy
from paraview import simple
from vtkmodules.numpy_interface import dataset_adapter
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkDoubleArray
from vtkmodules.vtkFiltersModeling import vtkDijkstraGraphGeodesicPath, vtkLinearSubdivisionFilter
from vtkmodules.vtkFiltersSources import vtkPlatonicSolidSource

SUBDIVISIONS = 8
REPEATS = 3


def sphere():
    """An icosahedron, its triangles cut into four, projected: 655,362 points."""
    source = vtkPlatonicSolidSource()
    source.SetSolidTypeToIcosahedron()
    subdivided = vtkLinearSubdivisionFilter()
    subdivided.SetNumberOfSubdivisions(SUBDIVISIONS)
    subdivided.SetInputConnection(source.GetOutputPort())
    subdivided.Update()
    mesh = dataset_adapter.WrapDataObject(subdivided.GetOutput())
    mesh.Points = mesh.Points / numpy.linalg.norm(mesh.Points, axis=1)[:, None]
    mesh.VTKObject.GetPointData().Initialize()
    mesh.VTKObject.GetCellData().Initialize()
    return mesh.VTKObject


def best(run):
    """The least seconds of some runs, and the result of the last."""
    seconds = []
    for _ in range(REPEATS):
        start = time.perf_counter()
        result = run()
        seconds.append(time.perf_counter() - start)
    return min(seconds), result


def along_edges(mesh, source):
    path = vtkDijkstraGraphGeodesicPath()
    path.SetStartVertex(source)
    path.SetEndVertex(0)
    path.StopWhenEndReachedOff()
    path.SetInputData(mesh)
    path.Update()
    weights = vtkDoubleArray()
    path.GetCumulativeWeights(weights)
    return vtk_to_numpy(weights)


def by_filter(producer, source, depth):
    distance = GeodesicDistance(Input=producer, SourcePointIds=[source], Depth=depth)
    distance.UpdatePipeline()
    found = distance.GetClientSideObject().GetOutputDataObject(0)
    result = vtk_to_numpy(found.GetPointData().GetArray("Distance")).copy()
    simple.Delete(distance)
    return result


def main():
    simple.LoadDistributedPlugin("GridFEM", remote=False, ns=globals())
    mesh = sphere()
    producer = simple.TrivialProducer()
    producer.GetClientSideObject().SetOutput(mesh)
    points = vtk_to_numpy(mesh.GetPoints().GetData()).astype(float)
    source = len(points) // 2
    exact = numpy.arccos(numpy.clip(points @ points[source], -1.0, 1.0))
    print(f"{len(points)} points\n\n| by | s | largest error | root mean square |\n|---|---|---|---|")
    ways = {f"Geodesic Distance, depth {depth}": lambda depth=depth: by_filter(producer, source, depth)
            for depth in (6, 7, 8)}
    ways["vtkDijkstraGraphGeodesicPath"] = lambda: along_edges(mesh, source)
    for name, way in ways.items():
        seconds, found = best(way)
        error = numpy.abs(found - exact) / numpy.pi
        print(f"| {name} | {seconds:.2f} | {error.max():.1e} | "
              f"{numpy.sqrt(numpy.mean(error ** 2)):.1e} |", flush=True)


main()
