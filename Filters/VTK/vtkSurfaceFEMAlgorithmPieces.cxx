// The runs of a filter whose surface consists of pieces, or that has several surfaces: blocks of
// composite data, or the pieces of MPI ranks.
#include "vtkSurfaceFEMAlgorithm.h"

#include "Input/InputArray.h"
#include "Input/InputBlocks.h"
#include "Input/InputValidation.h"
#include "Input/SurfaceInput.h"
#include "Output/BlockTables.h"
#include "Output/SolverOutput.h"
#include "Pieces/CanDistribute.h"
#include "Pieces/GatheredOutput.h"
#include "Pieces/GatheredRanks.h"
#include "Pieces/JoinedBlocks.h"
#include "Pieces/Ranks.h"
#include "Pipeline/FilterState.h"
#include "Pipeline/PipelineTime.h"

#include "vtkCompositeDataSet.h"
#include "vtkErrorCode.h"
#include "vtkExecutive.h"
#include "vtkInformationVector.h"
#include "vtkPolyData.h"

namespace
{

/// Makes the input the first output. The other outputs are empty.
void PassOn(vtkInformationVector* input, vtkInformationVector* outputs)
{
  gridfem::EmptyOutputs(outputs);
  vtkPolyData::GetData(outputs)->ShallowCopy(vtkPolyData::GetData(input));
}

} // namespace

/// Prepares a run on all blocks. The pipeline also calls it for every block.
void vtkSurfaceFEMAlgorithm::BeginBlocks()
{
  this->Tables->PutBack(this->GetExecutive()->GetOutputInformation());
  vtkInformationVector** inputs = this->GetExecutive()->GetInputInformation();
  if (this->Blocks->Begin(inputs, this->GetNumberOfInputPorts()))
  {
    this->SetErrorCode(vtkErrorCode::NoError);
    this->IsBlockAborted = false;
  }
}

/// Ends a run on all blocks. The pipeline also calls it for every block. A run may find other time
/// steps. For composite data, the pipeline passes on the input's times once more after the last
/// block.
void vtkSurfaceFEMAlgorithm::EndBlocks()
{
  vtkInformationVector* outputs = this->GetExecutive()->GetOutputInformation();
  if (this->Blocks->End())
  {
    this->Joined->Finish(this->KeepsStages());
    if (this->IsBlockAborted)
    {
      gridfem::EmptyOutputs(outputs);
    }
    this->Tables->Exchange(outputs);
  }
  const std::vector<double> steps = this->TimeSteps();
  if (!steps.empty())
  {
    gridfem::SetTimeSteps(steps, outputs);
  }
}

/// Computes on a surface that is not joined: the input, or one block of it.
void vtkSurfaceFEMAlgorithm::ComputeAlone(
  vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkInformationVector** surfaces = this->Surface->Of(inputs, this->GetNumberOfInputPorts());
  try
  {
    this->ComputeSurface(surfaces, outputs);
  }
  catch (const gridfem::MissingArray& error)
  {
    if (!this->Blocks->AnyHas(error))
    {
      throw;
    }
    PassOn(surfaces[0], outputs);
    vtkWarningMacro("A block has no array '" << error.array << "'. It is output unchanged.");
  }
  catch (const gridfem::MissingChoice& choice)
  {
    PassOn(surfaces[0], outputs);
    vtkWarningMacro(<< choice.what() << " Until then the output is the input.");
  }
  gridfem::StampTime(!this->OwnTimeSteps().empty(), inputs[0], outputs);
}

/// Computes one block of a surface of several blocks. The first block computes for all.
void vtkSurfaceFEMAlgorithm::ComputeBlock(
  vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  if (!this->Joined->HasStarted())
  {
    this->Joined->Start(outputs);
    try
    {
      this->ComputeJoinedBlocks(inputs);
    }
    catch (...)
    {
      this->Joined->Fail(std::current_exception());
      throw;
    }
  }
  this->Joined->HandBack(vtkDataSet::GetData(inputs[0]), outputs);
  gridfem::StampTime(!this->OwnTimeSteps().empty(), inputs[0], outputs);
}

