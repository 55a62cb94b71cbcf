/// What the curves panel warns of: said where something is wrong, silent where nothing is, and gone after one click. A curve that one pose sends far
/// beyond its knots. And limits, which hold knots: their lines are dragged, knots stop at them, the inspector switches them.
#include "hands.h"

#define SCENE(last, members) "{'wiggly': 2, 'frames': [0, " last "], 'splines': [{'name': 'sway', " members "}]}"
#define SETTLING(members)                                                                                            \
    SCENE("48", "'knots': [{'frame': 10, 'value': 0.2, 'settles': true}, {'frame': 20, 'value': "                    \
                "0.3}], " members)
/// Two poses two periods apart, whose values are in step, but not their phases: the later one is passed the other way.
#define FORCED                                                                                                       \
    SCENE("120", "'frequency': 1, 'damping': 0.05, 'bandwidth': 0.03, 'knots': [{'frame': 12, 'value': "             \
                 "0.3, 'im': 1}, {'frame': 60, 'value': 0.3, 'im': -1}, <96 0.9>]")
#define WIDE                                                                                                         \
    SCENE("120", "'frequency': 1, 'damping': 0.1, 'bandwidth': 0.2, 'knots': [<0 1>,"                                \
                 "<24 1>, <84 1>]")

/// Scenes with one warning, and what is so once that is clicked.
static const struct {
    enum warning_kind kind;
    const char *scene, *remedy;
} warned[] = {
    // a jump within two frames, and a knot half a period later that asks for the same value again; it is calm enough
    {WARNING_FAR,
     SCENE("72", "'frequency': 1, 'damping': 0.05, 'bandwidth': 0.05, 'knots': [<10 0>, <12 1>, <24 1>]"),
     "sway.knots 3; sway.limits -1.2 1.2"},
    // half a period apart, and a start that costs nothing however hard it swings; no knot where calm does it
    {WARNING_FAR,
     SCENE("72", "'frequency': 1, 'mode': 'real', 'calm': 0, 'damping': 0.05, 'knots': [<10 1>, <22 1>]"),
     "sway.knots 2; sway.calm 1 ~0"},
    {WARNING_RATE, SCENE("48", "'frequency': 9, 'damping': 0.1, 'bandwidth': 0.1, 'knots': [<10 0>, <12 1>, <14 0>]"),
     "is substeps 2; sway.frequency 9 ~0"},
    // knots on both samples beside a slope: nothing is left for it to say
    {WARNING_SLOPE,
     SCENE("48", "'frequency': 1, 'mode': 'real', 'damping': 0.1, 'knots': [<10 0.2>, {'frame': 11, 'value': 0.3, "
                 "'slope': 5}, <12 0.38>]"),
     "sway.1.sloped 0"},
    {WARNING_PHASE,
     SCENE("48",
           "'mode': 'cubic', 'knots': [{'frame': 10, 'value': 0.2, 'im': 1}, {'frame': 20, 'value': 0.3, 'im': 0}]"),
     "sway.posed 0 0"},
    {WARNING_WIND_UP, SETTLING("'passive': 'filter', 'frequency': 1, 'wind_up': 0.5"), "sway.wind_up 0 ~0"},
    {WARNING_SUDDEN, SETTLING("'frequency': 2, 'wind_up': 0.1"), "sway.wind_up 0.17"},
    {WARNING_SETTLES, SETTLING("'mode': 'cubic'"), "sway.settles 0 0"},
    {WARNING_FORCED, FORCED, "sway.0.posed ! sway.1.posed"},
    {WARNING_DRIFT, WIDE, "sway.bandwidth 0.12"}, // 0.3 over 2.5 periods
};

/// In one step, which undo takes back byte by byte. A tooltip would cover what the warning says.
TEST(one_click_remedies)
{
    for (size_t i = 0; i < sizeof warned / sizeof *warned; i++) {
        struct session session, *const s = &session;
        session_open(s, warned[i].scene);
        hands(s, "warnings 1; keep; hover warning(0); wait 90");
        if (warnings_of(s->editor)->list[0].kind != warned[i].kind) fail_msg("other than to %s", warned[i].remedy);
        assert_ptr_equal(hovered(s->editor), &thing_warning);
        assert_false(tooltip_is_shown(tooltip_of(s->editor)));
        hands(s,
              "click warning(0); wait 1; warnings 0; %s; key Ctrl+Z; kept; warnings 1; label; key Ctrl+Shift+Z; "
              "warnings 0",
              warned[i].remedy);
        session_close(s);
    }
}

