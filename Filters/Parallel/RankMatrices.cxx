#include "Parallel/RankMatrices.h"

#include <algorithm>
#include <limits>

namespace gridfem
{

namespace
{

struct Entry
{
  Id row;
  Id column;
  double value;
};

/// Rows one after the other, columns with their numbers over all ranks, as PETSc takes them.
struct Rows
{
  std::vector<PetscInt> begin{ 0 };
  std::vector<PetscInt> column;
  std::vector<PetscScalar> value;

  void Reserve(Id rows, Id entries)
  {
    begin.reserve(rows + 1);
    column.reserve(entries);
    value.reserve(entries);
  }

  void Add(Id columnNumber, double entry)
  {
    column.push_back(static_cast<PetscInt>(columnNumber));
    value.push_back(entry);
  }

  void EndRow()
  {
    RequireIndices(static_cast<double>(column.size()), "entries of a matrix");
    begin.push_back(static_cast<PetscInt>(column.size()));
  }

  Id Count() const { return static_cast<Id>(begin.size()) - 1; }
};

/// Collective. Of all functions of the numbering.
std::vector<PetscInt> NumbersOf(const Communicator& ranks, const LevelNumbering& numbering)
{
  std::vector<PetscInt> numbers;
  ranks.Together([&] { numbers.assign(numbering.number.begin(), numbering.number.end()); });
  return numbers;
}

/// Collective. Of some functions.
std::vector<PetscInt> NumbersOf(
  const Communicator& ranks, const LevelNumbering& numbering, const std::vector<Index>& functions)
{
  std::vector<PetscInt> numbers;
  ranks.Together(
    [&]
    {
      for (const Index function : functions)
      {
        numbers.push_back(static_cast<PetscInt>(numbering.number[function]));
      }
    });
  return numbers;
}

/// @param numbers  ascending
PetscIndices MakeIndices(const std::vector<PetscInt>& numbers)
{
  PetscIndices indices;
  Check(ISCreateGeneral(PETSC_COMM_SELF, static_cast<PetscInt>(numbers.size()), numbers.data(),
    PETSC_COPY_VALUES, indices.Receive()));
  Check(ISSetInfo(indices, IS_SORTED, IS_LOCAL, PETSC_TRUE, PETSC_TRUE));
  return indices;
}

/// Collective.
PetscMatrix MakeMatrix(const Communicator& ranks, const Rows& rows, Id ownColumns)
{
  PetscMatrix matrix;
  Check(MatCreateMPIAIJWithArrays(ranks.Handle(), static_cast<PetscInt>(rows.Count()),
    static_cast<PetscInt>(ownColumns), PETSC_DETERMINE, PETSC_DETERMINE, rows.begin.data(),
    rows.column.data(), rows.value.data(), matrix.Receive()));
  return matrix;
}

/// Collective. Entries of rows that belong to other ranks are sent there; those that come here are
/// sorted by row and column, those of one place in the order of the ranks.
std::vector<Entry> ExchangeRows(
  const Communicator& ranks, const LevelNumbering& numbering, const SparseMatrix& own)
{
  const std::vector<Id> begins = ranks.Gather(std::vector<Id>{ numbering.begin });
  std::vector<std::vector<Entry>> messages(ranks.Size());
  ranks.Together(
    [&]
    {
      for (Index row = 0; row < numbering.foreign; ++row)
      {
        const Id number = numbering.number[row];
        // Ranks without functions begin where the next one does.
        const auto owner = std::upper_bound(begins.begin(), begins.end(), number) - begins.begin();
        for (Id k = own.rowBegin[row]; k < own.rowBegin[row + 1]; ++k)
        {
          messages[owner - 1].push_back({ number, numbering.number[own.column[k]], own.value[k] });
        }
      }
    });
  messages = ranks.Exchange(messages);
  std::vector<Entry> received;
  ranks.Together(
    [&]
    {
      for (const auto& message : messages)
      {
        received.insert(received.end(), message.begin(), message.end());
      }
      std::stable_sort(received.begin(), received.end(),
        [](const Entry& a, const Entry& b)
        { return a.row != b.row ? a.row < b.row : a.column < b.column; });
    });
  return received;
}

/// The sum of the own entries of a row and of those received, both ascending by column.
template<class OwnColumn>
void MergeRow(const SparseMatrix& own, Index row, OwnColumn&& columnOf,
  std::vector<Entry>::const_iterator first, std::vector<Entry>::const_iterator last, Rows& rows)
{
  Id k = own.rowBegin[row];
  const Id end = own.rowBegin[row + 1];
  while (k < end || first != last)
  {
    constexpr Id None = std::numeric_limits<Id>::max();
    const Id ownColumn = k < end ? columnOf(own.column[k]) : None;
    const Id column = std::min(ownColumn, first != last ? first->column : None);
    double sum = 0.0;
    if (ownColumn == column)
    {
      sum += own.value[k++];
    }
    for (; first != last && first->column == column; ++first)
    {
      sum += first->value;
    }
    rows.Add(column, sum);
  }
  rows.EndRow();
}

} // namespace

PetscMatrix SumOverRanks(
  const Communicator& ranks, const LevelNumbering& numbering, const SparseMatrix& own)
{
  const std::vector<Entry> received = ExchangeRows(ranks, numbering, own);
  Rows rows;
  ranks.Together(
    [&]
    {
      rows.Reserve(numbering.OwnFunctions(), own.NonZeros() + static_cast<Id>(received.size()));
      auto next = received.begin();
      for (Index row = numbering.foreign; row < own.rows; ++row)
      {
        const auto first = next;
        while (next != received.end() && next->row == numbering.number[row])
        {
          ++next;
        }
        MergeRow(
          own, row, [&](Index column) { return numbering.number[column]; }, first, next, rows);
      }
    });
  return MakeMatrix(ranks, rows, numbering.OwnFunctions());
}

PetscMatrix RowsOfOwners(const Communicator& ranks, const LevelNumbering& numbering,
  const SparseMatrix& own, const std::vector<Id>& columnNumber, Id ownColumns)
{
  Rows rows;
  ranks.Together(
    [&]
    {
      rows.Reserve(numbering.OwnFunctions(), own.NonZeros());
      for (Index row = numbering.foreign; row < own.rows; ++row)
      {
        for (Id k = own.rowBegin[row]; k < own.rowBegin[row + 1]; ++k)
        {
          rows.Add(
            columnNumber.empty() ? Id{ own.column[k] } : columnNumber[own.column[k]], own.value[k]);
        }
        rows.EndRow();
      }
    });
  return MakeMatrix(ranks, rows, ownColumns);
}

namespace
{

/// Part of a matrix over all ranks.
struct PartOfMatrix
{
  ~PartOfMatrix()
  {
    if (parts)
    {
      MatDestroySubMatrices(1, &parts);
    }
  }

