/// The editor as its user meets it: mouse and keys in, document out. Without GL.
#include "session.h"

static const char SWAY[] =
    "{\"wiggly\": 1, \"frames\": [0, 48], \"splines\": [{\"name\": \"sway\", \"frequency\": 1,"
    "\"damping\": 0.1, \"knots\": [{\"frame\": 0, \"value\": 0}, {\"frame\": 12, \"value\": 1},"
    "{\"frame\": 24, \"value\": -1}, {\"frame\": 36, \"value\": 0.5}]}, {\"name\": \"up\","
    "\"mode\": \"cubic\", \"knots\": [{\"frame\": 6, \"value\": 0.25}]}]}";

static const struct spline *sway(const struct session *s) { return s->document->splines[0]; }

static void assert_knot(const struct session *s, int k, double frame, double value)
{
    assert_true(k < sway(s)->knot_count);
    assert_near(sway(s)->knots[k].frame, frame, 1e-9);
    assert_near(sway(s)->knots[k].value, value, 1e-9);
}

static float pixels_per_frame(struct session *s)
{
    session_point(s, "curve(sway,10,0)");
    float x = s->x;
    session_point(s, "curve(sway,20,0)");
    return (s->x - x) / 10;
}

SESSION_TEST(test_double_click_inserts_at_the_pointer, session_open(s, SWAY))
{
    session_point(s, "curve(sway,30,1.1)");
    session_click_here(s, 1);
    session_click_here(s, 2);
    assert_int_equal(sway(s)->knot_count, 5);
    assert_near(sway(s)->knots[3].frame, 30, 0);
    assert_near(sway(s)->knots[3].value, 1.1, 1e-5);
    assert_near(s->work.evaluation.curves[0].total[30], sway(s)->knots[3].value,
                0); // hit exactly, in the same frame
    session_key(s, 'Z', MOD_CTRL);
    assert_int_equal(sway(s)->knot_count, 4);
}

SESSION_TEST(test_insert_at_playhead_keeps_the_curve, session_open(s, SWAY))
{
    double before[49];
    memcpy(before, s->work.evaluation.curves[0].total, sizeof before);
    session_click(s, "ruler(30)");
    session_key(s, 'I', 0);
    assert_int_equal(sway(s)->knot_count, 5);
    assert_near(sway(s)->knots[3].frame, 30, 0);
    for (int i = 0; i < 49; i++) assert_near(s->work.evaluation.curves[0].total[i], before[i], 1e-7);
    assert_false(sway(s)->knots[3].has_phase);
    session_key(s, 'P', 0);
    assert_true(sway(s)->knots[3].has_phase);
}

SESSION_TEST(test_a_drag_is_one_step_and_snaps, session_open(s, SWAY))
{
    const char *original = session_saved(s);
    float frame = pixels_per_frame(s);
    session_pull(s, "knot(sway,1)", 2.3f * frame, -20, 8);
    assert_near(sway(s)->knots[1].frame, 14, 0); // already while dragging
    session_release(s, BUTTON_LEFT);
    assert_near(sway(s)->knots[1].frame, 14, 0);
    assert_true(sway(s)->knots[1].value > 1.05);
    const char *moved = session_saved(s);
    session_key(s, 'Z', MOD_CTRL);
    assert_saved(s, original);
    assert_null(history_undo_label(s->history));
    session_key(s, 'Y', MOD_CTRL);
    assert_saved(s, moved);
}

SESSION_TEST(test_modifiers_of_a_drag, session_open(s, SWAY))
{
    float frame = pixels_per_frame(s);
    session_point(s, "knot(sway,1)");
    session_press(s, BUTTON_LEFT, 1);
    s->mods = MOD_CTRL;
    session_drag(s, 2.25f * frame, 0, 4);
    assert_near(sway(s)->knots[1].frame, 14.25, 1e-4); // no snap
    s->mods = 0;
    session_key(s, 'Y', 0);
    session_drag(s, 3 * frame, -30, 4);
    assert_near(sway(s)->knots[1].frame, 12, 0); // locked to its frame
    assert_true(sway(s)->knots[1].value > 1.05);
    session_key(s, 'X', 0);
    session_frame(s);
    assert_near(sway(s)->knots[1].value, 1, 0); // locked to its value
    s->mods = MOD_SHIFT;
    session_key(s, 'X', 0);
    float before = (float)sway(s)->knots[1].value;
    session_drag(s, 0, -100, 4);
    double fine = sway(s)->knots[1].value - before;
    s->mods = 0;
    session_drag(s, 0, -100, 4);
    assert_near((sway(s)->knots[1].value - before - fine) / fine, 10, 0.01);
    session_release(s, BUTTON_LEFT);
}

