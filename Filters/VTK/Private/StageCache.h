// Which stage of a filter has to run again: every stage remembers what it was made from.
#ifndef GridFEM_StageCache_h
#define GridFEM_StageCache_h

#include <array>
#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

class vtkObject;

namespace gridfem
{

/// Everything a stage depends on, as a list of numbers.
class StageKey
{
public:
  StageKey& Add(std::int64_t value);
  StageKey& Add(int value) { return this->Add(static_cast<std::int64_t>(value)); }
  StageKey& Add(bool value) { return this->Add(static_cast<std::int64_t>(value)); }
  StageKey& Add(double value);
  StageKey& Add(const std::string& value);
  /// Address and modification time; the time alone is unique in a process. May be null.
  StageKey& Add(vtkObject* object);

  bool operator==(const StageKey& other) const { return parts_ == other.parts_; }

private:
  std::vector<std::uint64_t> parts_;
};

/// Runs stages when their keys change; counts the runs and takes their time.
class StageCache
{
public:
  static constexpr int Capacity = 8;

  /// Runs `body` unless the stage's last result has this key. A body that throws leaves no result.
  template<class Body>
  void Run(int stage, const StageKey& key, Body&& body)
  {
    Entry& entry = entries_[stage];
    if (this->IsCurrent(stage, key))
    {
      return;
    }
    entry.valid = false;
    const auto start = std::chrono::steady_clock::now();
    body();
    entry.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    ++entry.runs;
    this->Adopt(stage, key);
  }

  bool IsCurrent(int stage, const StageKey& key) const
  {
    return entries_[stage].valid && entries_[stage].key == key;
  }

  /// Notes a result that was made elsewhere: it counts as no run.
  void Adopt(int stage, const StageKey& key)
  {
    entries_[stage].key = key;
    entries_[stage].valid = true;
    ++entries_[stage].version;
  }

  /// Every stage has to run again; counts and times stay.
  void Forget()
  {
    for (Entry& entry : entries_)
    {
      entry.valid = false;
    }
  }

  /// Changes with every new result: part of the keys of later stages.
  std::int64_t Version(int stage) const { return entries_[stage].version; }

  std::int64_t Runs(int stage) const { return entries_[stage].runs; }
  double Seconds(int stage) const { return entries_[stage].seconds; }

private:
  struct Entry
  {
    StageKey key;
    bool valid = false;
    std::int64_t version = 0;
    std::int64_t runs = 0;
    double seconds = 0.0;
  };
  std::array<Entry, Capacity> entries_;
};

} // namespace gridfem

#endif
