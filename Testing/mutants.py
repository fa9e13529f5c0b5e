"""Makes deliberate errors, one after the other. Each must fail a test. Usage: mutants.py COPY [NAME...]

COPY is a copy of the sources with a configured build folder COPY/build; Testing/checks.sh mutants makes
one. Each error replaces one line, builds one test program, and runs its tests. The line is put back
afterwards. An error that no test notices is a failure, and so is a line that is no longer there.
"""
import os
import pathlib
import subprocess
import sys

# Name, file, line, replacement, and the test program that must fail.
MUTANTS = (
    ("directions that a device leaves out are lost", "Filters/Core/Multigrid/DeviceHierarchy.cxx",
     "        AddSolutions(unresolved_[level], b, x);",
     "        (void)AddSolutions;",
     "TestDeviceHierarchy"),
    ("a polynomial of another kind", "Filters/Device/Cycles.cxx",
     "    const float first = step == 1 ? 0.0f : (2.0f * k - 3.0f) / (2.0f * k + 1.0f);",
     "    const float first = step == 1 ? 0.0f : (2.0f * k - 1.0f) / (2.0f * k + 1.0f);",
     "TestDeviceHierarchy"),
    ("a device without units", "Filters/Device/Kernels.h",
     "    unit[row] = PowerNearRoot(own);",
     "    unit[row] = 1.0;",
     "TestDeviceHierarchy"),
    ("a group of rows that is left out", "Filters/Core/Spectrum/NearestRows.cxx",
     "    if (group != first && least <= nearest.distance)",
     "    if (group != first && 1.2 * toCenters[group] <= nearest.distance)",
     "TestNearestRows"),
    ("mirrored maps win", "Filters/Core/Spectrum/FunctionalMap.cxx",
     "      [](const Finalist& finalist) { return finalist.side > -ClearSide; });",
     "      [](const Finalist& finalist) { return finalist.side < ClearSide; });",
     "TestFunctionalMapSolver"),
    ("landmarks that are not in the key", "Filters/Core/Solvers/FunctionalMapSolver.cxx",
     "    key.Add(landmark[0]).Add(landmark[1]);",
     "    (void)landmark;",
     "TestFunctionalMapSolver"),
    ("a correction that is not harmonic", "Filters/Core/Equations/LocalCorrection.cxx",
     "        entries.emplace_back(number[other], -weight);",
     "        entries.emplace_back(number[other], -0.99 * weight);",
     "TestLocalCorrection"),
    ("nan in a distance", "Filters/Core/Distance/GeodesicDistance.cxx",
     "  field.atPoints = sources.shifted(distance, job.Part(0.8, 0.85));",
     "  field.atPoints = sources.shifted(distance, job.Part(0.8, 0.85)); field.atPoints[9] = NaN;",
     "TestGeodesicDistance"),
    ("converged without heat", "Filters/Core/Distance/GeodesicDistance.cxx",
     "  field.report.converged = field.report.converged && field.heatConverged && field.unreached == 0;",
     "  field.report.converged = field.report.converged || field.unreached > 0;",
     "TestGeodesicDistanceFilter"),
    ("unknown error counts as known", "Filters/Core/Equations/SolutionAccuracy.cxx",
     "  return std::isnan(a) || a >= b ? a : b;",
     "  return std::fmax(a, b);",
     "TestSolutionAccuracy"),
    ("load 1 % too large", "Filters/Core/Integrals/LoadSums.h",
     "      const Lanes weighted = sample.weight * value[c];",
     "      const Lanes weighted = 1.01 * sample.weight * value[c];",
     "TestLoadVector"),
    ("gradient 3 % too large", "Filters/Core/Integrals/Evaluation.cxx",
     "            coefficients(level.dof[patch][i], c) - coefficients(level.dof[patch][0], c);",
     "            1.03 * (coefficients(level.dof[patch][i], c) - coefficients(level.dof[patch][0], c));",
     "TestEvaluation"),
    ("coarsening of one axis", "Filters/Core/Integrals/CoarsenElements.cxx",
     "    lower[e00] += 0.5 * (lower[e01] + lower[e10]) + middle;",
     "    lower[e00] += 0.5 * (lower[e01] + lower[e01]) + middle;",
     "TestElementMatrices"),
    ("last parent has no children", "Filters/Core/Integrals/CoarsenElements.cxx",
     "  Scatter(sum[0], count, result);",
     "  Scatter(sum[0], begin + count == parents ? count - 1 : count, result);",
     "TestElementMatrices"),
    ("swapped sign of the rotation", "Filters/Core/Shape/HodgeDecomposition.cxx",
     "  return -space.LoadOfTurnedGradients(facing, job);",
     "  return space.LoadOfTurnedGradients(facing, job);",
     "TestHodgeDecomposition"),
    ("curvature 1 % off", "Filters/Core/Shape/PrincipalCurvatures.cxx",
     "    curvature = { mean - difference, mean + difference };",
     "    curvature = { mean - difference, 1.01 * mean + difference };",
     "TestPrincipalCurvatures"),
    ("heat kernel grows", "Filters/Core/Spectrum/SpectralDescriptors.cxx",
     "      weights(k, j) = std::exp(-modes.eigenvalues[k] * times[j]);",
     "      weights(k, j) = std::exp(modes.eigenvalues[k] * times[j]);",
     "TestSpectralDescriptors"),
    ("diffusion distance without its area", "Filters/Core/Spectrum/SpectralDescriptors.cxx",
     "    weights[k] = modes.area * std::exp(-2.0 * modes.eigenvalues[k] * time);",
     "    weights[k] = std::exp(-2.0 * modes.eigenvalues[k] * time);",
     "TestSpectralDescriptors"),
    ("constraints do not change a heat flow", "Filters/Core/Solvers/DiffusionSolver.cxx",
     "  key.Add(KeyOf(input.source)).Add(KeyOf(input.constraints)).Add(options.boundaryValues);",
     "  key.Add(KeyOf(input.source)).Add(options.boundaryValues);",
     "Plugin.TestEveryProperty"),
    ("unit does not change a transition", "Filters/Core/Solvers/DetailSolver.cxx",
     "    fields.Add(options.transitionWidth).Add(surface.UsedOptions().parameterUnits);",
     "    fields.Add(options.transitionWidth);",
     "TestSurfaceDetailFilter"),
    ("slivers stay", "Filters/Core/Grid/Patches.cxx",
     "    target[patch] = isSliver[patch] ? -1 : static_cast<Index>(patch);",
     "    target[patch] = static_cast<Index>(patch);",
     "TestPatchLevel"),
    ("functions elsewhere are accepted", "Filters/Core/Grid/StoredFunctions.cxx",
     "      if (point[function] != NoPoint && point[function] != here)",
     "      if (function < 0)",
     "TestPatchLevel"),
    ("torn patches are accepted", "Filters/Core/Grid/StoredFunctions.cxx",
     "    if (!isJoined && ShareAnEdge(clipped, first, second))",
     "    if (!isJoined && first == second && ShareAnEdge(clipped, first, second))",
     "TestPatchLevel"),
    ("damaged cells are read", "Filters/VTK/Private/Input/InputValidation.cxx",
     "  if (cells && !cells->IsValid())",
     "  if (cells && cells->GetNumberOfCells() < 0)",
     "TestFailureRule"),
    ("messages have no end", "Filters/VTK/Private/Pieces/DataMessage.cxx",
     "  if (!(bytes >= 0.0 && bytes <= static_cast<double>(bytes_.size() - taken_)))",
     "  if (bytes < -1.0)",
     "Fuzz.Filters"),
    ("any byte is a bool", "Filters/VTK/Private/Pieces/DataMessage.cxx",
     "  if (byte > 1)",
     "  if (byte > 255)",
     "TestDataMessage"),
    ("messages of any size", "Filters/Parallel/Communicator.h",
     "          RequireCounts(received, *expected);",
     "          static_cast<void>(expected);",
     "Parallel.TestCommunicatorOn3"),
    ("means not weighted by area", "Filters/Core/Grid/Field.cxx",
     "      mean.row(sourceCell[t]) += ofTriangle * onTriangles.row(t);",
     "      mean.row(sourceCell[t]) += onTriangles.row(t);",
     "TestSurfaceGradient"),
    ("an iteration of details that ended early is kept", "Filters/Core/Solvers/DetailSolver.cxx",
     "  key.Add(input.values ? KeyOf(options.equation) : StageKey());",
     "  key.Add(input.values ? StageKey() : StageKey());",
     "TestDetailSolver"),
    ("further arrays in turned order", "Filters/VTK/Private/Input/JoinedArrays.cxx",
     "      joined->CopyComponent(c, part.array.array, own);",
     "      joined->CopyComponent(components - 1 - c, part.array.array, own);",
     "TestFurtherArrays"),
    ("area kept for flows that shrink", "Filters/Core/Solvers/FlowSolver.cxx",
     "  return options.conformalized ? Rescaling::ConstantArea : Rescaling::None;",
     "  return Rescaling::ConstantArea;",
     "TestFlowSolver"),
    ("blend in the wrong unit", "Filters/Core/Solvers/StitchSolver.cxx",
     "  ofStitching.blendWidth = options.blendWidth * space->Extent() * space->UnitLength();",
     "  ofStitching.blendWidth = options.blendWidth * space->UnitLength();",
     "TestStitchSolver"),
    ("ranks send the row before", "Filters/Parallel/RankRows.cxx",
     "      rows.row(row) = x.row(out[k][row]);",
     "      rows.row(row) = x.row(out[k][row > 0 ? row - 1 : row]);",
     "Parallel.TestRankPoissonOn3"),
    ("paths keep their corners", "Filters/Core/Distance/SurfacePath.cxx",
     "  constexpr double Least = double(EIGEN_PI) - AngleRounding;",
     "  constexpr double Least = 0.5 * double(EIGEN_PI) - AngleRounding;",
     "TestSurfacePath"),
    ("random fields 5 % too large", "Filters/Core/Equations/MaternField.cxx",
     "  return std::sqrt(4.0 * double(EIGEN_PI) * options_.smoothness) *",
     "  return 1.05 * std::sqrt(4.0 * double(EIGEN_PI) * options_.smoothness) *",
     "TestMaternField"),
    ("smooth functions overlap in one direction", "Filters/Core/Integrals/SmoothElements.cxx",
     "                                AxisWeight(octant >> 2, c / 9, p / 9);",
     "                                AxisWeight(0, c / 9, p / 9);",
     "TestSmoothLevels"),
    ("half of the full width", "Filters/Core/Solvers/DiffusionSolver.cxx",
     "  return fullWidth * fullWidth / (16.0 * std::log(2.0));",
     "  return fullWidth * fullWidth / (8.0 * std::log(2.0));",
     "TestDiffusionSolver"),
    ("boundary in the wrong unit", "Filters/Core/Solvers/ZeroBoundary.cxx",
     "    length *= penalty * space.Extent() / surface.Space().UnitLength();",
     "    length *= penalty * space.Extent();",
     "TestZeroBoundary"),
    ("hanging nodes in the wrong order", "Filters/Core/Grid/JoinSeams.cxx",
     "      std::reverse(nodes.begin(), nodes.end());",
     "      std::sort(nodes.begin(), nodes.end());",
     "TestJoinSeams"),
    ("triangles face inward", "Filters/Core/Grid/OrientedMesh.cxx",
     "    if (edges.side[t] < 0)",
     "    if (edges.side[t] > 0)",
     "TestOrientedMesh"),
    ("volumes of triangles as they face", "Filters/Core/Shape/MeanCurvatureFlow.cxx",
     "  return SizeOf(points, oriented_.TrianglesOf(*mesh_), threads);",
     "  return SizeOf(points, mesh_->triangles, threads);",
     "TestMeanCurvatureFlow"),
    ("surrogates mix groups", "Filters/Core/Spectrum/SpectralSurrogates.cxx",
     "    const Id count = std::min<Id>(2 * static_cast<Id>(group) + 3, shares.rows() - first);",
     "    const Id count = std::min<Id>(2 * static_cast<Id>(group) + 4, shares.rows() - first);",
     "TestSpectralSurrogates"),
    ("unknown values are inside", "Filters/VTK/Private/Input/Domain.cxx",
     "  return value != 0.0 && !std::isnan(value);",
     "  return value != 0.0;",
     "TestDomain"),
    ("selections are not checked", "Filters/VTK/Private/Input/SelectionCheck.cxx",
     "    RequireList(node, data);",
     "    node->Modified();",
     "Fuzz.Filters"),
)


