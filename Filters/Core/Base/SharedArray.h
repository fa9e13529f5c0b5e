// An immutable array whose copies share their memory. For example, all matrices of a level share
// one pattern.
#ifndef GridFEM_SharedArray_h
#define GridFEM_SharedArray_h

#include "Base/Array.h"
#include "Base/Types.h"

namespace gridfem
{

template<class T>
class SharedArray
{
public:
  SharedArray() : SharedArray(Array<T>{}) {}
  SharedArray(Array<T> items) : items_(std::make_shared<const Array<T>>(std::move(items))) {}
  SharedArray(std::initializer_list<T> items) : SharedArray(Array<T>(items)) {}

  const T& operator[](Id place) const { return (*items_)[place]; }
  const T* data() const { return items_->data(); }
  std::size_t size() const { return items_->size(); }
  bool empty() const { return items_->empty(); }
  const T& back() const { return items_->back(); }
  auto begin() const { return items_->begin(); }
  auto end() const { return items_->end(); }

  bool operator==(const SharedArray& other) const { return *items_ == *other.items_; }

private:
  std::shared_ptr<const Array<T>> items_;
};

} // namespace gridfem

#endif
