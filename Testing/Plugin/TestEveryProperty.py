"""Tests that no change of a property, an array or an input leaves an old result.

Every property of every panel is changed, alone. The filter that was there before must then give the
bits of a new filter with the same values, and after the change is taken back those of the start.
"""
import unittest

import gridfem.vtkGridFEMFilters  # before the plugin, which makes objects of its classes
import numpy
from paraview import simple
from vtkmodules.util.numpy_support import vtk_to_numpy

import plugin

SURFACE = """
import math
from vtkmodules.vtkCommonCore import vtkDoubleArray
from vtkmodules.vtkFiltersSources import vtkSphereSource
source = vtkSphereSource()
source.SetRadius(1)
source.SetThetaResolution(24)
source.SetPhiResolution(13)
source.SetEndPhi(150)
source.Update()
output.ShallowCopy(source.GetOutput())
points = [output.GetPoint(k) for k in range(output.GetNumberOfPoints())]
places = {"p": (output.GetPointData(), points)}
centers = []
for k in range(output.GetNumberOfCells()):
    corners = [points[output.GetCell(k).GetPointId(i)] for i in range(3)]
    centers.append([(corners[0][axis] + corners[1][axis] + corners[2][axis]) / 3 for axis in range(3)])
places["c"] = (output.GetCellData(), centers)
functions = {
    "f": lambda x, y, z: (math.sin(3 * x) + z,),
    "g": lambda x, y, z: (2 + math.cos(2 * y),),
    "vector": lambda x, y, z: (y, z, x),
    "other_vector": lambda x, y, z: (z * z, x, y),
    "mask": lambda x, y, z: (float(x > 0.6),),
    "other_mask": lambda x, y, z: (float(y > -0.3),),
    "label": lambda x, y, z: (float(z > 0.2),),
    "other_label": lambda x, y, z: (float(x > 0.1),),
    "few": lambda x, y, z: (float(x > 0.9),),
    "other_few": lambda x, y, z: (float(y > 0.9),),
    "known": lambda x, y, z: (z if x > 0.9 else math.nan,),
    "metric": lambda x, y, z: (1 + x * x, 1, 2, 0, 0, 0),
    "other_metric": lambda x, y, z: (1, 1 + y * y, 1, 0, 0.1, 0)}
for place, (attributes, where) in places.items():
    for name, function in functions.items():
        array = vtkDoubleArray()
        array.SetName(place + "_" + name)
        array.SetNumberOfComponents(len(function(0, 0, 0)))
        for point in where:
            array.InsertNextTuple(function(*point))
        attributes.AddArray(array)
"""

POINTS = "POINTS"
SMALL = {"Depth": 4}

# The starts from which properties are changed. Most properties have an effect in one of them.
STARTS = {
    "ConnectivityAwareBasis": [{}],
    "ClipToOctree": [{}],
    "FarthestPoints": [{"NumberOfPoints": 4}],
    "FunctionalMap": [{"NumberOfModes": 12}],
    "GaussianField": [{"Range": 0.5, "NumberOfSamples": 3},
                      {"Range": 0.5, "NumberOfSamples": 3, "Statistics": 1},
                      {"Range": 0.5, "NumberOfSamples": 3, "ObservationArray": [POINTS, "p_f"],
                       "MaskArray": [POINTS, "p_few"], "ObservationNoise": 0.3}],
    "GeodesicDistance": [{"SourceArray": [POINTS, "p_mask"]},
                         {"Signed": 1, "LabelArray": [POINTS, "p_label"]},
                         {"UseSourcePosition": 1, "SourcePosition": [1, 0, 0]}],
    "GeodesicPaths": [{"SourceArray": [POINTS, "p_mask"], "TargetPointIds": [40, 90]}],
    "HarmonicInterpolation": [{"ValueArray": [POINTS, "p_f"], "MaskArray": [POINTS, "p_mask"]}],
    "HeatDiffusion": [{"Array": [POINTS, "p_f"], "DiffusionTime": 0.01, "FWHM": 0.2, "Sigma": 0.2},
                      {"Array": [POINTS, "p_f"], "Amount": 1, "FWHM": 0.3},
                      {"Array": [POINTS, "p_f"], "Amount": 2, "Sigma": 0.1},
                      {"Array": [POINTS, "p_f"], "HeatSourceArray": [POINTS, "p_g"], "NumberOfSteps": 2,
                       "ConstraintArray": [POINTS, "p_mask"], "DiffusionTime": 0.01}, {}],
    "LaplaceSpectrum": [{"NumberOfModes": 4, "AllModes": 1}, {"NumberOfModes": 4}],
    "MeanCurvatureFlow": [{"NumberOfSteps": 2}, {"NumberOfSteps": 2, "Conformalized": 1}],
    "Parameterization": [{}, {"MapType": 2}],
    "PrincipalCurvatures": [{}, {"SmoothingScale": 0.1}],
    "ScreenedPoisson": [{"Tolerance": 1e-12, "ValueArray": [POINTS, "p_f"], "ScreeningWeight": 100},
                        {"Tolerance": 1e-12,
                         "ValueArray": [POINTS, "p_f"], "ValueWeightArray": [POINTS, "p_g"],
                         "ConstraintArray": [POINTS, "p_mask"], "BoundaryFluxArray": [POINTS, "p_g"],
                         "GradientArray": [POINTS, "p_vector"],
                         "GradientScaleArray": [POINTS, "p_g"]}, {"Tolerance": 1e-12}],
    "SpectralSignatures": [{"NumberOfModes": 8, "SourcePointIds": [3], "FilterType": 1, "LastMode": 4,
                            "ValueArray": [POINTS, "p_f"]}],
    "StitchColors": [{"ColorArray": [POINTS, "p_f"], "LabelArray": [POINTS, "p_label"]}],
    "SurfaceDetail": [{"Tolerance": 1e-12, "ValueArray": [POINTS, "p_f"]},
                      {"Tolerance": 1e-12, "TransferFunction": 3,
                       "DetailScaleArray": [POINTS, "p_g"]}],
    # Short steps, because the longest of a model takes many solves.
    "SurfaceDynamics": [{"PatternLength": 1.0, "NumberOfSteps": 2, "TimeStep": 0.05},
                        {"Model": 1, "PatternLength": 1.0, "NumberOfSteps": 1, "TimeStep": 0.05},
                        {"Model": 4, "PatternLength": 1.0, "NumberOfSteps": 1, "TimeStep": 0.05},
                        {"Model": 5, "PatternLength": 1.0, "NumberOfSteps": 1, "TimeStep": 0.05,
                         "StartArray": [POINTS, "p_f"], "VelocityArray": [POINTS, "p_vector"]},
                        {"Model": 6, "PatternLength": 1.0, "NumberOfSteps": 1, "TimeStep": 0.05}],
    "SurfaceGradient": [{"Array": [POINTS, "p_vector"]},
                        {"Array": [POINTS, "p_vector"], "HodgeDecomposition": 1}]}

