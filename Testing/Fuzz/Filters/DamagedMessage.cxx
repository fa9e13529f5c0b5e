// Cuts and changes the bytes of messages between ranks.
#include "DamagedInput.h"

#include "FilterSupport.h"

#include "Pieces/DataMessage.h"

#include "vtkStringArray.h"

#include <new>
#include <stdexcept>

namespace gridfem::testing
{
namespace
{

Bytes SurfaceAsBytes()
{
  const auto surface = ToPolyData(GeodesicSphere(1));
  AddPointArray(surface, "f", 2, Wave);
  vtkNew<vtkStringArray> texts;
  texts->SetName("texts");
  texts->InsertNextValue("one");
  texts->InsertNextValue("");
  surface->GetFieldData()->AddArray(texts);
  DataMessage message;
  message.PutSurface(surface);
  return message.Release();
}

} // namespace

void TakeDamagedMessage(Choice& choice, DamagedCase& outcome)
{
  static const Bytes whole = SurfaceAsBytes();
  Bytes bytes = whole;
  const Id size = static_cast<Id>(whole.size());
  if (choice.OneIn(3))
  {
    bytes.resize(choice.Integer(0, size));
    outcome.description += "cut to " + std::to_string(bytes.size());
  }
  else
  {
    const Id first = choice.Integer(0, size - 1);
    const Id count = std::min(choice.Of<Id>({ 1, 4, 8 }), size - first);
    const int value = static_cast<int>(choice.Integer(0, 255));
    std::fill_n(bytes.begin() + first, count, static_cast<char>(value));
    outcome.description += std::to_string(count) + " bytes from " + std::to_string(first) +
                           " are " + std::to_string(value);
  }
  const bool isWhole = bytes == whole;
  DataMessage message(std::move(bytes));
  try
  {
    const auto taken = message.TakeSurface();
    outcome.Require(!isWhole || taken->GetNumberOfPoints() == 6, "a whole message loses points");
  }
  catch (const std::runtime_error& error)
  {
    outcome.refusal = error.what();
  }
  catch (const std::bad_alloc&)
  {
    outcome.refusal = "no memory";
  }
  outcome.Require(!isWhole || outcome.refusal.empty(), "a whole message is refused");
}

} // namespace gridfem::testing
