// Makes every filter, ready to run on a surface with the arrays it needs.
#ifndef GridFEM_Testing_AllFilters_h
#define GridFEM_Testing_AllFilters_h

#include "FilterSupport.h"

#include "vtkClipToOctree.h"
#include "vtkConnectivityAwareBasis.h"
#include "vtkFarthestPoints.h"
#include "vtkFunctionalMap.h"
#include "vtkGaussianField.h"
#include "vtkGeodesicDistance.h"
#include "vtkGeodesicPaths.h"
#include "vtkHarmonicInterpolation.h"
#include "vtkHeatDiffusion.h"
#include "vtkLaplaceSpectrum.h"
#include "vtkMeanCurvatureFlow.h"
#include "vtkParameterization.h"
#include "vtkPrincipalCurvatures.h"
#include "vtkScreenedPoisson.h"
#include "vtkSpectralSignatures.h"
#include "vtkStitchColors.h"
#include "vtkSurfaceDetail.h"
#include "vtkSurfaceDynamics.h"
#include "vtkSurfaceGradient.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ostream>

namespace gridfem::testing
{

template<class Filter>
vtkSmartPointer<vtkSurfaceFEMAlgorithm> Make()
{
  return vtkSmartPointer<Filter>::New();
}

template<class Filter>
vtkSmartPointer<vtkSurfaceFEMAlgorithm> MakeWithArray(const char* name)
{
  auto filter = Make<Filter>();
  filter->SetInputArrayToProcess(0, 0, 0, Points, name);
  return filter;
}

inline vtkSmartPointer<vtkSurfaceFEMAlgorithm> MakeInterpolation()
{
  return MakeWithArray<vtkHarmonicInterpolation>("few");
}

inline vtkSmartPointer<vtkSurfaceFEMAlgorithm> MakeGradient()
{
  return MakeWithArray<vtkSurfaceGradient>("f");
}

inline vtkSmartPointer<vtkSurfaceFEMAlgorithm> MakeStitching()
{
  auto filter = MakeWithArray<vtkStitchColors>("f");
  filter->SetInputArrayToProcess(1, 0, 0, Points, "label");
  return filter;
}

inline vtkSmartPointer<vtkSurfaceFEMAlgorithm> MakeHats()
{
  auto filter = Make<vtkScreenedPoisson>();
  filter->SetFunctionSpace(vtkSurfaceFEMAlgorithm::HatFunctions);
  return filter;
}

inline vtkSmartPointer<vtkSurfaceFEMAlgorithm> MakeMap()
{
  auto filter = vtkSmartPointer<vtkFunctionalMap>::New();
  filter->SetNumberOfModes(12);
  filter->SetInputDataObject(
    2, ToPolyData(Mapped(GeodesicSphere(8),
         [](const Vec3& p) { return Vec3(1.5 * p[0] + 0.3 * p[1] * p[1], p[1], 0.7 * p[2]); })));
  return filter;
}

inline vtkSmartPointer<vtkSurfaceFEMAlgorithm> MakeDynamics()
{
  auto filter = vtkSmartPointer<vtkSurfaceDynamics>::New();
  filter->SetNumberOfSteps(1);
  return filter;
}

/// Gives Functional Map a reference that the surface matches, but differs from.
inline void SetLikeReference(vtkAlgorithm* filter, const TriangleMesh& surface)
{
  if (auto* map = vtkFunctionalMap::SafeDownCast(filter))
  {
    const auto other = [](const Vec3& p)
    { return Vec3(p + 0.05 * Vec3(p[1] * p[2], std::sin(2.0 * p[0]), p[0] * p[1])); };
    map->SetInputDataObject(2, ToPolyData(Mapped(surface, other)));
  }
}

/// Whether an array is one of several that describe the same place, as on an edge.
inline bool IsOneOfSeveral(const std::string& array)
{
  return array == "ReferenceCorners" || array == "ReferenceWeights" || array == "MatchingColors";
}

struct FilterCase
{
  const char* name;
  vtkSmartPointer<vtkSurfaceFEMAlgorithm> (*make)();
};

inline void PrintTo(const FilterCase& filter, std::ostream* stream)
{
  *stream << filter.name;
}

/// Adds the point arrays that the filters use. "few" has values at a thousandth of the points, and
/// at ten of a small surface.
inline void AddArraysOfAllFilters(vtkPolyData* surface)
{
  AddPointArray(surface, "f", 1, Wave);
  AddPointArray(surface, "label", 1, [](const Vec3& p, int) { return p[0] > 0.0 ? 1.0 : 0.0; });
  auto* few = AddPointArray(surface, "few", 1, Wave);
  const vtkIdType step = std::clamp<vtkIdType>(surface->GetNumberOfPoints() / 10, 1, 1000);
  for (vtkIdType point = 0; point < surface->GetNumberOfPoints(); ++point)
  {
    few->SetValue(point, point % step == 0 ? few->GetValue(point) : std::nan(""));
  }
}

/// The argument of INSTANTIATE_TEST_SUITE_P.
inline auto AllFilters()
{
  return ::testing::Values(FilterCase{ "ClipToOctree", &Make<vtkClipToOctree> },
    FilterCase{ "ConnectivityAwareBasis", &Make<vtkConnectivityAwareBasis> },
    FilterCase{ "FarthestPoints", &Make<vtkFarthestPoints> },
    FilterCase{ "FunctionalMap", &MakeMap }, FilterCase{ "GaussianField", &Make<vtkGaussianField> },
    FilterCase{ "GeodesicDistance", &Make<vtkGeodesicDistance> },
    FilterCase{ "GeodesicPaths", &Make<vtkGeodesicPaths> },
    FilterCase{ "HarmonicInterpolation", &MakeInterpolation },
    FilterCase{ "HeatDiffusion", &Make<vtkHeatDiffusion> },
    FilterCase{ "LaplaceSpectrum", &Make<vtkLaplaceSpectrum> },
    FilterCase{ "MeanCurvatureFlow", &Make<vtkMeanCurvatureFlow> },
    FilterCase{ "Parameterization", &Make<vtkParameterization> },
    FilterCase{ "PrincipalCurvatures", &Make<vtkPrincipalCurvatures> },
    FilterCase{ "ScreenedPoisson", &Make<vtkScreenedPoisson> },
    FilterCase{ "ScreenedPoissonOnHats", &MakeHats },
    FilterCase{ "SpectralSignatures", &Make<vtkSpectralSignatures> },
    FilterCase{ "StitchColors", &MakeStitching },
    FilterCase{ "SurfaceDetail", &Make<vtkSurfaceDetail> },
    FilterCase{ "SurfaceDynamics", &MakeDynamics }, FilterCase{ "SurfaceGradient", &MakeGradient });
}

inline std::string NameOf(const ::testing::TestParamInfo<FilterCase>& filter)
{
  return filter.param.name;
}

} // namespace gridfem::testing

#endif