/// Stiff, a cubic is the same curve; and the wind-up of a spring, as its bandwidth, waits for the day that it is Wiggly again.
WALK(a_cubic_has_nothing_to_warn_of, session_open(s, WIDE), "key V; warnings 1; key V; warnings 0")
WALK(the_wind_up_of_a_spring_is_no_matter,
     session_open(s, SETTLING("'mode': 'real', 'frequency': 1, 'wind_up': 0.5")), "warnings 0")

/// Poses as they are seen where they are set force nothing, whatever their order.
SESSION_TEST(poses_on_a_curve_force_nothing, session_open(s, FORCED))
{
    hands(s, "click warning(0)");
    for (int frame = 6; frame < 120; frame += 24) hands(s, "seek %d; key Shift+I", frame);
    hands(s, "sway.knots 8");
    for (int i = 0; i < warnings_of(s->editor)->count; i++)
        assert_int_not_equal(warnings_of(s->editor)->list[i].kind, WARNING_FORCED);
}

TEST(the_scenes_of_the_program_are_quiet)
{
    static const char *const scenes[] = {"tail", "figure1", "figure3", "figure5"};
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++) {
        char path[64];
        struct session s;
        snprintf(path, sizeof path, "assets/scenes/%s.json", scenes[i]);
        session_open_file(&s, path);
        for (int spline = 0; spline < s.document->spline_count; spline++) {
            struct warnings found = {0};
            warnings_add(s.document, &s.work.evaluation, spline, &found);
            if (found.count) fail_msg("%s warns of %s", path, s.document->splines[spline]->name);
        }
        session_close(&s);
    }
}

// --- far ---

/// A jump within a frame.
#define JUMP "<10 0>, <11 1>, <24 1>"
#define JUMPS(last, more, before)                                                                                    \
    "{'wiggly': 2, 'frames': [0, " last "], 'splines': [" before "{'name': 'sway', 'frequency': 1, "                 \
    "'damping': 0.05, 'bandwidth': 0.05" more ", 'knots': [" JUMP "]}]}"
#define BASE                                                                                                         \
    "{'name': 'base', 'mode': 'cubic', 'knots': [<0 0>, {'frame': 60, "                                              \
    "'value': 3}]},"

/// What is said of the last spline of a scene.
static struct warnings found_by(const char *scene,
                                void (*add)(const struct document *document, const struct evaluation *evaluation,
                                            int spline, struct warnings *found))
{
    struct document *document = document_of_scene(scene);
    struct evaluation evaluation = {0};
    struct warnings found = {0};
    evaluation_update(&evaluation, document, false);
    add(document, &evaluation, document->spline_count - 1, &found);
    evaluation_free(&evaluation);
    document_destroy(document);
    return found;
}

TEST(limits_moving_equilibria_and_poses_are_not_far)
{
    static const char *const quiet[] = {
        JUMPS("72", ", 'limits': [null, 9]", ""),
        JUMPS("72", ", 'equilibrium': {'spline': 'base'}", BASE),
        JUMPS("72", ", 'mode': 'cubic'", ""),
        // poses at which the curve passes through 0 as fast as it swings
        SCENE(
            "72",
            "'frequency': 1, 'knots': [{'frame': 12, 'value': 0.1, 'im': 1}, {'frame': 36, 'value': 0.1, 'im': 1}]"),
    };
    for (size_t i = 0; i < sizeof quiet / sizeof *quiet; i++)
        if (found_by(quiet[i], warnings_add_far).count) fail_msg("%s is far", quiet[i]);
    assert_int_equal(found_by(JUMPS("72", "", ""), warnings_add_far).count, 1);
    // the largest knot is measured from the equilibrium
    const struct warnings found = found_by(JUMPS("72", ", 'equilibrium': -0.2", ""), warnings_add_far);
    assert_int_equal(found.count, 1);
    assert_near(fabs(found.list[0].remedy + 0.2), 1.2, 1e-12);
    assert_true(found.list[0].low < -1.4 && found.list[0].low > -2);
}

