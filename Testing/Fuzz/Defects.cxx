#include "Defects.h"

#include "Grid/CopiedTriangles.h"
#include "Grid/JoinSeams.h"
#include "Largest.h"
#include "Meshes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

namespace gridfem::testing
{
namespace
{

using Corners = std::array<Id, 3>;

/// Largest number of parts that a side is divided into.
constexpr Id MostParts = 4;

/// A mesh with two functions on it.
struct ValuedMesh
{
  TriangleMesh mesh;
  std::vector<Vec3> values; // the third is the number of the clean point, or -1
};

TriangleMesh Pipe(Choice& choice)
{
  const Id around = choice.Integer(6, 20);
  const Id along = choice.Integer(2, 6);
  TriangleMesh mesh;
  for (Id row = 0; row <= along; ++row)
  {
    for (Id k = 0; k < around; ++k)
    {
      const double angle = 2.0 * 3.14159265358979 * double(k) / double(around);
      mesh.points.emplace_back(std::cos(angle), std::sin(angle), 2.0 * double(row) / double(along));
    }
  }
  for (Id row = 0; row < along; ++row)
  {
    for (Id k = 0; k < around; ++k)
    {
      const Id low = row * around;
      const Id next = (k + 1) % around;
      mesh.triangles.push_back({ low + k, low + next, low + around + next });
      mesh.triangles.push_back({ low + k, low + around + next, low + around + k });
    }
  }
  return mesh;
}

TriangleMesh Plate(Choice& choice)
{
  const int columns = static_cast<int>(choice.Integer(2, 14));
  const int rows = static_cast<int>(choice.Integer(2, 14));
  return FlatRectangle(columns, rows, choice.Real(0.5, 2.0), 1.0);
}

TriangleMesh Ring(Choice& choice)
{
  const int along = static_cast<int>(choice.Integer(8, 24));
  const int around = static_cast<int>(choice.Integer(5, 12));
  return Torus(along, around, 1.0, choice.Real(0.2, 0.6));
}

TriangleMesh Block(Choice& choice)
{
  const int parts = static_cast<int>(choice.Integer(1, 5));
  const double width = choice.Real(0.3, 1.0);
  return Box(parts, Vec3::Zero(), { 1.0, width, choice.Real(0.3, 1.0) });
}

TriangleMesh Globe(Choice& choice)
{
  const int longitudes = static_cast<int>(choice.Integer(5, 20));
  return LatLongSphere(longitudes, static_cast<int>(choice.Integer(3, 10)));
}

TriangleMesh Cubes(Choice& choice)
{
  const int parts = static_cast<int>(choice.Integer(1, 3));
  return CubeArray(2, parts, choice.Real(0.05, 0.5));
}

TriangleMesh Sphere(Choice& choice)
{
  return GeodesicSphere(static_cast<int>(choice.Integer(2, 8)));
}

struct Shape
{
  const char* name;
  TriangleMesh (*make)(Choice&);
};

constexpr Shape Shapes[] = { { "sphere", Sphere }, { "ring", Ring }, { "block", Block },
  { "plate", Plate }, { "globe", Globe }, { "cubes", Cubes }, { "pipe", Pipe } };

/// Turns, scales and moves the mesh.
TriangleMesh Placed(Choice& choice, const TriangleMesh& mesh)
{
  const Vec3 axis = choice.Vector();
  const Vec3 shift = 3.0 * choice.Vector();
  const double angle = choice.Real(0.1, 6.0);
  return Transform(mesh, axis, angle, choice.PowerOfTen(-3.0, 3.0), shift);
}

Vec3 CentroidOf(const TriangleMesh& mesh, const Corners& corner)
{
  return (mesh.points[corner[0]] + mesh.points[corner[1]] + mesh.points[corner[2]]) / 3.0;
}

/// Marks the triangles on one side of a random plane through the middle of the mesh.
std::vector<char> OnOneSide(Choice& choice, const TriangleMesh& mesh)
{
  const Bounds bounds = BoundsOf(mesh.points, UsedPoints(mesh));
  const Vec3 size = bounds.high - bounds.low;
  const Vec3 normal = choice.Vector().normalized();
  const Vec3 origin = 0.5 * (bounds.low + bounds.high) + 0.2 * choice.Vector().cwiseProduct(size);
  std::vector<char> side;
  for (const Corners& corner : mesh.triangles)
  {
    side.push_back(normal.dot(CentroidOf(mesh, corner) - origin) > 0.0 ? 1 : 0);
  }
  return side;
}

std::vector<Corners> Selected(const TriangleMesh& mesh, const std::vector<char>& isKept)
{
  std::vector<Corners> kept;
  for (std::size_t t = 0; t < isKept.size(); ++t)
  {
    if (isKept[t])
    {
      kept.push_back(mesh.triangles[t]);
    }
  }
  return kept;
}

/// Returns the mesh without the points that no triangle uses. Notes the old number of each point.
TriangleMesh WithoutUnused(const TriangleMesh& mesh, std::vector<Id>& oldNumber)
{
  const std::vector<char> used = UsedPoints(mesh);
  std::vector<Id> number(used.size(), -1);
  TriangleMesh result;
  oldNumber.clear();
  for (std::size_t point = 0; point < used.size(); ++point)
  {
    if (used[point])
    {
      number[point] = static_cast<Id>(oldNumber.size());
      oldNumber.push_back(static_cast<Id>(point));
      result.points.push_back(mesh.points[point]);
    }
  }
  for (const Corners& corner : mesh.triangles)
  {
    result.triangles.push_back({ number[corner[0]], number[corner[1]], number[corner[2]] });
  }
  return result;
}

/// Returns a distance below which points are certain to be joined, also after a refinement.
double SafeTolerance(const TriangleMesh& mesh)
{
  const Bounds bounds = BoundsOf(mesh.points, UsedPoints(mesh));
  double shortest = std::numeric_limits<double>::infinity();
  for (const Corners& corner : mesh.triangles)
  {
    for (int k = 0; k < 3; ++k)
    {
      shortest = std::min(
        shortest, (mesh.points[corner[k]] - mesh.points[corner[(k + 1) % 3]]).norm() / MostParts);
    }
  }
  return std::min(SeamTolerance * (bounds.high - bounds.low).maxCoeff<Eigen::PropagateNaN>(),
    SeamShare * shortest);
}

double LargestCoordinate(const TriangleMesh& mesh)
{
  double largest = 0.0;
  for (const Vec3& point : mesh.points)
  {
    largest = testing::Larger(largest, point.cwiseAbs().maxCoeff<Eigen::PropagateNaN>());
  }
  return largest;
}

/// Returns the two or four parts of a mesh, as marks of its triangles. Some may be empty.
std::vector<std::vector<char>> PartsOf(Choice& choice, const TriangleMesh& mesh)
{
  std::vector<std::vector<char>> parts = { std::vector<char>(mesh.triangles.size(), 1) };
  for (Id planes = choice.Integer(1, 2); planes > 0; --planes)
  {
    const std::vector<char> side = OnOneSide(choice, mesh);
    std::vector<std::vector<char>> halves;
    for (const std::vector<char>& part : parts)
    {
      for (const char wanted : { 0, 1 })
      {
        halves.push_back(part);
        for (std::size_t t = 0; t < side.size(); ++t)
        {
          halves.back()[t] = part[t] && side[t] == wanted ? 1 : 0;
        }
      }
    }
    parts = halves;
  }
  return parts;
}

/// Divides the sides of every triangle into `parts`, and the triangle into parts².
class Refinement
{
public:
  Refinement(const ValuedMesh& given, Id parts) : parts_(double(parts)), result_(given)
  {
    result_.mesh.triangles.clear();
    for (const Corners& corner : given.mesh.triangles)
    {
      const auto at = [&](Id i, Id j) { return this->PointAt(corner, { parts - i - j, i, j }); };
      for (Id i = 0; i < parts; ++i)
      {
        for (Id j = 0; i + j < parts; ++j)
        {
          this->Add({ at(i, j), at(i + 1, j), at(i, j + 1) });
          if (i + j + 1 < parts)
          {
            this->Add({ at(i + 1, j), at(i + 1, j + 1), at(i, j + 1) });
          }
        }
      }
    }
  }

