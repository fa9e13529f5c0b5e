// Tests Laplace Spectrum on hat functions: it has the spectrum of a direct solver at every depth
// and for every kind of input.

#include "Spectra.h"
#include "Support/HatSystem.h"

#include "vtkConnectivityAwareBasis.h"
#include "vtkScreenedPoisson.h"
#include "vtkSpectralSignatures.h"

#include "vtkStripper.h"

#include <gtest/gtest.h>

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

using Spectrum = vtkLaplaceSpectrum;
constexpr int Modes = 9;

class HatLaplaceSpectrum : public ::testing::Test
{
protected:
  HatLaplaceSpectrum() : mesh(Transform(GeodesicSphere(8), { 1, 2, 0 }, 0.5, 3.0)), messages(filter)
  {
    filter->SetFunctionSpace(Spectrum::HatFunctions);
    filter->SetDepth(4);
    filter->SetNumberOfModes(Modes);
    filter->SetTolerance(1e-10);
    filter->SetInputData(ToPolyData(mesh));
  }

  /// The tolerance is the relative error of a value. The error of the reference is 1e-8.
  void ExpectSpectrumOf(const TriangleMesh& surface, const std::string& what)
  {
    const std::vector<double> expected = HatEigenvalues(BuildHatSystem(surface), Modes);
    EXPECT_LT(Difference(Eigenvalues(filter), expected), 1e-7 * expected.back()) << what;
    EXPECT_EQ(FieldValue(filter->GetOutput(), "Converged"), 1) << what;
  }

  TriangleMesh mesh;
  vtkNew<Spectrum> filter;
  Messages messages;
};

TEST_F(HatLaplaceSpectrum, IsThatOfADirectSolverAtEveryDepth)
{
  for (const int depth : { 2, 4, 6 })
  {
    filter->SetDepth(depth);
    this->ExpectSpectrumOf(mesh, "depth " + std::to_string(depth));
    EXPECT_LE(FieldValue(filter->GetOutput(), "UsedDepth"), depth);
  }
}

TEST_F(HatLaplaceSpectrum, TheGridIsAsFineAsTheEstimateOfErrorsNeeds)
{
  // The errors are relative to the values of the surface itself. They come from the coarse mesh.
  vtkNew<Spectrum> exact;
  exact->SetNumberOfModes(Modes);
  exact->SetDepth(8);
  exact->SetInputData(ToPolyData(mesh));
  exact->Update();
  const auto surface = Column(exact, "Eigenvalue");
  filter->SetDepth(8);
  const auto hats = Eigenvalues(filter);
  const double enough = FieldValue(filter->GetOutput(), "UsedDepth");
  EXPECT_LT(enough, 6);
  const auto said = Column(filter, "EstimatedError");
  for (int k = 1; k < Modes; ++k)
  {
    const double error = hats[k] / surface[k] - 1.0;
    EXPECT_GT(said[k], 0.5 * error) << k;
    EXPECT_LT(said[k], 2.0 * error) << k;
  }
  vtkNew<vtkScreenedPoisson> poisson; // which is to be solved only
  poisson->SetFunctionSpace(Spectrum::HatFunctions);
  poisson->SetDepth(8);
  poisson->SetInputData(ToPolyData(mesh));
  poisson->Update();
  EXPECT_EQ(FieldValue(poisson->GetOutput(), "UsedDepth"), enough - 1);
}

TEST_F(HatLaplaceSpectrum, ModesAreOrthonormalInTheMassOfTheMesh)
{
  filter->AllModesOn();
  filter->Update();
  Eigen::MatrixXd X(mesh.points.size(), Modes);
  for (int mode = 0; mode < Modes; ++mode)
  {
    const auto values = PointValues(filter->GetOutput(), ("Mode00" + std::to_string(mode)).c_str());
    ASSERT_EQ(values.size(), mesh.points.size());
    X.col(mode) = Eigen::Map<const Eigen::VectorXd>(values.data(), X.rows());
  }
  const HatSystem system = BuildHatSystem(mesh);
  Eigen::MatrixXd ordered(X.rows(), Modes);
  for (Eigen::Index point = 0; point < X.rows(); ++point)
  {
    ordered.row(system.row[point]) = X.row(point);
  }
  const Eigen::MatrixXd gram = ordered.transpose() * (system.mass * ordered);
  EXPECT_LT(
    (gram - Eigen::MatrixXd::Identity(Modes, Modes)).cwiseAbs().maxCoeff<Eigen::PropagateNaN>(),
    1e-9);
}

