#include "Window.h"

#include "Examples.h"
#include "FirstApply.h"
#include "FirstChoices.h"

#include "vtkPVXMLElement.h"
#include "vtkSMProxy.h"
#include "vtkSMProxyManager.h"
#include "vtkSMSessionProxyManager.h"
#include "vtkSMSourceProxy.h"

#include <pqObjectBuilder.h>
#include <pqPVApplicationCore.h>
#include <pqPipelineSource.h>
#include <pqProxyGroupMenuManager.h>

#include <QAction>
#include <QApplication>
#include <QMenu>
#include <QStringList>
#include <QTimer>
#include <QVariant>
#include <QWidget>

namespace
{

/// An attribute of the hint ShowInMenu of the filter behind a menu entry. May be empty.
QString Hint(QAction* entry, const char* attribute)
{
  const QStringList names = entry->data().toStringList(); // of the filter's group and the filter
  vtkSMSessionProxyManager* proxies =
    vtkSMProxyManager::GetProxyManager()->GetActiveSessionProxyManager();
  vtkSMProxy* filter = proxies && names.size() == 2
                         ? proxies->GetPrototypeProxy(names[0].toUtf8(), names[1].toUtf8())
                         : nullptr;
  vtkPVXMLElement* hints = filter ? filter->GetHints() : nullptr;
  vtkPVXMLElement* shown = hints ? hints->FindNestedElementByName("ShowInMenu") : nullptr;
  return shown ? shown->GetAttributeOrEmpty(attribute) : "";
}

/// Puts the filters of the category into sections with titles.
void Arrange(pqProxyGroupMenuManager* filters)
{
  auto* menu = filters->menu()->findChild<QMenu*>("Surface FEM", Qt::FindDirectChildrenOnly);
  if (!menu)
  {
    return;
  }
  const QList<QAction*> entries = menu->actions();
  menu->clear();
  for (const char* section : { "Solve", "Analyze", "Shape", "Basis", "" })
  {
    menu->addSection(section);
    for (QAction* entry : entries)
    {
      if (Hint(entry, "section") == section)
      {
        menu->addAction(entry);
      }
    }
  }
}

/// Fills the list of the search with the jobs of the filters, which can be done if the filters can.
void ListJobs(pqProxyGroupMenuManager* filters, QWidget* list)
{
  qDeleteAll(list->actions());
  for (QAction* entry : filters->actions())
  {
    const QString jobs = Hint(entry, "jobs");
    if (!jobs.isEmpty())
    {
      auto* found = new QAction(entry->text() + ": " + jobs, list);
      found->setObjectName(entry->objectName() + "Jobs");
      found->setEnabled(entry->isEnabled());
      found->setData(entry->data());
      QObject::connect(found, &QAction::triggered, entry, &QAction::trigger);
      list->addAction(found);
    }
  }
}

/// Adds the jobs to ParaView's search. Its own list of filters is made first, so that it is known
/// which of them can be applied.
void SearchJobs(pqProxyGroupMenuManager* filters)
{
  auto* list = new QWidget;
  QObject::connect(filters, &QObject::destroyed, list, &QObject::deleteLater);
  pqPVApplicationCore* core = pqPVApplicationCore::instance();
  core->registerForQuicklaunch(list);
  QObject::connect(core, &pqPVApplicationCore::aboutToShowQuickLaunch, filters,
    [filters, list] { ListJobs(filters, list); });
}

/// Meets the filters that the user makes. ParaView does not report filters of scripts and states
/// here.
void MeetFilters(pqPVApplicationCore* core)
{
  QObject::connect(core->getObjectBuilder(), &pqObjectBuilder::filterCreated, core,
    [](pqPipelineSource* made)
    {
      auto* filter = made ? vtkSMSourceProxy::SafeDownCast(made->getProxy()) : nullptr;
      if (filter)
      {
        gridfem::MakeFirstChoices(filter);
        gridfem::AwaitFirstApply(filter);
      }
    });
}

/// Adds to the window that has the menu of filters. Returns false if there is none yet.
bool AddToWindow()
{
  for (QWidget* window : QApplication::topLevelWidgets())
  {
    auto* menu = window->findChild<QMenu*>("menuFilters");
    auto* filters = menu ? menu->findChild<pqProxyGroupMenuManager*>() : nullptr;
    if (filters)
    {
      QObject::connect(
        filters, &pqProxyGroupMenuManager::menuPopulated, filters, [filters] { Arrange(filters); });
      Arrange(filters);
      SearchJobs(filters);
      gridfem::AddExamples(window);
      return true;
    }
  }
  return false;
}

} // namespace

void gridfem::RegisterWindow()
{
  if (!qApp)
  {
    return;
  }
  // The plugin may be loaded before ParaView has made its core and its window.
  QTimer::singleShot(0, qApp,
    []
    {
      pqPVApplicationCore* core = pqPVApplicationCore::instance();
      if (core)
      {
        MeetFilters(core);
      }
      if (core && !AddToWindow())
      {
        QObject::connect(
          core, &pqPVApplicationCore::clientEnvironmentDone, core, [] { AddToWindow(); });
      }
    });
}
