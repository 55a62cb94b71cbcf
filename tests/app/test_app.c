/// What the app shows, without a picture: figures, the card for newcomers and larger type.
#include "blind.h"
#include "documents.h"
#include "questions.h"

#include "scene/load.h"
#include "shown.h"

static struct editor *e(const struct blind *b) { return b->app.work.editor; }
static struct core *core(struct blind *b) { return &b->app.work.editor->core; }
static bool shows(const struct blind *b, const char *text) { return shown_text(e(b), text) != NULL; }

/// Events happen in their order: a figure that opens before the first movement of a drag ends the press, and the movement is no drag.
BLIND_TEST(a_figure_ends_a_press_that_began_in_its_frame, blind_open(b, "assets/scenes/tail.json"))
{
    struct app *app = &b->app;
    float x, y;
    char knot[64];
    blind_frame(b);
    const int splines = app->work.document->spline_count;
    snprintf(knot, sizeof knot, "knot(%s,1)", app->work.document->splines[0]->name);
    assert_true(editor_target(e(b), knot, &x, &y, NULL));
    blind_pointer(b, x, y);
    blind_button(b, BUTTON_LEFT, ACTION_PRESS, x, y);
    blind_send_example(b, "figure 4");
    blind_point(b, x, y - 40);
    assert_false(history_is_open(app->work.history));
    assert_int_equal(history_count(app->work.history), 0);
    blind_frame(b);
    assert_true(app->work.document->spline_count != splines && !app->work.document->path);
}

/// Figure 2 shows poles and response with the numbers that change them, Figure 3 the phase curve, until another scene opens.
TEST(figures_show_their_subject)
{
    for (int by_key = 0; by_key < 2; by_key++) {
        struct blind b;
        float x, y;
        blind_open(&b, by_key ? NULL : "assets/scenes/figure2.json");
        if (by_key) blind_send_example(&b, "poles");
        blind_frames(&b, 2);
        const struct draw_command *axis = shown_text(e(&b), "-1 Hz"); // below the response
        assert_true(axis && shown_text(e(&b), "-40 dB at 0 Hz") && widget_at(e(&b), "damping", &x, &y));
        assert_true(axis->y < y);
        blind_send_example(&b, "figure 3");
        blind_frames(&b, 2);
        assert_true(!shown_text(e(&b), "-1 Hz") && shown_text(e(&b), "phase")); // which that figure is of
        blind_send_example(&b, "figure 4");
        blind_frames(&b, 2);
        assert_null(shown_text(e(&b), "phase"));
        blind_close(&b);
    }
}

// --- the card for newcomers stands beside what a scene shows, or in a band above it, on every size of stage

enum { STEPS = 12, REACH = 6, LINE = 16 };

/// Shows it; the card lies between its first word and its last one.
static struct rect welcome_at(struct blind *b, float width)
{
    app_resize(&b->app, width, roundf(width * 9 / 16), 1);
    core(b)->view.refit_stage = true; // as in a window of that size
    welcome(e(b));
    blind_frames(b, 2);
    const struct draw_command *first = shown_text(e(b), "Drag the character"), *last = shown_text(e(b), "Got it");
    assert_true(first && last && first->y <= last->y);
    return (struct rect){first->x - REACH, first->y - LINE, last->x + 40 - first->x, last->y - first->y + LINE};
}

static bool covers_a_character(const struct editor *editor, struct rect card)
{
    for (int i = 0; i <= STEPS * STEPS; i++) {
        struct target target = {.number = {i % STEPS / (double)STEPS, i / STEPS / (double)STEPS}};
        for (target.rig = 0; target.rig < editor->core.document->rig_count; target.rig++) {
            float xy[2];
            if (thing_point.find(editor->stage, &editor->core, &target, xy) && rect_contains(card, xy[0], xy[1]))
                return true;
        }
    }
    return false;
}

