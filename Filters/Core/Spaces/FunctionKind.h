// The kinds of functions that solutions are made of.
#ifndef GridFEM_FunctionKind_h
#define GridFEM_FunctionKind_h

namespace gridfem
{

/// The kind of functions, chosen by the user. Only code that builds a space, estimates its memory
/// or suggests how to reduce its error knows it. Problems are the same for all kinds.
/// The order is that of the property FunctionSpace.
enum class FunctionKind
{
  Grid,      // trilinear functions of the grid's corners
  Hats,      // functions of the mesh's points
  SmoothGrid // quadratic functions of the grid's cells
};

/// Whether a finer grid reduces the error of the functions. Otherwise only a finer mesh does.
constexpr bool IsRefinedByDepth(FunctionKind kind)
{
  return kind != FunctionKind::Hats;
}

} // namespace gridfem

#endif
