#include "Algebra/BlockVectors.h"

#include <random>

namespace gridfem
{

template<class Real>
void BlockBuffer<Real>::Reserve(Id rows, Id columns)
{
  if (rows_ != rows || capacity_ < columns)
  {
    Release(memory_); // so that two blocks never exist at the same time
    memory_.resize(rows * columns);
    rows_ = rows;
    capacity_ = columns;
    columns_ = 0;
  }
}

template<class Real>
void BlockBuffer<Real>::Grow(Id rows, Id columns, int threads)
{
  if (columns_ == 0)
  {
    this->Reserve(rows, columns);
  }
  else if (capacity_ < columns)
  {
    BlockBuffer wide;
    wide.Reserve(rows, columns);
    wide.Show(columns_);
    CopyBlock(this->View(), wide.View(), threads);
    std::swap(*this, wide);
  }
}

template<class Real>
void BlockBuffer<Real>::Keep(const std::vector<Index>& columns, int threads)
{
  ParallelRanges(rows_, threads,
    [&](Id begin, Id end)
    {
      for (Id row = begin; row < end; ++row)
      {
        Real* const numbers = memory_.data() + row * capacity_;
        Id place = 0;
        for (const Index column : columns)
        {
          numbers[place++] = numbers[column];
        }
      }
    });
  columns_ = static_cast<Id>(columns.size());
}

template class BlockBuffer<float>;
template class BlockBuffer<double>;

MultiVector RandomColumns(Id rows, Id columns)
{
  std::mt19937_64 generator(20180901);
  MultiVector X(rows, columns);
  for (Id i = 0; i < rows; ++i)
  {
    for (Id j = 0; j < columns; ++j)
    {
      X(i, j) = static_cast<double>(generator() >> 11) * 0x1p-52 - 1.0;
    }
  }
  return X;
}

} // namespace gridfem
