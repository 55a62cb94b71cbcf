/// A canvas in a browser: its WebGL 2 context, and the events that page.js sends. And the process there, which has no signals and never waits.
#include "platform/platform.h"
#include "base/need.h"
#include "base/progress.h"
#include "platform/events.h"
#include "platform/process.h"
#include <dlfcn.h>
#include <emscripten.h>
#include <emscripten/html5.h>
#include <errno.h>
#include <math.h>
#include <spawn.h>
#include <stdlib.h>
#include <string.h>
#include <sys/types.h>
#include <sys/xattr.h>

struct window {
    EMSCRIPTEN_WEBGL_CONTEXT_HANDLE context;
    struct clicks clicks;
    enum mouse_cursor cursor;
    bool is_shown;         ///< since the first swap
    bool (*frame)(void *); ///< platform_run()'s
    void *user;
};

/// The one with a canvas.
static struct platform *shown;

// What the page does; `page` is page.js's object.
EM_JS(int, page_width, (void), { return Module.page.size().width; });
EM_JS(int, page_height, (void), { return Module.page.size().height; });
EM_JS(double, page_scale, (void), { return Module.page.size().scale; });
EM_JS(void, page_title, (const char *title), { Module.page.title(UTF8ToString(title)); });
EM_JS(void, page_describe, (const char *text), { Module.page.describe(UTF8ToString(text)); });
EM_JS(void, page_cursor, (const char *name), { Module.page.cursor(UTF8ToString(name)); });
EM_JS(void, page_copy, (const char *text), { Module.page.copy(UTF8ToString(text)); });
EM_JS(void, page_shown, (void), { Module.page.shown(); });
EM_JS(void, page_fullscreen, (void), { Module.page.fullscreen(); });
EM_JS(void, page_share, (const char *scene), { Module.page.share(UTF8ToString(scene)); });
EM_JS(void, page_choose, (void), { Module.page.choose(); });
EM_JS(bool, page_fetches, (const char *path), { return Module.page.fetches(UTF8ToString(path)); });
EM_JS(bool, page_waits, (void), { return Module.page.waits(); });
EM_JS(void, page_resize, (void), { Module.page.resize(); });
EM_JS(void, page_stopped, (void), { Module.page.stopped(); });

struct platform *platform_window(int width, int height, const char *title, int vsync, struct error *error)
{
    (void)width;
    (void)height;
    (void)vsync;
    EmscriptenWebGLContextAttributes wishes;
    emscripten_webgl_init_context_attributes(&wishes);
    wishes.alpha = wishes.antialias = wishes.stencil = false;
    wishes.preserveDrawingBuffer = true; // so that only what changed is drawn
    wishes.enableExtensionsByDefault = false;
    wishes.majorVersion = 2;
    EMSCRIPTEN_WEBGL_CONTEXT_HANDLE context = emscripten_webgl_create_context("#canvas", &wishes);
    if (context <= 0 || emscripten_webgl_make_context_current(context) != EMSCRIPTEN_RESULT_SUCCESS) {
        fail(error, ERROR_ENVIRONMENT, "this browser has no WebGL 2");
        return NULL;
    }
    shown = platform_blind(page_width(), page_height(), (float)page_scale());
    shown->window = need_zeroed(1, sizeof *shown->window);
    shown->window->context = context;
    shown->keeps = true;
    platform_title(shown, title);
    return shown;
}

struct platform *platform_offscreen(int width, int height, float scale, struct error *error)
{
    (void)width;
    (void)height;
    (void)scale;
    fail(error, ERROR_ENVIRONMENT,
         shown
             ? "a browser draws only in its window: expected --no-draw"
             : "this browser has no WebGL 2, or it is turned off. Turn on hardware acceleration in its settings, or "
               "open this page in another browser");
    return NULL;
}

