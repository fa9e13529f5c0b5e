// Means of functions over the connected components of a surface, and the constants that have them.
#ifndef GridFEM_ComponentMeans_h
#define GridFEM_ComponentMeans_h

#include "Algebra/ColumnAlgebra.h"
#include "Algebra/DividedRows.h"
#include "Base/Types.h"

#include <vector>

namespace gridfem
{

/// Blocks have one row per function, means one row per component; any number of columns. Same bits
/// for any number of threads. Keeps references to what it is made from. Where processes hold the
/// rows together, all of them call every function, and means are those of the whole.
class ComponentMeans
{
public:
  /// @param component  per function, 0 .. numberOfComponents - 1
  /// @param integral   ∫ b_i per function
  /// @param divided    null: this process holds all functions
  ComponentMeans(const std::vector<Index>& component, const std::vector<double>& integral,
    Index numberOfComponents, int threads, const DividedRows* divided = nullptr);

  /// Means of a field over the components, from its integrals against the functions. Components
  /// without area have mean 0.
  MultiVector OfIntegrals(const MultiVector& load) const;

  /// Means of a function over the components, from its coefficients.
  MultiVector OfFunction(const MultiVector& coefficients) const;

  /// coefficients += the constants `mean`, but on components without area.
  void AddConstants(const MultiVector& mean, MultiVector& coefficients) const;

  /// load -= the integrals of the constants `mean`.
  void SubtractIntegrals(const MultiVector& mean, MultiVector& load) const;

  /// ∫ (mean - mean of all)² over the surface, per column.
  Columns SquaredSpread(const MultiVector& mean) const;

private:
  template<class Weight>
  MultiVector WeightedMeans(const MultiVector& x, Weight&& weight) const;
  template<class Weight>
  void AddWeighted(const MultiVector& mean, MultiVector& x, Weight&& weight) const;

  const std::vector<Index>& component_;
  const std::vector<double>& integral_;
  std::vector<double> area_;
  int threads_;
  const DividedRows* divided_;
};

} // namespace gridfem

#endif
