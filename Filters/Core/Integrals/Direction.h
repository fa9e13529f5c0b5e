// The direction of a vector of any size.
#ifndef GridFEM_Direction_h
#define GridFEM_Direction_h

#include "Base/Types.h"

namespace gridfem
{

/// v / |v|, also where |v|² is no number any more; 0 for 0.
inline Vec3 DirectionOf(const Vec3& v)
{
  const double largest = v.cwiseAbs().maxCoeff();
  return largest > 0.0 ? Vec3((v / largest).normalized()) : Vec3(Vec3::Zero());
}

} // namespace gridfem

#endif
