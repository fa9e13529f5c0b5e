#include "Discretization.h"
#include "Figures.h"
#include "Measure.h"
#include "Meshes.h"
#include "SetupCost.h"
#include "ShiftInvert.h"
#include "Spectrum/Spectrum.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>

namespace gridfem::benchmarks
{

namespace
{

constexpr int Modes = 100;
const char* const Number = "number of the eigenvalue";

/// World units.
std::vector<double> Eigenvalues(const GridFunctions& space, int degree)
{
  SpectrumOptions options;
  options.numberOfModes = Modes;
  std::vector<double> values = ComputeSpectrum(
    testing::ViewOf(space, BuildLevelOperators(space, TriangleRule(degree))), options)
                                 .eigenvalues;
  for (double& value : values)
  {
    value /= space.GetGrid().spacing * space.GetGrid().spacing;
  }
  return values;
}

GridFunctions Space(const TriangleMesh& mesh, int depth, bool connectivityAware = true)
{
  SpaceOptions options;
  options.depth = depth;
  options.connectivityAware = connectivityAware;
  return BuildGridFunctions(mesh, options);
}

/// |value / reference - 1| from the second eigenvalue on.
std::vector<double> Differences(
  const std::vector<double>& values, const std::vector<double>& reference)
{
  std::vector<double> differences;
  for (std::size_t k = 1; k < std::min(values.size(), reference.size()); ++k)
  {
    differences.push_back(std::abs(values[k] / reference[k] - 1.0));
  }
  return differences;
}

Panel SpectrumPanel(const std::string& title)
{
  return { title, Number, "eigenvalue", false, {} };
}

Panel DifferencePanel(const std::string& title, const std::string& quantity)
{
  return { title, Number, quantity, true, {} };
}

std::vector<double> HatEigenvalues(const TriangleMesh& mesh)
{
  return SpectraSpectrum(AssembleCotangents(mesh), Modes, TruthTolerance).eigenvalues;
}

} // namespace

void WriteQuadratureFigure(const std::string& folder)
{
  const GridFunctions space = Space(RockerArm(0).mesh, 5);
  const double triangles = static_cast<double>(space.clipped.NumberOfTriangles());
  Figure figure{ "figure-4.4",
    { SpectrumPanel("Rocker arm, depth 5: five quadrature rules"),
      DifferencePanel("The same against degree 12", "relative difference") } };
  const std::vector<double> best = Eigenvalues(space, 12);
  for (const int degree : { 2, 4, 6, 10, 12 })
  {
    const double samples = triangles * static_cast<double>(TriangleRule(degree).points.size());
    const std::string name = "degree " + std::to_string(degree) + ", " +
                             std::to_string(TriangleRule(degree).points.size()) + " points, " +
                             Text("%.0f samples", samples);
    const std::vector<double> values = degree == 12 ? best : Eigenvalues(space, degree);
    figure.panels[0].curves.push_back(CountedCurve(name, Curve::Kind::Ours, values, 1));
    if (degree != 12)
    {
      figure.panels[1].curves.push_back(CountedCurve(
        "degree " + std::to_string(degree), Curve::Kind::Ours, Differences(values, best), 2));
    }
  }
  WriteFigure(figure, folder);
}

void WriteRigidMotionFigure(const std::string& folder)
{
  constexpr int Motions = 10;
  constexpr int Depth = 6;
  const NamedMesh mesh = RockerArm(0);
  std::mt19937 generator(1);
  const auto number = [&] { return 2.0 * double(generator()) / double(std::mt19937::max()) - 1.0; };
  std::vector<std::vector<double>> spectra;
  std::vector<double> mean(Modes, 0.0);
  for (int k = 0; k < Motions; ++k)
  {
    const Vec3 axis(number(), number(), number());
    const double angle = 3.14159265358979323846 * number();
    const TriangleMesh moved = testing::Transform(mesh.mesh, axis, angle);
    spectra.push_back(Eigenvalues(Space(moved, Depth), 2));
    for (int mode = 0; mode < Modes; ++mode)
    {
      mean[mode] += spectra.back().at(mode) / Motions;
    }
  }
  Figure figure{ "figure-4.5",
    { SpectrumPanel("Rocker arm in ten positions, depth 6"),
      { "The same against their mean", Number, "relative difference", false, {} } } };
  for (int k = 0; k < Motions; ++k)
  {
    const std::string name = "position " + std::to_string(k + 1);
    figure.panels[0].curves.push_back(CountedCurve(name, Curve::Kind::Ours, spectra[k], 1));
    std::vector<double> difference;
    for (int mode = 1; mode < Modes; ++mode)
    {
      difference.push_back(spectra[k][mode] / mean[mode] - 1.0);
    }
    figure.panels[1].curves.push_back(CountedCurve(name, Curve::Kind::Ours, difference, 2));
  }
  WriteFigure(figure, folder);
}

namespace
{

/// Cotangents on the mesh, on the mesh subdivided once, and grids of about as many functions,
/// against cotangents on a mesh that is subdivided once or twice more.
Panel CompareWithCotangents(
  const std::string& title, const TriangleMesh& low, const std::vector<int>& depths)
{
  Panel panel = DifferencePanel(title, "relative error");
  const TriangleMesh mid = testing::SubdivideInPlane(low);
  const TriangleMesh high = testing::SubdivideInPlane(mid);
  const std::vector<double> fine = HatEigenvalues(mid);
  std::vector<double> truth = HatEigenvalues(high);
  for (std::size_t k = 0; k < truth.size(); ++k)
  {
    truth[k] += (truth[k] - fine[k]) / 3.0; // the error falls by four: Richardson's limit
  }
  const auto label = [](const char* what, std::size_t count)
  { return std::string(what) + Text(", %.0f functions", static_cast<double>(count)); };
  panel.curves.push_back(CountedCurve(label("cotangents", low.points.size()), Curve::Kind::Peer,
    Differences(HatEigenvalues(low), truth), 2));
  panel.curves.push_back(CountedCurve(
    label("cotangents", mid.points.size()), Curve::Kind::Peer, Differences(fine, truth), 2));
  for (const int depth : depths)
  {
    const GridFunctions space = Space(low, depth);
    const Index functions = space.Finest().numberOfFunctions;
    std::printf("Table 4.3: %s: cotangents %zu / %zu / %zu, depth %d: %d functions, plain %d\n",
      title.c_str(), low.points.size(), mid.points.size(), high.points.size(), depth, functions,
      Space(low, depth, false).Finest().numberOfFunctions);
    panel.curves.push_back(
      CountedCurve(label(("grid, depth " + std::to_string(depth)).c_str(), functions),
        Curve::Kind::Ours, Differences(Eigenvalues(space, 2), truth), 2));
  }
  return panel;
}

} // namespace

void WriteCotangentFigure(const std::string& folder)
{
  Figure figure{ "figure-4.6", {} };
  figure.panels.push_back(CompareWithCotangents("Sphere", testing::LatLongSphere(140, 69), { 5 }));
  figure.panels.push_back(CompareWithCotangents("Rocker arm", RockerArm(0).mesh, { 5, 6 }));
  const NamedMesh genus3 = RealMesh("Genus-3", "genus3_13k.ply");
  if (!genus3.mesh.points.empty())
  {
    figure.panels.push_back(CompareWithCotangents(genus3.name, genus3.mesh, { 5, 6 }));
  }
  figure.panels.push_back(CompareWithCotangents(
    "Pulley, walls 1.5 cells at depth 5", testing::Pulley(60, 1.5 / 16.0), { 5 }));
  WriteFigure(figure, folder);
}

} // namespace gridfem::benchmarks
