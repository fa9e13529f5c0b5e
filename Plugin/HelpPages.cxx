#include "HelpPages.h"

#include "GridFEMPages.h"

#include "vtkPVPlugin.h"

#include <memory>
#include <string>
#include <vector>

namespace
{

class HelpPages : public vtkPVPlugin
{
public:
  const char* GetPluginName() override { return "GridFEM Pages"; }
  const char* GetPluginVersionString() override { return "1.0"; }
  const char* GetDescription() override { return "The pages of the help of GridFEM."; }
  const char* GetRequiredPlugins() override { return ""; }
  const char* GetEULA() override { return nullptr; }
  bool GetRequiredOnServer() override { return false; }
  bool GetRequiredOnClient() override { return false; }

  void GetBinaryResources(std::vector<std::string>& resources) override
  {
    const std::unique_ptr<char[]> text(GridFEM_pages());
    resources.emplace_back(text.get());
  }
};

} // namespace

void gridfem::RegisterHelpPages()
{
  static HelpPages pages;
  vtkPVPlugin::ImportPlugin(&pages);
}
