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

/// A surface's framebuffer.
struct surface_size {
    int width, height; ///< device pixels
    float scale;       ///< device pixels per logical pixel
};

/// At most one of the two exists.
struct platform {
    struct window *window;
    struct offscreen *offscreen;
    struct surface_size size; ///< without a window
    struct event_queue queue;
    bool keeps;
    char *clipboard; ///< without a window
};

/// Events go to `queue`, which must outlive the window.
struct window *window_create(int width, int height, const char *title, int vsync, struct event_queue *queue,
                             struct error *error);
void window_destroy(struct window *window);
/// The window's X id, or 0.
unsigned long window_number(const struct window *window);
/// Queries the window's position: an error if the window is gone.
void window_ask_place(const struct window *window);
/// Ends the process as described at platform_on_lost() if another program destroyed the window. X errors reveal that; while `idle`, nothing
/// is drawn, so this queries the window.
void window_check(const struct window *window, bool idle);

struct offscreen *offscreen_create(int width, int height, struct error *error);
void offscreen_destroy(struct offscreen *offscreen);

/// With the address sanitizer: keeps the graphics driver in memory until the process ends.
void keep_driver_loaded(void);

/// Stores the address of a symbol from a library GLFW may have loaded, without linking to it. false if there is none.
static inline bool symbol_find(const char *name, void *pointer)
{
    void *symbol = dlsym(RTLD_DEFAULT, name);
    if (symbol) memcpy(pointer, &symbol, sizeof symbol);
    return symbol != NULL;
}

/// Letters and punctuation map by their label, digits, arrows and the rest by position; so do letters if the layout has no Latin ones.
/// KEY_NONE for other keys.
int key_translate(int glfw_key, int scancode);

unsigned mods_translate(int glfw_mods);

// The graphics driver's messages (--gl-debug).

/// Whether platform_debug_gl() was called, so that contexts need debug output.
bool gl_debug_wanted(void);

/// Listens to the current context if wanted. false if its driver has no debug output.
bool gl_debug_start(struct error *error);

#endif
