// The messages for a user: none if all is well, otherwise the cause.
#include "Solvers/SolveWarnings.h"

#include <gtest/gtest.h>

#include <set>

using namespace gridfem;

namespace
{

bool Has(const std::string& text, const std::string& part)
{
  return text.find(part) != std::string::npos;
}

Spectrum SpectrumOf(std::vector<double> values, Index constants)
{
  Spectrum spectrum;
  spectrum.eigenvalues = std::move(values);
  spectrum.residuals.assign(spectrum.eigenvalues.size(), 1e-9);
  spectrum.numberOfConstants = constants;
  spectrum.converged = true;
  return spectrum;
}

std::string TextOf(const Spectrum& spectrum, int wanted)
{
  return Joined(WarningsOf(spectrum, wanted, "at Depth 7"));
}

} // namespace

TEST(SolveWarnings, NameADifferentReasonForEveryEnd)
{
  std::set<std::string> reasons;
  for (const SolveEnd end : { SolveEnd::Converged, SolveEnd::IterationLimit, SolveEnd::NotFinite,
         SolveEnd::Stagnation, SolveEnd::Breakdown })
  {
    SolveReport report;
    report.end = end;
    report.iterations = 17;
    report.history = { { 0, 1.0, 1.0 }, { 17, 0.25, 0.5 } };
    reasons.insert(ReasonOf(report));
    const std::string warning = WarningOf(report, 1e-6);
    EXPECT_TRUE(Has(warning, "after 17 iterations")) << warning;
    EXPECT_TRUE(Has(warning, ReasonOf(report))) << warning;
    EXPECT_TRUE(Has(warning, "energy residual is 0.25, the residual is 0.5"));
  }
  EXPECT_EQ(reasons.size(), 5U);
}

TEST(SolveWarnings, AreOfErrorsWhereNoToleranceIsGiven)
{
  SolveReport report;
  SolutionAccuracy accuracy;
  accuracy.algebraic = 0.125;
  accuracy.discretization = 0.0625;
  EXPECT_TRUE(Has(WarningOf(report, accuracy, 0.0), "0.125 of the solution"));
  EXPECT_TRUE(Has(WarningOf(report, accuracy, 0.0), "function space is 0.0625"));
  EXPECT_EQ(WarningOf(report, accuracy, 1e-3), WarningOf(report, 1e-3));
  report.converged = true;
  EXPECT_EQ(WarningOf(report, accuracy, 0.0), "");
  EXPECT_EQ(WarningOf(report, accuracy, 1e-3), "");
}

TEST(SolveWarnings, OfSpectraNameWhatIsMissing)
{
  EXPECT_EQ(TextOf(SpectrumOf({ 0, 1, 2 }, 1), 3), "");

  Spectrum truncated = SpectrumOf({ 0, 1, 2 }, 1);
  truncated.truncated = true;
  EXPECT_EQ(TextOf(truncated, 9), "Only 3 of the 9 modes exist at Depth 7.");

  EXPECT_TRUE(Has(TextOf(SpectrumOf({ 0, 0, 0 }, 3), 3), "3 connected components"));
  EXPECT_EQ(TextOf(SpectrumOf({ 0 }, 1), 1), ""); // a user who asks for one mode knows

  Spectrum open = SpectrumOf({ 0, 1, 2 }, 1);
  open.converged = false;
  open.iterations = 50;
  open.numberOfConverged = 2;
  open.residuals.back() = 0.5;
  const std::string text = TextOf(open, 3);
  EXPECT_TRUE(Has(text, "after 50 iterations: 2 of 3 modes")) << text;
  EXPECT_TRUE(Has(text, "largest residual is 0.5")) << text;
  EXPECT_FALSE(Has(text, "Normal Stabilization")) << text;

  open.truncated = true; // others may exist
  EXPECT_TRUE(Has(TextOf(open, 9), "Only 3 of the 9 modes were found")) << TextOf(open, 9);
  EXPECT_TRUE(Has(TextOf(open, 9), "Normal Stabilization")) << TextOf(open, 9);
}

TEST(SolveWarnings, OfConstraintsNameFreeComponentsAndVisibleMisfits)
{
  ConstrainedSolution solution;
  solution.report.converged = true;
  solution.isHeld = { 1, 1 };
  EXPECT_EQ(Joined(WarningsOf(solution, 1e-6)), "");
  solution.isHeld = { 1, 0, 0 };
  EXPECT_TRUE(Has(Joined(WarningsOf(solution, 1e-6)), "2 of 3"));
  solution.misfit = 0.25;
  solution.relativeMisfit = 0.5;
  EXPECT_TRUE(Has(WarningOfConstraints(solution), "0.25"));
  solution.relativeMisfit = 1e-4;
  EXPECT_EQ(WarningOfConstraints(solution), "");
}

TEST(SolveWarnings, OfFlowsSayWhyTheyEnd)
{
  FlowSummary flow;
  flow.steps = flow.wanted = 5;
  EXPECT_EQ(WarningOf(flow, false, {}), "");
  flow.unconverged = 1;
  EXPECT_TRUE(Has(WarningOf(flow, false, {}), "1 step has"));
  flow.unconverged = 2;
  EXPECT_TRUE(Has(WarningOf(flow, false, {}), "2 steps have"));
  flow.unconverged = 0;
  flow.steps = 3;
  std::set<std::string> texts;
  for (const FlowEnd end :
    { FlowEnd::Vanished, FlowEnd::VolumeLost, FlowEnd::Unfit, FlowEnd::Breakdown })
  {
    flow.end = end;
    texts.insert(WarningOf(flow, false, {}));
    EXPECT_TRUE(Has(*texts.rbegin(), "after 3 of 5 steps"));
  }
  EXPECT_EQ(texts.size(), 4U);
}

TEST(SolveWarnings, JoinSentencesWithoutEmptyOnes)
{
  EXPECT_EQ(Joined({}), "");
  EXPECT_EQ(Joined({ "", "A.", "", "B." }), "A. B.");
}
