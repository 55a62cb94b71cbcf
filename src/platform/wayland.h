/// What GLFW does not tell of a Wayland display. Private to platform/.
#ifndef PLATFORM_WAYLAND_H
#define PLATFORM_WAYLAND_H

#include <stdbool.h>

/// Whether the window's display is a Wayland one to which the connection has ended.
bool wayland_is_lost(void);

/// Whether cursors may be made: GLFW 3.3 crashes on a Wayland display none of whose seats has a pointer. Asks the display.
bool wayland_allows_cursors(void);

#endif
