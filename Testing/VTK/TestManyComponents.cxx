// Tests a surface of ten thousand separate components. Every filter reports progress all the way
// and serves an abort at any place.

#include "AllFilters.h"

using namespace gridfem;
using namespace gridfem::testing;

namespace
{

/// Makes tetrahedra on a square, two and a half cells of depth 8 apart and one cell wide.
vtkSmartPointer<vtkPolyData> TenThousandTetrahedra()
{
  constexpr int Side = 100;
  TriangleMesh mesh;
  for (int k = 0; k < Side * Side; ++k)
  {
    const int first = 4 * k;
    const Vec3 corner(k % Side, k / Side, 0);
    for (const Vec3& point : { Vec3(0, 0, 0), Vec3(0.4, 0, 0), Vec3(0, 0.4, 0), Vec3(0, 0, 0.4) })
    {
      mesh.points.push_back(corner + point);
    }
    for (const auto& [a, b, c] : { std::array{ 0, 2, 1 }, { 0, 1, 3 }, { 1, 2, 3 }, { 0, 3, 2 } })
    {
      mesh.triangles.push_back({ first + a, first + b, first + c });
    }
  }
  auto surface = ToPolyData(mesh);
  AddArraysOfAllFilters(surface);
  return surface;
}

/// Records the progress of a filter, and requests an abort at a fraction of it.
class Listener
{
public:
  Listener(vtkAlgorithm* filter, double end) : end_(end)
  {
    command_->SetClientData(this);
    command_->SetCallback(&Listener::Hear);
    filter->AddObserver(vtkCommand::ProgressEvent, command_);
  }

  std::vector<double> fractions;
  int afterAbort = 0; // reports

private:
  static void Hear(vtkObject* caller, unsigned long, void* self, void*)
  {
    auto* filter = static_cast<vtkAlgorithm*>(caller);
    auto* listener = static_cast<Listener*>(self);
    listener->afterAbort += listener->isAborted_;
    listener->fractions.push_back(filter->GetProgress());
    if (!listener->isAborted_ && filter->GetProgress() >= listener->end_)
    {
      listener->isAborted_ = true;
      filter->SetAbortExecute(1);
    }
  }

  double end_;
  bool isAborted_ = false;
  vtkNew<vtkCallbackCommand> command_;
};

class ManyComponents : public ::testing::TestWithParam<FilterCase>
{
protected:
  ManyComponents() : filter(GetParam().make()), messages(filter)
  {
    filter->SetInputData(TenThousandTetrahedra());
    filter->SetDepth(8);
    filter->SetNumberOfThreads(1);
    filter->ReleaseDataFlagOn(); // so that every run is the same
  }

  /// Returns the reports of a run that is aborted at a fraction.
  Listener Run(double end)
  {
    filter->RemoveObservers(vtkCommand::ProgressEvent);
    Listener listener(filter, end);
    filter->Modified();
    succeeded = filter->GetExecutive()->Update() == 1;
    return listener;
  }

  bool HasOutput() { return !IsEmptyData(filter->GetOutputDataObject(0)); }

  vtkSmartPointer<vtkSurfaceFEMAlgorithm> filter;
  Messages messages;
  bool succeeded = false;
};

TEST_P(ManyComponents, AreReportedAndCanBeAborted)
{
  constexpr double Never = 2.0;
  constexpr double LeastStep = 0.02; // between two reports that come fast
  const auto whole = this->Run(Never).fractions;
  EXPECT_TRUE(std::is_sorted(whole.begin(), whole.end()));
  ASSERT_GT(whole.size(), 4u); // the pipeline makes two
  const bool hasResult = messages.errors.empty();
  EXPECT_EQ(succeeded, hasResult);
  EXPECT_EQ(this->HasOutput(), hasResult);
  if (!hasResult) // signatures need modes that are not constants, and a map needs one component
  {
    const bool isMap = filter->IsA("vtkFunctionalMap");
    const char* reason = isMap ? "10000 connected components" : "Number Of Modes above 10000";
    EXPECT_NE(messages.errors[0].find(reason), std::string::npos) << messages.errors[0];
    messages.errors.clear();
  }
  for (const double end : { whole[1], whole[whole.size() / 2] })
  {
    const auto part = this->Run(std::max(end - LeastStep, 1e-6)); // 0 is the pipeline's
    // The pipeline adds a report at the end.
    EXPECT_LE(part.afterAbort, 1) << "aborted at " << end << ", at last "
                                  << ::testing::PrintToString(part.fractions);
    EXPECT_TRUE(succeeded);
    EXPECT_FALSE(this->HasOutput()) << "aborted at " << end;
    EXPECT_TRUE(messages.errors.empty());
  }
  EXPECT_EQ(this->Run(Never).fractions.back(), 1.0); // nothing of the abort is left
  EXPECT_EQ(this->HasOutput(), hasResult);
}

INSTANTIATE_TEST_SUITE_P(AllFilters, ManyComponents, AllFilters(), NameOf);

} // namespace
