// Runs the tests of a file on all ranks. Only the first rank prints; the others print failures.
#include <gtest/gtest.h>

#include <mpi.h>

namespace
{

/// Failures of ranks whose other messages are not printed.
class Failures : public testing::EmptyTestEventListener
{
public:
  explicit Failures(int rank) : rank_(rank) {}

  void OnTestPartResult(const testing::TestPartResult& result) override
  {
    if (result.failed())
    {
      std::fprintf(stderr, "rank %d: %s:%d: %s\n", rank_,
        result.file_name() ? result.file_name() : "", result.line_number(), result.summary());
    }
  }

private:
  int rank_;
};

} // namespace

int main(int argc, char** argv)
{
  testing::InitGoogleTest(&argc, argv);
  MPI_Init(&argc, &argv);
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  if (rank > 0)
  {
    testing::TestEventListeners& listeners = testing::UnitTest::GetInstance()->listeners();
    delete listeners.Release(listeners.default_result_printer());
    listeners.Append(new Failures(rank));
  }
  int failed = RUN_ALL_TESTS();
  MPI_Allreduce(MPI_IN_PLACE, &failed, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
  MPI_Finalize();
  return failed;
}
