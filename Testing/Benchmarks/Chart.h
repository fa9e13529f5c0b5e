// The content of a figure: panels of curves, or colored surfaces. Written as files that
// draw_figures.py turns into pictures.
#ifndef GridFEM_Benchmarks_Chart_h
#define GridFEM_Benchmarks_Chart_h

#include "Grid/TriangleMesh.h"

#include <string>
#include <vector>

namespace gridfem::benchmarks
{

struct Curve
{
  enum class Kind
  {
    Ours,
    Thesis, // the thesis' smoother, ten Gauss-Seidel sweeps, on the grid
    Peer,
    Reference
  };

  std::string name;
  Kind kind = Kind::Ours;
  std::vector<double> x;
  std::vector<double> y;
};

struct Panel
{
  std::string title;
  std::string xLabel;
  std::string yLabel;
  bool logarithmic = false; // y; values that are not positive are left out
  std::vector<Curve> curves;
};

struct Figure
{
  std::string name; // of the files
  std::vector<Panel> panels;
};

/// Curves against 0, 1, 2, ... (or from `first`).
Curve CountedCurve(
  const std::string& name, Curve::Kind kind, const std::vector<double>& y, int first = 0);

/// A surface colored by one value per point between 0 and `largest`.
struct ColoredSurface
{
  std::string title;
  TriangleMesh mesh;
  std::vector<double> value;
  double largest = 1.0;
};

/// <folder>/<name>.csv, one line per point of a curve: title, axes and scale of its panel, name and
/// kind of the curve, x, y. Throws std::runtime_error, as the next.
void WriteFigure(const Figure& figure, const std::string& folder);

/// <folder>/<name>-<k>.vtk, legacy format, with the point array `value`; title and largest value
/// stand in its title line.
void WriteSurfaces(
  const std::string& name, const std::vector<ColoredSurface>& surfaces, const std::string& folder);

} // namespace gridfem::benchmarks

#endif
