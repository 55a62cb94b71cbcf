/// A .gif is read back by ImageMagick: pictures of few colors exactly, whatever their size and whatever changes.
#include "folder.h"

#include "app/film.h"
#include "platform/platform.h"

enum { PICTURES = 3, MOST_PIXELS = 640 * 360 };

static unsigned char written[PICTURES][4 * MOST_PIXELS], seen[PICTURES][4 * MOST_PIXELS];
static uint32_t seed;

static unsigned pick(unsigned count)
{
    seed = seed * 1664525 + 1013904223;
    return (seed >> 8) % count;
}

/// Of each later picture `changed` in a hundred pixels get another of `colors` colors, which differ by 30 in a channel.
static void make_pictures(size_t pixels, unsigned colors, unsigned changed)
{
    seed = 1;
    for (int p = 0; p < PICTURES; p++) {
        for (size_t i = 0; i < pixels; i++) {
            const unsigned color = pick(colors),
                           made = 0xff000000U | color / 64 * 30 << 16 | color / 8 % 8 * 30 << 8 | color % 8 * 30;
            const bool stays = p > 0 && pick(100) >= changed;
            memcpy(&written[p][4 * i], stays ? (const void *)&written[p - 1][4 * i] : &made, 4);
        }
    }
}

static void write_film(const char *path, int width, int height)
{
    struct error error;
    off_t bytes;
    const struct film_shape shape = {width, height, .rate = 24, .count = PICTURES};
    struct film_file *film = film_file_open(&film_gif, path, &shape, &error);
    assert_non_null(film);
    for (int p = 0; p < PICTURES; p++) assert_int_equal(film_gif.put(film, written[p], true, &error), FILM_DONE);
    assert_int_equal(film_gif.finish(film, true, &bytes, &error), FILM_DONE);
    film_file_close(film);
}

/// ImageMagick finds so many pictures of this size.
static void read_film(const char *path, size_t pixels)
{
    char command[256];
    snprintf(command, sizeof command, "convert '%s' -coalesce -depth 8 rgba:-", path);
    FILE *pictures = popen(command, "r");
    assert_non_null(pictures);
    for (int p = 0; p < PICTURES; p++) assert_int_equal(fread(seen[p], 4, pixels, pictures), pixels);
    assert_int_equal(fgetc(pictures), EOF);
    assert_int_equal(pclose(pictures), 0);
}

TEST(pictures_of_few_colors_are_read_back_exactly)
{
    static const struct {
        int width, height;
        unsigned colors, changed;
    } cases[] = {
        {1, 1, 1, 0},       {1, 1, 255, 100},  {16, 16, 2, 0},     {17, 5, 255, 100},
        {161, 91, 255, 30}, {320, 180, 1, 50}, {640, 360, 255, 1}, {640, 360, 3, 100},
    };
    if (system("convert -version >/dev/null 2>&1") != 0) {
        print_message("skip - ImageMagick is missing\n");
        skip();
    }
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
        const size_t pixels = (size_t)cases[c].width * (size_t)cases[c].height;
        make_pictures(pixels, cases[c].colors, cases[c].changed);
        write_film(folder_path("few.gif"), cases[c].width, cases[c].height);
        read_film(folder_path("few.gif"), pixels);
        for (int p = 0; p < PICTURES; p++) assert_memory_equal(seen[p], written[p], 4 * pixels);
    }
}

static void step_through(const struct opened *opened, const char *path, bool wait)
{
    static const struct export_options options = {.size = {96, 54}, .has_frames = true, .last = 12};
    struct error error;
    enum film_state state;
    struct film *film = film_open(opened, path, &options, &error);
    assert_non_null(film);
    while ((state = film_step(film, wait, &error)) == FILM_RUNS) continue;
    assert_int_equal(state, FILM_DONE);
    film_close(film);
}

/// As the app and a browser draw it, between frames of their own.
TEST(a_film_that_waits_for_nothing_is_the_same)
{
    struct opened opened;
    struct platform *platform = platform_offscreen(64, 64, 1, NULL);
    if (!platform) skip();
    assert_done(opened_read(&opened, "assets/scenes/tail.json", &error));
    opened_solve(&opened, SOLVER_BY_LENGTH);
    step_through(&opened, folder_path("waits.gif"), true);
    step_through(&opened, folder_path("steps.gif"), false);
    const uint64_t content = file_content(folder_path("waits.gif"));
    assert_true(content != 0 && content == file_content(folder_path("steps.gif")));
    opened_free(&opened);
    platform_destroy(platform);
}

TESTS_BETWEEN(folder_make, folder_remove)
