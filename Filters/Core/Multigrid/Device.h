// What the cycle asks of a device such as a GPU. A library that is opened at run time offers it, so
// that Core and programs depend on no driver.
#ifndef GridFEM_Device_h
#define GridFEM_Device_h

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace gridfem
{

/// Where cycles run.
enum class DeviceChoice
{
  Automatic = 0, // on a GPU if there is one and the problem is large enough to gain by it
  Cpu = 1,
  Gpu = 2 // on a GPU if there is one
};

/// A sparse matrix in compressed rows. Whoever gives it keeps the arrays until the call returns.
struct DeviceMatrix
{
  std::int32_t rows = 0;
  const std::int64_t* rowBegin = nullptr; // rows + 1 numbers
  const std::int32_t* column = nullptr;   // rowBegin[rows] numbers, ascending in each row
  const double* value = nullptr;          // as many
};

/// Groups of unknowns that are relaxed together; see UnknownGroups.
struct DeviceGroups
{
  std::int32_t size = 0; // of every group, at most 64
  std::int64_t count = 0;
  const std::int32_t* unknown = nullptr; // size * count numbers, group after group; -1: unused
};

/// A group of a level.
struct DeviceGroup
{
  std::size_t set = 0; // in DeviceLevel::groups
  std::int64_t group = 0;
};

/// One level of a hierarchy.
struct DeviceLevel
{
  DeviceMatrix A;
  ///@{ Empty on the coarsest level.
  std::vector<DeviceGroups> groups;
  bool isSingly = false; // each unknown is a group of its own, in addition to `groups`
  DeviceMatrix schwarz;  // pattern of all groups; no rows: that of A has it
  DeviceMatrix prolongation;
  DeviceMatrix restriction;
  ///@}
  DeviceMatrix inverse; // of A, on the coarsest level alone
};

/// Pivots of a group's scaled block below this value stop its factorization on a device. In their
/// directions, rounding to single precision would disturb corrections more than they help.
constexpr double SmallestDevicePivot = 1e-6;

/// Double precision does not resolve directions with smaller pivots, either. They are combinations
/// of functions that vanish on the surface. Nothing is lost without them.
constexpr double NullPivot = 1e-14;

/// Kind of the numbers of a block.
enum class DeviceNumbers
{
  Single,
  Double
};

/// The cycles of one hierarchy, in the memory of a device and in single precision. All functions
/// may throw std::runtime_error with a message of the driver or of the library. Not safe to call
/// from several threads at once.
class DeviceCycles
{
public:
  virtual ~DeviceCycles() = default;

  /// Takes new values of the matrices and of the inverse, on the same patterns. After an exception,
  /// the object must not be used any more.
  virtual void Update(const std::vector<DeviceLevel>& levels) = 0;

  /// The groups of a level with directions that single precision does not resolve. The smoother
  /// leaves these directions out. Valid until Update.
  virtual const std::vector<DeviceGroup>& Unresolved(int level) const = 0;

  /// Memory of the host for a block with the rows of a level and one or more columns, row after
  /// row. It stays valid until the next call of Room.
  virtual void* Room(int level, int columns, DeviceNumbers numbers) = 0;

  /// Replaces the block b in Room by B b. The arguments are those of the last Room. B is one V
  /// cycle on the hierarchy that begins at `level`. The smoother is a Chebyshev polynomial of the
  /// fourth kind in M A, where M is the sum of the inverses of all groups' blocks (additive
  /// Schwarz). B is symmetric positive semi-definite. Same bits for every call on one card.
  virtual void Precondition(int level, int columns, DeviceNumbers numbers) = 0;

  /// Seconds that the last cycle took on the device, without copies.
  virtual double Seconds() const = 0;

  /// Memory on the device in bytes.
  virtual std::size_t Memory() const = 0;
};

/// A card, and the function that makes hierarchies on it.
struct Device
{
  std::string name; // of the card
  /// Copies a hierarchy to the device. Finest level first. May throw std::runtime_error.
  std::function<std::unique_ptr<DeviceCycles>(const std::vector<DeviceLevel>&)> make;
};

/// Opens a library of devices. It stays open until the process ends, because its driver has threads
/// of its own.
/// @param whyNot  receives the reason for null
std::shared_ptr<const Device> OpenDevice(const std::string& path, std::string& whyNot);

/// The device of this process, or null. The first call looks for the GPU library, beside Core.
/// The environment variable GRIDFEM_DEVICE_LIBRARY names another library.
/// @param whyNot  receives the reason if there is none
std::shared_ptr<const Device> FindDevice(std::string& whyNot);

/// Replaces the device for hierarchies that are built later; null: none. Safe to call from several
/// threads, as FindDevice is.
void UseDevice(std::shared_ptr<const Device> device);

/// The function that a GPU library exports. It fills `device`, or returns false with the reason.
using OpenDeviceFunction = bool (*)(Device& device, std::string& whyNot);
/// The number rises with every change of this header.
constexpr const char* OpenDeviceName = "GridFEMOpenDevice1";

} // namespace gridfem

#endif
