#include "Input/SelectedPoints.h"

#include "Input/SelectionCheck.h"
#include "Pieces/JoinedBlocks.h"
#include "Pieces/Ranks.h"
#include "Solvers/Surface.h"

#include "Base/Errors.h"

#include "vtkAlgorithm.h"
#include "vtkCallbackCommand.h"
#include "vtkCellData.h"
#include "vtkCommand.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkExecutive.h"
#include "vtkExtractSelection.h"
#include "vtkIdList.h"
#include "vtkInformation.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSelection.h"
#include "vtkSelectionNode.h"
#include "vtkSelector.h"
#include "vtkVariant.h"

#if VTK_MODULE_ENABLE_ParaView_VTKExtensionsExtractionPython
#include "vtkPythonSelector.h"
#endif

#include <string>

namespace gridfem
{
namespace
{

/// Evaluates queries with ParaView's own selector, because its Find Data makes them.
class Extraction : public vtkExtractSelection
{
public:
  static Extraction* New();
  vtkTypeMacro(Extraction, vtkExtractSelection);

protected:
  vtkSmartPointer<vtkSelector> NewSelectionOperator(
    vtkSelectionNode::SelectionContent content) override
  {
#if VTK_MODULE_ENABLE_ParaView_VTKExtensionsExtractionPython
    if (content == vtkSelectionNode::QUERY)
    {
      return vtkSmartPointer<vtkPythonSelector>::New();
    }
#endif
    return this->Superclass::NewSelectionOperator(content);
  }
};

vtkStandardNewMacro(Extraction);

constexpr const char* Insidedness = "vtkInsidedness"; // of vtkExtractSelection

vtkSmartPointer<vtkCompositeDataIterator> LeavesOf(vtkCompositeDataSet* data)
{
  return vtkSmartPointer<vtkCompositeDataIterator>::Take(data->NewIterator());
}

/// Removes the marks of an earlier extraction, which would be mixed up with the new one.
void RemoveInsidedness(vtkDataObject* data)
{
  if (auto* dataSet = vtkDataSet::SafeDownCast(data))
  {
    dataSet->GetPointData()->RemoveArray(Insidedness);
    dataSet->GetCellData()->RemoveArray(Insidedness);
  }
}

/// Copies a data set, or the blocks that can be read. Other blocks are refused in their own run.
vtkSmartPointer<vtkDataObject> CopyOf(vtkDataObject* data)
{
  auto copy = vtkSmartPointer<vtkDataObject>::Take(data->NewInstance());
  auto* from = vtkCompositeDataSet::SafeDownCast(data);
  if (!from)
  {
    RequireReadable(data);
    copy->ShallowCopy(data);
    RemoveInsidedness(copy);
    return copy;
  }
  auto* to = vtkCompositeDataSet::SafeDownCast(copy);
  to->CopyStructure(from);
  const auto leaf = LeavesOf(from);
  for (leaf->InitTraversal(); !leaf->IsDoneWithTraversal(); leaf->GoToNextItem())
  {
    if (IsReadable(leaf->GetCurrentDataObject()))
    {
      to->SetDataSet(leaf, CopyOf(leaf->GetCurrentDataObject()));
    }
  }
  return copy;
}

/// Returns a copy without the nodes of other processes. VTK reads beyond the last node if there are
/// several of them.
vtkSmartPointer<vtkSelection> NodesOfThisProcess(vtkSelection* selection)
{
  auto own = vtkSmartPointer<vtkSelection>::New(); // it stays with its own pipeline
  own->ShallowCopy(selection);
  const int process = Ranks().Own();
  for (unsigned int k = own->GetNumberOfNodes(); k-- > 0;)
  {
    vtkInformation* properties = own->GetNode(k)->GetProperties();
    const int owner = properties->Has(vtkSelectionNode::PROCESS_ID())
                        ? properties->Get(vtkSelectionNode::PROCESS_ID())
                        : -1;
    if (owner != -1 && owner != process)
    {
      own->RemoveNode(k);
    }
  }
  return own;
}

/// Returns the part of extracted data at the block's place in the whole. Null if it has none.
vtkDataObject* BlockOf(
  vtkCompositeDataSet* extracted, vtkCompositeDataSet* whole, vtkDataObject* block)
{
  const auto leaf = LeavesOf(whole);
  for (leaf->InitTraversal(); !leaf->IsDoneWithTraversal(); leaf->GoToNextItem())
  {
    if (leaf->GetCurrentDataObject() == block)
    {
      return extracted->GetDataSet(leaf);
    }
  }
  return nullptr;
}

/// Returns the ids of the surface's points or cells in the data set that it was extracted from.
/// Null if the ids are the same.
vtkDataArray* OriginalIds(
  vtkDataSetAttributes* attributes, const char* name, vtkIdType surface, vtkIdType original)
{
  vtkDataArray* ids = attributes->GetArray(name);
  if (!ids && surface != original)
  {
    throw InvalidInput("The Selection refers to the input with " + std::to_string(original) +
                       " points or cells, but its surface has " + std::to_string(surface) +
                       ". The surface lacks the array '" + name + "' with the original ids.");
  }
  return ids;
}

/// Returns which of `count` points or cells are inside.
/// @param originalIds  their places in `inside`; null if these are the same
std::vector<char> SelectedOf(vtkDataArray* inside, vtkDataArray* originalIds, vtkIdType count)
{
  const vtkIdType ids = originalIds ? originalIds->GetNumberOfTuples() : count;
  if (ids < count)
  {
    throw InvalidInput("The array '" + std::string(originalIds->GetName()) + "' has " +
                       std::to_string(ids) + " ids for " + std::to_string(count) +
                       " points or cells.");
  }
  std::vector<char> isSelected(count, 0);
  for (vtkIdType k = 0; k < count; ++k)
  {
    const double id = originalIds ? originalIds->GetComponent(k, 0) : static_cast<double>(k);
    if (!(id >= 0.0 && id < static_cast<double>(inside->GetNumberOfTuples())))
    {
      throw InvalidInput(
        "The Selection was made on data with " + std::to_string(inside->GetNumberOfTuples()) +
        " points or cells, but the surface has the original id " +
        (originalIds ? originalIds->GetVariantValue(k).ToString() : std::to_string(k)) +
        ". Make the Selection again on the present input.");
    }
    isSelected[k] = inside->GetComponent(static_cast<vtkIdType>(id), 0) > 0.0;
  }
  return isSelected;
}

/// @param part  the data set that the surface was extracted from, with `vtkInsidedness`
std::vector<char> PointsOf(vtkDataSet* part, vtkPolyData* surface)
{
  const bool isSurfaceItself = vtkPolyData::SafeDownCast(part) != nullptr;
  const auto idsOf =
    [&](vtkDataSetAttributes* attributes, const char* name, vtkIdType count, vtkIdType original)
  { return isSurfaceItself ? nullptr : OriginalIds(attributes, name, count, original); };
  if (vtkDataArray* inside = part->GetPointData()->GetArray(Insidedness))
  {
    return SelectedOf(inside,
      idsOf(surface->GetPointData(), "vtkOriginalPointIds", surface->GetNumberOfPoints(),
        part->GetNumberOfPoints()),
      surface->GetNumberOfPoints());
  }
  std::vector<char> isSelected(surface->GetNumberOfPoints(), 0);
  if (vtkDataArray* inside = part->GetCellData()->GetArray(Insidedness))
  {
    const std::vector<char> cells = SelectedOf(inside,
      idsOf(surface->GetCellData(), "vtkOriginalCellIds", surface->GetNumberOfCells(),
        part->GetNumberOfCells()),
      surface->GetNumberOfCells());
    vtkNew<vtkIdList> points;
    for (vtkIdType cell = 0; cell < surface->GetNumberOfCells(); ++cell)
    {
      if (cells[cell])
      {
        surface->GetCellPoints(cell, points);
        for (vtkIdType k = 0; k < points->GetNumberOfIds(); ++k)
        {
          isSelected[points->GetId(k)] = 1;
        }
      }
    }
  }
  return isSelected;
}

} // namespace

/// Returns a data set of the input, with `vtkInsidedness`. Null if nothing of it is selected.
vtkDataSet* SelectedPoints::PartOf(vtkDataObject* block) const
{
  auto* whole = vtkCompositeDataSet::SafeDownCast(whole_);
  return vtkDataSet::SafeDownCast(
    whole ? BlockOf(vtkCompositeDataSet::SafeDownCast(extracted_), whole, block)
          : extracted_.GetPointer());
}

std::vector<char> SelectedPoints::PointsOfBlocks(const JoinedBlocks& joined) const
{
  std::vector<char> isSelected(joined.Surface().whole->GetNumberOfPoints(), 0);
  for (const JoinedBlocks::Block& block : joined.Blocks())
  {
    vtkDataSet* part = block.piece >= 0 ? this->PartOf(block.data) : nullptr;
    if (!part)
    {
      continue;
    }
    const std::vector<char> points = PointsOf(part, block.surface);
    const std::vector<vtkIdType>& places = joined.Surface().pieces[block.piece].points;
    for (std::size_t point = 0; point < points.size(); ++point)
    {
      if (points[point] && places[point] >= 0)
      {
        isSelected[places[point]] = 1;
      }
    }
  }
  return isSelected;
}

/// Extracts again only if data or selection have changed.
/// @param own  the nodes of this process
/// @param selectionTime  of the last change of the selection
void SelectedPoints::Extract(vtkDataObject* data, vtkSelection* own, std::int64_t selectionTime)
{
  const auto dataTime = static_cast<std::int64_t>(data->GetMTime());
  if (extracted_ && dataTime_ == dataTime && selectionTime_ == selectionTime)
  {
    return;
  }
  extracted_ = nullptr;
  std::string error;
  vtkNew<vtkCallbackCommand> listen;
  listen->SetClientData(&error);
  listen->SetCallback([](vtkObject*, unsigned long, void* text, void* message)
    { *static_cast<std::string*>(text) = static_cast<const char*>(message); });
  vtkNew<Extraction> filter;
  filter->AddObserver(vtkCommand::ErrorEvent, listen);
  filter->AddObserver(vtkCommand::WarningEvent, listen); // an unknown kind of selection
  filter->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, listen);
  filter->PreserveTopologyOn();
  filter->SetInputDataObject(0, CopyOf(data));
  filter->SetInputDataObject(1, own);
  const Ranks ranks;
  filter->UpdatePiece(ranks.Own(), ranks.Count(), 0); // nodes may be of one process
  if (!error.empty())
  {
    throw InvalidInput("The Selection cannot be evaluated: " + error);
  }
  extracted_ = filter->GetOutputDataObject(0);
  dataTime_ = dataTime;
  selectionTime_ = selectionTime;
}

