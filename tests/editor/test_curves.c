/// The curves panel as an animator uses it: boxes, scaling, retiming, other curves, ruler. Events in, document out.
#include "five_knots.h"
#include "panel_session.h"

static void assert_frames(const struct session *s, const double *frames)
{
    for (int k = 0; k < spline(s, 0)->knot_count; k++) assert_near(spline(s, 0)->knots[k].frame, frames[k], 1e-9);
}

/// Which knots of the first spline are selected, as digits from the first.
static void assert_selected(const struct session *s, const char *expected)
{
    char text[64] = "";
    for (int k = 0; k < spline(s, 0)->knot_count; k++) {
        text[k] = selection_has(selection_of(s->editor), spline(s, 0)->knots[k].id) ? '1' : '0';
    }
    assert_string_equal(text, expected);
}

/// Drags a box from one target to another; the button stays down.
static void drag_box(struct session *s, const char *from, const char *to, unsigned mods)
{
    session_point(s, from);
    s->mods = mods;
    session_press(s, BUTTON_LEFT, 1);
    session_hover(s, to);
}

static void box(struct session *s, const char *from, const char *to, unsigned mods)
{
    drag_box(s, from, to, mods);
    session_release(s, BUTTON_LEFT);
    s->mods = 0;
}

SESSION_TEST(test_a_box_selects_adds_and_removes, session_open(s, FIVE))
{
    drag_box(s, "curve(sway,15,1.4)", "curve(sway,35,-1.2)", 0);
    assert_selected(s, "01100"); // already while the box grows
    session_hover(s, "curve(sway,25,-1.2)");
    assert_selected(s, "01000"); // and where it shrinks again
    session_release(s, BUTTON_LEFT);
    box(s, "curve(sway,45,1.4)", "curve(sway,65,-1.2)", MOD_SHIFT);
    assert_selected(s, "01001");
    box(s, "curve(sway,16,1.4)", "curve(sway,24,-1.2)", MOD_CTRL);
    assert_selected(s, "00001");
    box(s, "curve(sway,55,0.3)", "curve(sway,66,-0.4)", MOD_ALT);
    assert_selected(s, "00000");
    assert_null(history_undo_label(s->history));
}

SESSION_TEST(test_escape_takes_a_box_back_and_a_click_clears, session_open(s, FIVE))
{
    session_click(s, "knot(sway,3)");
    drag_box(s, "curve(sway,7,1.4)", "curve(sway,35,-1.2)", 0);
    assert_selected(s, "11100");
    session_key(s, KEY_ESCAPE, 0);
    assert_selected(s, "00010");
    session_release(s, BUTTON_LEFT);
    session_point(s, "curve(sway,66,-1.2)");
    session_click_here(s, 1);
    assert_selected(s, "00000");
}

SESSION_TEST(test_a_knot_of_another_curve_makes_it_active, session_open(s, FIVE))
{
    assert_int_equal(active(s->editor), 0);
    session_point(s, "knot(up,1)");
    session_press(s, BUTTON_LEFT, 1);
    assert_int_equal(active(s->editor), 1);
    session_drag(s, 0, -20, 4); // and the same press drags it
    session_release(s, BUTTON_LEFT);
    assert_true(spline(s, 1)->knots[1].value > 0.8);
}

SESSION_TEST(test_scaling_by_a_typed_factor, session_open(s, FIVE))
{
    box(s, "curve(sway,7,1.4)", "curve(sway,35,-1.2)", 0);
    const char *original = session_saved(s);
    session_type(s, "sx1.3");
    session_key(s, KEY_ENTER, 0);
    const double frames[] = {7, 20, 33, 40, 60}; // about the middle of 10 … 30
    assert_frames(s, frames);
    assert_near(spline(s, 0)->knots[1].value, 1, 0);
    assert_near(spline(s, 0)->knots[1].slope, 2 / 1.3, 1e-5); // the shape is stretched with the knots
    assert_one_step(s, original);
    original = session_saved(s);
    session_type(s, "sy-2");
    session_key(s, KEY_ENTER, 0);
    assert_frames(s, frames);
    assert_near(spline(s, 0)->knots[1].value, -2, 1e-9);
    assert_near(spline(s, 0)->knots[2].value, 2, 1e-9);
    assert_near(spline(s, 0)->knots[1].slope, -4 / 1.3, 1e-5);
    assert_one_step(s, original);
}

