#include "TriangleClipper.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace gridfem
{

TriangleClipper::TriangleClipper(const std::vector<std::array<Id, 3>>& triangles,
  const std::vector<Id>& pointClass, const std::vector<Vec3>& position, const MeshEdges& edges,
  int cellsPerSide, double tolerance)
  : triangles_(triangles), pointClass_(pointClass), position_(position), edges_(edges),
    cellsPerSide_(cellsPerSide), tolerance_(tolerance)
{
}

void TriangleClipper::Polygon::Push(const Vertex& v, int tag)
{
  if (size == Capacity)
  {
    throw std::length_error("A clipped polygon has too many corners.");
  }
  vertex[size] = v;
  vertex[size].tag = tag;
  ++size;
}

void TriangleClipper::Clip(Id triangle, ClipBlock& block)
{
  this->Start(triangle);
  if (planes_[0].count + planes_[1].count + planes_[2].count == 0)
  {
    this->Emit(start_, block);
    return;
  }
  pieces_.clear();
  corners_.clear();
  interiorPosition_.clear();
  for (auto& slots : sparseSlots_)
  {
    if (!slots.empty())
    {
      slots.clear();
    }
  }
  interiorBegin_ = static_cast<Id>(block.interior.size());
  this->ClipAxis(start_, 0, block);
  this->LinkPieces(block);
}

void TriangleClipper::Start(Id triangle)
{
  triangle_ = triangle;
  start_.size = 0;
  Vec3 low = position_[triangles_[triangle][0]];
  Vec3 high = low;
  for (int corner = 0; corner < 3; ++corner)
  {
    const Id id = triangles_[triangle][corner];
    const Vec3& p = position_[id];
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
    Vertex v{ { p[0], p[1], p[2] }, { 0.0, 0.0, 0.0 }, id, corner };
    v.weight[corner] = 1.0;
    start_.Push(v, corner);
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    planes_[axis] = PlanesBetween(low[axis], high[axis]);
  }
}

void TriangleClipper::ClipAxis(const Polygon& polygon, int axis, ClipBlock& block)
{
  if (axis == 3)
  {
    this->Emit(polygon, block);
    return;
  }
  double low = polygon.vertex[0].position[axis];
  double high = low;
  for (int i = 1; i < polygon.size; ++i)
  {
    low = std::min(low, polygon.vertex[i].position[axis]);
    high = std::max(high, polygon.vertex[i].position[axis]);
  }
  const PlaneRange planes = PlanesBetween(low, high);
  Polygon below;
  std::array<Polygon, 2> above;
  const Polygon* rest = &polygon;
  for (int k = 0; k < planes.count; ++k)
  {
    Polygon& next = above[k % 2];
    this->Split(*rest, axis, planes.first + k, below, next, block);
    if (below.size > 0)
    {
      this->ClipAxis(below, axis + 1, block);
    }
    rest = &next;
  }
  if (rest->size > 0)
  {
    this->ClipAxis(*rest, axis + 1, block);
  }
}

void TriangleClipper::Split(
  const Polygon& polygon, int axis, int plane, Polygon& below, Polygon& above, ClipBlock& block)
{
  below.size = above.size = 0;
  bool hasBelow = false;
  bool hasAbove = false;
  const auto side = [&](const Vertex& v)
  { return (v.position[axis] > plane) - (v.position[axis] < plane); };
  for (int i = 0; i < polygon.size; ++i)
  {
    const Vertex& v = polygon.vertex[i];
    const Vertex& next = polygon.vertex[i + 1 == polygon.size ? 0 : i + 1];
    const int here = side(v);
    const int there = side(next);
    hasBelow |= here < 0;
    hasAbove |= here > 0;
    if (here <= 0)
    {
      below.Push(v, here == 0 && there > 0 ? PlaneTag + axis : v.tag);
    }
    if (here >= 0)
    {
      above.Push(v, here == 0 && there < 0 ? PlaneTag + axis : v.tag);
    }
    if (here * there < 0)
    {
      const Vertex cut = this->Cut(v, next, axis, plane, block);
      below.Push(cut, here < 0 ? PlaneTag + axis : v.tag);
      above.Push(cut, here < 0 ? v.tag : PlaneTag + axis);
    }
  }
  if (!hasBelow)
  {
    below.size = 0;
  }
  if (!hasAbove)
  {
    above.size = 0;
  }
}

TriangleClipper::Vertex TriangleClipper::Cut(
  const Vertex& from, const Vertex& to, int axis, int plane, ClipBlock& block)
{
  return from.tag < PlaneTag ? this->CutMeshEdge(from.tag, axis, plane)
                             : this->CutPlaneEdge(from, to, axis, plane, block);
}

double TriangleClipper::Snap(double value) const
{
  const double nearest = std::nearbyint(value);
  return std::abs(value - nearest) <= tolerance_ ? nearest : value;
}

TriangleClipper::Vertex TriangleClipper::CutMeshEdge(int edge, int axis, int plane) const
{
  const Id e = edges_.ofTriangle[triangle_][edge];
  const auto& ends = edges_.ends[e];
  const Vec3& a = position_[ends[0]];
  const Vec3& b = position_[ends[1]];
  const double t = (plane - a[axis]) / (b[axis] - a[axis]);
  Vertex cut;
  Id number = edges_.cutBegin[e];
  for (int other = 0; other < 3; ++other)
  {
    const PlaneRange planes = PlanesBetween(a[other], b[other]);
    if (other < axis)
    {
      number += planes.count;
    }
    else if (other == axis)
    {
      number += plane - planes.first;
    }
    cut.position[other] = other == axis ? plane : this->Snap(a[other] + t * (b[other] - a[other]));
  }
  cut.id = static_cast<Id>(position_.size()) + number;
  const int next = edge == 2 ? 0 : edge + 1;
  const bool forward = pointClass_[triangles_[triangle_][edge]] == ends[0];
  cut.weight = { 0.0, 0.0, 0.0 };
  cut.weight[forward ? edge : next] = 1.0 - t;
  cut.weight[forward ? next : edge] = t;
  cut.tag = edge;
  return cut;
}

TriangleClipper::Slot& TriangleClipper::InteriorSlot(int axisA, int planeA, int axisB, int planeB)
{
  const PlaneRange& a = planes_[axisA];
  const PlaneRange& b = planes_[axisB];
  // A triangle that touches a plane without crossing it can still have a cut edge there.
  const Id row = planeA - a.first + 1;
  const Id width = b.count + 2;
  const Id place = row * width + (planeB - b.first + 1);
  const Id size = (a.count + Id{ 2 }) * width;
  const int table = axisA + axisB - 1;
  if (size > LargestTable)
  {
    return sparseSlots_[table][place];
  }
  if (static_cast<Id>(slots_[table].size()) < size)
  {
    slots_[table].resize(size);
  }
  return slots_[table][place];
}

TriangleClipper::Vertex TriangleClipper::CutPlaneEdge(
  const Vertex& from, const Vertex& to, int axis, int plane, ClipBlock& block)
{
  const int edgeAxis = from.tag - PlaneTag;
  const int edgePlane = static_cast<int>(from.position[edgeAxis]);
  Slot& slot = this->InteriorSlot(edgeAxis, edgePlane, axis, plane);
  if (slot.stamp != triangle_)
  {
    const double t = (plane - from.position[axis]) / (to.position[axis] - from.position[axis]);
    std::array<double, 3> position;
    CutPoint point;
    point.triangle = triangle_;
    for (int k = 0; k < 3; ++k)
    {
      position[k] = this->Snap(from.position[k] + t * (to.position[k] - from.position[k]));
      point.weight[k] = from.weight[k] + t * (to.weight[k] - from.weight[k]);
    }
    position[axis] = plane;
    position[edgeAxis] = edgePlane;
    slot = { triangle_, static_cast<Id>(block.interior.size()) };
    block.interior.push_back(point);
    interiorPosition_.push_back(position);
  }
  Vertex cut;
  cut.id = -1 - slot.id;
  cut.position = interiorPosition_[slot.id - interiorBegin_];
  cut.weight = block.interior[slot.id].weight;
  cut.tag = from.tag;
  return cut;
}

CellIndex TriangleClipper::CellOf(const Polygon& polygon) const
{
  CellIndex cell;
  for (int axis = 0; axis < 3; ++axis)
  {
    double low = polygon.vertex[0].position[axis];
    for (int i = 1; i < polygon.size; ++i)
    {
      low = std::min(low, polygon.vertex[i].position[axis]);
    }
    cell[axis] = std::clamp(static_cast<int>(low), 0, cellsPerSide_ - 1);
  }
  return cell;
}

void TriangleClipper::Emit(const Polygon& polygon, ClipBlock& block)
{
  const CellIndex cell = this->CellOf(polygon);
  const Id piece = static_cast<Id>(block.key.size());
  block.key.push_back(MortonEncode(cell));
  block.triangle.push_back(triangle_);
  block.size.push_back(polygon.size);
  for (int i = 0; i < polygon.size; ++i)
  {
    block.corner.push_back(polygon.vertex[i].id);
    block.tag.push_back(static_cast<std::uint8_t>(polygon.vertex[i].tag));
  }
  if (&polygon != &start_)
  {
    pieces_.push_back({ cell, piece, static_cast<int>(corners_.size()), polygon.size });
    for (int i = 0; i < polygon.size; ++i)
    {
      const Vertex& v = polygon.vertex[i];
      corners_.push_back({ v.id, v.tag, v.position });
    }
  }
}

void TriangleClipper::LinkPieces(ClipBlock& block) const
{
  for (const LocalPiece& piece : pieces_)
  {
    for (int i = 0; i < piece.size; ++i)
    {
      const LocalCorner& corner = corners_[piece.firstCorner + i];
      const int axis = corner.tag - PlaneTag;
      if (axis >= 0 && static_cast<int>(corner.position[axis]) == piece.cell[axis] + 1)
      {
        this->LinkAcross(piece, i, block);
      }
    }
  }
}

const TriangleClipper::LocalPiece* TriangleClipper::FindPiece(const CellIndex& cell) const
{
  const auto found = std::lower_bound(pieces_.begin(), pieces_.end(), cell,
    [](const LocalPiece& piece, const CellIndex& wanted) { return piece.cell < wanted; });
  return found != pieces_.end() && found->cell == cell ? &*found : nullptr;
}

bool TriangleClipper::HasEdge(const LocalPiece& piece, Id a, Id b) const
{
  for (int i = 0; i < piece.size; ++i)
  {
    const Id from = corners_[piece.firstCorner + i].id;
    const Id to = corners_[piece.firstCorner + (i + 1) % piece.size].id;
    if ((from == a && to == b) || (from == b && to == a))
    {
      return true;
    }
  }
  return false;
}

/// The piece on the other side of a cut is in the next cell; where the cut runs along an edge of
/// the grid it can be one further along the axes that were clipped later.
void TriangleClipper::LinkAcross(const LocalPiece& piece, int corner, ClipBlock& block) const
{
  const LocalCorner& from = corners_[piece.firstCorner + corner];
  const LocalCorner& to = corners_[piece.firstCorner + (corner + 1) % piece.size];
  const int axis = from.tag - PlaneTag;
  static constexpr std::array<int, 3> Shifts = { 0, -1, 1 };
  for (const int shiftZ : Shifts)
  {
    for (const int shiftY : Shifts)
    {
      if ((axis == 2 && shiftZ != 0) || (axis >= 1 && shiftY != 0))
      {
        continue;
      }
      CellIndex cell = piece.cell;
      ++cell[axis];
      cell[1] += shiftY;
      cell[2] += shiftZ;
      const LocalPiece* other = this->FindPiece(cell);
      if (other && this->HasEdge(*other, from.id, to.id))
      {
        block.links.push_back({ piece.piece, other->piece });
        return;
      }
    }
  }
}

} // namespace gridfem
