#include "Measure.h"
#include "PeerTimes.h"
#include <cstdlib>
using namespace gridfem::benchmarks;
int main(int argc, char** argv)
{
  PeerJob job{ RockerArm(argc > 1 ? std::atoi(argv[1]) : 2), argc > 2 ? std::atoi(argv[2]) : 7, 1e-4, 2 };
  PrintPeers(job, MeasurePeers(job));
}
