// Seconds of every stage of ours and of the peers, with the same surface and the same accuracy.
// They take turns in one process, so other work on the machine meets all of them.
#ifndef GridFEM_Benchmarks_PeerTimes_h
#define GridFEM_Benchmarks_PeerTimes_h

#include "SetupCost.h"

#include <array>
#include <string>
#include <vector>

namespace gridfem::benchmarks
{

/// The times. Every stage has the best time of the repetitions.
struct GridTimes
{
  double setup = 0.0;    // triangles to ready-to-solve hierarchy
  double plain = 0.0;    // the same on the plain space; 0: not run
  double metric = 0.0;   // metric of an embedding at every sample
  double values = 0.0;   // new metric at every sample to ready-to-solve hierarchy
  double weights = 0.0;  // new weights for every patch and direction to ready-to-solve hierarchy
  double lambda = 0.0;   // new λ to ready-to-solve hierarchy
  double load = 0.0;     // one right-hand side from values at the points
  double load3 = 0.0;    // three
  double solve = 0.0;    // one column to the error of the comparison
  double solve3 = 0.0;   // three
  double cycle = 0.0;    // one cycle
  double evaluate = 0.0; // values at the points
  double FromMesh() const { return setup + load + solve + evaluate; }

  double iterations = -1.0; // fewest to the error; 0: the start and its correction
  double iterations3 = -1.0;
  double functions = 0.0;
  double clippedTriangles = 0.0;
};

struct AmgTimes
{
  double setup = 0.0;
  double solve = 0.0;
  double iterations = 0.0;
};

struct CholmodTimes
{
  double analyze = 0.0;
  double factor = 0.0;
  double solve = 0.0;  // one column
  double solve3 = 0.0; // three columns in one call
};

struct PeerTimes
{
  double vertices = 0.0;
  double assembly = 0.0;               // of the hat system, one thread
  double load = 0.0;                   // one right-hand side of it
  std::array<GridTimes, 2> grid;       // one thread, two threads
  std::array<CholmodTimes, 2> cholmod; // its BLAS on one thread, on two
  AmgTimes boomerAmg;                  // one process
  AmgTimes gamg;

  const AmgTimes& FasterSolve() const;
  /// Seconds from the mesh to values at its points of the faster one.
  double FasterFromMesh() const;
};

struct PeerJob
{
  NamedMesh mesh;
  int depth = 8;
  double error = 1e-4; // L2 over the surface, relative
  int repetitions = 3;
};

/// In a process of its own.
PeerTimes MeasurePeers(const PeerJob& job);

/// A table of everything.
void PrintPeers(const PeerJob& job, const PeerTimes& times);

} // namespace gridfem::benchmarks

#endif
