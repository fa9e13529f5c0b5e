// Step 5: the library below the filters, without VTK. Fits a function to the heights of the points
// of a bumpy plate, and computes its first eigenvalues in the same space.
//
//   gridfem_step_5 DEPTH

#include <Problems/Poisson.h>
#include <Problems/Spectrum.h>
#include <Spaces/SpaceChoice.h>

#include <cmath>
#include <cstdlib>
#include <exception>
#include <iostream>

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

void Run(int depth)
{
  const gridfem::TriangleMesh mesh = Plate(60);

  // A space of functions: the mesh is clipped to a grid, and every connected piece of a support
  // gets a function. FunctionKind::Hats would take the mesh's own.
  gridfem::SpaceOptions options;
  options.depth = depth;
  const auto space = gridfem::BuildSpace(mesh, options, gridfem::SpaceChoice(), {});
  std::cout << space->NumberOfFunctions(0) << " functions on " << space->NumberOfLevels()
            << " levels\n";

  // (λM + L) u = λ f, with a hierarchy of λM + L and integrals of f. Lengths in the space are in
  // its own unit, so that λ, which is per area, is multiplied by that squared.
  gridfem::Field heights;
  heights.values.resize(static_cast<gridfem::Id>(mesh.points.size()), 1);
  for (std::size_t point = 0; point < mesh.points.size(); ++point)
  {
    heights.values(static_cast<gridfem::Id>(point), 0) = mesh.points[point][2];
  }
  gridfem::PoissonOptions equation;
  equation.screeningWeight = 500.0 * space->UnitLength() * space->UnitLength();
  equation.accuracy = 0.1; // iterate to a tenth of the error of the space
  const gridfem::Multigrid multigrid =
    gridfem::BuildMultigrid(*space, equation.screeningWeight, 1.0, equation.multigrid);
  const gridfem::PoissonSolution solution =
    gridfem::SolvePoisson(*space, multigrid, space->LoadOfValues(heights), {}, equation);
  const gridfem::MultiVector atPoints = space->ValuesAtPoints(solution.coefficients);
  std::cout << (solution.report.converged ? "converged" : "stopped") << " after "
            << solution.report.iterations << " iterations; heights up to "
            << heights.values.maxCoeff() << " became " << atPoints.maxCoeff() << "\n";

  gridfem::SpectrumOptions modes;
  modes.numberOfModes = 5;
  const gridfem::Spectrum spectrum = gridfem::ComputeSpectrum(*space, modes);
  std::cout << "eigenvalues per area:";
  for (const double eigenvalue : spectrum.eigenvalues)
  {
    std::cout << " " << eigenvalue / (space->UnitLength() * space->UnitLength());
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
  catch (const std::exception& error) // Core says everything that it cannot do by an exception
  {
    std::cerr << error.what() << "\n";
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
