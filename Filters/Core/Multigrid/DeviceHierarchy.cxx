#include "Multigrid/DeviceHierarchy.h"

#include "Algebra/BlockVectors.h"
#include "Algebra/FillRows.h"
#include "Base/PrecisionTraits.h"
#include "Multigrid/CoarseSolver.h"
#include "Multigrid/Multigrid.h"

#include <algorithm>
#include <exception>

namespace gridfem
{
namespace
{

/// Fewer unknowns are solved on the CPU before a device has started.
constexpr Index LeastUnknowns = 20000;

/// More groups with directions that single precision does not resolve make the cycle too weak.
constexpr double MostUnresolved = 1e-2; // of all groups

static_assert(SmallestDevicePivot == PrecisionTraits<float>::SmallestPatchPivot &&
              NullPivot == PrecisionTraits<double>::SmallestPatchPivot);

/// Whether constants of a component have so little energy that single precision does not resolve
/// it. In contrast to functions that vanish on the surface, they matter.
bool HasFaintConstants(const SparseMatrix& A)
{
  constexpr double Rounding = 1e-13;
  const Groups components = ComponentsOf(A);
  for (std::size_t c = 0; c + 1 < components.begin.size(); ++c)
  {
    double energy = 0.0;
    double trace = 0.0;
    for (Index k = components.begin[c]; k < components.begin[c + 1]; ++k)
    {
      const Index row = components.item[k];
      for (Id entry = A.rowBegin[row]; entry < A.rowBegin[row + 1]; ++entry)
      {
        energy += A.value[entry];
        trace += A.column[entry] == row ? A.value[entry] : 0.0;
      }
    }
    if (energy > Rounding * trace && energy < SmallestDevicePivot * trace)
    {
      return true;
    }
  }
  return false;
}

constexpr const char* SmallWeight = "a small weight needs double precision";

/// The reason why a device does not take these levels; empty if it does.
std::string Obstacle(const std::vector<MultigridLevel>& levels, const MultigridOptions& options)
{
  const MultigridOptions usual;
  if (options.device == DeviceChoice::Cpu)
  {
    return "Device is CPU";
  }
  if (levels.front().distributed)
  {
    return "ranks share the surface";
  }
  if (options.smoother != usual.smoother || options.preSweeps != usual.preSweeps ||
      options.postSweeps != usual.postSweeps || options.precision != usual.precision)
  {
    return "a GPU has a smoother of its own, but the options ask for another";
  }
  if (options.device == DeviceChoice::Automatic && levels.front().A.rows < LeastUnknowns)
  {
    return "there are few functions";
  }
  if (levels.size() < 2)
  {
    return "there is only one level";
  }
  return HasFaintConstants(levels.back().A) ? SmallWeight : "";
}

DeviceMatrix ViewOf(const SparseMatrix& A)
{
  return { A.rows, A.rowBegin.data(), A.column.data(), A.value.data() };
}

/// The pattern of A, and the pairs of unknowns in the same group.
SparseMatrix PatternWith(const SparseMatrix& A, const UnknownGroups& groups, int threads)
{
  Array<Index> unknown(groups.unknown.size());
  std::transform(groups.unknown.begin(), groups.unknown.end(), unknown.begin(),
    [&](Index u) { return u >= 0 ? u : A.rows; });
  const Groups places = GroupItems(unknown, Id(A.rows) + 1, threads);
  SparseMatrix pattern;
  pattern.rows = A.rows;
  pattern.columns = A.columns;
  FillRows(pattern, threads,
    [&](Index row, Array<Index>& column, Array<double>&)
    {
      const auto first = static_cast<Id>(column.size());
      column.insert(
        column.end(), A.column.begin() + A.rowBegin[row], A.column.begin() + A.rowBegin[row + 1]);
      for (Index k = places.begin[row]; k < places.begin[row + 1]; ++k)
      {
        const UnknownGroup group = groups[places.item[k] / groups.size];
        std::copy_if(
          group.begin(), group.end(), std::back_inserter(column), [](Index u) { return u >= 0; });
      }
      std::sort(column.begin() + first, column.end());
      column.erase(std::unique(column.begin() + first, column.end()), column.end());
    });
  return pattern;
}

/// Views of a hierarchy, as a device takes it.
class DeviceView
{
public:
  /// @param isNew  else only matrices have new values
  DeviceView(const std::vector<MultigridLevel>& from, int threads, bool isNew)
    : inverse_(CoarseSolver(from.back().A, threads, SmallestDevicePivot).Inverse()),
      patterns_(from.size())
  {
    for (std::size_t l = 0; l < from.size(); ++l)
    {
      DeviceLevel& level = levels.emplace_back();
      level.A = ViewOf(from[l].A);
      if (l + 1 == from.size())
      {
        level.inverse = ViewOf(inverse_);
        continue;
      }
      level.isSingly = from[l].smoothing && from[l].smoothing->smoother != SmootherType::Patch;
      if (!level.isSingly)
      {
        Add(from[l].order.dof, level);
      }
      if (!from[l].groups.dof.IsEmpty())
      {
        Add(from[l].groups.dof, level);
      }
      if (isNew && !from[l].groups.dof.IsEmpty())
      {
        patterns_[l] = PatternWith(from[l].A, from[l].groups.dof, threads);
        level.schwarz = ViewOf(patterns_[l]);
      }
      level.prolongation = ViewOf(from[l].prolongation);
      level.restriction = ViewOf(from[l].restriction);
    }
  }

  std::vector<DeviceLevel> levels;

private:
  static void Add(const UnknownGroups& groups, DeviceLevel& level)
  {
    level.groups.push_back({ groups.size, groups.Count(), groups.unknown.data() });
  }