SESSION_TEST(test_scaling_by_pointer_about_the_playhead, session_open(s, FIVE))
{
    session_click(s, "ruler(20)");
    session_key(s, 'A', MOD_CTRL);
    session_point(s, "curve(sway,40,0)");
    session_type(s, "spx");
    session_hover(s, "curve(sway,50,0.7)"); // one and a half times as far
    const double frames[] = {5, 20, 35, 50, 80};
    assert_frames(s, frames);
    session_click_here(s, 1); // a click keeps it
    assert_false(history_is_open(s->history));
    assert_frames(s, frames);
}

SESSION_TEST(test_scaling_can_mirror_and_be_taken_back, session_open(s, FIVE))
{
    box(s, "curve(sway,7,1.4)", "curve(sway,35,-1.2)", 0);
    const char *original = session_saved(s);
    session_type(s, "sx-1");
    session_frame(s);
    assert_near(spline(s, 0)->knots[0].value, -1, 0); // in reverse order
    assert_near(spline(s, 0)->knots[1].slope, -2, 1e-5);
    assert_near(spline(s, 0)->knots[2].value, 0, 0);
    assert_selected(s, "11100");
    session_key(s, KEY_ESCAPE, 0);
    assert_saved(s, original);
    assert_null(history_undo_label(s->history));
}

/// 4 would lie on 40, which is not selected; 0 would put all on one frame; 9 leads out of the range.
SESSION_TEST(test_scaling_never_swallows_a_knot, session_open(s, FIVE))
{
    box(s, "curve(sway,7,1.4)", "curve(sway,35,-1.2)", 0);
    const char *const bad[] = {"2", "0", "9"};
    for (int i = 0; i < 3; i++) {
        const char *original = session_saved(s);
        session_type(s, "sx");
        session_type(s, bad[i]);
        session_key(s, KEY_ENTER, 0);
        assert_int_equal(spline(s, 0)->knot_count, 5);
        assert_saved(s, original);
    }
}

SESSION_TEST(test_a_ripple_moves_what_comes_after, session_open(s, FIVE))
{
    const char *original = session_saved(s);
    float frame = (float)(layout_of(s->editor)->plot.w / (plot_of(s->editor)->frame1 - plot_of(s->editor)->frame0));
    session_point(s, "knot(sway,2)");
    session_press(s, BUTTON_LEFT, 1);
    session_key(s, 'R', 0);
    session_key(s, 'X', 0);
    session_drag(s, 7 * frame, 0, 7);
    const double later[] = {10, 20, 37, 47, 67}, alone[] = {10, 20, 37, 40, 60}, sooner[] = {10, 20, 21, 31, 51};
    assert_frames(s, later);
    session_key(s, 'R', 0);
    assert_frames(s, alone);
    session_key(s, 'R', 0);
    session_drag(s, -30 * frame, 0, 10);
    assert_frames(s, sooner); // it stops behind the knot that stays
    session_drag(s, 200 * frame, 0, 10);
    const double end[] = {10, 20, 66, 76, 96};
    assert_frames(s, end); // and at the end of the range
    assert_said(s->editor, "end of the range");
    session_release(s, BUTTON_LEFT);
    assert_near(spline(s, 0)->knots[3].value, 0.5, 0);
    assert_one_step(s, original);
}

SESSION_TEST(test_ruler_units_and_snap, session_open(s, FIVE))
{
    session_move(s, layout_of(s->editor)->ruler.x / 2, layout_of(s->editor)->ruler.y + 8);
    session_click_here(s, 1);
    assert_true(is_on(s->editor, SWITCH_SECONDS));
    session_key(s, 'U', 0);
    assert_false(is_on(s->editor, SWITCH_SECONDS));
    float frame = (float)(layout_of(s->editor)->plot.w / (plot_of(s->editor)->frame1 - plot_of(s->editor)->frame0));
    session_key(s, 'G', 0); // off the frames
    session_pull(s, "knot(sway,0)", 2.25f * frame, 0, 3);
    assert_near(spline(s, 0)->knots[0].frame, 12.25, 1e-3);
    s->mods = MOD_CTRL;
    session_drag(s, 0.1f * frame, 0, 1);
    assert_near(spline(s, 0)->knots[0].frame, 12, 1e-9);
    session_release(s, BUTTON_LEFT);
}

