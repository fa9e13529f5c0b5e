"""Draws the figures that BenchmarkFigures computed, with VTK's charts.

    pvpython draw_figures.py NUMBERS PICTURES

NUMBERS is the folder with the .csv and .vtk files, PICTURES is the folder for the .png files. Needs
a display (xvfb-run gives one).
"""

import csv
import math
import pathlib
import sys

import vtkmodules.vtkRenderingContextOpenGL2  # noqa: F401 (draws the charts)
import vtkmodules.vtkRenderingFreeType  # noqa: F401 (draws their texts)
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401
from vtkmodules.vtkChartsCore import vtkAxis, vtkChart, vtkChartLegend, vtkChartMatrix, vtkChartXY
from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkLookupTable
from vtkmodules.vtkCommonDataModel import vtkTable, vtkVector2f, vtkVector2i
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkIOLegacy import vtkPolyDataReader
from vtkmodules.vtkRenderingAnnotation import vtkScalarBarActor
from vtkmodules.vtkRenderingContext2D import vtkPen
from vtkmodules.vtkRenderingCore import (vtkActor, vtkPolyDataMapper, vtkRenderer, vtkRenderWindow,
                                         vtkWindowToImageFilter)
from vtkmodules.vtkViewsContext2D import vtkContextView

WIDTH, HEIGHT = 410, 325  # of a panel, pixels
SMALLEST = 1e-16  # on logarithmic axes

# Ours is blue, the thesis' smoother orange, peers have the other hues.
COLORS = {
    "ours": [(31, 90, 180), (90, 170, 235), (20, 40, 110), (0, 150, 160), (120, 110, 220)],
    "thesis": [(230, 110, 0), (245, 180, 60), (150, 70, 0), (205, 150, 110)],
    "peer": [(200, 30, 40), (130, 130, 130), (40, 150, 60), (150, 60, 160), (110, 80, 50)],
    "reference": [(0, 0, 0), (110, 110, 110)],
}


def read_panels(path):
    """{panel title: {"x axis", "y axis", "logarithmic", "curves": {name: (kind, [(x, y)])}}}"""
    panels = {}
    with open(path, newline="") as file:
        for row in csv.DictReader(file):
            panel = panels.setdefault(row["panel"], dict(row, curves={}))
            kind, points = panel["curves"].setdefault(row["curve"], (row["kind"], []))
            points.append((float(row["x"]), float(row["y"])))
    return panels


def add_curve(chart, name, kind, points, number):
    columns = [vtkDoubleArray(), vtkDoubleArray()]
    for column, title in zip(columns, ("x", name)):
        column.SetName(title)
    for point in points:
        for column, value in zip(columns, point):
            column.InsertNextValue(value)
    table = vtkTable()
    for column in columns:
        table.AddColumn(column)
    plot = chart.AddPlot(vtkChart.LINE)
    plot.SetInputData(table, 0, 1)
    plot.SetColor(*COLORS[kind][number % len(COLORS[kind])], 255)
    plot.SetWidth(2.5 if kind == "ours" else 1.7)
    plot.GetPen().SetLineType(vtkPen.DASH_LINE if kind == "reference" else vtkPen.SOLID_LINE)


def fill_chart(chart, title, panel):
    logarithmic = panel["logarithmic"] == "1"
    counts = {}
    for name, (kind, points) in panel["curves"].items():
        kept = [p for p in points if p[1] > SMALLEST or not logarithmic]
        add_curve(chart, name, kind, kept, counts.get(kind, 0))
        counts[kind] = counts.get(kind, 0) + 1
    chart.SetTitle(title)
    chart.GetTitleProperties().SetFontSize(15)
    chart.GetLegend().SetLabelSize(12)
    for place, label in ((vtkAxis.BOTTOM, "x axis"), (vtkAxis.LEFT, "y axis")):
        axis = chart.GetAxis(place)
        axis.SetTitle(panel[label])
        axis.GetTitleProperties().SetFontSize(13)
        axis.GetTitleProperties().BoldOff()
        axis.GetLabelProperties().SetFontSize(12)
        axis.GetGridPen().SetColor(228, 228, 228, 255)
    chart.GetAxis(vtkAxis.LEFT).SetLogScale(logarithmic)
    chart.GetAxis(vtkAxis.LEFT).SetGridVisible(not logarithmic)  # a line per digit is too much


def place_legend(chart, panel):
    """In the corner with the fewest points of the curves."""
    points = [p for _, curve in panel["curves"].values() for p in curve]
    if panel["logarithmic"] == "1":
        points = [(x, math.log(y)) for x, y in points if y > SMALLEST]
    low, high = ([f(p[k] for p in points) for k in (0, 1)] for f in (min, max))
    shares = [[(p[k] - low[k]) / ((high[k] - low[k]) or 1.0) for k in (0, 1)] for p in points]

    def crowd(corner):
        return sum(abs(x - corner[0]) < 0.55 and abs(y - corner[1]) < 0.35 for x, y in shares)

    x, y = min(((1, 1), (1, 0), (0, 1), (0, 0)), key=crowd)
    legend = chart.GetLegend()
    legend.SetHorizontalAlignment(vtkChartLegend.RIGHT if x else vtkChartLegend.LEFT)
    legend.SetVerticalAlignment(vtkChartLegend.TOP if y else vtkChartLegend.BOTTOM)
    legend.SetPadding(6)
    legend.GetPen().SetColor(200, 200, 200, 255)
    legend.GetBrush().SetColor(255, 255, 255, 200)


