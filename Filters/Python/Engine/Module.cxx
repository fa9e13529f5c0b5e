// The Python module gridfem._core: arrays of numpy in and out, without VTK.
#include "Problem.h"

#include "Base/Errors.h"
#include "Base/LargeMemory.h"
#include "Base/ShortWaits.h"
#include "Grid/PolygonTriangles.h"
#include "Solvers/SurfaceOptions.h"

#include <pybind11/eigen.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <chrono>
#include <numeric>
#include <optional>

namespace py = pybind11;

namespace gridfem
{
namespace
{

using Points = py::array_t<double, py::array::c_style>;
using Cells = py::array_t<Id, py::array::c_style>;
using Arrays = std::map<std::string, std::pair<MultiVector, bool>>;
using Numbers = std::map<std::string, double>;

const std::map<std::string, MakeProblem> Problems = {
  { "FarthestPoints", MakeFarthestPoints },
  { "FunctionalMap", MakeFunctionalMap },
  { "GaussianField", MakeGaussianField },
  { "GeodesicDistance", MakeDistance },
  { "GeodesicPaths", MakePath },
  { "HarmonicInterpolation", MakeInterpolation },
  { "HeatDiffusion", MakeDiffusion },
  { "LaplaceSpectrum", MakeSpectrum },
  { "MeanCurvatureFlow", MakeFlow },
  { "Parameterization", MakeParameterization },
  { "PrincipalCurvatures", MakeCurvatures },
  { "ScreenedPoisson", MakePoisson },
  { "SpectralSignatures", MakeSignatures },
  { "StitchColors", MakeStitching },
  { "SurfaceDetail", MakeDetail },
  { "SurfaceDynamics", MakeDynamics },
  { "SurfaceGradient", MakeGradient },
};

/// Looks for Ctrl-C every tenth of a second.
class Signals
{
public:
  bool GoOn()
  {
    const auto now = Clock::now();
    if (now - lastLook_ < std::chrono::milliseconds(100))
    {
      return true;
    }
    lastLook_ = now;
    const py::gil_scoped_acquire python;
    return PyErr_CheckSignals() == 0;
  }

private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point lastLook_ = Clock::now();
};

std::vector<Vec3> VectorsOf(const Points& points)
{
  const auto rows = points.unchecked<2>();
  std::vector<Vec3> vectors(static_cast<std::size_t>(rows.shape(0)));
  for (py::ssize_t k = 0; k < rows.shape(0); ++k)
  {
    vectors[k] = { rows(k, 0), rows(k, 1), rows(k, 2) };
  }
  return vectors;
}

/// Returns reactions that a function of Python computes: from a row of values for each place to a
/// row of rates. Several threads may call them.
GivenReactions ReactionsOf(const py::object& function, int species)
{
  GivenReactions reactions;
  if (function.is_none())
  {
    return reactions;
  }
  const std::shared_ptr<const py::object> kept(new py::object(function),
    [](const py::object* object)
    {
      const py::gil_scoped_acquire python;
      delete object;
    });
  reactions.species = species;
  reactions.rates = [kept, species](const double* u, double* rates, Id places)
  {
    const py::gil_scoped_acquire python;
    const std::vector<py::ssize_t> shape = { places, species };
    const auto result = (*kept)(Points(shape, u)).cast<Points>();
    if (result.ndim() != 2 || result.shape(0) != places || result.shape(1) != species)
    {
      throw InvalidInput(
        "the function of reactions must return an array of the shape it is given.");
    }
    std::copy_n(result.data(), result.size(), rates);
  };
  return reactions;
}

Results SolveAlone(const Problem& problem, const Given& given)
{
  const py::gil_scoped_release others;
  KeepWaitsShort();
  const MemoryReuse reuse;
  Signals signals;
  return problem(given, Progress([&](double) { return signals.GoOn(); }));
}

py::tuple Solve(const std::string& name, const Points& points, const Cells& cells,
  const Arrays& arrays, const Numbers& numbers, const std::vector<Id>& sources,
  const std::vector<double>& observed, const py::object& reactions, int species,
  const std::optional<std::pair<Points, Cells>>& reference, const std::vector<Id>& partners)
{
  Properties properties(name, numbers);
  const Problem problem = Problems.at(name)(properties);
  const bool welds =
    properties.Switch("WeldCoincidentPoints", SurfaceOptions().space.weldCoincidentPoints);
  properties.RequireNoOther();
  Given given;
  given.SetCells(VectorsOf(points), cells.data(), cells.shape(0), cells.shape(1), welds);
  for (const auto& [array, values] : arrays)
  {
    if (values.first.rows() != (values.second ? points.shape(0) : cells.shape(0)))
    {
      throw InvalidInput(array + " has " + std::to_string(values.first.rows()) + " rows.");
    }
    given.arrays[array] = { values.first, values.second };
  }
  given.sources = sources;
  given.observed = observed;
  given.reactions = ReactionsOf(reactions, species);
  if (reference)
  {
    const auto& [places, polygons] = *reference;
    Given other;
    other.SetCells(VectorsOf(places), polygons.data(), polygons.shape(0), polygons.shape(1), welds);
    given.reference = other.mesh;
    given.partners = partners;
  }
  try
  {
    const Results results = SolveAlone(problem, given);
    return py::make_tuple(results.arrays, results.warnings);
  }
  catch (const Aborted&)
  {
    throw py::error_already_set(); // raised by the signal
  }
}

std::vector<Triangle> Triangulate(const Points& corners)
{
  std::vector<Id> ids(static_cast<std::size_t>(corners.shape(0)));
  std::iota(ids.begin(), ids.end(), Id{ 0 });
  return TrianglesOfPolygon(VectorsOf(corners), 0, ids);
}

/// Returns the default and the range of each property by name.
std::map<std::string, std::array<double, 3>> KnownProperties(const std::string& name)
{
  Properties properties(name, {});
  Problems.at(name)(properties);
  std::map<std::string, std::array<double, 3>> known;
  for (const auto& [property, range] : properties.Known())
  {
    known[property] = { range.standard, range.least, range.most };
  }
  return known;
}

} // namespace

PYBIND11_MODULE(_core, module)
{
  module.doc() = "GridFEM's numerics, for the package gridfem.";
  module.def("solve", &Solve,
    "Solves the problem of a filter's name: arrays and warnings.\n\n"
    "arrays: per name a matrix and whether its rows are points, else they are cells.",
    py::arg("name"), py::arg("points"), py::arg("cells"), py::arg("arrays"), py::arg("properties"),
    py::arg("sources"), py::arg("observed"), py::arg("reactions") = py::none(),
    py::arg("species") = 0, py::arg("reference") = py::none(),
    py::arg("partners") = std::vector<Id>());
  module.def("triangulate", &Triangulate, "The triangles of a polygon, by its corners.");
  module.def("properties", &KnownProperties, "Per property its default and its range.");
}

} // namespace gridfem
