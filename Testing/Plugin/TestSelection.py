"""Tests selections of ParaView as inputs of filters: of points and cells, by the mouse and by a query."""
import unittest

import gridfem.vtkGridFEMFilters  # before the plugin, which makes objects of its classes
from paraview import simple

import plugin


def values(proxy, name):
    array = plugin.data(proxy).GetPointData().GetArray(name)
    return [array.GetTuple1(k) for k in range(array.GetNumberOfTuples())]


class Selection(unittest.TestCase):
    def setUp(self):
        self.surface = plugin.with_arrays(plugin.sphere())
        self.detail = simple.SurfaceDetail(Input=self.surface, Depth=4, TransitionWidth=0)

    def tearDown(self):
        simple.ResetSession()

    def selected(self, selection):
        self.detail.Selection = selection
        inside = values(self.detail, "Selected")
        self.assertEqual(set(inside) - {0, 1}, set())
        return [point for point, value in enumerate(inside) if value]

    def test_points_by_id(self):
        self.assertEqual(self.selected(plugin.selected_points(3, 17, 500)), [3, 17, 500])

    def test_cells_by_id(self):
        cells = simple.IDSelectionSource(FieldType="CELL", IDs=[0, 10, 0, 100])
        surface = plugin.data(self.surface)
        points = {surface.GetCell(cell).GetPointId(k) for cell in (10, 100) for k in range(3)}
        self.assertEqual(self.selected(cells), sorted(points))

    def test_points_by_query(self):
        query = simple.SelectionQuerySource(ElementType=0, QueryString="f > 0.3")
        f = values(self.surface, "f")
        self.assertEqual(
            self.selected(query), [point for point, value in enumerate(f) if value > 0.3])

    def test_what_the_mouse_takes_in_a_view(self):
        view = simple.CreateRenderView(ViewSize=[400, 400])
        simple.Show(self.surface, view)
        view.CameraPosition, view.CameraFocalPoint, view.CameraViewUp = [0, 0, 5], [0, 0, 0], [0, 1, 0]
        simple.Render(view)
        simple.SetActiveSource(self.surface)
        for select in (simple.SelectSurfacePoints, simple.SelectSurfaceCells,
                       simple.SelectPointsThrough, simple.SelectCellsThrough):
            with self.subTest(by=select.__name__):
                select(Rectangle=[200, 200, 260, 260], View=view)
                selection = self.surface.GetSelectionInput(0)
                surface = plugin.data(self.surface)
                places = [surface.GetPoint(point) for point in self.selected(selection)]
                self.assertGreater(len(places), 10)
                self.assertLess(len(places), surface.GetNumberOfPoints() / 4)
                self.assertTrue(all(x > -0.3 and y > -0.3 for x, y, _ in places))
                through = "Through" in select.__name__
                self.assertEqual(any(z < -0.5 for *_, z in places), through)
        simple.Delete(view)  # while its display is still there

    def test_new_scales_solve_nothing_and_a_new_selection_fills_no_matrix(self):
        self.selected(plugin.selected_points(3))
        self.assertEqual(plugin.reruns(
            self.detail, lambda: simple.SetProperties(self.detail, DetailScale=3, OutsideScale=0)), [])
        self.assertEqual(
            plugin.reruns(self.detail, lambda: self.selected(plugin.selected_points(4))),
            ["RightHandSide", "Solve"])

    def test_a_new_curve_repeats_the_matrix(self):
        simple.SetProperties(self.detail, TransferFunction="Custom")
        self.detail.UpdatePipeline()
        before = values(self.detail, "NormalDisplacement")

        def change():
            self.detail.CustomTransferFunction.Points = [-1, 0, 0.5, 0, 1, 1, 0.5, 0]

        self.assertEqual(
            plugin.reruns(self.detail, change), ["Hierarchy", "RightHandSide", "Solve"])
        self.assertNotEqual(values(self.detail, "NormalDisplacement"), before)

    def test_sources_known_and_held_values(self):
        chosen = plugin.selected_points(3, 200, 400)
        distance = simple.GeodesicDistance(Input=self.surface, Depth=4, Selection=chosen)
        by_id = simple.GeodesicDistance(Input=self.surface, Depth=4, SourcePointIds=[3, 200, 400])
        self.assertEqual(values(distance, "Distance"), values(by_id, "Distance"))
        f = values(self.surface, "f")
        array = ["POINTS", "f"]
        spread = simple.HarmonicInterpolation(
            Input=self.surface, Depth=4, ValueArray=array, Selection=chosen)
        held = simple.ScreenedPoisson(
            Input=self.surface, Depth=4, ValueArray=array, ScreeningWeight=1, Selection=chosen)
        for proxy, name in ((spread, "Interpolated"), (held, "Solution")):
            result = values(proxy, name)
            for point in (3, 200, 400):
                self.assertAlmostEqual(result[point], f[point], 5)
            self.assertGreater(max(abs(a - b) for a, b in zip(result, f)), 0.05)


if __name__ == "__main__":
    plugin.load()
    unittest.main()