SESSION_TEST(test_normalised_curves_keep_their_picture, session_open(s, FIVE))
{
    session_key(s, 'N', 0);
    const float(*line)[2] = (const float(*)[2])s->editor->curves->cache.others[0];
    int count = s->editor->curves->cache.count;
    float low = line[0][1], high = line[0][1], own_low = 1e9f, own_high = -1e9f;
    for (int c = 0; c < count; c++) {
        low = fminf(low, line[c][1]);
        high = fmaxf(high, line[c][1]);
        own_low = fminf(own_low, s->editor->curves->cache.re[c][1]);
        own_high = fmaxf(own_high, s->editor->curves->cache.re[c][1]);
    }
    assert_near(low, own_low, 1.5); // as high as the active one
    assert_near(high, own_high, 1.5);
    float before = line[count / 2][1];
    session_key(s, KEY_PAGE_DOWN, 0);
    assert_int_equal(active(s->editor), 1);
    assert_near(s->editor->curves->cache.re[count / 2][1], before, 1.5); // nothing jumps
}

/// A knot where the curve is, and with Shift a pose, leaves every sample where it was.
SESSION_TEST(test_double_click_on_the_curve_keeps_it, session_open(s, FIVE))
{
    for (unsigned mods = 0; mods <= MOD_SHIFT; mods += MOD_SHIFT) {
        double before[97];
        char target[64];
        int frame = mods ? 52 : 24, count = spline(s, 0)->knot_count;
        memcpy(before, s->work.evaluation.curves[0].total, sizeof before);
        snprintf(target, sizeof target, "curve(sway,%d,%.9g)", frame, before[frame]);
        s->mods = mods;
        session_click(s, target);
        session_click_here(s, 2);
        assert_int_equal(spline(s, 0)->knot_count, count + 1);
        int k = selection_single(selection_of(s->editor), spline(s, 0));
        assert_near(spline(s, 0)->knots[k].frame, frame, 0);
        assert_int_equal(spline(s, 0)->knots[k].has_phase, mods != 0);
        for (int i = 0; i < 97; i++) assert_near(s->work.evaluation.curves[0].total[i], before[i], 1e-6);
    }
    char other[64];
    snprintf(other, sizeof other, "curve(up,35,%.9g)", s->work.evaluation.curves[1].total[35]);
    s->mods = MOD_CTRL; // off frames, which leaves the active spline as it is until the second click
    session_click(s, other);
    session_click_here(s, 2);
    assert_int_equal(active(s->editor), 1);
    assert_int_equal(spline(s, 1)->knot_count, 3);
}

/// Inserts a knot or pose on the first spline at a frame; returns the curve's largest change.
static double change_by_a_knot(const char *settings, int frame, bool pose)
{
    char scene[1024];
    double before[97], most = 0;
    struct session s;
    snprintf(scene, sizeof scene,
             "{\"frames\": [0, 96], \"splines\": [{\"name\": \"x\", %s, \"knots\": [{\"frame\": 0, \"value\": 0},"
             "{\"frame\": 20, \"value\": 1}, {\"frame\": 50, \"value\": -0.4}]}, {\"name\": \"y\", \"mode\": "
             "\"cubic\", \"start\": \"loop\", \"knots\": [{\"frame\": 10, \"value\": 0}, {\"frame\": 60, "
             "\"value\": 1}]}]}",
             settings);
    session_open(&s, scene);
    for (int f = 0; f < frame; f++) session_key(&s, KEY_RIGHT, 0);
    memcpy(before, s.work.evaluation.curves[0].total, sizeof before);
    session_key(&s, 'I', pose ? MOD_SHIFT : 0);
    const int at = spline_find_knot(s.document, spline(&s, 0), frame);
    const bool swings = spline_mode(spline(&s, 0)) == WIGGLY_COMPLEX;
    assert_true((at >= 0) == (swings || !pose)); // the others have no phase that a pose could hold
    assert_true(at < 0 || spline(&s, 0)->knots[at].has_phase == pose);
    assert_true((strstr(said(s.editor), "Only a wiggly spline") != NULL) == (at < 0));
    for (int i = 0; i < 97; i++) most = fmax(most, fabs(s.work.evaluation.curves[0].total[i] - before[i]));
    session_close(&s);
    return most;
}

