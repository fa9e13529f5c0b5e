// Large blocks of fresh memory in few pages. A block that is touched for the first time costs a
// call into the system for every page of 4 kB, which takes longer than many a loop over it.
#ifndef GridFEM_LargePages_h
#define GridFEM_LargePages_h

#include <cstddef>

namespace gridfem
{

/// Asks for large pages where memory that has not been touched yet spans some of them. A wish: the
/// system may ignore it, and only Linux is asked. Contents do not change.
void PreferLargePages(void* begin, std::size_t bytes);

} // namespace gridfem

#endif
