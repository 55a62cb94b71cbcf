/// The inspector's section on tails: every part of a tail set by hand, each a step that undo takes back byte by byte.
#include "panel_session.h"

static const char scene[] =
    "{\"frames\": [0, 48], \"splines\": [{\"name\": \"sway\", \"knots\": [{\"frame\": 0, \"value\": 0.5}]}, "
    "{\"name\": \"walk\", \"knots\": [{\"frame\": 0, \"value\": 0.25}]}], \"rigs\": [{\"type\": \"tail\", \"name\": "
    "\"t\", \"joints\": 4, \"position\": [0, 0.26, 0], \"channels\": [{\"spline\": \"sway\", \"lag\": 6, \"gain\": "
    "5}]}]}";

static const struct tail *tail(const struct session *s) { return document_tail(s->document, 0); }

/// Everything is in reach on a tall screen.
static void open_tall(struct session *s)
{
    panel_open(s, scene, 1280, 1600);
    session_saved(s);
}

/// Undoes all, which gives what there was at first.
static void close_undone(struct session *s)
{
    while (history_undo_label(s->history)) session_key(s, 'Z', MOD_CTRL);
    assert_saved(s, s->saved[0]);
    session_close(s);
}

#define TALL_TEST(name) TEST_OF(struct session, s, open_tall(s), close_undone(s), name)

TALL_TEST(test_place_and_size)
{
    panel_enter(s, "position.x", "0.5");
    assert_near(tail(s)->position[0].value, 0.5, 0);
    panel_enter(s, "length", "2");
    assert_near(tail(s)->length, 2, 0);
    panel_enter(s, "joints", "8");
    assert_int_equal(tail(s)->joints, 8);
    assert_near(tail(s)->channels[0].gain.value[0], 2.5, 0);
    panel_drag(s, "joints", 20);
    panel_drag(s, "joints", 16);
    panel_release(s);
    assert_near(tail(s)->channels[0].gain.value[0], 1.25, 0); // from 8, whatever lay between
    panel_click(s, "position.z.follow");
    panel_click(s, "item.walk");
    assert_int_equal(tail(s)->position[2].track, 1);
    assert_near(posed(s->editor)->matrix[0][14], 0.25, 1e-6);
    panel_click(s, "position.z.follow");
    assert_int_equal(tail(s)->position[2].track, -1);
    assert_near(tail(s)->position[2].value, 0.25, 1e-3); // stays where it was
}

TALL_TEST(test_channels)
{
    panel_click(s, "axis.0");
    panel_click(s, "item.up");
    panel_click(s, "part.displacement");
    assert_int_equal(tail(s)->channels[0].axis, AXIS_UP);
    assert_int_equal(tail(s)->channels[0].of, PART_DISPLACEMENT);
    panel_click(s, "feed.0");
    panel_click(s, "item.walk");
    assert_int_equal(tail(s)->channels[0].spline, 1);
    panel_click(s, "channel.add");
    assert_int_equal(tail(s)->channel_count, 2);
    assert_int_equal(tail(s)->channels[1].spline, active(s->editor));
    assert_int_equal(shown_channel(s->editor), 1);
    panel_click(s, "channel.0");
    panel_click(s, "channel.delete");
    assert_int_equal(tail(s)->channel_count, 1);
    panel_click(s, "channel.delete");
    assert_int_equal(tail(s)->channel_count, 0);
    assert_false(panel_shows(s, "gain"));
}

