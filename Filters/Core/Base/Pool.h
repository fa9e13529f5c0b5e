// Work space of parallel jobs: as many as run at the same time, kept from one to the next.
#ifndef GridFEM_Pool_h
#define GridFEM_Pool_h

#include <cstddef>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace gridfem
{

template<class Space>
class Pool
{
public:
  /// A space for the life of this object, nobody else's meanwhile; what it held stays in it.
  class Loan
  {
  public:
    explicit Loan(Pool& pool) : pool_(pool), space_(pool.Take()) {}
    ~Loan() { pool_.Return(std::move(space_)); }
    Loan(const Loan&) = delete;
    Loan& operator=(const Loan&) = delete;

    Space& operator*() const { return *space_; }

  private:
    Pool& pool_;
    std::unique_ptr<Space> space_;
  };

private:
  std::unique_ptr<Space> Take()
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (free_.empty())
    {
      free_.reserve(made_ + 1); // Return must not fail
      auto space = std::make_unique<Space>();
      ++made_;
      return space;
    }
    std::unique_ptr<Space> space = std::move(free_.back());
    free_.pop_back();
    return space;
  }
  void Return(std::unique_ptr<Space> space)
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    free_.push_back(std::move(space));
  }

  std::mutex mutex_;
  std::size_t made_ = 0;
  std::vector<std::unique_ptr<Space>> free_;
};

} // namespace gridfem

#endif
