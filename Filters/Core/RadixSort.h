// Stable sorting of keys with a payload, digit by digit.
#ifndef GridFEM_RadixSort_h
#define GridFEM_RadixSort_h

#include "Array.h"
#include "Types.h"

namespace gridfem
{

struct SortEntry
{
  std::uint64_t key;
  Id item;
};

/// Sorts ascending by the lowest `bits` bits of the key; equal keys keep their order.
/// Cost O(n bits / 12); the same for any number of threads.
void RadixSort(Array<SortEntry>& entries, int bits, int threads = 0);

} // namespace gridfem

#endif