/// I and Shift+I in every mode, with a start of every kind, and on an equilibrium that moves. Behind the last knot an oscillation dies away
/// and a cubic is held, until a knot is there. With wind-up the curve swings freely until half a period before a knot.
TEST(test_a_knot_on_the_curve_keeps_it)
{
    static const struct kind {
        const char *settings;
        int last; ///< frame of a knot
        double change;
    } kinds[] = {
        {"\"mode\": \"real\", \"frequency\": 1", 95, 1e-6},
        {"\"mode\": \"real\", \"spring\": 30, \"friction\": 14, \"equilibrium\": {\"spline\": \"y\"}", 95, 1e-6},
        {"\"mode\": \"cubic\", \"equilibrium\": {\"spline\": \"y\"}", 49, 1e-6},
        {"\"frequency\": 1.3, \"damping\": 0.1, \"start\": \"rest\"", 49, 1e-6},
        {"\"frequency\": 1.3, \"damping\": 0.1, \"equilibrium\": {\"spline\": \"y\"}", 49, 1e-6},
        {"\"frequency\": 1.3, \"damping\": 0.1, \"equilibrium\": {\"spline\": \"y\"}, \"start\": \"loop\"", 95, 1e-6},
        {"\"frequency\": 1.3, \"damping\": 0.1, \"equilibrium\": {\"spline\": \"y\"}, \"passive\": \"filter\"", 95,
         1e-6},
        {"\"frequency\": 1.3, \"damping\": 0.1, \"wind_up\": 0.5", 35, 5e-3},
    };
    for (const struct kind *kind = kinds; kind < kinds + sizeof kinds / sizeof *kinds; kind++) {
        for (int frame = 5; frame <= kind->last; frame += 30) {
            for (int pose = 0; pose < 2; pose++)
                assert_near(change_by_a_knot(kind->settings, frame, pose), 0, kind->change);
        }
    }
}

/// As a cubic, by its mode or shown as one, it stays behind its last knot where that put it: a tail does not wind through its body.
TEST(test_a_cubic_holds_its_last_value)
{
    static const char *const ways[] = {"VV", "VV", "MM"};
    for (int way = 0; way < 3; way++) {
        struct session s;
        session_open(&s, FIVE);
        if (way == 1)
            session_key(&s, 'M', MOD_SHIFT); // the paper's cubic goes straight on, but V does not show that one
        for (const char *key = ways[way]; *key; key++) session_key(&s, *key, 0);
        session_frame(&s);
        const wiggly_curve *curve = &s.work.evaluation.curves[0];
        assert_int_equal(curve->mode, WIGGLY_CUBIC);
        for (int i = 60; i <= 96; i++) assert_near(curve->total[i], 0, 1e-12);
        assert_true(fabs(curve->total[50]) > 0.01);
        session_close(&s);
    }
}

/// The first and the last as well as those between, of the active curve and of the others.
SESSION_TEST(test_every_knot_is_drawn, session_open(s, FIVE))
{
    session_frame(s);
    const struct drawlist *list = drawn_by(s->editor);
    for (int i = 0; i < 2; i++) {
        for (int k = 0; k < spline(s, i)->knot_count; k++) {
            char target[32];
            float x, y;
            int drawn = 0;
            snprintf(target, sizeof target, "knot(%s,%d)", spline(s, i)->name, k);
            assert_done(editor_target(s->editor, target, &x, &y, &error));
            for (int c = 0; c < list->count; c++) {
                const struct draw_command *command = &list->commands[c];
                if (command->kind != DRAW_CONVEX || command->count != 4) continue;
                const float *p = list->points + 2 * command->first; // top, right, bottom, left
                drawn += fabsf((p[0] + p[4]) / 2 - x) < 0.5f && fabsf((p[1] + p[5]) / 2 - y) < 0.5f;
            }
            if (drawn != 1) fail_msg("%s is drawn %d times", target, drawn);
        }
    }
}

