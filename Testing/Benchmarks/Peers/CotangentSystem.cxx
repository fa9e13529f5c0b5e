#include "CotangentSystem.h"

#include <algorithm>

namespace gridfem::benchmarks
{

namespace
{

struct Entry
{
  int column;
  double mass;
  double stiffness;
};

/// Entries of one row while it is summed up; a dozen of them, so that searching is cheap.
class Row
{
public:
  void Add(int column, double mass, double stiffness)
  {
    const auto found = std::find_if(
      entries_.begin(), entries_.end(), [&](const Entry& entry) { return entry.column == column; });
    if (found == entries_.end())
    {
      entries_.push_back({ column, mass, stiffness });
      return;
    }
    found->mass += mass;
    found->stiffness += stiffness;
  }

  std::vector<Entry>& Sorted()
  {
    std::sort(entries_.begin(), entries_.end(),
      [](const Entry& a, const Entry& b) { return a.column < b.column; });
    return entries_;
  }

private:
  std::vector<Entry> entries_;
};

/// Triangles around each row: triangle[begin[r] .. begin[r + 1]), as 3 t + corner.
struct Fans
{
  std::vector<int> begin;
  std::vector<int> corner;
};

Fans FindFans(const TriangleMesh& mesh, const std::vector<int>& row, int rows)
{
  Fans fans{ std::vector<int>(rows + 1, 0), std::vector<int>(3 * mesh.triangles.size()) };
  for (const auto& triangle : mesh.triangles)
  {
    for (const Id point : triangle)
    {
      ++fans.begin[row[point] + 1];
    }
  }
  for (int r = 0; r < rows; ++r)
  {
    fans.begin[r + 1] += fans.begin[r];
  }
  std::vector<int> next(fans.begin.begin(), fans.begin.end() - 1);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    for (int c = 0; c < 3; ++c)
    {
      fans.corner[next[row[mesh.triangles[t][c]]]++] = static_cast<int>(3 * t + c);
    }
  }
  return fans;
}

/// Used points in the order of the mesh.
std::vector<int> NumberRows(const TriangleMesh& mesh, int& rows)
{
  std::vector<int> row(mesh.points.size(), -1);
  for (const auto& triangle : mesh.triangles)
  {
    for (const Id point : triangle)
    {
      row[point] = 0;
    }
  }
  rows = 0;
  for (int& r : row)
  {
    r = r < 0 ? r : rows++;
  }
  return row;
}

/// Contributions of one triangle to the row of one of its corners.
void AddCorner(
  const TriangleMesh& mesh, const std::vector<int>& rowOf, int triangle, int corner, Row& row)
{
  const auto& points = mesh.triangles[triangle];
  const Id a = points[corner];
  const Id b = points[(corner + 1) % 3];
  const Id c = points[(corner + 2) % 3];
  const Vec3 opposite = mesh.points[c] - mesh.points[b];
  const Vec3 toB = mesh.points[b] - mesh.points[a];
  const Vec3 toC = mesh.points[c] - mesh.points[a];
  const double twiceArea = toB.cross(toC).norm();
  if (!(twiceArea > 0.0))
  {
    row.Add(rowOf[a], 0.0, 0.0);
    return;
  }
  // The gradient of a hat is the opposite edge turned by 90 degrees over twice the area.
  const double scale = 0.5 / twiceArea;
  row.Add(rowOf[a], twiceArea / 12.0, scale * opposite.squaredNorm());
  row.Add(rowOf[b], twiceArea / 24.0, -scale * opposite.dot(toC));
  row.Add(rowOf[c], twiceArea / 24.0, scale * opposite.dot(toB));
}

} // namespace

CotangentSystem AssembleCotangents(const TriangleMesh& mesh)
{
  CotangentSystem hats;
  int rows = 0;
  hats.row = NumberRows(mesh, rows);
  const Fans fans = FindFans(mesh, hats.row, rows);
  // Closed surfaces have half as many vertices as triangles and seven entries per row.
  const std::size_t guess = rows + 3 * mesh.triangles.size() + 1024;
  SymmetricMatrix& mass = hats.mass;
  SymmetricMatrix& stiffness = hats.stiffness;
  for (SymmetricMatrix* matrix : { &mass, &stiffness })
  {
    matrix->resize(rows, rows);
    matrix->reserve(static_cast<Eigen::Index>(guess));
  }
  Row row;
  for (int r = 0; r < rows; ++r)
  {
    mass.startVec(r);
    stiffness.startVec(r);
    for (int k = fans.begin[r]; k < fans.begin[r + 1]; ++k)
    {
      AddCorner(mesh, hats.row, fans.corner[k] / 3, fans.corner[k] % 3, row);
    }
    for (const Entry& entry : row.Sorted())
    {
      mass.insertBack(entry.column, r) = entry.mass;
      stiffness.insertBack(entry.column, r) = entry.stiffness;
    }
    row.Sorted().clear();
  }
  mass.finalize();
  stiffness.finalize();
  return hats;
}

SymmetricMatrix Combine(const CotangentSystem& hats, double lambda)
{
  SymmetricMatrix matrix = hats.stiffness;
  for (Eigen::Index k = 0; k < matrix.nonZeros(); ++k)
  {
    matrix.valuePtr()[k] += lambda * hats.mass.valuePtr()[k];
  }
  return matrix;
}

Eigen::MatrixXd ToRows(const CotangentSystem& hats, const MultiVector& values)
{
  Eigen::MatrixXd rows(hats.mass.rows(), values.cols());
  for (std::size_t point = 0; point < hats.row.size(); ++point)
  {
    if (hats.row[point] >= 0)
    {
      rows.row(hats.row[point]) = values.row(static_cast<Id>(point));
    }
  }
  return rows;
}

} // namespace gridfem::benchmarks