void vtkSurfaceFEMAlgorithm::ComputeJoinedBlocks(vtkInformationVector** inputs)
{
  gridfem::JoinedBlocks& joined = *this->Joined;
  vtkCompositeDataSet* whole = this->Blocks->Whole();
  const int ports = this->GetNumberOfInputPorts();
  const int count = gridfem::JoinedBlocks::CountBlocks(whole);
  if (gridfem::Ranks::AreSeveral())
  {
    this->Blocks->RequireAligned();
    const gridfem::Ranks ranks;
    const bool isShared = ranks.Number(count > 0) > 1 || count > 1;
    vtkInformationVector** surfaces = nullptr;
    ranks.Together(
      [&]
      {
        joined.Read(whole, isShared);
        surfaces = joined.Inputs(inputs, ports, this->WeldCoincidentPoints);
      });
    this->ComputeOnRanks(surfaces, joined.Results());
    return;
  }
  gridfem::RequireFurtherInputs(inputs, ports);
  joined.Read(whole, count > 1);
  while (!joined.IsEmpty())
  {
    vtkInformationVector** surfaces = joined.Inputs(inputs, ports, this->WeldCoincidentPoints);
    try
    {
      this->ComputeSurface(surfaces, joined.Results());
      return;
    }
    catch (const gridfem::MissingArray& error)
    {
      const std::vector<std::string> without = joined.LeaveOut(error.array);
      if (without.empty())
      {
        gridfem::ThrowWithPartialArrays(error, joined.Surface());
      }
      for (const std::string& block : without)
      {
        vtkWarningMacro("The surface does not include " << block << ", because it has no array '"
                                                        << error.array
                                                        << "'. It is output unchanged.");
      }
    }
  }
}

/// Computes on several MPI ranks. All of them call it, also those without a piece of the surface.
void vtkSurfaceFEMAlgorithm::ComputeOnRanks(
  vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  this->Blocks->RequireAligned();
  const gridfem::Ranks ranks;
  if (ranks.Any(this->GetAbortExecute() != 0))
  {
    throw gridfem::Aborted();
  }
  vtkInformationVector** surfaces = inputs;
  vtkDataSet* piece = vtkDataSet::GetData(inputs[0]);
  const bool isShared = ranks.Number(!gridfem::IsEmpty(piece)) > 1;
  ranks.Together(
    [&]
    {
      gridfem::RequireFurtherInputs(inputs, this->GetNumberOfInputPorts());
      if (isShared)
      {
        gridfem::RequireNoVolume(piece);
      }
      if (piece && piece->GetNumberOfCells() > 0)
      {
        surfaces = this->Surface->Of(inputs, this->GetNumberOfInputPorts());
      }
    });
  if (this->TryTogether(surfaces, outputs))
  {
    this->Ranked->NoteComputed();
    gridfem::ShareFieldArrays(
      vtkDataObject::GetData(surfaces[0]), vtkDataObject::GetData(outputs, 0));
    gridfem::StampTime(!this->OwnTimeSteps().empty(), surfaces[0], outputs);
    return;
  }
  this->UseSurface(false);
  this->Ranked->Run(surfaces, this->GetNumberOfInputPorts(), outputs, this->WeldCoincidentPoints,
    this->OwnTimeSteps(),
    [this](vtkInformationVector** gathered, vtkInformationVector* results)
    {
      this->ComputeSurface(gathered, results);
      gridfem::StampTime(!this->OwnTimeSteps().empty(), gathered[0], results);
      return this->OwnTimeSteps();
    });
}

/// Starts all ranks from the beginning after a failure, because the data of one rank may not fit
/// the data of the others.
bool vtkSurfaceFEMAlgorithm::TryTogether(
  vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  try
  {
    if (!gridfem::CanDistribute(this, inputs, this->NeedsWholeSurface()))
    {
      return false;
    }
    this->UseSurface(true);
    this->State->RunTogether([&] { this->ComputeInside(inputs, outputs); });
    gridfem::AddFieldInt(vtkPolyData::GetData(outputs), gridfem::DistributedName, 1);
    this->WriteDepth(outputs);
    return true;
  }
  catch (const gridfem::Aborted&)
  {
    throw;
  }
  catch (const gridfem::NeedsWholeSurface&)
  {
    this->FreeStages();
    return false;
  }
  catch (...)
  {
    this->FreeStages();
    throw;
  }
}
