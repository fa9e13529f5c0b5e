// The problems that Python can request. Each has the properties, the defaults and the arrays of the
// filter of its name.
#ifndef GridFEM_Problem_h
#define GridFEM_Problem_h

#include "Given.h"

#include "Base/Progress.h"

#include <functional>

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

/// Returns the corners of triangles as rows of three numbers.
inline MultiVector RowsOf(const std::vector<std::array<Id, 3>>& corners)
{
  MultiVector rows(static_cast<Id>(corners.size()), 3);
  for (Id row = 0; row < rows.rows(); ++row)
  {
    for (int k = 0; k < 3; ++k)
    {
      rows(row, k) = static_cast<double>(corners[row][k]);
    }
  }
  return rows;
}

/// Solves a problem. Throws InvalidInput for unusable input, and Aborted.
using Problem = std::function<Results(const Given& given, const Progress& progress)>;

/// Takes the properties that the problem has. Throws InvalidInput for one that is out of range.
using MakeProblem = Problem (*)(Properties& properties);

extern const MakeProblem MakeCurvatures;
extern const MakeProblem MakeDetail;
extern const MakeProblem MakeDiffusion;
extern const MakeProblem MakeDistance;
extern const MakeProblem MakeDynamics;
extern const MakeProblem MakeFarthestPoints;
extern const MakeProblem MakeFlow;
extern const MakeProblem MakeFunctionalMap;
extern const MakeProblem MakeGaussianField;
extern const MakeProblem MakeGradient;
extern const MakeProblem MakeInterpolation;
extern const MakeProblem MakeParameterization;
extern const MakeProblem MakePath;
extern const MakeProblem MakePoisson;
extern const MakeProblem MakeSignatures;
extern const MakeProblem MakeSpectrum;
extern const MakeProblem MakeStitching;

} // namespace gridfem

#endif
