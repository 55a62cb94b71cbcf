/// Creates surfaces, and works around graphics drivers.
#include "platform/platform.h"
#include "base/need.h"
#include "platform/surface.h"
#include <dlfcn.h>
#include <link.h>
#include <malloc.h>
#include <stdlib.h>
#include <string.h>

/// Software drivers allocate and free triangle memory every frame. Makes the C library keep it, which saves a tenth of the CPU time.
static void keep_freed_memory(void)
{
#ifdef __GLIBC__
    mallopt(M_MMAP_THRESHOLD, 32 << 20); // the largest allowed
    mallopt(M_TRIM_THRESHOLD, 64 << 20);
#endif
}

#ifdef __SANITIZE_ADDRESS__
/// Keeps a loaded Mesa library in memory.
static int pin_library(struct dl_phdr_info *info, size_t size, void *context)
{
    (void)size;
    (void)context;
    if (strstr(info->dlpi_name, "_dri.so")) dlopen(info->dlpi_name, RTLD_LAZY | RTLD_NOLOAD | RTLD_NODELETE);
    return 0;
}

// Mesa's driver leaks a few blocks when unloaded. While it stays loaded, the leak checker finds pointers to them, or names to suppress.
void keep_driver_loaded(void) { dl_iterate_phdr(pin_library, NULL); }
#else
void keep_driver_loaded(void) {}
#endif

static struct platform *allocate(void)
{
    struct platform *platform = need_zeroed(1, sizeof *platform);
    keep_freed_memory();
    return platform;
}

struct platform *platform_window(int width, int height, const char *title, int vsync, struct error *error)
{
    struct platform *platform = allocate();
    platform->window = window_create(width, height, title, vsync, &platform->queue, error);
    if (!platform->window) {
        free(platform);
        return NULL;
    }
    keep_driver_loaded();
    if (!gl_debug_start(error)) {
        platform_destroy(platform);
        return NULL;
    }
    return platform;
}

struct platform *platform_blind(int width, int height, float scale)
{
    struct platform *platform = allocate();
    platform->size = (struct surface_size){width, height, scale};
    return platform;
}

struct platform *platform_offscreen(int width, int height, float scale, struct error *error)
{
    struct platform *platform = platform_blind(width, height, scale);
    platform->offscreen = offscreen_create(width, height, error);
    if (!platform->offscreen) {
        free(platform);
        return NULL;
    }
    platform->keeps = true;
    if (gl_debug_start(error)) return platform;
    platform_destroy(platform);
    return NULL;
}

void platform_destroy(struct platform *platform)
{
    if (!platform) return;
    if (platform->window) window_destroy(platform->window);
    if (platform->offscreen) offscreen_destroy(platform->offscreen);
    free(platform->clipboard);
    free(platform);
}

void platform_run(struct platform *platform, bool (*frame)(void *), void *user)
{
    (void)platform;
    while (frame(user)) continue;
}

bool platform_in_page(void) { return false; }

void platform_describe(struct platform *platform, const char *text) { (void)platform, (void)text; }

void platform_share(struct platform *platform, const char *scene) { (void)platform, (void)scene; }

void platform_choose_file(struct platform *platform) { (void)platform; }

bool platform_fetches(const char *path)
{
    (void)path;
    return false;
}

bool platform_keeps(const struct platform *platform) { return platform->keeps; }
