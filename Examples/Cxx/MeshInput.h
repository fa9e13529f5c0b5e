// Where the main job gets its mesh, and what it smooths on it.
#ifndef GridFEM_Examples_MeshInput_h
#define GridFEM_Examples_MeshInput_h

#include <vtkAlgorithm.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <string>

/// The endings FindReader knows, as it is said to a user.
constexpr const char* MeshFileEndings = ".ply .obj .stl .vtp .vtk";

/// VTK's reader for a file, chosen by the ending of its name (in any case of letters); null for an
/// ending that is not in MeshFileEndings.
vtkSmartPointer<vtkAlgorithm> FindReader(const std::string& path);

/// Chooses what the screened Poisson equation smooths, and adds it to the mesh if need be:
/// the mesh's own point scalars when it has some (a scan's colours); else `Stripes` along its
/// longest side. Scalars of one component get noise, as a measured value would have.
/// @return  the name of the point array
std::string AddArrayToSmooth(vtkPolyData* mesh);

#endif
