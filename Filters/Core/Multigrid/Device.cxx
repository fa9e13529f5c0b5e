#include "Multigrid/Device.h"

#include <cstdlib>
#include <mutex>

#if defined(__unix__) || defined(__APPLE__)
#include <dlfcn.h>
#define GRIDFEM_HAS_DLOPEN
#endif

// The build gives the name of a file without quotes, which not every shell passes on.
#define GRIDFEM_QUOTED(text) #text
#define GRIDFEM_QUOTE(text) GRIDFEM_QUOTED(text)

namespace gridfem
{
namespace
{

/// The device of this process.
struct Found
{
  std::mutex mutex;
  bool isSearched = false;
  std::shared_ptr<const Device> device;
  std::string whyNot;
};

Found& TheDevice()
{
  static Found found;
  return found;
}

} // namespace

std::shared_ptr<const Device> OpenDevice(
  [[maybe_unused]] const std::string& path, std::string& whyNot)
{
#ifdef GRIDFEM_HAS_DLOPEN
  void* const library = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!library)
  {
    const std::string error = dlerror();
    whyNot = error.find("No such file") != std::string::npos
               ? "this installation has no GPU library"
               : "the GPU library cannot be loaded (" + error + ")";
    return nullptr;
  }
  const auto open = reinterpret_cast<OpenDeviceFunction>(dlsym(library, OpenDeviceName));
  const auto device = std::make_shared<Device>();
  if (open && open(*device, whyNot))
  {
    return device;
  }
  if (!open)
  {
    whyNot = path + " is not a GPU library of this version";
  }
#else
  whyNot = "GPUs are not used on this system";
#endif
  return nullptr;
}

std::shared_ptr<const Device> FindDevice(std::string& whyNot)
{
  Found& found = TheDevice();
  const std::lock_guard<std::mutex> lock(found.mutex);
  if (!found.isSearched)
  {
    const char* const given = std::getenv("GRIDFEM_DEVICE_LIBRARY");
    found.device = OpenDevice(given ? given : GRIDFEM_QUOTE(GRIDFEM_CUDA_LIBRARY), found.whyNot);
    found.isSearched = true;
  }
  whyNot = found.whyNot;
  return found.device;
}

void UseDevice(std::shared_ptr<const Device> device)
{
  Found& found = TheDevice();
  const std::lock_guard<std::mutex> lock(found.mutex);
  found.device = std::move(device);
  found.whyNot = found.device ? "" : "no device is in use";
  found.isSearched = true;
}

} // namespace gridfem