void platform_destroy(struct platform *platform)
{
    if (!platform) return;
    if (platform->window) emscripten_webgl_destroy_context(platform->window->context);
    if (platform == shown) shown = NULL;
    free(platform->window);
    free(platform->clipboard);
    free(platform);
}

static EM_BOOL on_frame(double time, void *user)
{
    (void)time;
    const struct window *window = user;
    if (page_waits() || window->frame(window->user)) return EM_TRUE;
    page_stopped();
    return EM_FALSE;
}

void platform_run(struct platform *platform, bool (*frame)(void *), void *user)
{
    if (platform->window) {
        platform->window->frame = frame;
        platform->window->user = user;
        emscripten_request_animation_frame_loop(on_frame, platform->window);
        emscripten_unwind_to_js_event_loop(); // leaves the stack as it is: `user` is there
    }
    while (frame(user)) continue;
}

const struct event *platform_events(struct platform *platform, double seconds, int *count)
{
    (void)seconds;                       // the browser waits
    if (platform->window) page_resize(); // just before a frame, since it clears the canvas
    return event_queue_take(&platform->queue, count);
}

void platform_swap(struct platform *platform)
{
    if (!platform->window->is_shown) page_shown();
    platform->window->is_shown = true;
}

double platform_refresh_rate(struct platform *platform)
{
    (void)platform;
    return 0;
}

void platform_title(struct platform *platform, const char *title)
{
    if (platform->window) page_title(title);
}

void platform_describe(struct platform *platform, const char *text)
{
    if (platform->window) page_describe(text);
}

void platform_toggle_fullscreen(struct platform *platform)
{
    if (platform->window) page_fullscreen();
}

const char *platform_clipboard(struct platform *platform) { return platform->clipboard; }

void platform_set_clipboard(struct platform *platform, const char *text)
{
    free(platform->clipboard);
    platform->clipboard = need_text(text);
    if (platform->window) page_copy(text);
}

bool platform_in_page(void) { return true; }

void platform_share(struct platform *platform, const char *scene)
{
    if (platform->window) page_share(scene);
}

void platform_choose_file(struct platform *platform)
{
    if (platform->window) page_choose();
}

bool platform_fetches(const char *path) { return shown && page_fetches(path); }

void platform_cursor(struct platform *platform, enum mouse_cursor cursor)
{
    static const char *const names[] = {
        [CURSOR_ARROW] = "default",      [CURSOR_HAND] = "pointer", [CURSOR_HORIZONTAL] = "ew-resize",
        [CURSOR_VERTICAL] = "ns-resize", [CURSOR_MOVE] = "move",    [CURSOR_TEXT] = "text"};
    if (!platform->window || cursor == platform->window->cursor) return;
    platform->window->cursor = cursor;
    page_cursor(names[cursor]);
}

static struct platform_calls calls;

void platform_listen(struct platform_calls listener) { calls = listener; }

/// A hidden page has no frames, and may never be shown again.
EMSCRIPTEN_KEEPALIVE void web_hidden(void)
{
    if (calls.lost) calls.lost(calls.user);
}

// A browser says itself what is wrong in WebGL.

void platform_debug_gl(void) {}
int platform_gl_complaints(void) { return 0; }

// Events, called by input.js. Positions are logical pixels from the canvas's top left; the mods of a finger have FINGER, too. A text is the
// callee's to free: it comes by malloc(), because a user's text may be larger than the stack.

static const unsigned FINGER = 16;

static void push(struct event event)
{
    event.time = clock_now();
    if (shown) event_queue_push(&shown->queue, &event);
}

EMSCRIPTEN_KEEPALIVE void web_pointer(float x, float y, unsigned mods)
{
    push((struct event){.kind = EVENT_POINTER, .x = x, .y = y, .mods = mods & ~FINGER, .finger = mods & FINGER});
}

