#include "Shape/OpenedSurface.h"

#include "Base/Errors.h"
#include "Base/SortEachOnce.h"
#include "Grid/CopiedTriangles.h"
#include "Grid/SurfaceSides.h"
#include "Grid/TriangleArea.h"
#include "Shape/CutGraph.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace gridfem
{

namespace
{

/// The triangles of the mesh that take part, connected, and in components.
struct Sheets
{
  ConnectedTriangles triangles;
  std::vector<Id> source;                 // triangle of the mesh
  std::vector<char> isTurned;             // against the mesh
  std::vector<std::vector<Index>> member; // triangles of each component, ascending
};

/// The side of a triangle after it was turned, which exchanges its corners 1 and 2.
HalfEdge AfterTurn(HalfEdge corner, bool isTurned)
{
  return isTurned ? 2 - corner : corner;
}

/// @param place  of each point
Sheets FindSheets(const TriangleMesh& mesh, const Array<Index>& place)
{
  const Neighbors neighbors = FindNeighbors(SortedSides(mesh, place), mesh.triangles.size());
  std::vector<signed char> side;
  Sheets sheets;
  std::vector<Index> number(mesh.triangles.size(), -1);
  for (SurfaceComponent& component : FindComponents(mesh, neighbors, side))
  {
    const auto hasArea = [&](Id t)
    { return AreaVector(mesh.points, mesh.triangles[t]).norm() > 0.0; };
    if (std::none_of(component.triangles.begin(), component.triangles.end(), hasArea))
    {
      continue; // nothing to flatten; lengths may be 0, too
    }
    std::sort(component.triangles.begin(), component.triangles.end());
    sheets.member.emplace_back();
    for (const Id member : component.triangles)
    {
      number[member] = sheets.triangles.Count();
      sheets.member.back().push_back(number[member]);
      const auto& c = mesh.triangles[member];
      const bool isTurned = side[member] < 0;
      sheets.triangles.Add({ place[c[0]], place[c[isTurned ? 2 : 1]], place[c[isTurned ? 1 : 2]] });
      sheets.source.push_back(member);
      sheets.isTurned.push_back(isTurned ? 1 : 0);
    }
  }
  const auto halfEdge = [&](Id t, int corner)
  { return 3 * number[t] + AfterTurn(static_cast<HalfEdge>(corner), side[t] < 0); };
  for (Id t = 0; t < static_cast<Id>(neighbors.size()); ++t)
  {
    for (int corner = 0; corner < 3; ++corner)
    {
      const Neighbor& neighbor = neighbors[t][corner];
      // Otherwise it is left out, or the component has one side only and ends here.
      if (number[t] >= 0 && neighbor.triangle != Neighbor::None &&
          (side[t] == side[neighbor.triangle]) == neighbor.facesAlike)
      {
        sheets.triangles.twin[halfEdge(t, corner)] = halfEdge(neighbor.triangle, neighbor.corner);
      }
    }
  }
  return sheets;
}

/// Leaves out triangles that have the corners of an earlier one. An edge would have too many sides.
Sheets FindSheets(const TriangleMesh& mesh, bool weldsCoincidentPoints, int threads)
{
  RequireIndices(3.0 * static_cast<double>(mesh.triangles.size()), "sides of triangles");
  Array<Index> place(mesh.points.size());
  std::iota(place.begin(), place.end(), 0);
  if (weldsCoincidentPoints)
  {
    place = WeldCoincidentPoints(mesh.points, UsedPoints(mesh, threads), threads);
  }
  const std::vector<char> isCopy = CopiedTriangles(mesh, place, threads);
  if (isCopy.empty())
  {
    return FindSheets(mesh, place);
  }
  TriangleMesh once = mesh;
  std::vector<Id> source(mesh.triangles.size());
  std::iota(source.begin(), source.end(), 0);
  KeepTriangles(once, source, [&isCopy](std::size_t t) { return !isCopy[t]; });
  Sheets sheets = FindSheets(once, place);
  for (Id& triangle : sheets.source)
  {
    triangle = source[triangle];
  }
  return sheets;
}

/// One component on its way to a disk.
class Opening
{
public:
  Opening(const TriangleMesh& mesh, const Sheets& sheets, const std::vector<Index>& members)
    : mesh_(mesh)
  {
    for (const Index member : members)
    {
      const auto& places = sheets.triangles.places[member];
      placeOf_.insert(placeOf_.end(), places.begin(), places.end());
    }
    SortEachOnce(placeOf_);
    for (const Index place : placeOf_)
    {
      points_.push_back(mesh.points[place]);
    }
    const auto local = [&](Index place)
    {
      return static_cast<Index>(
        std::lower_bound(placeOf_.begin(), placeOf_.end(), place) - placeOf_.begin());
    };
    const Index first = members.front(); // members are consecutive
    for (const Index member : members)
    {
      const auto& places = sheets.triangles.places[member];
      part_.Add({ local(places[0]), local(places[1]), local(places[2]) });
      disk_.triangleOf.push_back(sheets.source[member]);
      disk_.isTurned.push_back(sheets.isTurned[member]);
      for (HalfEdge k = 0; k < 3; ++k)
      {
        const HalfEdge twin = sheets.triangles.twin[3 * member + k];
        part_.twin[3 * (member - first) + k] = twin < 0 ? -1 : twin - 3 * first;
      }
    }
  }

  Disk ToDisk(const OpeningOptions& options)
  {
    const auto loops = BoundaryLoops(part_);
    disk_.topology.loops = static_cast<Id>(loops.size());
    Id inner = 0;
    for (const HalfEdge twin : part_.twin)
    {
      inner += twin >= 0 ? 1 : 0;
    }
    const Id edges = static_cast<Id>(part_.twin.size()) - inner / 2;
    disk_.topology.euler = NumberVertices(part_).count - edges + part_.Count();
    this->FillHoles(loops, options.holeSize);
    for (const HalfEdge h : FindCuts(part_, points_, disk_.topology.Genus() > 0, options.extraCuts))
    {
      part_.Cut(h);
    }
    return this->Finish();
  }

private:
  double LengthOf(const std::vector<HalfEdge>& loop) const
  {
    double length = 0.0;
    for (const HalfEdge h : loop)
    {
      length += (points_[part_.From(h)] - points_[part_.To(h)]).norm();
    }
    return length;
  }

  /// The length of the circle around the area of the component.
  double CircleOfArea() const
  {
    double area = 0.0;
    for (const auto& c : part_.places)
    {
      area += 0.5 * AreaVector(points_, { c[0], c[1], c[2] }).norm();
    }
    return std::sqrt(4.0 * double(EIGEN_PI) * area);
  }

  /// Covers every small loop with triangles around its middle.
  void FillHoles(const std::vector<std::vector<HalfEdge>>& loops, double holeSize)
  {
    constexpr double PinHole = 0.1;
    double longest = PinHole * this->CircleOfArea();
    const std::vector<HalfEdge>* kept = nullptr;
    for (const auto& loop : loops)
    {
      if (this->LengthOf(loop) > longest)
      {
        longest = this->LengthOf(loop);
        kept = &loop;
      }
    }
    for (const auto& loop : loops)
    {
      if (&loop != kept && this->LengthOf(loop) <= holeSize * longest)
      {
        this->Fill(loop);
      }
    }
  }

  void Fill(const std::vector<HalfEdge>& loop)
  {
    Vec3 middle = Vec3::Zero();
    for (const HalfEdge h : loop)
    {
      middle += points_[part_.From(h)] / static_cast<double>(loop.size());
    }
    if (loop.size() == 2)
    {
      part_.Connect(loop[0], loop[1]);
      return;
    }
    points_.push_back(middle);
    const auto center = static_cast<Index>(points_.size() - 1);
    const HalfEdge first = 3 * part_.Count();
    for (const HalfEdge h : loop)
    {
      part_.Add({ part_.To(h), part_.From(h), center });
      part_.Connect(h, 3 * (part_.Count() - 1));
      disk_.triangleOf.push_back(-1);
      disk_.isTurned.push_back(0);
    }
    const auto count = static_cast<Index>(loop.size());
    for (Index k = 0; k < count; ++k) // side 1 runs from where the edge begins to the center
    {
      part_.Connect(first + 3 * ((k + 1) % count) + 1, first + 3 * k + 2);
    }
  }

  Disk Finish()
  {
    const VertexNumbers vertices = NumberVertices(part_);
    disk_.points.resize(vertices.count);
    disk_.pointOf.assign(vertices.count, -1);
    for (Index t = 0; t < part_.Count(); ++t)
    {
      std::array<Index, 3> corners{};
      for (int k = 0; k < 3; ++k)
      {
        corners[k] = vertices.ofCorner[3 * t + k];
        disk_.points[corners[k]] = points_[part_.places[t][k]];
        const Id source = disk_.triangleOf[t];
        if (source >= 0 && disk_.pointOf[corners[k]] < 0)
        {
          const int own = disk_.isTurned[t] && k > 0 ? 3 - k : k;
          disk_.pointOf[corners[k]] = mesh_.triangles[source][own];
        }
      }
      disk_.triangles.push_back(corners);
    }
    const auto loops = BoundaryLoops(part_);
    for (const HalfEdge h : loops.front())
    {
      disk_.loop.push_back(vertices.ofCorner[h]);
    }
    return std::move(disk_);
  }

  const TriangleMesh& mesh_;
  std::vector<Index> placeOf_; // ascending: the place of the mesh of each local place
  std::vector<Vec3> points_;   // of local places, and the middles of holes
  ConnectedTriangles part_;
  Disk disk_;
};

} // namespace

std::vector<Disk> OpenToDisks(
  const TriangleMesh& mesh, const OpeningOptions& options, const Job& job)
{
  const Sheets sheets = FindSheets(mesh, options.weldCoincidentPoints, job.threads);
  if (sheets.member.empty())
  {
    throw InvalidInput("No triangle has three corners at different places.");
  }
  std::vector<Disk> disks;
  for (const std::vector<Index>& members : sheets.member)
  {
    job.Check(static_cast<double>(disks.size()) / static_cast<double>(sheets.member.size()));
    disks.push_back(Opening(mesh, sheets, members).ToDisk(options));
  }
  return disks;
}

} // namespace gridfem
