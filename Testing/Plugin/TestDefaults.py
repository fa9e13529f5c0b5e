"""Tests that the XML agrees with the classes: defaults, ranges, and a text for everything."""
import re
import unittest

import gridfem.vtkGridFEMFilters as filters  # before the plugin, which makes objects of its classes
from paraview import simple
from paraview.modules.vtkRemotingServerManager import vtkSMOrderedPropertyIterator

import plugin

# The ends of int, vtkIdType and double. A class that allows them has no bound.
UNBOUNDED = {2**31 - 1, 2**63 - 1, 1.7976931348623157e308}

# The arrays of a panel are numbered in their order, except for these.
INDICES = {("LaplaceSpectrum", "MetricArray"): 5}

# The panel of a new filter shows at most this number of properties, without inputs and advanced
# properties.
MOST_SHOWN = 5

# The class does not clamp these properties. It refuses values below the range, with a message.
REFUSED_BELOW = {"ScreeningWeight": 0, "Mode": -1, "DiffusionTime": 0, "SmoothingScale": 0,
                 "TransitionWidth": 0, "FWHM": 0, "Sigma": 0, "Range": 0,
                 "StandardDeviation": 0, "PatternLength": 0, "TimeStep": 0, "Feed": 0, "Kill": 0, "Damping": 0,
                 "Diffusivity": 0, "DiffusivityV": 0}

# Words that people type into the search of ParaView's window, and a filter that they find.
JOBS = {
    "smooth": "ScreenedPoisson", "denoise": "HeatDiffusion", "sharpen": "SurfaceDetail",
    "eigenfunctions": "LaplaceSpectrum", "eigenvalues": "LaplaceSpectrum",
    "harmonic": "HarmonicInterpolation", "heat kernel": "SpectralSignatures",
    "geodesic": "GeodesicDistance", "shortest path": "GeodesicPaths",
    "curvature": "PrincipalCurvatures", "flatten": "Parameterization", "unfold": "MeanCurvatureFlow", "kriging": "GaussianField",
    "reaction-diffusion": "SurfaceDynamics", "random field": "GaussianField", "fill in": "HarmonicInterpolation"}


def is_shown(proxy, decorator):
    """Whether a decorator of the panel shows its property, on a surface without blocks."""
    kind, words = decorator.GetAttribute("type"), decorator.GetAttribute
    if kind == "CompositeDecorator":
        expression = decorator.FindNestedElementByName("Expression")
        return any(is_shown(proxy, expression.GetNestedElement(k))
                   for k in range(expression.GetNumberOfNestedElements()))
    if kind == "InputDataTypeDecorator":
        return False
    if words("mode") != "visibility":
        return True
    value = str(proxy.GetProperty(words("property")).GetElement(int(words("index") or 0)))
    return (value in (words("values") or words("value")).split()) != (words("inverse") == "1")


def shown_properties(proxy):
    """Returns the properties in the panel of a filter, without inputs, advanced properties and
    properties that another one hides."""
    for key in proxy.ListProperties():
        prop = proxy.SMProxy.GetProperty(key)
        if (prop.IsA("vtkSMInputProperty") or prop.GetInformationOnly()
                or prop.GetPanelVisibility() != "default"):
            continue
        hints = prop.GetHints()
        number = hints.GetNumberOfNestedElements() if hints else 0
        nested = [hints.GetNestedElement(k) for k in range(number)]
        if all(is_shown(proxy.SMProxy, element) for element in nested
               if element.GetName() == "PropertyWidgetDecorator"):
            yield key


def value_of(prop):
    """Returns the value of a property as the getters of classes do: several elements as a tuple."""
    elements = tuple(prop.GetElement(k) for k in range(prop.GetNumberOfElements()))
    return elements[0] if len(elements) == 1 else elements


def arrays_of(proxy):
    """Returns the properties that choose arrays, in the order of the panel."""
    properties = vtkSMOrderedPropertyIterator()
    properties.SetProxy(proxy.SMProxy)
    properties.Begin()
    while not properties.IsAtEnd():
        if properties.GetProperty().GetCommand() == "SetInputArrayToProcess":
            yield properties.GetKey()
        properties.Next()