SelectedPoints::SelectedPoints(vtkAlgorithm* filter) : filter_(filter)
{
  // Before and after all blocks, the input is the whole. In between it is one block after the
  // other.
  const auto noteWhole = [](vtkObject* caller, unsigned long event, void* client, void*)
  {
    vtkDataObject* data = static_cast<vtkAlgorithm*>(caller)->GetInputDataObject(0, 0);
    if (vtkCompositeDataSet::SafeDownCast(data))
    {
      static_cast<SelectedPoints*>(client)->whole_ =
        event == vtkCommand::StartEvent ? data : nullptr;
    }
  };
  vtkNew<vtkCallbackCommand> listen;
  listen->SetClientData(this);
  listen->SetCallback(noteWhole);
  observers_[0] = filter->AddObserver(vtkCommand::StartEvent, listen);
  observers_[1] = filter->AddObserver(vtkCommand::EndEvent, listen);
}

SelectedPoints::~SelectedPoints()
{
  filter_->RemoveObserver(observers_[0]);
  filter_->RemoveObserver(observers_[1]);
}

void SelectedPoints::Free()
{
  extracted_ = nullptr;
}

void SelectedPoints::Update(
  const Surface& surface, vtkSelection* selection, vtkPolyData* input, const JoinedBlocks* joined)
{
  if (selection && !surface.IsShared())
  {
    RequireOneProcess("A Selection"); // the surface is gathered from all ranks
  }
  const bool isGiven = surface.Any(selection != nullptr);
  std::vector<char> isSelected;
  surface.Together(
    [&]
    {
      if (selection && input)
      {
        isSelected = this->Evaluate(selection, input, joined);
        return;
      }
      this->Free();
      isSelected.assign(isGiven && input ? input->GetNumberOfPoints() : 0, 0);
    });
  if (isGiven_ != isGiven || isSelected_ != isSelected)
  {
    ++version_;
  }
  isGiven_ = isGiven;
  isSelected_ = std::move(isSelected);
}

