// Handles the pieces of a surface that several MPI ranks hold, with the space of all of them. No
// rank gathers the surface. Needs MPI.
#ifndef GridFEM_DistributedSurface_h
#define GridFEM_DistributedSurface_h

#include "InputArray.h"
#include "InputMesh.h"

#include "Problems/EdgeConditions.h"
#include "Spaces/SurfaceSpace.h"

#include "vtkSmartPointer.h"

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

class vtkAlgorithm;
class vtkDataArray;
class vtkPolyData;

namespace gridfem
{

class DistanceMethod;
class SelectedPoints;
struct GivenCells;
struct Grid;
struct MemoryNeed;
struct DistanceOptions;
struct SurfaceOptions;

/// Thrown on all ranks if one process has to compute on the whole surface: the parts of a triangle
/// with a hanging node may need a point of another rank.
struct NeedsWholeSurface : InvalidInput
{
  NeedsWholeSurface() : InvalidInput("The surface has hanging nodes, and ranks share it.") {}
};

/// The surface of all ranks. All functions but Free, IsUsed, Space, Area, Side, Depth, GridOfRanks,
/// NumberOfFunctions, Parts, CopiedTriangles, IsPieceRepeated, DataTypeOf, Numbers and WithCopies
/// are collective on the ranks of VTK's global controller. All but Run are called within Run. A
/// body that can throw on one rank alone is called within Together.
class DistributedSurface
{
public:
  DistributedSurface();
  ~DistributedSurface();

  using Body = std::function<void(const Progress& ofAll)>;

  /// Runs a body on all ranks. Its progress is aborted for all ranks or none. If it throws on one
  /// rank, all ranks throw: either Aborted on all, or the error on the first rank and
  /// FailedElsewhere on the others.
  void Run(const Progress& progress, const Body& body);

  void Together(const std::function<void()>& body) const;

  /// Throws on all ranks if the memory of one is not enough.
  void Require(const MemoryNeed& own) const;
  bool Any(bool holds) const;

  /// Reads this rank's piece, which may be null. Copies count once: cells that vtkGhostType marks
  /// as duplicates, and pieces that an earlier rank has, too.
  /// @param joinsSeams  gives points that coincide but for rounding the same coordinates. Throws
  ///   NeedsWholeSurface if there are hanging nodes.
  /// @return  the piece without the copies
  InputMesh ReadPieces(vtkPolyData* piece, bool joinsSeams, int threads);

  /// Reads the pieces and clips them.
  /// @param options  has the threads of one rank
  /// @param isClipped  the pieces are parts of a clip, whose grid and cells are taken
  /// (ReadGivenCells)
  /// @param mesh     gets the piece without the copies
  void BuildSpace(
    vtkPolyData* piece, const SurfaceOptions& options, bool isClipped, InputMesh& mesh);

  /// Returns the threads that a rank may use. Ranks share the threads of a machine.
  int ThreadsOfRank(int wanted) const;

  /// Tells the other ranks of the array that ranks with polygons have found. They get an array of
  /// zeros. Throws if the ranks' arrays do not fit each other.
  /// @param index  that of SetInputArrayToProcess
  void Agree(int index, InputArray& array);

  /// Returns the array that SetInputArrayToProcess(index, ...) names, agreed on by all ranks.
  /// @param mesh      comes from ReadPieces; a piece without triangles need not have the array
  /// @param property  the name in messages
  InputArray Find(vtkAlgorithm* filter, int index, vtkPolyData* piece, const InputMesh& mesh,
    const std::string& property);

  /// Returns the type of results for an agreed array, the same on all ranks.
  int DataTypeOf(int index) const;

  /// Replaces the numbers by the numbers of the first rank that has any.
  void Agree(std::vector<double>& numbers) const;

  /// Returns the largest number of all ranks. NaN if one is unknown, NaN or infinite.
  double Largest(double own) const;

  /// Sums numbers over the ranks; it has no rows.
  const DividedRows& Numbers() const;

  void Free();
  bool IsUsed() const { return space_ != nullptr; }
  const std::shared_ptr<const SurfaceSpace>& Space() const { return space_; }

  /// The area of the whole surface, and the longest side of the box around it, in world units.
  double Area() const { return area_; }
  double Side() const { return space_->UnitLength() * space_->Extent(); }

  /// The depth of the grid. It is coarser below hat functions that do not need it.
  int Depth() const { return this->GridOfRanks().depth; }
  const Grid& GridOfRanks() const;

  /// The number of functions of the finest level, on all ranks.
  Id NumberOfFunctions() const;

  /// Returns values on the whole piece.
  /// @param mesh  comes from ReadPieces
  InputMesh WithCopies(const InputMesh& mesh) const;

  /// Returns rows at this rank's points. Copies get the rows of the originals.
  void FillCopies(MultiVector& atPoints) const;

  /// Returns means on the cells of this rank's piece, and of copied cells as well.
  /// @param mesh  comes from BuildSpace
  MultiVector MeansOnCells(const InputMesh& mesh, const MultiVector& onTriangles, Id cells) const;

  /// A flag for each point of this rank: 1 if a function of any rank reaches it.
  std::vector<char> PointsWithFunctions() const;

  /// Values that are held at this rank's own points (HoldPointsAndEdges).
  HeldValues Hold(
    bool weldCoincidentPoints, const std::vector<Id>& points, const MultiVector& values) const;

  /// The terms that the boundary of the whole surface adds to an equation (TermsOnBoundary).
  BoundaryTerms OnBoundary(
    bool weldCoincidentPoints, const MultiVector* flux, const MultiVector* values) const;

  /// Returns the solver of distances from points of the ranks (RankDistance). It is valid as long
  /// as this space.
  /// @param mesh  comes from BuildSpace
  std::unique_ptr<DistanceMethod> MakeDistance(
    const InputMesh& mesh, const DistanceOptions& options, const Job& job) const;

  struct Internals;
  const Internals& Parts() const { return *ranks_; }
  const InputMesh& CopiedTriangles() const { return copies_; }
  /// Whether an earlier rank has this piece, too.
  bool IsPieceRepeated() const { return isRepeated_; }

private:
  std::shared_ptr<const GivenCells> ReadCells(vtkPolyData* piece, const InputMesh& mesh) const;

  struct StandIn
  {
    vtkSmartPointer<vtkDataArray> array; // for a rank without polygons
    int dataType = 0;                    // of the first rank that has the array
  };
  std::unique_ptr<Internals> ranks_; // while it runs or has a space
  std::shared_ptr<const SurfaceSpace> space_;
  Progress progress_;
  double area_ = 0.0;
  Id numberOfPoints_ = 0;
  Id numberOfCells_ = 0;
  InputMesh copies_;
  bool isRepeated_ = false;
  std::map<int, StandIn> arrays_; // by index
};

} // namespace gridfem

#endif
