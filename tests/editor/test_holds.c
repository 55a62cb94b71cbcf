/// What knots hold, through every edit that moves or copies them: poses keep their phase, which mirrors as their value does, still knots stay
/// still, and free ones free.
#include "panel_session.h"
#include "scene/edit.h"
#include "shown.h"

#include <stdlib.h>

#define HOLDING                                                                                                      \
    "{\"wiggly\": 2, \"frames\": [0, 120], \"splines\": [{\"name\": \"sway\", \"frequency\": 1, \"damping\": 0.1,"   \
    "\"knots\": [{\"frame\": 20, \"value\": 0.8, \"im\": 0.3}, {\"frame\": 34, \"value\": 0.5, \"settles\": true},"  \
    "{\"frame\": 50, \"still\": true}, {\"frame\": 64, \"value\": -0.6, \"im\": 0.45, \"slope\": 1}]}]}"

static void paste_cut(struct session *s)
{
    session_key(s, 'X', MOD_CTRL);
    char *text = strdup(copied(s->editor));
    assert_int_equal(s->document->splines[0]->knot_count, 0);
    playback_of(s->editor)->position = 30;
    session_send(s, (struct event){.kind = EVENT_PASTE, .text = text});
    session_frame(s);
    free(text);
}

static void scale(struct session *s, const char *factors)
{
    session_type(s, "s");
    session_type(s, factors);
    session_frame(s);
    session_key(s, KEY_ENTER, 0);
}

static void nudge_up(struct session *s) { session_key(s, KEY_UP, MOD_ALT); }
static void nudge_right(struct session *s) { session_key(s, KEY_RIGHT, MOD_ALT); }
static void drag_all(struct session *s) { session_carry(s, "knot(sway,0)", 30, -20, 4); }
static void drag_in_time(struct session *s) { session_carry(s, "knot(sway,3)", 40, 0, 4); }
static void mirror(struct session *s) { scale(s, "1 -1"); }
static void halve(struct session *s) { scale(s, "1 0.5"); }
static void squeeze(struct session *s) { scale(s, "0.5 1"); }
static void turn_round(struct session *s) { scale(s, "-1 1"); }
static void turn_and_mirror(struct session *s) { scale(s, "-1 -1"); }
static void duplicate(struct session *s) { session_key(s, 'D', MOD_CTRL); }
static void add_slopes(struct session *s) { session_key(s, 'T', 0); }
static void smooth(struct session *s) { session_key(s, 'T', MOD_CTRL); }

/// The phases of poses in the order of time after an edit of all knots, and how many times each knot is there.
static const struct edit {
    const char *name;
    void (*run)(struct session *s);
    double phases[4];
    int copies, steps;
} edits[] = {
    {"a nudge of values", nudge_up, {0.3, 0.45}, 1, 1},
    {"a nudge in time", nudge_right, {0.3, 0.45}, 1, 1},
    {"a drag", drag_all, {0.3, 0.45}, 1, 1},
    {"a drag in time", drag_in_time, {0.3, 0.45}, 1, 1},
    {"mirrored values", mirror, {-0.3, -0.45}, 1, 1},
    {"half the values", halve, {0.15, 0.225}, 1, 1},
    {"half the time", squeeze, {0.3, 0.45}, 1, 1},
    {"time turned round", turn_round, {-0.45, -0.3}, 1, 1}, // the swing turns the other way
    {"both turned round", turn_and_mirror, {0.45, 0.3}, 1, 1},
    {"copies behind them", duplicate, {0.3, 0.45, 0.3, 0.45}, 2, 1},
    {"cut and paste", paste_cut, {0.3, 0.45}, 1, 2},
    {"slopes", add_slopes, {0.3, 0.45}, 1, 1},
    {"smooth slopes", smooth, {0.3, 0.45}, 1, 1},
};

/// Whether a spline has those phases, and as many still and free knots as copies.
static void assert_held(const char *name, const struct spline *spline, const double *phases, int copies)
{
    int poses = 0, stills = 0, settling = 0;
    assert_int_equal(spline->knot_count, 4 * copies);
    for (int k = 0; k < spline->knot_count; k++) {
        const struct knot *knot = &spline->knots[k];
        stills += knot->still;
        settling += knot->settles;
        if (knot->still && (knot->has_slope || knot->has_phase)) fail_msg("%s: a still knot holds more", name);
        if (!knot->has_phase) continue;
        if (poses == 2 * copies || fabs(knot->phase - phases[poses]) > 1e-9)
            fail_msg("%s: the phase of pose %d is %g", name, poses, knot->phase);
        poses++;
    }
    if (poses != 2 * copies || stills != copies || settling != copies)
        fail_msg("%s: %d poses, %d still knots, %d that settle", name, poses, stills, settling);
}

