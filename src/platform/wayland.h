/// What GLFW does not report about a Wayland display, and functions of libraries that it may have loaded: looking them up saves the program
/// dependencies of its own. Private to platform/.
#ifndef PLATFORM_WAYLAND_H
#define PLATFORM_WAYLAND_H

#include <dlfcn.h>
#include <stdbool.h>
#include <string.h>

/// Whether the window's Wayland connection has ended.
bool wayland_is_lost(void);

/// Whether cursors may be made: GLFW 3.3 crashes on a Wayland display without a pointer. Asks the display.
bool wayland_allows_cursors(void);

/// Puts the symbol's address into a pointer; false if nothing of that name is loaded.
static inline bool symbol_find(const char *name, void *pointer)
{
    void *symbol = dlsym(RTLD_DEFAULT, name);
    if (symbol) memcpy(pointer, &symbol, sizeof symbol);
    return symbol != NULL;
}

#endif
