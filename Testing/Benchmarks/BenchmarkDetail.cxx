// Frames per second of Surface Detail, while a user moves a slider. [T Table 5.5]
//
// A frame ends with new positions of all vertices. It has the states of the thesis. "solve" is one
// cycle from the last solution. "rhs" integrates a new scale before this cycle. "matrix" also
// weighs the elements for a new transfer function and updates the hierarchy. "scale" is the work of
// the filter for another DetailScale. The solution is linear in the scale, so nothing is solved.
// The peer solves the same equation on hat functions and factorizes again.
#include "Cholmod.h"
#include "Measure.h"
#include "Meshes.h"
#include "SetupCost.h"

#include "Base/LargeMemory.h"
#include "Integrals/LoadVector.h"
#include "Shape/SurfaceDetail.h"
#include "Spaces/HatSpace.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace
{

using namespace gridfem;
using namespace gridfem::benchmarks;

constexpr int Threads = 2;
constexpr int Frames = 5;

struct Subject
{
  const char* name; // of the thesis
  const char* file; // the nearest mesh there is
  int subdivisions;
  int depth;
};

constexpr Subject Subjects[] = { { "Lucy", "happy_buddha_99k.ply", 1, 7 },
  { "Buddha", "happy_buddha_99k.ply", 2, 8 }, { "Armadillo", "armadillo_100k.ply", 1, 8 },
  { "Dragon", "dragon_871k.ply", 0, 8 }, { "Isidore", "rocker_arm.ply", 3, 8 } };

template<class Frame>
double SecondsOf(Frame&& frame)
{
  return LeastSeconds(Frames, frame);
}

struct DetailTimes
{
  double vertices = 0.0;
  double functions = 0.0;
  double setup = 0.0;
  double scale = 0.0;
  double solve = 0.0;
  double load = 0.0;
  double matrix = 0.0;
  double error = 0.0;  // of the positions after a frame of "matrix", relative to the displacement
  double loads3 = 0.0; // right-hand sides of values and gradients of three columns, from arrays
  double loads1 = 0.0;
  double evaluate = 0.0;
};

class DetailFrames
{
public:
  DetailFrames(const TriangleMesh& mesh, int depth) : mesh_(mesh)
  {
    options_.functions.depth = depth;
    options_.functions.threads = Threads;
    options_.normalStabilization = 1e-2;
    multigridOptions_.threads = Threads;
    multigridOptions_.cycle = CycleType::V;
  }

  DetailTimes Measure()
  {
    DetailTimes times;
    this->Prepare(times);
    times.scale = SecondsOf([&](int k) { this->Move(0.1 * k); });
    times.solve = SecondsOf([&](int) { this->Cycle(); });
    times.load = SecondsOf(
      [&](int k)
      {
        this->Integrate(k);
        this->Cycle();
      });
    times.matrix = SecondsOf(
      [&](int k)
      {
        this->Weigh(k);
        this->Integrate(k);
        this->Cycle();
      });
    const MultiVector inFrame = change_;
    this->Solve();
    times.error = (inFrame - change_).norm() / change_.norm();
    this->MeasureLoads(times);
    return times;
  }

private:
  void Prepare(DetailTimes& times)
  {
    times.vertices = static_cast<double>(mesh_.points.size());
    for (int k = 0; k < 2; ++k) // the first one touches the memory
    {
      const Stopwatch watch;
      space_ = std::make_unique<GridSpace>(BuildGridSpace(mesh_, options_));
      lambda_ = 500.0 / SurfaceArea(mesh_) * std::pow(space_->UnitLength(), 2);
      hierarchy_ =
        std::make_unique<Multigrid>(BuildMultigrid(*space_, lambda_, 1.0, multigridOptions_));
      times.setup = watch.Seconds();
    }
    times.functions = static_cast<double>(space_->NumberOfFunctions(0));
    const HatFunctions around = NumberHatFunctions(mesh_);
    const TriangleCurvatures curvatures = CurvaturesOnTriangles(mesh_,
      ComputeCurvatures(mesh_, around, PointNormals(mesh_, around, Threads), Threads), Threads);
    usual_ = UsualCurvature(mesh_, curvatures);
    onElements_ = space_->MeansOnElements(curvatures.values, Threads);
    weighted_ = space_->Copy();
    weighted_->SplitStiffness(curvatures.direction, Threads);
    shape_ = ShapeInSpace(*space_, Threads).coefficients;
    this->Weigh(0);
    this->Integrate(0);
    this->Solve();
  }

  /// A user's hand moves a little farther in every frame.
  void Weigh(int frame)
  {
    const double strength = 4.0 + 0.05 * frame;
    weighted_->Weigh(WeightsOfMetric(onElements_, [&](double curvature)
                       { return 1.0 + strength * std::min(1.0, std::abs(curvature) / usual_); }),
      Threads);
    UpdateMultigrid(*weighted_, lambda_, 1.0, *hierarchy_);
  }

  void Integrate(int frame)
  {
    const std::vector<double> scale(onElements_.rows(), 1.0 + 0.02 * frame);
    load_ = weighted_->StiffnessTimes(shape_, scale, Threads);
  }

  void Solve()
  {
    PoissonOptions options;
    options.screeningWeight = lambda_;
    options.multigrid = multigridOptions_;
    options.solve.tolerance = 1e-8;
    const MultiVector last = std::move(solution_);
    options.start = &last;
    const MultiVector noValues = MultiVector::Zero(load_.rows(), load_.cols());
    solution_ = SolvePoisson(*weighted_, *hierarchy_, noValues, load_, options).coefficients;
    this->Move(1.0);
  }

  void Cycle()
  {
    hierarchy_->Cycle(load_, solution_);
    this->Move(1.0);
  }

  void Move(double scale)
  {
    change_ = weighted_->ValuesAtPoints(scale * solution_, Threads);
    positions_.resize(mesh_.points.size());
    for (std::size_t p = 0; p < positions_.size(); ++p)
    {
      positions_[p] =
        mesh_.points[p] + Vec3(Eigen::Map<const Vec3>(&change_(static_cast<Id>(p), 0)));
    }
  }

  void MeasureLoads(DetailTimes& times)
  {
    const auto points = static_cast<Id>(mesh_.points.size());
    for (const int columns : { 1, 3 })
    {
      const Field values{ FieldAssociation::Points, MultiVector::Ones(points, columns) };
      const Field gradients{ FieldAssociation::Points, MultiVector::Ones(points, 3 * columns) };
      (columns == 1 ? times.loads1 : times.loads3) = SecondsOf(
        [&](int)
        {
          space_->LoadOfValues(values, Threads);
          space_->LoadOfGradients(gradients, nullptr, Threads);
        });
    }
    times.evaluate = SecondsOf([&](int) { space_->ValuesAtPoints(solution_, Threads); });
  }

  const TriangleMesh& mesh_;
  GridSpaceOptions options_;
  MultigridOptions multigridOptions_;
  std::unique_ptr<GridSpace> space_;
  std::unique_ptr<FiniteElementSpace> weighted_;
  std::unique_ptr<Multigrid> hierarchy_;
  double lambda_ = 1.0;
  double usual_ = 1.0;
  MultiVector onElements_;
  MultiVector shape_;
  MultiVector load_;
  MultiVector solution_;
  MultiVector change_;
  std::vector<Vec3> positions_;
};

/// CHOLMOD's numeric factorization and solution of three columns for a changed matrix of the hats:
/// the least of five changes after one that touches its memory for the first time.
double CholmodSecondsPerChange(const TriangleMesh& mesh)
{
  SetBlasThreads(Threads);
  const CotangentSystem hats = AssembleCotangents(mesh);
  const SymmetricMatrix A = Combine(hats, 500.0 / SurfaceArea(mesh));
  Cholmod cholmod;
  cholmod.Analyze(A);
  const Eigen::MatrixXd b = Eigen::MatrixXd::Ones(A.rows(), 3);
  double least = std::numeric_limits<double>::infinity();
  for (int change = 0; change < 6; ++change)
  {
    const Stopwatch watch;
    cholmod.Factor(A);
    cholmod.Solve(b);
    least = change == 0 ? least : std::min(least, watch.Seconds());
  }
  return least;
}

} // namespace

