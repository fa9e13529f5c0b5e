#include "Examples.h"

#include "vtkPVPlugin.h"
#include "vtkPVPluginTracker.h"

#include <pqApplicationCore.h>
#include <pqDeleteReaction.h>
#include <pqLoadStateReaction.h>
#include <pqPipelineSource.h>
#include <pqServerManagerModel.h>

#include <QDir>
#include <QFile>
#include <QMenu>
#include <QMessageBox>
#include <QRegularExpression>
#include <QWidget>

namespace
{

/// The folder of the examples. It does not exist if the plugin was copied without them.
QDir Folder()
{
  vtkPVPluginTracker* plugins = vtkPVPluginTracker::GetInstance();
  for (unsigned int k = 0; k < plugins->GetNumberOfPlugins(); ++k)
  {
    const QString name = plugins->GetPluginName(k);
    if (name == "GridFEM")
    {
      return QFileInfo(plugins->GetPluginFileName(k)).dir().filePath("examples");
    }
  }
  return QDir("/nonexistent");
}

/// What an example shows, from the first words of its script. Empty if the script has no such
/// words.
QString TitleOf(const QString& path)
{
  QFile file(path);
  if (!file.open(QIODevice::ReadOnly))
  {
    return {};
  }
  const QString text = QString::fromUtf8(file.readAll());
  const QRegularExpression begin("^\"\"\"A ParaView state: ([^.:]*)");
  QString title = begin.match(text).captured(1).simplified();
  return title.isEmpty() ? title : title.replace(0, 1, title[0].toUpper());
}

/// Asks before an example takes the place of the pipeline.
bool MayOpen(QWidget* window)
{
  const pqServerManagerModel* model = pqApplicationCore::instance()->getServerManagerModel();
  if (model->findItems<pqPipelineSource*>().isEmpty())
  {
    return true;
  }
  QMessageBox question(QMessageBox::Question, "Surface FEM Examples",
    "Open the example in a new session? The current pipeline is closed.",
    QMessageBox::Yes | QMessageBox::No, window);
  question.setObjectName("OpenExample");
  return question.exec() == QMessageBox::Yes;
}

void Open(const QString& path, QWidget* window)
{
  if (MayOpen(window))
  {
    pqDeleteReaction::deleteAll();
    pqLoadStateReaction::loadState(path);
  }
}

} // namespace

void gridfem::AddExamples(QWidget* window)
{
  auto* help = window->findChild<QMenu*>("menu_Help");
  if (!help)
  {
    return;
  }
  const QDir folder = Folder();
  QMenu* examples = nullptr;
  for (const QString& name : folder.entryList({ "*.py" }, QDir::Files, QDir::Name))
  {
    const QString path = folder.absoluteFilePath(name);
    const QString title = TitleOf(path);
    if (title.isEmpty())
    {
      continue;
    }
    if (!examples)
    {
      examples = new QMenu("Surface FEM Examples", help);
      examples->setObjectName("SurfaceFEMExamples");
      QAction* after = help->findChild<QAction*>("ExampleVisualizations");
      const auto place = help->actions().indexOf(after) + 1;
      help->insertMenu(after ? help->actions().value(place) : nullptr, examples);
    }
    QAction* example = examples->addAction(title, [path, window] { Open(path, window); });
    example->setObjectName(QFileInfo(name).baseName());
  }
}