  const ValuedMesh& Result() const { return result_; }

private:
  void Add(const Corners& corners) { result_.mesh.triangles.push_back(corners); }

  /// @param share  of each corner; triangles with the same corners of nonzero share have one point
  Id PointAt(const Corners& corner, const std::array<Id, 3>& share)
  {
    std::array<std::pair<Id, Id>, 3> key;
    for (int k = 0; k < 3; ++k)
    {
      key[k] = share[k] > 0 ? std::pair(corner[k], share[k]) : std::pair(Id(-1), Id(0));
    }
    std::sort(key.begin(), key.end());
    if (key[1].first < 0)
    {
      return key[2].first;
    }
    const auto [entry, isNew] = points_.emplace(key, static_cast<Id>(result_.values.size()));
    if (isNew)
    {
      Vec3 place = Vec3::Zero();
      Vec3 value = Vec3::Zero();
      for (const auto& [point, part] : key) // the same sum from both sides of an edge
      {
        place += part > 0 ? Vec3(double(part) * result_.mesh.points[point]) : Vec3::Zero();
        value += part > 0 ? Vec3(double(part) * result_.values[point]) : Vec3::Zero();
      }
      result_.mesh.points.push_back(place / parts_);
      result_.values.push_back(value / parts_);
      result_.values.back()[2] = -1.0;
    }
    return entry->second;
  }

