/// The curves panel as an animator uses it: boxes, scaling, retiming, other curves, ruler; what it draws, where its view goes, and splines of
/// thousands of knots.
#include "editor/core/core.h"
#include "five_knots.h"
#include "hands.h"

/// Already while the box grows, and where it shrinks again; then with modifiers.
WALK(a_box_selects_adds_and_removes, session_open(s, FIVE),
     "press curve(sway,15,1.4); hover curve(sway,35,-1.2); sway.picked 0 1 1 0 0; hover curve(sway,25,-1.2);"
     "sway.picked 0 1 0 0 0; release; with Shift; box curve(sway,45,1.4) curve(sway,65,-1.2); sway.picked 0 1 0 0 1;"
     "with Ctrl; box curve(sway,16,1.4) curve(sway,24,-1.2); sway.picked 0 0 0 0 1;"
     "with Alt; box curve(sway,55,0.3) curve(sway,66,-0.4); sway.picked 0 0 0 0 0; label")

WALK(escape_takes_a_box_back_and_a_click_clears, session_open(s, FIVE),
     "click knot(sway,3); press curve(sway,7,1.4); hover curve(sway,35,-1.2); sway.picked 1 1 1 0 0;"
     "key Escape; sway.picked 0 0 0 1 0; release; click curve(sway,66,-1.2); sway.picked 0 0 0 0 0")

/// And the same press drags it.
WALK(a_knot_of_another_curve_makes_it_active, session_open(s, FIVE),
     "active 0; press knot(up,1); active 1; drag 0 -20; release; up.1.value > 0.8")

/// The knots on 10, 20 and 30.
#define FIRST_THREE "box curve(sway,7,1.4) curve(sway,35,-1.2);"

/// About the middle of 10 … 30; the shape is stretched with the knots.
WALK(scaling_by_a_typed_factor, session_open(s, FIVE),
     FIRST_THREE
     "keep; type sx1.3; key Enter; sway.frame 7 20 33 40 60; sway.1.value 1 ~0; sway.1.slope 1.5384615 ~1e-5;"
     "once; keep; type sy-2; key Enter; sway.frame 7 20 33 40 60; sway.1.value -2; sway.2.value 2;"
     "sway.1.slope -3.0769231 ~1e-5; once")

/// One and a half times as far; a click keeps it.
WALK(scaling_by_pointer_about_the_playhead, session_open(s, FIVE),
     "click ruler(20); key Ctrl+A; point curve(sway,40,0); type spx; hover curve(sway,50,0.7);"
     "sway.frame 5 20 35 50 80; click; open 0; sway.frame 5 20 35 50 80")

/// In reverse order.
WALK(scaling_can_mirror_and_be_taken_back, session_open(s, FIVE),
     FIRST_THREE "keep; type sx-1; wait 1; sway.value -1 1 0 0.5 0; sway.1.slope -2 ~1e-5; sway.picked 1 1 1 0 0;"
                 "key Escape; kept; label")

/// 2 would put one on 40, which is not selected; 0 all on one frame; 9 leads out of the range.
WALK(scaling_never_swallows_a_knot, session_open(s, FIVE),
     FIRST_THREE
     "keep; type sx2; key Enter; kept; type sx0; key Enter; kept; type sx9; key Enter; kept; sway.knots 5")

/// It stops behind the knot that stays, and at the end of the range.
WALK(a_ripple_moves_what_comes_after, session_open(s, FIVE),
     "keep; press knot(sway,2); key R X; drag 7f 0 7; sway.frame 10 20 37 47 67; key R; sway.frame 10 20 37 40 60;"
     "key R; drag -30f 0 10; sway.frame 10 20 21 31 51; drag 200f 0 10; sway.frame 10 20 66 76 96;"
     "said end of the range; release; sway.3.value 0.5 ~0; once")

SESSION_TEST(ruler_units_and_snap, session_open(s, FIVE))
{
    session_move(s, layout_of(s->editor)->ruler.x - 20, layout_of(s->editor)->ruler.y + 8);
    hands(s, "click; seconds 1; key U; seconds 0; key G; pull knot(sway,0) 2.25f 0 3; sway.0.frame 12.25 ~1e-3;"
             "with Ctrl; drag 0.1f 0 1; sway.0.frame 12"); // off the frames
}

