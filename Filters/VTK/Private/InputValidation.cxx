#include "InputValidation.h"

#include "Base/Errors.h"
#include "Problems/MemoryEstimate.h"
#include "Problems/Spectrum.h"

#include "vtkDataSet.h"
#include "vtkGenericCell.h"
#include "vtkNew.h"
#include "vtkPolyData.h"

#include <cmath>
#include <iomanip>
#include <sstream>
#include <string>

namespace gridfem
{
namespace
{

/// Throws when a job needs more memory than there is; unknown memory is taken as enough.
void RequireBytes(double bytes, const std::string& subject, const std::string& advice)
{
  constexpr double GB = 1e9;
  const double available = AvailableMemory();
  if (available > 0.0 && bytes > available)
  {
    std::ostringstream message;
    message << std::setprecision(3) << subject << " needs about " << bytes / GB
            << " GB of memory, but only " << available / GB << " GB are free. " << advice;
    throw InvalidInput(message.str());
  }
}

/// Of all that a filter makes on the grid.
double BytesOf(const TriangleMesh& mesh, const MemoryEstimate& grid, bool hatFunctions)
{
  return grid.bytes + (hatFunctions ? EstimateHatMemory(mesh, grid.functions) : 0.0);
}

} // namespace

bool IsEmpty(vtkDataSet* input)
{
  return !input || input->GetNumberOfPoints() == 0;
}

void RequireNumber(const char* property, double value)
{
  if (std::isnan(value))
  {
    throw InvalidInput(std::string(property) + " is not a number.");
  }
}

void RequireAtLeast(const char* property, double value, double least)
{
  if (!std::isfinite(value) || value < least)
  {
    std::ostringstream message;
    message << property << " is " << value << "; it must be " << least << " or more.";
    throw InvalidInput(message.str());
  }
}

void RequireNoVolume(vtkDataSet* piece)
{
  if (!piece || vtkPolyData::SafeDownCast(piece) || piece->GetNumberOfCells() == 0)
  {
    return;
  }
  vtkNew<vtkGenericCell> cell;
  for (vtkIdType k = 0; k < piece->GetNumberOfCells(); ++k)
  {
    if (piece->GetCellType(k) == cell->GetCellType())
    {
      continue; // as the last one, which is no volume
    }
    cell->SetCellType(piece->GetCellType(k));
    if (cell->GetCellDimension() == 3)
    {
      throw InvalidInput(
        "The input is a volume mesh in pieces on several ranks, where the faces "
        "between pieces would count as surface. Ghost Cells and Extract Surface in "
        "front of this filter leave them out.");
    }
  }
}

bool FitsMemory(const TriangleMesh& mesh, int depth, bool hatFunctions)
{
  const double available = AvailableMemory();
  return available <= 0.0 || BytesOf(mesh, EstimateMemory(mesh, depth), hatFunctions) <= available;
}

void RequireMemory(const TriangleMesh& mesh, int depth, bool hatFunctions)
{
  const MemoryEstimate estimate = EstimateMemory(mesh, depth);
  std::ostringstream subject;
  subject << "Depth " << depth << " (about " << std::setprecision(3) << estimate.functions
          << " basis functions)";
  if (hatFunctions)
  {
    subject << " with the hat functions of " << mesh.points.size() << " points";
  }
  RequireBytes(BytesOf(mesh, estimate, hatFunctions), subject.str(),
    "Every step down in Depth takes a quarter of the memory.");
}

void RequireMemoryForHats(const TriangleMesh& mesh, Id functions)
{
  RequireBytes(EstimateHatMemory(mesh, static_cast<double>(functions)),
    "Hat functions on " + std::to_string(mesh.points.size()) + " points",
    "Choose the functions of the grid, or fewer points.");
}

void RequireMemoryForModes(Id functions, Id modes, int threads)
{
  RequireBytes(EstimateSpectrumMemory(functions, modes, threads),
    "NumberOfModes " + std::to_string(modes) + " with " + std::to_string(functions) +
      " basis functions",
    "Choose fewer modes or a smaller Depth.");
}

} // namespace gridfem
