// Tests patches, functions and nested levels, plain and connectivity-aware.
#include "Grid/GridFunctions.h"

#include "Base/Errors.h"
#include "Support/Meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

GridFunctions SpaceOf(
  const TriangleMesh& mesh, int depth, bool connectivityAware = true, bool weld = true)
{
  SpaceOptions options;
  options.depth = depth;
  options.connectivityAware = connectivityAware;
  options.weldCoincidentPoints = weld;
  return BuildGridFunctions(mesh, options);
}

/// Returns the lattice point of a cell's corner, as a key.
MortonKey CornerKey(MortonKey cell, int corner)
{
  CellIndex index = MortonDecode(cell);
  for (int axis = 0; axis < 3; ++axis)
  {
    index[axis] += corner >> axis & 1;
  }
  return MortonEncode(index);
}

void ExpectSameTables(const GridFunctions& a, const GridFunctions& b)
{
  EXPECT_EQ(a.piecePatch, b.piecePatch);
  EXPECT_EQ(a.pointPatch, b.pointPatch);
  EXPECT_EQ(a.component, b.component);
  ASSERT_EQ(a.levels.size(), b.levels.size());
  for (std::size_t l = 0; l < a.levels.size(); ++l)
  {
    EXPECT_EQ(a.levels[l].cell, b.levels[l].cell);
    EXPECT_EQ(a.levels[l].dof, b.levels[l].dof);
    EXPECT_EQ(a.levels[l].parent, b.levels[l].parent);
    EXPECT_EQ(a.levels[l].numberOfFunctions, b.levels[l].numberOfFunctions);
  }
}

} // namespace

TEST(PatchLevel, SphereOfThesisTable43)
{
  const GridFunctions space = SpaceOf(LatLongSphere(140, 69), 5, false);
  EXPECT_EQ(space.Finest().NumberOfPatches(), 4760);
  EXPECT_EQ(space.Finest().numberOfFunctions, 9532);
}

// Thesis Table 4.3 lists 3,226 functions for the rocker arm at depth 5.
TEST(PatchLevel, RockerArmOfThesisTable43)
{
  const std::string path = RealMesh("rocker_arm.ply");
  if (path.empty())
  {
    GTEST_SKIP() << "The folder of real meshes is not there.";
  }
  const GridFunctions space = SpaceOf(ReadMesh(path), 5, false);
  EXPECT_NEAR(space.Finest().numberOfFunctions, 3226, 0.02 * 3226);
}

TEST(PatchLevel, PlainSpaceHasOneFunctionPerGridCorner)
{
  const GridFunctions space = SpaceOf(TrefoilTube(120, 12, 0.4), 5, false);
  for (const PatchLevel& level : space.levels)
  {
    std::map<MortonKey, std::set<Index>> functions;
    for (Id patch = 0; patch < level.NumberOfPatches(); ++patch)
    {
      for (int corner = 0; corner < FunctionsPerPatch; ++corner)
      {
        functions[CornerKey(level.cell[patch], corner)].insert(level.dof[patch][corner]);
      }
    }
    EXPECT_EQ(static_cast<Index>(functions.size()), level.numberOfFunctions);
    for (const auto& [corner, numbers] : functions)
    {
      EXPECT_EQ(numbers.size(), 1u);
    }
  }
}

