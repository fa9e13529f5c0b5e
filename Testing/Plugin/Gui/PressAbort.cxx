// Presses the abort button of ParaView's window for a script, which waits for a filter meanwhile.
#include <QApplication>
#include <QMouseEvent>
#include <QTimer>
#include <QToolButton>
#include <QWidget>

namespace
{

/// The button, as soon as something runs that it can abort.
QToolButton* EnabledButton()
{
  for (QWidget* window : QApplication::topLevelWidgets())
  {
    auto* button = window->findChild<QToolButton*>("AbortButton");
    if (button && button->isEnabled())
    {
      return button;
    }
  }
  return nullptr;
}

/// Sends what a click of the mouse sends, which ParaView blocks for most widgets while a filter
/// runs.
void Click(QWidget* widget)
{
  const QPointF place = widget->rect().center();
  const QPointF screen = widget->mapToGlobal(place.toPoint());
  for (const auto type : { QEvent::MouseButtonPress, QEvent::MouseButtonRelease })
  {
    const auto held = type == QEvent::MouseButtonPress ? Qt::LeftButton : Qt::NoButton;
    QMouseEvent event(type, place, screen, Qt::LeftButton, held, Qt::NoModifier);
    QApplication::sendEvent(widget, &event);
  }
}

} // namespace

/// Presses the button once, at the first event that ParaView handles while it can be pressed.
extern "C" Q_DECL_EXPORT void PressAbort()
{
  auto* timer = new QTimer(qApp);
  QObject::connect(timer, &QTimer::timeout, timer,
    [timer]
    {
      if (QWidget* button = EnabledButton())
      {
        timer->stop();
        timer->deleteLater();
        Click(button);
      }
    });
  timer->start(0);
}