TEST_F(HatLaplaceSpectrum, StripsSoupAndFoldsAreTheirTriangles)
{
  vtkNew<vtkStripper> stripper;
  stripper->SetInputData(ToPolyData(mesh));
  stripper->Update();
  ASSERT_GT(stripper->GetOutput()->GetNumberOfStrips(), 0);
  filter->SetInputData(stripper->GetOutput());
  this->ExpectSpectrumOf(mesh, "strips");
  filter->SetInputData(ToPolyData(Unweld(mesh)));
  this->ExpectSpectrumOf(mesh, "soup");
  // Three half-planes share an edge.
  TriangleMesh book = FlatRectangle(6, 6);
  const TriangleMesh page = book;
  for (const double angle : { 2.0, 4.0 })
  {
    book = Join(book, Transform(page, { 0, 1, 0 }, angle));
  }
  for (Vec3& point : book.points) // the rotation moves points of the axis by rounding
  {
    if (std::hypot(point[0], point[2]) < 1e-9)
    {
      point = { 0.0, std::round(6.0 * point[1]) / 6.0, 0.0 };
    }
  }
  filter->SetInputData(ToPolyData(book));
  this->ExpectSpectrumOf(book, "book");
}

TEST_F(HatLaplaceSpectrum, PointsWithoutAFunctionHaveNoValue)
{
  const TriangleMesh clean = mesh;
  mesh.points.push_back({ 9, 9, 9 });
  mesh.points.push_back({ 1, 0, 0 });
  const Id last = static_cast<Id>(mesh.points.size()) - 1;
  mesh.triangles.push_back({ last, last, 0 }); // has no area
  filter->SetInputData(ToPolyData(mesh));
  this->ExpectSpectrumOf(clean, "unused points");
  const auto mode = PointValues(filter->GetOutput(), "Mode");
  EXPECT_TRUE(std::isnan(mode[last - 1]));
  EXPECT_TRUE(std::isnan(mode[last]));
}

TEST_F(HatLaplaceSpectrum, TakesABasisOrTheClippedMesh)
{
  vtkNew<vtkConnectivityAwareBasis> basis;
  basis->SetDepth(4);
  basis->SetInputData(filter->GetInput());
  filter->SetBasisConnection(basis->GetOutputPort());
  this->ExpectSpectrumOf(mesh, "basis on port 1");
  const auto coarse = Eigenvalues(filter);
  filter->SetInputConnection(1, nullptr);
  filter->SetInputConnection(0, basis->GetOutputPort());
  const auto clipped = Eigenvalues(filter);
  ASSERT_EQ(clipped.size(), coarse.size());
  for (int k = 1; k < Modes; ++k)
  {
    EXPECT_LT(clipped[k], coarse[k]); // the hats of the clipped mesh contain the mesh's
  }
}

TEST_F(HatLaplaceSpectrum, MoreModesThanHatsWarnsAndGivesAll)
{
  filter->SetInputData(ToPolyData(GeodesicSphere(2)));
  filter->SetNumberOfModes(100);
  EXPECT_EQ(Eigenvalues(filter).size(), 18u); // 4 n² + 2 points
  ASSERT_FALSE(messages.warnings.empty());
  EXPECT_NE(messages.warnings[0].find("hat functions of this mesh"), std::string::npos);
}

TEST_F(HatLaplaceSpectrum, AnAccuracyThatTheMeshDoesNotHaveIsReported)
{
  // The ninth eigenvalue of 512 flat triangles is good to 3 %.
  filter->SetAccuracy(0.1);
  Eigenvalues(filter);
  EXPECT_EQ(FieldValue(filter->GetOutput(), "Converged"), 1);
  EXPECT_TRUE(messages.warnings.empty());
  filter->SetAccuracy(0.005);
  Eigenvalues(filter);
  EXPECT_EQ(FieldValue(filter->GetOutput(), "Converged"), 0);
  ExpectOne(messages.warnings, "subdivide the mesh");
  EXPECT_LE(FieldValue(filter->GetOutput(), "UsedDepth"), 6); // no depth helps, so none is tried
}

TEST_F(HatLaplaceSpectrum, SignaturesAreThoseOfItsModes)
{
  vtkNew<vtkSpectralSignatures> own;
  own->SetFunctionSpace(Spectrum::HatFunctions);
  own->SetDepth(4);
  own->SetNumberOfModes(Modes);
  own->SetTolerance(1e-10);
  own->SetInputData(filter->GetInput());
  own->Update();
  filter->AllModesOn();
  vtkNew<vtkSpectralSignatures> chained;
  chained->SetInputConnection(filter->GetOutputPort());
  chained->Update();
  const auto expected = PointValues(chained->GetOutput(), "HeatKernelSignature");
  ASSERT_FALSE(expected.empty());
  // Values are known to 1e-10 and vectors to its square root. The signature is a sum of their
  // squares.
  EXPECT_LT(Difference(PointValues(own->GetOutput(), "HeatKernelSignature"), expected), 1e-5);
}

} // namespace