  const double parts_;
  ValuedMesh result_;
  std::map<std::array<std::pair<Id, Id>, 3>, Id> points_;
};

/// Gives parts of the surface points of their own, and refines some of the parts. Moves the points
/// by less than the tolerance of seams.
void TakeApart(Choice& choice, const Defects& defects, ValuedMesh& surface)
{
  const double noise = defects.hasSeams ? 0.2 * SafeTolerance(surface.mesh) : 0.0;
  const double ofSingle = 1e-7 * LargestCoordinate(surface.mesh);
  const bool isSingle = ofSingle < noise && choice.OneIn(4);
  ValuedMesh whole;
  for (const std::vector<char>& isInPart : PartsOf(choice, surface.mesh))
  {
    std::vector<Id> oldNumber;
    ValuedMesh part;
    part.mesh = WithoutUnused({ surface.mesh.points, Selected(surface.mesh, isInPart) }, oldNumber);
    for (const Id point : oldNumber)
    {
      part.values.push_back(surface.values[point]);
    }
    if (defects.hasHangingNodes)
    {
      part = Refinement(part, choice.Integer(1, MostParts)).Result();
    }
    for (Vec3& point : part.mesh.points)
    {
      point += noise * choice.Vector();
      point = isSingle ? point.cast<float>().cast<double>().eval() : point;
    }
    whole.mesh = Join(whole.mesh, part.mesh);
    whole.values.insert(whole.values.end(), part.values.begin(), part.values.end());
  }
  surface = whole;
}

void TurnSome(Choice& choice, TriangleMesh& mesh)
{
  const double share = choice.Real(0.05, 0.95);
  for (Corners& corner : mesh.triangles)
  {
    if (choice.Real(0.0, 1.0) < share)
    {
      std::swap(corner[1], corner[2]);
    }
  }
}

/// Repeats some triangles, with the same points, at any later place in the list.
void RepeatSome(Choice& choice, TriangleMesh& mesh)
{
  std::vector<Corners>& triangles = mesh.triangles;
  const double share = choice.Real(0.02, 1.0);
  for (std::size_t t = triangles.size(); t-- > 0;)
  {
    if (choice.Real(0.0, 1.0) >= share)
    {
      continue;
    }
    Corners copy = triangles[t];
    std::rotate(copy.begin(), copy.begin() + choice.Integer(0, 2), copy.end());
    if (choice.OneIn(2))
    {
      std::swap(copy[0], copy[1]);
    }
    const auto size = static_cast<Id>(triangles.size());
    triangles.insert(triangles.begin() + choice.Integer(static_cast<Id>(t) + 1, size), copy);
  }
}

/// The steps of every input.
void Prepare(TriangleMesh& mesh)
{
  std::vector<Id> source(mesh.triangles.size());
  std::iota(source.begin(), source.end(), Id(0));
  DropCopies(mesh, source, 1);
  JoinSeams(mesh, 1);
}

MultiVector FirstTwo(const std::vector<Vec3>& values)
{
  MultiVector columns(static_cast<Id>(values.size()), 2);
  for (Id row = 0; row < columns.rows(); ++row)
  {
    columns.row(row) = values[row].head<2>().transpose();
  }
  return columns;
}

/// Two waves along the surface. The third value is the number of the point.
std::vector<Vec3> Waves(Choice& choice, const TriangleMesh& mesh)
{
  const Bounds bounds = BoundsOf(mesh.points);
  const double size = (bounds.high - bounds.low).maxCoeff<Eigen::PropagateNaN>();
  const Vec3 wave[] = { 3.0 * choice.Vector(), 8.0 * choice.Vector() };
  std::vector<Vec3> values;
  for (const Vec3& point : mesh.points)
  {
    const Vec3 place = (point - bounds.low) / size;
    values.emplace_back(
      1.5 + std::sin(wave[0].dot(place)), std::cos(wave[1].dot(place)), double(values.size()));
  }
  return values;
}

/// Keeps the triangles on one side of a plane. The points stay.
void Mask(Choice& choice, TriangleMesh& mesh)
{
  const std::vector<Corners> part = Selected(mesh, OnOneSide(choice, mesh));
  mesh.triangles = part.empty() ? mesh.triangles : part;
}

void MakeDefects(Choice& choice, const Defects& defects, ValuedMesh& surface)
{
  if (defects.hasSeams || defects.hasHangingNodes)
  {
    TakeApart(choice, defects, surface);
  }
  if (defects.isTurned)
  {
    TurnSome(choice, surface.mesh);
  }
  if (defects.hasCopies)
  {
    RepeatSome(choice, surface.mesh);
  }
}

/// Returns, for each of the clean points, a point of the surface with its number.
std::vector<Id> PointsByNumber(const ValuedMesh& surface, std::size_t count)
{
  const std::vector<char> used = UsedPoints(surface.mesh);
  std::vector<Id> points(count);
  for (std::size_t point = 0; point < surface.values.size(); ++point)
  {
    const double number = surface.values[point][2];
    if (number >= 0.0 && used[point])
    {
      points[static_cast<std::size_t>(number)] = static_cast<Id>(point);
    }
  }
  return points;
}

} // namespace

DefectivePair MakeDefectivePair(Choice& choice, const Defects& defects)
{
  DefectivePair pair;
  const Shape& shape = Shapes[choice.Integer(0, std::size(Shapes) - 1)];
  pair.description = shape.name;
  TriangleMesh mesh = shape.make(choice);
  pair.isAligned = choice.OneIn(2);
  if (!pair.isAligned)
  {
    mesh = Placed(choice, mesh);
  }
  if (defects.isMasked)
  {
    Mask(choice, mesh);
  }
  std::vector<Id> oldNumber;
  pair.clean = WithoutUnused(mesh, oldNumber);
  ValuedMesh surface{ pair.clean, Waves(choice, pair.clean) };
  pair.values = FirstTwo(surface.values);
  if (defects.hasHangingNodes)
  {
    const ValuedMesh fine = Refinement(surface, MostParts).Result();
    pair.fine = fine.mesh;
    pair.fineValues = FirstTwo(fine.values);
  }
  MakeDefects(choice, defects, surface);
  if (defects.isMasked) // the points of the whole, in front of the others
  {
    surface.mesh = Join({ mesh.points, {} }, surface.mesh);
    surface.values.insert(surface.values.begin(), mesh.points.size(), Vec3(7.0, -7.0, -1.0));
  }
  pair.defectivePoint = PointsByNumber(surface, pair.clean.points.size());
  pair.defective = surface.mesh;
  pair.defectiveValues = FirstTwo(surface.values);
  Prepare(pair.clean);
  Prepare(pair.defective);
  return pair;
}

} // namespace gridfem::testing
