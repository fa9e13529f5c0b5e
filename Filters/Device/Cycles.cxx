// V cycles on a device. The smoother is a Chebyshev polynomial of the fourth kind in M A, with the
// additive Schwarz matrix M (Lottes, Numer. Linear Algebra Appl. 30, 2023). It needs no order of
// patches, so that every step is a product with a sparse matrix.
#include "Kernels.h"
#include "Schwarz.h"

#include <map>
#include <tuple>

namespace gridfem::device
{
namespace
{

/// Steps of the smoother before and after the correction from the coarser level. Conjugate
/// gradients then take at most twice as many iterations as with a W cycle of patch sweeps.
constexpr int Steps = 3;

/// Steps of the power iteration for the largest eigenvalue of M A, and the factor on its result,
/// which is up to a sixth too small. The polynomial stays below 1 up to 16 % beyond the bound.
constexpr int PowerSteps = 16;
constexpr float PowerMargin = 1.1f;

/// Groups of an unusual size whose blocks are factored at the same time.
constexpr std::int64_t GroupsAtOnce = 16384;

/// Groups of unknowns on the device.
struct GroupSet
{
  Index size = 0;
  Index count = 0;
  Buffer<Index> unknown;
  Buffer<Index> memberBegin; // of each unknown: the places of the groups that hold it
  Buffer<Index> member;

  GroupSet(Queue& queue, const DeviceGroups& groups, Index rows)
    : size(groups.size), count(static_cast<Index>(groups.count)),
      unknown(Copy(queue, groups.unknown, std::size_t(groups.count) * groups.size))
  {
    const Index places = size * count;
    std::vector<Index> begin(std::size_t(rows) + 1, 0);
    for (Index place = 0; place < places; ++place)
    {
      begin[groups.unknown[place] + 1] += groups.unknown[place] >= 0 ? 1 : 0;
    }
    begin[0] = 0;
    for (Index row = 0; row < rows; ++row)
    {
      begin[row + 1] += begin[row];
    }
    std::vector<Index> next(begin.begin(), begin.end() - 1);
    std::vector<Index> places_(begin.back());
    for (Index place = 0; place < places; ++place)
    {
      if (groups.unknown[place] >= 0)
      {
        places_[next[groups.unknown[place]]++] = place;
      }
    }
    memberBegin = Copy(queue, begin);
    member = Copy(queue, places_);
    queue.Wait();
  }

  std::size_t Bytes() const { return unknown.Bytes() + memberBegin.Bytes() + member.Bytes(); }
};

/// A matrix between two levels, and its entries before they are scaled.
struct Transfer
{
  Matrix matrix;
  Buffer<float> given;

  Transfer() = default;
  Transfer(Queue& queue, const DeviceMatrix& A)
    : matrix(std::make_shared<const Pattern>(queue, A)), given(matrix.SharedPattern()->Size())
  {
    const std::vector<float> single(A.value, A.value + A.rowBegin[A.rows]);
    matrix.SharedPattern()->Place(queue, single.data(), given.Data());
  }

  std::size_t Bytes() const
  {
    return matrix.Bytes() + given.Bytes() + matrix.SharedPattern()->Bytes();
  }
};

struct Level
{
  Index rows = 0;
  Matrix A;
  Matrix schwarz;
  std::vector<GroupSet> groups;
  bool isSingly = false;
  Transfer prolongation;
  Transfer restriction;
  Matrix inverse; // of the coarsest level
  std::vector<DeviceGroup> unresolved;
  Buffer<double> unit;
  float bound = 1.0f; // of the eigenvalues of M A

  Buffer<float> b; // load
  Buffer<float> x; // solution
  Buffer<float> r; // residual
  Buffer<float> z; // last correction
};

class Cycles : public DeviceCycles
{
public:
  explicit Cycles(const std::vector<DeviceLevel>& levels)
  {
    for (const DeviceLevel& from : levels)
    {
      Level& to = levels_.emplace_back();
      to.rows = from.A.rows;
      to.unit = Buffer<double>(to.rows);
      to.A = Matrix(std::make_shared<const Pattern>(queue_, from.A));
      bytes_ += to.unit.Bytes() + to.A.Bytes() + to.A.SharedPattern()->Bytes();
      if (levels_.size() < levels.size())
      {
        this->Add(from, to);
      }
    }
    this->MakeRoom(1);
    this->Update(levels);
  }