/// A click takes it away, upright at the right hand or in a band; the description comes back where a band was.
TEST(the_card_covers_no_character)
{
    static const char *const scenes[] = {"character", "compositing", "figure7", "hands", "up-down"};
    for (int i = 0; i < 5; i++) {
        struct blind b;
        char path[64];
        snprintf(path, sizeof path, "assets/scenes/%s.json", scenes[i]);
        blind_open(&b, path);
        for (float width = 640; width <= 1280; width += 80) {
            const struct rect card = welcome_at(&b, width), stage = layout_of(e(&b))->stage;
            if (covers_a_character(e(&b), card)) fail_msg("%s at %g", scenes[i], (double)width);
            assert_true(card.x >= stage.x && card.x + card.w <= stage.x + stage.w);
            assert_true(card.y >= stage.y && card.y + card.h <= stage.y + stage.h);
            if (i != 1 || (width > 640 && width < 1280)) continue;
            assert_int_equal(shows(&b, "Compositing"), width > 1000);
            blind_click(&b, card.x + card.w / 2, card.y + card.h / 2);
            assert_false(is_welcoming(e(&b)));
            assert_true(shows(&b, "Compositing"));
        }
        blind_close(&b);
    }
}

// --- how large everything is

BLIND_TEST(keys_make_everything_larger_and_smaller, blind_open(b, NULL))
{
    static const struct {
        int key, times;
        unsigned mods;
        double scale;
    } rows[] = {{KEY_F8, 1, 0, 1.25},         {KEY_F8, 1, 0, 1.5},          {KEY_F8, 2, MOD_SHIFT, 1},
                {KEY_F8, 1, MOD_SHIFT, 0.75}, {KEY_F8, 1, MOD_SHIFT, 0.75}, {'0', 1, MOD_CTRL | MOD_SHIFT, 1},
                {KEY_F8, 4, 0, 1.5}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        for (int k = 0; k < rows[i].times; k++) blind_key(b, rows[i].key, rows[i].mods);
        assert_near(core(b)->view.scale, rows[i].scale, 1e-6);
        assert_near(core(b)->view.layout.window.w, 1280 / rows[i].scale, 1e-2);
        if (i == 0) assert_true(shows(b, "125 %"));
    }
    assert_string_equal(said(e(b)), "175 % needs a window of 1330 × 700, not 1280 × 720");
    blind_frame(b);
    assert_true(shows(b, said(e(b)))); // in full
    static const float sizes[][5] = {
        {1000, 600, 1, 1.25f, 1000 / 1.25f}, {2560, 1440, 2, 3, 2560 / 1.5f}, {600, 1000, 1, 1.5f, 600 / 1.5f}};
    for (int i = 0; i < 3; i++) { // as large as fits; upright it needs less
        blind_resize(b, sizes[i][0], sizes[i][1], sizes[i][2]);
        assert_near(core(b)->view.scale, sizes[i][3], 1e-6);
        assert_near(core(b)->view.layout.window.w, sizes[i][4], 1e-2);
    }
}

/// What is on the screen under the pointer stays there.
BLIND_TEST(the_pointer_means_the_same_place, blind_open(b, NULL))
{
    blind_point(b, 640, 300);
    blind_key(b, KEY_F8, 0);
    assert_near(core(b)->input.pointer_x, 512, 1e-3);
    blind_point(b, 700, 500);
    assert_near(core(b)->input.pointer_x, 560, 1e-3);
    assert_near(core(b)->input.pointer_y, 400, 1e-3);
}

BLIND_TEST(the_status_line_makes_everything_larger_by_mouse, blind_open(b, NULL))
{
    const float x = 6 + 24 + 42 + 44 + 64 + 48 + 20;
    blind_button(b, BUTTON_LEFT, ACTION_PRESS, x, 708);
    blind_frame(b);
    assert_near(core(b)->view.scale, 1.25, 1e-6);
    blind_button(b, BUTTON_RIGHT, ACTION_PRESS, x * 1.25f, 708); // the bar is higher now
    blind_frame(b);
    assert_near(core(b)->view.scale, 1, 1e-6);
}
