/// What the app shows, without a picture: figures, the card for newcomers, larger type, presenting, and the demo.
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
        for (target.nth = 0; target.nth < 2; target.nth++) {
            float xy[2];
            if (find_character(editor->stage, &editor->core, &target, xy) && rect_contains(card, xy[0], xy[1]))
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

// --- presenting

BLIND_TEST(presenting_gives_the_stage_the_window_and_changes_nothing, blind_open(b, NULL))
{
    char *before = text_of_document(b->app.work.document);
    const struct layout normal = *layout_of(e(b)), *l = layout_of(e(b));
    blind_key(b, KEY_F5, 0);
    blind_frames(b, 30);
    assert_near(core(b)->view.scale, 1.5, 1e-6);
    assert_near(l->stage.w * 1.5f, 1280, 1);
    assert_near(l->stage.h * 1.5f, 720, 1);
    assert_true(l->inspector.x >= l->window.w && l->curves.y >= l->window.h);
    assert_false(shows(b, "Knot"));
    blind_key(b, KEY_ESCAPE, 0);
    assert_memory_equal(l, &normal, sizeof normal);
    assert_true(shows(b, "Knot"));
    assert_true(history_is_saved(b->app.work.history));
    assert_prints(b->app.work.document, before);
    free(before);
}

BLIND_TEST(a_panel_comes_when_the_pointer_does, blind_open(b, NULL))
{
    static const struct {
        float x, y; ///< pointer; 0: Tab
        float side, below;
    } rows[] = {{600, 300, 0, 0}, {1275, 300, 1, 0}, {1000, 300, 1, 0}, {300, 715, 0, 1}, {0, 0, 1, 1}, {0, 0, 0, 0}};
    const struct layout *l = layout_of(e(b));
    blind_key(b, KEY_F5, 0);
    blind_frames(b, 30);
    for (int i = 0; i < 6; i++) {
        if (rows[i].x > 0)
            blind_point(b, rows[i].x, rows[i].y);
        else
            blind_key(b, KEY_TAB, 0);
        if (i == 1) blind_frames(b, 2);
        const float side = core(b)->view.presenter.side;
        if (i == 1) assert_true(side > 0 && side < 1); // slides
        blind_frames(b, 30);
        assert_near(core(b)->view.presenter.side, rows[i].side, 0);
        assert_near(core(b)->view.presenter.below, rows[i].below, 0);
        if (i == 1) assert_near(l->stage.w * 1.5f, 1280, 1);      // it lies over the stage
        if (i == 4) assert_true(l->stage.w < l->inspector.x + 1); // now they share the window
    }
    blind_key(b, KEY_F5, 0);
    assert_false(core(b)->view.presenter.on);
}

/// There they come and go together, and take their room from the stage.
BLIND_TEST(in_an_upright_window_all_panels_come_from_below, blind_open(b, NULL))
{
    const struct layout *l = layout_of(e(b));
    blind_resize(b, 390, 792, 1);
    blind_key(b, KEY_F5, 0);
    blind_frames(b, 30);
    assert_near(l->stage.h, 792, 0);
    assert_true(l->curves.y >= 792 && l->inspector.y >= 792);
    blind_point(b, 200, 785);
    blind_frames(b, 2);
    for (int k = 0; k < 2; k++) { // what comes by: the ruler, and the first group's heading
        const float y = k ? l->inspector.y + 14 : l->ruler.y + 8;
        blind_button(b, BUTTON_LEFT, ACTION_PRESS, 200, y);
        if (!k) blind_frame(b);
        assert_false(is_dragging(e(b)));
        blind_button(b, BUTTON_LEFT, ACTION_RELEASE, 200, y);
    }
    for (int k = 0; k < 2; k++) {
        blind_frames(b, 30);
        assert_true(shows(b, "damping")); // the group is still open
        assert_near(l->status.y + l->status.h, 792, 0);
        assert_near(l->inspector.y + l->inspector.h, l->status.y, 0);
        assert_near(l->stage.h, l->curves.y, 0);
        if (!k) blind_point(b, 200, l->inspector.y + 20);
    }
    blind_point(b, 200, 100);
    blind_frames(b, 30);
    assert_true(l->curves.y >= 792 && l->inspector.y >= 792);
}

BLIND_TEST(what_is_pressed_is_shown_and_fades, blind_open(b, NULL))
{
    blind_key(b, 'Z', MOD_CTRL);
    assert_false(shows(b, "Ctrl + Z"));
    blind_key(b, KEY_F5, 0);
    assert_true(shows(b, "F5"));
    blind_key(b, 'Z', MOD_CTRL);
    assert_true(shows(b, "Ctrl + Z") && shows(b, "Nothing to undo")); // the status line is away or on its way
    blind_key(b, 'Z', MOD_CTRL);
    assert_true(shows(b, "Ctrl + Z ×2"));
    blind_frames(b, 120);
    assert_false(shows(b, "Ctrl + Z ×2"));
    blind_button(b, BUTTON_RIGHT, ACTION_PRESS, 600, 300);
    blind_frame(b);
    assert_true(shows(b, "right-click"));
    blind_point(b, 640, 300);
    assert_true(shows(b, "right drag"));
    blind_frames(b, 120);
    assert_true(shows(b, "right drag"));
    blind_button(b, BUTTON_RIGHT, ACTION_RELEASE, 600, 300);
    blind_frames(b, 120);
    assert_false(shows(b, "right drag"));
}

// --- the demo: all of it can be played, it begins anew by itself, and the first touch ends it

static void demo_open(struct blind *b)
{
    blind_open(b, NULL);
    b->options.demo = true;
    b->app.demo = (struct demo){.on = true, .theme = theme_in_use()};
    assert_done(b->app.replay = demo_replay(&error));
}

static const char *caption(const struct blind *b) { return e(b)->dialogs->caption; }
static uint64_t scene_now(const struct blind *b) { return scene_hash(b->app.work.document); }

/// Every target is there (else a frame fails), every caption fits, every kind of thing is shown, and the second round is the first.
BLIND_TEST(all_of_the_demo_plays_and_begins_anew, demo_open(b))
{
    bool seen[RIG_KINDS] = {false}, light = false, presents = false, records = false;
    const uint64_t first = scene_now(b);
    const long length = replay_get_header(b->app.replay)->frames;
    uint64_t changed = first;
    int edits = 0; ///< captions under which the scene became another
    char last[160] = "";
    assert_true(length > 100 * 60 && length < 140 * 60);
    for (long frame = 0; frame < length; frame++) {
        blind_frame(b);
        const struct document *document = b->app.work.document;
        for (int r = 0; r < document->rig_count; r++) seen[document->rigs[r]->kind] = true;
        light |= theme_in_use() == THEME_LIGHT;
        presents |= core(b)->view.presenter.on;
        records |= strstr(said(e(b)), "knots recorded") != NULL;
        if (strcmp(last, caption(b)) == 0) continue;
        snprintf(last, sizeof last, "%s", caption(b));
        if (!shows(b, last)) fail_msg("the caption “%s” does not fit", last);
        edits += scene_now(b) != changed;
        changed = scene_now(b);
    }
    for (int kind = 0; kind < RIG_KINDS; kind++) assert_true(seen[kind]);
    assert_true(light && presents && records && edits >= 9 && scene_now(b) != first);
    blind_frame(b);
    assert_int_equal(b->app.demo.frame, 0);
    assert_int_equal(scene_now(b), first);
    assert_int_equal(theme_in_use(), THEME_DARK);
    assert_true(b->app.demo.on);
}

/// In the middle of a drag. A pointer that passes is no touch, and the window's close button loses nothing and asks nothing.
TEST(the_first_touch_ends_the_demo_with_the_start_scene)
{
    static const struct {
        struct event event;
        bool stops, quits;
    } rows[] = {
        {{.kind = EVENT_KEY, .key = 'V', .action = ACTION_PRESS}, true, false},
        {{.kind = EVENT_BUTTON, .action = ACTION_PRESS, .x = 300, .y = 200}, true, false},
        {{.kind = EVENT_WHEEL, .dy = 1, .x = 300, .y = 200}, true, false},
        {{.kind = EVENT_POINTER, .x = 300, .y = 200}, false, false},
        {{.kind = EVENT_SIZE, .x = 1600, .y = 900, .scale = 1}, false, false},
        {{.kind = EVENT_CLOSE}, false, true},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        struct blind b;
        demo_open(&b);
        const uint64_t first = scene_now(&b);
        blind_frames(&b, 9 * 60);
        assert_string_equal(dragged(e(&b)), "Move body");
        blind_send(&b, rows[i].event);
        app_frame(&b.app);
        if (b.app.quit != rows[i].quits || (!rows[i].quits && b.app.demo.on == rows[i].stops)) fail_msg("%zu", i);
        if (rows[i].stops) {
            assert_int_equal(scene_now(&b), first);
            assert_true(history_is_saved(b.app.work.history));
            assert_string_equal(caption(&b), "");
            assert_false(is_dragging(e(&b)));
            blind_frame(&b);
            assert_null(b.app.replay);
        }
        blind_close(&b);
    }
}

/// A slow display shows fewer pictures of the same demo.
BLIND_TEST(the_demo_takes_its_time_whatever_the_display, demo_open(b))
{
    static const int rates[] = {144, 20};
    for (int r = 0; r < 2; r++) {
        for (int i = 0; i < rates[r] * 3; i++) assert_done(demo_next(&b->app, 1.0 / rates[r], &error));
        assert_int_equal(b->app.demo.frame, 180 * (r + 1));
    }
}
