// Evaluates the constant function on two triangles. Vectors are made in the library and freed here:
// that works only if both agree on the alignment of Eigen's memory.
#include "Base/Types.h"

#include <Base/SimdLanes.h>
#include <GridFEM/Grid/GridFunctions.h>
#include <Integrals/Evaluation.h>

#include <iostream>

static_assert(alignof(gridfem::Lanes) == 64, "as in the library, whatever this processor is");

int main()
{
  gridfem::TriangleMesh mesh;
  mesh.points = { { 0, 0, 0 }, { 1, 0, 0.1 }, { 0, 1, 0.2 }, { 1, 1, 0.7 } };
  mesh.triangles = { { 0, 1, 2 }, { 1, 3, 2 } };
  gridfem::SpaceOptions options;
  options.depth = 4;
  for (int run = 0; run < NumberOfRuns; ++run)
  {
    const gridfem::GridFunctions space = gridfem::BuildGridFunctions(mesh, options);
    gridfem::MultiVector ones =
      gridfem::MultiVector::Ones(space.Finest().numberOfFunctions, 1 + run % 3);
    ones = gridfem::EvaluateAtPoints(space, ones);
    if (ones.rows() != 4 ||
        std::abs(ones.maxCoeff() - 1.0) + std::abs(ones.minCoeff() - 1.0) > 1e-12)
    {
      std::cerr << "The functions do not sum to one.\n";
      return 1;
    }
  }
  std::cout << "The functions sum to one.\n";
  return 0;
}
