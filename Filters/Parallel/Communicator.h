// The MPI ranks that hold a surface: messages between them, and a common reaction to failures.
#ifndef GridFEM_Communicator_h
#define GridFEM_Communicator_h

#include "Base/Errors.h"
#include "Base/Types.h"

#include <mpi.h>

#include <exception>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

namespace gridfem
{

/// Thrown on every rank when one rank has failed; names the rank and the reason.
struct RankFailure : std::runtime_error
{
  RankFailure(int failed, const std::string& reason) : std::runtime_error(reason), rank(failed) {}
  int rank;
};

/// Throws if ranks have sent other numbers of items than this rank expects from them.
void RequireCounts(const std::vector<Id>& received, const std::vector<Id>& expected);

/// Throws if a rank has sent a place outside [0, places).
void RequirePlace(Id place, Id places);

/// The number of items in each list.
template<class Item>
std::vector<Id> SizesOf(const std::vector<std::vector<Item>>& lists)
{
  std::vector<Id> sizes;
  sizes.reserve(lists.size());
  for (const std::vector<Item>& list : lists)
  {
    sizes.push_back(static_cast<Id>(list.size()));
  }
  return sizes;
}

/// A handle that does not own the communicator. All functions but Size and Rank are collective: all
/// ranks call them, in the same order.
class Communicator
{
public:
  explicit Communicator(MPI_Comm handle);

  MPI_Comm Handle() const { return handle_; }
  int Size() const { return size_; }
  int Rank() const { return rank_; }

  /// Runs the body, which is not collective, on all ranks. If it throws on one rank, all ranks
  /// throw: Aborted if any rank threw Aborted, else RankFailure with the message of the first rank
  /// that failed.
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

  /// Runs a body that calls collective functions. If it throws on this rank alone, even outside of
  /// Together, all ranks throw, as with Together. Every message between ranks first asks whether a
  /// rank has failed, so the other ranks learn of it at their next wait. InvalidInput has to be
  /// thrown on all ranks or none, and is passed on unchanged.
  template<class Body>
  void Guard(Body&& body) const
  {
    std::exception_ptr failure;
    try
    {
      body();
    }
    catch (const RankFailure&)
    {
      throw;
    }
    catch (const Aborted&)
    {
      throw;
    }
    catch (const InvalidInput&)
    {
      throw;
    }
    catch (...)
    {
      failure = std::current_exception();
    }
    this->ThrowTogether(failure);
  }

  /// The check for failures that starts every message, for callers that send their own messages.
  void RequireAll() const { this->ThrowTogether(nullptr); }

  /// The number of ranks that run on this machine.
  int RanksOfMachine() const;

  /// The sum over the ranks of this machine.
  double SumOfMachine(double own) const;

  /// Reductions over the ranks, entry by entry and in place. The same bits on all ranks.
  void Sum(double* values, Id count) const;
  void Sum(float* values, Id count) const;
  void Minimum(double* values, Id count) const;
  void Maximum(double* values, Id count) const;

  /// The count of the ranks before this one, and the count of all ranks.
  struct Share
  {
    Id before = 0;
    Id total = 0;
  };
  Share ShareOf(Id own) const;

  /// The items of all ranks, ordered by rank.
  template<class T>
  std::vector<T> Gather(const std::vector<T>& own) const
  {
    static_assert(std::is_trivially_copyable_v<T>);
    const std::vector<Id> counts = this->Counts(static_cast<Id>(own.size()));
    Id total = 0;
    for (const Id count : counts)
    {
      total += count;
    }
    std::vector<T> all;
    this->Together([&] { all.resize(total); });
    this->GatherBytes(own.data(), counts, sizeof(T), all.data());
    return all;
  }

  /// Sends messages[r] to rank r, and returns the messages that each rank has sent here.
  /// @param expected  the number of items from each rank, if this rank knows it; all ranks throw if
  ///                  a rank has sent another number
  template<class T>
  std::vector<std::vector<T>> Exchange(const std::vector<std::vector<T>>& messages,
    const std::optional<std::vector<Id>>& expected = {}) const
  {
    static_assert(std::is_trivially_copyable_v<T>);
    const std::vector<Id> sent = SizesOf(messages);
    std::vector<const void*> out(size_);
    for (int r = 0; r < size_; ++r)
    {
      out[r] = messages[r].data();
    }
    const std::vector<Id> received = this->ExchangeCounts(sent);
    std::vector<std::vector<T>> result(size_);
    std::vector<void*> in(size_);
    this->Together(
      [&]
      {
        if (expected)
        {
          RequireCounts(received, *expected);
        }
        for (int r = 0; r < size_; ++r)
        {
          result[r].resize(received[r]);
          in[r] = result[r].data();
        }
      });
    this->ExchangeBytes(out, sent, in, received, sizeof(T));
    return result;
  }

private:
  void ThrowTogether(const std::exception_ptr& failure) const;
  std::vector<Id> Counts(Id own) const;
  std::vector<Id> ExchangeCounts(const std::vector<Id>& sent) const;
  void GatherBytes(
    const void* own, const std::vector<Id>& counts, std::size_t itemSize, void* all) const;
  void ExchangeBytes(const std::vector<const void*>& out, const std::vector<Id>& sent,
    const std::vector<void*>& in, const std::vector<Id>& received, std::size_t itemSize) const;

  MPI_Comm handle_;
  int size_ = 1;
  int rank_ = 0;
};

} // namespace gridfem

#endif