def make_room_for_legend(chart, panel):
    """On the right, beside the curves: so many leave no corner free."""
    x = [p[0] for _, curve in panel["curves"].values() for p in curve]
    axis = chart.GetAxis(vtkAxis.BOTTOM)
    axis.SetBehavior(vtkAxis.FIXED)
    axis.SetRange(min(x), max(x) + 1.1 * (max(x) - min(x)) * chart.GetShowLegend())
    chart.GetLegend().SetVerticalAlignment(vtkChartLegend.CENTER)


def write_png(window, path):
    window.Render()
    image = vtkWindowToImageFilter()
    image.SetInput(window)
    image.ReadFrontBufferOff()
    writer = vtkPNGWriter()
    writer.SetInputConnection(image.GetOutputPort())
    writer.SetCompressionLevel(9)
    writer.SetFileName(str(path))
    writer.Write()


def draw_panels(path, picture):
    panels = read_panels(path)
    columns = 2 if len(panels) in (2, 4) else min(3, len(panels))
    rows = -(-len(panels) // columns)
    view = vtkContextView()
    view.GetRenderWindow().SetSize(columns * WIDTH, rows * HEIGHT)
    view.GetRenderer().SetBackground(1, 1, 1)
    matrix = vtkChartMatrix()
    matrix.SetSize(vtkVector2i(columns, rows))
    matrix.SetGutter(vtkVector2f(100, 95))
    matrix.SetBorders(85, 60, 25, 45)
    view.GetScene().AddItem(matrix)
    explained = []
    for k, (title, panel) in enumerate(panels.items()):
        chart = vtkChartXY()
        fill_chart(chart, title, panel)
        names = [(name, kind) for name, (kind, _) in panel["curves"].items()]
        chart.SetShowLegend(1 < len(names) <= 9 and names not in explained)
        explained.append(names)
        if len(names) > 8:
            make_room_for_legend(chart, panel)
        else:
            place_legend(chart, panel)
        matrix.SetChart(vtkVector2i(k % columns, rows - 1 - k // columns), chart)
    view.GetRenderWindow().SetMultiSamples(0)  # smooth edges would double the size of the file
    write_png(view.GetRenderWindow(), picture)


def surface_renderer(path):
    with open(path) as file:
        file.readline()
        largest, title = file.readline().strip().split(" ", 1)
    reader = vtkPolyDataReader()
    reader.SetFileName(str(path))
    colors = vtkLookupTable()
    colors.SetNumberOfTableValues(12)  # steps: contours are seen, and the picture stays small
    colors.SetHueRange(0.62, 0.0)
    colors.SetRange(0.0, float(largest))
    mapper = vtkPolyDataMapper()
    mapper.SetInputConnection(reader.GetOutputPort())
    mapper.SetLookupTable(colors)
    mapper.UseLookupTableScalarRangeOn()
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().LightingOff()
    bar = vtkScalarBarActor()
    bar.SetLookupTable(colors)
    bar.SetTitle(title + "\n")
    bar.SetNumberOfLabels(3)
    bar.SetLabelFormat("%.1e")
    bar.SetOrientationToHorizontal()
    bar.SetPosition(0.1, 0.02)
    bar.SetWidth(0.8)
    bar.SetHeight(0.16)
    bar.UnconstrainedFontSizeOn()
    for text in (bar.GetTitleTextProperty(), bar.GetLabelTextProperty()):
        text.SetColor(0, 0, 0)
        text.SetFontSize(14)
        text.BoldOff()
        text.ItalicOff()
        text.ShadowOff()
    renderer = vtkRenderer()
    renderer.AddActor(actor)
    renderer.AddViewProp(bar)
    renderer.SetBackground(1, 1, 1)
    camera = renderer.GetActiveCamera()
    camera.SetPosition(1, 0.8, 0.6)
    camera.SetViewUp(0, 0, 1)
    renderer.ResetCamera()
    camera.Zoom(0.85)
    camera.SetWindowCenter(0, -0.3)
    return renderer


def draw_surfaces(paths, picture):
    window = vtkRenderWindow()
    window.SetMultiSamples(0)
    window.SetSize(len(paths) * WIDTH * 3 // 4, HEIGHT)
    for k, path in enumerate(paths):
        renderer = surface_renderer(path)
        renderer.SetViewport(k / len(paths), 0, (k + 1) / len(paths), 1)
        window.AddRenderer(renderer)
    write_png(window, picture)


def main():
    numbers, pictures = map(pathlib.Path, sys.argv[1:3])
    pictures.mkdir(parents=True, exist_ok=True)
    for path in sorted(numbers.glob("*.csv")):
        draw_panels(path, pictures / (path.stem + ".png"))
    names = sorted({path.stem.rpartition("-")[0] for path in numbers.glob("*.vtk")})
    for name in names:
        draw_surfaces(sorted(numbers.glob(name + "-*.vtk")), pictures / (name + ".png"))


main()