std::vector<char> SelectedPoints::Evaluate(
  vtkSelection* selection, vtkPolyData* surface, const JoinedBlocks* joined)
{
  const auto own = NodesOfThisProcess(selection);
  if (own->GetNumberOfNodes() == 0) // VTK fails on blocks without nodes, or loses the blocks
  {
    vtkPolyData* whole = joined ? joined->Surface().whole.GetPointer() : surface;
    return std::vector<char>(whole->GetNumberOfPoints(), 0);
  }
  vtkDataObject* data = whole_ ? whole_.GetPointer() : filter_->GetInputDataObject(0, 0);
  RequireEvaluable(own, data);
  this->Extract(data, own, static_cast<std::int64_t>(selection->GetMTime()));
  vtkDataSet* part = joined ? nullptr : this->PartOf(filter_->GetInputDataObject(0, 0));
  return joined ? this->PointsOfBlocks(*joined)
         : part ? PointsOf(part, surface)
                : std::vector<char>(surface->GetNumberOfPoints(), 0);
}

std::vector<Id> SelectedPoints::Ids(const TriangleMesh& mesh) const
{
  std::vector<Id> ids;
  if (isGiven_)
  {
    const std::vector<char> used = UsedPoints(mesh);
    for (Id point = 0; point < static_cast<Id>(used.size()); ++point)
    {
      if (isSelected_[point] && used[point])
      {
        ids.push_back(point);
      }
    }
  }
  return ids;
}

} // namespace gridfem