// Computes the definition in another way. For every grid corner, repeated sweeps over the links
// find the connected components of the patches around it.
TEST(PatchLevel, FunctionsAreTheComponentsOfTheirSupport)
{
  for (const TriangleMesh& mesh :
    { TrefoilTube(200, 16, 0.5), TwoSheets(6, 0.02), CubeArray(2, 2, 0.1) })
  {
    ClipOptions options;
    options.depth = 4;
    const ClippedMesh clipped = Clip(mesh, options);
    const PatchPartition patches = BuildPatches(clipped, FunctionSupport::ConnectivityAware);
    const PatchLevel level = BuildFinestLevel(4, patches, FunctionSupport::ConnectivityAware);
    std::map<MortonKey, std::map<Id, Id>> label; // for each corner: patch -> component label
    std::map<MortonKey, std::map<Id, int>> cornerOf;
    for (Id patch = 0; patch < level.NumberOfPatches(); ++patch)
    {
      for (int corner = 0; corner < FunctionsPerPatch; ++corner)
      {
        label[CornerKey(level.cell[patch], corner)][patch] = patch;
        cornerOf[CornerKey(level.cell[patch], corner)][patch] = corner;
      }
    }
    std::size_t expected = 0;
    for (auto& [corner, labels] : label)
    {
      for (bool changed = true; changed;)
      {
        changed = false;
        for (const Link& link : patches.links)
        {
          const auto a = labels.find(link.first);
          const auto b = labels.find(link.second);
          if (a != labels.end() && b != labels.end() && a->second != b->second)
          {
            a->second = b->second = std::min(a->second, b->second);
            changed = true;
          }
        }
      }
      std::map<Id, std::set<Index>> functions;
      for (const auto& [patch, component] : labels)
      {
        functions[component].insert(level.dof[patch][cornerOf[corner][patch]]);
      }
      for (const auto& [component, numbers] : functions)
      {
        ASSERT_EQ(numbers.size(), 1u);
      }
      expected += functions.size();
    }
    EXPECT_EQ(static_cast<std::size_t>(level.numberOfFunctions), expected);
  }
}

TEST(PatchLevel, LevelsAreNested)
{
  for (const bool aware : { false, true })
  {
    const GridFunctions space = SpaceOf(TrefoilTube(200, 16, 0.5), 6, aware);
    ASSERT_EQ(space.levels.size(), 7u);
    for (std::size_t l = 0; l + 1 < space.levels.size(); ++l)
    {
      const PatchLevel& fine = space.levels[l];
      const PatchLevel& coarse = space.levels[l + 1];
      ASSERT_EQ(fine.parent.size(), fine.cell.size());
      std::vector<int> children(coarse.cell.size(), 0);
      // Patches that share a function have parents that share every coarse function on which the
      // fine function depends. The row of the prolongation therefore does not depend on the patch.
      // [T (6.1)]
      std::vector<std::map<MortonKey, Index>> row(fine.numberOfFunctions);
      for (Id patch = 0; patch < fine.NumberOfPatches(); ++patch)
      {
        ASSERT_EQ(coarse.cell[fine.parent[patch]], fine.cell[patch] >> 3);
        ++children[fine.parent[patch]];
        const CellIndex cell = MortonDecode(fine.cell[patch]);
        for (int corner = 0; corner < FunctionsPerPatch; ++corner)
        {
          for (int up = 0; up < FunctionsPerPatch; ++up)
          {
            bool depends = true;
            for (int axis = 0; axis < 3; ++axis)
            {
              const int at = (cell[axis] & 1) + (corner >> axis & 1); // 0, 1, 2 half cells
              depends &= at == 1 || at == 2 * (up >> axis & 1);
            }
            if (depends)
            {
              const Index function = coarse.dof[fine.parent[patch]][up];
              const auto [entry, isNew] = row[fine.dof[patch][corner]].insert(
                { CornerKey(coarse.cell[fine.parent[patch]], up), function });
              ASSERT_EQ(entry->second, function);
            }
          }
        }
      }
      EXPECT_EQ(std::count(children.begin(), children.end(), 0), 0);
    }
    EXPECT_EQ(space.levels.back().NumberOfPatches(), 1);
    EXPECT_EQ(space.levels.back().numberOfFunctions, FunctionsPerPatch);
  }
}

TEST(PatchLevel, SheetsThatNearlyTouchAreSplit)
{
  const TriangleMesh sheets = TwoSheets(8, 0.01);
  const GridFunctions plain = SpaceOf(sheets, 4, false);
  const GridFunctions aware = SpaceOf(sheets, 4, true);
  EXPECT_EQ(plain.numberOfComponents, 1);
  EXPECT_EQ(aware.numberOfComponents, 2);
  EXPECT_EQ(aware.levels.back().numberOfFunctions, 2 * FunctionsPerPatch);
  EXPECT_EQ(aware.Finest().numberOfFunctions, 2 * 17 * 17 * 2);
}