/// Twelve curves that end at the same height in the lowest panel there is.
TEST(test_labels_never_overlap)
{
    char scene[4096];
    size_t at = (size_t)snprintf(scene, sizeof scene, "{\"wiggly\":1,\"frames\":[0,48],\"splines\":[");
    for (int i = 0; i < 12; i++) {
        at += (size_t)snprintf(scene + at, sizeof scene - at,
                               "%s{\"name\":\"s%d\",\"mode\":\"cubic\",\"knots\":[{\"frame\":%d,\"value\":1}]}",
                               i ? "," : "", i, i);
    }
    snprintf(scene + at, sizeof scene - at, "]}");
    struct session s;
    panel_open(&s, scene, 640, 300);
    const struct drawlist *list = drawn_by(s.editor);
    const struct rect plot = layout_of(s.editor)->plot;
    float last = plot.y - 20;
    int labels = 0;
    for (int i = 0; i < list->count; i++) {
        const struct draw_command *c = &list->commands[i];
        bool beside = c->kind == DRAW_TEXT && c->x > plot.x + plot.w && c->x < layout_of(s.editor)->inspector.x;
        if (!beside || c->y < plot.y || c->y > plot.y + plot.h + 8) continue;
        assert_true(c->y - last > 13);
        last = c->y;
        labels++;
    }
    assert_true(labels >= 3);
    assert_true(last <= plot.y + plot.h);
    session_close(&s);
}

/// Where the view is and where a knot is in it: 0 … 1 from the bottom up.
static double height_of(const struct session *s, int i, int k)
{
    const struct plotted *view = plot_of(s->editor);
    return (spline(s, i)->knots[k].value - view->value0) / (view->value1 - view->value0);
}

/// What is inserted, pasted or nudged out of sight comes into it in small steps, and the panel keeps still under a drag.
SESSION_TEST(test_the_view_follows_edits_smoothly, session_open(s, FIVE))
{
    const struct plotted *view = plot_of(s->editor);
    struct plotted before = *view;
    session_click(s, "ruler(80)");
    session_send(s, (struct event){.kind = EVENT_PASTE, .text = "0,6\n"});
    session_frame(s);
    assert_near(view->value1, before.value1, 1e-9); // it is solved now, and only then the way begins
    double last = view->value1, largest = 0;
    int frames = 0;
    for (; frames < 120 && curves_wants_frames(s->editor->curves); frames++) {
        session_frame(s);
        assert_true(view->value1 >= last);
        largest = fmax(largest, view->value1 - last);
        last = view->value1;
    }
    assert_true(frames > 10 && frames < 60);
    assert_true(largest < 0.35 * (last - before.value1));
    assert_true(height_of(s, 0, 5) < 0.97);
    assert_near(view->frame1, before.frame1, 1e-9);
    before = *view;
    session_pull(s, "knot(sway,5)", 0, -60, 6); // out at the top
    assert_true(height_of(s, 0, 5) > 1);
    assert_near(view->value1, before.value1, 0);
    session_release(s, BUTTON_LEFT);
    for (int i = 0; i < 60; i++) session_frame(s);
    assert_true(height_of(s, 0, 5) < 0.97);
    before = *view;
    session_key(s, KEY_DOWN, MOD_ALT); // what stays in sight moves nothing
    for (int i = 0; i < 10; i++) session_frame(s);
    assert_near(view->value1, before.value1, 0);
}

/// The whole of the spline's curve is in sight once the view has come to rest.
static void assert_in_sight(struct session *s, int i)
{
    const struct plotted *view = plot_of(s->editor);
    for (int frame = 0; frame < 90; frame++) session_frame(s);
    for (int sample = 0; sample < document_samples(s->document); sample++) {
        const double total = s->world.evaluation->curves[i].total[sample];
        assert_true(total < view->value1 && total > view->value0);
    }
}

/// Of the scene that the program begins with.
static const char SWAY[] =
    "{\"wiggly\": 1, \"frames\": [0, 120], \"splines\": [{\"name\": \"sway\", \"frequency\": 1, \"damping\": 0.08,"
    "\"bandwidth\": 0.08, \"start\": \"loop\", \"knots\": [{\"frame\": 8, \"value\": 1}, {\"frame\": 20, \"value\": "
    "-1.1},"
    "{\"frame\": 56, \"value\": 0.4}, {\"frame\": 82, \"value\": 0.2}, {\"frame\": 100, \"value\": -0.6}]}]}";

/// A found frequency, a chosen feel and a roll of the dice may swing far beyond what was seen.
SESSION_TEST(test_the_view_follows_another_feel, panel_open(s, SWAY, 1280, 2400))
{
    session_key(s, 'F', MOD_SHIFT);
    assert_in_sight(s, 0);
    panel_click(s, "preset.antenna");
    assert_in_sight(s, 0);
    panel_click(s, "section.variation");
    panel_enter(s, "variation", "1");
    panel_click(s, "variation.roll");
    assert_in_sight(s, 0);
}

