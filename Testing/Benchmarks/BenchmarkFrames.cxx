// Frames of a series smoothed on one surface of 32,402 points, beside the substitutions of CHOLMOD.
//
// Both smooth by 6 edges (FWHM) with hat functions and the same time scheme: three solves of M + γδ
// L for a frame. Set-up and factor are not counted, because a series pays for them once. Frames
// come either all at once, as the columns of one array, or one after the other, as in an animation.
// Times are the least of some runs, on two threads.
#include "Cholmod.h"
#include "CotangentSystem.h"
#include "Dense.h"
#include "Measure.h"
#include "Meshes.h"

#include "Largest.h"
#include "Solvers/DiffusionSolver.h"
#include "Solvers/LocalSurface.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <memory>

namespace
{

using namespace gridfem;
using namespace gridfem::benchmarks;

constexpr int Threads = 2;
constexpr Id Frames = 1200;
constexpr double WidthInEdges = 6.0;

class Ours
{
public:
  Ours(std::shared_ptr<const TriangleMesh> mesh, double width)
    : surface_(stages_, std::move(mesh), OnHats())
  {
    options_.amount = DiffusionAmount::FullWidth;
    options_.fullWidth = width;
  }

  const MultiVector& Smooth(const MultiVector& frames)
  {
    const GivenField values =
      GivenField::Of("frames", { FieldAssociation::Points, frames }, ++given_);
    return solver_.Update(surface_, { values, {}, {} }, options_, { Threads, {} })
      .steps.front()
      .atPoints;
  }

private:
  static SurfaceOptions OnHats()
  {
    SurfaceOptions options = DiffusionSolver::SurfaceDefaults();
    options.choice.kind = FunctionKind::Hats;
    options.space.threads = Threads;
    return options;
  }

  Stages stages_;
  LocalSurface surface_;
  DiffusionSolver solver_;
  DiffusionSolver::Options options_;
  std::int64_t given_ = 0;
};

class Peer
{
public:
  Peer(const TriangleMesh& mesh, double width)
    : hats_(AssembleCotangents(mesh)), step_((1.0 - std::sqrt(0.5)) * TimeOfFullWidth(width))
  {
    SetBlasThreads(Threads);
    const SymmetricMatrix matrix = Combine(hats_, 1.0 / step_);
    factor_.Analyze(matrix);
    factor_.Factor(matrix);
  }

  /// Three steps of Backward Euler, and the line through the last two up to the end.
  Eigen::MatrixXd Smooth(const MultiVector& frames) const
  {
    const Eigen::MatrixXd start = ToRows(hats_, frames);
    const auto advance = [&](const Eigen::MatrixXd& u) -> Eigen::MatrixXd
    { return factor_.Solve((hats_.mass * u) / step_); };
    const Eigen::MatrixXd second = advance(advance(start));
    const Eigen::MatrixXd third = advance(second);
    const double end = 1.0 / (1.0 - std::sqrt(0.5)); // of the step, in steps of Backward Euler
    return second + (end - 2.0) * (third - second);
  }

private:
  CotangentSystem hats_;
  double step_;
  Cholmod factor_;
};

/// The sides of the triangles of a sphere, if all are alike.
double EdgeOfSphere(Id points)
{
  return std::sqrt(8.0 * M_PI / std::sqrt(3.0) / static_cast<double>(points));
}

struct FrameTimes
{
  double ours = 0.0; // seconds
  double peers = 0.0;
  double difference = 0.0; // largest, relative to the largest value
};

/// Smooths one block of frames after the other, each by both. Keeps the least times of a block.
FrameTimes Compare(Ours& ours, const Peer& peer, const MultiVector& frames, Id block, int blocks)
{
  FrameTimes times{ HUGE_VAL, HUGE_VAL, 0.0 };
  for (int k = 0; k < blocks; ++k)
  {
    const MultiVector own = frames.middleCols(k * block % frames.cols(), block);
    MultiVector mine;
    Eigen::MatrixXd theirs;
    times.ours = std::min(times.ours, LeastSeconds(1, [&](int) { mine = ours.Smooth(own); }));
    times.peers = std::min(times.peers, LeastSeconds(1, [&](int) { theirs = peer.Smooth(own); }));
    const double largest = (mine - theirs).cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
    times.difference = gridfem::testing::Larger(
      times.difference, largest / theirs.cwiseAbs().maxCoeff<Eigen::PropagateNaN>());
  }
  return times;
}

} // namespace

int main()
{
  const auto mesh = std::make_shared<const TriangleMesh>(gridfem::testing::GeodesicSphere(90));
  const auto points = static_cast<Id>(mesh->points.size());
  const double width = WidthInEdges * EdgeOfSphere(points);
  Ours ours(mesh, width);
  const Peer peer(*mesh, width);
  const MultiVector frames = gridfem::testing::RandomValues(points, Frames);
  ours.Smooth(frames.leftCols(1)); // makes functions and hierarchy

  std::printf("Frames of noise on a sphere of %lld points\n\n", static_cast<long long>(points));
  const Table table({ "frames at once", "s", "ms a frame", "CHOLMOD, ms a frame", "difference" });
  const auto row = [&](Id block, int blocks)
  {
    const FrameTimes times = Compare(ours, peer, frames, block, blocks);
    const double scale = 1e3 / static_cast<double>(block);
    table.Row({ std::to_string(block), Text("%.3f", times.ours), Text("%.2f", scale * times.ours),
      Text("%.2f", scale * times.peers), Text("%.1e", times.difference) });
    return times;
  };
  const FrameTimes one = row(1, 20);
  row(8, 5);
  const FrameTimes all = row(Frames, 2);
  std::printf("\n");
  PrintAtMost("frames/ms-of-one-frame", 1e3 * one.ours, 40.0);
  PrintAtMost("frames/seconds-of-1200-frames", all.ours, 4.0);
  PrintAtLeast("frames/cholmod-over-ours-1200-frames", all.peers / all.ours, 1.0);
  PrintAtMost("frames/difference", gridfem::testing::Larger(one.difference, all.difference), 1e-3);
  return 0;
}
