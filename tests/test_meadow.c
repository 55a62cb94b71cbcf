/// Meadows: loaded and saved, solved as the variations that they are, pushed by bodies and swinging after them.
#include "panel_session.h"
#include "rig/meadow.h"

static const char scene[] =
    "{\"wiggly\": 1, \"frames\": [0, 96], \"splines\": [{\"name\": \"wind\", \"frequency\": 1, \"damping\": 0.1, "
    "\"knots\": [{\"frame\": 10, \"value\": 0.5}, {\"frame\": 60, \"value\": -0.5}]}],"
    "\"rigs\": [{\"type\": \"tail\", \"name\": \"fox\", \"position\": [0, 0.26, 0], \"channels\": []},"
    "{\"type\": \"meadow\", \"name\": \"reeds\", \"spline\": \"wind\", \"count\": 300, \"seed\": 5, "
    "\"area\": [4, 3], \"height\": 0.5, \"variation\": 0.4, \"mood\": \"mild\"}]}";

/// The wind follows another spline, and the fox's tail has one of its own.
static const char windy_scene[] =
    "{\"wiggly\": 1, \"frames\": [0, 96], \"splines\": ["
    "{\"name\": \"wind\", \"frequency\": 1, \"damping\": 0.1, \"equilibrium\": {\"spline\": \"gust\"}, "
    "\"knots\": [{\"frame\": 10, \"value\": 0.5}, {\"frame\": 60, \"value\": -0.5}]},"
    "{\"name\": \"gust\", \"mode\": \"cubic\", "
    "\"knots\": [{\"frame\": 0, \"value\": 0}, {\"frame\": 50, \"value\": 0.2}]},"
    "{\"name\": \"tail\", \"knots\": [{\"frame\": 0, \"value\": 0.2}]}],"
    "\"rigs\": [{\"type\": \"tail\", \"name\": \"fox\", \"position\": [0, 0.26, 0], "
    "\"channels\": [{\"spline\": \"tail\", \"axis\": \"side\", \"gain\": 4}]},"
    "{\"type\": \"meadow\", \"name\": \"reeds\", \"spline\": \"wind\", \"count\": 40, \"variation\": 0.4}]}";

SESSION_TEST(it_is_read_and_written, session_open(s, scene))
{
    const struct meadow_rig *meadow = &s->document->rigs[1]->meadow;
    assert_int_equal(meadow->count, 300);
    assert_near(meadow->area[1], 3, 0);
    assert_near(meadow->variation, 0.4, 0);
    const char *saved = session_saved(s);
    assert_non_null(strstr(saved, "\"count\": 300"));
    assert_non_null(strstr(saved, "\"mood\": \"mild\""));
    struct document *again = document_of_text(saved);
    assert_memory_equal(&again->rigs[1]->meadow, meadow, sizeof *meadow);
    document_destroy(again);
}

TEST(every_reed_is_a_variation)
{
    struct session s;
    struct models *models = panel_open_models(&s, scene);
    session_frame(&s);
    const struct meadow *meadow = models_meadow(models);
    assert_int_equal(meadow_count(meadow), 300);
    int others = 0;
    for (int r = 0; r < 300; r++) {
        const wiggly_value at_knot = meadow_value(meadow, r, 60), between = meadow_value(meadow, r, 35);
        assert_near(at_knot.y + at_knot.re, -0.5, 1e-12);
        others += fabs(between.re - s.world.evaluation->curves[0].re[35]) > 0.01;
    }
    assert_true(others > 250);
    session_close(&s);
}

/// A meadow has no hard edge: it is an ellipse whose outer half has fewer reeds than the inner one, and shorter ones.
TEST(it_thins_out_towards_its_edge)
{
    struct session s;
    struct models *models = panel_open_models(&s, scene);
    session_frame(&s);
    int count[2] = {0};
    double height[2] = {0};
    for (int r = 0; r < 300; r++) {
        const struct reed *reed = meadow_reed(models_meadow(models), r);
        const double x = (double)reed->place[0] / 2, z = (double)reed->place[2] / 1.5, from_middle = x * x + z * z;
        assert_true(from_middle <= 1);
        count[from_middle > 0.5]++;
        height[from_middle > 0.5] += (double)reed->height;
    }
    assert_true(count[0] > 2 * count[1] && count[1] > 30);
    assert_true(height[0] / count[0] > 1.2 * height[1] / count[1]);
    session_close(&s);
}

