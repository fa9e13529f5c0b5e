#include "Chart.h"

#include <fstream>
#include <stdexcept>

namespace gridfem::benchmarks
{

Curve CountedCurve(
  const std::string& name, Curve::Kind kind, const std::vector<double>& y, int first)
{
  Curve curve{ name, kind, {}, y };
  for (std::size_t k = 0; k < y.size(); ++k)
  {
    curve.x.push_back(first + static_cast<double>(k));
  }
  return curve;
}

namespace
{

std::ofstream Open(const std::string& name)
{
  std::ofstream file(name);
  file.precision(8);
  if (!file)
  {
    throw std::runtime_error("Could not write " + name);
  }
  return file;
}

std::string Quoted(const std::string& text)
{
  return '"' + text + "\",";
}

const char* NameOf(Curve::Kind kind)
{
  constexpr const char* Names[] = { "ours", "thesis", "peer", "reference" };
  return Names[static_cast<int>(kind)];
}

} // namespace

void WriteFigure(const Figure& figure, const std::string& folder)
{
  std::ofstream file = Open(folder + "/" + figure.name + ".csv");
  file << "panel,x axis,y axis,logarithmic,curve,kind,x,y\n";
  for (const Panel& panel : figure.panels)
  {
    for (const Curve& curve : panel.curves)
    {
      const std::string start = Quoted(panel.title) + Quoted(panel.xLabel) + Quoted(panel.yLabel) +
                                (panel.logarithmic ? "1," : "0,") + Quoted(curve.name) +
                                NameOf(curve.kind) + ',';
      for (std::size_t k = 0; k < curve.x.size(); ++k)
      {
        file << start << curve.x[k] << ',' << curve.y[k] << '\n';
      }
    }
  }
}

void WriteSurfaces(
  const std::string& name, const std::vector<ColoredSurface>& surfaces, const std::string& folder)
{
  for (std::size_t k = 0; k < surfaces.size(); ++k)
  {
    const ColoredSurface& surface = surfaces[k];
    std::ofstream file = Open(folder + "/" + name + "-" + std::to_string(k) + ".vtk");
    file << "# vtk DataFile Version 3.0\n"
         << surface.largest << ' ' << surface.title << "\nASCII\nDATASET POLYDATA\nPOINTS "
         << surface.mesh.points.size() << " double\n";
    for (const Vec3& point : surface.mesh.points)
    {
      file << point.transpose() << '\n';
    }
    const std::size_t triangles = surface.mesh.triangles.size();
    file << "POLYGONS " << triangles << ' ' << 4 * triangles << '\n';
    for (const auto& corners : surface.mesh.triangles)
    {
      file << "3 " << corners[0] << ' ' << corners[1] << ' ' << corners[2] << '\n';
    }
    file << "POINT_DATA " << surface.value.size()
         << "\nSCALARS value double 1\nLOOKUP_TABLE default\n";
    for (const double value : surface.value)
    {
      file << value << '\n';
    }
  }
}

} // namespace gridfem::benchmarks
