// A random mesh with a random function space, and random options and fields for problems.
#ifndef GridFEM_Testing_RandomSurface_h
#define GridFEM_Testing_RandomSurface_h

#include "Equations/Poisson.h"
#include "RandomMesh.h"
#include "Spaces/HatSpace.h"

namespace gridfem::testing
{

struct RandomSurface
{
  std::string name;
  std::shared_ptr<const TriangleMesh> mesh;
  GridSpaceOptions options;
  bool isOnHats = false;
  std::shared_ptr<FiniteElementSpace> space; // null until Build
  const GridSpace* grid = nullptr;           // the space itself, or the grid below the hats

  Id NumberOfPoints() const { return static_cast<Id>(mesh->points.size()); }
  Id NumberOfTriangles() const { return static_cast<Id>(mesh->triangles.size()); }

  bool isChecked = true; // RequireSurface checks the mesh first

  /// Builds the space. Throws InvalidInput.
  void Build();

  std::string Describe() const;
};

/// @param isDefault  quadrature and operator have the filters' default options
RandomSurface MakeRandomSurface(Choice& choice, bool isDefault);

MultigridOptions RandomCycle(Choice& choice);
SolveOptions RandomSolve(Choice& choice);

/// Returns a field of any size, smooth or rough. Some columns are zeros, and some values are NaN or
/// infinite.
Field RandomField(Choice& choice, const TriangleMesh& mesh, Id columns, FieldAssociation where);

/// Returns a field with numbers of ordinary size.
Field OrdinaryField(Choice& choice, const TriangleMesh& mesh, Id columns, FieldAssociation where);

/// Returns random point ids; rarely, a point does not exist.
std::vector<Id> RandomPoints(Choice& choice, const TriangleMesh& mesh, Id most);

/// Returns 0 or a power of ten, in squared cells.
double RandomWeight(Choice& choice);

} // namespace gridfem::testing

#endif
