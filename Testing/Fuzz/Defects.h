// Makes clean surfaces, and the same surfaces with defects as in files. The defects are seams that
// rounding left open, hanging nodes, turned and repeated triangles, and points of parts that were
// cut away.
#ifndef GridFEM_Testing_Defects_h
#define GridFEM_Testing_Defects_h

#include "Choice.h"
#include "Grid/TriangleMesh.h"

#include <string>

namespace gridfem::testing
{

/// The defects to make.
struct Defects
{
  bool hasSeams = false; // parts with points of their own, which coincide except for rounding
  bool hasHangingNodes = false; // parts that are finer than their neighbors
  bool isTurned = false;        // some triangles are turned over
  bool hasCopies = false;       // some triangles are repeated, as they are or turned over
  bool isMasked = false;        // the surface is a part of a larger one, whose points remain
};

/// A surface and its defective version. Both have been through the steps that every input goes
/// through: DropCopies and JoinSeams.
struct DefectivePair
{
  std::string description;
  TriangleMesh clean;
  TriangleMesh defective;
  MultiVector values;             // two columns at the points of `clean`
  MultiVector defectiveValues;    // the same functions at the points of `defective`
  std::vector<Id> defectivePoint; // of each point of `clean`: one of the points in its place
  bool isAligned = false;         // with the axes, so that flat parts may lie in a face of the grid
  TriangleMesh fine; // with hanging nodes: as fine as the finest part; begins with `clean`
  MultiVector fineValues;
};

DefectivePair MakeDefectivePair(Choice& choice, const Defects& defects);

} // namespace gridfem::testing

#endif
