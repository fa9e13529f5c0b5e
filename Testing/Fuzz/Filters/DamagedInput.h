// Filters on damaged data: saved bases, cell arrays, selections, and messages between ranks. Every
// case must be refused with one message, or give the right result. It must never crash.
#ifndef GridFEM_Testing_DamagedInput_h
#define GridFEM_Testing_DamagedInput_h

#include "../Choice.h"

#include <string>
#include <vector>

class vtkAlgorithm;
class vtkDataArray;

namespace gridfem::testing
{

/// The course of one case.
struct DamagedCase
{
  std::string description;         // what was damaged, and how
  std::string refusal;             // the message; empty if there is a result
  std::vector<std::string> broken; // violated requirements

  void Require(bool holds, const std::string& what)
  {
    if (!holds)
    {
      broken.push_back(what);
    }
  }
};

/// Runs a filter. A failure must give one message and empty outputs.
/// @return  whether there is a result
bool RunOnDamaged(vtkAlgorithm* filter, DamagedCase& outcome);

/// Changes a few values or the size of an array of type double, in range and out of range.
void DamageArray(Choice& choice, vtkDataArray* array, DamagedCase& outcome);

///@{ Each makes one random case.
void SolveOnDamagedBasis(Choice& choice, DamagedCase& outcome);
void RunOnDamagedCells(Choice& choice, DamagedCase& outcome);
void SelectByDamagedNodes(Choice& choice, DamagedCase& outcome);
void TakeDamagedMessage(Choice& choice, DamagedCase& outcome);
///@}

} // namespace gridfem::testing

#endif
