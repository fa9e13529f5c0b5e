// Provides decisions that the MPI ranks of a filter make together, and messages between them.
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

/// Thrown on all ranks except the rank that reports the error. Prints nothing itself.
struct FailedElsewhere : std::runtime_error
{
  FailedElsewhere() : std::runtime_error("failed on another rank") {}
};

using Bytes = std::vector<char>;

/// The ranks of VTK's global controller. Every function but the first five is collective: all ranks
/// have to call it, in the same order. Otherwise the ranks wait for each other forever.
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

  /// Whether a condition holds on at least one rank.
  bool Any(bool holds) const;

  /// The number of ranks on which a condition holds.
  int Number(bool holds) const;

  /// Runs the body, which is not collective, on all ranks. If one rank throws, all do. All throw
  /// Aborted if that was thrown. Otherwise the first rank throws the error, naming the rank that
  /// failed, and the others throw FailedElsewhere.
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

  /// Does the same for a body that the first rank runs for a long time while the others sleep.
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

  /// Returns the messages of all ranks on the first one. Empty on the others.
  std::vector<Bytes> Gather(const Bytes& own) const;

  /// Returns the message for this rank. The first rank gives one for each.
  Bytes Scatter(const std::vector<Bytes>& messages) const;

  /// Returns the texts of all ranks, on all of them.
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