def passes(build, test):
    """Builds and runs a test. Tests with a dot in their name are entries of ctest."""
    target = {"Plugin": "GridFEM", "Parallel": test.split(".")[-1].split("On")[0], "Fuzz": "FuzzFilters"}
    built = target.get(test.split(".")[0], test)
    made = subprocess.run(["cmake", "--build", str(build), "--target", built], capture_output=True, text=True)
    if made.returncode:
        sys.exit(f"{test} cannot be built:\n{made.stdout[-3000:]}{made.stderr[-3000:]}")
    if "." in test:
        command = ["ctest", "--test-dir", str(build), "--no-tests=error", "-R", f"^{test}$"]
    else:
        command = [str(next(p for p in build.rglob(test) if p.is_file())), "--gtest_brief=1"]
    first = {**os.environ, "GTEST_FAIL_FAST": "1"}  # one failure is enough
    return subprocess.run(command, env=first, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL).returncode == 0


def is_caught(copy, mutant):
    name, file, line, replacement, test = mutant
    path = copy / file
    text = path.read_text()
    if text.count(line + "\n") != 1:
        sys.exit(f"{name}: {file} has the line {text.count(line)} times: {line}")
    path.write_text(text.replace(line, replacement))
    try:
        return not passes(copy / "build", test)
    finally:
        path.write_text(text)


def main():
    copy = pathlib.Path(sys.argv[1]).resolve()
    chosen = [m for m in MUTANTS if not sys.argv[2:] or m[0] in sys.argv[2:]]
    for test in sorted({mutant[-1] for mutant in chosen}):
        if not passes(copy / "build", test):
            sys.exit(f"{test} fails without a deliberate error")
    survivors = []
    for mutant in chosen:
        caught = is_caught(copy, mutant)
        print(f"{'caught' if caught else 'SURVIVES'}: {mutant[0]} ({mutant[-1]})", flush=True)
        survivors += [] if caught else [mutant[0]]
    print(f"{len(chosen) - len(survivors)} of {len(chosen)} deliberate errors fail a test")
    return 1 if survivors else 0


if __name__ == "__main__":
    sys.exit(main())
