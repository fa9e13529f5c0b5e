"""Writes a sphere cut into two blocks."""
import sys

from paraview import simple

sphere = simple.Sphere(Radius=1.0, ThetaResolution=40, PhiResolution=20)
middle = simple.PointDatatoCellData(Input=simple.Calculator(
    Input=sphere, ResultArrayName="z", Function="coordsZ"))
blocks = simple.GroupDatasets(Input=[
    simple.Threshold(Input=middle, Scalars=["CELLS", "z"], LowerThreshold=low,
                     UpperThreshold=low + 2) for low in (-2, 0)])
simple.SaveData(sys.argv[1], proxy=blocks)
