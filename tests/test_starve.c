/// Each allocation fails once: no signal, and no success that is none.
#include "starve.h"

#include "base/file.h"
#include "base/png.h"
#include "folder.h"
#include "ui/font.h"

/// The fonts as the app reads and rasterises them.
static int read_fonts(void *user)
{
    struct atlas atlas;
    struct error error = {0};
    (void)user;
    if (!font_init(&error) || !atlas_build(1, &atlas, &error)) return strstr(error.text, "memory") ? 3 : 4;
    atlas_free(&atlas);
    return 0;
}

enum { SIDE = 64 };

/// A picture; it is whole where it is said to be written, and else not there.
static int write_picture(void *user)
{
    static unsigned char pixels[4 * SIDE * SIDE];
    struct error error = {0};
    const char *path = user;
    unsigned seed = 1;
    for (size_t i = 0; i < sizeof pixels; i++)
        pixels[i] = (unsigned char)((seed = seed * 1664525u + 1013904223u) >> 29);
    unlink(path);
    if (png_write(path, SIDE, SIDE, pixels, &error)) return access(path, F_OK) == 0 ? 0 : 4;
    return access(path, F_OK) != 0 && strstr(error.text, "emory") ? 3 : 5;
}

static void fonts(void **state)
{
    (void)state;
    starve("fonts", read_fonts, NULL, 300);
}

static void pictures(void **state)
{
    (void)state;
    char path[128];
    snprintf(path, sizeof path, "%s", folder_path("picture.png"));
    starve("a picture", write_picture, path, 300);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(fonts),
        cmocka_unit_test(pictures),
    };
    return cmocka_run_group_tests(tests, folder_make, folder_remove);
}