class TestDefaults(unittest.TestCase):
    def setUp(self):
        self.surface = plugin.sphere()
        self.proxies = {
            name: getattr(simple, name)(Input=self.surface) for name in plugin.PROXIES}

    def tearDown(self):
        for proxy in self.proxies.values():
            simple.Delete(proxy)
        simple.Delete(self.surface)

    def properties(self):
        """Yields the proxy name, a new object of the class, the property name and the property."""
        for name, proxy in self.proxies.items():
            instance = getattr(filters, "vtk" + name)()
            for key in proxy.ListProperties():
                yield name, instance, key, proxy.SMProxy.GetProperty(key)

    def values(self):
        """Yields the properties with a getter in the class."""
        for name, instance, key, prop in self.properties():
            if not (prop.IsA("vtkSMProxyProperty") or prop.GetInformationOnly() or prop.GetRepeatable()
                    or prop.GetCommand() == "SetInputArrayToProcess"):
                yield name, instance, key, prop

    def test_every_default_is_the_class_default(self):
        compared = 0
        for name, instance, key, prop in self.values():
            with self.subTest(proxy=name, property=key):
                prop.ResetToXMLDefaults()
                self.assertEqual(value_of(prop), getattr(instance, "Get" + key)())
                compared += 1
        self.assertGreaterEqual(compared, 7 * len(plugin.PROXIES))  # the loop has seen every filter

    def test_the_curve_of_the_panel_is_that_of_the_class(self):
        curve = self.proxies["SurfaceDetail"].CustomTransferFunction
        of_class = filters.vtkSurfaceDetail().GetCustomTransferFunction()
        points = []
        for k in range(of_class.GetSize()):
            node = [0.0] * 4
            of_class.GetNodeValue(k, node)
            points += node
        self.assertEqual(list(curve.Points), points)
        self.assertEqual(
            self.proxies["SurfaceDetail"].GetClientSideObject().GetCustomTransferFunction(),
            curve.GetClientSideObject())

    def test_the_object_gets_the_default(self):
        """The default of a position comes from the bounds of the input."""
        for name, _, key, prop in self.values():
            with self.subTest(proxy=name, property=key):
                server_side = self.proxies[name].GetClientSideObject()
                self.assertEqual(getattr(server_side, "Get" + key)(), value_of(prop))

    def test_no_array_is_chosen(self):
        self.assertGreater(sum(len(list(arrays_of(proxy))) for proxy in self.proxies.values()), 10)
        for name, proxy in self.proxies.items():
            for index, key in enumerate(arrays_of(proxy)):
                with self.subTest(proxy=name, property=key):
                    prop = proxy.SMProxy.GetProperty(key)
                    expected = 9 if key == "DomainArray" else INDICES.get((name, key), index)
                    self.assertEqual(prop.GetElement(0), str(expected))
                    self.assertRegex(prop.GetElement(4), r"^\(None(: \w+)?\)$")

    def test_every_range_is_the_class_range(self):
        compared = 0
        for name, instance, key, prop in self.values():
            domain = prop.FindDomain("vtkSMIntRangeDomain") or prop.FindDomain(
                "vtkSMDoubleRangeDomain")
            if prop.FindDomain("vtkSMEnumerationDomain"):
                continue
            if key in REFUSED_BELOW:
                lowest, highest = REFUSED_BELOW[key], None
            elif hasattr(instance, f"Get{key}MinValue"):
                lowest = getattr(instance, f"Get{key}MinValue")()
                highest = getattr(instance, f"Get{key}MaxValue")()
            else:
                continue
            with self.subTest(proxy=name, property=key):
                self.assertIsNotNone(domain)
                self.assertEqual(domain.GetMinimum(0) if domain.GetMinimumExists(0) else None, lowest)
                end = None if highest in UNBOUNDED else highest
                self.assertEqual(domain.GetMaximum(0) if domain.GetMaximumExists(0) else None, end)
                compared += 1
        self.assertGreater(compared, 30)  # the loop has seen every filter

    def test_every_choice_is_one_of_the_class(self):
        for name, instance, key, prop in self.values():
            domain = prop.FindDomain("vtkSMEnumerationDomain")
            if not domain:
                continue
            for entry in range(domain.GetNumberOfEntries()):
                with self.subTest(proxy=name, property=key, entry=domain.GetEntryText(entry)):
                    getattr(instance, "Set" + key)(domain.GetEntryValue(entry))
                    self.assertEqual(
                        getattr(instance, "Get" + key)(), domain.GetEntryValue(entry))

    def test_labels_are_names_with_spaces(self):
        """Messages make labels of names in this way (LabelOf in Filters/Core/Solvers)."""
        for name, _, key, prop in self.properties():
            with self.subTest(proxy=name, property=key):
                self.assertEqual(prop.GetXMLLabel(), re.sub("(?<=[a-z])(?=[A-Z])", " ", key))

    def test_everything_is_documented(self):
        for name, _, key, prop in self.properties():
            with self.subTest(proxy=name, property=key):
                words = prop.GetDocumentation().GetDescription()
                self.assertTrue(words and len(words.split()) >= 4)
        for name, proxy in self.proxies.items():
            documentation = proxy.SMProxy.GetDocumentation()
            with self.subTest(proxy=name):
                self.assertTrue(documentation.GetShortHelp())
                self.assertTrue(documentation.GetLongHelp())
                self.assertGreater(len(documentation.GetDescription().split()), 40)

    def test_a_panel_shows_what_matters(self):
        for name, proxy in self.proxies.items():
            with self.subTest(proxy=name):
                shown = set(shown_properties(proxy))
                self.assertLessEqual(len(shown), MOST_SHOWN, sorted(shown))
                if name not in plugin.WITHOUT_GRID:
                    self.assertTrue(shown & {"Depth", "SmoothingScale"})
                # An array that a filter cannot do without is seen.
                self.assertLessEqual(set(plugin.CHOICES.get(name, ())), shown)

    def test_labels_say_what_a_special_number_means(self):
        """The group of a property does, because the label of the property is its name in Python."""
        told = 0
        for name, proxy in self.proxies.items():
            groups = [proxy.SMProxy.GetPropertyGroup(k)
                      for k in range(proxy.SMProxy.GetNumberOfPropertyGroups())]
            labels = {proxy.SMProxy.GetPropertyName(group.GetProperty(k)): group.GetXMLLabel()
                      for group in groups for k in range(group.GetNumberOfProperties())}
            for key in proxy.ListProperties():
                domain = proxy.SMProxy.GetProperty(key).FindDomain("vtkSMIntRangeDomain")
                is_special = domain and domain.GetMinimumExists(0) and domain.GetMinimum(0) == -1
                if key == "Depth" or is_special:
                    with self.subTest(proxy=name, property=key):
                        label = proxy.SMProxy.GetProperty(key).GetXMLLabel()
                        self.assertIn(f"{label} {'0' if key == 'Depth' else '-1'}: ", labels[key])
                        told += 1
                if key == "Level":
                    self.assertIn("14: finest", labels[key], name)
        self.assertGreater(told, len(self.proxies))

    def test_labels_are_the_names_of_scripts(self):
        for name, _, key, prop in self.properties():
            with self.subTest(proxy=name, property=key):
                self.assertEqual(prop.GetXMLLabel().replace(" ", ""), key)

    def test_lists_of_ids_are_advanced_and_other_inputs_are_offered(self):
        for name, _, key, prop in self.properties():
            with self.subTest(proxy=name, property=key):
                if key == "SourcePointIds":
                    self.assertEqual(prop.GetPanelVisibility(), "advanced")
                if key in ("Sources", "Values", "Basis"):
                    self.assertEqual(prop.GetPanelWidget(), "input_selector")
                    self.assertEqual(
                        prop.GetPanelVisibility(), "advanced" if key == "Basis" else "default")

    def test_every_filter_is_in_the_menu(self):
        for name, proxy in self.proxies.items():
            with self.subTest(proxy=name):
                entry = proxy.SMProxy.GetHints().FindNestedElementByName("ShowInMenu")
                self.assertEqual(entry.GetAttribute("category"), "Surface FEM")
                self.assertIn(entry.GetAttribute("section"), ("Solve", "Analyze", "Shape", "Basis"))

    def test_filters_are_found_by_their_job(self):
        """ParaView's search finds a filter by its label and its jobs."""
        for words, name in JOBS.items():
            proxy = self.proxies[name].SMProxy
            jobs = proxy.GetHints().FindNestedElementByName("ShowInMenu").GetAttribute("jobs")
            with self.subTest(words=words, proxy=name):
                self.assertIn(words, f"{proxy.GetXMLLabel()}: {jobs}".lower())


if __name__ == "__main__":
    plugin.load()
    unittest.main()
