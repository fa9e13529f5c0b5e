// A hierarchy whose cycles run on a device.
#ifndef GridFEM_DeviceHierarchy_h
#define GridFEM_DeviceHierarchy_h

#include "Multigrid/Device.h"
#include "Multigrid/MultigridLevel.h"
#include "Multigrid/PatchFactor.h"

#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace gridfem
{

struct MultigridOptions;

class DeviceHierarchy
{
public:
  /// Returns null if the CPU should cycle.
  /// @param levels  finest first, with A, prolongation, restriction and orders
  /// @param whyNot  receives the reason for null
  static std::unique_ptr<DeviceHierarchy> Make(const std::vector<MultigridLevel>& levels,
    const MultigridOptions& options, std::string& whyNot);

  /// Takes new values of the matrices. Returns false if the device cannot use them.
  bool Update(const std::vector<MultigridLevel>& levels, std::string& whyNot);

  /// x = B b on the hierarchy that begins at `level`, with B symmetric positive semi-definite. Safe
  /// to call from several threads. Returns false if the device fails; it is not used any more then.
  template<class Real>
  bool Precondition(std::size_t level, const Vectors<Real>& b, Vectors<Real>& x) const;

  /// Name of the card.
  const std::string& Name() const { return device_->name; }

  /// The driver's message once it has failed; empty before.
  std::string Failure() const;

  /// Time of the last cycle on the device, without copies.
  double Seconds() const { return cycles_->Seconds(); }

  /// Memory on the device in bytes.
  std::size_t Memory() const { return cycles_->Memory(); }

private:
  DeviceHierarchy() = default;
  bool TakeUnresolved(const std::vector<MultigridLevel>& levels,
    const std::vector<DeviceLevel>& views, std::string& whyNot);

  std::shared_ptr<const Device> device_;
  std::unique_ptr<DeviceCycles> cycles_;
  /// Of each level: the factors of the groups that the device leaves out in part. Their solutions
  /// are added in double precision, so that the energy rᵀBr contains these directions.
  std::vector<std::vector<GroupFactor>> unresolved_;
  int threads_ = 0;
  mutable std::mutex mutex_; // of cycles_ and failure_
  mutable std::string failure_;
};

} // namespace gridfem

#endif
