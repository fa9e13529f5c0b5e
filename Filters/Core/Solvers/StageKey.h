// Identifies the inputs of a stage. The numbers of a key change if the stage has to run again.
#ifndef GridFEM_StageKey_h
#define GridFEM_StageKey_h

#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

namespace gridfem
{

/// A list of numbers. Two keys are equal if their numbers are equal.
class StageKey
{
public:
  StageKey& Add(std::int64_t value);
  StageKey& Add(int value) { return this->Add(static_cast<std::int64_t>(value)); }
  StageKey& Add(bool value) { return this->Add(static_cast<std::int64_t>(value)); }
  StageKey& Add(double value);
  StageKey& Add(const std::string& value);
  StageKey& Add(const StageKey& other);

  template<class Enum, std::enable_if_t<std::is_enum_v<Enum>, int> = 0>
  StageKey& Add(Enum value)
  {
    return this->Add(static_cast<std::int64_t>(value));
  }

  template<class Item>
  StageKey& Add(const std::vector<Item>& items)
  {
    this->Add(static_cast<std::int64_t>(items.size()));
    for (const Item& item : items)
    {
      this->Add(item);
    }
    return *this;
  }

  /// Adds an object that numbers its changes: its address and that number. May be null.
  template<class Object>
  auto Add(Object* object) -> decltype(static_cast<void>(object->GetMTime()), *this)
  {
    this->Add(static_cast<std::int64_t>(reinterpret_cast<std::intptr_t>(object)));
    return this->Add(static_cast<std::int64_t>(object ? object->GetMTime() : 0));
  }

  /// Deleted, because any other pointer would count as a bool.
  StageKey& Add(const void* object) = delete;

  bool operator==(const StageKey& other) const { return parts_ == other.parts_; }
  bool operator!=(const StageKey& other) const { return !(*this == other); }

private:
  std::vector<std::uint64_t> parts_;
};

} // namespace gridfem

#endif
