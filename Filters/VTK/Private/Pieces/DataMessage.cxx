#include "Pieces/DataMessage.h"

#include "Pipeline/Allocation.h"

#include "vtkBitArray.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkStringArray.h"
#include "vtkTypeInt32Array.h"
#include "vtkTypeInt64Array.h"

#include <cstdint>
#include <stdexcept>

namespace gridfem
{
namespace
{

/// Returns the array with its values side by side in memory. Bits become bytes.
vtkSmartPointer<vtkDataArray> Contiguous(vtkDataArray* array)
{
  const bool isBits = array->GetDataType() == VTK_BIT;
  if (!isBits && array->HasStandardMemoryLayout())
  {
    return array;
  }
  vtkSmartPointer<vtkDataArray> copy;
  copy.TakeReference(
    vtkDataArray::CreateDataArray(isBits ? VTK_UNSIGNED_CHAR : array->GetDataType()));
  RequireRoom(static_cast<std::size_t>(array->GetNumberOfValues()) * copy->GetDataTypeSize());
  copy->DeepCopy(array);
  copy->SetName(array->GetName());
  return copy;
}

std::string NameOf(vtkAbstractArray* array)
{
  return array->GetName() ? array->GetName() : "";
}

std::size_t NumberOfBytes(vtkDataArray* array)
{
  return static_cast<std::size_t>(array->GetNumberOfValues()) * array->GetDataTypeSize();
}

bool HaveSameValues(vtkDataArray* a, vtkDataArray* b)
{
  const auto ours = Contiguous(a);
  const auto theirs = Contiguous(b);
  const std::size_t bytes = NumberOfBytes(ours);
  return bytes == NumberOfBytes(theirs) && (bytes == 0 || std::memcmp(ours->GetVoidPointer(0),
                                                            theirs->GetVoidPointer(0), bytes) == 0);
}

bool HaveSameStrings(vtkStringArray* a, vtkStringArray* b)
{
  for (vtkIdType k = 0; k < a->GetNumberOfValues(); ++k)
  {
    if (a->GetValue(k) != b->GetValue(k))
    {
      return false;
    }
  }
  return true;
}

} // namespace

bool CanTravel(vtkAbstractArray* array)
{
  return vtkDataArray::SafeDownCast(array) || vtkStringArray::SafeDownCast(array);
}

bool HaveSameContents(vtkAbstractArray* a, vtkAbstractArray* b)
{
  if (!a || !b || a == b)
  {
    return a == b;
  }
  if (a->GetDataType() != b->GetDataType() || NameOf(a) != NameOf(b) ||
      a->GetNumberOfComponents() != b->GetNumberOfComponents() ||
      a->GetNumberOfTuples() != b->GetNumberOfTuples())
  {
    return false;
  }
  if (vtkDataArray* numbers = vtkDataArray::SafeDownCast(a))
  {
    return HaveSameValues(numbers, vtkDataArray::SafeDownCast(b));
  }
  vtkStringArray* texts = vtkStringArray::SafeDownCast(a);
  return texts && HaveSameStrings(texts, vtkStringArray::SafeDownCast(b));
}

bool HaveSameCells(vtkCellArray* a, vtkCellArray* b)
{
  const vtkIdType ours = a ? a->GetNumberOfCells() : 0;
  const vtkIdType theirs = b ? b->GetNumberOfCells() : 0;
  return a == b || (ours == theirs &&
                     (ours == 0 ||
                       (HaveSameContents(a->GetOffsetsArray(), b->GetOffsetsArray()) &&
                         HaveSameContents(a->GetConnectivityArray(), b->GetConnectivityArray()))));
}

void DataMessage::PutBytes(const void* bytes, std::size_t count)
{
  const char* first = static_cast<const char*>(bytes);
  bytes_.insert(bytes_.end(), first, first + count);
}

void DataMessage::RequireLeft(double bytes) const
{
  if (!(bytes >= 0.0 && bytes <= static_cast<double>(bytes_.size() - taken_)))
  {
    throw std::runtime_error("A message between ranks is damaged: what it announces does not fit "
                             "into the " +
                             std::to_string(bytes_.size() - taken_) + " bytes that are left.");
  }
}

template<class Number>
Number DataMessage::TakeCount(std::size_t bytesOfEach)
{
  const auto count = this->Take<Number>();
  this->RequireLeft(static_cast<double>(count) * static_cast<double>(bytesOfEach));
  return count;
}

bool DataMessage::TakeTruth()
{
  const auto byte = this->Take<unsigned char>();
  if (byte > 1)
  {
    throw std::runtime_error("A message between ranks is damaged: it has " + std::to_string(byte) +
                             " where 0 or 1 belongs.");
  }
  return byte == 1;
}

void DataMessage::TakeBytes(void* bytes, std::size_t count)
{
  this->RequireLeft(static_cast<double>(count));
  if (count > 0)
  {
    std::memcpy(bytes, bytes_.data() + taken_, count);
  }
  taken_ += count;
}

void DataMessage::PutText(const std::string& text)
{
  this->Put(static_cast<std::int64_t>(text.size()));
  this->PutBytes(text.data(), text.size());
}

std::string DataMessage::TakeText()
{
  std::string text(this->TakeCount<std::int64_t>(1), ' ');
  this->TakeBytes(&text[0], text.size());
  return text;
}

void DataMessage::PutTexts(const std::vector<std::string>& texts)
{
  this->Put(static_cast<std::int64_t>(texts.size()));
  for (const std::string& text : texts)
  {
    this->PutText(text);
  }
}

std::vector<std::string> DataMessage::TakeTexts()
{
  std::vector<std::string> texts(this->TakeCount<std::int64_t>(sizeof(std::int64_t)));
  for (std::string& text : texts)
  {
    text = this->TakeText();
  }
  return texts;
}

void DataMessage::PutNumbers(const std::vector<double>& numbers)
{
  this->Put(static_cast<std::int64_t>(numbers.size()));
  this->PutBytes(numbers.data(), numbers.size() * sizeof(double));
}

std::vector<double> DataMessage::TakeNumbers()
{
  std::vector<double> numbers(this->TakeCount<std::int64_t>(sizeof(double)));
  this->TakeBytes(numbers.data(), numbers.size() * sizeof(double));
  return numbers;
}

void DataMessage::PutArray(vtkAbstractArray* array)
{
  this->Put(array ? array->GetDataType() : -1);
  if (!array)
  {
    return;
  }
  this->PutText(NameOf(array));
  const int components = array->GetNumberOfComponents();
  this->Put(components);
  this->Put(array->GetNumberOfTuples());
  this->Put(array->HasAComponentName());
  for (int c = 0; array->HasAComponentName() && c < components; ++c)
  {
    this->PutText(array->GetComponentName(c) ? array->GetComponentName(c) : "");
  }
  if (vtkDataArray* numbers = vtkDataArray::SafeDownCast(array))
  {
    const auto contiguous = Contiguous(numbers);
    this->PutBytes(contiguous->GetVoidPointer(0), NumberOfBytes(contiguous));
    return;
  }
  vtkStringArray* texts = vtkStringArray::SafeDownCast(array);
  for (vtkIdType k = 0; k < texts->GetNumberOfValues(); ++k)
  {
    this->PutText(texts->GetValue(k));
  }
}

vtkSmartPointer<vtkAbstractArray> DataMessage::TakeArray()
{
  vtkSmartPointer<vtkAbstractArray> array;
  const int type = this->Take<int>();
  if (type < 0)
  {
    return array;
  }
  array.TakeReference(vtkAbstractArray::CreateArray(type == VTK_BIT ? VTK_UNSIGNED_CHAR : type));
  if (!CanTravel(array))
  {
    throw std::runtime_error(
      "A message between ranks is damaged: no array has the type " + std::to_string(type) + ".");
  }
  const std::string name = this->TakeText();
  array->SetName(name.empty() ? nullptr : name.c_str());
  const int components = this->Take<int>();
  const auto tuples = this->Take<vtkIdType>();
  const bool isOfNumbers = vtkDataArray::SafeDownCast(array) != nullptr;
  const std::size_t bytesOfEach = isOfNumbers ? array->GetDataTypeSize() : sizeof(std::int64_t);
  this->RequireLeft(components < 1 || tuples < 0 ? -1.0
                                                 : static_cast<double>(tuples) * components *
                                                     static_cast<double>(bytesOfEach));
  array->SetNumberOfComponents(components);
  SetTuples(array, tuples);
  if (this->Take<bool>())
  {
    for (int c = 0; c < components; ++c)
    {
      array->SetComponentName(c, this->TakeText().c_str());
    }
  }
  this->TakeValues(array);
  return array;
}

void DataMessage::TakeValues(vtkAbstractArray* array)
{
  if (vtkDataArray* numbers = vtkDataArray::SafeDownCast(array))
  {
    this->TakeBytes(numbers->GetVoidPointer(0), NumberOfBytes(numbers));
    return;
  }
  vtkStringArray* texts = vtkStringArray::SafeDownCast(array);
  for (vtkIdType k = 0; k < texts->GetNumberOfValues(); ++k)
  {
    texts->SetValue(k, this->TakeText());
  }
}

void DataMessage::PutArrays(vtkFieldData* arrays, vtkIdType tuples)
{
  std::vector<vtkAbstractArray*> put;
  for (int k = 0; k < arrays->GetNumberOfArrays(); ++k)
  {
    vtkAbstractArray* array = arrays->GetAbstractArray(k);
    if (CanTravel(array) && (tuples < 0 || array->GetNumberOfTuples() == tuples))
    {
      put.push_back(array);
    }
  }
  this->Put(static_cast<int>(put.size()));
  for (vtkAbstractArray* array : put)
  {
    this->PutArray(array);
  }
  auto* attributes = vtkDataSetAttributes::SafeDownCast(arrays);
  for (int type = 0; type < vtkDataSetAttributes::NUM_ATTRIBUTES; ++type)
  {
    vtkAbstractArray* active = attributes ? attributes->GetAbstractAttribute(type) : nullptr;
    this->PutText(active ? NameOf(active) : "");
  }
}

void DataMessage::TakeArrays(vtkFieldData* arrays)
{
  const int count = this->Take<int>();
  for (int k = 0; k < count; ++k)
  {
    if (const auto array = this->TakeArray())
    {
      arrays->AddArray(array);
    }
  }
  auto* attributes = vtkDataSetAttributes::SafeDownCast(arrays);
  for (int type = 0; type < vtkDataSetAttributes::NUM_ATTRIBUTES; ++type)
  {
    const std::string active = this->TakeText();
    if (attributes && !active.empty() && attributes->HasArray(active.c_str()))
    {
      attributes->SetActiveAttribute(active.c_str(), type);
    }
  }
}

void DataMessage::PutCells(vtkCellArray* cells)
{
  const bool isLong = cells && cells->GetConnectivityArray()->GetDataTypeSize() == 8;
  this->Put(isLong);
  this->Put(cells ? cells->GetNumberOfCells() : vtkIdType{ 0 });
  this->Put(cells ? cells->GetNumberOfConnectivityIds() : vtkIdType{ 0 });
  if (!cells || cells->GetNumberOfCells() == 0)
  {
    return;
  }
  for (vtkDataArray* ids : { cells->GetOffsetsArray(), cells->GetConnectivityArray() })
  {
    this->PutBytes(ids->GetVoidPointer(0), NumberOfBytes(ids));
  }
}

vtkSmartPointer<vtkCellArray> DataMessage::TakeCells()
{
  auto cells = vtkSmartPointer<vtkCellArray>::New();
  const bool isLong = this->Take<bool>();
  const auto count = this->Take<vtkIdType>();
  const auto corners = this->Take<vtkIdType>();
  if (count == 0)
  {
    return cells;
  }
  const double bytes = isLong ? sizeof(vtkTypeInt64) : sizeof(vtkTypeInt32);
  this->RequireLeft(
    count < 0 || corners < 0 ? -1.0 : (static_cast<double>(count) + 1.0 + corners) * bytes);
  const auto take = [&](auto offsets, auto connectivity)
  {
    this->TakeBytes(offsets->GetPointer(0), NumberOfBytes(offsets));
    this->TakeBytes(connectivity->GetPointer(0), NumberOfBytes(connectivity));
    cells->SetData(offsets.Get(), connectivity.Get());
  };
  if (isLong)
  {
    using Ids = vtkTypeInt64Array;
    take(NewArray<Ids>(nullptr, count + 1), NewArray<Ids>(nullptr, corners));
  }
  else
  {
    using Ids = vtkTypeInt32Array;
    take(NewArray<Ids>(nullptr, count + 1), NewArray<Ids>(nullptr, corners));
  }
  return cells;
}

void DataMessage::PutSurface(vtkPolyData* surface)
{
  this->PutArray(surface->GetPoints() ? surface->GetPoints()->GetData() : nullptr);
  for (vtkCellArray* cells :
    { surface->GetVerts(), surface->GetLines(), surface->GetPolys(), surface->GetStrips() })
  {
    this->PutCells(cells);
  }
  this->PutArrays(surface->GetPointData(), surface->GetNumberOfPoints());
  this->PutArrays(surface->GetCellData(), surface->GetNumberOfCells());
  this->PutArrays(surface->GetFieldData(), -1);
}

vtkSmartPointer<vtkPolyData> DataMessage::TakeSurface()
{
  auto surface = vtkSmartPointer<vtkPolyData>::New();
  if (const auto coordinates = this->TakeArray())
  {
    vtkNew<vtkPoints> points;
    auto* numbers = vtkDataArray::SafeDownCast(coordinates);
    if (!numbers || numbers->GetNumberOfComponents() != 3)
    {
      throw std::runtime_error("A message between ranks is damaged: points have no coordinates.");
    }
    points->SetData(numbers);
    surface->SetPoints(points);
  }
  surface->SetVerts(this->TakeCells());
  surface->SetLines(this->TakeCells());
  surface->SetPolys(this->TakeCells());
  surface->SetStrips(this->TakeCells());
  this->TakeArrays(surface->GetPointData());
  this->TakeArrays(surface->GetCellData());
  this->TakeArrays(surface->GetFieldData());
  return surface;
}

} // namespace gridfem
