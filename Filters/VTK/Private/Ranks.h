// The MPI ranks that a filter runs on: decisions taken together, and messages between them.
#ifndef GridFEM_Ranks_h
#define GridFEM_Ranks_h

#include "vtkType.h"

#include <exception>
#include <stdexcept>
#include <string>
#include <vector>

class vtkMultiProcessController;

namespace gridfem
{

/// Thrown beside the rank that tells what went wrong: says nothing itself.
struct FailedElsewhere : std::runtime_error
{
  FailedElsewhere() : std::runtime_error("failed on another rank") {}
};

using Bytes = std::vector<char>;

/// The ranks of VTK's global controller. Every function but the first five is collective: all ranks
/// call it, in the same order, or wait for each other for ever.
class Ranks
{
public:
  Ranks();

  /// Whether there is more than one.
  static bool AreSeveral();

  int Count() const { return count_; }
  int Own() const { return own_; }
  /// Whether this is the rank that computes.
  bool IsFirst() const { return own_ == 0; }

  /// Whether it holds on one rank at least.
  bool Any(bool holds) const;

  /// On how many ranks it holds.
  int Number(bool holds) const;

  /// Runs the body, which is not collective, on all ranks. When one throws, all do: Aborted on all
  /// if that was thrown; else the first rank the error, naming the rank that failed, and the others
  /// FailedElsewhere.
  template<class Body>
  void Together(Body&& body) const
  {
    std::exception_ptr failure;
    try
    {
      body();
    }
    catch (...)
    {
      failure = std::current_exception();
    }
    this->ThrowTogether(failure);
  }

  /// The same for a body that the first rank runs for a long time while the others sleep.
  template<class Body>
  void OnFirst(Body&& body) const
  {
    this->Together(
      [&]
      {
        if (!this->IsFirst())
        {
          this->Sleep();
          return;
        }
        const Waking waking{ *this }; // also when the body throws
        body();
      });
  }

  /// The messages of all ranks, on the first one; empty on the others.
  std::vector<Bytes> Gather(const Bytes& own) const;

  /// The message for this rank, of those of the first rank, one for each.
  Bytes Scatter(const std::vector<Bytes>& messages) const;

  /// The texts of all ranks, on all of them.
  std::vector<std::string> Exchange(const std::string& own) const;

private:
  struct Waking
  {
    const Ranks& ranks;
    ~Waking() { ranks.Wake(); }
  };

  void ThrowTogether(const std::exception_ptr& failure) const;
  void Sleep() const;
  void Wake() const;
  std::vector<vtkIdType> Lengths(std::size_t own) const;

  vtkMultiProcessController* controller_;
  int count_ = 1;
  int own_ = 0;
};

} // namespace gridfem

#endif
