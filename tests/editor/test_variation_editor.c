/// The frequency of knots by a key, and variations in the inspector and the file.

#include "panel_session.h"

/// Extrema of 1.25 Hz, 24 frames a second.
static const char swinging[] =
    "{\"wiggly\": 1, \"frames\": [0, 120], \"splines\": [{\"name\": \"sway\", \"frequency\": 3, \"damping\": 0.4, "
    "\"knots\": [{\"frame\": 5, \"value\": 1}, {\"frame\": 15, \"value\": -0.9}, {\"frame\": 24, \"value\": 0.8}, "
    "{\"frame\": 34, \"value\": -0.7}, {\"frame\": 43, \"value\": 0.62}]}]}";

static const char few[] =
    "{\"wiggly\": 1, \"frames\": [0, 120], \"splines\": [{\"name\": \"sway\", \"frequency\": 3, "
    "\"knots\": [{\"frame\": 5, \"value\": 1}, {\"frame\": 15, \"value\": -0.9}, {\"frame\": 24, \"value\": 0.8}]}]}";

static double number(const struct session *s, enum parameter p)
{
    return s->document->splines[0]->parameter[p].value;
}

SESSION_TEST(a_key_finds_the_frequency, session_open(s, swinging))
{
    session_frame(s);
    const char *original = session_saved(s);
    session_key(s, 'F', MOD_SHIFT);
    session_frame(s);
    assert_near(number(s, PARAMETER_FREQUENCY), 1.26, 0.06);
    assert_true(number(s, PARAMETER_DAMPING) < 0.1);
    session_key(s, 'Z', MOD_CTRL);
    assert_saved(s, original);
}

SESSION_TEST(too_few_knots_are_told, session_open(s, few))
{
    session_frame(s);
    session_key(s, 'F', MOD_SHIFT);
    assert_said(s->editor, "Four knots");
    assert_near(number(s, PARAMETER_FREQUENCY), 3, 0);
}

SESSION_TEST(the_dice_rolls_another_motion, panel_open(s, swinging, 1280, 1200))
{
    const char *original = session_saved(s);
    panel_click(s, "section.variation");
    const double before = s->world.evaluation->curves[0].total[20];
    panel_click(s, "variation.roll");
    session_frame(s);
    assert_near(number(s, PARAMETER_VARIATION), 0.3, 0);
    assert_true(s->world.evaluation->curves[0].total[20] != before);
    assert_true(s->world.evaluation->curves[0].total[15] == -0.9);
    const double seed = number(s, PARAMETER_SEED);
    panel_click(s, "variation.roll");
    assert_true(number(s, PARAMETER_SEED) != seed);
    for (int i = 0; i < 2; i++) session_key(s, 'Z', MOD_CTRL);
    assert_saved(s, original);
}

TEST(the_file_has_both_numbers_and_what_else_is_there)
{
    static const char scene[] =
        "{\"wiggly\": 1, \"frames\": [0, 24], \"splines\": [{\"name\": \"a\", \"frequency\": 1, "
        "\"variation\": {\"seed\": 7, \"amount\": 0.3, \"mood\": \"mild\"}, \"knots\": []}]}";
    struct session s;
    session_open(&s, scene);
    const char *saved = session_saved(&s);
    assert_non_null(strstr(saved, "\"variation\": { \"seed\": 7, \"amount\": 0.3, \"mood\": \"mild\" }"));
    session_close(&s);
}