SESSION_TEST(normalised_curves_keep_their_picture, session_open(s, FIVE))
{
    hands(s, "key N");
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
    hands(s, "key PageDown; active 1");
    assert_near(s->editor->curves->cache.re[count / 2][1], before, 1.5); // nothing jumps
}

/// A knot where the curve is, and with Shift a pose, leaves every sample where it was. With Ctrl it may be off frames, and the active spline stays
/// until the second click.
SESSION_TEST(double_click_on_the_curve_keeps_it, session_open(s, FIVE))
{
    static const struct {
        const char *mods, *spline, *expected;
        int frame;
    } rows[] = {
        {"", "sway", "sway.frame 10 20 24 30 40 60; sway.picked 0 0 1 0 0 0; sway.2.posed 0; steady 1e-6", 24},
        {"Shift", "sway", "sway.frame 10 20 24 30 40 52 60; sway.picked 0 0 0 0 0 1 0; sway.5.posed 1; steady 1e-6",
         52},
        {"Ctrl", "up", "active 1; up.knots 3", 35}};
    for (int i = 0; i < 3; i++) {
        const double value = s->work.evaluation.curves[i == 2].total[rows[i].frame];
        hands(s, "keep; with %s; click curve(%s,%d,%.9g); active 0; again; %s", rows[i].mods, rows[i].spline,
              rows[i].frame, value, rows[i].expected);
    }
}

/// I and Shift+I in every mode, with a start of every kind, and on an equilibrium that moves. Behind the last knot an oscillation dies away
/// and a cubic is held, until a knot is there. With wind-up the curve swings freely until half a period before a knot.
TEST(a_knot_on_the_curve_keeps_it)
{
#define SWINGS "'frequency': 1.3, 'damping': 0.1, "
#define MOVES "'equilibrium': {'spline': 'y'}"
    static const struct kind {
        const char *settings;
        int last; ///< frame of a knot
        double change;
        bool swings; ///< else there is no phase that a pose could hold
    } kinds[] = {
        {"'mode': 'real', 'frequency': 1", 95, 1e-6, false},
        {"'mode': 'real', 'spring': 30, 'friction': 14, " MOVES, 95, 1e-6, false},
        {"'mode': 'cubic', " MOVES, 49, 1e-6, false},
        {SWINGS "'start': 'rest'", 49, 1e-6, true},
        {SWINGS MOVES, 49, 1e-6, true},
        {SWINGS MOVES ", 'start': 'loop'", 95, 1e-6, true},
        {SWINGS MOVES ", 'passive': 'filter'", 95, 1e-6, true},
        {SWINGS "'wind_up': 0.5", 35, 5e-3, true},
    };
    for (const struct kind *kind = kinds; kind < kinds + sizeof kinds / sizeof *kinds; kind++) {
        char scene[1024];
        struct session session, *const s = &session;
        snprintf(scene, sizeof scene,
                 "{'frames': [0, 96], 'splines': [{'name': 'x', %s, 'knots': [<0 0>, <20 1>, <50 -0.4>]}, {'name': "
                 "'y', 'mode': 'cubic', 'start': 'loop', 'knots': [<10 0>, <60 1>]}]}",
                 kind->settings);
        session_open(s, scene);
        for (int frame = 5; frame <= kind->last; frame += 30) {
            const int k = frame < 20 ? 1 : frame < 50 ? 2 : 3;
            hands(s, "seek %d; keep", frame);
            for (int pose = 0; pose <= kind->swings; pose++)
                hands(s, "key %s; x.%d.frame %d; x.%d.posed %d; steady %g; key Ctrl+Z; kept", pose ? "Shift+I" : "I",
                      k, frame, k, pose, kind->change);
            if (!kind->swings) hands(s, "key Shift+I; kept; said Only a wiggly spline");
        }
        session_close(s);
    }
}

/// As a cubic, by its mode or shown as one, it stays behind its last knot where that put it: a tail does not wind through its body. The paper's
/// cubic goes straight on, but V does not show that one.
TEST(a_cubic_holds_its_last_value)
{
    static const char *const ways[] = {"V V", "M V V", "M M"};
    for (int way = 0; way < 3; way++) {
        struct session session, *const s = &session;
        session_open(s, FIVE);
        hands(s, "key %s; wait 1", ways[way]);
        const wiggly_curve *curve = &s->work.evaluation.curves[0];
        double most = 0; // behind the last knot
        for (int i = 60; i <= 96; i++) most = fmax(most, fabs(curve->total[i]));
        if (curve->mode != WIGGLY_CUBIC || !(most <= 1e-12) || fabs(curve->total[50]) <= 0.01)
            fail_msg("%s: up to %g behind the last knot", ways[way], most);
        session_close(s);
    }
}

