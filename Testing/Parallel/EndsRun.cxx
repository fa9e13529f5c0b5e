// The last rank fails while the others wait for its message: the run ends and says why.
#include "Parallel/Communicator.h"

#include <cstdio>
#include <stdexcept>

using namespace gridfem;

int main(int argc, char** argv)
{
  MPI_Init(&argc, &argv);
  const Communicator ranks(MPI_COMM_WORLD);
  ranks.Guard(
    [&]
    {
      if (ranks.Rank() == ranks.Size() - 1)
      {
        throw std::runtime_error("nothing is left");
      }
      double value = 0.0;
      ranks.Sum(&value, 1);
    },
    [](const std::string& message) { std::fprintf(stderr, "%s\n", message.c_str()); });
  MPI_Finalize();
  return 0;
}
