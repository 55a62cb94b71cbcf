/// Two programs draw their frames in turn, so that whatever else the machine does affects both alike.
#ifndef PLATFORM_TURNS_H
#define PLATFORM_TURNS_H

#include <stdbool.h>

/// The other program hands over by a byte on descriptor 3, and gets one on descriptor 4; whoever starts the two connects the
/// pipes. `first`: this one begins. false if the descriptors are not open.
bool turns_open(bool first);

/// Waits for this program's turn; returns at once if the other one has ended.
void turns_take(void);

void turns_give(void);

#endif
