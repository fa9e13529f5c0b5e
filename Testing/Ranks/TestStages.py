"""Tests the kept stages if rank 0 gathers the surface, and steps in time."""
import unittest

import numpy
from vtkmodules.util import numpy_support
from vtkmodules.vtkCommonDataModel import vtkDataObject, vtkPolyData
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline as pipeline

import ranks

STAGES = ("Space", "System", "RightHandSide", "Hierarchy", "Solve")


class Stages(unittest.TestCase):
    def runs(self, filter_):
        return {stage: filter_.GetNumberOfRuns(stage) for stage in STAGES}

    def expect_runs(self, filter_, expected):
        """Returns the stages of the first rank. The others compute nothing."""
        if ranks.RANK > 0:
            expected = dict.fromkeys(STAGES, 0)
        runs = self.runs(filter_)
        ranks.check(self, [] if runs == {**runs, **expected} else [f"{runs}, not {expected}"])

    def piece(self):
        return ranks.piece(ranks.ellipsoid(), "ghosts")

    def test_an_unchanged_input_repeats_nothing(self):
        filter_ = ranks.make("ScreenedPoisson", gathers=True)
        data = self.piece()
        ranks.run(filter_, data)
        once = dict.fromkeys(STAGES, 1)
        self.expect_runs(filter_, once)
        ranks.run(filter_, data)
        self.expect_runs(filter_, once)
        copy = vtkPolyData()
        copy.ShallowCopy(data)
        ranks.run(filter_, copy)
        self.expect_runs(filter_, once)
        ranks.run(filter_, self.piece())  # read again: new arrays with the same numbers
        self.expect_runs(filter_, once)

    def test_a_change_on_one_rank_repeats_what_depends_on_it(self):
        for rank in {0, ranks.RANKS - 1}:
            filter_ = ranks.make("ScreenedPoisson", gathers=True)
            ranks.run(filter_, self.piece())
            data = self.piece()
            if ranks.RANK == rank:
                inside = data.GetNumberOfPoints() // 2  # no ghost
                numpy_support.vtk_to_numpy(data.GetPointData().GetArray("f"))[inside] += 1.0
            ranks.run(filter_, data)
            self.expect_runs(filter_, {"Space": 1, "System": 1, "RightHandSide": 2, "Solve": 2})
            data = self.piece()
            if ranks.RANK == rank:
                numpy_support.vtk_to_numpy(data.GetPoints().GetData())[:] *= 1.001
            ranks.run(filter_, data)
            self.expect_runs(filter_, {"Space": 2, "System": 2})

    def test_without_kept_stages_the_answer_is_the_same(self):
        filter_ = ranks.make("ScreenedPoisson", gathers=True, ReleaseDataFlag=True)
        data = self.piece()
        problems = []
        values = []
        for _ in range(2):
            output = ranks.run(filter_, data)[0]
            values.append(numpy_support.vtk_to_numpy(
                output.GetPointData().GetArray("Solution")).copy())
        if (values[0] != values[1]).any():
            problems.append("the second run differs")
        ranks.check(self, problems)
        self.expect_runs(filter_, {"Space": 2, "Solve": 2})

    def test_an_empty_input_frees_and_a_new_one_is_computed(self):
        filter_ = ranks.make("ScreenedPoisson", gathers=True)
        ranks.run(filter_, self.piece())
        output = ranks.run(filter_, vtkPolyData())[0]
        ranks.check(self, ["not empty"] if output.GetNumberOfPoints() else [])
        ranks.run(filter_, self.piece())
        self.expect_runs(filter_, {"Space": 2, "Solve": 2})


class Time(unittest.TestCase):
    def steps(self, filter_):
        """Returns the steps of all ports, which have to be the same on all ranks."""
        filter_.UpdateInformation()
        steps = []
        for port in range(filter_.GetNumberOfOutputPorts()):
            steps += list(filter_.GetOutputInformation(port).Get(pipeline.TIME_STEPS()) or [])
        return steps

    def at(self, filter_, time):
        filter_.UpdateTimeStep(time)
        output = filter_.GetOutputDataObject(0)
        stamp = output.GetInformation().Get(vtkDataObject.DATA_TIME_STEP())
        return output, [] if stamp == time else [f"the data are of time {stamp}, not {time}"]

    def test_a_flow_plays(self):
        for kind in ("ghosts", "one rank is empty"):
            filter_ = ranks.make("MeanCurvatureFlow", NumberOfSteps=3)
            data = ranks.piece(ranks.ellipsoid(), kind)
            ranks.run(filter_, data)
            steps = self.steps(filter_)
            ranks.check(self, [] if steps == 3 * [0, 1, 2, 3] else [f"steps {steps}"])
            problems = []
            for time in (0.0, 2.0, 1.0, 3.0, 2.0):
                output, wrong = self.at(filter_, time)
                problems += wrong
                step = output.GetFieldData().GetArray("Step")
                if step.GetValue(0) != time:
                    problems.append(f"step {step.GetValue(0)} at {time}")
                if time == 0.0 and data.GetNumberOfPoints():
                    apart = ranks.apart(numpy_support.vtk_to_numpy(output.GetPoints().GetData()),
                                        numpy_support.vtk_to_numpy(data.GetPoints().GetData()))
                    problems += [f"moved by {apart} at the start"] if apart > 1e-12 else []
            ranks.check(self, problems)
            runs = filter_.GetNumberOfRuns("Space")
            ranks.check(self, [] if runs == (ranks.RANK == 0) else [f"{runs} runs"])

    def test_modes_that_do_not_exist_are_no_time_steps_on_any_rank(self):
        filter_ = ranks.make("LaplaceSpectrum", 2, NumberOfModes=1000, AllModes=False)
        ranks.run(filter_, ranks.piece(ranks.ellipsoid(), "contiguous"))
        steps = self.steps(filter_)
        every = ranks.gathered([float(len(steps)), sum(steps)]).reshape(-1, 2)
        problems = [] if (every == every[0]).all() and 10 <= len(steps) < 3 * 999 else [f"steps {steps}"]
        ranges = set()
        for mode in (1.0, 3.0, 5.0):
            output, wrong = self.at(filter_, mode)
            problems += wrong
            ranges.add(output.GetPointData().GetArray("Mode").GetRange())
        if len(ranges) != 3:
            problems.append("modes are the same")
        ranks.check(self, problems)
        filter_.SetNumberOfModes(4)
        steps = self.steps(filter_)
        ranks.check(self, [] if steps == 3 * [1, 2, 3] else [f"steps {steps}"])


if __name__ == "__main__":
    ranks.main()
