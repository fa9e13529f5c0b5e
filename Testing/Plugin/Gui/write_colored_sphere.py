"""Writes a sphere with arrays at its points: colors, which are also `f`, the array that all tests
choose, labels of its halves, a function and a vector field."""
import sys

from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkIntArray, vtkUnsignedCharArray
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter

source = vtkSphereSource()
source.SetThetaResolution(40)
source.SetPhiResolution(20)
source.Update()
sphere = source.GetOutput()

colors = vtkUnsignedCharArray()
colors.SetName("colors")
colors.SetNumberOfComponents(3)
label = vtkIntArray()
label.SetName("label")
height = vtkDoubleArray()
height.SetName("height")
direction = vtkDoubleArray()
direction.SetName("direction")
direction.SetNumberOfComponents(3)
for point in range(sphere.GetNumberOfPoints()):
    x, y, z = sphere.GetPoint(point)
    colors.InsertNextTuple3(*(round(255 * (c + 0.5)) for c in (x, y, z)))
    label.InsertNextValue(int(z > 0))
    height.InsertNextValue(z)
    direction.InsertNextTuple3(0, 0, 2)
f = vtkUnsignedCharArray()
f.DeepCopy(colors)
f.SetName("f")
for array in (colors, f, label, height, direction):
    sphere.GetPointData().AddArray(array)

writer = vtkXMLPolyDataWriter()
writer.SetFileName(sys.argv[1])
writer.SetInputData(sphere)
writer.Write()