/// Where values alone are out of step, a free phase would not help, so nothing is said of the phases.
TEST(values_out_of_step_are_not_a_matter_of_phase)
{
    assert_int_equal(found_by(SCENE("120", "'frequency': 1, 'bandwidth': 0.03, 'knots': [{'frame': 12, 'value': 1, "
                                           "'im': 0}, {'frame': 60, 'value': -1, 'im': 0}]"),
                              warnings_add_forced)
                         .count,
                     0);
}

/// How far a spline's curve and its knots are from 0 at most.
static double farthest(const struct session *s, int spline, double *knot)
{
    double most = 0;
    const struct spline *of = s->document->splines[spline];
    for (int i = 0; i < s->work.evaluation.samples; i++)
        most = fmax(most, fabs(s->work.evaluation.curves[spline].total[i]));
    *knot = 0;
    for (int k = 0; k < of->knot_count; k++) *knot = fmax(*knot, fabs(of->knots[k].value));
    return most;
}

/// The tail dragged far up just behind a knot that stays: a whole curve of the sway is sent to three times its other knots.
#define DRAG_FAR "with Alt; seek 84; pull tail(tail,0.3) 0 -300 12; wait 60; with; dragging 1"

/// In the start scene as it was before wind-up: of the active curve, and of the other one that the tail follows. One click leaves what swings
/// least, as one step.
SESSION_TEST(a_drag_on_the_stage_says_that_the_curve_swings_far, session_open_file(s, "tests/replays/session.json"))
{
    double knot;
    hands(s, "warnings 0; " DRAG_FAR "; warnings 2");
    assert_true(farthest(s, 0, &knot) > 2.5 * knot && farthest(s, 1, &knot) > 4);
    for (int i = 0; i < 2; i++) {
        assert_int_equal(warnings_of(s->editor)->list[i].kind, WARNING_FAR);
        assert_int_equal(warnings_of(s->editor)->list[i].spline, i);
    }
    hands(s, "release; keep; hover warning(0); wait 1");
    assert_ptr_equal(hovered(s->editor), &thing_warning);
    assert_string_equal(s->editor->curves->fixes[0].text, "set limits from -1.3 to 1.3");
    hands(s, "click warning(0); wait 1");
    assert_true(farthest(s, 0, &knot) < 1.3 * knot);
    hands(s, "key Ctrl+Z; kept");
}

/// With wind-up the same drag stays within twice what it sets.
SESSION_TEST(the_start_scene_bears_the_same_drag, session_open_file(s, "assets/scenes/tail.json"))
{
    double knot;
    hands(s, DRAG_FAR "; warnings 0");
    for (int i = 0; i < 2; i++) assert_true(farthest(s, i, &knot) < 2 * knot);
}

/// A scene too long for limits: W adds a pose at the peak, outside complex mode a knot.
TEST(a_pose_at_the_peak_holds_where_limits_cannot)
{
    static const char *const scenes[] = {JUMPS("25000", ", 'mode': 'real'", ""), JUMPS("25000", "", "")};
    for (int is_complex = 0; is_complex < 2; is_complex++) {
        struct session session, *const s = &session;
        session_open(s, scenes[is_complex]);
        double knot;
        const double before = farthest(s, 0, &knot);
        hands(s, "keep; key W; sway.knots 4; sway.2.posed %d; sway.2.phase %s 0", is_complex, is_complex ? "!" : "");
        assert_near(fabs(s->document->splines[0]->knots[2].value), 1, 1e-12);
        assert_true(farthest(s, 0, &knot) < before);
        hands(s, "key Ctrl+Z; kept");
        session_close(s);
    }
}

// --- limits ---

