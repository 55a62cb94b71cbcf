/// Limits in the app: their lines are dragged, knots stop at them, the inspector switches them, files say what is wrong.
#include "near.h"

#include "panel_session.h"
#include "scene/load.h"
#include <stdlib.h>
#include <string.h>

static const char swinging[] =
    "{\"wiggly\": 1, \"frames\": [0, 120], \"splines\": [{\"name\": \"sway\", \"frequency\": 1.2, \"damping\": 0.05, "
    "\"limits\": [null, 1.2], \"knots\": [{\"frame\": 8, \"value\": 0}, {\"frame\": 14, \"value\": 0.8}, "
    "{\"frame\": 22, \"value\": -0.4}, {\"frame\": 60, \"value\": 1}]}]}";

static double limit(const struct session *s, enum parameter p) { return s->document->splines[0].parameter[p].value; }

static double highest(const struct session *s)
{
    const wiggly_curve *curve = s->world.evaluation->curves;
    double highest = curve->total[0];
    for (int i = 0; i < curve->samples; i++) highest = fmax(highest, curve->total[i]);
    return highest;
}

static void pull(struct session *s, const char *from, const char *to)
{
    session_point(s, from);
    session_press(s, BUTTON_LEFT, 1);
    session_point(s, to);
    session_frame(s);
    session_release(s, BUTTON_LEFT);
    session_frame(s);
}

static void a_line_is_dragged_as_far_as_the_knots(void **state)
{
    (void)state;
    struct session s;
    session_open(&s, swinging);
    char *original = session_saved(&s);
    assert_non_null(strstr(original, "\"limits\": [null, 1.2]"));
    session_point(&s, "curve(sway,100,1.2)");
    session_frame(&s);
    assert_int_equal(s.editor->core.hover.kind, HOVER_LIMIT);
    pull(&s, "curve(sway,100,1.2)", "curve(sway,100,1.05)");
    assert_near(limit(&s, PARAMETER_HIGH), 1.05, 0.01);
    assert_true(highest(&s) == limit(&s, PARAMETER_HIGH) || highest(&s) == 1);
    pull(&s, "curve(sway,100,1.05)", "curve(sway,100,0.5)");
    assert_near(limit(&s, PARAMETER_HIGH), 1, 0);
    pull(&s, "knot(sway,3)", "curve(sway,60,1.1)");
    assert_near(s.document->splines[0].knots[3].value, 1, 0);
    for (int i = 0; i < 2; i++) session_key(&s, 'Z', MOD_CTRL);
    assert_saved(&s, original);
    free(original);
    session_close(&s);
}

static void the_inspector_switches_each(void **state)
{
    (void)state;
    struct session s;
    panel_open(&s, swinging, 1280, 900);
    panel_click(&s, "section.limits");
    panel_click(&s, "limit.low");
    assert_near(limit(&s, PARAMETER_LOW), -0.55, 1e-12); // 0.15 of the largest knot beyond the lowest
    panel_enter(&s, "low limit", "-0.45");
    assert_near(limit(&s, PARAMETER_LOW), -0.45, 0);
    panel_enter(&s, "low limit", "0"); // there is a knot below
    assert_near(limit(&s, PARAMETER_LOW), -0.45, 0);
    panel_click(&s, "limit.high");
    assert_true(limit(&s, PARAMETER_HIGH) == INFINITY);
    char *text = session_saved(&s);
    assert_non_null(strstr(text, "\"limits\": [-0.45, null]"));
    free(text);
    panel_click(&s, "limit.low");
    text = session_saved(&s);
    assert_null(strstr(text, "limits"));
    free(text);
    session_close(&s);
}

static void a_file_with_wrong_limits_says_so(void **state)
{
    (void)state;
    static const char *const wrong[][2] = {
        {"[1, -1]", "s:1: splines[0].limits: expected the low limit below the high one, got 1 and -1"},
        {"[null, 0.5]", "s:1: splines[0].knots[0].value: expected at most the high limit, 0.5, got 0.75"},
        {"[1, null]", "s:1: splines[0].knots[0].value: expected at least the low limit, 1, got 0.75"},
        {"[0]", "s:1: splines[0].limits: expected two numbers, or null for none, got 1 elements"},
        {"[0, \"a\"]", "s:1: splines[0].limits[1]: expected a number, got a string"},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        char text[256];
        struct error error = {0};
        snprintf(text, sizeof text,
                 "{\"wiggly\": 1, \"frames\": [0, 9], \"splines\": [{\"name\": \"a\", \"limits\": %s, \"knots\": "
                 "[{\"frame\": 2, \"value\": 0.75}]}]}",
                 wrong[i][0]);
        assert_null(scene_parse("s", text, strlen(text), NULL, &error));
        assert_string_equal(error.text, wrong[i][1]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(a_line_is_dragged_as_far_as_the_knots),
                                       cmocka_unit_test(the_inspector_switches_each),
                                       cmocka_unit_test(a_file_with_wrong_limits_says_so)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
