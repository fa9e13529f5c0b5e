#include "Output/MovedPoints.h"

#include "Input/ModeReader.h"
#include "Output/ClippedArrays.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

namespace gridfem
{
namespace
{

void RemoveAttribute(vtkDataSetAttributes* attributes, int attribute)
{
  int index[vtkDataSetAttributes::NUM_ATTRIBUTES];
  attributes->GetAttributeIndices(index);
  if (index[attribute] >= 0)
  {
    attributes->RemoveArray(index[attribute]);
  }
}

} // namespace

void MovePoints(vtkPolyData* data, vtkDataArray* coordinates)
{
  vtkNew<vtkPoints> points;
  points->SetData(coordinates);
  data->SetPoints(points);
  for (vtkDataSetAttributes* attributes :
    { static_cast<vtkDataSetAttributes*>(data->GetPointData()),
      static_cast<vtkDataSetAttributes*>(data->GetCellData()) })
  {
    RemoveAttribute(attributes, vtkDataSetAttributes::NORMALS);
    RemoveAttribute(attributes, vtkDataSetAttributes::TANGENTS);
  }
  if (CarriesClip(data)) // else arrays of these names are the user's own
  {
    RemoveClipArrays(data);
  }
  RemoveModes(data);
}

} // namespace gridfem
