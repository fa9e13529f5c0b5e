// The mesh of the main job, and the function on it that the job smooths.
#ifndef GridFEM_Examples_MeshInput_h
#define GridFEM_Examples_MeshInput_h

#include <vtkAlgorithm.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <string>

/// The endings that FindReader knows, in words for the user.
constexpr const char* MeshFileEndings = ".ply .obj .stl .vtp .vtk";

/// Returns VTK's reader for a file, chosen by the ending of its name, in upper or lower case. Null
/// for an ending that is not in MeshFileEndings.
vtkSmartPointer<vtkAlgorithm> FindReader(const std::string& path);

/// Chooses the function that the screened Poisson equation smooths. If the mesh has point scalars,
/// such as the colors of a scan, they are the function. Otherwise the function adds `Stripes` along
/// the longest side to the mesh. Scalars of one component get noise, like a measured value.
/// @return  the name of the point array
std::string AddArrayToSmooth(vtkPolyData* mesh);

#endif
