#include "Spectrum/FunctionalMap.h"

#include "Base/Errors.h"
#include "Base/Parallel.h"
#include "Grid/OrientedMesh.h"
#include "Grid/TriangleArea.h"
#include "Spectrum/MapPlaces.h"
#include "Spectrum/MapStarts.h"
#include "Spectrum/NearestRows.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>

namespace gridfem
{
namespace
{

///@{ The refinements of starts, of the best of them, and of the best.
constexpr RefinementSizes First{ 20, 400, 1000, 0.15 };
constexpr RefinementSizes Second{ 40, 1500, 3000, 0.05 };
constexpr double LastGrowth = 0.05;
///@}

/// The number of maps that the second refinement takes.
constexpr std::size_t Finalists = 8;

/// Maps are the same if their matrices of twenty modes differ by less (Frobenius norm).
constexpr double SameMatrix = 0.5;

/// A map mirrors the surface if the areas of the triangles that it turns over are larger by this
/// share than the areas of the others. Below it, maps do not tell.
constexpr double ClearSide = 0.1;

/// Added to the mismatch of a map that mirrors the surface. Landmarks away from the plane of the
/// mirror outweigh it.
constexpr double Mirrored = 0.05;

///@{ Two maps are about as good if the mismatch of one is less than this factor larger. They differ
/// if places do by more than this length, on surfaces of area 1.
constexpr double AboutAsGood = 1.15;
constexpr double Differs = 0.1;
///@}

/// Rows whose places are found together.
constexpr Id RowsPerBlock = 256;

/// A candidate after the second refinement.
struct Finalist
{
  PartialMap map;
  double score = 0.0;
  double side = 0.0; // 1: it turns no triangle over; -1: it turns all; 0: unknown
};

Index ModesOf(const ModesOfShape& shape)
{
  const auto modes = static_cast<Index>(shape.modes.eigenvalues.size());
  if (modes < FewestModesOfMap)
  {
    throw InvalidInput("A functional map needs at least " + std::to_string(FewestModesOfMap) +
                       " modes of both surfaces; there are " + std::to_string(modes) + ".");
  }
  return modes;
}

RefinementSizes Limited(RefinementSizes sizes, Index modes)
{
  sizes.modes = std::min(sizes.modes, modes);
  return sizes;
}

/// Area vectors around the points of a mesh whose triangles face alike. Empty if they cannot.
std::vector<Vec3> NormalsAt(const TriangleMesh& mesh, const OrientedMesh& oriented)
{
  if (oriented.oneSided > 0)
  {
    return {};
  }
  std::vector<Vec3> normals(mesh.points.size(), Vec3::Zero());
  for (const std::array<Id, 3>& triangle : oriented.TrianglesOf(mesh))
  {
    const Vec3 area = AreaVector(mesh.points, triangle);
    for (const Id corner : triangle)
    {
      normals[corner] += area;
    }
  }
  return normals;
}

class MapSearch
{
public:
  MapSearch(const ModesOfShape& surface, const ModesOfShape& reference,
    const std::vector<Landmark>& landmarks, int threads)
    : ofSurface_(surface), ofReference_(reference), landmarks_(landmarks),
      modes_(std::min(ModesOf(surface), ModesOf(reference))), surface_(surface, modes_),
      reference_(reference, modes_), refinement_(surface_, reference_, landmarks, threads),
      threads_(threads)
  {
  }

  FunctionalMap Find(const Progress& progress)
  {
    const std::vector<Finalist> finalists = this->FindFinalists(progress.Part(0.0, 0.5));
    FunctionalMap found;
    found.isAmbiguous = IsAmbiguous(finalists);
    const RefinementSizes last{ modes_, Second.surfaceRows, Second.referenceRows, LastGrowth };
    PartialMap best =
      refinement_.Refine(finalists.front().map.matrix, last, progress.Part(0.5, 0.8));
    found.matrix = std::move(best.matrix);
    this->FindPlaces(found, progress.Part(0.8, 1.0));
    return found;
  }

private:
  /// Refines all starts, each by one thread, and sorts them by their mismatch.
  std::vector<PartialMap> RefineStarts(const Progress& progress) const
  {
    std::vector<MultiVector> starts = StartsBySigns(surface_, reference_);
    if (!landmarks_.empty())
    {
      starts.push_back(StartByLandmarks(surface_, reference_, landmarks_));
    }
    const MapRefinement alone(surface_, reference_, landmarks_, 1);
    std::vector<PartialMap> maps(starts.size());
    ParallelBlocks(
      static_cast<Id>(starts.size()), threads_,
      [&](Id k)
      {
        maps[k] = alone.Refine(std::move(starts[k]), Limited(First, modes_), {});
        maps[k].meanMismatch += alone.MissedLandmarks(maps[k].matrix);
      },
      progress);
    std::stable_sort(maps.begin(), maps.end(),
      [](const PartialMap& left, const PartialMap& right)
      { return left.meanMismatch < right.meanMismatch; });
    return maps;
  }

