// Damages the tables of a saved basis, and solves an equation on it.
#include "DamagedInput.h"

#include "FilterSupport.h"

#include "vtkConnectivityAwareBasis.h"
#include "vtkInformation.h"
#include "vtkScreenedPoisson.h"

#include <map>

namespace gridfem::testing
{
namespace
{

/// Largest change of a solution by tables that were accepted, over its largest value. The solver's
/// tolerance is 1e-12.
constexpr double SameAnswer = 1e-6;

/// Returns the array without the basis in memory that may be attached to it.
vtkSmartPointer<vtkDataArray> Stored(vtkDataArray* array, int type)
{
  auto copy = vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(type));
  copy->DeepCopy(array);
  copy->SetName(array->GetName());
  copy->GetInformation()->Clear();
  return copy;
}

void StoreAll(vtkFieldData* from, vtkFieldData* to)
{
  to->Initialize();
  for (int k = 0; k < from->GetNumberOfArrays(); ++k)
  {
    if (vtkDataArray* array = from->GetArray(k))
    {
      to->AddArray(Stored(array, array->GetDataType()));
    }
  }
}

/// Returns the data as a file keeps it.
vtkSmartPointer<vtkPolyData> Stored(vtkPolyData* data)
{
  auto stored = vtkSmartPointer<vtkPolyData>::New();
  stored->ShallowCopy(data);
  StoreAll(data->GetCellData(), stored->GetCellData());
  StoreAll(data->GetFieldData(), stored->GetFieldData());
  return stored;
}

struct SavedBasis
{
  vtkSmartPointer<vtkPolyData> source;
  vtkSmartPointer<vtkPolyData> basis;
  std::vector<double> onBasis;  // the solution at the points of the basis
  std::vector<double> onSource; // the solution at the points of the source
};

vtkSmartPointer<vtkScreenedPoisson> SolverOn(vtkPolyData* surface, vtkPolyData* basis)
{
  auto solver = vtkSmartPointer<vtkScreenedPoisson>::New();
  solver->SetInputData(0, surface);
  if (basis)
  {
    solver->SetInputData(1, basis);
  }
  solver->SetInputArrayToProcess(0, 0, 0, Points, "f");
  solver->SetTolerance(1e-12);
  solver->SetNumberOfThreads(1);
  return solver;
}

std::vector<double> Solve(vtkPolyData* surface, vtkPolyData* basis)
{
  const auto solver = SolverOn(surface, basis);
  solver->Update();
  return PointValues(solver->GetOutput(), "Solution");
}

SavedBasis Save(int shape, bool isAware, int precision)
{
  const TriangleMesh meshes[] = { GeodesicSphere(5), TwoSheets(5, 0.02), TrefoilTube(40, 6, 0.8),
    FlatRectangle(4, 3) };
  SavedBasis saved;
  saved.source = ToPolyData(meshes[shape], precision);
  AddPointArray(saved.source, "f", 1, Wave);
  vtkNew<vtkConnectivityAwareBasis> filter;
  filter->SetInputData(saved.source);
  filter->SetDepth(3);
  filter->SetConnectivityAware(isAware);
  filter->SetNumberOfThreads(1);
  filter->Update();
  saved.basis = Stored(filter->GetOutput());
  saved.onBasis = Solve(saved.basis, nullptr);
  saved.onSource = Solve(saved.source, saved.basis);
  return saved;
}

const SavedBasis& SavedBasisOf(Choice& choice)
{
  static std::map<std::string, SavedBasis> all;
  const int shape = static_cast<int>(choice.Integer(0, 3));
  const bool isAware = !choice.OneIn(3);
  const int precision = choice.Of({ VTK_DOUBLE, VTK_FLOAT });
  const std::string name =
    std::to_string(shape) + (isAware ? " aware " : " plain ") + std::to_string(precision);
  const auto found = all.find(name);
  return found != all.end() ? found->second
                            : all.emplace(name, Save(shape, isAware, precision)).first->second;
}

/// Damages one of the tables, or removes it.
/// @param canRemove  a surface without one of the tables is an ordinary surface
void DamageTable(Choice& choice, vtkPolyData* data, bool canRemove, DamagedCase& outcome)
{
  vtkFieldData* const cells = data->GetCellData();
  vtkFieldData* const fields = data->GetFieldData();
  const Id tables = cells->GetNumberOfArrays() + Id{ 2 } * fields->GetNumberOfArrays();
  Id which = choice.Integer(0, tables - 1);
  vtkFieldData* const place = which < cells->GetNumberOfArrays() ? cells : fields;
  which -= place == cells ? 0 : cells->GetNumberOfArrays();
  vtkDataArray* const array = place->GetArray(static_cast<int>(which % place->GetNumberOfArrays()));
  const auto damaged = Stored(array, VTK_DOUBLE); // holds any value
  if (canRemove && choice.OneIn(40))
  {
    outcome.description += std::string("no ") + array->GetName();
    place->RemoveArray(damaged->GetName());
    outcome.description += ", ";
    return;
  }
  DamageArray(choice, damaged, outcome);
  outcome.description += ", ";
  place->AddArray(damaged);
}

} // namespace

void SolveOnDamagedBasis(Choice& choice, DamagedCase& outcome)
{
  const SavedBasis& saved = SavedBasisOf(choice);
  const auto damaged = vtkSmartPointer<vtkPolyData>::New();
  damaged->ShallowCopy(saved.basis);
  const bool isAlone = choice.OneIn(2);
  const Id changes = choice.OneIn(3) ? choice.Integer(2, 3) : 1;
  for (Id k = 0; k < changes; ++k)
  {
    DamageTable(choice, damaged, !isAlone, outcome);
  }
  outcome.description += isAlone ? "as the surface" : "beside the surface";
  const auto solver = isAlone ? SolverOn(damaged, nullptr) : SolverOn(saved.source, damaged);
  if (!RunOnDamaged(solver, outcome))
  {
    return;
  }
  const std::vector<double>& expected = isAlone ? saved.onBasis : saved.onSource;
  const double error = Difference(PointValues(solver->GetOutput(), "Solution"), expected);
  outcome.Require(error <= SameAnswer, "the solution differs by " + std::to_string(error));
}

} // namespace gridfem::testing
