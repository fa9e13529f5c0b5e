// The source of the device library, for nvcc.
#include "Cycles.cxx"
