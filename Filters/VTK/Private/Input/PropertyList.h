// Properties of filters that are lists, such as ids of points. They change one item at a time.
#ifndef GridFEM_PropertyList_h
#define GridFEM_PropertyList_h

#include "Base/Types.h"

#include "vtkObject.h"
#include "vtkType.h"

#include <vector>

namespace gridfem
{

template<class Item>
void AddToList(
  std::vector<Item>& list, const typename std::vector<Item>::value_type& item, vtkObject* filter)
{
  list.push_back(item);
  filter->Modified();
}

/// An empty list does not change.
template<class Item>
void ClearList(std::vector<Item>& list, vtkObject* filter)
{
  if (!list.empty())
  {
    list.clear();
    filter->Modified();
  }
}

/// Returns one id of a list. -1 if there is none with this index.
inline vtkIdType IdOfList(const std::vector<Id>& list, vtkIdType index)
{
  return index >= 0 && index < static_cast<vtkIdType>(list.size()) ? list[index] : -1;
}

} // namespace gridfem

#endif
