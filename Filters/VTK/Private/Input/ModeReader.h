// Reads and writes the modes that Laplace Spectrum puts on a mesh.
#ifndef GridFEM_ModeReader_h
#define GridFEM_ModeReader_h

#include "Input/InputMesh.h"
#include "Solvers/Stages.h"

#include "Spectrum/SpectralDescriptors.h"

#include <string>

class vtkPolyData;

namespace gridfem
{

/// Returns the name of a mode's array: Mode000, Mode001, ...
std::string ModeName(int mode);

/// Whether the mesh has the field array Eigenvalues and the point array Mode000.
bool CarriesModes(vtkPolyData* input);

/// Removes all modes: the point arrays Mode, Mode000, ... and the field array Eigenvalues. Without
/// this field array, the point arrays are no modes and stay.
void RemoveModes(vtkPolyData* data);

/// Adds the arrays of the modes.
void AddModeArrays(StageKey& key, vtkPolyData* input);

/// Returns the modes on a mesh that carries them. They are 0 at points that no polygon uses. Throws
/// InvalidInput naming an array that is missing or does not fit, or the first point with a NaN or
/// infinite value.
PointModes ReadModes(vtkPolyData* input, const InputMesh& mesh);

} // namespace gridfem

#endif
