// The pieces of a surface that several MPI ranks hold, none of which gathers it, with the space of
// all of them. Without MPI there is no such way.
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

/// All functions but Free, IsUsed, Space, Area, Side, Depth, GridOfRanks, NumberOfFunctions, Parts,
/// CopiedTriangles, IsPieceRepeated, DataTypeOf, Numbers and WithCopies are collective, on the
/// ranks of VTK's global controller, and but Run are called within Run. What throws on one rank
/// alone is called within Together.
class DistributedSurface
{
public:
  DistributedSurface();
  ~DistributedSurface();

  using Body = std::function<void(const Progress& ofAll)>;

  /// Runs a body on all ranks, with a progress that is aborted for all or none. Throws on all when
  /// it throws on one: Aborted on all, or the error on the first rank and FailedElsewhere on the
  /// others.
  void Run(const Progress& progress, const Body& body);

  void Together(const std::function<void()>& body) const;

  /// Throws on all ranks where the memory of one is not enough.
  void Require(const MemoryNeed& own) const;
  bool Any(bool holds) const;

  /// Reads this rank's piece, which may be null. Cells that vtkGhostType marks as duplicates, and
  /// pieces that an earlier rank has, too, are copies: they count once.
  /// @return  the piece without the copies
  InputMesh ReadPieces(vtkPolyData* piece, int threads);

  /// Reads the pieces and clips them.
  /// @param options  threads are those of a rank
  /// @param isClipped  the pieces are parts of a clip, whose grid and cells are taken
  /// (ReadGivenCells)
  /// @param mesh     gets the piece without the copies
  void BuildSpace(
    vtkPolyData* piece, const SurfaceOptions& options, bool isClipped, InputMesh& mesh);

  /// The threads that a rank may use: those of a machine are shared.
  int ThreadsOfRank(int wanted) const;

  /// What ranks with polygons have found becomes known on the others, as an array of zeros. Throws
  /// where the ranks' arrays do not fit each other.
  /// @param index  that of SetInputArrayToProcess
  void Agree(int index, InputArray& array);

  /// The array that SetInputArrayToProcess(index, ...) names, agreed on.
  /// @param mesh      as ReadPieces has given it; without triangles the piece need not have the
  /// array
  /// @param property  the name that messages give
  InputArray Find(vtkAlgorithm* filter, int index, vtkPolyData* piece, const InputMesh& mesh,
    const std::string& property);

  /// Of an agreed array that there is: the type that results have on all ranks.
  int DataTypeOf(int index) const;

  /// Numbers become those of the first rank that has any.
  void Agree(std::vector<double>& numbers) const;

  /// The largest number of all ranks; NaN where one is unknown, NaN or infinite.
  double Largest(double own) const;

  /// For sums over ranks; without rows.
  const DividedRows& Numbers() const;

  void Free();
  bool IsUsed() const { return space_ != nullptr; }
  const std::shared_ptr<const SurfaceSpace>& Space() const { return space_; }

  /// Of the whole surface; and the longest side of the box around it, world units.
  double Area() const { return area_; }
  double Side() const { return space_->UnitLength() * space_->Extent(); }

  /// Of the grid, which is coarser below hat functions that do not need it.
  int Depth() const { return this->GridOfRanks().depth; }
  const Grid& GridOfRanks() const;

  /// Functions of the finest level, on all ranks.
  Id NumberOfFunctions() const;

  /// The whole piece.
  /// @param mesh  as ReadPieces has given it
  InputMesh WithCopies(const InputMesh& mesh) const;

  /// Rows at this rank's points: those of copies become those of the originals.
  void FillCopies(MultiVector& atPoints) const;

  /// Means on the cells of this rank's piece, those of copies as well.
  /// @param mesh  as BuildSpace has given it
  MultiVector MeansOnCells(const InputMesh& mesh, const MultiVector& onTriangles, Id cells) const;

  /// Per point of this rank: 1 where a function of any rank reaches it.
  std::vector<char> PointsWithFunctions() const;

  /// Values that are held at this rank's own points (HoldPoints).
  HeldValues Hold(const std::vector<Id>& points, const MultiVector& values) const;

  /// What the boundary of the whole adds to an equation (TermsOnBoundary).
  BoundaryTerms OnBoundary(
    bool weldCoincidentPoints, const MultiVector* flux, const MultiVector* values) const;

  /// Distances from points of the ranks (RankDistance), as long as there is this space.
  /// @param mesh  as BuildSpace has given it
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
  std::unique_ptr<Internals> ranks_; // while it runs, and as long as there is a space
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
