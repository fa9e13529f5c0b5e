// Memory, loops and copies of a device. One source, compiled twice: by nvcc for a GPU, and by any
// other compiler for the threads of the host, where tests compare it with Core. No other file knows
// CUDA.
#ifndef GridFEM_Device_Memory_h
#define GridFEM_Device_Memory_h

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#ifdef __CUDACC__
#include <cuda_runtime.h>
#define GRIDFEM_ON_DEVICE __host__ __device__ __forceinline__
#else
#define GRIDFEM_ON_DEVICE inline
#endif
#ifdef __CUDA_ARCH__
#define GRIDFEM_UNROLL _Pragma("unroll 6")
#else
#define GRIDFEM_UNROLL
#endif

namespace gridfem::device
{

using Index = std::int32_t;
using Id = std::int64_t;

/// How terms are joined, from 0.
struct Sum
{
  GRIDFEM_ON_DEVICE static double Of(double a, double b) { return a + b; }
};

/// For numbers that are not negative. NaN is larger than any number.
struct Largest
{
  GRIDFEM_ON_DEVICE static double Of(double a, double b) { return a >= b || a != a ? a : b; }
};

/// Blocks whose terms are joined first, and the threads of each.
constexpr Index JoinBlocks = 256;
constexpr Index JoinThreads = 256;

#ifdef __CUDACC__

inline void Check(cudaError_t error)
{
  if (error != cudaSuccess)
  {
    cudaGetLastError(); // the next call starts without this error
    throw std::runtime_error(cudaGetErrorString(error));
  }
}

inline void* TakeMemory(std::size_t bytes)
{
  void* memory = nullptr;
  Check(cudaMalloc(&memory, bytes));
  return memory;
}

inline void FreeMemory(void* memory) noexcept
{
  cudaFree(memory);
}

/// Memory of the host that the device copies fast.
inline void* TakeHostMemory(std::size_t bytes)
{
  void* memory = nullptr;
  Check(cudaMallocHost(&memory, bytes));
  return memory;
}

inline void FreeHostMemory(void* memory) noexcept
{
  cudaFreeHost(memory);
}

template<class Body>
__global__ void RunBody(Index count, Body body)
{
  const Index i = blockIdx.x * blockDim.x + threadIdx.x;
  if (i < count)
  {
    body(i);
  }
}

/// parts[column][block] = the terms of a block, joined in fixed order.
template<class Join, class Term>
__global__ void JoinTerms(Index count, Term term, double* parts)
{
  __shared__ double own[JoinThreads];
  double joined = 0.0;
  for (Index i = blockIdx.x * JoinThreads + threadIdx.x; i < count; i += gridDim.x * JoinThreads)
  {
    joined = Join::Of(joined, term(i, blockIdx.y));
  }
  own[threadIdx.x] = joined;
  for (Index half = JoinThreads / 2; half > 0; half /= 2)
  {
    __syncthreads();
    if (threadIdx.x < half)
    {
      own[threadIdx.x] = Join::Of(own[threadIdx.x], own[threadIdx.x + half]);
    }
  }
  if (threadIdx.x == 0)
  {
    parts[blockIdx.y * gridDim.x + blockIdx.x] = own[0];
  }
}

#else

inline void* TakeMemory(std::size_t bytes)
{
  return ::operator new(bytes);
}

inline void FreeMemory(void* memory) noexcept
{
  ::operator delete(memory);
}

inline void* TakeHostMemory(std::size_t bytes)
{
  return ::operator new(bytes);
}

inline void FreeHostMemory(void* memory) noexcept
{
  ::operator delete(memory);
}

#endif

/// An array of the device, or memory of the host for copies.
template<class T, void* (*Take)(std::size_t), void (*Free)(void*) noexcept>
class BasicBuffer
{
public:
  BasicBuffer() = default;
  explicit BasicBuffer(std::size_t size)
    : data_(size > 0 ? static_cast<T*>(Take(size * sizeof(T))) : nullptr), size_(size)
  {
  }
  BasicBuffer(BasicBuffer&& other) noexcept { this->Swap(other); }
  BasicBuffer& operator=(BasicBuffer&& other) noexcept
  {
    this->Swap(other);
    return *this;
  }
  ~BasicBuffer()
  {
    if (data_)
    {
      Free(data_);
    }
  }

