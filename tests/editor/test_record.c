/// Recording the body's way: few knots that keep to the hand's motion, a tail that swings as it did, one step to undo.
#include "panel_session.h"

#include "editor/stage/state.h"

static const char scene[] =
    "{\"frames\": [0, 96], \"splines\": [{\"name\": \"sway\", \"frequency\": 1.2, \"damping\": 0.25, \"bandwidth\": "
    "0.1, \"knots\": [{\"frame\": 0, \"value\": 0.2, \"slope\": 0}, {\"frame\": 90, \"value\": 0.2}]}],"
    "\"rigs\": [{\"type\": \"tail\", \"name\": \"tail\", \"position\": [0, 0.26, 0], \"channels\": [{\"spline\": "
    "\"sway\"}]}]}";

enum { JOINTS = 24, X = 12, DRAGGED = 60, WATCHED = 150 };

static float joint_x(const struct session *s, int n) { return posed(s->editor)->matrix[n][X]; }

TEST(test_few_knots_keep_to_the_way)
{
    enum { COUNT = 200, CAPACITY = 64 };
    double way[COUNT];
    int knots[CAPACITY];
    for (int i = 0; i < COUNT; i++) way[i] = 0.3 * (1 - cos(0.05 * i)) * exp(-0.01 * i);
    int made = record_simplify(way, COUNT, 0.004, knots, CAPACITY);
    assert_in_range(made, 3, 16);
    assert_int_equal(knots[0], 0);
    assert_int_equal(knots[made - 1], COUNT - 1);
    for (int i = 1; i < made; i++) assert_true(knots[i] > knots[i - 1]);
    assert_true(knots[1] > 1 && knots[made - 2] < COUNT - 2); // beside the ends a knot would take their slope away
    for (int i = 0; i < COUNT; i++) way[i] = 0.5;
    assert_int_equal(record_simplify(way, COUNT, 0.004, knots, CAPACITY), 2);
    for (int i = 0; i < COUNT; i++) way[i] = i % 2; // a hand that trembles: no more than there is room for
    assert_int_equal(record_simplify(way, COUNT, 0.004, knots, CAPACITY), CAPACITY);
}

/// Drags the body along x for a second while the scene plays; R recorded it or not. Notes base and tip of each frame.
static void perform(struct session *s, bool records, float base[WATCHED], float tip[WATCHED])
{
    session_point(s, "body(tail)");
    session_frame(s);
    session_press(s, BUTTON_LEFT, 1);
    session_hold(s, KEY_SPACE, ACTION_PRESS); // playing, as a recording is
    session_hold(s, KEY_SPACE, ACTION_RELEASE);
    session_move(s, s->x - 4, s->y);
    session_send(s, (struct event){.kind = EVENT_KEY, .key = 'X', .action = ACTION_PRESS});
    if (records) session_send(s, (struct event){.kind = EVENT_KEY, .key = 'R', .action = ACTION_PRESS});
    float x = s->x;
    for (int i = 0; i < WATCHED; i++) {
        float u = fminf(1, (float)i / DRAGGED);
        if (i == DRAGGED + 12) session_button(s, BUTTON_LEFT, ACTION_RELEASE, 1);
        if (i < DRAGGED + 12) session_move(s, x - 180 * u * u * (3 - 2 * u), s->y);
        session_frame(s);
        base[i] = joint_x(s, 0);
        tip[i] = joint_x(s, JOINTS) - base[i];
    }
}

TEST(test_recorded_is_what_was_seen)
{
    static float live_base[WATCHED], live_tip[WATCHED], base[WATCHED], tip[WATCHED];
    struct session s;
    session_open(&s, scene);
    perform(&s, false, live_base, live_tip);
    session_close(&s);
    session_open(&s, scene);
    const char *before = session_saved(&s);
    perform(&s, true, base, tip);
    assert_int_equal(s.document->spline_count, 3);
    assert_string_equal(s.document->splines[1]->name, "tail x");
    assert_int_equal(spline_mode(s.document->splines[1]), WIGGLY_CUBIC);
    assert_in_range(s.document->splines[1]->knot_count, 3, 12);
    const struct tail *tail = document_tail(s.document, 0);
    assert_int_equal(tail->position[0].track, 1);
    assert_int_equal(tail->position[2].track, -1);
    assert_int_equal(tail->channel_count, 2);
    assert_int_equal(tail->channels[0].of, PART_TOTAL);
    assert_int_equal(tail->channels[1].of, PART_DISPLACEMENT);
    assert_int_equal(s.document->splines[2]->parameter[PARAMETER_EQUILIBRIUM].track, 1);
    assert_int_equal(s.document->splines[0]->knot_count, 2); // the keyed swing is as it was
    float most = 0;
    for (int i = 0; i < WATCHED; i++) {
        assert_near(base[i], live_base[i], 0.01);
        most = fmaxf(most, fabsf(live_tip[i] - live_tip[0]));
    }
    assert_true(most > 0.1f);
    for (int i = DRAGGED + 14; i < WATCHED; i++) assert_near(tip[i], live_tip[i], 0.15 * most);
    session_key(&s, KEY_SPACE, 0);
    for (int i = 5; i < DRAGGED; i += 5) { // from its first half-second on
        playback_of(s.editor)->position = 24.0 * (i + 1) / 60;
        session_frame(&s);
        assert_near(joint_x(&s, 0), live_base[i], 0.01);
        assert_near(joint_x(&s, JOINTS) - joint_x(&s, 0), live_tip[i], 0.1 * most);
    }
    session_key(&s, 'Z', MOD_CTRL);
    assert_saved(&s, before);
    assert_null(history_undo_label(s.history));
    session_key(&s, 'Y', MOD_CTRL);
    assert_int_equal(s.document->spline_count, 3);
    session_close(&s);
}

