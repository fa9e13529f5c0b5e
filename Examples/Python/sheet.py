"""Draws pictures side by side on one white sheet, with VTK's own classes. The examples with
pictures share it.
"""

import math
import sys
from dataclasses import dataclass, field

import vtkmodules.vtkRenderingFreeType  # noqa: F401, draws text
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401, draws everything else
from vtkmodules.vtkFiltersCore import vtkPolyDataNormals
from vtkmodules.vtkFiltersGeneral import vtkOBBTree
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkRenderingCore import (
    vtkActor,
    vtkColorTransferFunction,
    vtkDataSetMapper,
    vtkRenderer,
    vtkRenderWindow,
    vtkTextActor,
    vtkWindowToImageFilter,
)

BLUE, WHITE, RED = (0.13, 0.34, 0.68), (0.96, 0.96, 0.95), (0.76, 0.16, 0.15)
GRAY = (0.7, 0.7, 0.68)
INK = (0.15, 0.15, 0.15)
GAP = 8  # pixels between tiles


@dataclass
class Layer:
    """A data set in a tile: colored by a point or cell array, or all gray."""

    data: object
    array: str = ""
    low: float = -1.0
    high: float = 1.0
    sequential: bool = False  # pale to dark, for values with one end
    shuffled: bool = False  # ids: every value its own color
    direct: bool = False  # the array holds colors
    wireframe: bool = False
    edges: bool = False
    color: tuple = (0.85, 0.85, 0.83)


@dataclass
class View:
    """The view of a tile, in parallel projection."""

    center: tuple
    direction: tuple  # from the center to the eye
    up: tuple
    height: float  # of what is seen


@dataclass
class Tile:
    label: str
    view: View
    layers: list = field(default_factory=list)


def required(data):
    """The output of a filter, which is empty when the filter could not do its work."""
    if data.GetNumberOfPoints() == 0:
        sys.exit("The filter could not do its work; the message above says why.")
    return data


def from_the_front(mesh, room=1.1):
    """The plane of x and y, as scans often stand. `room` is the size of the view in sizes of the
    mesh."""
    bounds = mesh.GetBounds()
    height = room * max(bounds[1] - bounds[0], bounds[3] - bounds[2])
    return View(mesh.GetCenter(), (0, 0, -1), (0, 1, 0), height)


def view_of(data, width_to_height=1.0, tilt=25.0):
    """Looks at the broadest side of a data set, a little from above."""
    corner, longest, middle, shortest = [0.0] * 3, [0.0] * 3, [0.0] * 3, [0.0] * 3
    vtkOBBTree().ComputeOBB(data, corner, longest, middle, shortest, [0.0] * 3)
    center = [c + (a + b + d) / 2 for c, a, b, d in zip(corner, longest, middle, shortest)]
    broad, tall, deep = (math.hypot(*axis) for axis in (longest, middle, shortest))
    across = [x / broad for x in longest]
    up = [x / (tall or 1) for x in middle]
    front = [across[i - 2] * up[i - 1] - across[i - 1] * up[i - 2] for i in range(3)]
    cosine, sine = math.cos(math.radians(tilt)), math.sin(math.radians(tilt))
    seen = max(tall * cosine + deep * sine, broad / width_to_height)
    return View(
        center,
        [cosine * f - sine * u for f, u in zip(front, up)],
        [cosine * u + sine * f for f, u in zip(front, up)],
        1.08 * seen,
    )


def diverging_colors(low, high):
    colors = vtkColorTransferFunction()
    colors.SetColorSpaceToLab()
    colors.SetNanColor(*GRAY)
    for value, color in ((low, BLUE), ((low + high) / 2, WHITE), (high, RED)):
        colors.AddRGBPoint(value, *color)
    return colors


def sequential_colors(low, high):
    colors = vtkColorTransferFunction()
    colors.SetColorSpaceToLab()
    colors.SetNanColor(*GRAY)
    for value, color in ((low, WHITE), (high, BLUE)):
        colors.AddRGBPoint(value, *color)
    return colors


def shuffled_colors(count):
    """Light colors of which neighboring numbers differ."""
    colors = vtkColorTransferFunction()
    colors.SetColorSpaceToHSV()
    colors.HSVWrapOff()
    for i in range(count):
        hue = i * 0.61803398875 % 1.0
        colors.AddHSVPoint(i, hue, 0.25 + 0.35 * (i * 0.7548776662 % 1.0), 0.97)
    return colors


