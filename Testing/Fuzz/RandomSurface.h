// A random mesh with random functions on it, and random options and fields for problems.
#ifndef GridFEM_Testing_RandomSurface_h
#define GridFEM_Testing_RandomSurface_h

#include "Problems/Poisson.h"
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
  const GridSpace* grid = nullptr;           // it, or the one below the hats

  Id NumberOfPoints() const { return static_cast<Id>(mesh->points.size()); }
  Id NumberOfTriangles() const { return static_cast<Id>(mesh->triangles.size()); }

  bool isChecked = true; // RequireSurface has the first word

  /// Throws InvalidInput.
  void Build();

  std::string Describe() const;
};

/// @param isDefault  the quadrature and the operator are those of the filters by default
RandomSurface MakeRandomSurface(Choice& choice, bool isDefault);

MultigridOptions RandomCycle(Choice& choice);
SolveOptions RandomSolve(Choice& choice);

/// Of any size, smooth or rough, now and then with columns of zeros or of NaN.
Field RandomField(Choice& choice, const TriangleMesh& mesh, Id columns, FieldAssociation where);

/// Numbers of ordinary size.
Field OrdinaryField(Choice& choice, const TriangleMesh& mesh, Id columns, FieldAssociation where);

/// Mostly points of the mesh.
std::vector<Id> RandomPoints(Choice& choice, const TriangleMesh& mesh, Id most);

/// 0 or a power of ten, in squared cells.
double RandomWeight(Choice& choice);

} // namespace gridfem::testing

#endif
