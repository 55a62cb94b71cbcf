/// Settings: what one load and save gives, the next one gives again.
#include "app/settings.h"
#include "fuzz.h"
#include <stdlib.h>

static char *saved(const void *data, size_t size, size_t *saved_size)
{
    struct error error;
    const char *path = fuzz_file("settings", data, size);
    struct settings *settings = settings_load(path, &error);
    fuzz_expect(settings_save(settings, path, &error), error.text);
    settings_free(settings);
    return fuzz_bytes(path, saved_size);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    size_t first_size, second_size;
    char *first = saved(data, size, &first_size), *second = saved(first, first_size, &second_size);
    fuzz_same("settings that are saved, loaded and saved are the same", first, first_size, second, second_size);
    free(first);
    free(second);
    return 0;
}
