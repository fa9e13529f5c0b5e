#include "InputValidation.h"

#include "Errors.h"
#include "MemoryEstimate.h"

#include "vtkMultiProcessController.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <iomanip>
#include <sstream>

namespace gridfem
{

bool IsEmpty(vtkPolyData* input)
{
  return !input || input->GetNumberOfPoints() == 0;
}

void RequireSingleProcess()
{
  vtkMultiProcessController* controller = vtkMultiProcessController::GetGlobalController();
  if (controller && controller->GetNumberOfProcesses() > 1)
  {
    throw InvalidInput("This filter solves on the whole surface and cannot yet run on " +
                       std::to_string(controller->GetNumberOfProcesses()) +
                       " MPI ranks. Run it with one rank, which uses all processors.");
  }
}

void RequireSurface(const TriangleMesh& mesh)
{
  Validate(mesh);
  const auto& first = mesh.points[mesh.triangles.front()[0]];
  Vec3 low = first;
  Vec3 high = first;
  for (const auto& triangle : mesh.triangles)
  {
    for (const Id point : triangle)
    {
      low = low.cwiseMin(mesh.points[point]);
      high = high.cwiseMax(mesh.points[point]);
    }
  }
  // Rounding gives points on a line an area of about 1e-16 squared lengths.
  if (!(SurfaceArea(mesh) > 1e-14 * (high - low).squaredNorm()))
  {
    throw InvalidInput("The surface has no area: all polygons are degenerate.");
  }
}

void RequireMemory(const TriangleMesh& mesh, int depth)
{
  const double available = AvailableMemory();
  const MemoryEstimate estimate = EstimateMemory(mesh, depth);
  if (available <= 0.0 || estimate.bytes <= available)
  {
    return;
  }
  constexpr double GB = 1e9;
  std::ostringstream message;
  message << "Depth " << depth << " needs about " << std::setprecision(3) << estimate.bytes / GB
          << " GB of memory (about " << estimate.functions << " basis functions), but only "
          << available / GB << " GB are free. Every step down in Depth takes a quarter of the "
          << "memory.";
  throw InvalidInput(message.str());
}

} // namespace gridfem
