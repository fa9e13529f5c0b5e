#include "Input/CarriedModes.h"

#include "Input/ModeCheck.h"
#include "Input/ModeReader.h"
#include "Pieces/CanDistribute.h"
#include "Pipeline/InputSurface.h"

#include "vtkPolyData.h"

#include <utility>

namespace gridfem
{

GivenModes CarriedModes::Update(InputSurface& surface, vtkPolyData* input)
{
  const bool isAsked = !surface.IsShared() || HasPolygons(input);
  if (surface.Any(isAsked && !CarriesModes(input)))
  {
    *this = {};
    return {};
  }
  StageKey key;
  key.Add(surface.IsShared()).Add(surface.JoinsSeams());
  if (isAsked)
  {
    AddMesh(key, input);
    AddModeArrays(key, input);
  }
  if (!surface.Any(!given_ || given_.version != key))
  {
    return given_;
  }
  if (!surface.Any(misfit_.empty() || ghostKey_ != key))
  {
    return {};
  }
  *this = {};
  auto modes = std::make_shared<PointModes>(this->Read(surface, input));
  misfit_ = FindMisfit(*mesh_.triangles, *modes, surface.Threads(), surface.SumsOverProcesses());
  if (misfit_.empty())
  {
    given_ = { mesh_.triangles, std::move(modes), key };
  }
  else
  {
    ghostKey_ = key;
  }
  return given_;
}

PointModes CarriedModes::Read(InputSurface& surface, vtkPolyData* input)
{
  mesh_ = surface.ReadTriangles();
  PointModes modes;
  surface.Together(
    [&]
    {
      if (HasPolygons(input))
      {
        modes = ReadModes(input, surface.WithCopies(mesh_));
      }
    });
  if (surface.IsShared())
  {
    surface.Agree(modes.eigenvalues);
    modes.area = surface.Area();
  }
  if (!HasPolygons(input))
  {
    modes.values.setZero(
      static_cast<Id>(mesh_.triangles->points.size()), static_cast<Id>(modes.eigenvalues.size()));
  }
  return modes;
}

std::string CarriedModes::WarningOfShape(const std::string& input) const
{
  return this->AreOfAnotherShape()
           ? "The modes of the " + input + " belong to another shape: " + misfit_ +
               ". The filter computes new modes."
           : std::string();
}

void CarriedModes::RemoveMisfit(vtkPolyData* output) const
{
  if (this->AreOfAnotherShape())
  {
    RemoveModes(output);
  }
}

} // namespace gridfem