/// `time`: milliseconds, when the browser saw it; a slow frame may lie between.
EMSCRIPTEN_KEEPALIVE void web_button(int button, int action, unsigned mods, double time, float x, float y)
{
    struct event event = {.kind = EVENT_BUTTON,
                          .button = (enum event_button)button,
                          .action = (enum event_action)action,
                          .mods = mods & ~FINGER,
                          .finger = mods & FINGER,
                          .x = x,
                          .y = y,
                          .clicks = 1};
    if (shown && event.action == ACTION_PRESS)
        event.clicks = clicks_count(&shown->window->clicks, &event, 1e-3 * time);
    push(event);
}

EMSCRIPTEN_KEEPALIVE void web_wheel(float dx, float dy, unsigned mods, float x, float y)
{
    push((struct event){.kind = EVENT_WHEEL, .dx = dx, .dy = dy, .mods = mods, .x = x, .y = y});
}

/// `name` as replays have it.
EMSCRIPTEN_KEEPALIVE void web_key(char *name, int action, unsigned mods)
{
    const int key = key_from_name(name);
    free(name);
    if (key != KEY_NONE)
        push((struct event){.kind = EVENT_KEY, .key = key, .action = (enum event_action)action, .mods = mods});
}

/// Whether a key is the app's, not the browser's.
EMSCRIPTEN_KEEPALIVE bool web_keeps(char *name, unsigned mods)
{
    const int key = key_from_name(name);
    free(name);
    return calls.keeps_key && key != KEY_NONE && calls.keeps_key(calls.user, key, mods);
}

EMSCRIPTEN_KEEPALIVE void web_text(unsigned codepoint)
{
    push((struct event){.kind = EVENT_TEXT, .codepoint = codepoint});
}

/// Device pixels.
EMSCRIPTEN_KEEPALIVE void web_size(int width, int height, float scale)
{
    if (!shown) return;
    shown->width = width;
    shown->height = height;
    shown->scale = scale;
    push((struct event){.kind = EVENT_SIZE, .x = (float)width / scale, .y = (float)height / scale, .scale = scale});
}

EMSCRIPTEN_KEEPALIVE void web_drop(char *path)
{
    if (shown) event_queue_push_drop(&shown->queue, path, clock_now());
    free(path);
}

/// The text that the next paste inserts.
EMSCRIPTEN_KEEPALIVE void web_clipboard(char *text)
{
    free(shown ? shown->clipboard : text);
    if (shown) shown->clipboard = text;
}

// --- the process

/// The page begins at 0.
double process_age(void) { return 1e-3 * emscripten_get_now(); }
double process_peak_memory(void) { return NAN; }
void process_sleep(double seconds) { (void)seconds; }
void process_catch_end(void) {}
bool process_was_told_to_end(void) { return false; }

bool turns_open(bool first)
{
    (void)first;
    return false;
}
void turns_take(void) {}
void turns_give(void) {}

// Not in this C library, or of no use in a browser.

int posix_spawnp(pid_t *process, const char *file, const posix_spawn_file_actions_t *actions,
                 const posix_spawnattr_t *attributes, char *const arguments[], char *const environment[])
{
    (void)process, (void)file, (void)actions, (void)attributes, (void)arguments, (void)environment;
    return ENOSYS;
}

ssize_t getxattr(const char *path, const char *name, void *value, size_t size)
{
    (void)path, (void)name, (void)value, (void)size;
    return -1;
}

int fsetxattr(int file, const char *name, const void *value, size_t size, int flags)
{
    (void)file, (void)name, (void)value, (void)size, (void)flags;
    return -1;
}

int fremovexattr(int file, const char *name)
{
    (void)file, (void)name;
    return -1;
}

void *dlopen(const char *file, int mode)
{
    (void)file, (void)mode;
    return NULL;
}

void *dlsym(void *library, const char *name)
{
    (void)library, (void)name;
    return NULL;
}

int dlclose(void *library)
{
    (void)library;
    return 0;
}

long allocation_count(void) { return 0; }