  void Update(const std::vector<DeviceLevel>& levels) override
  {
    for (std::size_t l = levels_.size(); l-- > 0;)
    {
      Level& level = levels_[l];
      const Pattern& pattern = *level.A.SharedPattern();
      const Buffer<double> value(pattern.Size());
      const Buffer<double> diagonal(level.rows);
      pattern.Place(queue_, levels[l].A.value, value.Data());
      queue_.ForEach(level.rows,
        FindUnits{ pattern.AsPlaces(), value.Data(), diagonal.Data(), level.unit.Data() });
      this->Scale(level.A, value.Data(), level, true, level, true);
      if (l + 1 == levels_.size())
      {
        this->SetInverse(levels[l].inverse, level);
        continue;
      }
      this->AddUpInverses(level, value.Data(), diagonal.Data());
      const Level& coarse = levels_[l + 1];
      this->Scale(
        level.prolongation.matrix, level.prolongation.given.Data(), level, false, coarse, true);
      this->Scale(
        level.restriction.matrix, level.restriction.given.Data(), coarse, true, level, false);
      level.bound = PowerMargin * this->LargestEigenvalue(level);
    }
    recordings_.clear(); // they contain the bounds
  }

  const std::vector<DeviceGroup>& Unresolved(int level) const override
  {
    return levels_.at(level).unresolved;
  }

  void* Room(int level, int columns, DeviceNumbers numbers) override
  {
    const std::size_t size = std::size_t(levels_.at(level).rows) * columns;
    if (size + std::size_t(SliceRows) * columns > std::size_t(std::numeric_limits<Index>::max()))
    {
      throw std::runtime_error("a block of vectors is too large");
    }
    this->MakeRoom(columns);
    const std::size_t bytes = size * BytesOf(numbers);
    if (room_.Size() < bytes)
    {
      recordings_.clear(); // they name the old memory
      room_ = {};
      room_ = HostBuffer<char>(bytes);
      given_ = {};
      given_ = Buffer<char>(bytes);
    }
    return room_.Data();
  }

  void Precondition(int level, int columns, DeviceNumbers numbers) override
  {
    Recording& recording = recordings_[{ level, columns, numbers }];
    if (!recording)
    {
      recording = queue_.Record(
        [this, level, columns, numbers]
        {
          if (numbers == DeviceNumbers::Single)
          {
            this->CycleInUnits<float>(level, columns);
          }
          else
          {
            this->CycleInUnits<double>(level, columns);
          }
        });
    }
    const std::size_t bytes = std::size_t(levels_[level].rows) * columns * BytesOf(numbers);
    queue_.Upload(room_.Data(), bytes, given_.Data());
    queue_.Run(recording);
    queue_.Download(given_.Data(), bytes, room_.Data());
    queue_.Wait();
  }

  double Seconds() const override { return queue_.Seconds(); }

  std::size_t Memory() const override
  {
    std::size_t bytes = bytes_ + given_.Bytes();
    for (const Level& level : levels_)
    {
      bytes += level.b.Bytes() + level.x.Bytes() + level.r.Bytes() + level.z.Bytes();
    }
    return bytes;
  }

private:
  static std::size_t BytesOf(DeviceNumbers numbers)
  {
    return numbers == DeviceNumbers::Single ? sizeof(float) : sizeof(double);
  }

  /// The data of a level that do not change with the values of its matrix.
  void Add(const DeviceLevel& from, Level& to)
  {
    to.schwarz =
      Matrix(from.schwarz.rows > 0 ? std::make_shared<const Pattern>(queue_, from.schwarz)
                                   : to.A.SharedPattern());
    to.isSingly = from.isSingly;
    for (const DeviceGroups& groups : from.groups)
    {
      to.groups.emplace_back(queue_, groups, to.rows);
      bytes_ += to.groups.back().Bytes();
    }
    to.prolongation = Transfer(queue_, from.prolongation);
    to.restriction = Transfer(queue_, from.restriction);
    bytes_ += to.schwarz.Bytes() + to.prolongation.Bytes() + to.restriction.Bytes();
  }

  void SetInverse(const DeviceMatrix& inverse, Level& level)
  {
    level.inverse = Matrix(std::make_shared<const Pattern>(queue_, inverse));
    const Buffer<double> value(level.inverse.SharedPattern()->Size());
    level.inverse.SharedPattern()->Place(queue_, inverse.value, value.Data());
    this->Scale(level.inverse, value.Data(), level, false, level, false);
    queue_.Wait();
  }