static const char LIMITED[] =
    "{'wiggly': 1, 'frames': [0, 120], 'splines': [{'name': 'sway', 'frequency': 1.2, 'damping': 0.05, 'limits': "
    "[null, 1.2], 'knots': [<8 0>, <14 0.8>, <22 -0.4>, <60 1>]}]}";

SESSION_TEST(a_line_is_dragged_as_far_as_the_knots, session_open(s, LIMITED))
{
    hands(s, "saves \"limits\": [null, 1.2]; keep; hover curve(sway,100,1.2)");
    assert_ptr_equal(hovered(s->editor), &thing_limit);
    hands(s, "box curve(sway,100,1.2) curve(sway,100,1.05); wait 1; sway.limits -inf 1.05 ~0.01");
    const double high = s->document->splines[0]->parameter[PARAMETER_HIGH].value;
    double highest = -INFINITY;
    for (int i = 0; i < s->work.evaluation.samples; i++)
        highest = fmax(highest, s->work.evaluation.curves[0].total[i]);
    assert_true(highest == high || highest == 1);
    hands(s, "box curve(sway,100,1.05) curve(sway,100,0.5); wait 1; sway.limits -inf 1 ~0;"
             "box knot(sway,3) curve(sway,60,1.1); wait 1; sway.3.value 1 ~0; key 2*Ctrl+Z; kept");
}

/// While a limit holds a knot the status line says so, and no longer; it stays after the release, to be read.
WALK(what_holds_a_dragged_knot_is_said, session_open(s, LIMITED),
     "pull knot(sway,1) 0 -20; said; drag 0 -400; sway.1.value 1.2 ~0; says Held by the limit 1.2 of sway at frame "
     "14.;"
     "drag 0 400; said; drag 0 -400; release; says Held by the limit 1.2 of sway at frame 14.")

/// A knot cannot leave the range nor sit on another one: what stops it is said as it is where knots are scaled.
SESSION_TEST(what_stops_a_knot_in_time_is_said, session_open(s, LIMITED))
{
    hands(s, "pull knot(sway,1) 7f 0 7; said; drag 1f 0 1; sway.1.frame 21; says A knot would land on another on "
             "frame 22.;"
             "drag 1f 0 1; said; drag 120f 0 5; says A knot would leave the range.; key Escape;" // past it
             "click knot(sway,0); key 8*Alt+Left; sway.0.frame 0 ~0");
    hush(s->editor);
    hands(s, "key Alt+Left; says A knot would leave the range.");
}

/// From 0.2 below it.
SESSION_TEST(a_nudge_goes_as_far_as_the_limit, session_open(s, LIMITED))
{
    hands(s, "click knot(sway,3); key 9*Alt+Shift+Up; sway.3.value 1.2 ~0;"
             "says Held by the limit 1.2 of sway at frame 60.");
    assert_false(said_error(s->editor));
}

/// It bends as far as the limit; before, the pull was taken back as a whole.
SESSION_TEST(a_pulled_tail_stops_at_the_limit,
             session_open(s, "{'wiggly': 1, 'frames': [0, 48], 'splines': [{'name': 'sway', 'limits': [-0.5, 0.5], "
                             "'knots': [<0 0>]}], 'rigs': [{'type': 'tail', 'name': 'tail', 'position': [0, 0.26, "
                             "0], 'channels': [{'spline': 'sway', 'gain': 6}]}]}"))
{
    hands(s, "wait 1; pull tail(tail,0.95) -500 0 25; wait 20; release; said eld by the limit");
    assert_near(fabs(s->document->splines[0]->knots[0].value), 0.5, 0);
    assert_false(said_error(s->editor));
}

/// 0.15 of the largest knot beyond the lowest; above 0 there is a knot below.
WALK(the_inspector_switches_each_limit, panel_open(s, LIMITED, 1280, 1000),
     "click section.limits; click limit.low; sway.limits -0.55 1.2 ~1e-12;"
     "enter low_limit -0.45; sway.limits -0.45 1.2 ~0;"
     "enter low_limit 0; sway.limits -0.45 1.2 ~0;"
     "click limit.high; sway.limits -0.45 inf; saves \"limits\": [-0.45, null]; click limit.low; omits limits")
