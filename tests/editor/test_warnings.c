/// Warnings in the curves panel: said where something is wrong, silent where nothing is, and gone after one click.
#include "base/file.h"
#include "panel_session.h"

/// A jump within two frames, and a knot half a period later that asks for the same value again.
static const char JUMP[] = "{\"wiggly\": 1, \"frames\": [0, 72], \"splines\": [{\"name\": \"sway\", \"frequency\": 1,"
                           "\"damping\": 0.05, \"bandwidth\": 0.05, \"knots\": [{\"frame\": 10, \"value\": 0},"
                           "{\"frame\": 12, \"value\": 1}, {\"frame\": 24, \"value\": 1}]}]}";

/// Knots half a period apart, and a start that costs nothing however hard it swings.
static const char UNCALM[] =
    "{\"wiggly\": 1, \"frames\": [0, 72], \"splines\": [{\"name\": \"sway\", \"frequency\": 1,"
    "\"mode\": \"real\", \"calm\": 0, \"damping\": 0.05, \"knots\": ["
    "{\"frame\": 10, \"value\": 1}, {\"frame\": 22, \"value\": 1}]}]}";

static const char FAST[] = "{\"wiggly\": 1, \"frames\": [0, 48], \"splines\": [{\"name\": \"sway\", \"frequency\": 9,"
                           "\"damping\": 0.1, \"bandwidth\": 0.1, \"knots\": [{\"frame\": 10, \"value\": 0},"
                           "{\"frame\": 12, \"value\": 1}, {\"frame\": 14, \"value\": 0}]}]}";

static const char WIDE[] =
    "{\"wiggly\": 1, \"frames\": [0, 120], \"splines\": [{\"name\": \"sway\", \"frequency\": 1,"
    "\"damping\": 0.1, \"bandwidth\": 0.2, \"knots\": [{\"frame\": 0, \"value\": 1},"
    "{\"frame\": 24, \"value\": 1}, {\"frame\": 84, \"value\": 1}]}]}";

/// Knots on both samples beside a slope: nothing is left for it to say.
static const char IDLE[] = "{\"wiggly\": 1, \"frames\": [0, 48], \"splines\": [{\"name\": \"sway\", \"frequency\": 1,"
                           "\"mode\": \"real\", \"damping\": 0.1, \"knots\": [{\"frame\": 10, \"value\": 0.2},"
                           "{\"frame\": 11, \"value\": 0.3, \"slope\": 5}, {\"frame\": 12, \"value\": 0.38}]}]}";

/// Poses where there is no phase.
static const char POSED[] =
    "{\"wiggly\": 2, \"frames\": [0, 48], \"splines\": [{\"name\": \"sway\", \"mode\": \"cubic\","
    "\"knots\": [{\"frame\": 10, \"value\": 0.2, \"im\": 1},"
    "{\"frame\": 20, \"value\": 0.3, \"im\": 0}]}]}";

/// Two poses two periods apart, whose values are in step, but not their phases: the later one is passed the other way.
static const char FORCED[] =
    "{\"wiggly\": 2, \"frames\": [0, 120], \"splines\": [{\"name\": \"sway\", \"frequency\": 1, \"damping\": 0.05,"
    "\"bandwidth\": 0.03, \"knots\": [{\"frame\": 12, \"value\": 0.3, \"im\": 1}, {\"frame\": 60, \"value\": 0.3, "
    "\"im\": -1}, {\"frame\": 96, \"value\": 0.9}]}]}";

/// Opens a scene that has a warning, clicks it, and finds it gone by one step that undo takes back byte by byte.
static void assert_remedied(struct session *s, const char *scene, enum warning_kind kind)
{
    session_open(s, scene);
    assert_int_equal(warnings_of(s->editor)->count, 1);
    assert_int_equal(warnings_of(s->editor)->list[0].kind, kind);
    const char *original = session_saved(s);
    session_point(s, "warning(0)");
    session_frame(s);
    assert_ptr_equal(hovered(s->editor), &thing_warning);
    for (int i = 0; i < 90; i++) session_frame(s);
    assert_false(tooltip_is_shown(tooltip_of(s->editor))); // it would cover what the warning says
    session_click(s, "warning(0)");
    session_frame(s);
    assert_int_equal(warnings_of(s->editor)->count, 0);
    session_key(s, 'Z', MOD_CTRL);
    assert_saved(s, original);
    assert_int_equal(warnings_of(s->editor)->count, 1);
    assert_null(history_undo_label(s->history));
    session_key(s, 'Y', MOD_CTRL);
    assert_int_equal(warnings_of(s->editor)->count, 0);
}

TEST(test_a_swing_is_tamed_by_what_helps)
{
    struct session s;
    assert_remedied(&s, JUMP, WARNING_FAR);
    const struct spline *sway = s.document->splines[0];
    assert_int_equal(sway->knot_count, 3); // there is calm enough: limits hold it
    assert_near(sway->parameter[PARAMETER_LOW].value, -1.2, 1e-9);
    assert_near(sway->parameter[PARAMETER_HIGH].value, 1.2, 1e-9);
    session_close(&s);
    assert_remedied(&s, UNCALM, WARNING_FAR);
    assert_int_equal(s.document->splines[0]->knot_count, 2); // no knot where calm does it
    assert_near(s.document->splines[0]->parameter[PARAMETER_CALM].value, 1, 0);
    session_close(&s);
}

