// Systems of reactions whose concentrations form patterns when they also spread.
#ifndef GridFEM_Reactions_h
#define GridFEM_Reactions_h

#include "Base/Types.h"

#include <functional>
#include <vector>

namespace gridfem
{

/// Computes R(u) at several places. Both arrays have one number per species for each place, place
/// by place. Several threads call it at the same time.
using ReactionRates = std::function<void(const double* u, double* rates, Id places)>;

/// Returns reactions that compute one place at a time.
/// @param react  is called with the values and the rates of a place
template<int Species, class React>
ReactionRates AtEachPlace(React react)
{
  return [react](const double* u, double* rates, Id places)
  {
    for (Id place = 0; place < places; ++place)
    {
      react(u + Species * place, rates + Species * place);
    }
  };
}

/// A system du/dt = D Δu + R(u) of one or two species, in units of its own. Functions of one place
/// read and write one number per species.
struct ReactionSystem
{
  std::vector<double> diffusion; // D >= 0 of each species
  double patternLength = 1.0;    // about the distance between two spots, stripes or waves
  double step = 0.0;             // a step that resolves the reactions and is stable
  double frame = 0.0;            // a time in which the pattern changes visibly
  double functions = 6.0;        // functions per pattern length that resolve the fronts
  double noiseLength = 1.0;      // wavelength of the noise at the start, in pattern lengths
  std::vector<double> rest;      // a state without reactions

  ReactionRates react;

  /// The start from two independent normal numbers.
  std::function<void(const double* normal, double* u)> startOfNoise;

  /// The start at rest, disturbed by an amount from 0 to 1.
  std::function<void(double amount, double* u)> startOfDisturbance;

  int Species() const { return static_cast<int>(rest.size()); }
};

/// Schnakenberg's system: u' = D Δu + 0.1 - u + u²v and v' = 40 D Δv + 0.9 - u²v. Spots grow from
/// its unstable state of rest. [Schnakenberg: Simple chemical reaction systems with limit cycle
/// behaviour, 1979; Turing: The chemical basis of morphogenesis, 1952]
ReactionSystem SpotsOfTuring();

/// u' = D Δu - uv² + F (1 - u) and v' = D/2 Δv + uv² - (F + k) v. Spots that divide, stripes or
/// waves, by the feed rate F and the kill rate k. [Pearson: Complex patterns in a simple system,
/// 1993]
ReactionSystem GrayScott(double feed, double kill);

/// u' = D Δu + u - u³/3 - v and v' = 0.08 (u + 0.7 - v/2): waves in an excitable medium, which turn
/// into spirals where they are broken. [FitzHugh 1961; Winfree: Varieties of spiral wave behavior,
/// 1991]
ReactionSystem FitzHughNagumo();

/// u' = D Δu + u - u³: two phases, -1 and 1, and fronts that move by their curvature. [Allen and
/// Cahn: A microscopic theory for antiphase boundary motion, 1979]
ReactionSystem AllenCahn();

/// Returns how fast reactions answer to a change: the largest sum of a row of the matrix ∂R/∂u, in
/// units of the largest value of each species, for values from `low` to `high`. A species that is 0
/// has the unit 1. Places where R is not finite do not count.
double FastestResponse(
  const ReactionRates& react, const std::vector<double>& low, const std::vector<double>& high);

} // namespace gridfem

#endif