  T* Data() const { return data_; }
  std::size_t Size() const { return size_; }
  std::size_t Bytes() const { return size_ * sizeof(T); }

private:
  void Swap(BasicBuffer& other)
  {
    std::swap(data_, other.data_);
    std::swap(size_, other.size_);
  }

  T* data_ = nullptr;
  std::size_t size_ = 0;
};

template<class T>
using Buffer = BasicBuffer<T, TakeMemory, FreeMemory>;
template<class T>
using HostBuffer = BasicBuffer<T, TakeHostMemory, FreeHostMemory>;

/// Work that was recorded once and is run many times.
class Recording
{
public:
  Recording() = default;
  Recording(Recording&& other) noexcept : run_(std::exchange(other.run_, {})) {}
  Recording& operator=(Recording&& other) noexcept
  {
    std::swap(run_, other.run_);
    return *this;
  }

#ifdef __CUDACC__
  ~Recording()
  {
    if (run_)
    {
      cudaGraphExecDestroy(run_);
    }
  }
  explicit operator bool() const
  {
    return run_ != nullptr;
  }

private:
  friend class Queue;
  cudaGraphExec_t run_ = nullptr;
#else
  explicit operator bool() const
  {
    return static_cast<bool>(run_);
  }

private:
  friend class Queue;
  std::function<void()> run_;
#endif
};

/// The parts that are joined last.
struct Parts
{
  const double* parts;

  GRIDFEM_ON_DEVICE double operator()(Index i, Index column) const
  {
    return parts[column * JoinBlocks + i];
  }
};

/// Runs loops and copies one after the other, while the host goes on. Wait waits for all of them.
class Queue
{
public:
  Queue(const Queue&) = delete;
  Queue& operator=(const Queue&) = delete;

#ifdef __CUDACC__
  Queue()
  {
    Check(cudaStreamCreateWithFlags(&stream_, cudaStreamNonBlocking));
    Check(cudaEventCreate(&begin_));
    Check(cudaEventCreate(&end_));
  }
  ~Queue()
  {
    cudaEventDestroy(begin_);
    cudaEventDestroy(end_);
    cudaStreamDestroy(stream_);
  }

  /// Runs body(i) for every i in [0, count), in any order.
  template<class Body>
  void ForEach(Index count, const Body& body)
  {
    constexpr Index Threads = 128;
    if (count > 0)
    {
      RunBody<<<(count + Threads - 1) / Threads, Threads, 0, stream_>>>(count, body);
      Check(cudaGetLastError());
    }
  }

  /// Joins term(i, column) for every i in [0, count), for each column. Same bits for every call.
  /// @param parts   of the device, JoinBlocks numbers for each column
  /// @param result  of the device, one number for each column
  template<class Join, class Term>
  void JoinAll(Index count, Index columns, const Term& term, double* parts, double* result)
  {
    const dim3 blocks(JoinBlocks, columns);
    JoinTerms<Join><<<blocks, JoinThreads, 0, stream_>>>(count, term, parts);
    Check(cudaGetLastError());
    const dim3 last(1, columns);
    JoinTerms<Join><<<last, JoinThreads, 0, stream_>>>(JoinBlocks, Parts{ parts }, result);
    Check(cudaGetLastError());
  }

  template<class T>
  void Upload(const T* from, std::size_t count, T* to)
  {
    Check(cudaMemcpyAsync(to, from, count * sizeof(T), cudaMemcpyHostToDevice, stream_));
  }

  template<class T>
  void Download(const T* from, std::size_t count, T* to)
  {
    Check(cudaMemcpyAsync(to, from, count * sizeof(T), cudaMemcpyDeviceToHost, stream_));
  }

  void Wait()
  {
    Check(cudaStreamSynchronize(stream_));
  }

