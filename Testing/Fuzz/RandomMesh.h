// Small meshes of every kind that users might have. Most of them are bad.
#ifndef GridFEM_Testing_RandomMesh_h
#define GridFEM_Testing_RandomMesh_h

#include "Choice.h"
#include "Grid/TriangleMesh.h"

#include <string>

namespace gridfem::testing
{

struct RandomMesh
{
  std::string name; // describes how it was made
  TriangleMesh mesh;
};

/// Makes a random mesh. Some are invalid input: they have infinite or NaN coordinates, or corners
/// that do not exist.
RandomMesh MakeRandomMesh(Choice& choice);

} // namespace gridfem::testing

#endif