/// Parts: the names of the meshes in the thesis, and "peer" for CHOLMOD beside them.
int main(int argc, char** argv)
{
  const Parts parts(argc, argv);
  std::printf("\nFrames per second, three components, %d threads [T Table 5.5]\n", Threads);
  const Table table({ "for", "vertices", "functions", "set-up s", "scale", "solve", "rhs", "matrix",
    "error of a frame", "loads of 3 / set-up", "of 1", "values at points s", "CHOLMOD s" });
  for (const Subject& subject : Subjects)
  {
    if (!parts.Want(subject.name))
    {
      continue;
    }
    const TriangleMesh mesh = RealMesh(subject.name, subject.file, subject.subdivisions).mesh;
    const auto times = MeasureInOwnProcess<DetailTimes>(
      [&]
      {
        const MemoryReuse reuse;
        return DetailFrames(mesh, subject.depth).Measure();
      });
    const double peer =
      parts.IsNamed("peer") || argc == 1
        ? MeasureInOwnProcess<double>([&] { return CholmodSecondsPerChange(mesh); })
        : 0.0;
    table.Row({ subject.name, Text("%.0f", times.vertices), Text("%.0f", times.functions),
      Text("%.2f", times.setup), Text("%.1f", 1.0 / times.scale), Text("%.1f", 1.0 / times.solve),
      Text("%.1f", 1.0 / times.load), Text("%.1f", 1.0 / times.matrix), Text("%.1e", times.error),
      Text("%.3f", times.loads3 / times.setup), Text("%.3f", times.loads1 / times.setup),
      Text("%.3f", times.evaluate), Text("%.2f", peer) });
    const std::string name = std::string("detail-") + subject.name;
    const double size = times.functions / 2.7e5;
    PrintAtLeast(name + "-solve-frames", 1.0 / times.solve, 27.0 / size);
    PrintAtLeast(name + "-rhs-frames", 1.0 / times.load, 12.0 / size);
    PrintAtLeast(name + "-matrix-frames", 1.0 / times.matrix, 5.0 / size);
    PrintAtMost(name + "-frame-error", times.error, 1e-3);
    PrintAtMost(name + "-loads-3-over-setup", times.loads3 / times.setup, 0.2);
    PrintAtMost(name + "-loads-1-over-setup", times.loads1 / times.setup, 0.15);
    if (peer > 0.0)
    {
      PrintAtLeast(name + "-cholmod-over-matrix", peer / times.matrix, 20.0);
    }
  }
}
