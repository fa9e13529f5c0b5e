// Symmetric quadrature rules, stored as orbits under permutations of the three barycentric
// coordinates. Degrees 4, 6, 10 and 12: D. A. Dunavant, High degree efficient symmetrical Gaussian
// quadrature rules for the triangle, IJNME 21 (1985). The numbers solve the moment equations to 18
// digits.
#include "Integrals/QuadratureRule.h"

#include "Base/Errors.h"

#include <algorithm>
#include <string>

namespace gridfem
{
namespace
{

/// All distinct permutations of (a, b, 1 - a - b), each with the same weight.
struct Orbit
{
  double weight;
  double a;
  double b;
};

QuadratureRule MakeRule(int degree, const std::vector<Orbit>& orbits)
{
  QuadratureRule rule{ degree, {} };
  for (const Orbit& orbit : orbits)
  {
    std::array<double, 3> point = { orbit.a, orbit.b, 1.0 - orbit.a - orbit.b };
    std::sort(point.begin(), point.end());
    do
    {
      rule.points.push_back({ point, orbit.weight });
    } while (std::next_permutation(point.begin(), point.end()));
  }
  return rule;
}

QuadratureRule MakeDegree2()
{
  return MakeRule(2, { { 1.0 / 3.0, 1.0 / 6.0, 1.0 / 6.0 } });
}

QuadratureRule MakeDegree4()
{
  return MakeRule(4, {
                       { 0.223381589678011466, 0.445948490915964886, 0.445948490915964886 },
                       { 0.109951743655321868, 0.0915762135097707435, 0.0915762135097707435 },
                     });
}

QuadratureRule MakeDegree6()
{
  return MakeRule(6, {
                       { 0.116786275726379366, 0.249286745170910421, 0.249286745170910421 },
                       { 0.0508449063702068169, 0.0630890144915022283, 0.0630890144915022283 },
                       { 0.0828510756183735752, 0.0531450498448169474, 0.310352451033784405 },
                     });
}

QuadratureRule MakeDegree10()
{
  QuadratureRule rule =
    MakeRule(10, {
                   { 0.0367259577564667047, 0.485577633383657377, 0.485577633383657377 },
                   { 0.0453210594355279348, 0.109481575485037055, 0.109481575485037055 },
                   { 0.0727579168454201086, 0.141707219414879955, 0.30793983876412095 },
                   { 0.0283272425310574848, 0.0250035347626863861, 0.246672560639902694 },
                   { 0.00942166696373282346, 0.00954081540029945758, 0.0668032510122002658 },
                 });
  rule.points.push_back({ { 1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0 }, 0.0908179903827535801 });
  return rule;
}

QuadratureRule MakeDegree12()
{
  return MakeRule(12, {
                        { 0.0257310664404553354, 0.488217389773804883, 0.488217389773804883 },
                        { 0.0436925445380384021, 0.439724392294460273, 0.439724392294460273 },
                        { 0.0628582242178851004, 0.271210385012115922, 0.271210385012115922 },
                        { 0.034796112930708943, 0.127576145541585925, 0.127576145541585925 },
                        { 0.00616626105155901723, 0.0213173504532103702, 0.0213173504532103702 },
                        { 0.0403715577663809295, 0.115343494534697999, 0.275713269685514194 },
                        { 0.0223567732023034457, 0.0228383322222570296, 0.281325580989939548 },
                        { 0.0173162311086588924, 0.0257340505483302282, 0.116251915907597141 },
                      });
}

} // namespace

const QuadratureRule& TriangleRule(int degree)
{
  static const std::array<QuadratureRule, 5> rules = { MakeDegree2(), MakeDegree4(), MakeDegree6(),
    MakeDegree10(), MakeDegree12() };
  for (const QuadratureRule& rule : rules)
  {
    if (rule.degree == degree)
    {
      return rule;
    }
  }
  throw InvalidInput("There is no quadrature rule of degree " + std::to_string(degree) +
                     "; choose 2, 4, 6, 10 or 12.");
}

} // namespace gridfem
