// Groups of unknowns that are relaxed together. How many a group has is a property of the space:
// the functions of a patch.
#ifndef GridFEM_UnknownGroups_h
#define GridFEM_UnknownGroups_h

#include "Base/Types.h"

#include <array>
#include <vector>

namespace gridfem
{

/// Groups of this size have kernels and an order in memory of their own; see PatchInverse.h and
/// PatchFactor.h. Groups of any other size take general loops.
constexpr int PatchKernelWidth = 8;

/// The unknowns of one group; -1 marks an unused place.
using UnknownGroup = Eigen::Map<const Eigen::Array<Index, Eigen::Dynamic, 1>>;

struct UnknownGroups
{
  int size = 0;               // of every group
  std::vector<Index> unknown; // group after group

  UnknownGroups() = default;
  explicit UnknownGroups(int ofGroup) : size(ofGroup) {}

  template<std::size_t Size>
  UnknownGroups(const std::vector<std::array<Index, Size>>& groups) : size(Size)
  {
    unknown.reserve(Size * groups.size());
    for (const auto& group : groups)
    {
      this->Add(group);
    }
  }

  bool IsEmpty() const { return unknown.empty(); }
  Id Count() const { return size > 0 ? static_cast<Id>(unknown.size()) / size : 0; }
  UnknownGroup operator[](Id group) const { return { unknown.data() + group * size, size }; }

  /// @param group  of `size` unknowns
  template<class Group>
  void Add(const Group& group)
  {
    unknown.insert(unknown.end(), group.begin(), group.end());
  }
};

} // namespace gridfem

#endif
