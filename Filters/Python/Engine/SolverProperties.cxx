#include "SolverProperties.h"

#include "Integrals/QuadratureRule.h"

#include <limits>

namespace gridfem
{

void TakeProperty::operator()(EquationOptions& equation) const
{
  const bool hasAccuracy = equation.solve.tolerance == 0.0;
  equation.solve.tolerance =
    properties.Number("Tolerance", equation.solve.tolerance, hasAccuracy ? 0.0 : 1e-16, 0.999);
  if (hasAccuracy)
  {
    const double wanted = properties.Number("Accuracy", equation.accuracy, 1e-6, 1.0);
    equation.accuracy = equation.solve.tolerance == 0.0 ? wanted : 0.0;
  }
  equation.solve.maximumIterations = properties.Integer(
    "MaximumIterations", equation.solve.maximumIterations, 1, std::numeric_limits<int>::max());
  equation.multigrid.device = static_cast<DeviceChoice>(
    properties.Integer("Device", static_cast<int>(equation.multigrid.device), 0, 2));
}

void TakeSurfaceOptions(Properties& properties, SurfaceOptions& options, double leastStabilization)
{
  constexpr int Largest = std::numeric_limits<int>::max();
  const int depth = properties.Integer("Depth", options.space.depth, 0, MaximumDepth);
  options.space.depth = depth == 1 ? 2 : depth; // as the filters do, whose sliders pass 1
  options.space.connectivityAware =
    properties.Switch("ConnectivityAware", options.space.connectivityAware);
  options.space.weldCoincidentPoints =
    properties.Switch("WeldCoincidentPoints", options.space.weldCoincidentPoints);
  options.space.threads = properties.Integer("NumberOfThreads", options.space.threads, 0, 1024);
  options.choice.kind = static_cast<FunctionKind>(
    properties.Integer("FunctionSpace", static_cast<int>(options.choice.kind), 0, 2));
  options.choice.quadratureDegree =
    properties.Integer("QuadratureDegree", options.choice.quadratureDegree, -Largest, Largest);
  TriangleRule(options.choice.quadratureDegree); // refuses a wrong degree before the long work
  options.choice.normalStabilization = properties.Number(
    "NormalStabilization", options.choice.normalStabilization, leastStabilization, 1.0);
  options.parameterUnits = static_cast<ParameterUnits>(
    properties.Integer("ParameterUnits", static_cast<int>(options.parameterUnits), 0, 2));
}

} // namespace gridfem
