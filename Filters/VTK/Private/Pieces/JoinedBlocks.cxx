#include "Pieces/JoinedBlocks.h"

#include "Input/InputArray.h"
#include "Input/InputValidation.h"
#include "Pieces/GatheredOutput.h"
#include "Pipeline/PipelineTime.h"

#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkPolyData.h"

#include <algorithm>

namespace gridfem
{
namespace
{

std::string NameOf(vtkCompositeDataIterator* leaf)
{
  vtkInformation* about = leaf->HasCurrentMetaData() ? leaf->GetCurrentMetaData() : nullptr;
  const char* name = about ? about->Get(vtkCompositeDataSet::NAME()) : nullptr;
  return name && *name ? "block '" + std::string(name) + "'"
                       : "block " + std::to_string(leaf->GetCurrentFlatIndex());
}

/// Calls body(data set, its place among the leaves) for the blocks that have points.
template<class Body>
void ForEachBlock(vtkCompositeDataSet* whole, Body&& body)
{
  auto leaf = vtkSmartPointer<vtkCompositeDataIterator>::Take(whole->NewIterator());
  for (leaf->InitTraversal(); !leaf->IsDoneWithTraversal(); leaf->GoToNextItem())
  {
    auto* data = vtkDataSet::SafeDownCast(leaf->GetCurrentDataObject());
    if (!gridfem::IsEmpty(data))
    {
      body(data, leaf.Get());
    }
  }
}

} // namespace

JoinedBlocks::JoinedBlocks() = default;
JoinedBlocks::~JoinedBlocks() = default;

void JoinedBlocks::Start(vtkInformationVector* outputs)
{
  hasStarted_ = true;
  failure_ = nullptr;
  results_->SetNumberOfInformationObjects(0);
  for (int port = 0; port < outputs->GetNumberOfInformationObjects(); ++port)
  {
    auto result =
      vtkSmartPointer<vtkDataObject>::Take(vtkDataObject::GetData(outputs, port)->NewInstance());
    results_->SetInformationObject(port, CopyWith(result, outputs->GetInformationObject(port)));
  }
}

int JoinedBlocks::CountBlocks(vtkCompositeDataSet* whole)
{
  int count = 0;
  ForEachBlock(whole, [&](vtkDataSet*, vtkCompositeDataIterator*) { ++count; });
  return count;
}

void JoinedBlocks::Read(vtkCompositeDataSet* whole, bool isShared)
{
  blocks_.clear();
  std::size_t index = 0;
  ForEachBlock(whole,
    [&](vtkDataSet* data, vtkCompositeDataIterator* leaf)
    {
      if (isShared)
      {
        RequireNoVolume(data);
      }
      this->ReadBlock(data, NameOf(leaf), index++);
    });
  surfaces_.resize(index);
}

/// Reads a block. A data set without a surface, such as a set of nodes beside the sides, is no
/// block.
void JoinedBlocks::ReadBlock(vtkDataSet* data, const std::string& name, std::size_t index)
{
  surfaces_.resize(std::max(surfaces_.size(), index + 1));
  if (!surfaces_[index])
  {
    surfaces_[index] = std::make_unique<SurfaceInput>();
  }
  vtkPolyData* surface = surfaces_[index]->Of(data);
  if (!gridfem::IsEmpty(surface))
  {
    blocks_.push_back({ data, surface, name, 0 });
  }
}

std::vector<std::string> JoinedBlocks::LeaveOut(const std::string& array)
{
  std::vector<Block*> lacking;
  bool anyHas = false;
  for (Block& block : blocks_)
  {
    if (block.piece >= 0 && HasArray(block.surface, array))
    {
      anyHas = true;
    }
    else if (block.piece >= 0)
    {
      lacking.push_back(&block);
    }
  }
  std::vector<std::string> names;
  if (anyHas)
  {
    for (Block* block : lacking)
    {
      block->piece = -1;
      names.push_back(block->name);
    }
  }
  return names;
}

vtkInformationVector** JoinedBlocks::Inputs(
  vtkInformationVector** inputs, int ports, bool weldCoincidentPoints)
{
  std::vector<vtkSmartPointer<vtkPolyData>> pieces;
  std::vector<std::string> owners;
  std::vector<bool> isLeftOut;
  StageKey key;
  key.Add(weldCoincidentPoints);
  for (Block& block : blocks_)
  {
    isLeftOut.push_back(block.piece < 0);
    if (block.piece >= 0)
    {
      block.piece = static_cast<int>(pieces.size());
      pieces.push_back(block.surface);
      owners.push_back(block.name);
      AddSurface(key, block.surface);
    }
  }
  entry_ = &entries_[isLeftOut];
  entry_->isUsed = true;
  const vtkSmartPointer<vtkPolyData> last = entry_->surface.whole;
  if (!last || !(entry_->key == key))
  {
    entry_->surface = {};
    std::for_each(
      pieces.begin(), pieces.end(), [](vtkPolyData* piece) { RequireGoodCells(piece, "piece"); });
    if (pieces.empty())
    {
      pieces.push_back(vtkSmartPointer<vtkPolyData>::New());
      owners.emplace_back();
    }
    entry_->surface = JoinPieces(pieces, owners, weldCoincidentPoints);
    if (last && pieces.size() > 1)
    {
      KeepUnchanged(last, entry_->surface.whole);
    }
    entry_->key = key;
  }
  if (!blocks_.empty())
  {
    SetTime(entry_->surface.whole, TimeOf(blocks_.front().data));
  }
  return inputs_.Of(inputs, ports, entry_->surface.whole);
}

void JoinedBlocks::HandBack(vtkDataSet* data, vtkInformationVector* outputs) const
{
  if (failure_)
  {
    try
    {
      std::rethrow_exception(failure_);
    }
    catch (const Aborted&)
    {
      throw;
    }
    catch (...)
    {
      throw FailedElsewhere(); // reported only once
    }
  }
  const auto block = std::find_if(
    blocks_.begin(), blocks_.end(), [=](const Block& other) { return other.data == data; });
  if (block == blocks_.end())
  {
    return;
  }
  if (block->piece < 0)
  {
    vtkPolyData::GetData(outputs)->ShallowCopy(block->surface);
    return;
  }
  for (int port = 0; port < outputs->GetNumberOfInformationObjects(); ++port)
  {
    vtkDataObject* result = vtkDataObject::GetData(results_, port);
    vtkDataObject* output = vtkDataObject::GetData(outputs, port);
    if (block->piece == 0)
    {
      output->ShallowCopy(result);
    }
    DataMessage message;
    PutPart(result, entry_->surface, block->piece, message, GivenFieldArrays::Withheld);
    DataMessage part(message.Release());
    TakePart(part, block->surface, output);
  }
}

void JoinedBlocks::Finish(bool isKept)
{
  hasStarted_ = false;
  failure_ = nullptr;
  blocks_.clear();
  results_->SetNumberOfInformationObjects(0);
  inputs_.Free();
  entry_ = nullptr;
  if (!isKept)
  {
    surfaces_.clear();
  }
  for (auto entry = entries_.begin(); entry != entries_.end();)
  {
    const bool stays = isKept && entry->second.isUsed;
    entry->second.isUsed = false;
    entry = stays ? std::next(entry) : entries_.erase(entry);
  }
}

} // namespace gridfem
