// Names of ParaView that differ between the versions 5.11 to 6.1.
#ifndef GridFEM_ParaViewVersions_h
#define GridFEM_ParaViewVersions_h

#include "vtkSMTransferFunctionPresets.h"

#if __has_include("vtkSMColorMapEditorHelper.h")
#include "vtkSMColorMapEditorHelper.h"
#else
#include "vtkSMPVRepresentationProxy.h"
#endif

namespace gridfem
{

/// Static functions that color a representation by an array and show its color bar.
#if __has_include("vtkSMColorMapEditorHelper.h")
using Coloring = vtkSMColorMapEditorHelper; // ParaView 5.13 and newer
#else
using Coloring = vtkSMPVRepresentationProxy;
#endif

/// The name of ParaView's preset of the colors Viridis, which ParaView 6 has shortened.
inline const char* ViridisPreset()
{
  const bool isShort = vtkSMTransferFunctionPresets::GetInstance()->HasPreset("Viridis");
  return isShort ? "Viridis" : "Viridis (matplotlib)";
}

} // namespace gridfem

#endif