SESSION_TEST(test_a_drag_passes_through_an_occupied_frame, session_open(s, SWAY))
{
    float frame = pixels_per_frame(s);
    session_pull(s, "knot(sway,1)", 11 * frame, 0, 11);
    assert_near(sway(s)->knots[1].frame, 23, 0);
    session_drag(s, frame, 0, 1);
    assert_near(sway(s)->knots[1].frame, 23, 0); // 24 is taken: it waits in front
    assert_near(sway(s)->knots[2].frame, 24, 0);
    session_drag(s, frame, 0, 1);
    assert_near(sway(s)->knots[2].frame, 25, 0); // and is past it
    assert_near(sway(s)->knots[2].value, 1, 1e-9);
    assert_knot(s, 1, 24, -1);
    session_release(s, BUTTON_LEFT);
    assert_int_equal(sway(s)->knot_count, 4);
}

SESSION_TEST(test_a_group_keeps_its_shape_and_stays_inside, session_open(s, SWAY))
{
    session_key(s, 'A', MOD_CTRL);
    session_point(s, "knot(sway,2)");
    session_press(s, BUTTON_LEFT, 1);
    session_key(s, 'X', 0);
    session_drag(s, 3000, 0, 6);
    session_release(s, BUTTON_LEFT);
    const double frames[] = {12, 24, 36, 48}, values[] = {0, 1, -1, 0.5};
    for (int k = 0; k < 4; k++) assert_knot(s, k, frames[k], values[k]);
}

SESSION_TEST(test_escape_cancels_a_drag_then_drops_the_selection, session_open(s, SWAY))
{
    const char *original = session_saved(s);
    session_pull(s, "knot(sway,1)", 60, -20, 5);
    session_key(s, KEY_ESCAPE, 0);
    assert_saved(s, original);
    assert_false(history_is_open(s->history));
    assert_null(history_undo_label(s->history));
    session_drag(s, 60, -20, 5);
    session_release(s, BUTTON_LEFT);
    assert_saved(s, original);
    session_key(s, KEY_ESCAPE, 0);
    session_key(s, KEY_DELETE, 0); // nothing is selected any more
    assert_saved(s, original);
}

SESSION_TEST(test_a_click_edits_nothing, session_open(s, SWAY))
{
    uint64_t revision = history_revision(s->history);
    session_click(s, "knot(sway,1)");
    session_carry(s, "knot(sway,2)", 1, 1, 2); // a hand that trembles
    assert_true(history_revision(s->history) == revision);
}

/// What was undone is said until the next edit, not beside what that has made.
SESSION_TEST(test_an_edit_ends_the_message_of_an_undo, session_open(s, SWAY))
{
    for (int edit = 0; edit < 3; edit++) {
        session_carry(s, "knot(sway,2)", 0, -20, 3);
        session_key(s, 'Z', MOD_CTRL);
        assert_string_equal(said(s->editor), "Undone: Move knot");
        if (edit == 0) session_carry(s, "knot(sway,1)", 0, 30, 3);
        if (edit == 1) session_key(s, KEY_UP, MOD_ALT);
        if (edit == 2) session_carry(s, "slider(frequency)", 9, 0, 3);
        assert_string_equal(said(s->editor), "");
    }
}

SESSION_TEST(test_selecting, session_open(s, SWAY))
{
    session_click(s, "knot(sway,1)");
    s->mods = MOD_SHIFT;
    session_click(s, "knot(sway,2)");
    session_click(s, "knot(sway,3)");
    session_click(s, "knot(sway,3)"); // taken out again
    s->mods = 0;
    session_key(s, KEY_DELETE, 0);
    assert_int_equal(sway(s)->knot_count, 2);
    assert_knot(s, 1, 36, 0.5);
    session_key(s, 'Z', MOD_CTRL);
    session_click(s, "knot(sway,1)");
    session_type(s, ".");
    session_key(s, KEY_BACKSPACE, 0);
    assert_int_equal(sway(s)->knot_count, 3);
    assert_knot(s, 2, 36, 0.5);
    session_key(s, KEY_PAGE_DOWN, 0);
    session_key(s, 'A', MOD_CTRL);
    session_key(s, KEY_DELETE, 0);
    assert_int_equal(s->document->splines[1]->knot_count, 0); // of the other spline now
    assert_int_equal(sway(s)->knot_count, 3);
}

