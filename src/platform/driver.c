/// What graphics drivers do with memory and pictures that GL does not say.
#include "platform/surface.h"
#include <dlfcn.h>
#include <epoxy/gl.h>
#include <link.h>
#include <malloc.h>
#include <stddef.h>
#include <string.h>

void keep_freed_memory(void)
{
#ifdef __GLIBC__
    mallopt(M_MMAP_THRESHOLD, 32 << 20); // the largest allowed
    mallopt(M_TRIM_THRESHOLD, 64 << 20);
#endif
}

#ifdef __SANITIZE_ADDRESS__
/// Pins a loaded library of Mesa's drivers.
static int pin_library(struct dl_phdr_info *info, size_t size, void *context)
{
    (void)size;
    (void)context;
    if (strstr(info->dlpi_name, "_dri.so")) dlopen(info->dlpi_name, RTLD_LAZY | RTLD_NOLOAD | RTLD_NODELETE);
    return 0;
}

// Mesa's driver leaves a few blocks to the process when it is unloaded. The leak checker then finds no pointer to them and
// no name to suppress them by; while the driver stays loaded, it finds both.
void keep_driver_loaded(void) { dl_iterate_phdr(pin_library, NULL); }
#else
void keep_driver_loaded(void) {}
#endif

static bool is_software(void)
{
    const char *renderer = (const char *)glGetString(GL_RENDERER);
    return renderer && (strstr(renderer, "llvmpipe") || strstr(renderer, "softpipe"));
}

static void fill(int x, int width, int height, float red, float blue)
{
    glScissor(x, 0, width, height);
    glClearColor(red, 0.0f, blue, 1.0f);
    glClear(GL_COLOR_BUFFER_BIT);
}

/// The pixel shows `red` and `blue`, each 0 or 255.
static bool shows(int x, int y, int red, int blue)
{
    unsigned char pixel[4] = {0};
    glReadPixels(x, y, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, pixel);
    return pixel[0] == red && pixel[2] == blue;
}

bool probe_keeps(struct platform *platform)
{
    // On a GPU the standard leaves the content undefined, whatever one trial shows.
    if (!is_software()) return false;
    struct surface_size size;
    platform_size(platform, &size.width, &size.height, &size.scale);
    int half = size.width / 2, y = size.height / 2;
    if (half < 1 || y < 1) return false;
    glEnable(GL_SCISSOR_TEST);
    fill(0, size.width, size.height, 1.0f, 0.0f);
    platform_swap(platform);
    bool kept = shows(0, y, 255, 0) && shows(half, y, 255, 0);
    fill(0, half, size.height, 0.0f, 1.0f);
    platform_swap(platform);
    kept = kept && shows(0, y, 0, 255) && shows(half, y, 255, 0);
    fill(0, size.width, size.height, 0.0f, 0.0f);
    glDisable(GL_SCISSOR_TEST);
    return kept;
}