  template<class Number>
  void Scale(const Matrix& to, const Number* from, const Level& rows, bool overRow,
    const Level& columns, bool overColumn)
  {
    queue_.ForEach(
      to.SharedPattern()->Rows(), ScaleEntries<Number>{ to.AsPlaces(), from, rows.unit.Data(),
                                    overRow, columns.unit.Data(), overColumn, to.Values() });
  }

  /// Fills the additive Schwarz matrix of a level.
  void AddUpInverses(Level& level, const double* value, const double* diagonal)
  {
    const Places places = level.schwarz.AsPlaces();
    level.unresolved.clear();
    queue_.ForEach(places.slots,
      StartSum{ places, diagonal, level.unit.Data(), level.isSingly, level.schwarz.Values() });
    for (const GroupSet& set : level.groups)
    {
      const std::size_t square = std::size_t(set.size) * set.size;
      const bool isUsual = set.size == UsualGroup;
      const Buffer<float> inverse(square * set.count);
      const Buffer<unsigned char> state(set.count);
      const Buffer<double> work(
        isUsual ? 0 : square * std::min<std::int64_t>(GroupsAtOnce, set.count));
      const Index step = isUsual ? set.count : static_cast<Index>(GroupsAtOnce);
      for (Index first = 0; first < set.count; first += step)
      {
        queue_.ForEach(std::min(step, set.count - first),
          InvertGroups{ set.size, set.unknown.Data() + std::size_t(first) * set.size,
            level.A.AsPlaces(), value, level.unit.Data(),
            level.schwarz.SharedPattern() == level.A.SharedPattern(), work.Data(),
            inverse.Data() + first * square, state.Data() + first });
      }
      queue_.ForEach(
        places.slots, AddInverses{ places, set.size, set.unknown.Data(), inverse.Data(),
                        set.memberBegin.Data(), set.member.Data(), level.schwarz.Values() });
      this->ReadStates(state, std::size_t(&set - level.groups.data()), level.unresolved);
    }
  }

  void ReadStates(
    const Buffer<unsigned char>& state, std::size_t set, std::vector<DeviceGroup>& unresolved)
  {
    std::vector<unsigned char> ofGroups(state.Size());
    queue_.Download(state.Data(), state.Size(), ofGroups.data());
    queue_.Wait();
    for (std::size_t group = 0; group < ofGroups.size(); ++group)
    {
      if ((ofGroups[group] & IsOutside) != 0)
      {
        throw std::runtime_error("the matrix does not couple all unknowns of a patch");
      }
      if (ofGroups[group] != IsComplete)
      {
        unresolved.push_back({ set, static_cast<std::int64_t>(group) });
      }
    }
  }

  /// The largest eigenvalue of M A, by a power iteration from pseudorandom numbers. It is the
  /// Rayleigh quotient yᵀ M y / xᵀ y for y = A x.
  float LargestEigenvalue(Level& level)
  {
    float* const x = level.x.Data();
    float* const y = level.r.Data();
    float* const z = level.z.Data();
    double* const square = sums_.Data();
    queue_.ForEach(level.rows, FillRandom{ x });
    for (int step = 0; step < PowerSteps; ++step)
    {
      if (step > 0)
      {
        queue_.JoinAll<Sum>(level.rows, 1, ProductTerm{ z, z }, parts_.Data(), square);
        queue_.ForEach(level.rows, Normalize{ z, square, x });
      }
      this->Multiply(level.A, x, y, 1);
      this->Multiply(level.schwarz, y, z, 1);
    }
    double work = 0.0;
    double energy = 0.0;
    queue_.JoinAll<Sum>(level.rows, 1, ProductTerm{ z, y }, parts_.Data(), square);
    queue_.Download(square, 1, &work);
    queue_.JoinAll<Sum>(level.rows, 1, ProductTerm{ x, y }, parts_.Data(), square);
    queue_.Download(square, 1, &energy);
    queue_.Wait();
    return work > 0.0 && energy > 0.0 ? static_cast<float>(work / energy) : 1.0f;
  }

  /// Makes room for blocks of up to so many columns.
  void MakeRoom(int columns)
  {
    if (columns <= columns_)
    {
      return;
    }
    columns_ = 0;
    recordings_.clear(); // they name the old memory
    for (Level& level : levels_)
    {
      level.b = {};
      level.x = {};
      level.r = {};
      level.z = {};
    }
    for (Level& level : levels_)
    {
      const std::size_t size = std::size_t(level.rows) * columns;
      level.b = Buffer<float>(size);
      level.x = Buffer<float>(size);
      level.r = Buffer<float>(size);
      level.z = Buffer<float>(size);
    }
    parts_ = Buffer<double>(std::size_t(JoinBlocks) * columns);
    sums_ = Buffer<double>(columns);
    columns_ = columns;
  }

