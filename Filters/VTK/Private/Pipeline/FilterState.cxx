#include "Pipeline/FilterState.h"

#include "Pieces/CanDistribute.h"
#include "Pipeline/WholeSurface.h"

#include "Base/Errors.h"
#include "Solvers/Requirements.h"

namespace gridfem
{

FilterState::FilterState(vtkAlgorithm* filter)
  : bridge(filter), filter_(filter),
    whole_(std::make_unique<WholeSurface>(stages, filter, options)), used_(whole_.get())
{
}

FilterState::~FilterState() = default;

InputSurface& FilterState::Read(vtkPolyData* input, vtkPolyData* basisData)
{
  used_->SetInput(input, basisData);
  return *used_;
}

void FilterState::RunTogether(const std::function<void()>& body)
{
  if (!piece_)
  {
    piece_ = MakePieceSurface(stages, filter_, options);
  }
  used_ = piece_.get();
  used_->Run(bridge.GetProgress(),
    [&](const Progress& ofAll)
    {
      progressOfAll_ = ofAll;
      body();
    });
}

bool FilterState::NoteRange(const std::string& property, double value, double least, double most)
{
  const std::string message = RefusalOf(property, value, least, most);
  const auto noted = refusals_.find(property);
  const bool isNew = message != (noted == refusals_.end() ? std::string() : noted->second);
  if (isNew)
  {
    refusals_[property] = message;
  }
  return isNew;
}

void FilterState::RequireRanges() const
{
  for (const auto& [property, message] : refusals_)
  {
    if (!message.empty())
    {
      throw InvalidInput(message);
    }
  }
}

void FilterState::Free()
{
  used_->Free();
  stages.Forget();
}

} // namespace gridfem
