/// Directions on the command line.
#ifndef COMMANDS_DIRECTION_H
#define COMMANDS_DIRECTION_H

#include <stdbool.h>

/// "up", "side", "front" or "x,y,z" as a vector of length 1 (y is up, z is to the front); false where it is none of these.
bool direction_read(const char *text, double direction[3]);

#endif
