#include "Parallel/DistributedSurface.h"

#include "Base/Parallel.h"
#include "Parallel/HeldPoints.h"
#include "Parallel/RankBoundary.h"
#include "Parallel/RankDistance.h"
#include "Parallel/RankMemory.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>

namespace gridfem
{
namespace
{

/// Adds the bits of some numbers to a digest. Equal numbers give equal digests. FNV-1a.
template<class Number>
void Digest(const Number* numbers, std::size_t count, std::uint64_t& digest)
{
  for (std::size_t k = 0; k < count; ++k)
  {
    std::uint64_t bits = 0;
    std::memcpy(&bits, numbers + k, sizeof(Number));
    digest = (digest ^ bits) * 1099511628211ULL;
    digest ^= digest >> 29;
  }
}

constexpr std::uint64_t EmptyDigest = 14695981039346656037ULL;

std::uint64_t DigestOf(const TriangleMesh& mesh)
{
  std::uint64_t digest = EmptyDigest;
  for (const Vec3& point : mesh.points)
  {
    Digest(point.data(), 3, digest);
  }
  for (const auto& corners : mesh.triangles)
  {
    Digest(corners.data(), 3, digest);
  }
  return digest;
}

} // namespace

DistributedSurface::DistributedSurface(Stages& stages, const Communicator& ranks)
  : Surface(stages), ranks_(ranks), numbers_(ranks, 0, {})
{
}

void DistributedSurface::Run(const Progress& progress, const Body& body)
{
  struct Deciding // also when the body throws
  {
    Stages& stages;
    ~Deciding() { stages.DecideTogether(nullptr); }
  } const deciding{ this->GetStages() };
  deciding.stages.DecideTogether([this](bool holds) { return this->Any(holds); });
  own_ = progress;
  ranks_.Guard([&] { body(OfAllRanks(ranks_, progress)); });
}

void DistributedSurface::NeedWhole()
{
  throw std::logic_error("no process holds the whole surface");
}

bool DistributedSurface::IsRepeated(const TriangleMesh& own) const
{
  const bool hasAny = !own.triangles.empty();
  const std::vector<std::uint64_t> digests =
    ranks_.Gather(std::vector<std::uint64_t>{ hasAny ? DigestOf(own) : 0 });
  const auto digest = digests.begin() + ranks_.Rank();
  return hasAny && std::find(digests.begin(), digest, *digest) != digest;
}

void DistributedSurface::Measure(const TriangleMesh& own)
{
  area_ = SurfaceArea(own);
  ranks_.Sum(&area_, 1);
  if (!(area_ > 0.0))
  {
    throw InvalidInput("The surface has no area: all polygons are degenerate.");
  }
}

void DistributedSurface::BuildFunctions(const SurfaceOptions& asked, const TriangleList& copies,
  const std::shared_ptr<const GivenCells>& given)
{
  RankSpaceOptions options;
  options.space = { asked.choice, asked.space };
  options.space.functions.threads = this->ThreadsOfRank(asked.space.threads);
  options.functionsPerPoint = asked.functionsPerPoint;
  options.given = given;
  functions_ = nullptr; // frees its memory first
  functions_ = std::make_shared<const RankSurface>(
    ranks_, this->Mesh(), options, asked.choice.kind == FunctionKind::Hats, own_, copies);
  ++structure_;
}

void DistributedSurface::NoteOptions(const SurfaceOptions& asked)
{
  used_ = asked;
  used_.space.threads = this->ThreadsOfRank(asked.space.threads);
  used_.space.depth = this->GetGrid().depth; // coarser below hat functions that need less
}

int DistributedSurface::ThreadsOfRank(int wanted) const
{
  const int all = std::max(1, NumberOfThreads(0) / ranks_.RanksOfMachine());
  return wanted > 0 ? wanted : all;
}

void DistributedSurface::AgreeOn(std::vector<double>& numbers) const
{
  const std::vector<Id> counts = ranks_.Gather(std::vector<Id>{ static_cast<Id>(numbers.size()) });
  const std::vector<double> all = ranks_.Gather(numbers);
  const auto first = std::find_if(counts.begin(), counts.end(), [](Id count) { return count > 0; });
  numbers.assign(all.begin(), all.begin() + (first == counts.end() ? 0 : *first));
}

void DistributedSurface::AgreeOn(GivenCells& cells) const
{
  std::vector<double> numbers;
  if (!cells.ofTriangle.empty())
  {
    std::uint64_t digest = EmptyDigest;
    Digest(cells.cells.data(), cells.cells.size(), digest);
    const Vec3& origin = cells.grid.origin;
    numbers = { origin[0], origin[1], origin[2], cells.grid.spacing,
      static_cast<double>(cells.grid.depth), static_cast<double>(cells.cells.size()),
      static_cast<double>(digest >> 12) };
  }
  const std::vector<double> own = numbers;
  this->AgreeOn(numbers);
  this->Together(
    [&]
    {
      if (!own.empty() && own != numbers)
      {
        throw InvalidInput(
          "The surface of this rank was clipped to a different grid than the surface of "
          "other ranks. Clip it again.");
      }
    });
  cells.grid.origin = Vec3(numbers[0], numbers[1], numbers[2]);
  cells.grid.spacing = numbers[3];
  cells.grid.depth = static_cast<int>(numbers[4]);
}

std::shared_ptr<const SurfaceSpace> DistributedSurface::SharedSpace() const
{
  return { functions_, &functions_->Levels() };
}

double DistributedSurface::LongestSide() const
{
  return this->Space().UnitLength() * this->Space().Extent();
}

void DistributedSurface::Require(const MemoryNeed& own) const
{
  RequireMemory(ranks_, own);
}

double DistributedSurface::Largest(double own) const
{
  constexpr double Unknown = std::numeric_limits<double>::infinity();
  double largest = std::isnan(own) ? Unknown : own; // MPI does not define the maximum of NaN
  ranks_.Maximum(&largest, 1);
  return largest == Unknown ? std::nan("") : largest;
}

bool DistributedSurface::IsFirst(bool holds) const
{
  double first = holds ? ranks_.Rank() : ranks_.Size();
  ranks_.Minimum(&first, 1);
  return first == ranks_.Rank();
}

HeldValues DistributedSurface::Hold(const std::vector<Id>& points, const MultiVector& values) const
{
  return HoldPointsAndEdges(
    functions_->Levels(), this->AreCoincidentPointsWelded(), points, values);
}

BoundaryTerms DistributedSurface::OnBoundary(
  const MultiVector* flux, const MultiVector* values) const
{
  return TermsOnBoundary(functions_->Levels(), this->AreCoincidentPointsWelded(), flux, values);
}

EdgeSamples DistributedSurface::SampleBoundary(bool ofNested) const
{
  const RankLevels& levels = functions_->Levels();
  return gridfem::SampleBoundary(
    ofNested ? levels.OfGrid() : levels, this->AreCoincidentPointsWelded());
}

std::unique_ptr<DistanceMethod> DistributedSurface::MakeDistance(
  const DistanceOptions& options, const Job& job) const
{
  return std::make_unique<RankDistance>(functions_->Levels(), this->SharedMesh(), options, job);
}

std::vector<char> DistributedSurface::PointsWithFunctions() const
{
  std::vector<char> has = this->Space().PointsWithFunctions();
  MultiVector numbers(static_cast<Id>(has.size()), 1);
  std::copy(has.begin(), has.end(), numbers.data());
  this->FillCopies(numbers);
  std::transform(numbers.data(), numbers.data() + numbers.size(), has.begin(),
    [](double n) { return n == 1.0; });
  return has;
}

void DistributedSurface::FillCopies(MultiVector& atPoints) const
{
  const RankSpace& space = functions_->Space();
  space.Copies().FillPoints(space.Distribution(), atPoints);
}

} // namespace gridfem
