// Moments of the pieces of a patch, from which the element matrices of quadratic B-splines follow
// linearly. Along each axis, products of two functions or of their slopes are polynomials of degree
// four. In the basis of Bernstein polynomials their coefficients cancel only where the products
// vanish, so that functions that barely reach the surface keep their digits.
#ifndef GridFEM_QuadraticMoments_h
#define GridFEM_QuadraticMoments_h

#include "Integrals/PatchIntegrals.h"
#include "Integrals/SmoothElements.h"

namespace gridfem
{

class QuadraticMoments
{
public:
  /// Adds the triangles of a batch.
  /// @param bendWeight  weight of |∂nn u|²
  void Add(const TriangleBatch& batch, const TrianglePlanes& planes, const QuadratureRule& rule,
    const BatchWeights& weights, const Lanes& bendWeight);

  SmoothElementMatrix Mass() const;
  SmoothElementMatrix Stiffness() const;

private:
  static constexpr int Terms = 5; // Bernstein polynomials of degree four along an axis
  static constexpr int Moments = Terms * Terms * Terms;

  void AddBend(const TriangleBatch& batch, const TrianglePlanes& planes, const Lanes& weight);

  // Row 0 has the moments of the mass. Rows 1 to 3 have those of T_xx, T_yy and T_zz, and rows 4 to
  // 6 those of T_xy, T_yz and T_zx. The last row is unused. Moments are numbered x fastest.
  using Sums = Eigen::Matrix<double, LaneCount, Moments>;
  Sums sums_ = Sums::Zero();

  using Matrix =
    Eigen::Matrix<double, SmoothFunctionsPerPatch, SmoothFunctionsPerPatch, Eigen::RowMajor>;
  Matrix bend_ = Matrix::Zero();

  static Matrix Expand(const Sums& sums, int row, const std::array<int, 3>& kinds);
  static SmoothElementMatrix Pack(const Matrix& matrix);
};

} // namespace gridfem

#endif