  /// Replaces the given block b by B b. Levels compute in units of their unknowns and of the size
  /// of each column.
  template<class Number>
  void CycleInUnits(int l, Index columns)
  {
    Level& level = levels_[l];
    const Index items = level.rows * columns;
    auto* const given = reinterpret_cast<Number*>(given_.Data());
    queue_.JoinAll<Largest>(level.rows, columns,
      SizeTerm<Number>{ given, level.unit.Data(), columns }, parts_.Data(), sums_.Data());
    queue_.ForEach(
      items, EnterUnits<Number>{ given, level.unit.Data(), sums_.Data(), columns, level.b.Data() });
    this->Cycle(l, columns);
    queue_.ForEach(
      items, LeaveUnits<Number>{ level.x.Data(), level.unit.Data(), sums_.Data(), columns, given });
  }

  /// x = B b
  void Cycle(std::size_t l, Index columns)
  {
    Level& level = levels_[l];
    if (l + 1 == levels_.size())
    {
      this->Multiply(level.inverse, level.b.Data(), level.x.Data(), columns);
      return;
    }
    Level& coarse = levels_[l + 1];
    for (int step = 1; step <= Steps; ++step)
    {
      const float* const residual = step == 1 ? level.b.Data() : level.r.Data();
      this->Smooth(level, step, residual, columns, step == 1);
      this->SubtractProduct(level, residual, columns);
    }
    this->Multiply(level.restriction.matrix, level.r.Data(), coarse.b.Data(), columns);
    this->Cycle(l + 1, columns);
    this->AddProduct(level.prolongation.matrix, coarse.x.Data(), 0.0f, 1.0f, level, columns, false);
    for (int step = 1; step <= Steps; ++step)
    {
      this->SubtractProduct(level, level.r.Data(), columns);
      this->Smooth(level, step, level.r.Data(), columns, false);
    }
  }

  /// y = A x
  void Multiply(const Matrix& A, const float* x, float* y, Index columns)
  {
    queue_.ForEach(A.Items(columns), MultiplyRows{ A.Products(columns), x, y });
  }

  /// r = from - A z
  void SubtractProduct(Level& level, const float* from, Index columns)
  {
    queue_.ForEach(level.A.Items(columns),
      SubtractRows{ level.A.Products(columns), level.z.Data(), from, level.r.Data() });
  }

  /// z = first z + second A from, x += z
  void AddProduct(const Matrix& A, const float* from, float first, float second, Level& level,
    Index columns, bool isFromZero)
  {
    queue_.ForEach(A.Items(columns), SmoothRows{ A.Products(columns), from, first, second,
                                       level.z.Data(), level.x.Data(), isFromZero });
  }

  /// A step of the smoother, from the residual before it.
  void Smooth(Level& level, int step, const float* residual, Index columns, bool isFromZero)
  {
    const auto k = static_cast<float>(step);
    const float first = step == 1 ? 0.0f : (2.0f * k - 3.0f) / (2.0f * k + 1.0f);
    const float second = (8.0f * k - 4.0f) / (2.0f * k + 1.0f) / level.bound;
    this->AddProduct(level.schwarz, residual, first, second, level, columns, isFromZero);
  }

  Queue queue_;
  std::vector<Level> levels_;
  HostBuffer<char> room_; // of the host, for copies
  Buffer<char> given_;    // the same on the device
  Buffer<double> parts_;  // of sums
  Buffer<double> sums_;
  /// By level, columns and kind of numbers.
  std::map<std::tuple<int, int, DeviceNumbers>, Recording> recordings_;
  int columns_ = 0;
  std::size_t bytes_ = 0; // of what stays
};

} // namespace
} // namespace gridfem::device

#ifdef __GNUC__
#define GRIDFEM_EXPORT extern "C" __attribute__((visibility("default")))
#else
#define GRIDFEM_EXPORT extern "C"
#endif

GRIDFEM_EXPORT bool GridFEMOpenDevice1(gridfem::Device& device, std::string& whyNot)
{
  using namespace gridfem;
  device.name = device::CardName(whyNot);
  device.make = [](const std::vector<DeviceLevel>& levels) -> std::unique_ptr<DeviceCycles>
  { return std::make_unique<device::Cycles>(levels); };
  return !device.name.empty();
}