TALL_TEST(test_angles_one_for_each_joint)
{
    panel_click(s, "lag.each");
    for (int n = 0; n < 4; n++) assert_near(tail(s)->channels[0].lag.value[n], 6 * n, 1e-9);
    panel_enter(s, "lag.joint", "-0.04");
    session_frame(s);
    assert_true(session_shows(s, "0.0 → 18.0°")); // not −0.0
    panel_enter(s, "lag.joint", "0");
    panel_click(s, "lag.each"); // lit: back to one
    assert_int_equal(tail(s)->channels[0].lag.form, ANGLES_ONE);
    assert_near(tail(s)->channels[0].lag.value[0], 6, 1e-9);
    panel_click(s, "gain.each");
    panel_enter(s, "gain.joint", "9"); // the first, as none was touched yet
    assert_near(tail(s)->channels[0].gain.value[0], 9, 0);
    const char *good = session_saved(s);
    panel_enter(s, "gain.joint", "x");
    assert_said(s->editor, "joint 1: expected a number");
    assert_saved(s, good);
    session_key(s, KEY_ESCAPE, 0);
    panel_click(s, "gain.ramp");
    assert_int_equal(tail(s)->channels[0].gain.form, ANGLES_RAMP);
    panel_click(s, "gain.ramp");
    assert_int_equal(tail(s)->channels[0].gain.form, ANGLES_ONE);
    panel_click(s, "rest.each");
    assert_int_equal(tail(s)->rest.form, ANGLES_EACH);
}

/// The curve is drawn by a drag over the joints: one step, which Esc takes back; arrows go along it.
TALL_TEST(test_angles_are_drawn)
{
    panel_click(s, "gain.each");
    const char *flat = session_saved(s);
    panel_press(s, "gain.curve", 1); // at the first joint
    session_drag(s, 80, -20, 4);     // a third of the way is the next joint
    assert_true(tail(s)->channels[0].gain.value[0] > 5 &&
                tail(s)->channels[0].gain.value[1] > tail(s)->channels[0].gain.value[0]);
    assert_near(tail(s)->channels[0].gain.value[2], 5, 0);
    assert_int_equal(s->editor->inspector->joint[ANGLE_GAIN], 1);
    session_key(s, KEY_ESCAPE, 0);
    assert_saved(s, flat);
    panel_release(s);
    panel_pull(s, "gain.curve", 300, 10, 6); // beyond the last one
    for (int n = 2; n < 4; n++) assert_true(tail(s)->channels[0].gain.value[n] < 5);
    assert_one_step(s, flat);
    panel_click(s, "gain.curve");
    const int joint = s->editor->inspector->joint[ANGLE_GAIN];
    const double last = tail(s)->channels[0].gain.value[joint];
    session_key(s, KEY_UP, 0);
    assert_near(tail(s)->channels[0].gain.value[joint], last + 0.5, 1e-9);
    session_key(s, KEY_LEFT, 0);
    session_key(s, KEY_UP, 0);
    assert_int_equal(s->editor->inspector->joint[ANGLE_GAIN], joint - 1);
}

TALL_TEST(test_tails)
{
    panel_click(s, "tail.name");
    session_key(s, 'A', MOD_CTRL);
    panel_type(s, "brush");
    session_key(s, KEY_ENTER, 0);
    assert_string_equal(s->document->rigs[0]->name, "brush");
    panel_click(s, "rig.copy");
    assert_int_equal(document_count_rigs(s->document, RIG_TAIL), 2);
    assert_int_equal(s->editor->stage->tail_count, 2);
    assert_int_equal(shown_rig(s->editor), 1);
    panel_click(s, "rig.delete"); // its spline bends the first one too: nothing to ask
    assert_int_equal(document_count_rigs(s->document, RIG_TAIL), 1);
    panel_click(s, "rig.delete");
    assert_int_equal(asked(s->editor), DIALOG_ASK);
    session_key(s, 'K', 0);
    assert_int_equal(document_count_rigs(s->document, RIG_TAIL), 0);
    assert_int_equal(s->editor->stage->tail_count, 0);
    assert_int_equal(s->document->spline_count, 2);
    panel_click(s, "rig.add");
    panel_click(s, "item.tail");
    assert_int_equal(document_count_rigs(s->document, RIG_TAIL), 1);
}

/// View state is no edit.
TALL_TEST(test_toggles)
{
    panel_click(s, "onion");
    panel_click(s, "trail");
    panel_click(s, "record");
    assert_true(is_on(s->editor, SWITCH_ONION) && is_on(s->editor, SWITCH_TRAIL) && is_on(s->editor, SWITCH_RECORD));
    assert_null(history_undo_label(s->history));
}
