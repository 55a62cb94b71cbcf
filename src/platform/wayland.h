/// What GLFW does not report about a Wayland display. Private to platform/.
#ifndef PLATFORM_WAYLAND_H
#define PLATFORM_WAYLAND_H

#include <stdbool.h>

/// Whether the window's Wayland connection has ended.
bool wayland_is_lost(void);

/// Whether cursors may be made: GLFW 3.3 crashes on a Wayland display without a pointer. Asks the display.
bool wayland_allows_cursors(void);

#endif
