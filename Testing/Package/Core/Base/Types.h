// A header of this project in a folder that GridFEM has as well.
#ifndef CoreConsumer_Types_h
#define CoreConsumer_Types_h

inline constexpr int NumberOfRuns = 100;

#endif
