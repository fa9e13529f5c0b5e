#include "Equations/Reactions.h"

#include <algorithm>
#include <cmath>

namespace gridfem
{
namespace
{

/// Rises smoothly from 0 to 1 around 0.
double SmoothStep(double x, double width)
{
  const double t = std::clamp(0.5 + x / width, 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

/// The state of rest of FitzHughNagumo(), by Newton's method.
std::vector<double> RestOfFitzHughNagumo(double beta, double gamma)
{
  double u = -1.0;
  for (int k = 0; k < 20; ++k)
  {
    const double value = u - u * u * u / 3.0 - (u + beta) / gamma;
    u -= value / (1.0 - u * u - 1.0 / gamma);
  }
  return { u, (u + beta) / gamma };
}

} // namespace

ReactionSystem SpotsOfTuring()
{
  constexpr double A = 0.1;
  constexpr double B = 0.9;
  ReactionSystem system;
  system.diffusion = { 1.0, 40.0 };
  system.patternLength = 12.1; // measured on a plane; 2π/√0.3875 = 10.1 grows fastest
  system.step = 0.2;
  system.frame = 1.2;
  system.rest = { A + B, B / ((A + B) * (A + B)) };
  system.react = AtEachPlace<2>(
    [](const double* u, double* rates)
    {
      const double made = u[0] * u[0] * u[1];
      rates[0] = A - u[0] + made;
      rates[1] = B - made;
    });
  system.startOfNoise = [rest = system.rest](const double* normal, double* u)
  {
    u[0] = rest[0] + 0.3 * std::clamp(normal[0], -3.0, 3.0);
    u[1] = rest[1];
  };
  system.startOfDisturbance = [rest = system.rest](double amount, double* u)
  {
    u[0] = rest[0] + amount;
    u[1] = rest[1];
  };
  return system;
}

ReactionSystem GrayScott(double feed, double kill)
{
  ReactionSystem system;
  system.diffusion = { 1.0, 0.5 };
  system.patternLength = 31.0; // measured on a plane
  system.step = 2.0;
  system.frame = 40.0;
  system.functions = 12.0;
  system.rest = { 1.0, 0.0 };
  system.react = AtEachPlace<2>(
    [feed, kill](const double* u, double* rates)
    {
      const double made = u[0] * u[1] * u[1];
      rates[0] = feed * (1.0 - u[0]) - made;
      rates[1] = made - (feed + kill) * u[1];
    });
  system.startOfDisturbance = [](double amount, double* u)
  {
    u[0] = 1.0 - 0.5 * amount;
    u[1] = 0.3 * amount;
  };
  system.startOfNoise = [disturb = system.startOfDisturbance](const double* normal, double* u)
  { disturb(SmoothStep(normal[0] - 1.0, 0.8), u); };
  return system;
}

ReactionSystem FitzHughNagumo()
{
  constexpr double Slowness = 0.08;
  constexpr double Beta = 0.7;
  constexpr double Gamma = 0.5;
  ReactionSystem system;
  system.diffusion = { 1.0, 0.0 };
  system.patternLength = 30.0; // measured on a plane: between the arms of a spiral
  system.step = 0.25;
  system.frame = 5.0;
  system.functions = 12.0;
  system.noiseLength = 4.0;
  system.rest = RestOfFitzHughNagumo(Beta, Gamma);
  system.react = AtEachPlace<2>(
    [](const double* u, double* rates)
    {
      rates[0] = u[0] - u[0] * u[0] * u[0] / 3.0 - u[1];
      rates[1] = Slowness * (u[0] + Beta - Gamma * u[1]);
    });
  // Waves break where the edge of an excited region meets the edge of a region that recovers.
  system.startOfNoise = [rest = system.rest](const double* normal, double* u)
  {
    u[0] = rest[0] + 2.5 * SmoothStep(normal[0], 0.2);
    u[1] = rest[1] + 1.3 * SmoothStep(normal[1], 0.2);
  };
  system.startOfDisturbance = [rest = system.rest](double amount, double* u)
  {
    u[0] = rest[0] + 2.5 * amount;
    u[1] = rest[1];
  };
  return system;
}

ReactionSystem AllenCahn()
{
  ReactionSystem system;
  system.diffusion = { 1.0 };
  system.patternLength = 2.0 * double(EIGEN_PI); // shorter waves fade
  system.step = 0.2;
  system.frame = 0.4;
  system.rest = { -1.0 };
  system.react =
    AtEachPlace<1>([](const double* u, double* rates) { rates[0] = u[0] - u[0] * u[0] * u[0]; });
  system.startOfNoise = [](const double* normal, double* u)
  { u[0] = 0.5 * std::clamp(normal[0], -2.0, 2.0); };
  system.startOfDisturbance = [](double amount, double* u) { u[0] = 2.0 * amount - 1.0; };
  return system;
}

double FastestResponse(
  const ReactionRates& react, const std::vector<double>& low, const std::vector<double>& high)
{
  constexpr Id Steps = 16; // from low to high
  const Id species = static_cast<Id>(low.size());
  Id places = 1;
  std::vector<double> size;
  std::vector<double> step;
  for (Id s = 0; s < species; ++s)
  {
    const double largest = std::max(std::abs(low[s]), std::abs(high[s]));
    size.push_back(largest > 0.0 ? largest : 1.0);
    step.push_back(std::max(high[s] - low[s], 1e-3 * size[s]) / Steps);
    places *= Steps + 1;
  }
  std::vector<double> u(static_cast<std::size_t>(places * species));
  for (Id place = 0; place < places; ++place)
  {
    for (Id s = 0, stride = 1; s < species; ++s, stride *= Steps + 1)
    {
      u[place * species + s] = low[s] + double(place / stride % (Steps + 1)) * step[s];
    }
  }
  std::vector<double> rates(u.size());
  react(u.data(), rates.data(), places);

  double fastest = 0.0;
  for (Id place = 0; place < places; ++place)
  {
    for (Id row = 0; row < species; ++row)
    {
      double sum = 0.0;
      for (Id s = 0, stride = 1; s < species; ++s, stride *= Steps + 1)
      {
        const Id other = place / stride % (Steps + 1) < Steps ? place + stride : place - stride;
        const double change = rates[other * species + row] - rates[place * species + row];
        sum += std::abs(change) / step[s] * size[s] / size[row];
      }
      fastest = std::isfinite(sum) ? std::max(fastest, sum) : fastest;
    }
  }
  return fastest;
}

} // namespace gridfem