# Values that a rule below does not find.
OTHER_VALUES = {"Depth": [3, 5], "QuadratureDegree": [4], "SourcePointIds": [[5], [1, 9]], "TargetPointIds": [[7], [20, 30]],
                "NumberOfModes": [6, 3], "Mode": [1, 2], "Accuracy": [0.01], "WantedError": [0.3],
                "ResultPrefix": ["Mine "], "FurtherArrays": [["p_g"], ["p_g", "p_vector"]], "FirstMode": [2], "LastMode": [3],
                # Each observation takes a solve.
                "ObservationArray": [[POINTS, "p_known"]],
                "MaskArray": [[POINTS, "p_other_few"], ["CELLS", "c_few"]],
                "FirstPointId": [7], "SourcePosition": [[0.0, -1.0, 0.0], [0.0, 0.0, 3.0]],
                "ReactionU": ["u*(1-u)"], "ReactionV": ["0.5 - v", ""], "InsideLabel": [0], "ReferenceLabel": [1, 0],
                "NormalStabilization": [0.5], "MaximumIterations": [2], "Tolerance": [1e-3]}
ENDS = {"MaximumIterations", "Tolerance", "Accuracy", "WantedError"}  # they end an iteration early
# These filters start from the last solution. It changes the last digits and the report, not the solution.
WARM = {"ScreenedPoisson", "SurfaceDetail"}
REPORTS = {"Iterations", "Residual", "ConvergenceFactor", "AlgebraicError", "DiscretizationError",
           "LargestDiscretizationError", "TrustedEstimate"}
LEFT_OUT = {"NumberOfThreads", "Device"}  # change no bit without a GPU


def contents(proxy):
    """Returns all arrays of all outputs as bytes, without the seconds that a run took."""
    algorithm = proxy.GetClientSideObject()
    proxy.UpdatePipeline()
    found = {}
    for port in range(algorithm.GetNumberOfOutputPorts()):
        output = algorithm.GetOutputDataObject(port)
        for kind in range(8):
            arrays = output.GetAttributesAsFieldData(kind)
            for k in range(arrays.GetNumberOfArrays() if arrays else 0):
                array = arrays.GetArray(k)
                if array and array.GetName() != "Seconds":
                    values = vtk_to_numpy(array)
                    found[port, kind, array.GetName()] = values.copy()
        if output.IsA("vtkPointSet") and output.GetPoints():
            found[port, "points"] = vtk_to_numpy(output.GetPoints().GetData()).copy()
    return found


def is_same(one, other):
    """Whether two arrays have the same bits."""
    return (one is not None and other is not None and one.dtype == other.dtype
            and one.shape == other.shape and one.tobytes() == other.tobytes())


def is_close(one, other):
    """Whether two arrays are the same except for rounding and the end of an iteration."""
    if one is None or other is None or one.shape != other.shape:
        return False
    size = numpy.nanmax(numpy.abs(other.astype(float)), initial=1.0)  # that of the surface at least
    return numpy.allclose(one, other, rtol=0, atol=1e-6 * size, equal_nan=True)


def differences(found, expected, is_equal=is_same):
    return {key for key in found.keys() | expected.keys()
            if not is_equal(found.get(key), expected.get(key))}


