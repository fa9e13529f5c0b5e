// PETSc as the ranks use it: started on their communicator, its errors thrown, its objects owned.
#ifndef GridFEM_PetscSession_h
#define GridFEM_PetscSession_h

#include "Parallel/Communicator.h"

#include <petscksp.h>

#include <utility>

namespace gridfem
{

/// Collective. Starts PETSc on these ranks, unless it runs already: without its handlers of signals
/// and of errors, and without options from the outside. It ends before MPI does.
void StartPetsc(const Communicator& ranks);

/// What PETSc has returned.
struct PetscFailure : std::runtime_error
{
  PetscFailure(PetscErrorCode returned, const std::string& words)
    : std::runtime_error(words), code(returned)
  {
  }
  PetscErrorCode code;
};

/// Throws PetscFailure with PETSc's words.
void Check(PetscErrorCode code);

/// Owns an object of PETSc.
template<class Object, PetscErrorCode (*Destroy)(Object*)>
class PetscHandle
{
public:
  PetscHandle() = default;
  PetscHandle(PetscHandle&& other) noexcept : object_(std::exchange(other.object_, nullptr)) {}
  PetscHandle& operator=(PetscHandle&& other) noexcept
  {
    std::swap(object_, other.object_);
    return *this;
  }
  ~PetscHandle()
  {
    if (object_)
    {
      Destroy(&object_);
    }
  }

  /// For functions that make an object; there must be none yet.
  Object* Receive() { return &object_; }
  operator Object() const { return object_; }

private:
  Object object_ = nullptr;
};

using PetscMatrix = PetscHandle<Mat, MatDestroy>;
using PetscVector = PetscHandle<Vec, VecDestroy>;
using PetscScatter = PetscHandle<VecScatter, VecScatterDestroy>;
using PetscIndices = PetscHandle<IS, ISDestroy>;
using PetscSolver = PetscHandle<KSP, KSPDestroy>;
using PetscCycle = PetscHandle<PC, PCDestroy>;

/// The own entries of a vector while this lives.
class VectorEntries
{
public:
  explicit VectorEntries(Vec vector) : vector_(vector) { Check(VecGetArray(vector, &entries_)); }
  ~VectorEntries() { VecRestoreArray(vector_, &entries_); }
  VectorEntries(const VectorEntries&) = delete;
  VectorEntries& operator=(const VectorEntries&) = delete;
  PetscScalar& operator[](Id k) { return entries_[k]; }

private:
  Vec vector_;
  PetscScalar* entries_ = nullptr;
};

} // namespace gridfem

#endif