  /// Returns the best maps, the best first.
  std::vector<Finalist> FindFinalists(const Progress& progress)
  {
    std::vector<PartialMap> maps;
    for (PartialMap& map : this->RefineStarts(progress.Part(0.0, 0.5)))
    {
      const bool isNew = std::none_of(maps.begin(), maps.end(),
        [&](const PartialMap& other) { return (other.matrix - map.matrix).norm() < SameMatrix; });
      if (isNew && maps.size() < Finalists)
      {
        maps.push_back(std::move(map));
      }
    }
    this->ChooseTriangles();
    std::vector<Finalist> finalists;
    for (PartialMap& map : maps)
    {
      const double done = 0.5 + 0.5 * double(finalists.size()) / double(maps.size());
      Finalist finalist;
      finalist.map = refinement_.Refine(
        std::move(map.matrix), Limited(Second, modes_), progress.Part(done, done));
      finalist.score = finalist.map.meanMismatch + refinement_.MissedLandmarks(finalist.map.matrix);
      finalist.side = this->SideOf(finalist.map.matrix);
      finalist.score += finalist.side < -ClearSide ? Mirrored : 0.0;
      finalists.push_back(std::move(finalist));
    }
    std::stable_sort(finalists.begin(), finalists.end(),
      [](const Finalist& left, const Finalist& right) { return left.score < right.score; });
    return landmarks_.empty() ? WithoutMirrors(std::move(finalists)) : finalists;
  }

  /// Leaves out maps that mirror the surface, if others do not.
  static std::vector<Finalist> WithoutMirrors(std::vector<Finalist> finalists)
  {
    const auto mirrors = std::stable_partition(finalists.begin(), finalists.end(),
      [](const Finalist& finalist) { return finalist.side > -ClearSide; });
    if (mirrors != finalists.begin())
    {
      finalists.erase(mirrors, finalists.end());
    }
    return finalists;
  }

  /// Chooses some thousand triangles of the surface that tell the side of a map. None if one of the
  /// surfaces has one side only.
  void ChooseTriangles()
  {
    const OrientedMesh oriented = Orient(ofSurface_.mesh, true, threads_);
    normals_ = NormalsAt(ofReference_.mesh, Orient(ofReference_.mesh, true, threads_));
    if (normals_.empty() || oriented.oneSided > 0)
    {
      return;
    }
    constexpr std::size_t Some = 3000;
    const std::vector<std::array<Id, 3>>& triangles = oriented.TrianglesOf(ofSurface_.mesh);
    const std::size_t step = std::max<std::size_t>(1, triangles.size() / Some);
    for (std::size_t k = 0; k < triangles.size(); k += step)
    {
      const double area = AreaVector(ofSurface_.mesh.points, triangles[k]).norm();
      const bool isReached = std::all_of(triangles[k].begin(), triangles[k].end(),
        [&](Id corner) { return surface_.rowOf[corner] >= 0; });
      if (area > 0.0 && isReached)
      {
        areas_.push_back(area);
        for (const Id corner : triangles[k])
        {
          corners_.push_back(surface_.rowOf[corner]);
        }
      }
    }
  }

