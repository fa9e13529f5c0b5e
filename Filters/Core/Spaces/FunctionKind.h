// Which functions solutions are made of.
#ifndef GridFEM_FunctionKind_h
#define GridFEM_FunctionKind_h

namespace gridfem
{

/// Chosen by a user, and known to what makes a space, estimates its memory or says what would make
/// its error smaller; a problem is the same on both.
enum class FunctionKind
{
  Grid, // of the grid's corners
  Hats  // of the mesh's points
};

/// Whether a finer grid has functions of smaller error; else only a finer mesh has.
constexpr bool IsRefinedByDepth(FunctionKind kind)
{
  return kind == FunctionKind::Grid;
}

} // namespace gridfem

#endif