def shaded(mesh):
    """With normals, so that it looks smooth but at sharp edges."""
    normals = vtkPolyDataNormals()
    normals.SetInputData(mesh)
    normals.SetFeatureAngle(40)
    normals.ConsistencyOff()
    normals.Update()
    return normals.GetOutput()


def actor_of(layer):
    mapper = vtkDataSetMapper()
    mapper.SetInputData(shaded(layer.data) if layer.data.IsA("vtkPolyData") else layer.data)
    mapper.SetScalarVisibility(bool(layer.array))
    if layer.array:
        in_cells = layer.data.GetCellData().HasArray(layer.array)
        attributes = layer.data.GetCellData() if in_cells else layer.data.GetPointData()
        mapper.SetScalarModeToUseCellFieldData() if in_cells else (
            mapper.SetScalarModeToUsePointFieldData()
        )
        mapper.SelectColorArray(layer.array)
        if layer.direct:
            mapper.SetColorModeToDirectScalars()
        elif layer.shuffled:
            largest = attributes.GetArray(layer.array).GetRange()[1]
            mapper.SetLookupTable(shuffled_colors(int(largest) + 1))
        else:
            colors_between = sequential_colors if layer.sequential else diverging_colors
            mapper.SetLookupTable(colors_between(layer.low, layer.high))
            mapper.InterpolateScalarsBeforeMappingOff()
        mapper.UseLookupTableScalarRangeOn()
    actor = vtkActor()
    actor.SetMapper(mapper)
    look = actor.GetProperty()
    look.SetColor(layer.color)
    look.SetAmbient(0.25)
    look.SetDiffuse(0.8)
    look.SetEdgeVisibility(layer.edges)
    look.SetEdgeColor(0.25, 0.25, 0.25)
    look.SetLineWidth(1.0)
    if layer.wireframe:
        look.SetRepresentationToWireframe()
        look.LightingOff()
    return actor


def text_of(text, font_size, x, y):
    actor = vtkTextActor()
    actor.SetInput(text)
    style = actor.GetTextProperty()
    style.SetFontSize(font_size)
    style.SetColor(INK)
    style.SetJustificationToCentered()
    actor.SetPosition(x, y)
    return actor


def renderer_of(tile, viewport):
    renderer = vtkRenderer()
    renderer.SetViewport(*viewport)
    renderer.SetBackground(1, 1, 1)
    for layer in tile.layers:
        renderer.AddActor(actor_of(layer))
    camera = renderer.GetActiveCamera()
    camera.ParallelProjectionOn()
    camera.SetFocalPoint(*tile.view.center)
    camera.SetPosition(
        *(c + tile.view.height * d for c, d in zip(tile.view.center, tile.view.direction))
    )
    camera.SetViewUp(*tile.view.up)
    camera.SetParallelScale(tile.view.height / 2)
    renderer.ResetCameraClippingRange()
    return renderer


def window_of(tiles, columns, tile_size, title):
    rows = math.ceil(len(tiles) / columns)
    font_size = max(12, tile_size[1] // 17)
    strip = 2 * font_size  # below every tile, for its label
    width = columns * tile_size[0]
    height = rows * tile_size[1] + (strip if title else 0)
    window = vtkRenderWindow()
    window.SetOffScreenRendering(True)
    window.SetMultiSamples(8)
    window.SetSize(width, height)
    texts = vtkRenderer()
    texts.SetBackground(1, 1, 1)
    window.AddRenderer(texts)
    if title:
        texts.AddActor2D(text_of(title, font_size + 2, width / 2, height - 0.75 * strip))
    for i, tile in enumerate(tiles):
        left, bottom = i % columns * tile_size[0], (rows - 1 - i // columns) * tile_size[1]
        right, top = left + tile_size[0] - GAP, bottom + tile_size[1] - GAP
        texts.AddActor2D(
            text_of(tile.label, font_size, (left + right) / 2, bottom + 0.4 * font_size)
        )
        viewport = (left / width, (bottom + strip) / height, right / width, top / height)
        window.AddRenderer(renderer_of(tile, viewport))
    return window


def write_sheet(tiles, path, columns, tile_size, title=""):
    """Writes tiles, row by row from the top, as a PNG file; tile_size is in pixels."""
    window = window_of(tiles, columns, tile_size, title)
    window.Render()
    image = vtkWindowToImageFilter()
    image.SetInput(window)
    image.ReadFrontBufferOff()
    writer = vtkPNGWriter()
    writer.SetCompressionLevel(9)
    writer.SetFileName(str(path))
    writer.SetInputConnection(image.GetOutputPort())
    writer.Write()
    if writer.GetErrorCode() != 0:
        raise OSError(f"{path} could not be written.")
