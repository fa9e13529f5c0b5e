// The hybrid hierarchy: hat functions of the mesh above the levels of a grid. [T §4.2, Hat-Basis
// Incorporation]
#ifndef GridFEM_HatMultigrid_h
#define GridFEM_HatMultigrid_h

#include "Spaces/HatMatrices.h"
#include "Spaces/HatTransfer.h"
#include "Spaces/LevelOperators.h"

namespace gridfem
{

struct HatMultigridOptions
{
  MultigridOptions grid;   // of the levels below the hats
  LevelSmoothing hats;     // two sweeps before and after
  bool relaxGroups = true; // groups of hats together after each sweep (before, on the way back)
};

/// Twice as many Gauss-Seidel sweeps on the hats as there are sweeps on the levels of the grid.
HatMultigridOptions HatCycle(const MultigridOptions& grid);

/// What the hybrid hierarchy of one mesh and one grid keeps for any a M + b L.
struct HatHierarchy
{
  HatFunctions functions; // in grid units
  HatMatrices matrices;
  PatchOrder order;          // of the sweeps
  PatchOrder groups;         // of eight hats each; see GroupByCoupling
  SparseMatrix prolongation; // from the finest functions of the grid
};

/// @param mesh  what the space was made from, weldCoincidentPoints as there
/// Throws InvalidInput when no triangle has an area.
HatHierarchy BuildHatHierarchy(const TriangleMesh& mesh, const GridFunctions& space,
  bool weldCoincidentPoints, HatTransfer transfer, int threads = 0, const Progress& progress = {});

/// a M + b L of the hats on top of the grid's levels, ready to cycle. Grid units.
Multigrid BuildHatMultigrid(const HatHierarchy& hats, const GridFunctions& space,
  const LevelOperators& system, double a, double b, const HatMultigridOptions& options,
  const Progress& progress = {});

/// New factors for such a hierarchy.
void UpdateHatMultigrid(const HatHierarchy& hats, const GridFunctions& space,
  const LevelOperators& system, double a, double b, Multigrid& multigrid);

} // namespace gridfem

#endif