TEST(test_edits_keep_what_knots_hold)
{
    static const double before[] = {0.3, 0.45};
    for (size_t e = 0; e < sizeof edits / sizeof *edits; e++) {
        struct session s;
        session_open(&s, HOLDING);
        session_key(&s, 'A', MOD_CTRL);
        const char *original = session_saved(&s);
        edits[e].run(&s);
        assert_held(edits[e].name, s.document->splines[0], edits[e].phases, edits[e].copies);
        assert_string_not_equal(session_saved(&s), original);
        for (int i = 0; i < edits[e].steps; i++) session_key(&s, 'Z', MOD_CTRL);
        assert_saved(&s, original);
        assert_held(edits[e].name, s.document->splines[0], before, 1);
        for (int i = 0; i < edits[e].steps; i++) session_key(&s, 'Y', MOD_CTRL);
        assert_held(edits[e].name, s.document->splines[0], edits[e].phases, edits[e].copies);
        session_close(&s);
    }
}

/// A knot made still keeps its value, unseen: edits of what is drawn leave it as it is, copies have it too, text does not.
TEST(test_a_still_knot_keeps_its_value)
{
    for (size_t e = 0; e < sizeof edits / sizeof *edits; e++) {
        struct session s;
        int kept = 0;
        session_open(&s, HOLDING);
        session_click(&s, "knot(sway,1)");
        session_key(&s, 'P', MOD_SHIFT);
        session_key(&s, 'A', MOD_CTRL);
        edits[e].run(&s);
        const struct spline *spline = s.document->splines[0];
        for (int k = 0; k < spline->knot_count; k++) kept += spline->knots[k].still && spline->knots[k].value == 0.5;
        if (kept != (edits[e].run == paste_cut ? 0 : edits[e].copies)) fail_msg("%s: %d", edits[e].name, kept);
        session_close(&s);
    }
}

/// Shift+P again, or the button. A knot that was loaded still has no value, so it stays where it is seen.
TEST(test_a_value_comes_back)
{
    static const struct row {
        const char *knot;
        double high; ///< set meanwhile
        double value;
        const char *said;
    } rows[] = {
        {"{\"frame\": 48, \"value\": 2.5}", INFINITY, 2.5, ""},
        {"{\"frame\": 48, \"value\": 2.5, \"im\": 0.3, \"slope\": 1}", INFINITY, 2.5, ""},
        {"{\"frame\": 48, \"value\": 2.5}", 2.25, 2.25, "Held by the limit 2.25"},
        {"{\"frame\": 48, \"still\": true}", INFINITY, 2, ""},
    };
    for (size_t i = 0; i < 2 * sizeof rows / sizeof *rows; i++) {
        const struct row *row = &rows[i / 2];
        const bool loaded = strstr(row->knot, "still");
        char scene[512];
        struct session s;
        snprintf(scene, sizeof scene,
                 "{\"wiggly\": 2, \"frames\": [0, 96], \"splines\": [{\"name\": \"sway\", \"frequency\": 1, "
                 "\"equilibrium\": 2, \"knots\": [{\"frame\": 24, \"value\": 2.125}, %s]}]}",
                 row->knot);
        session_open(&s, scene);
        session_click(&s, "knot(sway,1)");
        if (!loaded) session_key(&s, 'P', MOD_SHIFT);
        if (!loaded) assert_said(s.editor, "comes to rest at the equilibrium");
        assert_non_null(shown_text(s.editor, "Comes to rest at the equilibrium"));
        const struct knot *knot = &s.document->splines[0]->knots[1];
        assert_true(knot->still);
        assert_loads_again(s.document);
        assert_near(s.work.evaluation.curves[0].total[48], 2, 1e-9);
        if (row->high < INFINITY) {
            const struct param high = param_number(row->high);
            assert_done(edit_parameter(s.document, 0, PARAMETER_HIGH, &high, &error));
            session_frame(&s);
        }
        if (i % 2) panel_click(&s, "holds.value");
        if (i % 2 == 0) session_key(&s, 'P', MOD_SHIFT);
        knot = &s.document->splines[0]->knots[1];
        assert_false(knot->still || knot->has_phase || knot->has_slope);
        assert_near(knot->value, row->value, 1e-9);
        assert_said(s.editor, row->said);
        session_close(&s);
    }
}

