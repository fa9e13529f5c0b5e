// Gives ParaView's window the pages of the plugin's help. ParaView's own build rules make pages of
// the panels only, and none with Qt 6 in ParaView 5.12 and 5.13 (ParaView issue 19742). The list of
// plugins shows the pages as a plugin of their own.
#ifndef GridFEM_HelpPages_h
#define GridFEM_HelpPages_h

namespace gridfem
{

/// Hands the pages over. The plugin calls it when it is loaded.
void RegisterHelpPages();

} // namespace gridfem

#endif