/// The first and the last as well as those between, of the active curve and of the others.
SESSION_TEST(every_knot_is_drawn, session_open(s, FIVE))
{
    session_frame(s);
    const struct drawlist *list = drawn_by(s->editor);
    for (int k = 0; k < 7; k++) {
        char target[32];
        float xy[2];
        int drawn = 0;
        snprintf(target, sizeof target, k < 5 ? "knot(sway,%d)" : "knot(up,%d)", k % 5);
        session_where(s, target, xy);
        EACH_DRAWN(c, s->editor)
        {
            if (c->kind != DRAW_CONVEX || c->count != 4) continue;
            const float *p = list->points + 2 * c->first; // top, right, bottom, left
            drawn += fabsf((p[0] + p[4]) / 2 - xy[0]) < 0.5f && fabsf((p[1] + p[5]) / 2 - xy[1]) < 0.5f;
        }
        if (drawn != 1) fail_msg("%s is drawn %d times", target, drawn);
    }
}

/// Where a knot of the first spline is in the view: 0 … 1 from the bottom up.
static double height_of(const struct session *s, int k)
{
    const struct plotted *view = plot_of(s->editor);
    return (spline(s, 0)->knots[k].value - view->value0) / (view->value1 - view->value0);
}

/// What is inserted, pasted or nudged out of sight comes into it in small steps, and the panel keeps still under a drag.
SESSION_TEST(the_view_follows_edits_smoothly, session_open(s, FIVE))
{
    const struct plotted *view = plot_of(s->editor);
    struct plotted before = *view;
    hands(s, "click ruler(80); paste 0,6");
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
    assert_true(height_of(s, 5) < 0.97);
    assert_near(view->frame1, before.frame1, 1e-9);
    before = *view;
    hands(s, "pull knot(sway,5) 0 -60 6"); // out at the top
    assert_true(height_of(s, 5) > 1);
    assert_near(view->value1, before.value1, 0);
    hands(s, "release; wait 60");
    assert_true(height_of(s, 5) < 0.97);
    before = *view;
    hands(s, "key Alt+Down; wait 10"); // what stays in sight moves nothing
    assert_near(view->value1, before.value1, 0);
}

/// The whole of the first spline's curve is in sight once the view has come to rest.
static void assert_in_sight(struct session *s, const char *after)
{
    const struct plotted *view = plot_of(s->editor);
    hands(s, "%s; wait 90", after);
    for (int sample = 0; sample < document_samples(s->document); sample++) {
        const double total = s->world.evaluation->curves[0].total[sample];
        if (total >= view->value1 || total <= view->value0) fail_msg("%s: %g is out of sight", after, total);
    }
}

/// A found frequency, a chosen feel and a roll of the dice may swing far beyond what was seen. The scene that the program begins with.
SESSION_TEST(
    the_view_follows_another_feel,
    panel_open(s,
               "{'wiggly': 1, 'frames': [0, 120], 'splines': [{'name': 'sway', 'frequency': 1, 'damping': 0.08, "
               "'bandwidth': 0.08, 'start': 'loop', 'knots': [<8 1>, <20 -1.1>, <56 0.4>, <82 0.2>, <100 -0.6>]}]}",
               1280, 2400))
{
    assert_in_sight(s, "key Shift+F");
    assert_in_sight(s, "click preset.antenna");
    assert_in_sight(s, "click section.variation; enter variation 1; click variation.roll");
}

/// What was copied behind the end is in sight, and so is all that was before.
SESSION_TEST(the_view_follows_a_longer_scene, session_open(s, FIVE))
{
    const struct plotted *view = plot_of(s->editor);
    const double left = view->frame0;
    hands(s, "key Ctrl+A Ctrl+D; is frames.1 > 96; wait 60");
    assert_true(view->frame1 > s->document->last_frame);
    assert_near(view->frame0, left, 1e-9);
}