// Thesis Fig. 6.5: nothing is split on the finest level, so both spaces have the same functions
// there.
TEST(PatchLevel, SeparatedCubesDifferOnCoarseLevelsOnly)
{
  const TriangleMesh cubes = CubeArray(6, 2, 1.0);
  const GridFunctions plain = SpaceOf(cubes, 5, false);
  const GridFunctions aware = SpaceOf(cubes, 5, true);
  EXPECT_EQ(plain.Finest().cell, aware.Finest().cell);
  EXPECT_EQ(plain.Finest().dof, aware.Finest().dof);
  EXPECT_EQ(aware.numberOfComponents, 216);
  EXPECT_GT(aware.levels[2].numberOfFunctions, plain.levels[2].numberOfFunctions);
}

TEST(PatchLevel, SubdivisionInThePlaneChangesNothing)
{
  for (const TriangleMesh& mesh : { Box(3), LatLongSphere(40, 21), TrefoilTube(120, 12, 0.4),
         Transform(Box(4), { 0, 0, 1 }, std::acos(-1.0) / 4) })
  {
    for (const bool aware : { false, true })
    {
      const GridFunctions once = SpaceOf(mesh, 5, aware);
      const GridFunctions twice = SpaceOf(SubdivideInPlane(mesh), 5, aware);
      EXPECT_EQ(once.Finest().cell, twice.Finest().cell);
      EXPECT_EQ(once.Finest().numberOfFunctions, twice.Finest().numberOfFunctions);
    }
  }
}

TEST(PatchLevel, SoupGivesTheFunctionsOfItsWeldedMesh)
{
  const TriangleMesh mesh = TrefoilTube(120, 12, 0.4);
  const GridFunctions welded = SpaceOf(mesh, 5);
  const GridFunctions soup = SpaceOf(Unweld(mesh), 5);
  EXPECT_EQ(welded.Finest().dof, soup.Finest().dof);
  EXPECT_EQ(SpaceOf(Unweld(mesh), 5, true, false).numberOfComponents,
    static_cast<Index>(mesh.triangles.size()));
}

TEST(PatchLevel, EveryUsedPointHasAPatchThatContainsIt)
{
  TriangleMesh mesh = LatLongSphere(40, 21);
  mesh.points.push_back({ 9, 9, 9 }); // no triangle uses it
  const GridFunctions space = SpaceOf(mesh, 5);
  EXPECT_EQ(space.pointPatch.back(), -1);
  for (std::size_t point = 0; point + 1 < mesh.points.size(); ++point)
  {
    ASSERT_GE(space.pointPatch[point], 0);
    const CellIndex cell = MortonDecode(space.Finest().cell[space.pointPatch[point]]);
    for (int axis = 0; axis < 3; ++axis)
    {
      const double local = space.clipped.position[point][axis] - cell[axis];
      EXPECT_GE(local, -1e-9);
      EXPECT_LE(local, 1.0 + 1e-9);
    }
  }
}

TEST(PatchLevel, TablesAloneGiveTheSameSpace)
{
  for (const TriangleMesh& mesh :
    { TrefoilTube(200, 16, 0.5), Unweld(LatLongSphere(40, 21)), TwoSheets(6, 0.02) })
  {
    for (const bool aware : { false, true })
    {
      const GridFunctions live = SpaceOf(mesh, 5, aware);
      ClippedMesh clipped = live.clipped;
      clipped.links = FindLinks(clipped, WeldCoincidentPoints(mesh.points));
      PatchLevel finest;
      finest.cell = live.Finest().cell;
      finest.dof = live.Finest().dof;
      finest.numberOfFunctions = live.Finest().numberOfFunctions;
      const GridFunctions restored =
        RestoreGridFunctions(std::move(clipped), live.piecePatch, finest, live.support);
      ExpectSameTables(live, restored);
    }
  }
}