/// What was copied behind the end is in sight, and so is all that was before.
SESSION_TEST(test_the_view_follows_a_longer_scene, session_open(s, FIVE))
{
    const struct plotted *view = plot_of(s->editor);
    const double left = view->frame0;
    session_key(s, 'A', MOD_CTRL);
    session_key(s, 'D', MOD_CTRL);
    assert_true(s->document->last_frame > 96);
    for (int i = 0; i < 60; i++) session_frame(s);
    assert_true(view->frame1 > s->document->last_frame);
    assert_near(view->frame0, left, 1e-9);
}

/// The active spline's imaginary part, too, is inside of the panel at first.
SESSION_TEST(
    test_all_that_is_drawn_is_framed,
    session_open(s, "{\"wiggly\": 1, \"frames\": [0, 3], \"splines\": [{\"name\": \"sway\", \"frequency\": 1,"
                    "\"damping\": 0.02, \"knots\": [{\"frame\": 0, \"value\": 0}, {\"frame\": 1, \"value\": 0.3},"
                    "{\"frame\": 2, \"value\": 0.58}]}]}"))
{
    const struct curve_cache *cache = &s->editor->curves->cache;
    const struct rect *plot = &layout_of(s->editor)->plot;
    session_key(s, KEY_HOME, 0);
    assert_true(cache->count > 100);
    for (int c = 0; c < cache->count; c++) {
        assert_true(cache->im[c][1] > plot->y + 4 && cache->im[c][1] < plot->y + plot->h - 4);
        assert_true(cache->re[c][1] > plot->y + 4 && cache->re[c][1] < plot->y + plot->h - 4);
    }
}

/// Where bands in the active spline's colour begin and end, in frames; returns how many there are.
static int find_bands(const struct session *s, double ends[4][2])
{
    const struct core *core = &s->editor->core;
    const float left = curves_x(s->editor->curves, core, 0);
    const float frame = curves_x(s->editor->curves, core, 1) - left;
    const uint32_t rgb = spline_list_color(core->document, core->focus.active) >> 8;
    int count = 0;
    for (int i = 0; i < core->list.count && count < 4; i++) {
        const struct draw_command *c = &core->list.commands[i];
        if (c->kind != DRAW_RECT || c->color >> 8 != rgb || c->bounds.h < core->view.layout.plot.h - 1) continue;
        ends[count][0] = (double)((c->bounds.x - left) / frame);
        ends[count++][1] = (double)((c->bounds.x + c->bounds.w - left) / frame);
    }
    return count;
}

/// The wind-up before a selected knot is a band: half a period, no longer than to the knot before, in a loop also round the seam.
SESSION_TEST(test_the_wind_up_of_a_selected_knot_is_a_band,
             session_open(s,
                          "{\"wiggly\": 1, \"frames\": [0, 96], \"splines\": [{\"name\": \"sway\", \"frequency\": 1,"
                          "\"wind_up\": 0.5, \"start\": \"loop\", \"knots\": [{\"frame\": 4, \"value\": 0},"
                          "{\"frame\": 40, \"value\": 1}, {\"frame\": 47, \"value\": -1}]}]}"))
{
    static const double expected[][2][2] = {{{0, 4}, {88, 96}}, {{28, 40}}, {{40, 47}}};
    double ends[4][2];
    session_click(s, "curve(sway,70,0.9)");
    assert_int_equal(find_bands(s, ends), 0);
    for (int k = 0; k < 3; k++) {
        char target[32];
        snprintf(target, sizeof target, "knot(sway,%d)", k);
        session_click(s, target);
        const int count = find_bands(s, ends);
        assert_int_equal(count, k == 0 ? 2 : 1);
        for (int b = 0; b < count; b++) {
            const int of = count == 2 && ends[b][0] > 50 ? 1 : 0;
            for (int e = 0; e < 2; e++) assert_near(ends[b][e], expected[k][of][e], 0.3);
        }
    }
    session_key(s, 'Z', MOD_CTRL);
    document_own_spline(s->document, 0)->parameter[PARAMETER_WIND_UP].value = 0;
    session_frame(s);
    assert_int_equal(find_bands(s, ends), 0);
}
