/// The fox as a person sees it: its outlines, inner ones too, are those of a much finer picture, without stairs.
#include "blind.h"
#include "offscreen.h"
#include <stdlib.h>

enum { WIDTH = 500, HEIGHT = 200, FINE = 4, BYTES = WIDTH * HEIGHT * 4 };
static unsigned char drawn[BYTES], fine[FINE * FINE * BYTES];

static int set_up(void **state)
{
    (void)state;
    return offscreen_open(FINE * WIDTH, FINE * HEIGHT);
}

/// A pixel's channel in the finer picture: the mean over its area.
static int averaged(int x, int y, int channel)
{
    int sum = 0;
    for (int i = 0; i < FINE * FINE; i++) {
        const int from = (y * FINE + i / FINE) * FINE * WIDTH + x * FINE + i % FINE;
        sum += fine[4 * from + channel];
    }
    return sum / (FINE * FINE);
}

/// Pixels that are off the finer picture's by more than `tolerance` in any channel.
static int stairs(int tolerance)
{
    int count = 0;
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        bool off = false;
        for (int k = 0; k < 3; k++) off |= abs(drawn[4 * i + k] - averaged(i % WIDTH, i / WIDTH, k)) > tolerance;
        count += off;
    }
    return count;
}

static void outlines_have_no_stairs(void **state)
{
    (void)state;
    if (!platform) skip();
    static const enum theme_kind themes[] = {THEME_DARK, THEME_LIGHT};
    static const unsigned long most[] = {90,
                                         50}; // without skirts 103 and 74, with markings edged by distance alone 440
    struct blind blind;
    blind_open(&blind, "assets/scenes/tail.json");
    blind_frame(&blind);
    struct stage_view view = *editor_stage(blind.app.table.editor);
    for (int t = 0; t < 2; t++) {
        theme_use(themes[t]);
        view.colors = theme()->stage;
        offscreen_draw(&view, WIDTH, HEIGHT, drawn);
        offscreen_draw(&view, FINE * WIDTH, FINE * HEIGHT, fine);
        assert_in_range(stairs(60), 0, most[t]);
    }
    theme_use(THEME_DARK);
    blind_close(&blind);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(outlines_have_no_stairs)};
    return cmocka_run_group_tests(tests, set_up, offscreen_close);
}
