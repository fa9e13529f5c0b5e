// Small meshes of every kind that somebody might have, most of them bad.
#ifndef GridFEM_Testing_RandomMesh_h
#define GridFEM_Testing_RandomMesh_h

#include "Choice.h"
#include "Grid/TriangleMesh.h"

#include <string>

namespace gridfem::testing
{

struct RandomMesh
{
  std::string name; // how it was made
  TriangleMesh mesh;
};

/// Some are no valid input: they have numbers that are not finite, or corners that do not exist.
RandomMesh MakeRandomMesh(Choice& choice);

} // namespace gridfem::testing

#endif
