// The figures of the thesis' chapters 4 and 6.2.2, computed again. Each function writes the input
// of draw_figures.py into a folder. The figures have the thesis' numbers.
#ifndef GridFEM_Benchmarks_Figures_h
#define GridFEM_Benchmarks_Figures_h

#include "Chart.h"

#include <string>

namespace gridfem::benchmarks
{

void WriteQuadratureFigure(const std::string& folder);  // 4.4
void WriteRigidMotionFigure(const std::string& folder); // 4.5
void WriteCotangentFigure(const std::string& folder);   // 4.6 and Table 4.3
void WriteHatConvergence(const std::string& folder);    // 4.7, 4.9, 4.10
void WriteGridConvergence(const std::string& folder);   // 4.8
void WriteRotatedCubes(const std::string& folder);      // 4.11, 4.12
void WriteErrorMaps(const std::string& folder);         // 4.13
void WriteSeparatedCubes(const std::string& folder);    // 6.5, 6.6
void WriteKnotConvergence(const std::string& folder);   // 6.7

} // namespace gridfem::benchmarks

#endif