/// The active spline's imaginary part, too, is inside of the panel at first.
SESSION_TEST(all_that_is_drawn_is_framed,
             session_open(s,
                          "{'wiggly': 1, 'frames': [0, 3], 'splines': [{'name': 'sway', 'frequency': 1, 'damping': "
                          "0.02, 'knots': [<0 0>, <1 0.3>, <2 0.58>]}]}"))
{
    const struct curve_cache *cache = &s->editor->curves->cache;
    const struct rect *plot = &layout_of(s->editor)->plot;
    hands(s, "key Home");
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
    const float left = curves_x(core, 0);
    const float frame = curves_x(core, 1) - left;
    const uint32_t rgb = spline_list_color(core->document, core->focus.active) >> 8;
    int count = 0;
    EACH_DRAWN(c, s->editor)
    {
        if (count == 4 || c->kind != DRAW_RECT || c->color >> 8 != rgb || c->bounds.h < core->view.layout.plot.h - 1)
            continue;
        ends[count][0] = (double)((c->bounds.x - left) / frame);
        ends[count++][1] = (double)((c->bounds.x + c->bounds.w - left) / frame);
    }
    return count;
}

/// The wind-up before a selected knot is a band: half a period, no longer than to the knot before, in a loop also round the seam.
SESSION_TEST(the_wind_up_of_a_selected_knot_is_a_band,
             session_open(s, "{'wiggly': 1, 'frames': [0, 96], 'splines': [{'name': 'sway', 'frequency': "
                             "1, 'wind_up': 0.5, 'start': 'loop', 'knots': [<4 0>, <40 1>, <47 -1>]}]}"))
{
    static const double expected[][2][2] = {{{0, 4}, {88, 96}}, {{28, 40}}, {{40, 47}}};
    double ends[4][2];
    hands(s, "click curve(sway,70,0.9)");
    assert_int_equal(find_bands(s, ends), 0);
    for (int k = 0; k < 3; k++) {
        hands(s, "click knot(sway,%d)", k);
        const int count = find_bands(s, ends);
        assert_int_equal(count, k == 0 ? 2 : 1);
        for (int b = 0; b < count; b++) {
            const int of = count == 2 && ends[b][0] > 50 ? 1 : 0;
            for (int e = 0; e < 2; e++) assert_near(ends[b][e], expected[k][of][e], 0.3);
        }
    }
    hands(s, "key Ctrl+Z");
    document_own_spline(s->document, 0)->parameter[PARAMETER_WIND_UP].value = 0;
    session_frame(s);
    assert_int_equal(find_bands(s, ends), 0);
}

// --- thousands of knots ---

enum { CROWD = 30000 };

/// A spline of so many knots, and another of two before it.
static void open_crowd(struct session *s, int knots)
{
    const size_t room = 256 + (size_t)knots * 40;
    char *scene = malloc(room);
    assert_non_null(scene);
    size_t at = (size_t)sprintf(scene,
                                "{'wiggly': 1, 'frames': [0, %d], 'splines': [{'name': 'few', 'knots': [<3 2>, <9 "
                                "1>]}, {'name': 'many', 'mode': 'cubic', 'knots': [",
                                knots);
    for (int k = 0; k < knots; k++)
        at += (size_t)sprintf(scene + at, "%s{'frame': %d, 'value': %d}", k ? "," : "", k, k * 7919 % 1009);
    strcpy(scene + at, "]}]}");
    panel_open(s, scene, 1280, 900);
    activate(s->editor, 1);
    free(scene);
}

/// By a look at all of them.
static void assert_walked(struct session *s)
{
    struct core *core = &s->editor->core;
    int expected = 0;
    session_frame(s);
    struct knot_place at = SELECTED_START;
    for (int of = 0; of < s->document->spline_count; of++) {
        for (int k = 0; k < spline(s, of)->knot_count; k++) {
            if (!selection_has(&core->focus.selection, spline(s, of)->knots[k].id)) continue;
            expected++;
            assert_true(selected_next(core, &at));
            assert_int_equal(at.spline, of);
            assert_int_equal(at.knot, k);
        }
    }
    assert_false(selected_next(core, &at));
    assert_int_equal(selected_count(core), expected);
}

SESSION_TEST(edits_and_selections_are_found, open_crowd(s, CROWD))
{
    struct core *core = &s->editor->core;
    struct selection *selection = &core->focus.selection;
    assert_walked(s);
    selection_set(selection, spline(s, 1)->knots[CROWD - 1].id, true);
    assert_walked(s);
    hands(s, "key Up"); // its value
    assert_walked(s);
    selection_set(selection, spline(s, 1)->knots[100].id, true);
    selection_set(selection, spline(s, 0)->knots[1].id, true);
    assert_walked(s);
    core_activate(core, 0);
    assert_walked(s);
    core_activate(core, 1);
    selection_set(selection, spline(s, 1)->knots[100].id, true);
    core_delete(core); // indices move
    assert_true(spline(s, 1)->knot_count < CROWD);
    assert_walked(s);
    hands(s, "key Ctrl+Z");
    assert_walked(s);
    hands(s, "key Ctrl+A");
    assert_walked(s);
}

