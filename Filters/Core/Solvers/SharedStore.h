// Stores things that several filters make from the same surface. Each is made once while somebody
// uses it.
#ifndef GridFEM_SharedStore_h
#define GridFEM_SharedStore_h

#include <map>
#include <memory>
#include <mutex>

namespace gridfem
{

/// Holds only the thing that was requested last. The others live as long as their users. Safe to
/// call from several threads.
template<class Key, class Value>
class SharedStore
{
public:
  using Pointer = std::shared_ptr<const Value>;

  /// Returns null if there is none.
  Pointer Find(const Key& key)
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    return this->Known(key);
  }

  /// Calls build() if there is none. A second caller waits. If build() throws, nothing is stored.
  template<class Build>
  Pointer Get(const Key& key, Build&& build)
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    Pointer thing = this->Known(key);
    if (!thing)
    {
      last_.reset(); // frees its memory first
      thing = last_ = std::make_shared<const Value>(build());
      known_[key] = thing;
    }
    return thing;
  }

private:
  Pointer Known(const Key& key)
  {
    const auto found = known_.find(key);
    Pointer thing = found == known_.end() ? nullptr : found->second.lock();
    if (thing)
    {
      last_ = thing;
    }
    return thing;
  }

  std::mutex mutex_;
  std::map<Key, std::weak_ptr<const Value>> known_;
  Pointer last_;
};

} // namespace gridfem

#endif
