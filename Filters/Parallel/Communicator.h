// The MPI ranks that hold a surface together: messages between them, and failures taken together.
#ifndef GridFEM_Communicator_h
#define GridFEM_Communicator_h

#include "Base/Errors.h"
#include "Base/Types.h"

#include <mpi.h>

#include <exception>
#include <string>
#include <type_traits>
#include <vector>

namespace gridfem
{

/// Thrown on every rank when one has failed; says which, and why.
struct RankFailure : std::runtime_error
{
  RankFailure(int failed, const std::string& reason) : std::runtime_error(reason), rank(failed) {}
  int rank;
};

/// A handle that does not own the communicator. All functions but Size and Rank are collective: all
/// ranks call them, in the same order.
class Communicator
{
public:
  explicit Communicator(MPI_Comm handle);

  MPI_Comm Handle() const { return handle_; }
  int Size() const { return size_; }
  int Rank() const { return rank_; }

  /// Runs the body, which is not collective, on all ranks. When one throws, all do: Aborted if that
  /// was thrown anywhere, else RankFailure with the message of the first rank that failed.
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

  /// Runs a body that calls collective functions. What it throws on this rank alone, also outside
  /// of Together, all throw, as there: every message between ranks begins with the question whether
  /// one has failed, so that the others learn it where they wait next. InvalidInput is thrown on
  /// all ranks or none, and stays what it is.
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

  /// What every message begins with, for those that are not sent here.
  void RequireAll() const { this->ThrowTogether(nullptr); }

  /// How many of the ranks run on this machine.
  int RanksOfMachine() const;

  /// The sum over the ranks of this machine.
  double SumOfMachine(double own) const;

  /// Entry by entry over the ranks, in place. The same bits on all ranks.
  void Sum(double* values, Id count) const;
  void Sum(float* values, Id count) const;
  void Minimum(double* values, Id count) const;
  void Maximum(double* values, Id count) const;

  /// What the ranks before this one have, and what all have.
  struct Share
  {
    Id before = 0;
    Id total = 0;
  };
  Share ShareOf(Id own) const;

  /// The items of all ranks, one rank after the other.
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

  /// Sends messages[r] to rank r; returns what each rank has sent here.
  template<class T>
  std::vector<std::vector<T>> Exchange(const std::vector<std::vector<T>>& messages) const
  {
    static_assert(std::is_trivially_copyable_v<T>);
    std::vector<Id> sent(size_);
    std::vector<const void*> out(size_);
    for (int r = 0; r < size_; ++r)
    {
      sent[r] = static_cast<Id>(messages[r].size());
      out[r] = messages[r].data();
    }
    const std::vector<Id> received = this->ExchangeCounts(sent);
    std::vector<std::vector<T>> result(size_);
    std::vector<void*> in(size_);
    this->Together(
      [&]
      {
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
