// Packs surfaces and arrays of VTK into bytes that travel between ranks, with all their digits.
// VTK's own messages are files in its legacy format, which cuts ids to 32 bits.
#ifndef GridFEM_DataMessage_h
#define GridFEM_DataMessage_h

#include "Pieces/Ranks.h"

#include "vtkSmartPointer.h"

#include <cstring>
#include <string>
#include <type_traits>
#include <vector>

class vtkAbstractArray;
class vtkCellArray;
class vtkDataSetAttributes;
class vtkFieldData;
class vtkPolyData;

namespace gridfem
{

/// A message. Its parts come out in the order in which they were put in. Taking throws
/// std::runtime_error if the message ends before, or has a size or a number that cannot be.
class DataMessage
{
public:
  DataMessage() = default;
  explicit DataMessage(Bytes bytes) : bytes_(std::move(bytes)) {}

  /// Returns all bytes that were put in, and leaves none.
  Bytes Release() { return std::move(bytes_); }

  template<class Number>
  void Put(Number number)
  {
    static_assert(std::is_arithmetic_v<Number>);
    this->PutBytes(&number, sizeof(number));
  }

  template<class Number>
  Number Take()
  {
    if constexpr (std::is_same_v<Number, bool>)
    {
      return this->TakeTruth();
    }
    Number number{};
    this->TakeBytes(&number, sizeof(number));
    return number;
  }

  void PutText(const std::string& text);
  std::string TakeText();

  void PutTexts(const std::vector<std::string>& texts);
  std::vector<std::string> TakeTexts();

  void PutNumbers(const std::vector<double>& numbers);
  std::vector<double> TakeNumbers();

  /// Puts in an array that CanTravel, or null.
  void PutArray(vtkAbstractArray* array);
  vtkSmartPointer<vtkAbstractArray> TakeArray();

  /// Puts in the arrays that can travel and have this number of tuples, and marks the active
  /// arrays. -1 means any number of tuples.
  void PutArrays(vtkFieldData* arrays, vtkIdType tuples);
  /// Takes out arrays and adds them to the existing arrays.
  void TakeArrays(vtkFieldData* arrays);

  /// Puts in points, cells and arrays.
  void PutSurface(vtkPolyData* surface);
  vtkSmartPointer<vtkPolyData> TakeSurface();

private:
  void PutBytes(const void* bytes, std::size_t count);
  void TakeBytes(void* bytes, std::size_t count);
  /// Takes a byte that is 0 or 1. No other byte is a bool.
  bool TakeTruth();
  /// Takes the number of things that follow, each of at least so many bytes.
  template<class Number>
  Number TakeCount(std::size_t bytesOfEach);
  void RequireLeft(double bytes) const;
  void TakeValues(vtkAbstractArray* array);
  void PutCells(vtkCellArray* cells);
  vtkSmartPointer<vtkCellArray> TakeCells();

  Bytes bytes_;
  std::size_t taken_ = 0;
};

/// Whether an array can travel. Numbers and strings can, variants cannot.
bool CanTravel(vtkAbstractArray* array);

/// Whether two arrays have the same type, name, shape and bits. Either may be null.
bool HaveSameContents(vtkAbstractArray* a, vtkAbstractArray* b);

/// Whether two cell arrays have the same cells, bit by bit. Null counts as no cells.
bool HaveSameCells(vtkCellArray* a, vtkCellArray* b);

} // namespace gridfem

#endif
