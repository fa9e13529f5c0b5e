// Common parts of tests of function spaces: named meshes in both spaces, coefficients of known
// functions, dense copies of sparse matrices.
#ifndef GridFEM_Testing_Spaces_h
#define GridFEM_Testing_Spaces_h

#include "Algebra/SparseMatrix.h"
#include "Dense.h"
#include "Grid/GridFunctions.h"
#include "Integrals/TrilinearBasis.h"
#include "Meshes.h"

#include <ostream>
#include <string>

namespace gridfem::testing
{

/// Returns the gradients of a cell's eight functions at a point in the cell's own coordinates.
inline std::array<Vec3, FunctionsPerPatch> TrilinearGradientsAt(const Vec3& local)
{
  std::array<CornerValues, 3> derivative;
  TrilinearGradients(local, derivative);
  std::array<Vec3, FunctionsPerPatch> gradient;
  for (int c = 0; c < FunctionsPerPatch; ++c)
  {
    gradient[c] = Vec3(derivative[0][c], derivative[1][c], derivative[2][c]);
  }
  return gradient;
}

/// A mesh and the options of a space on it, as a test parameter.
struct SpaceCase
{
  std::string name;
  TriangleMesh mesh;
  SpaceOptions options;

  GridFunctions Build() const { return BuildGridFunctions(mesh, options); }
};

inline std::ostream& operator<<(std::ostream& stream, const SpaceCase& space)
{
  return stream << space.name << (space.options.connectivityAware ? "" : " plain");
}

/// Returns surfaces that are curved, flat, on grid planes, nearly on grid planes (slivers), or
/// disconnected.
inline std::vector<SpaceCase> AllSpaces(int depth = 4)
{
  const double nearly = 1e-7; // radians, so that faces cross grid planes at glancing angles
  const std::vector<std::pair<std::string, TriangleMesh>> meshes = {
    { "sphere", GeodesicSphere(8) },
    { "torus", Torus(30, 12, 1.0, 0.3) },
    { "box on grid planes", Box(5) },
    { "box nearly on grid planes", Transform(Box(5), { 1, 1, 1 }, nearly) },
    { "rotated box far away", Transform(Box(4), { 1, 2, 3 }, 0.7, 10.0, { 500, -300, 20 }) },
    { "two sheets", Transform(TwoSheets(6, 0.01), { 1, 0.3, 0 }, 0.4) },
    { "soup", Unweld(Transform(GeodesicSphere(5), { 1, 0, 1 }, 0.3)) },
  };
  std::vector<SpaceCase> cases;
  for (const auto& [name, mesh] : meshes)
  {
    for (const bool connectivityAware : { true, false })
    {
      SpaceOptions options;
      options.depth = depth;
      options.connectivityAware = connectivityAware;
      cases.push_back({ name, mesh, options });
    }
  }
  return cases;
}

/// Copies one number at a time, because GCC warns about bounds when a fixed-size vector is assigned
/// to a dynamic row.
inline void SetRow(MultiVector& values, Id row, const Vec3& vector)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    values(row, axis) = vector[axis];
  }
}

/// Returns the grid corner of every finest function, in world units. These are the coefficients of
/// the coordinate functions.
inline MultiVector CoordinateCoefficients(const GridFunctions& space)
{
  const PatchLevel& level = space.Finest();
  MultiVector result = MultiVector::Zero(level.numberOfFunctions, 3);
  for (Id patch = 0; patch < level.NumberOfPatches(); ++patch)
  {
    const CellIndex cell = MortonDecode(level.cell[patch]);
    for (int c = 0; c < FunctionsPerPatch; ++c)
    {
      const Vec3 corner(cell[0] + (c & 1), cell[1] + ((c >> 1) & 1), cell[2] + (c >> 2));
      SetRow(result, level.dof[patch][c], space.GetGrid().ToWorld(corner));
    }
  }
  return result;
}

/// Returns these coefficients in grid units: the embedding that is the mesh itself.
inline MultiVector GridCoordinates(const GridFunctions& space)
{
  MultiVector coordinates = CoordinateCoefficients(space);
  for (Id i = 0; i < coordinates.rows(); ++i)
  {
    SetRow(coordinates, i, space.GetGrid().ToGrid(coordinates.row(i).transpose()));
  }
  return coordinates;
}

/// Returns the points of a mesh as values on points.
inline MultiVector PointCoordinates(const TriangleMesh& mesh)
{
  MultiVector result(mesh.points.size(), 3);
  for (std::size_t i = 0; i < mesh.points.size(); ++i)
  {
    SetRow(result, static_cast<Id>(i), mesh.points[i]);
  }
  return result;
}

} // namespace gridfem::testing

#endif
