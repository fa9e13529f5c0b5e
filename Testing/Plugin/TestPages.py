"""Tests the examples on the pages: each runs unchanged, and all its outputs contain data."""
import os
import pathlib
import re
import unittest

from paraview import simple
from vtkmodules.vtkCommonDataModel import vtkDataObject

import plugin

PAGES = pathlib.Path(os.environ["GRIDFEM_SOURCE_DIR"]) / "Plugin" / "Documentation"


def surface():
    """Makes a spindle with the arrays that the examples name. It meets a tenth of the cells that a
    sphere would. The examples have the default depth of the filters, and are the same for any
    surface."""
    spindle = simple.Calculator(
        Input=plugin.sphere(), CoordinateResults=1, Function="0.1*(coordsX*iHat+coordsY*jHat)+coordsZ*kHat")
    mesh = simple.Calculator(
        Input=plugin.with_arrays(spindle), ResultArrayName="colors",
        Function="(coordsX+2)*iHat+(coordsY+2)*jHat+2*kHat")
    return simple.ProgrammableFilter(Input=mesh, CopyArrays=1, Script="""
x, z = inputs[0].Points[:, 0], inputs[0].Points[:, 2]
output.PointData.append(numpy.where(z > 0.7, numpy.nan, x), "g")""")


class Pages(unittest.TestCase):

    def tearDown(self):
        simple.ResetSession()

    def test_every_page_of_a_filter_has_an_example_that_runs(self):
        for name in plugin.PROXIES:
            with self.subTest(page=name):
                examples = re.findall(r"```python\n(.*?)```", (PAGES / f"{name}.md").read_text(), re.S)
                self.assertTrue(examples)
                names = {**vars(simple), "mesh": surface()}
                before = set(names)
                exec("\n".join(examples), names)  # pylint: disable=exec-used
                self.assertTrue(any(f"{name}(" in text for text in examples))
                for key in set(names) - before:
                    if key != "__builtins__":
                        self.check(key, names[key])

    def check(self, key, made):
        """The made object: a proxy, or one of its ports."""
        data = plugin.data(getattr(made, "Proxy", made), getattr(made, "Port", 0))
        sizes = [data.GetNumberOfElements(kind) for kind in (vtkDataObject.POINT, vtkDataObject.ROW)]
        self.assertGreater(max(sizes), 0, key)
        converged = data.GetFieldData().GetArray("Converged")
        if converged:
            self.assertEqual(converged.GetTuple1(0), 1, key)


if __name__ == "__main__":
    plugin.load()
    unittest.main()
