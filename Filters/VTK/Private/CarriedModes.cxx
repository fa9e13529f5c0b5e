#include "CarriedModes.h"

#include "CanDistribute.h"
#include "ClippedArrays.h"
#include "ModeCheck.h"
#include "ModeReader.h"
#include "SurfaceSolverState.h"

#include "vtkPolyData.h"

#include <utility>

namespace gridfem
{
GivenModes CarriedModes::Update(SurfaceSolverState& state, vtkPolyData* input)
{
  const bool isAsked = !state.IsShared() || HasPolygons(input);
  if (state.Any(isAsked && !CarriesModes(input)))
  {
    *this = {};
    return {};
  }
  StageKey key;
  key.Add(state.IsShared());
  if (isAsked)
  {
    AddMesh(key, input);
    AddModeArrays(key, input);
  }
  if (!state.Any(!given_ || given_.version != key))
  {
    return given_;
  }
  if (!state.Any(misfit_.empty() || foreignKey_ != key))
  {
    return {};
  }
  *this = {};
  auto modes = std::make_shared<PointModes>(
    state.IsShared() ? this->ReadTogether(state, input) : this->Read(state, input));
  misfit_ = FindMisfit(*mesh_.triangles, *modes, state.Threads(), state.SumsOverProcesses());
  if (misfit_.empty())
  {
    given_ = { mesh_.triangles, std::move(modes), key };
  }
  else
  {
    foreignKey_ = key;
  }
  return given_;
}

PointModes CarriedModes::Read(SurfaceSolverState& state, vtkPolyData* input)
{
  mesh_ = state.ReadMeshOf(input, {});
  RequireSurface(*mesh_.triangles);
  return ReadModes(input, mesh_);
}

PointModes CarriedModes::ReadTogether(SurfaceSolverState& state, vtkPolyData* piece)
{
  DistributedSurface& together = state.together;
  mesh_ = together.ReadPieces(piece, !state.Any(piece && CarriesBasis(piece)), state.Threads());
  PointModes modes;
  state.Together(
    [&]
    {
      if (HasPolygons(piece))
      {
        modes = ReadModes(piece, together.WithCopies(mesh_));
      }
    });
  together.Agree(modes.eigenvalues);
  modes.area = together.Area();
  if (!HasPolygons(piece))
  {
    modes.values.setZero(
      static_cast<Id>(mesh_.triangles->points.size()), static_cast<Id>(modes.eigenvalues.size()));
  }
  return modes;
}

} // namespace gridfem
