// Disjoint sets. The root of a set is its lowest member, so results do not depend on the order of
// unions.
#ifndef GridFEM_UnionFind_h
#define GridFEM_UnionFind_h

#include "Types.h"

#include <numeric>
#include <vector>

namespace gridfem
{

class UnionFind
{
public:
  explicit UnionFind(Id count) : parent_(count)
  {
    std::iota(parent_.begin(), parent_.end(), Id{ 0 });
  }

  /// The lowest member of the set that contains x.
  Id Find(Id x)
  {
    while (parent_[x] != x)
    {
      parent_[x] = parent_[parent_[x]];
      x = parent_[x];
    }
    return x;
  }

  void Unite(Id a, Id b)
  {
    a = this->Find(a);
    b = this->Find(b);
    parent_[a > b ? a : b] = a > b ? b : a;
  }

  Id Size() const { return static_cast<Id>(parent_.size()); }

private:
  std::vector<Id> parent_;
};

/// Numbers the sets 0, 1, ... in the order of their lowest members; returns the number of each
/// member's set. `count` gets the number of sets.
template<class Number>
std::vector<Number> NumberSets(UnionFind& sets, Id& count)
{
  std::vector<Number> number(sets.Size());
  count = 0;
  for (Id x = 0; x < sets.Size(); ++x)
  {
    const Id root = sets.Find(x);
    number[x] = root == x ? static_cast<Number>(count++) : number[root];
  }
  return number;
}

} // namespace gridfem

#endif