/// While a knot is dragged past others, and after.
SESSION_TEST(a_drag_is_found, open_crowd(s, 300))
{
    hands(s, "pull knot(many,150) 5 5 2");
    for (int i = 0; i < 30; i++) {
        session_drag(s, i < 20 ? 7 : -21, i % 2 ? 30 : -28, 1);
        assert_walked(s);
    }
    hands(s, "selected 1; release");
    assert_walked(s);
    hands(s, "key Ctrl+Z");
    assert_walked(s);
}

/// Of a crowd each pixel column shows one knot, and the highest and lowest value are reached by its stroke.
SESSION_TEST(a_crowd_is_drawn_as_columns, open_crowd(s, CROWD))
{
    session_frame(s);
    const int few = drawn_by(s->editor)->point_count;
    session_close(s);
    open_crowd(s, 3 * CROWD);
    session_frame(s);
    const int many = drawn_by(s->editor)->point_count;
    assert_true(many < few + few / 4);
}

/// Opens a scene of one spline with a knot every `gap` frames, whose values come again and again.
static void open_crowded(struct session *s, int knots, int gap, const int *values, int period)
{
    static char scene[400000];
    char *end =
        scene + sprintf(scene, "{'wiggly':1, 'frames':[0,%d], 'splines':[{'name':'sway', 'knots':[", knots * gap);
    for (int i = 0; i < knots; i++)
        end += sprintf(end, "%s{'frame':%d, 'value':%d}", i ? "," : "", gap * i, values[i % period]);
    strcpy(end, "]}]}");
    session_open(s, scene);
}

/// 2,400 knots on 900 pixels, three of them a swing: some are marked, and each can still be clicked.
TEST(of_crowded_knots_some_are_marked_and_each_is_hit)
{
    static const int values[] = {0, 1, 2};
    struct session s;
    open_crowded(&s, 2400, 1, values, 3);
    int diamonds = 0;
    EACH_DRAWN(c, s.editor) diamonds += c->kind == DRAW_CONVEX;
    assert_in_range(diamonds, 51, 149);
    for (int k = 1000; k < 1003; k++) hands(&s, "click knot(sway,%d); selected 1; sway.%d.picked 1", k, k);
    session_close(&s);
}

/// Swings finer than a pixel are drawn as the band that they fill, also where a swing takes two columns, half a swing each; and a
/// curve that can be followed stays a line.
TEST(swings_finer_than_a_column_are_a_band)
{
    static const int values[] = {-1, -1, 1, 1};
    struct session s;
    open_crowded(&s, 3200, 2, values, 4);
    const struct rect plot = layout_of(s.editor)->plot;
    for (double frames = 6400; frames > 3200; frames *= 0.97) {
        *plot_of(s.editor) = (struct plotted){0, frames, -2, 2};
        session_frame(&s);
        const struct draw_command *band = NULL;
        EACH_DRAWN(c, s.editor) if (c->kind == DRAW_BAND && c->width > 2.4f) band = c;
        if (!band) fail_msg("no band with %g frames in sight", frames);
        const float *xy = drawn_by(s.editor)->points + 2 * band->first;
        const float apart = (xy[2 * band->count - 2] - xy[0]) / (float)(band->count - 1);
        for (int c = 2; c + 3 < band->count; c++) {
            const float high = fminf(xy[2 * c + 1], xy[2 * c + 3]), low = fmaxf(xy[2 * c + 1], xy[2 * c + 3]);
            if (high > plot.y + plot.h / 4 + 1 || low < plot.y + 3 * plot.h / 4 - 1)
                fail_msg("column %d with %g frames in sight is %g to %g", c, frames, high, low);
            assert_near(xy[2 * c + 2] - xy[2 * c], apart, 1e-3);
        }
    }
    *plot_of(s.editor) = (struct plotted){0, 240, -2, 2};
    session_frame(&s);
    EACH_DRAWN(c, s.editor) assert_int_not_equal(c->kind, DRAW_BAND);
    session_close(&s);
}
