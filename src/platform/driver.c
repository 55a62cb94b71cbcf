/// Keeps the graphics driver loaded until the process ends.
#include "platform/surface.h"
#include <dlfcn.h>
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
