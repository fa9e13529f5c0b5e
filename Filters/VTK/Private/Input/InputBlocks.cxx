#include "Input/InputBlocks.h"

#include "Input/InputArray.h"
#include "Pieces/Ranks.h"

#include "Base/Errors.h"

#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataObjectTree.h"
#include "vtkDataObjectTypes.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkMultiPieceDataSet.h"
#include "vtkPartitionedDataSet.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <set>
#include <sstream>

namespace gridfem
{
namespace
{

constexpr const char* NoBlocks = "one piece"; // stands for any input that is not composite

[[noreturn]] void ThrowUnlike()
{
  throw InvalidInput("The blocks of the input differ in kind between the ranks, so they cannot be "
                     "joined into one surface.");
}

unsigned int NumberOfChildren(vtkDataObject* parent)
{
  if (auto* blocks = vtkMultiBlockDataSet::SafeDownCast(parent))
  {
    return blocks->GetNumberOfBlocks();
  }
  if (auto* sets = vtkPartitionedDataSetCollection::SafeDownCast(parent))
  {
    return sets->GetNumberOfPartitionedDataSets();
  }
  if (auto* pieces = vtkMultiPieceDataSet::SafeDownCast(parent))
  {
    return pieces->GetNumberOfPieces();
  }
  auto* partitions = vtkPartitionedDataSet::SafeDownCast(parent);
  return partitions ? partitions->GetNumberOfPartitions() : 0;
}

vtkDataObject* Child(vtkDataObject* parent, unsigned int index)
{
  if (index >= NumberOfChildren(parent))
  {
    return nullptr;
  }
  if (auto* blocks = vtkMultiBlockDataSet::SafeDownCast(parent))
  {
    return blocks->GetBlock(index);
  }
  if (auto* sets = vtkPartitionedDataSetCollection::SafeDownCast(parent))
  {
    return sets->GetPartitionedDataSet(index);
  }
  if (auto* pieces = vtkMultiPieceDataSet::SafeDownCast(parent))
  {
    return pieces->GetPieceAsDataObject(index);
  }
  return vtkPartitionedDataSet::SafeDownCast(parent)->GetPartitionAsDataObject(index);
}

void SetChild(vtkDataObject* parent, unsigned int index, vtkDataObject* child)
{
  if (auto* blocks = vtkMultiBlockDataSet::SafeDownCast(parent))
  {
    blocks->SetBlock(index, child);
  }
  else if (auto* sets = vtkPartitionedDataSetCollection::SafeDownCast(parent))
  {
    sets->SetPartitionedDataSet(index, vtkPartitionedDataSet::SafeDownCast(child));
  }
  else if (auto* pieces = vtkMultiPieceDataSet::SafeDownCast(parent))
  {
    pieces->SetPiece(index, child);
  }
  else if (auto* partitions = vtkPartitionedDataSet::SafeDownCast(parent))
  {
    partitions->SetPartition(index, child);
  }
}

/// Writes a line for every existing block: the classes and indices on the path to it.
void ListBlocks(vtkDataObject* parent, const std::string& path, std::string& lines)
{
  const std::string here = path + parent->GetClassName() + " ";
  for (unsigned int index = 0; index < NumberOfChildren(parent); ++index)
  {
    vtkDataObject* child = Child(parent, index);
    if (child && vtkDataObjectTree::SafeDownCast(child))
    {
      ListBlocks(child, here + std::to_string(index) + " ", lines);
    }
    else if (child)
    {
      lines += here + std::to_string(index) + "\n";
    }
  }
}

/// Describes the blocks of an input as text.
std::string BlocksOf(vtkDataObject* data)
{
  auto* composite = vtkCompositeDataSet::SafeDownCast(data);
  if (!composite)
  {
    return NoBlocks;
  }
  std::string lines = std::string(composite->GetClassName()) + "\n";
  if (vtkDataObjectTree::SafeDownCast(composite))
  {
    ListBlocks(composite, "", lines);
    return lines;
  }
  // Blocks of another kind, such as AMR, cannot be added: all ranks have to have the same.
  auto iterator = vtkSmartPointer<vtkCompositeDataIterator>::Take(composite->NewIterator());
  for (iterator->InitTraversal(); !iterator->IsDoneWithTraversal(); iterator->GoToNextItem())
  {
    lines += std::to_string(iterator->GetCurrentFlatIndex()) + "\n";
  }
  return lines;
}

/// Adds an empty surface at the end of a path if nothing is there.
void AddBlock(vtkDataObject* root, const std::string& path)
{
  std::istringstream words(path);
  std::string kind;
  unsigned int index = 0;
  vtkDataObject* parent = root;
  while (words >> kind >> index)
  {
    if (kind != parent->GetClassName())
    {
      ThrowUnlike();
    }
    vtkDataObject* child = Child(parent, index);
    const auto behind = words.tellg();
    std::string childKind;
    const bool isLeaf = !(words >> childKind);
    if (!isLeaf)
    {
      words.seekg(behind);
    }
    if (!child)
    {
      vtkSmartPointer<vtkDataObject> added;
      added.TakeReference(
        vtkDataObjectTypes::NewDataObject(isLeaf ? "vtkPolyData" : childKind.c_str()));
      SetChild(parent, index, added);
      child = added;
    }
    if (isLeaf == (vtkDataObjectTree::SafeDownCast(child) != nullptr))
    {
      ThrowUnlike();
    }
    parent = child;
  }
}

vtkSmartPointer<vtkDataObjectTree> CopyOf(vtkDataObjectTree* tree)
{
  auto copy = vtkSmartPointer<vtkDataObjectTree>::Take(tree->NewInstance());
  copy->CopyStructure(tree);
  auto iterator = vtkSmartPointer<vtkCompositeDataIterator>::Take(tree->NewIterator());
  for (iterator->InitTraversal(); !iterator->IsDoneWithTraversal(); iterator->GoToNextItem())
  {
    copy->SetDataSet(iterator, iterator->GetCurrentDataObject());
  }
  return copy;
}

} // namespace

bool InputBlocks::Begin(vtkInformationVector** inputs, int ports)
{
  if (depth_++ > 0)
  {
    return false;
  }
  if (Ranks::AreSeveral())
  {
    this->Align(inputs, ports);
  }
  whole_ = vtkCompositeDataSet::GetData(inputs[0]);
  return true;
}

bool InputBlocks::End()
{
  if (--depth_ > 0)
  {
    return false;
  }
  whole_ = nullptr;
  for (const auto& [information, data] : given_)
  {
    information->Set(vtkDataObject::DATA_OBJECT(), data);
  }
  given_.clear();
  return true;
}

void InputBlocks::Align(vtkInformationVector** inputs, int ports)
{
  failure_ = nullptr;
  const Ranks ranks;
  try
  {
    for (int port = 0; port < ports; ++port)
    {
      vtkInformation* information = inputs[port]->GetInformationObject(0);
      const std::vector<std::string> blocks = ranks.Exchange(
        BlocksOf(information ? information->Get(vtkDataObject::DATA_OBJECT()) : nullptr));
      ranks.Together([&] { this->AlignPort(information, blocks); });
    }
  }
  catch (...)
  {
    failure_ = std::current_exception();
  }
}

void InputBlocks::AlignPort(vtkInformation* information, const std::vector<std::string>& blocks)
{
  if (std::all_of(blocks.begin(), blocks.end(),
        [&](const std::string& others) { return others == blocks.front(); }))
  {
    return;
  }
  std::set<std::string> paths;
  std::string kind;
  for (const std::string& text : blocks)
  {
    std::istringstream lines(text);
    std::string first;
    std::getline(lines, first);
    kind = kind.empty() ? first : kind;
    if (first != kind)
    {
      ThrowUnlike();
    }
    for (std::string path; std::getline(lines, path);)
    {
      paths.insert(path);
    }
  }
  auto* tree = vtkDataObjectTree::SafeDownCast(information->Get(vtkDataObject::DATA_OBJECT()));
  if (!tree)
  {
    ThrowUnlike();
  }
  const auto copy = CopyOf(tree);
  for (const std::string& path : paths)
  {
    AddBlock(copy, path);
  }
  given_.emplace_back(information, tree);
  information->Set(vtkDataObject::DATA_OBJECT(), copy);
}

bool InputBlocks::AnyHas(const MissingArray& missing) const
{
  if (!whole_)
  {
    return false;
  }
  auto iterator = vtkSmartPointer<vtkCompositeDataIterator>::Take(whole_->NewIterator());
  for (iterator->InitTraversal(); !iterator->IsDoneWithTraversal(); iterator->GoToNextItem())
  {
    auto* block = vtkDataSet::SafeDownCast(iterator->GetCurrentDataObject());
    if (block && missing.IsOn(block))
    {
      return true;
    }
  }
  return false;
}

void InputBlocks::RequireAligned() const
{
  if (failure_)
  {
    std::rethrow_exception(failure_);
  }
}

} // namespace gridfem