/// A second take keys the same spline anew where it passes, and adds no channels.
TEST(test_a_second_take_replaces_the_first)
{
    static float base[WATCHED], tip[WATCHED];
    struct session s;
    session_open(&s, scene);
    perform(&s, true, base, tip);
    session_key(&s, KEY_SPACE, 0);
    session_key(&s, KEY_LEFT, MOD_SHIFT);
    perform(&s, true, base, tip);
    assert_int_equal(s.document->spline_count, 3);
    assert_int_equal(document_tail(s.document, 0)->channel_count, 2);
    assert_in_range(s.document->splines[1]->knot_count, 3, 20);
    session_close(&s);
}

/// With the pointer on the body; the document as it is then.
static const char *open_at_body(struct session *s)
{
    session_open(s, scene);
    session_point(s, "body(tail)");
    session_frame(s);
    return session_saved(s);
}

TEST(test_escape_forgets_the_recording)
{
    struct session s;
    const char *before = open_at_body(&s);
    session_press(&s, BUTTON_LEFT, 1);
    session_drag(&s, -40, 0, 4);
    session_send(&s, (struct event){.kind = EVENT_KEY, .key = 'R', .action = ACTION_PRESS});
    session_drag(&s, -40, 0, 20);
    session_key(&s, KEY_ESCAPE, 0);
    assert_saved(&s, before);
    assert_false(record_has_motion(s.editor->stage));
    session_close(&s);
}

/// A tail that only bends sideways is lifted while it records: it gets a channel that bends up, in the recording's own step.
TEST(test_a_way_without_a_channel_gets_one)
{
    struct session s;
    const char *before = open_at_body(&s);
    s.mods = MOD_CTRL;
    session_press(&s, BUTTON_LEFT, 1);
    session_hold(&s, KEY_SPACE, ACTION_PRESS);
    session_hold(&s, KEY_SPACE, ACTION_RELEASE);
    session_move(&s, s.x, s.y - 4);
    session_send(&s, (struct event){.kind = EVENT_KEY, .key = 'Y', .action = ACTION_PRESS, .mods = MOD_CTRL});
    session_send(&s, (struct event){.kind = EVENT_KEY, .key = 'R', .action = ACTION_PRESS, .mods = MOD_CTRL});
    session_drag(&s, 0, -90, 20);
    session_drag(&s, 0, 60, 20);
    session_release(&s, BUTTON_LEFT);
    const struct tail *tail = document_tail(s.document, 0);
    const struct document *document = s.document;
    assert_int_equal(tail->channel_count, 2);
    const struct channel *made = &tail->channels[1];
    assert_int_equal(made->axis, AXIS_UP);
    assert_int_equal(made->of, PART_DISPLACEMENT);
    assert_string_equal(document->splines[made->spline]->name, "tail up");
    assert_int_equal(document->splines[made->spline]->parameter[PARAMETER_EQUILIBRIUM].track,
                     tail->position[1].track);
    assert_near(document->splines[made->spline]->parameter[PARAMETER_FREQUENCY].value, 1.2, 0);
    assert_said(s.editor, " knots recorded. New spline tail up: the tail swings after tail y.");
    session_key(&s, KEY_SPACE, 0);
    float most = 0; // it swings: the tip's height above the base changes
    for (int f = 0; f < 90; f++) {
        playback_of(s.editor)->position = f;
        session_frame(&s);
        const struct pose *pose = posed(s.editor);
        static float first;
        const float rise = pose->matrix[JOINTS][13] - pose->matrix[0][13];
        if (f == 0) first = rise;
        most = fmaxf(most, fabsf(rise - first));
    }
    assert_true(most > 0.03f);
    session_key(&s, 'Z', MOD_CTRL);
    assert_saved(&s, before);
    session_close(&s);
}