  SparseMatrix inverse_;
  std::vector<SparseMatrix> patterns_; // of the additive Schwarz matrices that differ from A's
};

/// The rows of V for the pivots of a group that single precision leaves out.
GroupFactor RestOf(const BlockSource& source, UnknownGroup group)
{
  const Id known = FactorGroup(source, group, SmallestDevicePivot).V.rows();
  GroupFactor factor = FactorGroup(source, group, NullPivot);
  factor.V = factor.V.bottomRows(factor.V.rows() - known).eval();
  return factor;
}

/// x += Σ R_pᵀ Vᵀ V R_p b over some groups p of unknowns.
void AddSolutions(const std::vector<GroupFactor>& groups, const MultiVector& b, MultiVector& x)
{
  for (const GroupFactor& group : groups)
  {
    const Id size = group.V.cols();
    Eigen::MatrixXd part(size, b.cols());
    for (Id i = 0; i < size; ++i)
    {
      part.row(i) = b.row(group.unknown[i]);
    }
    part = group.V.transpose() * (group.V * part).eval();
    for (Id i = 0; i < size; ++i)
    {
      x.row(group.unknown[i]) += part.row(i);
    }
  }
}

} // namespace

std::unique_ptr<DeviceHierarchy> DeviceHierarchy::Make(
  const std::vector<MultigridLevel>& levels, const MultigridOptions& options, std::string& whyNot)
{
  whyNot = Obstacle(levels, options);
  if (!whyNot.empty())
  {
    return nullptr;
  }
  std::unique_ptr<DeviceHierarchy> hierarchy(new DeviceHierarchy);
  hierarchy->device_ = FindDevice(whyNot);
  if (!hierarchy->device_)
  {
    return nullptr;
  }
  hierarchy->threads_ = options.threads;
  try
  {
    const DeviceView view(levels, options.threads, true);
    hierarchy->cycles_ = hierarchy->device_->make(view.levels);
    return hierarchy->TakeUnresolved(levels, view.levels, whyNot) ? std::move(hierarchy) : nullptr;
  }
  catch (const std::runtime_error& error)
  {
    whyNot = hierarchy->Name() + ": " + error.what();
    return nullptr;
  }
}

bool DeviceHierarchy::Update(const std::vector<MultigridLevel>& levels, std::string& whyNot)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!failure_.empty())
  {
    whyNot = failure_;
    return false;
  }
  if (HasFaintConstants(levels.back().A))
  {
    whyNot = SmallWeight;
    return false;
  }
  try
  {
    const DeviceView view(levels, threads_, false);
    cycles_->Update(view.levels);
    return this->TakeUnresolved(levels, view.levels, whyNot);
  }
  catch (const std::runtime_error& error)
  {
    whyNot = this->Name() + ": " + error.what();
    return false;
  }
}

/// Returns false if there are too many.
bool DeviceHierarchy::TakeUnresolved(const std::vector<MultigridLevel>& levels,
  const std::vector<DeviceLevel>& views, std::string& whyNot)
{
  double all = 0.0;
  double unresolved = 0.0;
  for (std::size_t l = 0; l + 1 < levels.size(); ++l)
  {
    unresolved += double(cycles_->Unresolved(static_cast<int>(l)).size());
    for (const DeviceGroups& set : views[l].groups)
    {
      all += double(set.count);
    }
  }
  if (unresolved > MostUnresolved * all)
  {
    whyNot = "flat faces need double precision";
    return false;
  }
  unresolved_.assign(levels.size(), {});
  for (std::size_t l = 0; l + 1 < levels.size(); ++l)
  {
    const std::vector<DeviceGroup>& groups = cycles_->Unresolved(static_cast<int>(l));
    if (groups.empty())
    {
      continue;
    }
    const BlockSource source(levels[l].A, threads_);
    for (const DeviceGroup& own : groups)
    {
      const DeviceGroups& set = views[l].groups[own.set];
      unresolved_[l].push_back(
        RestOf(source, UnknownGroup(set.unknown + own.group * set.size, set.size)));
    }
  }
  return true;
}

template<class Real>
bool DeviceHierarchy::Precondition(
  std::size_t level, const Vectors<Real>& b, Vectors<Real>& x, bool isMeasured) const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!failure_.empty())
  {
    return false;
  }
  MakeRoom(b.rows(), b.cols(), x);
  if (b.size() == 0)
  {
    return true;
  }
  const auto l = static_cast<int>(level);
  const auto columns = static_cast<int>(b.cols());
  const DeviceNumbers numbers =
    sizeof(Real) == sizeof(float) ? DeviceNumbers::Single : DeviceNumbers::Double;
  try
  {
    const Eigen::Map<Vectors<Real>> room(
      static_cast<Real*>(cycles_->Room(l, columns, numbers)), b.rows(), columns);
    const int threads = ThreadsFor(b.size(), threads_);
    CopyBlock(b, room, threads);
    cycles_->Precondition(l, columns, numbers);
    CopyBlock(room, Eigen::Map<Vectors<Real>>(x.data(), b.rows(), columns), threads);
    if constexpr (!PrecisionTraits<Real>::IsSingle)
    {
      if (isMeasured)
      {
        AddSolutions(unresolved_[level], b, x);
      }
    }
    return true;
  }
  catch (const std::runtime_error& error)
  {
    failure_ = this->Name() + ": " + error.what();
    return false;
  }
}

std::string DeviceHierarchy::Failure() const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  return failure_;
}

template bool DeviceHierarchy::Precondition(
  std::size_t, const Vectors<float>&, Vectors<float>&, bool) const;
template bool DeviceHierarchy::Precondition(
  std::size_t, const MultiVector&, MultiVector&, bool) const;

} // namespace gridfem
