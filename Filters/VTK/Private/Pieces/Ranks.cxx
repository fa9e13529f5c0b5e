#include "Pieces/Ranks.h"

#include "Base/Errors.h"
#include "Solvers/MemoryEstimate.h"
#include "Solvers/Requirements.h"

#include "vtkCommunicator.h"
#include "vtkMultiProcessController.h"
#if VTK_MODULE_ENABLE_VTK_ParallelMPI
#include "vtkMPIController.h"
#endif

#include <algorithm>
#include <chrono>
#include <new>
#include <numeric>
#include <thread>

namespace gridfem
{
namespace
{

enum Tag
{
  WakeTag = 471901,
  GatherTag,
  ScatterTag
};

/// Returns the text of an error that another rank prints.
std::string TextOf(const std::exception_ptr& failure)
{
  try
  {
    std::rethrow_exception(failure);
  }
  catch (const std::bad_alloc&)
  {
    return "out of memory.";
  }
  catch (const std::exception& error)
  {
    return error.what();
  }
  catch (...)
  {
    return "an unknown error.";
  }
}

bool IsAbort(const std::exception_ptr& failure)
{
  try
  {
    std::rethrow_exception(failure);
  }
  catch (const Aborted&)
  {
    return true;
  }
  catch (...)
  {
    return false;
  }
}

/// Checks the memory for messages before it is touched. The system kills processes that take more
/// than it has.
void RequireRoom(double bytesOfMessages)
{
  constexpr double WithSurface = 2.0; // which is read from the messages
  constexpr double Few = 1e6;
  if (bytesOfMessages < Few)
  {
    return;
  }
  RequireMemory({ WithSurface * bytesOfMessages, "What rank 0 gathers",
                  "Most filters do not gather the surface: see the help page about MPI ranks." },
    AvailableMemory());
}

/// Sleeps until a message arrives. MPI would wait with all the power of a processor, which the
/// first rank can use better.
void SleepUntilMessage(vtkMultiProcessController* controller, int tag)
{
#if VTK_MODULE_ENABLE_VTK_ParallelMPI
  if (auto* mpi = vtkMPIController::SafeDownCast(controller))
  {
    constexpr std::chrono::microseconds Longest(5000);
    std::chrono::microseconds pause(20);
    int hasArrived = 0;
    int source = 0;
    while (mpi->Iprobe(0, tag, &hasArrived, &source) && !hasArrived)
    {
      std::this_thread::sleep_for(pause);
      pause = std::min(2 * pause, Longest);
    }
  }
#else
  static_cast<void>(controller);
  static_cast<void>(tag);
#endif
}

} // namespace

Ranks::Ranks() : controller_(vtkMultiProcessController::GetGlobalController())
{
  if (controller_)
  {
    count_ = controller_->GetNumberOfProcesses();
    own_ = controller_->GetLocalProcessId();
  }
}

bool Ranks::AreSeveral()
{
  return Ranks().Count() > 1;
}

bool Ranks::Any(bool holds) const
{
  return this->Number(holds) > 0;
}

int Ranks::Number(bool holds) const
{
  const int own = holds ? 1 : 0;
  int number = 0;
  controller_->AllReduce(&own, &number, 1, vtkCommunicator::SUM_OP);
  return number;
}

void Ranks::ThrowTogether(const std::exception_ptr& failure) const
{
  const int own = failure ? own_ : count_;
  int first = count_;
  controller_->AllReduce(&own, &first, 1, vtkCommunicator::MIN_OP);
  if (first == count_)
  {
    return;
  }
  std::string text = own_ == first ? TextOf(failure) : std::string();
  int facts[2] = { static_cast<int>(text.size()), own_ == first && IsAbort(failure) };
  controller_->Broadcast(facts, 2, first);
  text.resize(facts[0]);
  if (!text.empty())
  {
    controller_->Broadcast(&text[0], facts[0], first);
  }
  if (facts[1])
  {
    throw Aborted();
  }
  if (!this->IsFirst())
  {
    throw FailedElsewhere();
  }
  if (first == 0)
  {
    std::rethrow_exception(failure);
  }
  throw InvalidInput("On rank " + std::to_string(first) + ": " + text);
}

void Ranks::Wake() const
{
  const char nothing = 0;
  for (int rank = 1; rank < count_; ++rank)
  {
    controller_->Send(&nothing, 1, rank, WakeTag);
  }
}

void Ranks::Sleep() const
{
  SleepUntilMessage(controller_, WakeTag);
  char nothing = 0;
  controller_->Receive(&nothing, 1, 0, WakeTag);
}

std::vector<vtkIdType> Ranks::Lengths(std::size_t own) const
{
  const auto length = static_cast<vtkIdType>(own);
  std::vector<vtkIdType> lengths(count_);
  controller_->AllGather(&length, lengths.data(), 1);
  return lengths;
}

std::vector<Bytes> Ranks::Gather(const Bytes& own) const
{
  const std::vector<vtkIdType> lengths = this->Lengths(own.size());
  std::vector<Bytes> messages;
  this->Together( // all have memory, or nobody sends
    [&]
    {
      if (this->IsFirst())
      {
        RequireRoom(std::accumulate(lengths.begin() + 1, lengths.end(), 0.0));
      }
      for (int rank = 0; this->IsFirst() && rank < count_; ++rank)
      {
        messages.emplace_back(rank == 0 ? own : Bytes(lengths[rank]));
      }
    });
  if (!this->IsFirst())
  {
    controller_->Send(own.data(), lengths[own_], 0, GatherTag);
    return messages;
  }
  for (int rank = 1; rank < count_; ++rank)
  {
    controller_->Receive(messages[rank].data(), lengths[rank], rank, GatherTag);
  }
  return messages;
}

Bytes Ranks::Scatter(const std::vector<Bytes>& messages) const
{
  std::vector<vtkIdType> lengths(count_);
  for (std::size_t rank = 0; rank < messages.size(); ++rank)
  {
    lengths[rank] = static_cast<vtkIdType>(messages[rank].size());
  }
  controller_->Broadcast(lengths.data(), count_, 0);
  Bytes own;
  this->Together([&] { own = this->IsFirst() ? messages[0] : Bytes(lengths[own_]); });
  if (!this->IsFirst())
  {
    controller_->Receive(own.data(), lengths[own_], 0, ScatterTag);
    return own;
  }
  for (int rank = 1; rank < count_; ++rank)
  {
    controller_->Send(messages[rank].data(), lengths[rank], rank, ScatterTag);
  }
  return own;
}

std::vector<std::string> Ranks::Exchange(const std::string& own) const
{
  std::vector<vtkIdType> lengths = this->Lengths(own.size());
  std::vector<vtkIdType> offsets(count_, 0);
  std::partial_sum(lengths.begin(), lengths.end() - 1, offsets.begin() + 1);
  std::string all(offsets.back() + lengths.back(), ' ');
  controller_->AllGatherV(own.data(), &all[0], lengths[own_], lengths.data(), offsets.data());
  std::vector<std::string> texts;
  texts.reserve(count_);
  for (int rank = 0; rank < count_; ++rank)
  {
    texts.push_back(all.substr(offsets[rank], lengths[rank]));
  }
  return texts;
}

} // namespace gridfem