SESSION_TEST(test_a_fast_spline_gets_substeps, assert_remedied(s, FAST, WARNING_RATE))
{
    assert_int_equal(s->document->substeps, 2);
    assert_near(s->document->splines[0]->parameter[PARAMETER_FREQUENCY].value, 9, 0);
}

SESSION_TEST(test_a_slope_without_effect_is_switched_off, assert_remedied(s, IDLE, WARNING_SLOPE))
{
    assert_false(s->document->splines[0]->knots[1].has_slope);
}

SESSION_TEST(test_poses_outside_complex_mode_are_freed, assert_remedied(s, POSED, WARNING_PHASE))
{
    for (int k = 0; k < 2; k++) assert_false(s->document->splines[0]->knots[k].has_phase);
}

#define SPLINE(members)                                                                                              \
    "{\"wiggly\": 2, \"frames\": [0, 48], \"splines\": [{\"name\": \"sway\", \"knots\": [{\"frame\": 10, "           \
    "\"value\": 0.2, \"settles\": true}, {\"frame\": 20, \"value\": 0.3}], " members "}]}"

SESSION_TEST(test_a_wind_up_without_effect_goes,
             assert_remedied(s, SPLINE("\"passive\": \"filter\", \"frequency\": 1, \"wind_up\": 0.5"),
                             WARNING_WIND_UP))
{
    assert_near(s->document->splines[0]->parameter[PARAMETER_WIND_UP].value, 0, 0);
}

/// As its bandwidth, it waits for the day that the spline is Wiggly again.
SESSION_TEST(test_the_wind_up_of_a_spring_is_no_matter,
             session_open(s, SPLINE("\"mode\": \"real\", \"frequency\": 1, \"wind_up\": 0.5")))
{
    assert_int_equal(warnings_of(s->editor)->count, 0);
}

SESSION_TEST(test_a_sudden_wind_up_is_lengthened,
             assert_remedied(s, SPLINE("\"frequency\": 2, \"wind_up\": 0.1"), WARNING_SUDDEN))
{
    assert_near(s->document->splines[0]->parameter[PARAMETER_WIND_UP].value, 0.17, 1e-9);
}

SESSION_TEST(test_a_cubic_does_not_settle, assert_remedied(s, SPLINE("\"mode\": \"cubic\""), WARNING_SETTLES))
{
    assert_false(s->document->splines[0]->knots[0].settles);
}

SESSION_TEST(test_a_pose_against_the_swing_is_freed, assert_remedied(s, FORCED, WARNING_FORCED))
{
    const struct knot *knots = s->document->splines[0]->knots;
    assert_true(knots[0].has_phase != knots[1].has_phase);
}

/// Where values alone are out of step, a free phase would not help, so nothing is said of the phases.
TEST(test_values_out_of_step_are_not_a_matter_of_phase)
{
    struct document *document = document_of_text(
        "{\"wiggly\": 2, \"frames\": [0, 120], \"splines\": [{\"name\": \"sway\", \"frequency\": 1, \"bandwidth\": "
        "0.03,"
        "\"knots\": [{\"frame\": 12, \"value\": 1, \"im\": 0}, {\"frame\": 60, \"value\": -1, \"im\": 0}]}]}");
    struct evaluation evaluation = {0};
    struct warnings found = {0};
    evaluation_update(&evaluation, document, false);
    warnings_add_forced(document, &evaluation, 0, &found);
    assert_int_equal(found.count, 0);
    evaluation_free(&evaluation);
    document_destroy(document);
}

/// Poses as they are seen where they are set force nothing, whatever their order.
TEST(test_poses_on_a_curve_force_nothing)
{
    struct session s;
    session_open(&s, FORCED);
    session_click(&s, "warning(0)");
    for (int frame = 6; frame < 120; frame += 24) {
        playback_of(s.editor)->position = frame;
        session_key(&s, 'I', MOD_SHIFT);
    }
    assert_int_equal(s.document->splines[0]->knot_count, 8);
    for (int i = 0; i < warnings_of(s.editor)->count; i++)
        assert_int_not_equal(warnings_of(s.editor)->list[i].kind, WARNING_FORCED);
    session_close(&s);
}

SESSION_TEST(test_a_wide_band_is_narrowed_to_what_the_knots_hold, assert_remedied(s, WIDE, WARNING_DRIFT))
{
    assert_near(s->document->splines[0]->parameter[PARAMETER_BANDWIDTH].value, 0.12, 1e-9); // 0.3 over 2.5 periods
}

TEST(test_the_scenes_of_the_program_are_quiet)
{
    static const char *const paths[] = {"assets/scenes/tail.json", "assets/scenes/figure1.json",
                                        "assets/scenes/figure3.json", "assets/scenes/figure5.json"};
    for (size_t i = 0; i < sizeof paths / sizeof paths[0]; i++) {
        struct session s;
        struct warnings found;
        char *text;
        size_t size;
        assert_done(file_read(paths[i], 1 << 20, &text, &size, &error));
        session_open(&s, text);
        for (int spline = 0; spline < s.document->spline_count; spline++) {
            found.count = 0;
            warnings_add(s.document, &s.work.evaluation, spline, &found);
            assert_int_equal(found.count, 0);
        }
        session_close(&s);
        free(text);
    }
}

SESSION_TEST(test_a_cubic_has_nothing_to_warn_of, session_open(s, WIDE))
{
    session_key(s, 'V', 0);
    assert_int_equal(warnings_of(s->editor)->count, 1); // stiff: the same curve
    session_key(s, 'V', 0);
    assert_int_equal(warnings_of(s->editor)->count, 0);
}
