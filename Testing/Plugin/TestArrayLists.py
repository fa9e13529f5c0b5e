"""Tests that the lists of arrays in the panels offer all arrays that the filter can take, and no
others."""
import unittest

import gridfem.vtkGridFEMFilters  # before the plugin, which makes objects of its classes
from paraview import simple

import plugin

SURFACE = """
from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkStringArray
from vtkmodules.vtkFiltersSources import vtkSphereSource
source = vtkSphereSource()
source.Update()
output.ShallowCopy(source.GetOutput())
def add(attributes, name, components, tuples):
    array = vtkDoubleArray()
    array.SetName(name)
    array.SetNumberOfComponents(components)
    array.SetNumberOfTuples(tuples)
    array.Fill(1)
    attributes.AddArray(array)
for components in (1, 3, 4, 6, 9):
    add(output.GetPointData(), "p%d" % components, components, output.GetNumberOfPoints())
    add(output.GetCellData(), "c%d" % components, components, output.GetNumberOfCells())
names = vtkStringArray()
names.SetName("names")
names.SetNumberOfTuples(output.GetNumberOfPoints())
output.GetPointData().AddArray(names)
"""

# What stands in each list for no array, in parentheses, so that it comes first.
NONE = "(None)"
COORDINATES = "(None: coordinates)"
AUTOMATIC = "(None: automatic)"
MEANINGS = {"DomainArray": "(None: all)", "ColorArray": AUTOMATIC, ("StitchColors", "LabelArray"): AUTOMATIC,
            ("HarmonicInterpolation", "ValueArray"): AUTOMATIC, "ValueArray": COORDINATES, "Array": COORDINATES}
ANY = {"Normals", "p1", "p3", "p4", "p6", "p9", "c1", "c3", "c4", "c6",
       "c9"}
EXPECTED = {  # those that are not named may offer any of these
    ("ScreenedPoisson", "ValueArray"): ANY,
    ("ScreenedPoisson", "GradientArray"): {"Normals", "p3", "p6", "p9", "c3", "c6", "c9"},
    ("ScreenedPoisson", "GradientScaleArray"): {"p1", "c1"},
    ("ScreenedPoisson", "ValueWeightArray"): {"p1", "c1"},
    ("ScreenedPoisson", "ConstraintArray"): {"p1"},
    ("ScreenedPoisson", "MetricArray"): {"p6", "p9", "c6", "c9"},
    ("LaplaceSpectrum", "MetricArray"): {"p6", "p9", "c6", "c9"},
    ("ScreenedPoisson", "BoundaryFluxArray"): {"Normals", "p1", "p3", "p4", "p6", "p9"},
    ("ScreenedPoisson", "FurtherArrays"): ANY,
    ("StitchColors", "ColorArray"): {"Normals", "p1", "p3", "p4", "c1", "c3", "c4"},
    ("StitchColors", "LabelArray"): {"p1", "c1"},
    ("HarmonicInterpolation", "ValueArray"): {"Normals", "p1", "p3", "p4", "p6", "p9"},
    ("HarmonicInterpolation", "FurtherArrays"): {"Normals", "p1", "p3", "p4", "p6", "p9"},
    ("HarmonicInterpolation", "MaskArray"): {"p1"},
    ("SurfaceDetail", "ValueArray"): {"Normals", "p1", "p3", "p4", "p6", "p9"},
    ("SurfaceDetail", "DetailScaleArray"): {"p1", "c1"},
    ("SurfaceGradient", "Array"): ANY,
    ("HeatDiffusion", "Array"): ANY,
    ("HeatDiffusion", "FurtherArrays"): ANY,
    ("HeatDiffusion", "HeatSourceArray"): ANY,
    ("HeatDiffusion", "ConstraintArray"): {"p1"},
    ("GeodesicDistance", "SourceArray"): {"p1"},
    ("GeodesicDistance", "LabelArray"): {"p1", "c1"},
    ("SpectralSignatures", "ValueArray"): {"Normals", "p1", "p3", "p4", "p6", "p9"},
    ("SurfaceDynamics", "StartArray"): {"p1", "c1"},
    ("SurfaceDynamics", "VelocityArray"): {"Normals", "p3", "c3"}}


class TestArrayLists(unittest.TestCase):
    def test_every_list_offers_what_its_filter_can_take(self):
        surface = simple.ProgrammableSource(OutputDataSetType="vtkPolyData", Script=SURFACE)
        plugin.data(surface)
        seen = set()
        for name in plugin.PROXIES:
            proxy = getattr(simple, name)(Input=surface)
            for key in proxy.ListProperties():
                domain = proxy.SMProxy.GetProperty(key).FindDomain("vtkSMArrayListDomain")
                if domain:
                    seen.add((name, key))
                    strings = [domain.GetString(k) for k in range(domain.GetNumberOfStrings())]
                    with self.subTest(proxy=name, property=key):
                        if key == "FurtherArrays":  # a list to check, with nothing checked
                            self.assertEqual(len(getattr(proxy, key)), 0)
                        else:
                            self.assertEqual(strings.pop(0), MEANINGS.get(
                                (name, key), MEANINGS.get(key, NONE)))
                        offered = set(strings)
                        self.assertGreater(len(offered), 0)
                        expected = {"p1", "c1"} if key == "DomainArray" else offered & ANY
                        self.assertEqual(offered, EXPECTED.get((name, key), expected))
        self.assertLessEqual(set(EXPECTED), seen)


if __name__ == "__main__":
    plugin.load()
    unittest.main()
