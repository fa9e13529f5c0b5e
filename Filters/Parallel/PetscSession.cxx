#include "Parallel/PetscSession.h"

#include <string>

namespace gridfem
{

namespace
{

/// MPI calls this first of all when it ends.
int EndPetsc(MPI_Comm, int, void*, void*)
{
  PetscBool isEnded = PETSC_FALSE;
  PetscFinalized(&isEnded);
  if (!isEnded)
  {
    PetscFinalize();
  }
  return MPI_SUCCESS;
}

/// Errors are thrown where Check sees them; nothing is printed on the way.
PetscErrorCode KeepSilent(
  MPI_Comm, int, const char*, const char*, PetscErrorCode code, PetscErrorType, const char*, void*)
{
  return code;
}

} // namespace

void Check(PetscErrorCode code)
{
  if (code)
  {
    const char* text = nullptr;
    PetscErrorMessage(code, &text, nullptr);
    throw PetscFailure(
      code, "PETSc: " + std::string(text ? text : "error") + " (" + std::to_string(code) + ")");
  }
}

void StartPetsc(const Communicator& ranks)
{
  PetscBool isRunning = PETSC_FALSE;
  Check(PetscInitialized(&isRunning));
  if (isRunning)
  {
    return;
  }
  PETSC_COMM_WORLD = ranks.Handle();
  Check(PetscOptionsSetValue(nullptr, "-skip_petscrc", "1"));
  Check(PetscOptionsSetValue(nullptr, "-no_signal_handler", "1"));
  Check(PetscInitializeNoArguments());
  Check(PetscPushErrorHandler(KeepSilent, nullptr));
  int key = MPI_KEYVAL_INVALID;
  MPI_Comm_create_keyval(MPI_COMM_NULL_COPY_FN, EndPetsc, &key, nullptr);
  MPI_Comm_set_attr(MPI_COMM_SELF, key, nullptr);
  MPI_Comm_free_keyval(&key);
}

} // namespace gridfem