TEST(PatchLevel, RefusesTablesThatDoNotFit)
{
  const GridFunctions live = SpaceOf(Box(2), 3);
  PatchLevel finest = live.Finest();
  finest.dof[3][2] = finest.numberOfFunctions;
  EXPECT_THROW(
    RestoreGridFunctions(live.clipped, live.piecePatch, finest, live.support), InvalidInput);
  Array<Index> piecePatch = live.piecePatch;
  piecePatch[0] = live.Finest().NumberOfPatches();
  EXPECT_THROW(
    RestoreGridFunctions(live.clipped, piecePatch, live.Finest(), live.support), InvalidInput);
  piecePatch.pop_back();
  EXPECT_THROW(
    RestoreGridFunctions(live.clipped, piecePatch, live.Finest(), live.support), InvalidInput);
}

/// Expects a refusal of the changed level that has these words.
void ExpectRefused(const GridFunctions& live, const PatchLevel& finest, const std::string& words)
{
  try
  {
    ClippedMesh clipped = live.clipped;
    clipped.links = FindLinks(clipped, {});
    RestoreGridFunctions(std::move(clipped), live.piecePatch, finest, live.support);
    ADD_FAILURE() << "accepted, although: " << words;
  }
  catch (const InvalidInput& error)
  {
    EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
  }
}

// Every number is in range. Levels from such tables would be solved, and converge.
TEST(PatchLevel, RefusesFunctionsThatAreElsewhere)
{
  for (const bool aware : { false, true })
  {
    const GridFunctions live = SpaceOf(GeodesicSphere(6), 4, aware);
    PatchLevel twice = live.Finest();
    twice.dof[5][2] = twice.dof[5][3];
    ExpectRefused(live, twice, "has function");
    PatchLevel elsewhere = live.Finest();
    elsewhere.dof[0][0] = elsewhere.dof.back()[0];
    ExpectRefused(live, elsewhere, "another corner of the grid");
    PatchLevel torn = live.Finest();
    torn.dof[9][4] = torn.numberOfFunctions++;
    ExpectRefused(live, torn, aware ? "share an edge" : "Two functions belong to one corner");
    PatchLevel more = live.Finest();
    ++more.numberOfFunctions;
    ExpectRefused(live, more, "No patch has function");
  }
}

TEST(PatchLevel, RefusesPatchesThatTearTheSurface)
{
  GridFunctions live = SpaceOf(Transform(TwoSheets(6, 0.02), { 1, 2, 3 }, 0.4), 4);
  const PatchLevel& finest = live.Finest();
  Index piece = 0; // one whose cell has a patch of the other sheet
  const auto isInCellOf = [&](Index patch)
  {
    const Index own = live.piecePatch[piece];
    return patch != own && patch >= 0 && patch < finest.NumberOfPatches() &&
           finest.cell[patch] == finest.cell[own];
  };
  while (!isInCellOf(live.piecePatch[piece] + 1))
  {
    ++piece;
    ASSERT_LT(piece, live.clipped.NumberOfPieces());
  }
  ++live.piecePatch[piece];
  ExpectRefused(live, finest, "share an edge");
}

// A corner that reaches 1e-6 of a cell into the next cell makes a sliver there. The sliver must not
// create functions.
TEST(PatchLevel, SliversJoinTheirNeighbors)
{
  TriangleMesh mesh;
  mesh.points = { { 0, 0, 0.1 }, { 1, 0, 0.1 }, { 0.5, 0.5 + 2.5e-7, 0.1 } };
  mesh.triangles = { { 0, 1, 2 } };
  ClipOptions options;
  options.depth = 2;
  const ClippedMesh clipped = Clip(mesh, options);
  const GridFunctions space = SpaceOf(mesh, 2);
  EXPECT_GT(static_cast<Id>(clipped.cells.size()), space.Finest().NumberOfPatches());
  std::vector<double> area(space.Finest().NumberOfPatches(), 0.0);
  for (Id piece = 0; piece < space.clipped.NumberOfPieces(); ++piece)
  {
    area[space.piecePatch[piece]] += PieceArea(space.clipped, piece);
  }
  EXPECT_GE(*std::min_element(area.begin(), area.end()), 1e-10);
}
