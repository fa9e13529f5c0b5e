#include "Grid/TriangleClipper.h"

#include "Grid/CutPoints.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace gridfem
{

namespace
{

double Snap(double value, double tolerance)
{
  const double nearest = std::nearbyint(value);
  return std::abs(value - nearest) <= tolerance ? nearest : value;
}

} // namespace

void TriangleClipper::Polygon::Push(std::int32_t vertex, int tag)
{
  if (size == Capacity)
  {
    throw std::length_error("A clipped polygon has too many corners.");
  }
  corner[size].vertex = vertex;
  corner[size].tag = static_cast<std::int16_t>(tag);
  ++size;
}

void TriangleClipper::Clip(Id triangle, ClipBuffer& store)
{
  triangle_ = triangle;
  CellIndex cell;
  if (this->IsInOneCell(cell))
  {
    if (!input_.region || input_.region->Contains(cell))
    {
      this->EmitWhole(cell, store);
    }
    return;
  }
  vertices_.clear();
  pieces_.clear();
  corners_.clear();
  for (auto& slots : sparseSlots_)
  {
    if (!slots.empty())
    {
      slots.clear();
    }
  }
  this->Start();
  Polygon whole;
  for (int corner = 0; corner < 3; ++corner)
  {
    whole.Push(corner, corner);
  }
  hasMovedPiece_ = false;
  this->ClipAxis(whole, 0, store);
  if (hasMovedPiece_)
  {
    this->LinkByEdges(store);
  }
  else
  {
    this->LinkPieces(store);
  }
}

bool TriangleClipper::IsInOneCell(CellIndex& cell)
{
  const auto& corner = input_.triangles[triangle_];
  const Vec3& a = input_.position[corner[0]];
  const Vec3& b = input_.position[corner[1]];
  const Vec3& c = input_.position[corner[2]];
  const Vec3 low = a.cwiseMin(b).cwiseMin(c);
  const Vec3 high = a.cwiseMax(b).cwiseMax(c);
  bool isCut = false;
  for (int axis = 0; axis < 3; ++axis)
  {
    planes_[axis] = PlanesBetween(low[axis], high[axis]);
    isCut |= planes_[axis].count > 0;
    cell[axis] = std::min(static_cast<int>(low[axis]), input_.cellsPerSide - 1);
  }
  return !isCut;
}

void TriangleClipper::EmitWhole(const CellIndex& cell, ClipBuffer& store)
{
  const Index piece = store.Append(MortonEncode(cell), static_cast<Index>(triangle_), nextChunk_);
  const Index number = store.NumberOf(piece);
  for (int k = 0; k < 3; ++k)
  {
    store.corner.push_back(static_cast<Index>(input_.triangles[triangle_][k]));
    const EdgeSide& side = input_.edges.ofTriangle[triangle_][k];
    if (side.stretch != EdgeSide::None)
    {
      stretches_[side.stretch] = number;
    }
  }
  store.cornerBegin.push_back(static_cast<Index>(store.corner.size()));
}

void TriangleClipper::Start()
{
  const auto& corners = input_.triangles[triangle_];
  for (int k = 0; k < 3; ++k)
  {
    const Vec3& p = input_.position[corners[k]];
    Vertex& vertex = vertices_.emplace_back();
    vertex.id = static_cast<Index>(corners[k]);
    for (int axis = 0; axis < 3; ++axis)
    {
      vertex.position[axis] = p[axis];
      vertex.weight[axis] = axis == k ? 1.0 : 0.0;
    }

    const EdgeSide& side = input_.edges.ofTriangle[triangle_][k];
    const int next = k == 2 ? 0 : k + 1;
    const Index from = input_.pointClass[corners[k]];
    const Index to = input_.pointClass[corners[next]];
    Edge& edge = edge_[k];
    edge.low = &input_.position[std::min(from, to)];
    edge.high = &input_.position[std::max(from, to)];
    edge.lowCorner = from <= to ? k : next;
    edge.highCorner = from <= to ? next : k;
    edge.firstCut[0] = static_cast<Index>(input_.position.size()) + side.FirstCut();
    for (int axis = 0; axis < 3; ++axis)
    {
      edge.planes[axis] = PlanesBetween((*edge.low)[axis], (*edge.high)[axis]);
      edge.firstCut[axis + 1] = edge.firstCut[axis] + edge.planes[axis].count;
    }
    edge.isNamedHere = side.IsFirst();
    edge.stretch = side.stretch == EdgeSide::None ? nullptr : &stretches_[side.stretch];
    edge.stride = input_.edges.StrideOf(side);
  }
}

void TriangleClipper::ClipAxis(const Polygon& polygon, int axis, ClipBuffer& store)
{
  if (axis == 3)
  {
    this->Emit(polygon, store);
    return;
  }
  double low = vertices_[polygon.corner[0].vertex].position[axis];
  double high = low;
  for (int i = 1; i < polygon.size; ++i)
  {
    const double value = vertices_[polygon.corner[i].vertex].position[axis];
    low = std::min(low, value);
    high = std::max(high, value);
  }
  const PlaneRange planes = PlanesBetween(low, high);
  if (planes.count == 0)
  {
    slab_[axis] = std::min(static_cast<int>(low), input_.cellsPerSide - 1);
    this->ClipAxis(polygon, axis + 1, store);
    return;
  }
  Polygon below;
  std::array<Polygon, 2> above;
  const Polygon* rest = &polygon;
  for (int k = 0; k < planes.count; ++k)
  {
    Polygon& next = above[k % 2];
    this->Split(*rest, axis, planes.first + k, below, next, store);
    slab_[axis] = planes.first + k - 1;
    if (below.size > 0 && this->IsNearRegion(axis, slab_[axis]))
    {
      this->ClipAxis(below, axis + 1, store);
    }
    rest = &next;
  }
  slab_[axis] = planes.first + planes.count - 1;
  if (rest->size > 0 && this->IsNearRegion(axis, slab_[axis]))
  {
    this->ClipAxis(*rest, axis + 1, store);
  }
}

int TriangleClipper::SideOf(const Corner& corner, int axis, int plane) const
{
  const double value = vertices_[corner.vertex].position[axis];
  return (value > plane) - (value < plane);
}

/// Returns the side of the first corner off the plane, searched from `corner` in steps of `step`.
int TriangleClipper::SideAfter(
  const Polygon& polygon, int corner, int step, int axis, int plane) const
{
  int side = 0;
  for (int k = 1; side == 0 && k < polygon.size; ++k)
  {
    side = this->SideOf(polygon.corner[(corner + k * step) % polygon.size], axis, plane);
  }
  return side;
}

/// Gives a corner on the plane to the polygons on both sides of it. Several such corners may be
/// consecutive, for example in a triangle nearly parallel to the plane. The part on the plane then
/// belongs to the polygon above, for both orientations. The polygon below gets only the corner
/// where it meets the plane; otherwise the two polygons would overlap.
void TriangleClipper::ShareCorner(
  const Polygon& polygon, int i, int axis, int plane, Polygon& below, Polygon& above) const
{
  const int back = polygon.size - 1;
  const int before = this->SideOf(polygon.corner[(i + back) % polygon.size], axis, plane);
  const int after = this->SideOf(polygon.corner[(i + 1) % polygon.size], axis, plane);
  const int from = this->SideAfter(polygon, i, back, axis, plane);
  const int to = this->SideAfter(polygon, i, 1, axis, plane);
  const Corner& corner = polygon.corner[i];
  const int planeTag = PlaneTag + axis;
  if (before < 0 || after < 0 || (from < 0 && to < 0))
  {
    below.Push(corner.vertex, to > 0 ? planeTag : corner.tag);
  }
  if (from > 0 || to > 0)
  {
    above.Push(corner.vertex, after < 0 ? planeTag : corner.tag);
  }
}

void TriangleClipper::Split(
  const Polygon& polygon, int axis, int plane, Polygon& below, Polygon& above, ClipBuffer& store)
{
  below.size = above.size = 0;
  bool hasBelow = false;
  bool hasAbove = false;
  const int planeTag = PlaneTag + axis;
  int here = this->SideOf(polygon.corner[0], axis, plane);
  for (int i = 0; i < polygon.size; ++i)
  {
    const Corner& corner = polygon.corner[i];
    const Corner& next = polygon.corner[i + 1 == polygon.size ? 0 : i + 1];
    const int there = this->SideOf(next, axis, plane);
    hasBelow |= here < 0;
    hasAbove |= here > 0;
    if (here != 0)
    {
      (here < 0 ? below : above).Push(corner.vertex, corner.tag);
    }
    else
    {
      this->ShareCorner(polygon, i, axis, plane, below, above);
    }
    if (here * there < 0)
    {
      const std::int32_t cut = corner.tag < PlaneTag
                                 ? this->CutMeshEdge(edge_[corner.tag], axis, plane)
                                 : this->CutPlaneEdge(corner, next, axis, plane, store);
      below.Push(cut, here < 0 ? planeTag : corner.tag);
      above.Push(cut, here < 0 ? corner.tag : planeTag);
    }
    here = there;
  }
  below.size = hasBelow ? below.size : 0;
  above.size = hasAbove ? above.size : 0;
}

std::int32_t TriangleClipper::CutMeshEdge(const Edge& edge, int axis, int plane)
{
  const Vec3& a = *edge.low;
  const Vec3& b = *edge.high;
  const double t = (plane - a[axis]) / (b[axis] - a[axis]);
  Vertex& cut = vertices_.emplace_back();
  cut.id = edge.firstCut[axis] + (plane - edge.planes[axis].first);
  for (int other = 0; other < 3; ++other)
  {
    cut.position[other] =
      other == axis ? plane : Snap(a[other] + t * (b[other] - a[other]), input_.tolerance);
    cut.weight[other] = 0.0;
  }
  cut.weight[edge.lowCorner] = 1.0 - t;
  cut.weight[edge.highCorner] = t;
  if (edge.isNamedHere)
  {
    const int opposite = 3 - edge.lowCorner - edge.highCorner;
    const bool isLowFirst = edge.lowCorner == (opposite + 1) % 3;
    PlaceCutPoint(cut.id,
      { static_cast<Index>(triangle_), opposite, isLowFirst ? 1.0 - t : t,
        isLowFirst ? t : 1.0 - t },
      input_, clipped_);
  }
  return static_cast<std::int32_t>(vertices_.size()) - 1;
}

TriangleClipper::Slot& TriangleClipper::InteriorSlot(int axisA, int planeA, int axisB, int planeB)
{
  const PlaneRange& a = planes_[axisA];
  const PlaneRange& b = planes_[axisB];
  // The margin of one plane on each side is needed because a triangle that only touches a plane can
  // still have a cut edge there.
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

std::int32_t TriangleClipper::CutPlaneEdge(
  const Corner& fromCorner, const Corner& toCorner, int axis, int plane, ClipBuffer& store)
{
  const int edgeAxis = fromCorner.tag - PlaneTag;
  const int edgePlane = static_cast<int>(vertices_[fromCorner.vertex].position[edgeAxis]);
  Slot& slot = this->InteriorSlot(edgeAxis, edgePlane, axis, plane);
  if (slot.stamp != triangle_)
  {
    slot = { triangle_, static_cast<std::int32_t>(vertices_.size()) };
    Vertex& cut = vertices_.emplace_back();
    const Vertex& from = vertices_[fromCorner.vertex];
    const Vertex& to = vertices_[toCorner.vertex];
    const double t = (plane - from.position[axis]) / (to.position[axis] - from.position[axis]);
    cut.id = -1 - static_cast<Index>(store.interior.size());
    for (int k = 0; k < 3; ++k)
    {
      cut.position[k] =
        k == axis ? plane
        : k == edgeAxis
          ? edgePlane
          : Snap(from.position[k] + t * (to.position[k] - from.position[k]), input_.tolerance);
      cut.weight[k] = from.weight[k] + t * (to.weight[k] - from.weight[k]);
    }
    store.interior.emplace_back(static_cast<Index>(triangle_), cut.weight);
  }
  return slot.vertex;
}

void TriangleClipper::Emit(const Polygon& polygon, ClipBuffer& store)
{
  Point low = vertices_[polygon.corner[0].vertex].position;
  for (int i = 1; i < polygon.size; ++i)
  {
    const Point& position = vertices_[polygon.corner[i].vertex].position;
    for (int axis = 0; axis < 3; ++axis)
    {
      low[axis] = std::min(low[axis], position[axis]);
    }
  }
  CellIndex cell;
  for (int axis = 0; axis < 3; ++axis)
  {
    cell[axis] = std::clamp(static_cast<int>(low[axis]), 0, input_.cellsPerSide - 1);
  }
  if (input_.region && !input_.region->Contains(cell))
  {
    return;
  }
  hasMovedPiece_ |= cell != slab_;
  const Index piece = store.Append(MortonEncode(cell), static_cast<Index>(triangle_), nextChunk_);
  const CellCode code = (CellCode{ cell[0] } << ShiftOf(0)) + (CellCode{ cell[1] } << ShiftOf(1)) +
                        (CellCode{ cell[2] } << ShiftOf(2));
  pieces_.emplace_back(code, piece, static_cast<int>(corners_.size()), polygon.size);
  for (int i = 0; i < polygon.size; ++i)
  {
    store.corner.push_back(vertices_[polygon.corner[i].vertex].id);
    corners_.emplace_back(polygon.corner[i].vertex, polygon.corner[i].tag);
  }
  store.cornerBegin.push_back(static_cast<Index>(store.corner.size()));
  this->NoteStretches(polygon, piece, store);
}

/// Stores the piece along each stretch of the triangle's sides. If rounding puts two pieces on one
/// stretch, they are linked, and the first stands for both.
void TriangleClipper::NoteStretches(const Polygon& polygon, Index piece, ClipBuffer& store)
{
  const Index number = store.NumberOf(piece);
  const auto inputs = static_cast<Index>(input_.position.size());
  for (int i = 0; i < polygon.size; ++i)
  {
    const int tag = polygon.corner[i].tag;
    if (tag >= PlaneTag || !edge_[tag].stretch)
    {
      continue;
    }
    const Edge& edge = edge_[tag];
    const bool isForward = edge.lowCorner == tag;
    const int near = isForward ? i : (i + 1 == polygon.size ? 0 : i + 1);
    const Index id = vertices_[polygon.corner[near].vertex].id;
    Index& known = edge.stretch[id < inputs ? 0 : edge.stride * (1 + id - edge.firstCut[0])];
    if (known < 0)
    {
      known = number;
    }
    else if (known != number)
    {
      store.links.emplace_back(known, number);
    }
  }
}

} // namespace gridfem
