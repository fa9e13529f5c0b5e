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

/// The hierarchy of a Multigrid on a device. Vectors have a row for each unknown of their level.
/// Precondition and Failure are safe to call from several threads.
class DeviceHierarchy
{
public:
  /// Returns null if options, matrices or the device leave the cycles to the CPU. A failing device
  /// throws nothing.
  /// @param levels  finest first, with A, prolongation, restriction and orders
  /// @param whyNot  receives the reason for null
  static std::unique_ptr<DeviceHierarchy> Make(const std::vector<MultigridLevel>& levels,
    const MultigridOptions& options, std::string& whyNot);

  /// Takes new values of the matrices. Returns false if the device cannot use them. The hierarchy
  /// must not be used any more then.
  bool Update(const std::vector<MultigridLevel>& levels, std::string& whyNot);

  /// x = B b on the hierarchy that begins at `level`, with B symmetric positive semi-definite. Any
  /// number of columns. Returns false if the device fails; it is not used any more then.
  /// @param isMeasured  adds solutions of groups that the device leaves out in part, so that rᵀBr
  ///   contains their directions. B A then has eigenvalues above 2, so that x += B (b - A x) may
  ///   grow. Blocks in single precision get none: their rounding would become large corrections.
  template<class Real>
  bool Precondition(
    std::size_t level, const Vectors<Real>& b, Vectors<Real>& x, bool isMeasured) const;

  /// Name of the card.
  const std::string& Name() const { return device_->name; }

  /// The driver's message once it has failed; empty before.
  std::string Failure() const;

  /// Seconds that the last cycle took on the device, without copies.
  double Seconds() const { return cycles_->Seconds(); }

  /// Memory on the device in bytes.
  std::size_t Memory() const { return cycles_->Memory(); }

private:
  DeviceHierarchy() = default;
  bool TakeUnresolved(const std::vector<MultigridLevel>& levels,
    const std::vector<DeviceLevel>& views, std::string& whyNot);

  std::shared_ptr<const Device> device_;
  std::unique_ptr<DeviceCycles> cycles_;
  /// The groups that the device leaves out in part, for each level. V has the rows of the pivots
  /// that are left out.
  std::vector<std::vector<GroupFactor>> unresolved_;
  int threads_ = 0;
  mutable std::mutex mutex_; // of cycles_ and failure_
  mutable std::string failure_;
};

} // namespace gridfem

#endif