SESSION_TEST(its_numbers_are_set_in_the_inspector, panel_open(s, scene, 1280, 2400))
{
    const char *original = session_saved(s);
    panel_enter(s, "meadow.count", "120");
    assert_int_equal(s->document->rigs[1]->meadow.count, 120);
    assert_one_step(s, original);
    panel_enter(s, "meadow.wide", "2.5");
    panel_enter(s, "meadow.gain", "-3");
    panel_enter(s, "meadow.seed", "9");
    const struct meadow_rig *meadow = &s->document->rigs[1]->meadow;
    assert_near(meadow->area[0], 2.5, 0);
    assert_near(meadow->area[1], 3, 0);
    assert_near(meadow->gain, -3, 0);
    assert_int_equal(meadow->seed, 9);
    assert_int_equal(meadow->count, 120);
    for (int i = 0; i < 4; i++) session_key(s, 'Z', MOD_CTRL);
    assert_saved(s, original);
}

/// Played in a loop, the meadow that ships does not jump.
TEST(the_meadow_of_the_app_loops)
{
    struct document *document = document_of_file("assets/scenes/meadow.json");
    for (int s = 0; s < document->spline_count; s++)
        assert_int_equal(spline_start(document->splines[s]), WIGGLY_LOOP);
    document_destroy(document);
}

/// Reeds that a frame solves while something is dragged.
static int solved_by_dragging(struct session *s, const char *target)
{
    int most = 0;
    session_point(s, target);
    session_press(s, BUTTON_LEFT, 1);
    const char *before = session_saved(s);
    for (int i = 0; i < 5; i++) {
        session_drag(s, 6, 2, 1);
        const int solved = meadow_solved(models_meadow(s->table.models));
        most = solved > most ? solved : most;
    }
    session_release(s, BUTTON_LEFT);
    const char *after = session_saved(s);
    assert_string_not_equal(before, after);
    return most;
}

TEST(they_are_solved_only_where_their_curves_change)
{
    static const struct {
        const char *target;
        int solved;
        bool grows;
    } cases[] = {
        {"tail(fox,0.9)", 0, false}, {"body(fox)", 0, false},     {"slider(meadow.height)", 0, true},
        {"knot(wind,1)", 40, false}, {"knot(gust,1)", 40, false}, {"slider(meadow.variation)", 40, false},
    };
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
        struct session s;
        struct models *models = panel_open_models(&s, windy_scene);
        session_frame(&s);
        const float height = meadow_reed(models_meadow(models), 0)->height;
        const int solved = solved_by_dragging(&s, cases[c].target);
        const bool grows = meadow_reed(models_meadow(models), 0)->height != height;
        if (solved != cases[c].solved || grows != cases[c].grows) fail_msg("%s", cases[c].target);
        session_close(&s);
    }
}

static double swing_of(const struct session *s)
{
    double most = 0;
    for (int r = 0; r < 300; r++) {
        for (int k = 0; k < 2; k++) most = fmax(most, fabs(s->editor->stage->meadow.brushed[r].q[k]));
    }
    return most;
}

SESSION_TEST(a_dragged_body_sets_them_swinging, panel_open_models(s, scene))
{
    session_frame(s);
    assert_near(swing_of(s), 0, 0);
    session_point(s, "body(fox)");
    session_press(s, BUTTON_LEFT, 1);
    for (int i = 1; i <= 10; i++) {
        const double swing = swing_of(s);
        editor_pose(s->editor); // as a window's first frame after a rest: no time has passed
        assert_near(swing_of(s), swing, 0);
        session_move(s, 12, 0);
        session_frame(s);
    }
    assert_true(swing_of(s) > 0.05);
    session_release(s, BUTTON_LEFT);
    for (int i = 0; i < 40; i++) session_frame(s);
    const double later = swing_of(s);
    assert_true(later > 0.001 && stage_is_moving(s->editor->stage));
    for (int i = 0; i < 2000; i++) session_frame(s);
    assert_near(swing_of(s), 0, 0);
    assert_false(stage_is_moving(s->editor->stage));
}

/// What a cubic moves has no swing of its own: its reeds are pushed aside, and that is all.
SESSION_TEST(reeds_that_nothing_pulls_back_do_not_swing, panel_open_models(s, scene))
{
    for (int mode = 0; mode < 2; mode++) session_key(s, 'M', 0);
    assert_int_equal(spline_mode(s->document->splines[0]), WIGGLY_CUBIC);
    session_point(s, "body(fox)");
    session_press(s, BUTTON_LEFT, 1);
    session_drag(s, 120, 0, 10);
    assert_near(swing_of(s), 0, 0);
    double pushed = 0;
    const struct stage_meadow *meadow = &editor_stage(s->editor)->meadow;
    for (int r = 0; r < meadow->count; r++) pushed = fmax(pushed, (double)fabsf(meadow->reeds[r].pushed[0]));
    assert_true(pushed > 0.5);
    session_release(s, BUTTON_LEFT);
}
