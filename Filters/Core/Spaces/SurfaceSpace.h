// The interface between problems and a space that one or several processes hold: levels, integrals
// of fields on the mesh, and values.
#ifndef GridFEM_SurfaceSpace_h
#define GridFEM_SurfaceSpace_h

#include "Grid/Field.h"
#include "Spaces/SpaceLevels.h"

#include <memory>
#include <vector>

namespace gridfem
{

/// A space on a surface. The conventions of SpaceLevels apply. The mesh is the mesh of this
/// process, and fields and values are on its points and triangles. If several processes hold the
/// surface, each triangle is in the mesh of one of them. Rows of integrals are complete in every
/// process that has them.
class SurfaceSpace : public SpaceLevels
{
public:
  /// World units per unit of length.
  virtual double UnitLength() const = 0;

  const SurfaceSpace* NestedLevels() const override { return nullptr; }

  ///@{ The finest level. Fields are given on the mesh, in world units. Each method throws
  /// InvalidInput when their rows or columns do not fit.

  /// Returns ∫ f b_i: rows = functions, columns = components of f.
  virtual MultiVector LoadOfValues(const Field& f, const Job& job = {}) const = 0;

  /// Returns ∫ w f b_i with a weight w on each triangle.
  virtual MultiVector LoadOfWeightedValues(
    const Field& f, const std::vector<double>& weight, const Job& job = {}) const = 0;

  /// Returns ∫ <s, ∇b_i>, dimensionless like the stiffness. Vector c of s is in columns 3c .. 3c+2;
  /// its part normal to the surface is ignored.
  /// @param scale  field with one column that multiplies s; null: 1
  /// @return rows = functions, one column per vector
  virtual MultiVector LoadOfGradients(
    const Field& s, const Field* scale, const Job& job = {}) const = 0;

  /// Computes LoadOfGradients for the field s = ∇f, with f linear on each triangle (f must be on
  /// points).
  virtual MultiVector LoadOfGradientsOf(
    const Field& f, const Field* scale, const Job& job = {}) const = 0;

  /// Computes LoadOfGradientsOf for the coordinates of the mesh's points, as functions in space.
  /// The coordinates remain the solution of their own equation, even on a grid with a weight of the
  /// normal derivative.
  virtual MultiVector LoadOfGradientsOfCoordinates(
    const Field* scale, const Job& job = {}) const = 0;

  /// Returns the mean surface gradients on the triangles, per world length: rows = triangles, three
  /// columns for each column of `coefficients`. Triangles without area get 0.
  virtual MultiVector GradientsOnTriangles(
    const MultiVector& coefficients, const Job& job = {}) const = 0;

  /// Returns for each point of the mesh: 1 if a function reaches it, otherwise 0.
  virtual std::vector<char> PointsWithFunctions() const = 0;
  ///@}

  /// Returns the same functions with the mass ∫ w b_i b_j for a weight w >= 0 on each triangle, and
  /// with Integrals() ∫ w b_i. The stiffness and all loads do not change. Throws InvalidInput
  /// unless there is one finite weight per triangle. [FiniteElementSpace::WeighMass]
  virtual std::shared_ptr<const SurfaceSpace> WithWeightedMass(
    const std::vector<double>& weight, const Job& job = {}) const = 0;

  /// Adds the contributions of all processes to sums over the triangles around each point of the
  /// mesh.
  virtual void SumAtPoints(MultiVector& /*parts*/) const {}
};

} // namespace gridfem

#endif