  /// The difference of the areas that a map keeps on their side and that it turns over, as a share
  /// of both. 0 if nothing tells.
  double SideOf(const MultiVector& matrix) const
  {
    if (areas_.empty())
    {
      return 0.0;
    }
    const std::vector<Id> image = refinement_.ImageOf(matrix, corners_, AllRows(reference_));
    double kept = 0.0;
    double all = 0.0;
    for (std::size_t k = 0; k < areas_.size(); ++k)
    {
      const std::array<Id, 3> corners = { reference_.point[image[3 * k]],
        reference_.point[image[3 * k + 1]], reference_.point[image[3 * k + 2]] };
      const double side = AreaVector(ofReference_.mesh.points, corners).dot(normals_[corners[0]]);
      kept += side > 0.0 ? areas_[k] : side < 0.0 ? -areas_[k] : 0.0;
      all += side != 0.0 ? areas_[k] : 0.0;
    }
    return all > 0.0 ? kept / all : 0.0;
  }

  static std::vector<Id> AllRows(const ModeRows& rows)
  {
    std::vector<Id> all(rows.point.size());
    std::iota(all.begin(), all.end(), 0);
    return all;
  }

  bool IsAmbiguous(const std::vector<Finalist>& finalists) const
  {
    const Finalist& best = finalists.front();
    return std::any_of(finalists.begin() + 1, finalists.end(),
      [&](const Finalist& other)
      {
        double sum = 0.0;
        for (std::size_t k = 0; k < best.map.image.size(); ++k)
        {
          sum +=
            (reference_.places.row(best.map.image[k]) - reference_.places.row(other.map.image[k]))
              .norm();
        }
        return other.score < AboutAsGood * best.score + 1e-3 &&
               sum > Differs * double(best.map.image.size());
      });
  }

  /// Finds the places of all points by the matrix.
  void FindPlaces(FunctionalMap& map, const Progress& progress) const
  {
    constexpr double NaN = std::numeric_limits<double>::quiet_NaN();
    const auto points = static_cast<Id>(surface_.rowOf.size());
    map.corners.assign(surface_.rowOf.size(), { -1, -1, -1 });
    map.weights.setConstant(points, 3, NaN);
    map.places.setConstant(points, 3, NaN);
    map.mismatch.assign(surface_.rowOf.size(), NaN);
    const MultiVector embedded = reference_.values * map.matrix.transpose();
    const std::vector<Id> image =
      NearestRows(embedded, threads_).Find(surface_.values, { threads_, progress.Part(0.0, 0.8) });
    const MapPlaces places(ofReference_.mesh, reference_, embedded);
    ParallelRanges(
      static_cast<Id>(image.size()), threads_,
      [&](Id begin, Id end)
      {
        for (Id row = begin; row < end; ++row)
        {
          this->SetPlace(
            surface_.point[row], places.Nearest(image[row], surface_.values.row(row)), map);
        }
      },
      RowsPerBlock, progress.Part(0.8, 1.0));
    double sum = 0.0;
    for (const Id point : surface_.point)
    {
      sum += map.mismatch[point] * map.mismatch[point];
    }
    map.meanMismatch = std::sqrt(sum / double(surface_.point.size()));
  }

  void SetPlace(Id point, const PlaceOfMap& place, FunctionalMap& map) const
  {
    map.places.row(point).setZero();
    for (int k = 0; k < 3; ++k)
    {
      const Id corner = reference_.point[place.rows[k]];
      map.corners[point][k] = corner;
      map.weights(point, k) = place.weights[k];
      for (int axis = 0; axis < 3; ++axis)
      {
        map.places(point, axis) += place.weights[k] * ofReference_.mesh.points[corner][axis];
      }
    }
    map.mismatch[point] = place.distance / std::sqrt(double(modes_));
  }

  const ModesOfShape& ofSurface_;
  const ModesOfShape& ofReference_;
  const std::vector<Landmark>& landmarks_;
  const Index modes_;
  const ModeRows surface_;
  const ModeRows reference_;
  const MapRefinement refinement_;
  const int threads_;
  ///@{ For the side of a map (ChooseTriangles).
  std::vector<double> areas_; // of triangles of the surface
  std::vector<Id> corners_;   // their corners, three rows for each
  std::vector<Vec3> normals_; // at the points of the reference
  ///@}
};

} // namespace

FunctionalMap FindFunctionalMap(const ModesOfShape& surface, const ModesOfShape& reference,
  const std::vector<Landmark>& landmarks, const Job& job)
{
  return MapSearch(surface, reference, landmarks, job.threads).Find(job.progress);
}

} // namespace gridfem
