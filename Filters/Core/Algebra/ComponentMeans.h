// Means of functions over the connected components of a surface, and the constant functions with
// these means.
#ifndef GridFEM_ComponentMeans_h
#define GridFEM_ComponentMeans_h

#include "Algebra/ColumnAlgebra.h"
#include "Algebra/DistributedRows.h"
#include "Base/Types.h"

#include <vector>

namespace gridfem
{

/// Blocks have one row per function and any number of columns; means have one row per component.
/// Same bits for any number of threads. Keeps references to the constructor's arguments. Collective
/// if the rows are distributed (see DistributedRows); the means cover the whole surface.
class ComponentMeans
{
public:
  /// @param component  the component of each function, 0 .. numberOfComponents - 1
  /// @param integral   ∫ b_i of each function
  /// @param distributed    null: this process holds all functions
  ComponentMeans(const std::vector<Index>& component, const std::vector<double>& integral,
    Index numberOfComponents, int threads, const DistributedRows* distributed = nullptr);

  /// Means of a field over the components, computed from its integrals against the functions.
  /// Components without area have mean 0.
  MultiVector OfIntegrals(const MultiVector& load) const;

  /// Means of a function over the components, computed from its coefficients.
  MultiVector OfFunction(const MultiVector& coefficients) const;

  /// Adds the constants `mean` to the coefficients, except on components without area.
  void AddConstants(const MultiVector& mean, MultiVector& coefficients) const;

  /// Subtracts the integrals of the constants `mean` from the load.
  void SubtractIntegrals(const MultiVector& mean, MultiVector& load) const;

  /// Returns ∫ (mean - mean of all)² over the surface, per column.
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
  const DistributedRows* distributed_;
};

} // namespace gridfem

#endif
