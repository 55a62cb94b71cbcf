/// Characters as a person sees them: their outlines, inner ones too, are those of a much finer picture, without stairs.
#include "blind.h"
#include "offscreen.h"

enum { WIDTH = 500, HEIGHT = 200, FINE = 4, BYTES = WIDTH * HEIGHT * 4 };
static unsigned char drawn[BYTES], fine[FINE * FINE * BYTES];

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

/// Rough pixels of a scene's stage in the dark and in the light theme are no more than `most`.
static void expect_smooth(const char *scene, const int most[2])
{
    static const enum theme_kind themes[] = {THEME_DARK, THEME_LIGHT};
    struct blind blind;
    blind_open(&blind, scene);
    blind_frame(&blind);
    struct stage_view view = *editor_stage(blind.app.work.editor);
    for (int t = 0; t < 2; t++) {
        theme_use(themes[t]);
        view.colors = theme()->stage;
        offscreen_draw(&view, WIDTH, HEIGHT, drawn);
        offscreen_draw(&view, FINE * WIDTH, FINE * HEIGHT, fine);
        const int rough = stairs(60);
        if (rough > most[t]) fail_msg("%s: expected at most %d rough pixels, got %d", scene, most[t], rough);
    }
    theme_use(THEME_DARK);
    blind_close(&blind);
}

TEST(outlines_have_no_stairs)
{
    static const struct {
        const char *scene;
        int most[2];
    } cases[] = {
        {"assets/scenes/tail.json", {90, 50}}, // without skirts 103 and 74, with markings edged by distance alone 440
        {"assets/scenes/dog.json", {85, 70}},
        {"assets/scenes/character.json", {18, 45}},
    };
    if (!platform) skip();
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) expect_smooth(cases[i].scene, cases[i].most);
}

OFFSCREEN(FINE *WIDTH, FINE *HEIGHT)