SESSION_TEST(test_nudges_merge, session_open(s, SWAY))
{
    const char *original = session_saved(s);
    session_click(s, "knot(sway,1)");
    for (int i = 0; i < 3; i++) session_key(s, KEY_RIGHT, MOD_ALT);
    assert_near(sway(s)->knots[1].frame, 15, 0);
    session_key(s, KEY_RIGHT, MOD_ALT | MOD_CTRL);
    assert_near(sway(s)->knots[1].frame, 15.1, 1e-9);
    session_key(s, 'Z', MOD_CTRL);
    assert_saved(s, original); // one run, one step
    session_click(s, "knot(sway,1)");
    session_key(s, KEY_UP, MOD_ALT);
    session_click(s, "knot(sway,2)");
    session_key(s, KEY_UP, MOD_ALT);
    session_key(s, 'Z', MOD_CTRL);
    assert_true(sway(s)->knots[1].value > 1); // another selection was another step
    session_key(s, 'Z', MOD_CTRL);
    assert_saved(s, original);
}

SESSION_TEST(test_a_nudge_passes_through, session_open(s, SWAY))
{
    session_click(s, "knot(sway,2)");
    session_key(s, KEY_RIGHT, MOD_ALT | MOD_SHIFT);
    assert_near(sway(s)->knots[2].frame, 34, 0);
    session_key(s, KEY_RIGHT, MOD_ALT);
    session_key(s, KEY_RIGHT, MOD_ALT); // 36 is taken
    assert_near(sway(s)->knots[2].frame, 36, 0);
    assert_near(sway(s)->knots[3].frame, 37, 0);
    assert_near(sway(s)->knots[3].value, -1, 0);
}

SESSION_TEST(test_slopes, session_open(s, SWAY))
{
    session_click(s, "knot(sway,1)");
    session_key(s, 'T', 0);
    assert_true(sway(s)->knots[1].has_slope);
    double slope = sway(s)->knots[1].slope;
    session_key(s, 'E', 0);
    assert_true(sway(s)->knots[1].slope > slope);
    session_key(s, 'D', 0);
    assert_near(sway(s)->knots[1].slope, slope, 1e-12);
    session_key(s, 'E', MOD_SHIFT);
    assert_near(sway(s)->knots[1].stiffness, 1250, 1e-9);
    session_carry(s, "handle(sway,1,1)", 0, -60, 5);
    assert_true(sway(s)->knots[1].slope > slope + 0.1);
    assert_near(sway(s)->knots[1].value, 1, 0);
    session_key(s, 'Z', MOD_CTRL);
    assert_near(sway(s)->knots[1].slope, slope, 1e-12);
    session_key(s, 'T', 0);
    assert_false(sway(s)->knots[1].has_slope);
}

/// However long the keys are held, a stiffness stays one that a scene may have.
SESSION_TEST(test_stiffness_stays_in_range, session_open(s, SWAY))
{
    session_click(s, "knot(sway,1)");
    for (int i = 0; i < 80; i++) session_key(s, 'E', MOD_SHIFT);
    assert_near(sway(s)->knots[1].stiffness, 1e9, 0);
    for (int i = 0; i < 160; i++) session_key(s, 'D', MOD_SHIFT);
    assert_near(sway(s)->knots[1].stiffness, 1e-3, 0);
}

SESSION_TEST(test_parameters_by_held_letters, session_open(s, SWAY))
{
    session_hold(s, 'F', ACTION_PRESS);
    for (int i = 0; i < 4; i++) session_key(s, KEY_UP, 0);
    session_hold(s, 'F', ACTION_RELEASE);
    session_key(s, KEY_UP, 0); // nothing is held: nothing happens
    assert_near(sway(s)->parameter[PARAMETER_FREQUENCY].value, 1.2, 1e-12);
    session_hold(s, 'Z', ACTION_PRESS);
    for (int i = 0; i < 30; i++) session_key(s, KEY_DOWN, 0);
    session_hold(s, 'Z', ACTION_RELEASE);
    assert_near(sway(s)->parameter[PARAMETER_DAMPING].value, 0, 0);
    session_key(s, 'Z', MOD_CTRL);
    assert_near(sway(s)->parameter[PARAMETER_DAMPING].value, 0.1, 0);
    session_key(s, 'Z', MOD_CTRL);
    assert_near(sway(s)->parameter[PARAMETER_FREQUENCY].value, 1, 0);
    session_key(s, 'M', 0);
    assert_int_equal(spline_mode(sway(s)), WIGGLY_REAL);
}

