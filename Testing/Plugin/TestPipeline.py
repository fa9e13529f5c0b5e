"""Tests three ways of working: a filter on a mesh, a chain, one basis for several filters."""
import math
import unittest

import gridfem.vtkGridFEMFilters  # before the plugin, which makes objects of its classes
from paraview import servermanager, simple
from paraview.modules.vtkRemotingViews import vtkSMParaViewPipelineControllerWithRendering
from vtkmodules.vtkCommonCore import vtkOutputWindow

import plugin

DEPTH = 4


def outputs(proxy):
    """Returns the class of every output port's data."""
    ports = range(proxy.SMProxy.GetNumberOfOutputPorts())
    return [plugin.data(proxy, port).GetClassName() for port in ports]


class TestPipeline(unittest.TestCase):
    def setUp(self):
        self.surface = plugin.sphere()

    def tearDown(self):
        simple.ResetSession()

    def largest_difference(self, one, other, name):
        one, other = (plugin.data(proxy).GetPointData().GetArray(name) for proxy in (one, other))
        # The clipped mesh has the input's points first.
        return max(abs(one.GetTuple(i)[c] - other.GetTuple(i)[c])
                   for i in range(one.GetNumberOfTuples())
                   for c in range(one.GetNumberOfComponents()))

    def test_every_filter_runs_on_a_mesh(self):
        further = {  # behind the mesh
            "ClipToOctree": ["vtkPolyData", "vtkUnstructuredGrid"],
            "ConnectivityAwareBasis": ["vtkUnstructuredGrid"],
            "ScreenedPoisson": ["vtkTable"],
            "LaplaceSpectrum": ["vtkTable", "vtkTable"],
            "MeanCurvatureFlow": ["vtkTable", "vtkTable"],
            "SpectralSignatures": ["vtkTable"],
            "FunctionalMap": ["vtkPolyData"],
            "GeodesicPaths": ["vtkPolyData"],
            "Parameterization": ["vtkPolyData"]}
        surface = plugin.with_arrays(self.surface)
        for name in plugin.PROXIES:
            with self.subTest(proxy=name):
                proxy = getattr(simple, name)(
                    Input=surface, **plugin.depth_of(name, DEPTH), **plugin.choices(name))
                self.assertEqual(outputs(proxy), ["vtkPolyData", *further.get(name, [])])
                self.assertGreater(plugin.data(proxy).GetNumberOfCells(), 0)

    def test_output_ports_have_names(self):
        clip = simple.ClipToOctree(Input=self.surface, Depth=DEPTH)
        octree = simple.OutputPort(clip, "Octree Cells")
        self.assertEqual(plugin.data(clip, 2).GetNumberOfCells(),
                         octree.GetDataInformation().GetNumberOfCells())

    def test_chain_gives_what_one_filter_gives(self):
        clip = simple.ClipToOctree(Input=self.surface, Depth=DEPTH)
        basis = simple.ConnectivityAwareBasis(Input=clip)
        chained = simple.ScreenedPoisson(Input=basis, Tolerance=1e-8)
        alone = simple.ScreenedPoisson(Input=self.surface, Depth=DEPTH, Tolerance=1e-8)
        # Other triangles, same surface: equal to the tolerance of the solver, 1e-8, and the float
        # coordinates, 1e-7. A basis of another depth is off by 1e-3.
        self.assertLess(self.largest_difference(alone, chained, "Solution"), 1e-6)

    def test_every_filter_on_the_one_before(self):
        few = {"LaplaceSpectrum": {"NumberOfModes": 8}, "SpectralSignatures": {"NumberOfModes": 8}}
        last = plugin.with_arrays(simple.ClipToOctree(Input=self.surface, Depth=DEPTH))
        for name in [name for name in plugin.PROXIES if name != "ClipToOctree"]:
            last = getattr(simple, name)(Input=last, **plugin.choices(name), **few.get(name, {}))
            self.assertGreater(plugin.data(last).GetNumberOfPoints(), 0, name)
        arrays = plugin.data(last).GetPointData()
        for array in ("Distance", "Interpolated", "Diffused", "Solution", "StitchedColors"):
            self.assertTrue(arrays.HasArray(array), array)

    def test_two_solvers_share_a_basis(self):
        basis = simple.ConnectivityAwareBasis(Input=self.surface, Depth=DEPTH)
        poisson = simple.ScreenedPoisson(
            Input=self.surface, Basis=basis, Depth=7, Tolerance=1e-8)
        spectrum = simple.LaplaceSpectrum(Input=self.surface, Basis=basis, Depth=7)
        self.assertEqual(plugin.data(poisson).GetNumberOfPoints(),
                         plugin.data(self.surface).GetNumberOfPoints())
        plugin.data(spectrum)
        systems = plugin.runs(poisson)["System"] + plugin.runs(spectrum)["System"]
        self.assertEqual(systems, 1)
        alone = simple.ScreenedPoisson(Input=self.surface, Depth=DEPTH, Tolerance=1e-8)
        self.assertLess(self.largest_difference(alone, poisson, "Solution"), 1e-6)

    def test_a_basis_of_another_mesh_is_refused(self):
        other = simple.Sphere(Radius=1.0, ThetaResolution=20, PhiResolution=20)
        basis = simple.ConnectivityAwareBasis(Input=other, Depth=DEPTH)
        poisson = simple.ScreenedPoisson(Input=self.surface, Basis=basis)
        self.assertEqual(plugin.data(poisson).GetNumberOfPoints(), 0)

    def test_an_input_that_is_taken_away_counts_no_more(self):
        values = simple.Calculator(Input=self.surface, ResultArrayName="f", Function="coordsX")
        coarse = simple.ConnectivityAwareBasis(Input=values, Depth=3)
        few = simple.PointSource(Center=[1, 0, 0], NumberOfPoints=1)
        height = simple.Calculator(Input=few, ResultArrayName="f", Function="coordsZ")
        selected = plugin.selected_points(*range(0, 700, 7))
        settings = {
            "ScreenedPoisson": {"ValueArray": ["POINTS", "f"]},
            "HarmonicInterpolation": {"ValueArray": ["POINTS", "f"]},
            "HeatDiffusion": {"Array": ["POINTS", "f"], "DiffusionTime": 0.1},
            "SpectralSignatures": {"NumberOfModes": 8},
            "GeodesicDistance": {"SourcePointIds": [0]}}
        inputs = [(name, "Basis", coarse) for name in ("LaplaceSpectrum", "ScreenedPoisson")]
        inputs += [(name, "Sources", few) for name in ("GeodesicDistance", "SpectralSignatures")]
        inputs += [("HarmonicInterpolation", "Values", height)]
        inputs += [(name, "Selection", selected) for name in (
            "GeodesicDistance", "HarmonicInterpolation", "HeatDiffusion", "ScreenedPoisson",
            "SurfaceDetail")]
        for name, port, other in inputs:
            with self.subTest(proxy=name, input=port):
                def result(proxy):
                    points = plugin.data(proxy).GetPointData()
                    return [end for k in range(points.GetNumberOfArrays())
                            for end in points.GetArray(k).GetRange(0)]

                def differ(one, other):  # the last solution is where the next one starts
                    return len(one) != len(other) or max(
                        abs(a - b) for a, b in zip(one, other)) > 1e-4

                proxy = getattr(simple, name)(Input=values, Depth=DEPTH, **settings.get(name, {}))
                without = result(proxy)
                setattr(proxy, port, other)
                self.assertTrue(differ(result(proxy), without))
                setattr(proxy, port, None)
                self.assertFalse(differ(result(proxy), without))

    def test_only_what_depends_on_a_change_runs_again(self):
        values = simple.Calculator(Input=self.surface, ResultArrayName="f", Function="coordsX")
        poisson = simple.ScreenedPoisson(
            Input=values, ValueArray=["POINTS", "f"], Depth=DEPTH)
        plugin.data(poisson)
        self.assertEqual(set(plugin.runs(poisson).values()), {1})

        def set_weight():
            poisson.ScreeningWeight = 10

        def set_function():
            values.Function = "coordsY"

        def set_depth():
            poisson.Depth = DEPTH + 1

        self.assertEqual(plugin.reruns(poisson, set_weight), ["Hierarchy", "Solve"])
        self.assertEqual(plugin.reruns(poisson, set_function), ["RightHandSide", "Solve"])
        self.assertEqual(plugin.reruns(poisson, set_depth), list(plugin.STAGES))

    def test_arrays_are_chosen_by_name(self):
        def components(proxy):
            return plugin.data(proxy).GetPointData().GetArray("Solution").GetNumberOfComponents()

        values = simple.Calculator(Input=self.surface, ResultArrayName="f", Function="coordsX")
        plugin.data(values)
        poisson = simple.ScreenedPoisson(Input=values, Depth=DEPTH)
        self.assertEqual(components(poisson), 3)  # the coordinates, although there are arrays
        poisson.ValueArray = ["POINTS", "f"]
        self.assertEqual(components(poisson), 1)

    def test_sharpening_by_the_gradient_of_the_values(self):
        values = simple.Calculator(Input=self.surface, ResultArrayName="f", Function="coordsX")
        poisson = simple.ScreenedPoisson(Input=values, Depth=DEPTH, UseValueGradient=1)

        def largest(scale):
            poisson.GradientScale = scale
            return plugin.data(poisson).GetPointData().GetArray("Solution").GetRange()[1]

        smoothed, kept, sharpened = (largest(scale) for scale in (0, 1, 2))
        self.assertAlmostEqual(kept, 1.0, delta=0.01)  # x on a sphere of radius 1
        self.assertLess(smoothed, kept - 0.05)
        self.assertGreater(sharpened, kept + 0.05)

    def test_modes_are_time_steps(self):
        spectrum = simple.LaplaceSpectrum(
            Input=self.surface, Depth=DEPTH, NumberOfModes=6)
        plugin.data(spectrum)
        self.assertEqual(list(spectrum.TimestepValues), [1, 2, 3, 4, 5])
        every = simple.LaplaceSpectrum(
            Input=self.surface, Depth=DEPTH, NumberOfModes=6, AllModes=1)
        expected = plugin.data(every).GetPointData()
        for mode in (3, 1, 5):
            spectrum.UpdatePipeline(float(mode))
            shown = spectrum.PointData["Mode"].GetRange()
            self.assertEqual(shown, expected.GetArray(f"Mode{mode:03}").GetRange())
        self.assertEqual(plugin.runs(spectrum)["Solve"], 1)

        spectrum.Mode = 2
        spectrum.UpdatePipeline(5.0)
        self.assertEqual(spectrum.PointData["Mode"].GetRange(),
                         expected.GetArray("Mode002").GetRange())
        spectrum.UpdatePipelineInformation()
        self.assertEqual(len(spectrum.TimestepValues), 0)
        self.assertEqual(plugin.runs(spectrum)["Solve"], 1)

    def test_flow_steps_are_time_steps(self):
        flow = simple.MeanCurvatureFlow(
            Input=self.surface, Depth=DEPTH, NumberOfSteps=4, TimeStep=2e-3)
        plugin.data(flow)
        self.assertEqual(list(flow.TimestepValues), [0, 1, 2, 3, 4])
        sizes = []
        for step in (0, 2, 4, 2):
            flow.UpdatePipeline(float(step))
            sizes.append(flow.GetDataInformation().GetBounds()[1])
        self.assertEqual(sizes[0], self.surface.GetDataInformation().GetBounds()[1])
        self.assertLess(sizes[2], sizes[1])
        self.assertEqual(sizes[1], sizes[3])
        flow.NumberOfSteps = 6
        flow.UpdatePipelineInformation()
        self.assertEqual(len(flow.TimestepValues), 7)

    def test_signatures_take_the_modes_of_the_input(self):
        spectrum = simple.LaplaceSpectrum(
            Input=self.surface, Depth=DEPTH, NumberOfModes=16, AllModes=1)
        signatures = simple.SpectralSignatures(Input=spectrum, NumberOfScales=5)
        arrays = plugin.data(signatures).GetPointData()
        self.assertEqual(arrays.GetArray("HeatKernelSignature").GetNumberOfComponents(), 5)
        self.assertEqual(plugin.runs(signatures)["Solve"], 0)
        self.assertEqual(plugin.data(signatures, 1).GetNumberOfRows(), 16)

    def test_distances_from_ids_and_from_other_points(self):
        signatures = simple.SpectralSignatures(
            Input=self.surface, Depth=DEPTH, NumberOfModes=16)
        self.assertIsNone(plugin.data(signatures).GetPointData().GetArray("BiharmonicDistance"))
        signatures.SourcePointIds = [0, 5]
        by_id = plugin.data(signatures).GetPointData().GetArray("BiharmonicDistance")
        self.assertEqual((by_id.GetValue(0), by_id.GetValue(5)), (0, 0))
        self.assertGreater(by_id.GetRange()[1], 0.1)

        places = [plugin.data(self.surface).GetPoint(point) for point in (0, 5)]
        selected = simple.Line(Point1=places[0], Point2=places[1], Resolution=1)
        signatures.SourcePointIds = []
        signatures.Sources = selected
        by_place = plugin.data(signatures).GetPointData().GetArray("BiharmonicDistance")
        self.assertEqual(by_place.GetRange(), by_id.GetRange())
        self.assertEqual(plugin.runs(signatures)["Solve"], 1)

    def test_other_sources_take_the_solution_alone(self):
        distance = simple.GeodesicDistance(Input=self.surface, Depth=DEPTH)
        plugin.data(distance)

        def set_source():
            distance.SourcePointIds = [1]

        self.assertEqual(plugin.reruns(distance, set_source), ["Solve"])
        values = plugin.data(distance).GetPointData().GetArray("Distance")
        self.assertEqual(values.GetValue(1), 0)
        self.assertAlmostEqual(values.GetValue(0), math.pi, delta=0.15)  # from pole to pole
        self.assertEqual(plugin.data(distance).GetPointData().GetScalars().GetName(), "Distance")

    def test_modes_vibrate_in_animate_modes(self):
        modes = simple.LaplaceSpectrum(
            Input=self.surface, Depth=DEPTH, NumberOfModes=9, AllModes=1)
        displacement = simple.Calculator(
            Input=modes, ResultArrayName="displacement", Function="Mode005*Normals")
        vibration = simple.AnimateModes(
            Input=displacement, Vectors=["POINTS", "displacement"], DisplacementPreapplied=0,
            DisplacementMagnitude=0.2)
        rest, moved = [], []
        for time, points in ((0.25, rest), (0.5, moved)):
            vibration.UpdatePipeline(time)
            data = servermanager.Fetch(vibration)
            data = data.GetBlock(0) if data.IsA("vtkMultiBlockDataSet") else data
            points += [data.GetPoint(point) for point in range(data.GetNumberOfPoints())]
        self.assertEqual(len(rest), plugin.data(modes).GetNumberOfPoints())
        values = plugin.data(modes).GetPointData().GetArray("Mode005")
        distances = [sum((a - b) ** 2 for a, b in zip(*pair)) ** 0.5 for pair in zip(rest, moved)]
        # cos(2 pi t) is 0 at the first time and -1 at the second.
        for point, distance in enumerate(distances):
            self.assertAlmostEqual(distance, 0.2 * abs(values.GetValue(point)), delta=1e-5)
        self.assertGreater(max(distances), 0.05)

    def test_tables(self):
        def columns(table):
            return [table.GetColumnName(column) for column in range(table.GetNumberOfColumns())]

        spectrum = simple.LaplaceSpectrum(Input=self.surface, Depth=DEPTH, NumberOfModes=6)
        self.assertLessEqual({"Mode", "Eigenvalue", "Residual"},
                             set(columns(plugin.data(spectrum, 1))))
        self.assertEqual(plugin.data(spectrum, 1).GetNumberOfRows(), 6)
        poisson = simple.ScreenedPoisson(Input=self.surface, Depth=DEPTH)
        self.assertLessEqual({"Iteration", "EnergyResidual", "Residual"},
                             set(columns(plugin.data(poisson, 1))))

    def test_charts_draw_what_tells(self):
        drawn = {
            "ScreenedPoisson": ["Log10AlgebraicError", "Log10DiscretizationError"],
            "LaplaceSpectrum": ["Eigenvalue"],
            "MeanCurvatureFlow": ["Sphericity"]}
        opened = {"LaplaceSpectrum", "MeanCurvatureFlow"}
        controller = vtkSMParaViewPipelineControllerWithRendering()
        for name, series in drawn.items():
            proxy = getattr(simple, name)(Input=self.surface, Depth=DEPTH)
            plugin.data(proxy)
            with self.subTest(proxy=name):
                self.assertEqual(
                    controller.GetPreferredViewType(proxy.SMProxy, 1),
                    "XYChartView" if name in opened else "None")
                chart = simple.Show(simple.OutputPort(proxy, 1), simple.CreateView("XYChartView"))
                self.assertEqual(list(chart.SeriesVisibility), series)
                # Row = iteration or mode; the flow has the steps, which are the times of the animation.
                self.assertEqual(chart.UseIndexForXAxis, int(name != "MeanCurvatureFlow"))
                if name == "MeanCurvatureFlow":
                    self.assertEqual(chart.XArrayName, "Step")

    def test_charts_of_blocks_draw_the_same_columns(self):
        errors = []
        vtkOutputWindow.GetInstance().AddObserver("ErrorEvent", lambda *_: errors.append(_))
        for kind in ("vtkMultiBlockDataSet", "vtkPartitionedDataSetCollection"):
            blocks = simple.GroupDatasets(
                Input=[self.surface, simple.Sphere(Radius=2.0, Center=[5, 0, 0])],
                BlockNames=["left", "right"], OutputType=kind)
            with self.subTest(kind=kind):
                spectrum = simple.LaplaceSpectrum(Input=blocks, Depth=DEPTH, NumberOfModes=4)
                view = simple.CreateView("XYChartView")
                chart = simple.Show(simple.OutputPort(spectrum, 1), view)
                view.SMProxy.Update()  # all but the picture
                self.assertEqual(list(chart.SeriesVisibility), ["Eigenvalue"])
                labels = list(chart.SeriesLabel)
                if "CompositeDataSetIndex" in chart.ListProperties():  # the boxes of the panel
                    self.assertIn("Eigenvalue (left)", labels)
                    self.assertNotIn("Eigenvalue (right)", labels)
                    chart.CompositeDataSetIndex = [1, 2]
                    second = "Eigenvalue (right)"
                else:  # from ParaView 6 on, the columns of all blocks share a name
                    self.assertIn("Eigenvalue", labels)
                    chart.BlockSelectors = ["/Root/left", "/Root/right"]
                    second = "Eigenvalue"
                view.SMProxy.Update()
                self.assertEqual(list(chart.SeriesVisibility), ["Eigenvalue"])
                self.assertIn(second, list(chart.SeriesColor))
                self.assertEqual(errors, [])


if __name__ == "__main__":
    plugin.load()
    unittest.main()
