#include "Solvers/StageKey.h"

#include <cstring>

namespace gridfem
{

StageKey& StageKey::Add(std::int64_t value)
{
  parts_.push_back(static_cast<std::uint64_t>(value));
  return *this;
}

StageKey& StageKey::Add(double value)
{
  std::uint64_t bits = 0;
  std::memcpy(&bits, &value, sizeof(bits));
  parts_.push_back(bits);
  return *this;
}

StageKey& StageKey::Add(const std::string& value)
{
  parts_.push_back(value.size());
  for (const char letter : value)
  {
    parts_.push_back(static_cast<unsigned char>(letter));
  }
  return *this;
}

StageKey& StageKey::Add(const StageKey& other)
{
  parts_.push_back(other.parts_.size());
  parts_.insert(parts_.end(), other.parts_.begin(), other.parts_.end());
  return *this;
}

} // namespace gridfem
