// Support shared by the filter tests: meshes as vtkPolyData, collected messages, arrays as vectors.
#ifndef GridFEM_Testing_FilterSupport_h
#define GridFEM_Testing_FilterSupport_h

#include "ExpectOne.h"
#include "Largest.h"
#include "Meshes.h"

#include "vtkAlgorithm.h"
#include "vtkCallbackCommand.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkExecutive.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkTable.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

namespace gridfem::testing
{

inline constexpr int Points = vtkDataObject::FIELD_ASSOCIATION_POINTS;
inline constexpr int Cells = vtkDataObject::FIELD_ASSOCIATION_CELLS;

/// The stages of solvers, in the order in which they depend on each other.
inline constexpr const char* Stages[] = { "Space", "System", "Hierarchy", "RightHandSide",
  "Solve" };

/// A smooth function of the position, one per component.
inline double Wave(const Vec3& p, int c)
{
  return std::sin(3 * p[0] + c) + p[2];
}

inline vtkSmartPointer<vtkPolyData> ToPolyData(const TriangleMesh& mesh, int precision = VTK_DOUBLE)
{
  auto data = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  points->SetDataType(precision);
  for (const Vec3& point : mesh.points)
  {
    points->InsertNextPoint(point.data());
  }
  vtkNew<vtkCellArray> polys;
  for (const auto& triangle : mesh.triangles)
  {
    polys->InsertNextCell({ triangle[0], triangle[1], triangle[2] });
  }
  data->SetPoints(points);
  data->SetPolys(polys);
  return data;
}

/// Adds a double point array with the components f(point).
inline vtkDoubleArray* AddPointArray(vtkPolyData* data, const char* name, int components,
  const std::function<double(const Vec3&, int)>& f)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(data->GetNumberOfPoints());
  for (vtkIdType k = 0; k < data->GetNumberOfPoints(); ++k)
  {
    const Vec3 point(data->GetPoint(k));
    for (int c = 0; c < components; ++c)
    {
      array->SetComponent(k, c, f(point, c));
    }
  }
  data->GetPointData()->AddArray(array);
  return array;
}

/// Whether a filter has passed its input on: the same points and cells, without the result.
inline bool PassesOn(vtkAlgorithm* filter, const char* result)
{
  auto* input = vtkPolyData::SafeDownCast(filter->GetInputDataObject(0, 0));
  auto* output = vtkPolyData::SafeDownCast(filter->GetOutputDataObject(0));
  return output->GetPoints() == input->GetPoints() && output->GetPolys() == input->GetPolys() &&
         !output->GetPointData()->HasArray(result) && !output->GetCellData()->HasArray(result);
}

/// Collects the messages of a filter, and silences the messages of its executive.
class Messages
{
public:
  explicit Messages(vtkAlgorithm* algorithm) : algorithm_(algorithm)
  {
    errorCommand_->SetClientData(&errors);
    errorCommand_->SetCallback(&Messages::Collect);
    warningCommand_->SetClientData(&warnings);
    warningCommand_->SetCallback(&Messages::Collect);
    quiet_->SetCallback([](vtkObject*, unsigned long, void*, void*) {});
    algorithm->AddObserver(vtkCommand::ErrorEvent, errorCommand_);
    algorithm->AddObserver(vtkCommand::WarningEvent, warningCommand_);
    algorithm->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, quiet_);
  }

  ~Messages()
  {
    algorithm_->RemoveObserver(errorCommand_);
    algorithm_->RemoveObserver(warningCommand_);
  }

  std::vector<std::string> errors;
  std::vector<std::string> warnings;

private:
  static void Collect(vtkObject*, unsigned long, void* list, void* text)
  {
    static_cast<std::vector<std::string>*>(list)->emplace_back(static_cast<const char*>(text));
  }

  vtkSmartPointer<vtkAlgorithm> algorithm_;
  vtkNew<vtkCallbackCommand> errorCommand_;
  vtkNew<vtkCallbackCommand> warningCommand_;
  vtkNew<vtkCallbackCommand> quiet_;
};

/// Returns all values of an array. Empty if there is none.
inline std::vector<double> Values(vtkDataArray* array)
{
  std::vector<double> values;
  for (vtkIdType k = 0; array && k < array->GetNumberOfTuples(); ++k)
  {
    for (int c = 0; c < array->GetNumberOfComponents(); ++c)
    {
      values.push_back(array->GetComponent(k, c));
    }
  }
  return values;
}

inline std::vector<double> PointValues(vtkDataObject* data, const char* name)
{
  return Values(vtkPolyData::SafeDownCast(data)->GetPointData()->GetArray(name));
}

inline double FieldValue(vtkDataObject* data, const char* name)
{
  vtkDataArray* array = data->GetFieldData()->GetArray(name);
  return array ? array->GetComponent(0, 0) : std::nan("");
}

/// Returns a column of a filter's table.
inline std::vector<double> Column(vtkAlgorithm* filter, const char* name)
{
  auto* table = vtkTable::SafeDownCast(filter->GetOutputDataObject(1));
  return Values(vtkDataArray::SafeDownCast(table->GetColumnByName(name)));
}

inline bool AllFinite(const std::vector<double>& values)
{
  return std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
}

/// Returns the largest difference. Infinite for different sizes.
inline double Difference(const std::vector<double>& a, const std::vector<double>& b)
{
  if (a.size() != b.size())
  {
    return INFINITY;
  }
  double largest = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k)
  {
    const bool areUnknown = std::isnan(a[k]) && std::isnan(b[k]);
    largest = Larger(largest, areUnknown ? 0.0 : std::abs(a[k] - b[k]));
  }
  return largest;
}

inline bool IsEmptyData(vtkDataObject* data)
{
  return data->GetNumberOfElements(vtkDataObject::POINT) <= 0 &&
         data->GetNumberOfElements(vtkDataObject::CELL) <= 0 &&
         data->GetNumberOfElements(vtkDataObject::ROW) <= 0 &&
         data->GetFieldData()->GetNumberOfArrays() == 0;
}

/// Expects a run to fail without output, and with a single error that contains all the parts.
template<class... Parts>
void ExpectRefused(vtkAlgorithm* filter, const Parts&... parts)
{
  const Messages messages(filter);
  EXPECT_EQ(filter->GetExecutive()->Update(), 0);
  ExpectOne(messages.errors, parts...);
  for (int port = 0; port < filter->GetNumberOfOutputPorts(); ++port)
  {
    EXPECT_TRUE(IsEmptyData(filter->GetOutputDataObject(port))) << "port " << port;
  }
}

} // namespace gridfem::testing

#endif