def arrays_offered(prop):
    """Returns choices of other arrays, as values of the property."""
    domain = prop.FindDomain("vtkSMArrayListDomain")
    names = [domain.GetString(k) for k in range(domain.GetNumberOfStrings())]
    return [["CELLS" if name.startswith("c_") else POINTS, name]
            for name in names if name[:2] in ("p_", "c_")]


def other_values(key, prop, value):
    """Returns other values of a property."""
    if key in OTHER_VALUES:
        return OTHER_VALUES[key]
    if prop.GetCommand() == "SetInputArrayToProcess":
        return [choice for choice in arrays_offered(prop) if choice[1] != value[1]][:2]
    enumeration = prop.FindDomain("vtkSMEnumerationDomain")
    if enumeration:
        return [enumeration.GetEntryValue(k) for k in range(enumeration.GetNumberOfEntries())]
    if prop.FindDomain("vtkSMBooleanDomain"):
        return [1 - value]
    if prop.IsA("vtkSMIntVectorProperty") and prop.GetNumberOfElements() == 1:
        return [value + 1]
    if prop.IsA("vtkSMDoubleVectorProperty") and prop.GetNumberOfElements() == 1:
        return [1.5 * value if value else 0.1]
    return []


def value_of(proxy, key):
    value = getattr(proxy, key)
    if hasattr(value, "GetData"):
        value = value.GetData()
    return list(value) if isinstance(value, (list, tuple)) else value


class TestEveryProperty(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.surface = simple.ProgrammableSource(OutputDataSetType="vtkPolyData", Script=SURFACE)
        arrays = plugin.data(cls.surface).GetPointData().GetNumberOfArrays()
        assert arrays > 10, arrays  # what the source could not make would be missed nowhere

    def make(self, name, values):
        proxy = getattr(simple, name)(Input=self.surface)
        for key, value in {**SMALL, **values}.items():
            if hasattr(proxy, key):
                setattr(proxy, key, value)
        return proxy

    def fresh(self, name, values):
        """Returns the contents of a new filter."""
        proxy = self.make(name, values)
        found = contents(proxy)
        simple.Delete(proxy)
        return found

    def changes(self, name, start):
        """Yields each property with its value at the start and another one."""
        proxy = self.make(name, start)
        for key in proxy.ListProperties():
            prop = proxy.SMProxy.GetProperty(key)
            if key in LEFT_OUT or prop.GetInformationOnly() or prop.IsA("vtkSMProxyProperty"):
                continue
            value = value_of(proxy, key)
            for other in other_values(key, prop, value):
                if other != value:
                    yield key, value, other
        simple.Delete(proxy)

    def test_a_change_gives_the_bits_of_a_new_filter(self):
        tried, seen = 0, set()
        for name in plugin.PROXIES:
            for start in STARTS[name]:
                kept = self.make(name, start)
                before = contents(kept)
                for key, value, other in list(self.changes(name, start)):
                    if name in WARM and key in ENDS:
                        continue
                    kept = kept or self.make(name, start)
                    proxy, kept = kept, None  # one that has failed is not used again
                    with self.subTest(filter=name, start=start, property=key, value=other):
                        setattr(proxy, key, other)
                        fresh = self.fresh(name, {**start, key: other})
                        self.assert_same(name, contents(proxy), fresh)
                        setattr(proxy, key, value)
                        self.assert_same(name, contents(proxy), before)
                        kept = proxy
                        tried += 1
                        if differences(fresh, before):
                            seen.add((name, key))
                if kept:
                    simple.Delete(kept)
        # Without these the loops would have tried nothing that can fail.
        self.assertGreater(tried, 300)
        self.assertGreater(len(seen), 100)

    def test_further_inputs(self):
        """The Basis, Sources and other inputs of a filter that were taken away do not count."""
        points = simple.Sphere(Radius=1.0, ThetaResolution=5, PhiResolution=5)
        values = simple.Calculator(Input=points, ResultArrayName="v", Function="coordsX")
        others = {"Basis": simple.ConnectivityAwareBasis(Input=self.surface, Depth=3),
                  "Sources": points, "Values": values, "Observations": values,
                  "Selection": plugin.selected_points(3, 40)}
        tried = 0
        for name in plugin.PROXIES:
            for start in STARTS[name]:
                kept = self.make(name, start)
                before = contents(kept)
                for key in others.keys() & set(kept.ListProperties()):
                    with self.subTest(filter=name, start=start, input=key):
                        setattr(kept, key, others[key])
                        fresh = self.fresh(name, {**start, key: others[key]})
                        self.assert_same(name, contents(kept), fresh)
                        setattr(kept, key, None)
                        self.assert_same(name, contents(kept), before)
                        tried += 1
        self.assertGreater(tried, 20)

    def assert_same(self, name, found, expected):
        different = differences(found, expected, is_close if name in WARM else is_same)
        if name in WARM:
            different = {key for key in different if key[0] == 0 and key[-1] not in REPORTS}
        self.assertEqual(different, set())


if __name__ == "__main__":
    plugin.load()
    unittest.main()