/// Shift+F finds the same with the value that a still knot keeps as without one.
TEST(test_a_kept_value_explains_nothing)
{
    static const char *const knots[] = {"\"value\": 9", "\"still\": true"};
    double found[2];
    for (int i = 0; i < 2; i++) {
        char scene[512];
        struct session s;
        snprintf(scene, sizeof scene,
                 "{\"frames\": [0, 96], \"splines\": [{\"name\": \"sway\", \"frequency\": 1, \"equilibrium\": 2, "
                 "\"knots\": [{\"frame\": 0, \"value\": 3}, {\"frame\": 9, \"value\": 1.1}, {\"frame\": 18, "
                 "\"value\": 2.8}, {\"frame\": 27, \"value\": 1.3}, {\"frame\": 60, %s}]}]}",
                 knots[i]);
        session_open(&s, scene);
        session_click(&s, "knot(sway,4)");
        if (i == 0) session_key(&s, 'P', MOD_SHIFT);
        session_key(&s, 'F', MOD_SHIFT);
        assert_said(s.editor, "Best");
        found[i] = s.document->splines[0]->parameter[PARAMETER_FREQUENCY].value;
        session_close(&s);
    }
    assert_near(found[0], found[1], 0);
    assert_near(found[0], 24.0 / 18, 0.02);
}

/// Alt+P and the button, for all selected knots but still ones, in one step each.
SESSION_TEST(test_knots_settle_and_do_not, session_open(s, HOLDING))
{
    const char *original = session_saved(s);
    session_key(s, 'A', MOD_CTRL);
    session_key(s, 'P', MOD_ALT);
    for (int k = 0; k < 4; k++) assert_true(s->document->splines[0]->knots[k].settles == (k != 2));
    panel_click(s, "settles");
    for (int k = 0; k < 4; k++) assert_false(s->document->splines[0]->knots[k].settles);
    for (int i = 0; i < 2; i++) session_key(s, 'Z', MOD_CTRL);
    assert_saved(s, original);
    session_click(s, "knot(sway,2)");
    session_key(s, 'P', MOD_ALT);
    assert_said(s->editor, "no value to settle at");
    assert_saved(s, original);
}

TEST(test_edits_of_the_scene_keep_what_knots_hold)
{
    static const double phases[] = {0.3, 0.45};
    struct document *document = document_of_text(HOLDING);
    assert_done(edit_spline_copy(document, 0, &error));
    assert_held("a copy", document->splines[1], phases, 1);
    assert_done(edit_fps(document, 48, true, &error));
    assert_held("another rate", document->splines[0], phases, 1);
    assert_done(edit_range(document, 40, 240, RANGE_MOVE, &error));
    assert_held("a shorter range", document->splines[0], phases, 1);
    assert_loads_again(document);
    document_destroy(document);
}

/// T goes by the knots that can have a slope, and aims at where a still knot is, not at 0.
TEST(test_slopes_beside_a_still_knot)
{
    struct session s;
    session_open(
        &s, "{\"wiggly\": 2, \"frames\": [0, 96], \"splines\": [{\"name\": \"sway\", \"frequency\": 1, \"damping\": "
            "0.1, \"equilibrium\": 2, \"knots\": [{\"frame\": 24, \"value\": 2}, {\"frame\": 36, \"value\": 3}, "
            "{\"frame\": 48, \"still\": true}]}]}");
    session_key(&s, 'A', MOD_CTRL);
    session_key(&s, 'T', MOD_CTRL);
    assert_near(s.document->splines[0]->knots[1].slope, 0, 1e-9); // from 2 to 2
    session_key(&s, 'T', 0);
    assert_false(s.document->splines[0]->knots[1].has_slope);
    session_close(&s);
}

/// A still knot is picked up where it is seen.
TEST(test_a_still_knot_is_where_it_is_seen)
{
    struct session s;
    session_open(
        &s,
        "{\"wiggly\": 2, \"frames\": [0, 96], \"splines\": [{\"name\": \"sway\", \"frequency\": 1, \"damping\": "
        "0.1, \"equilibrium\": 2, \"knots\": [{\"frame\": 24, \"value\": 2.5}, {\"frame\": 48, \"still\": true}]}]}");
    session_hover(&s, "knot(sway,1)");
    assert_ptr_equal(hovered(s.editor), &thing_knot);
    assert_non_null(shown_text(
        s.editor, "Comes to rest at the equilibrium; Shift+P gives it a value. Drag it in time (Ctrl: off frames)"));
    session_close(&s);
}
