// Step 5: the library below the filters, without VTK. Smooths the heights of a bumpy plate with two
// weights, and computes its first eigenvalues.
//
//   gridfem_step_5 DEPTH

#include <Solvers/LocalSurface.h>
#include <Solvers/PoissonSolver.h>
#include <Solvers/SpectrumSolver.h>

#include <cmath>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <memory>

namespace
{

/// A square of side 1 with waves, of 2 n² triangles.
gridfem::TriangleMesh Plate(gridfem::Id n)
{
  gridfem::TriangleMesh mesh;
  for (gridfem::Id j = 0; j <= n; ++j)
  {
    for (gridfem::Id i = 0; i <= n; ++i)
    {
      const double x = static_cast<double>(i) / n;
      const double y = static_cast<double>(j) / n;
      mesh.points.push_back({ x, y, 0.05 * std::sin(9.0 * x) * std::cos(7.0 * y) });
    }
  }
  for (gridfem::Id j = 0; j < n; ++j)
  {
    for (gridfem::Id i = 0; i < n; ++i)
    {
      const gridfem::Id corner = j * (n + 1) + i;
      mesh.triangles.push_back({ corner, corner + 1, corner + n + 2 });
      mesh.triangles.push_back({ corner, corner + n + 2, corner + n + 1 });
    }
  }
  return mesh;
}

/// The heights of the points, as a solver takes them.
gridfem::GivenField Heights(const gridfem::TriangleMesh& mesh)
{
  gridfem::Field heights; // on points, one column
  heights.values.resize(static_cast<gridfem::Id>(mesh.points.size()), 1);
  for (gridfem::Id point = 0; point < heights.values.rows(); ++point)
  {
    heights.values(point, 0) = mesh.points[static_cast<std::size_t>(point)][2];
  }
  return gridfem::GivenField::Of("height", heights);
}

void Run(int depth)
{
  const auto mesh = std::make_shared<const gridfem::TriangleMesh>(Plate(60));
  gridfem::SurfaceOptions functions;
  functions.space.depth = depth; // 2^depth cells along the plate
  functions.parameterUnits = gridfem::ParameterUnits::World;

  // A surface and a solver that stay: after a change of an option the solver repeats only the
  // stages that depend on it. Here the functions and the integrals of the heights are kept.
  gridfem::Stages stages;
  gridfem::LocalSurface surface(stages, mesh, functions);
  gridfem::PoissonSolver smooth;
  gridfem::PoissonSolver::Input input;
  input.values = Heights(*mesh);
  gridfem::PoissonSolver::Options options;
  for (const double weight : { 500.0, 50.0 })
  {
    options.screeningWeight = weight;
    const gridfem::PoissonSolver::Result& result = smooth.Update(surface, input, options, {});
    std::cout << "weight " << weight << ": " << (result.report.converged ? "converged" : "stopped")
              << " after " << result.report.iterations << " iterations, heights up to "
              << result.atPoints.maxCoeff() << "\n";
  }
  std::cout << surface.Space().NumberOfFunctions(0) << " functions, made "
            << stages.Runs(gridfem::SpaceStage) << " time, solved "
            << stages.Runs(gridfem::SolveStage) << " times\n";

  // One call that keeps nothing.
  gridfem::SpectrumSolver::Options modes;
  modes.numberOfModes = 5;
  const gridfem::SpectrumSolver::Result spectrum =
    gridfem::SpectrumSolver::Solve(mesh, {}, modes, functions);
  std::cout << "eigenvalues:";
  for (const double eigenvalue : spectrum.eigenvalues)
  {
    std::cout << " " << eigenvalue;
  }
  std::cout << "\n";
}

} // namespace

int main(int argc, char* argv[])
{
  if (argc != 2)
  {
    std::cerr << "Usage: " << argv[0] << " DEPTH\n";
    return EXIT_FAILURE;
  }
  try
  {
    Run(std::atoi(argv[1]));
  }
  catch (const std::exception& error) // Core throws an exception for everything that it cannot do
  {
    std::cerr << error.what() << "\n";
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
