// What the plugin adds to ParaView's window: entries of menus and of the search, and choices for
// filters that the user makes. Without a window there is nothing to add. The XML of a filter has
// the hint:
//
//   <Hints>
//     <ShowInMenu category="Surface FEM" section="Solve" jobs="smooth, denoise" />
//   </Hints>
//
//   section  the part of the category's menu that has the filter
//   jobs     other words that find the filter in ParaView's search (Ctrl+Space)
#ifndef GridFEM_Window_h
#define GridFEM_Window_h

namespace gridfem
{

/// Adds to the window as soon as there is one. The plugin calls it when it is loaded.
void RegisterWindow();

} // namespace gridfem

#endif