  SparseMatrix Copy(Index columns) const
  {
    PetscInt count = 0;
    const PetscInt* begin = nullptr;
    const PetscInt* column = nullptr;
    PetscBool isDone = PETSC_FALSE;
    const PetscScalar* value = nullptr;
    Check(MatGetRowIJ(parts[0], 0, PETSC_FALSE, PETSC_FALSE, &count, &begin, &column, &isDone));
    Check(MatSeqAIJGetArrayRead(parts[0], &value));
    SparseMatrix rows;
    rows.rows = static_cast<Index>(count);
    rows.columns = columns;
    rows.rowBegin = Array<Id>(begin, begin + count + 1);
    rows.column = Array<Index>(column, column + begin[count]);
    rows.value = Array<double>(value, value + begin[count]);
    Check(MatSeqAIJRestoreArrayRead(parts[0], &value));
    Check(MatRestoreRowIJ(parts[0], 0, PETSC_FALSE, PETSC_FALSE, &count, &begin, &column, &isDone));
    return rows;
  }

  Mat* parts = nullptr;
};

/// Collective. The rows of some functions, over all ranks, with the columns of all functions of the
/// numbering.
SparseMatrix RowsOfAll(const Communicator& ranks, Mat matrix, const LevelNumbering& numbering,
  const std::vector<Index>& functions)
{
  const PetscIndices rows = MakeIndices(NumbersOf(ranks, numbering, functions));
  const PetscIndices columns = MakeIndices(NumbersOf(ranks, numbering));
  const IS wantedRows = rows;
  const IS wantedColumns = columns;
  PartOfMatrix part;
  Check(
    MatCreateSubMatrices(matrix, 1, &wantedRows, &wantedColumns, MAT_INITIAL_MATRIX, &part.parts));
  SparseMatrix found;
  ranks.Together([&] { found = part.Copy(numbering.Functions()); });
  return found;
}

} // namespace

SparseMatrix SomeRows(const SparseMatrix& matrix, const std::vector<Index>& rows)
{
  Array<Id> begin{ 0 };
  Array<Index> column;
  SparseMatrix some;
  for (const Index row : rows)
  {
    const Id first = matrix.rowBegin[row];
    const Id last = matrix.rowBegin[row + 1];
    column.insert(column.end(), matrix.column.begin() + first, matrix.column.begin() + last);
    some.value.insert(some.value.end(), matrix.value.begin() + first, matrix.value.begin() + last);
    begin.push_back(static_cast<Id>(column.size()));
  }
  some.rows = static_cast<Index>(rows.size());
  some.columns = matrix.columns;
  some.rowBegin = std::move(begin);
  some.column = std::move(column);
  return some;
}

SparseMatrix WholeRows(const Communicator& ranks, Mat matrix, const LevelNumbering& numbering,
  const std::vector<Index>& shared, const SparseMatrix& own)
{
  const SparseMatrix whole = RowsOfAll(ranks, matrix, numbering, shared);
  SparseMatrix rows;
  ranks.Together(
    [&]
    {
      Array<Id> begin(own.rows + 1);
      begin[0] = 0;
      const auto forRows = [&](const auto& body)
      {
        Index next = 0;
        for (Index row = 0; row < own.rows; ++row)
        {
          const bool isShared = next < whole.rows && shared[next] == row;
          body(row, isShared ? whole : own, isShared ? next++ : row);
        }
      };
      forRows([&](Index row, const SparseMatrix& from, Index place)
        { begin[row + 1] = begin[row] + from.rowBegin[place + 1] - from.rowBegin[place]; });
      Array<Index> column(begin[own.rows]);
      rows.value.resize(begin[own.rows]);
      forRows(
        [&](Index row, const SparseMatrix& from, Index place)
        {
          const Id first = from.rowBegin[place];
          const Id count = from.rowBegin[place + 1] - first;
          std::copy_n(from.column.begin() + first, count, column.begin() + begin[row]);
          std::copy_n(from.value.begin() + first, count, rows.value.begin() + begin[row]);
        });
      rows.rows = rows.columns = own.rows;
      rows.rowBegin = std::move(begin);
      rows.column = std::move(column);
    });
  return rows;
}

LevelVectors::LevelVectors(const Communicator& ranks, const LevelNumbering& numbering)
  : LevelVectors(ranks, numbering.OwnFunctions(), NumbersOf(ranks, numbering))
{
}

LevelVectors::LevelVectors(
  const Communicator& ranks, const LevelNumbering& numbering, const std::vector<Index>& functions)
  : LevelVectors(ranks, numbering.OwnFunctions(), NumbersOf(ranks, numbering, functions))
{
}

LevelVectors::LevelVectors(const Communicator& ranks, Id own, const std::vector<PetscInt>& numbers)
  : comm_(ranks.Handle()), own_(own), count_(static_cast<Id>(numbers.size()))
{
  const PetscIndices functions = MakeIndices(numbers);
  Check(VecCreateSeq(PETSC_COMM_SELF, static_cast<PetscInt>(count_), room_.Receive()));
  const PetscVector whole = this->Make();
  Check(VecScatterCreate(whole, functions, room_, nullptr, spread_.Receive()));
}

PetscVector LevelVectors::Make() const
{
  PetscVector vector;
  Check(VecCreateMPI(comm_, static_cast<PetscInt>(own_), PETSC_DETERMINE, vector.Receive()));
  return vector;
}

void LevelVectors::Spread(Vec vector, std::vector<double>& entries) const
{
  Check(VecScatterBegin(spread_, vector, room_, INSERT_VALUES, SCATTER_FORWARD));
  Check(VecScatterEnd(spread_, vector, room_, INSERT_VALUES, SCATTER_FORWARD));
  entries.resize(count_);
  VectorEntries room(room_);
  for (Id k = 0; k < count_; ++k)
  {
    entries[k] = room[k];
  }
}

void LevelVectors::Add(const std::vector<double>& entries, Vec sum) const
{
  Check(VecZeroEntries(sum));
  this->Collect(entries, ADD_VALUES, sum);
}

void LevelVectors::TakeLeast(const std::vector<double>& entries, Vec least) const
{
  Check(VecSet(least, std::numeric_limits<double>::max()));
  this->Collect(entries, MIN_VALUES, least);
}

void LevelVectors::Collect(const std::vector<double>& entries, InsertMode mode, Vec vector) const
{
  {
    VectorEntries room(room_);
    for (Id k = 0; k < count_; ++k)
    {
      room[k] = entries[k];
    }
  }
  Check(VecScatterBegin(spread_, room_, vector, mode, SCATTER_REVERSE));
  Check(VecScatterEnd(spread_, room_, vector, mode, SCATTER_REVERSE));
}

} // namespace gridfem
