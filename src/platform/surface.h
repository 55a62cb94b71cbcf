/// The kinds of surface behind platform.h. Private to platform/.
#ifndef PLATFORM_SURFACE_H
#define PLATFORM_SURFACE_H

#include "base/error.h"
#include "platform/events.h"
#include "platform/platform.h"
#include <dlfcn.h>
#include <string.h>

struct window;
struct offscreen;

/// Properties of a surface's framebuffer.
struct surface_size {
    int width, height; ///< device pixels
    float scale;       ///< device pixels a logical pixel
};

/// At most one of the two exists.
struct platform {
    struct window *window;
    struct offscreen *offscreen;
    struct surface_size size; ///< where there is no window
    struct event_queue queue;
    bool keeps;
    char *clipboard; ///< in place of the system's where there is no window
};

/// Events go to `queue`, which must outlive the window.
struct window *window_create(int width, int height, const char *title, int vsync, struct event_queue *queue,
                             struct error *error);
void window_destroy(struct window *window);
/// The window's id on the X server; 0 where there is none.
unsigned long window_number(const struct window *window);
/// Asks the display where the window is: an error where it does not exist any more.
void window_ask_place(const struct window *window);
/// Has the process end as platform_on_lost() says when another program has destroyed the window: errors of the display show that
/// or, while nothing is drawn (`idle`), asking for the window.
void window_check(const struct window *window, bool idle);

struct offscreen *offscreen_create(int width, int height, struct error *error);
void offscreen_destroy(struct offscreen *offscreen);

/// In builds with the address sanitizer: keeps the loaded graphics driver in memory until the process ends.
void keep_driver_loaded(void);

/// Puts the address of a symbol of a library that GLFW may have loaded, which the program itself need not depend on, into a pointer; false
/// if nothing of that name is loaded.
static inline bool symbol_find(const char *name, void *pointer)
{
    void *symbol = dlsym(RTLD_DEFAULT, name);
    if (symbol) memcpy(pointer, &symbol, sizeof symbol);
    return symbol != NULL;
}

// The graphics driver's messages (--gl-debug).

/// Whether platform_debug_gl() was called: contexts are then made for debugging.
bool gl_debug_wanted(void);

/// If wanted, listens to the current context. false if its driver has no debug output.
bool gl_debug_start(struct error *error);

#endif
