// A pool of work spaces for parallel jobs. It holds as many spaces as jobs run at the same time,
// and later jobs reuse them.
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
  /// Borrows a space for the life of this object; nobody else uses it meanwhile. A space keeps the
  /// contents that were left in it.
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
      free_.reserve(made_ + 1); // so that Return cannot fail
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
