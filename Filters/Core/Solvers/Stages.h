// Runs the steps of a solver. Each step remembers its inputs and runs again only if they change.
#ifndef GridFEM_Stages_h
#define GridFEM_Stages_h

#include "Solvers/StageKey.h"

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <utility>

namespace gridfem
{

/// Runs stages if their keys change, counts the runs and measures their time. The name of a stage
/// is its identity.
class Stages
{
public:
  /// Runs `body` unless the stage's last result has this key. A body that throws leaves no result.
  template<class Body>
  void Run(const std::string& stage, const StageKey& key, Body&& body)
  {
    Entry& entry = entries_[stage];
    const bool isCurrent = this->IsCurrent(stage, key);
    if (anywhere_ ? !anywhere_(!isCurrent) : isCurrent)
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

  /// Makes Run collective: a stage runs in all processes if it has to run in one.
  /// @param anywhere  tells whether a condition holds in one of them; null: this process is alone
  void DecideTogether(std::function<bool(bool)> anywhere) { anywhere_ = std::move(anywhere); }

  bool IsCurrent(const std::string& stage, const StageKey& key) const
  {
    const Entry& entry = this->Find(stage);
    return entry.valid && entry.key == key;
  }

  /// Notes a result that was made elsewhere. This does not count as a run.
  void Adopt(const std::string& stage, const StageKey& key)
  {
    Entry& entry = entries_[stage];
    entry.key = key;
    entry.valid = true;
    ++entry.version;
  }

  /// Makes every stage run again. Counts and times stay.
  void Forget()
  {
    for (auto& [name, entry] : entries_)
    {
      entry.valid = false;
    }
  }

  /// Makes one stage run again.
  void Forget(const std::string& stage) { entries_[stage].valid = false; }

  /// Returns a number that changes with every new result. It is part of the keys of later stages.
  std::int64_t Version(const std::string& stage) const { return this->Find(stage).version; }

  /// Returns 0 for a stage that has not run.
  std::int64_t Runs(const std::string& stage) const { return this->Find(stage).runs; }
  double Seconds(const std::string& stage) const { return this->Find(stage).seconds; }

private:
  struct Entry
  {
    StageKey key;
    bool valid = false;
    std::int64_t version = 0;
    std::int64_t runs = 0;
    double seconds = 0.0;
  };

  const Entry& Find(const std::string& stage) const
  {
    static const Entry none;
    const auto found = entries_.find(stage);
    return found == entries_.end() ? none : found->second;
  }

  std::map<std::string, Entry> entries_;
  std::function<bool(bool)> anywhere_;
};

} // namespace gridfem

#endif
