// Finds the place on a reference surface that corresponds to each point of a surface, from the
// modes of both.
// Functional maps: Ovsjanikov, Ben-Chen, Solomon, Butscher, Guibas 2012. Refinement by more and
// more modes: Melzi, Ren, Rodolà, Sharma, Wonka, Ovsjanikov 2019.
#ifndef GridFEM_FunctionalMap_h
#define GridFEM_FunctionalMap_h

#include "Spectrum/SpectralDescriptors.h"

#include <array>
#include <vector>

namespace gridfem
{

/// One of the two surfaces of a map.
struct ModesOfShape
{
  const TriangleMesh& mesh;
  const PointModes& modes;            // with one constant mode
  const std::vector<char>& isReached; // per point: the modes have a value
};

/// A point of the surface, and the point of the reference that corresponds to it.
using Landmark = std::array<Id, 2>;

/// The fewest modes that a map takes.
constexpr int FewestModesOfMap = 10;

/// A function on the reference with the shares a of its modes corresponds to the function on the
/// surface with the shares `matrix` a. Both surfaces count as scaled to area 1.
struct FunctionalMap
{
  MultiVector matrix; // modes × modes
  ///@{ Rows are the points of the surface. Points that modes do not reach have -1 and NaN.
  std::vector<std::array<Id, 3>> corners; // points of the reference
  MultiVector weights;                    // of the corners, with the sum 1
  MultiVector places;                     // on the reference, L
  std::vector<double> mismatch;           // of the modes at the point and at its place: see below
  ///@}
  double meanMismatch = 0.0; // root of the mean square
  bool isAmbiguous = false;  // another map is about as good, and differs
};

/// Finds the map. Its first modes begin with all signs, in the order of the eigenvalues, and with
/// orders where close eigenvalues change places. With landmarks, a map that takes each landmark to
/// its partner is tried, too. Each start is refined with more and more modes: points go to their
/// nearest places in the space of the modes, and these places give the matrix of more modes. The
/// best map wins. Maps that mirror the surface lose, unless landmarks decide.
///
/// The mismatch at a point x with the place y is |φ(x) - matrix ψ(y)| / √k. Here φ are the k modes
/// of the surface, and ψ the modes of the reference. All have the mean square 1. Isometric surfaces
/// have the mismatch 0, and unrelated ones about 1.
/// @param landmarks  points that modes reach. Up to forty modes they only choose between maps. From
///   then on, all of them together count like a tenth of the points of a fit.
/// Throws InvalidInput if a surface has fewer than FewestModesOfMap modes, and Aborted. Same bits
/// for any number of threads.
FunctionalMap FindFunctionalMap(const ModesOfShape& surface, const ModesOfShape& reference,
  const std::vector<Landmark>& landmarks, const Job& job = {});

} // namespace gridfem

#endif