SESSION_TEST(test_keys_during_a_drag_do_not_mix, session_open(s, SWAY))
{
    session_pull(s, "knot(sway,1)", 30, -20, 3);
    session_key(s, KEY_DELETE, 0);
    session_key(s, 'Z', MOD_CTRL);
    session_key(s, KEY_PAGE_DOWN, 0);
    session_drag(s, 5, 0, 1);
    session_release(s, BUTTON_LEFT);
    assert_int_equal(sway(s)->knot_count, 4);
    assert_true(sway(s)->knots[1].frame > 12);
    session_key(s, 'Z', MOD_CTRL);
    assert_knot(s, 1, 12, 1);
}

static int below(int limit) { return rand() % limit; }

/// One event of somebody who hits everything: mostly sensible places, any key, any modifiers.
static void monkey(struct session *s)
{
    static const int keys[] = {KEY_SPACE, KEY_ESCAPE, KEY_ENTER,     KEY_TAB,       KEY_DELETE, KEY_LEFT, KEY_RIGHT,
                               KEY_UP,    KEY_DOWN,   KEY_PAGE_DOWN, KEY_HOME,      KEY_END,    KEY_F1,   ',',
                               'A',       'B',        'C',           'D',           'E',        'F',      'I',
                               'L',       'M',        'T',           'V',           'X',        'Y',      'Z',
                               '1',       '.',        '-',           KEY_BACKSPACE, 'I',        'T',      'S',
                               'N',       'U',        'G',           'R',           'P',        'S',      'R'};
    static const unsigned mods[] = {0, 0, 0, MOD_SHIFT, MOD_CTRL, MOD_ALT, MOD_ALT | MOD_SHIFT, MOD_ALT | MOD_CTRL};
    char target[32];
    struct event event = {.x = s->x, .y = s->y, .mods = mods[below(8)], .scale = 1};
    switch (below(8)) {
    case 0:
    case 1:
    case 2:
        session_move(s, (float)below(1300) - 10, (float)below(730) - 5);
        return;
    case 3:
        if (sway(s)->knot_count == 0) return;
        snprintf(target, sizeof target, "knot(sway,%d)", below(sway(s)->knot_count));
        if (!editor_target(s->editor, target, &event.x, &event.y, NULL)) return;
        session_move(s, event.x, event.y);
        event.kind = EVENT_BUTTON;
        event.action = ACTION_PRESS;
        event.clicks = 1;
        break;
    case 4:
        event.kind = EVENT_BUTTON;
        event.button = (enum event_button)(below(6) / 4);
        event.action = below(2) ? ACTION_PRESS : ACTION_RELEASE;
        event.clicks = 1 + below(2);
        break;
    case 5:
        event.kind = below(4) ? EVENT_WHEEL : below(2) ? EVENT_TEXT : EVENT_PASTE;
        event.text = below(2) ? copied(s->editor) : "0,0.5\n2,-1,3\n7,1e9\n";
        event.dy = (float)below(9) - 4;
        event.codepoint = (uint32_t) "0123456789-+.,<>[]"[below(18)];
        break;
    default:
        event.kind = EVENT_KEY;
        event.action = (enum event_action)below(3);
        event.key = keys[below(sizeof keys / sizeof keys[0])];
    }
    session_send(s, event);
}

TEST(test_a_monkey_can_be_undone)
{
    for (unsigned seed = 1; seed <= 12; seed++) {
        struct session s;
        srand(seed);
        session_open(&s, SWAY);
        const char *original = session_saved(&s);
        for (int i = 0; i < 1500; i++) {
            monkey(&s);
            if (below(3) == 0) session_frame(&s);
            session_asked(&s);
        }
        for (int i = 0; i < 4; i++) {
            session_key(&s, KEY_ESCAPE, 0);
            session_release(&s, BUTTON_LEFT);
            session_release(&s, BUTTON_RIGHT);
        }
        assert_false(history_is_open(s.history));
        for (int i = 0; i < s.work.evaluation.samples; i++)
            assert_true(isfinite(s.work.evaluation.curves[0].total[i]));
        while (history_undo_label(s.history)) assert_true(history_undo(s.history));
        assert_saved(&s, original);
        session_close(&s);
    }
}
