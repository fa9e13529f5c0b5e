// The examples that come with the plugin: states, as scripts, beside the plugin's file.
#ifndef GridFEM_Examples_h
#define GridFEM_Examples_h

class QWidget;

namespace gridfem
{

/// Adds a menu to the Help menu of the window. Its entries load the examples.
/// They ask first if there is a pipeline, which they close.
void AddExamples(QWidget* window);

} // namespace gridfem

#endif
