"""Temperatures at forty stations of a terrain, the field that they predict, and how far it is known.

    PYTHONPATH=build/lib/python3/dist-packages \\
        xvfb-run -a pvpython stations.py MESH DEPTH PICTURE.png

MESH is a .vtp or .ply file. The temperature is a random field, known at the stations with an error of
0.2 degrees. The script also prints how well each station is predicted by all others.
"""

import math
import random
import sys

from gridfem.vtkGridFEMFilters import vtkGaussianField
from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkFiltersCore import vtkGlyph3D
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkIOPLY import vtkPLYReader
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

from sheet import Layer, Tile, required, view_of, write_sheet

STATIONS = 40
MEAN, DEVIATION, ERROR = 12.0, 4.0, 0.2  # degrees
RANGE = 0.5  # of the side of a square with the area of the surface


def read(path):
    reader = vtkPLYReader() if path.endswith(".ply") else vtkXMLPolyDataReader()
    reader.SetFileName(path)
    reader.Update()
    return reader.GetOutput()


def field_on(mesh, depth):
    field = vtkGaussianField()
    field.SetInputData(0, mesh)
    field.SetDepth(depth)
    field.SetRange(RANGE)
    field.SetStandardDeviation(DEVIATION)
    return field


def weather(mesh, depth):
    """The mesh with a temperature at every point."""
    field = field_on(mesh, depth)
    field.SetSeed(4)
    field.Update()
    result = required(field.GetOutput())
    temperature = result.GetPointData().GetArray("Sample000")
    temperature.SetName("Temperature")
    for point in range(temperature.GetNumberOfTuples()):
        temperature.SetValue(point, MEAN + temperature.GetValue(point))
    return result


def measured(truth):
    """The temperatures at some points, with errors."""
    chance = random.Random(2)
    temperature = truth.GetPointData().GetArray("Temperature")
    inside = [k for k in range(truth.GetNumberOfPoints()) if not math.isnan(temperature.GetValue(k))]
    points, values = vtkPoints(), vtkDoubleArray()
    values.SetName("Measured")
    for point in chance.sample(inside, STATIONS):
        points.InsertNextPoint(truth.GetPoint(point))
        values.InsertNextValue(temperature.GetValue(point) + chance.gauss(0.0, ERROR))
    stations = vtkPolyData()
    stations.SetPoints(points)
    stations.GetPointData().SetScalars(values)
    return stations


def predicted(mesh, stations, depth):
    field = field_on(mesh, depth)
    field.SetInputData(2, stations)
    field.SetObservationNoise(ERROR)
    field.SetNumberOfSamples(100)
    field.StatisticsOn()
    field.Update()
    return required(field.GetOutput())


def balls(stations, size):
    ball = vtkSphereSource()
    ball.SetRadius(0.012 * size)
    glyphs = vtkGlyph3D()
    glyphs.SetInputData(stations)
    glyphs.SetSourceConnection(ball.GetOutputPort())
    glyphs.SetScaleModeToDataScalingOff()
    glyphs.Update()
    return glyphs.GetOutput()


def main():
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    mesh, depth = read(sys.argv[1]), int(sys.argv[2])
    truth = weather(mesh, depth)
    stations = measured(truth)
    result = predicted(mesh, stations, depth)
    ratio = result.GetFieldData().GetArray("LeaveOneOutRatio").GetValue(0)
    print(f"errors at left-out stations: {ratio:.2f} times what is expected")

    view = view_of(mesh, 4 / 3)
    low, high = MEAN - 2 * DEVIATION, MEAN + 2 * DEVIATION
    dots = balls(stations, view.height)
    colored = Layer(dots, "Measured", low, high)
    tiles = [Tile("measured at forty stations", view, [Layer(mesh), colored]),
             Tile("predicted temperature", view, [Layer(result, "Prediction", low, high), colored]),
             Tile("standard deviation of the error, 0 to 4 degrees", view,
                  [Layer(result, "PredictionStandardDeviation", 0, DEVIATION, sequential=True),
                   Layer(dots, color=(0.1, 0.1, 0.1))]),
             Tile("the temperature itself", view, [Layer(truth, "Temperature", low, high)])]
    write_sheet(tiles, sys.argv[3], 2, (420, 315), "Temperature from forty stations")


main()
