#include "Shape/ConnectedTriangles.h"

namespace gridfem
{

void ConnectedTriangles::Add(const std::array<Index, 3>& corners)
{
  places.push_back(corners);
  twin.insert(twin.end(), 3, -1);
}

void ConnectedTriangles::Connect(HalfEdge a, HalfEdge b)
{
  twin[a] = b;
  twin[b] = a;
}

void ConnectedTriangles::Cut(HalfEdge h)
{
  if (twin[h] >= 0)
  {
    twin[twin[h]] = -1;
    twin[h] = -1;
  }
}

HalfEdge ConnectedTriangles::NextOnBoundary(HalfEdge h) const
{
  HalfEdge next = Next(h);
  while (twin[next] >= 0)
  {
    next = Next(twin[next]);
  }
  return next;
}

VertexNumbers NumberVertices(const ConnectedTriangles& triangles)
{
  VertexNumbers vertices;
  vertices.ofCorner.assign(triangles.twin.size(), -1);
  for (HalfEdge first = 0; first < static_cast<HalfEdge>(triangles.twin.size()); ++first)
  {
    if (vertices.ofCorner[first] >= 0)
    {
      continue;
    }
    const Index vertex = vertices.count++;
    HalfEdge h = first; // leaves the vertex
    do
    {
      vertices.ofCorner[h] = vertex;
      h = triangles.twin[ConnectedTriangles::Previous(h)];
    } while (h >= 0 && h != first);
    if (h < 0) // the boundary: the other way round
    {
      for (h = triangles.twin[first]; h >= 0; h = triangles.twin[h])
      {
        h = ConnectedTriangles::Next(h);
        vertices.ofCorner[h] = vertex;
      }
    }
  }
  return vertices;
}

std::vector<std::vector<HalfEdge>> BoundaryLoops(const ConnectedTriangles& triangles)
{
  std::vector<std::vector<HalfEdge>> loops;
  std::vector<char> isDone(triangles.twin.size(), 0);
  for (HalfEdge first = 0; first < static_cast<HalfEdge>(triangles.twin.size()); ++first)
  {
    if (triangles.twin[first] >= 0 || isDone[first])
    {
      continue;
    }
    loops.emplace_back();
    for (HalfEdge h = first; !isDone[h]; h = triangles.NextOnBoundary(h))
    {
      isDone[h] = 1;
      loops.back().push_back(h);
    }
  }
  return loops;
}

} // namespace gridfem
