#include "Parallel/Communicator.h"

#include <algorithm>
#include <limits>
#include <new>
#include <numeric>
#include <stdexcept>

namespace gridfem
{

namespace
{

/// Outcomes that the ranks exchange after a failure. The largest wins.
enum Outcome
{
  Fine = 0,
  Failed = 1,
  WasAborted = 2
};

struct Failure
{
  int outcome = Fine;
  std::string reason;
};

Failure Describe(const std::exception_ptr& failure)
{
  if (!failure)
  {
    return {};
  }
  try
  {
    std::rethrow_exception(failure);
  }
  catch (const Aborted&)
  {
    return { WasAborted, "aborted" };
  }
  catch (const std::bad_alloc&)
  {
    return { Failed, "There is not enough memory." };
  }
  catch (const std::exception& error)
  {
    return { Failed, error.what() };
  }
  catch (...)
  {
    return { Failed, "An unknown error." };
  }
}

/// Items as one MPI type, so that MPI counts items and not bytes.
class ItemType
{
public:
  explicit ItemType(std::size_t size)
  {
    MPI_Type_contiguous(static_cast<int>(size), MPI_BYTE, &type_);
    MPI_Type_commit(&type_);
  }
  ~ItemType() { MPI_Type_free(&type_); }
  ItemType(const ItemType&) = delete;
  ItemType& operator=(const ItemType&) = delete;
  operator MPI_Datatype() const { return type_; }

private:
  MPI_Datatype type_ = MPI_DATATYPE_NULL;
};

/// Largest number of items in a message, because MPI counts them with 32 bits.
constexpr Id ItemsPerMessage = std::numeric_limits<int>::max() / 2;

/// Returns the count as MPI takes it. All ranks have the same count, so that all throw or none.
int CountOf(Id items)
{
  if (items > std::numeric_limits<int>::max())
  {
    throw InvalidInput("The ranks hold more than 2^31 - 1 items that all of them need.");
  }
  return static_cast<int>(items);
}

} // namespace

void RequireCounts(const std::vector<Id>& received, const std::vector<Id>& expected)
{
  const auto [wrong, right] =
    std::mismatch(received.begin(), received.end(), expected.begin(), expected.end());
  if (wrong != received.end() && right != expected.end())
  {
    throw std::length_error("Rank " + std::to_string(wrong - received.begin()) + " has sent " +
                            std::to_string(*wrong) + " items, but " + std::to_string(*right) +
                            " are expected.");
  }
}

void RequirePlace(Id place, Id places)
{
  if (place < 0 || place >= places)
  {
    throw std::out_of_range("A rank has sent place " + std::to_string(place) + ", but there are " +
                            std::to_string(places) + ".");
  }
}

Communicator::Communicator(MPI_Comm handle) : handle_(handle)
{
  MPI_Comm_size(handle_, &size_);
  MPI_Comm_rank(handle_, &rank_);
}

void Communicator::ThrowTogether(const std::exception_ptr& failure) const
{
  const Failure own = Describe(failure);
  // The worst outcome. If several ranks have it, the lowest rank counts.
  int mine[2] = { own.outcome, rank_ };
  int worst[2] = { Fine, 0 };
  MPI_Allreduce(mine, worst, 1, MPI_2INT, MPI_MAXLOC, handle_);
  if (worst[0] == Fine)
  {
    return;
  }
  if (worst[0] == WasAborted)
  {
    throw Aborted();
  }
  auto length = static_cast<int>(own.reason.size());
  MPI_Bcast(&length, 1, MPI_INT, worst[1], handle_);
  std::string reason = rank_ == worst[1] ? own.reason : std::string(length, ' ');
  MPI_Bcast(reason.data(), length, MPI_CHAR, worst[1], handle_);
  throw RankFailure(worst[1], reason);
}

int Communicator::RanksOfMachine() const
{
  return static_cast<int>(this->SumOfMachine(1.0));
}

double Communicator::SumOfMachine(double own) const
{
  this->RequireAll();
  MPI_Comm machine = MPI_COMM_NULL;
  MPI_Comm_split_type(handle_, MPI_COMM_TYPE_SHARED, rank_, MPI_INFO_NULL, &machine);
  double sum = own;
  MPI_Allreduce(&own, &sum, 1, MPI_DOUBLE, MPI_SUM, machine);
  MPI_Comm_free(&machine);
  return sum;
}

void Communicator::Sum(double* values, Id count) const
{
  this->RequireAll();
  MPI_Allreduce(MPI_IN_PLACE, values, CountOf(count), MPI_DOUBLE, MPI_SUM, handle_);
}

void Communicator::Sum(float* values, Id count) const
{
  this->RequireAll();
  MPI_Allreduce(MPI_IN_PLACE, values, CountOf(count), MPI_FLOAT, MPI_SUM, handle_);
}

void Communicator::Minimum(double* values, Id count) const
{
  this->RequireAll();
  MPI_Allreduce(MPI_IN_PLACE, values, CountOf(count), MPI_DOUBLE, MPI_MIN, handle_);
}

void Communicator::Maximum(double* values, Id count) const
{
  this->RequireAll();
  MPI_Allreduce(MPI_IN_PLACE, values, CountOf(count), MPI_DOUBLE, MPI_MAX, handle_);
}

Communicator::Share Communicator::ShareOf(Id own) const
{
  const std::vector<Id> counts = this->Counts(own);
  return { std::accumulate(counts.begin(), counts.begin() + rank_, Id{ 0 }),
    std::accumulate(counts.begin(), counts.end(), Id{ 0 }) };
}

std::vector<Id> Communicator::Counts(Id own) const
{
  this->RequireAll();
  std::vector<Id> counts(size_);
  MPI_Allgather(&own, 1, MPI_INT64_T, counts.data(), 1, MPI_INT64_T, handle_);
  return counts;
}

std::vector<Id> Communicator::ExchangeCounts(const std::vector<Id>& sent) const
{
  this->RequireAll();
  std::vector<Id> received(size_);
  MPI_Alltoall(sent.data(), 1, MPI_INT64_T, received.data(), 1, MPI_INT64_T, handle_);
  return received;
}

void Communicator::GatherBytes(
  const void* own, const std::vector<Id>& counts, std::size_t itemSize, void* all) const
{
  std::vector<int> count(size_);
  std::vector<int> begin(size_);
  Id total = 0;
  for (int r = 0; r < size_; ++r)
  {
    count[r] = CountOf(counts[r]);
    begin[r] = CountOf(total);
    total += counts[r];
  }
  CountOf(total);
  this->RequireAll();
  const ItemType type(itemSize);
  MPI_Allgatherv(own, count[rank_], type, all, count.data(), begin.data(), type, handle_);
}

/// Sends bytes from each rank to each other, in parts that MPI can count. Ranks without data for
/// each other exchange no message.
void Communicator::ExchangeBytes(const std::vector<const void*>& out, const std::vector<Id>& sent,
  const std::vector<void*>& in, const std::vector<Id>& received, std::size_t itemSize) const
{
  constexpr int Tag = 1907;
  const auto partsOf = [](const std::vector<Id>& items)
  {
    return std::accumulate(items.begin(), items.end(), Id{ 0 },
      [](Id sum, Id count) { return sum + count / ItemsPerMessage + 1; });
  };
  std::vector<MPI_Request> requests;
  requests.reserve(partsOf(sent) + partsOf(received));
  this->RequireAll();
  const ItemType type(itemSize);
  const auto inParts = [&](Id items, const auto& transfer)
  {
    for (Id begin = 0; begin < items; begin += ItemsPerMessage)
    {
      requests.emplace_back();
      transfer(begin * itemSize, CountOf(std::min(ItemsPerMessage, items - begin)));
    }
  };
  for (int r = 0; r < size_; ++r)
  {
    inParts(received[r],
      [&](std::size_t offset, int count) {
        MPI_Irecv(
          static_cast<char*>(in[r]) + offset, count, type, r, Tag, handle_, &requests.back());
      });
  }
  for (int r = 0; r < size_; ++r)
  {
    inParts(sent[r],
      [&](std::size_t offset, int count)
      {
        MPI_Isend(static_cast<const char*>(out[r]) + offset, count, type, r, Tag, handle_,
          &requests.back());
      });
  }
  MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
}

} // namespace gridfem
