// What problems ask of a space that one process or several together hold: the levels, and on the
// mesh integrals of given fields, and values.
#ifndef GridFEM_SurfaceSpace_h
#define GridFEM_SurfaceSpace_h

#include "Grid/Field.h"
#include "Spaces/SpaceLevels.h"

#include <memory>
#include <vector>

namespace gridfem
{

/// The words of SpaceLevels hold here, too. The mesh is that of this process: fields and values are
/// on its points and triangles. Where several processes hold the surface, each triangle is in the
/// mesh of one of them, and rows of integrals are whole in all that have them.
class SurfaceSpace : public SpaceLevels
{
public:
  /// World units per unit of length.
  virtual double UnitLength() const = 0;

  ///@{ The finest level. Fields are given on the mesh, in world units; each method throws
  /// InvalidInput when their rows or columns do not fit.

  /// ∫ f b_i: rows = functions, columns = components of f.
  virtual MultiVector LoadOfValues(const Field& f, const Job& job = {}) const = 0;

  /// ∫ w f b_i with a weight w on each triangle.
  virtual MultiVector LoadOfWeightedValues(
    const Field& f, const std::vector<double>& weight, const Job& job = {}) const = 0;

  /// ∫ <s, ∇b_i> as the stiffness has it, without a unit. Vector c of s lies in columns 3c .. 3c+2;
  /// its part normal to the surface is ignored.
  /// @param scale  one column that multiplies s, or null
  /// @return rows = functions, one column per vector
  virtual MultiVector LoadOfGradients(
    const Field& s, const Field* scale, const Job& job = {}) const = 0;

  /// The same with s = ∇f, f linear on each triangle (f must live on points).
  virtual MultiVector LoadOfGradientsOf(
    const Field& f, const Field* scale, const Job& job = {}) const = 0;

  /// The same for the coordinates of the mesh's points, with what they are in space: on a grid with
  /// a weight of the normal derivative they stay the solution of their own equation.
  virtual MultiVector LoadOfGradientsOfCoordinates(
    const Field* scale, const Job& job = {}) const = 0;

  /// Mean surface gradients on the triangles, per world length: rows = triangles, three columns for
  /// each of the coefficients'; 0 on triangles without an area.
  virtual MultiVector GradientsOnTriangles(
    const MultiVector& coefficients, const Job& job = {}) const = 0;

  /// Per point of the mesh: 1 where a function reaches it.
  virtual std::vector<char> PointsWithFunctions() const = 0;
  ///@}

  /// The same functions with the mass ∫ w b_i b_j, a weight w >= 0 on each triangle, and
  /// Integrals() ∫ w b_i; the stiffness and all loads stay. Throws InvalidInput when there is not
  /// one finite weight per triangle. [FiniteElementSpace::WeighMass]
  virtual std::shared_ptr<const SurfaceSpace> WithWeighedMass(
    const std::vector<double>& weight, const Job& job = {}) const = 0;

  /// Sums over the triangles around each point of the mesh become those of all processes.
  virtual void SumAtPoints(MultiVector& /*parts*/) const {}
};

} // namespace gridfem

#endif
