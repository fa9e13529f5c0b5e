"""The XML says what the classes say: defaults, ranges, and words for everything."""
import unittest

import gridfem.vtkGridFEMFilters as filters  # before the plugin, which makes objects of its classes
from paraview import simple

import plugin

UNBOUNDED = 1000  # from here on the panel has no upper end, and so no slider that nobody can set

# Properties without a value that a getter of the class could give.
CONNECTIONS = {"Input", "Basis", "Sources"}
ARRAYS = {"ValueArray": 0, "GradientArray": 1, "GradientScaleArray": 2}
INFORMATION = {"TimestepValues"}
LISTS = {"SourcePointIds"}

# Over sixteen orders of magnitude a slider is of no use; the class keeps what is typed in range.
WITHOUT_SLIDER = {"Tolerance"}


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
        """Proxy name, a new object of the class, property name, property."""
        for name, proxy in self.proxies.items():
            instance = getattr(filters, "vtk" + name)()
            for key in proxy.ListProperties():
                yield name, instance, key, proxy.SMProxy.GetProperty(key)

    def values(self):
        for name, instance, key, prop in self.properties():
            if key not in CONNECTIONS | set(ARRAYS) | INFORMATION | LISTS:
                yield name, instance, key, prop

    def test_every_default_is_the_class_default(self):
        compared = 0
        for name, instance, key, prop in self.values():
            with self.subTest(proxy=name, property=key):
                prop.ResetToXMLDefaults()
                self.assertEqual(prop.GetElement(0), getattr(instance, "Get" + key)())
                compared += 1
        self.assertEqual(compared, 6 + 6 + 18 + 20 + 20 + 21)  # the loop has seen every filter

    def test_the_object_gets_the_default(self):
        for name, instance, key, _ in self.values():
            with self.subTest(proxy=name, property=key):
                server_side = self.proxies[name].GetClientSideObject()
                self.assertEqual(
                    getattr(server_side, "Get" + key)(), getattr(instance, "Get" + key)())

    def test_no_array_is_chosen(self):
        for name, _, key, prop in self.properties():
            if key in ARRAYS:
                with self.subTest(proxy=name, property=key):
                    self.assertEqual(prop.GetElement(0), str(ARRAYS[key]))
                    self.assertEqual(prop.GetElement(4), "None")

    def test_every_range_is_the_class_range(self):
        for name, instance, key, prop in self.values():
            domain = prop.FindDomain("vtkSMIntRangeDomain") or prop.FindDomain(
                "vtkSMDoubleRangeDomain")
            if not domain or not hasattr(instance, f"Get{key}MinValue"):
                continue
            with self.subTest(proxy=name, property=key):
                lowest = getattr(instance, f"Get{key}MinValue")()
                highest = getattr(instance, f"Get{key}MaxValue")()
                self.assertTrue(domain.GetMinimumExists(0))
                self.assertEqual(domain.GetMinimum(0), lowest)
                has_end = highest < UNBOUNDED and key not in WITHOUT_SLIDER
                self.assertEqual(bool(domain.GetMaximumExists(0)), has_end)
                if has_end:
                    self.assertEqual(domain.GetMaximum(0), highest)

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

    def test_every_filter_is_in_the_menu(self):
        for name, proxy in self.proxies.items():
            with self.subTest(proxy=name):
                entry = proxy.SMProxy.GetHints().FindNestedElementByName("ShowInMenu")
                self.assertEqual(entry.GetAttribute("category"), "Surface FEM")


if __name__ == "__main__":
    plugin.load()
    unittest.main()