  /// Records what body gives to this queue. Body must neither wait nor take memory.
  Recording Record(const std::function<void()>& body)
  {
    Recording recording;
    cudaGraph_t graph = nullptr;
    Check(cudaStreamBeginCapture(stream_, cudaStreamCaptureModeThreadLocal));
    body();
    Check(cudaStreamEndCapture(stream_, &graph));
    const cudaError_t error = cudaGraphInstantiate(&recording.run_, graph, 0);
    cudaGraphDestroy(graph);
    Check(error);
    return recording;
  }

  /// Runs what was recorded, and measures its time.
  void Run(const Recording& recording)
  {
    Check(cudaEventRecord(begin_, stream_));
    Check(cudaGraphLaunch(recording.run_, stream_));
    Check(cudaEventRecord(end_, stream_));
  }

  /// Seconds that the last Run took on the device. To be called after Wait.
  double Seconds() const
  {
    float milliseconds = 0.0f;
    Check(cudaEventElapsedTime(&milliseconds, begin_, end_));
    return 1e-3 * milliseconds;
  }

private:
  cudaStream_t stream_ = nullptr;
  cudaEvent_t begin_ = nullptr;
  cudaEvent_t end_ = nullptr;
#else
  Queue() = default;

  template<class Body>
  void ForEach(Index count, const Body& body)
  {
#pragma omp parallel for schedule(static) if (count > 4096)
    for (Index i = 0; i < count; ++i)
    {
      body(i);
    }
  }

  template<class Join, class Term>
  void JoinAll(Index count, Index columns, const Term& term, double* parts, double* result)
  {
    for (Index column = 0; column < columns; ++column)
    {
      double* const own = parts + column * JoinBlocks;
      this->ForEach(JoinBlocks,
        [&](Index block)
        {
          double joined = 0.0;
          for (Id i = Id(block) * count / JoinBlocks; i < (Id(block) + 1) * count / JoinBlocks; ++i)
          {
            joined = Join::Of(joined, term(static_cast<Index>(i), column));
          }
          own[block] = joined;
        });
      result[column] = 0.0;
      for (Index block = 0; block < JoinBlocks; ++block)
      {
        result[column] = Join::Of(result[column], own[block]);
      }
    }
  }

  template<class T>
  void Upload(const T* from, std::size_t count, T* to)
  {
    std::copy(from, from + count, to);
  }

  template<class T>
  void Download(const T* from, std::size_t count, T* to)
  {
    std::copy(from, from + count, to);
  }

  void Wait()
  {
  }

  Recording Record(std::function<void()> body)
  {
    Recording recording;
    recording.run_ = std::move(body);
    return recording;
  }

  void Run(const Recording& recording)
  {
    const auto begin = std::chrono::steady_clock::now();
    recording.run_();
    seconds_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  }

  double Seconds() const
  {
    return seconds_;
  }

private:
  double seconds_ = 0.0;
#endif
};

/// Copies an array of the host to the device. The host's array may go once the queue has waited.
template<class T>
Buffer<T> Copy(Queue& queue, const T* from, std::size_t count)
{
  Buffer<T> to(count);
  queue.Upload(from, count, to.Data());
  return to;
}

template<class T>
Buffer<T> Copy(Queue& queue, const std::vector<T>& from)
{
  return Copy(queue, from.data(), from.size());
}

#ifdef __CUDACC__
/// The name of the first card, or an empty string.
inline std::string CardName(std::string& whyNot)
{
  int count = 0;
  cudaDeviceProp card;
  cudaError_t error = cudaGetDeviceCount(&count);
  if (error == cudaErrorInsufficientDriver || error == cudaErrorNoDevice || count == 0)
  {
    whyNot = "there is no NVIDIA card, or its driver is missing or too old";
    return "";
  }
  error = error == cudaSuccess ? cudaGetDeviceProperties(&card, 0) : error;
  if (error != cudaSuccess)
  {
    whyNot = cudaGetErrorString(error);
    return "";
  }
  return card.name;
}
#else
inline std::string CardName(std::string&)
{
  return "host";
}
#endif

} // namespace gridfem::device

#endif
