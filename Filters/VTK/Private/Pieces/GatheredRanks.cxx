#include "Pieces/GatheredRanks.h"

#include "Input/DataLines.h"
#include "Pieces/GatheredOutput.h"
#include "Pipeline/Allocation.h"
#include "Pipeline/InformationCopy.h"
#include "Pipeline/PipelineTime.h"

#include "Base/Errors.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataSet.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <utility>

namespace gridfem
{
namespace
{

/// Adds everything that is gathered of a data object.
void AddData(StageKey& key, vtkDataObject* data)
{
  auto* surface = vtkPolyData::SafeDownCast(data);
  if (!surface)
  {
    key.Add(data);
    return;
  }
  AddSurface(key, surface);
}

StageKey KeyOf(vtkInformationVector** inputs, int ports, bool weldCoincidentPoints)
{
  StageKey key;
  key.Add(weldCoincidentPoints);
  for (int port = 0; port < ports; ++port)
  {
    AddData(key, vtkDataObject::GetData(inputs[port]));
  }
  return key;
}

/// Returns the cells that are lines.
vtkSmartPointer<vtkCellArray> LinesOf(vtkDataSet* data)
{
  auto lines = vtkSmartPointer<vtkCellArray>::New();
  ForEachLine(data, [&](vtkIdList* points) { lines->InsertNextCell(points); });
  return lines;
}

/// Returns a data set on another port. Filters use only its points and lines if it is no
/// vtkPolyData.
vtkSmartPointer<vtkPolyData> AsSurface(vtkDataObject* data)
{
  if (auto* surface = vtkPolyData::SafeDownCast(data))
  {
    return surface;
  }
  auto* set = vtkDataSet::SafeDownCast(data);
  vtkSmartPointer<vtkPolyData> surface;
  if (set)
  {
    surface = vtkSmartPointer<vtkPolyData>::New();
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    SetTuples(points->GetData(), set->GetNumberOfPoints());
    for (vtkIdType point = 0; point < set->GetNumberOfPoints(); ++point)
    {
      points->SetPoint(point, set->GetPoint(point));
    }
    surface->SetPoints(points);
    surface->SetLines(LinesOf(set));
    surface->GetPointData()->ShallowCopy(set->GetPointData());
    surface->GetFieldData()->ShallowCopy(set->GetFieldData());
  }
  return surface;
}

void PutData(vtkDataObject* data, DataMessage& message)
{
  const vtkSmartPointer<vtkPolyData> surface = AsSurface(data);
  message.Put(surface != nullptr);
  if (surface)
  {
    if (surface->GetNumberOfPoints() > 0)
    {
      RequireGoodCells(surface, "piece");
    }
    message.PutSurface(surface);
  }
}

vtkSmartPointer<vtkPolyData> TakeData(DataMessage& message)
{
  return message.Take<bool>() ? message.TakeSurface() : vtkSmartPointer<vtkPolyData>::New();
}

bool HasPointsBehindFirst(const std::vector<vtkSmartPointer<vtkPolyData>>& pieces)
{
  for (std::size_t rank = 1; rank < pieces.size(); ++rank)
  {
    if (pieces[rank]->GetNumberOfPoints() > 0)
    {
      return true;
    }
  }
  return false;
}

std::vector<std::string> NamesOfRanks(std::size_t count)
{
  std::vector<std::string> names;
  for (std::size_t rank = 0; rank < count; ++rank)
  {
    names.push_back("rank " + std::to_string(rank));
  }
  return names;
}

} // namespace

GatheredRanks::GatheredRanks() = default;
GatheredRanks::~GatheredRanks() = default;

void GatheredRanks::Free()
{
  isGathered_ = false;
  own_ = nullptr;
  surface_ = {};
  others_.clear();
  vectors_.clear();
}

const std::vector<double>& GatheredRanks::StepsOf(const std::vector<double>& own) const
{
  return own == ownSteps_ ? steps_ : own;
}

void GatheredRanks::Run(vtkInformationVector** inputs, int ports, vtkInformationVector* outputs,
  bool weldCoincidentPoints, const std::vector<double>& ownSteps, const Computation& compute)
{
  const Ranks ranks;
  own_ = vtkPolyData::GetData(inputs[0]);
  if (!own_)
  {
    own_ = vtkSmartPointer<vtkPolyData>::New();
  }
  isEmpty_ = !ranks.Any(own_->GetNumberOfPoints() > 0);
  if (isEmpty_)
  {
    return;
  }
  this->Update(inputs, ports, weldCoincidentPoints);
  if (ranks.IsFirst())
  {
    SetTime(surface_.whole, TimeOf(own_)); // other times may have the same data
  }
  std::vector<Bytes> parts;
  ranks.OnFirst(
    [&]
    {
      try
      {
        const std::vector<double> steps = compute(this->GatheredInputs(inputs, ports), outputs);
        parts = this->Parts(outputs, steps);
      }
      catch (const InvalidInput& error)
      {
        ThrowWithPartialArrays(error, surface_);
      }
    });
  Bytes part = ranks.Scatter(parts);
  parts.clear();
  ranks.Together([&] { this->TakeParts(std::move(part), ownSteps, outputs); });
}

void GatheredRanks::Update(vtkInformationVector** inputs, int ports, bool weldCoincidentPoints)
{
  const Ranks ranks;
  const StageKey key = KeyOf(inputs, ports, weldCoincidentPoints);
  if (!ranks.Any(!isGathered_ || !(key == key_)))
  {
    return;
  }
  isGathered_ = false;
  DataMessage message;
  ranks.Together(
    [&]
    {
      RequireGoodCells(own_, "piece");
      for (int port = 0; !ranks.IsFirst() && port < ports; ++port)
      {
        PutData(port == 0 ? own_.Get() : vtkDataObject::GetData(inputs[port]), message);
      }
    });
  std::vector<Bytes> messages = ranks.Gather(message.Release());
  ranks.OnFirst([&] { this->Join(std::move(messages), inputs, ports, weldCoincidentPoints); });
  key_ = key;
  isGathered_ = true;
}

void GatheredRanks::Join(
  std::vector<Bytes> messages, vtkInformationVector** inputs, int ports, bool weldCoincidentPoints)
{
  std::vector<std::vector<vtkSmartPointer<vtkPolyData>>> pieces(ports); // by port, then by rank
  for (std::size_t rank = 0; rank < messages.size(); ++rank)
  {
    DataMessage message(std::move(messages[rank]));
    for (int port = 0; port < ports; ++port)
    {
      if (rank > 0)
      {
        pieces[port].push_back(TakeData(message));
        continue;
      }
      vtkSmartPointer<vtkPolyData> own =
        port == 0 ? own_ : AsSurface(vtkDataObject::GetData(inputs[port]));
      pieces[port].push_back(own ? own : vtkSmartPointer<vtkPolyData>::New());
    }
  }
  const vtkSmartPointer<vtkPolyData> last = surface_.whole;
  const std::vector<std::string> owners = NamesOfRanks(messages.size());
  surface_ = JoinPieces(pieces[0], owners, weldCoincidentPoints);
  if (last && HasPointsBehindFirst(pieces[0]))
  {
    KeepUnchanged(last, surface_.whole);
  }
  others_.resize(ports);
  for (int port = 1; port < ports; ++port)
  {
    const vtkSmartPointer<vtkDataObject> before = others_[port];
    others_[port] = nullptr;
    if (HasPointsBehindFirst(pieces[port]))
    {
      // Pieces of places have copies of points at their borders. A basis has cells of its own.
      const bool arePlaces = port > 1;
      const vtkSmartPointer<vtkPolyData> whole = JoinPieces(pieces[port], owners, arePlaces).whole;
      others_[port] = whole;
      if (before)
      {
        KeepUnchanged(vtkPolyData::SafeDownCast(before), whole);
      }
    }
  }
}

vtkInformationVector** GatheredRanks::GatheredInputs(vtkInformationVector** inputs, int ports)
{
  vectors_.clear();
  ports_.clear();
  for (int port = 0; port < ports; ++port)
  {
    vtkDataObject* whole = port == 0 ? surface_.whole.Get() : others_[port].Get();
    vtkInformation* given = inputs[port]->GetInformationObject(0);
    if (!given || !whole) // the first rank's own is all there is
    {
      ports_.push_back(inputs[port]);
      continue;
    }
    vtkNew<vtkInformationVector> vector;
    vector->SetInformationObject(0, CopyWith(whole, given));
    vectors_.emplace_back(vector);
    ports_.push_back(vector);
  }
  return ports_.data();
}

std::vector<Bytes> GatheredRanks::Parts(
  vtkInformationVector* outputs, const std::vector<double>& steps) const
{
  std::vector<Bytes> parts;
  for (int rank = 0; rank < static_cast<int>(surface_.pieces.size()); ++rank)
  {
    DataMessage message;
    message.PutNumbers(steps);
    for (int port = 0; port < outputs->GetNumberOfInformationObjects(); ++port)
    {
      vtkDataObject* output = vtkDataObject::GetData(outputs, port);
      const std::optional<double> time = TimeOf(output);
      message.Put(time.has_value());
      message.Put(time.value_or(0.0));
      PutPart(output, surface_, rank, message);
    }
    parts.push_back(message.Release());
  }
  return parts;
}

void GatheredRanks::TakeParts(
  Bytes bytes, const std::vector<double>& ownSteps, vtkInformationVector* outputs)
{
  DataMessage message(std::move(bytes));
  steps_ = message.TakeNumbers();
  ownSteps_ = Ranks().IsFirst() ? steps_ : ownSteps;
  for (int port = 0; port < outputs->GetNumberOfInformationObjects(); ++port)
  {
    vtkDataObject* output = vtkDataObject::GetData(outputs, port);
    const bool hasTime = message.Take<bool>();
    const double time = message.Take<double>();
    TakePart(message, own_, output);
    SetTime(output, hasTime ? std::make_optional(time) : std::nullopt);
  }
}

} // namespace gridfem
