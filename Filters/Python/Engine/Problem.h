// The problems that Python can request. Each has the properties, the defaults and the arrays of the
// filter of its name.
#ifndef GridFEM_Problem_h
#define GridFEM_Problem_h

#include "Given.h"

#include "Base/Progress.h"

namespace gridfem
{

struct Results
{
  std::map<std::string, MultiVector> arrays; // by the names that the filter gives them
  std::vector<std::string> warnings;

  /// An empty text is no warning.
  void Warn(const std::string& text)
  {
    if (!text.empty())
    {
      warnings.push_back(text);
    }
  }

  void Warn(const std::vector<std::string>& texts)
  {
    for (const std::string& text : texts)
    {
      this->Warn(text);
    }
  }
};

/// Returns ids as a column of numbers.
inline MultiVector ColumnOf(const std::vector<Id>& ids)
{
  return Eigen::Map<const Eigen::Matrix<Id, Eigen::Dynamic, 1>>(
    ids.data(), static_cast<Eigen::Index>(ids.size()))
    .cast<double>();
}

class Problem
{
public:
  virtual ~Problem() = default;

  /// Solves the problem. Throws InvalidInput for unusable input, and Aborted.
  virtual Results Solve(const Given& given, const Progress& progress) const = 0;
};

/// Takes the properties that the problem has. Throws InvalidInput for one that is out of range.
using MakeProblem = std::unique_ptr<Problem> (*)(Properties& properties);

std::unique_ptr<Problem> MakeCurvatures(Properties& properties);
std::unique_ptr<Problem> MakeDetail(Properties& properties);
std::unique_ptr<Problem> MakeDiffusion(Properties& properties);
std::unique_ptr<Problem> MakeDistance(Properties& properties);
std::unique_ptr<Problem> MakeDynamics(Properties& properties);
std::unique_ptr<Problem> MakeFarthestPoints(Properties& properties);
std::unique_ptr<Problem> MakeFlow(Properties& properties);
std::unique_ptr<Problem> MakeGaussianField(Properties& properties);
std::unique_ptr<Problem> MakeGradient(Properties& properties);
std::unique_ptr<Problem> MakeInterpolation(Properties& properties);
std::unique_ptr<Problem> MakeParameterization(Properties& properties);
std::unique_ptr<Problem> MakePath(Properties& properties);
std::unique_ptr<Problem> MakePoisson(Properties& properties);
std::unique_ptr<Problem> MakeSignatures(Properties& properties);
std::unique_ptr<Problem> MakeSpectrum(Properties& properties);
std::unique_ptr<Problem> MakeStitching(Properties& properties);

} // namespace gridfem

#endif
