/// Playback: the real clock, speed, the part that is played, and scrubbing.
#include "panel_session.h"

/// 24 frames a second, two samples a frame: a position of 2 is one frame.
static const char scene[] =
    "{\"frames\": [0, 100], \"substeps\": 2, \"splines\": [{\"name\": \"sway\", \"frequency\": 1, "
    "\"damping\": 0.1, \"knots\": [{\"frame\": 0, \"value\": 0}, {\"frame\": 40, \"value\": 1}]}]}";

/// One picture after `dt` seconds.
static void pass(struct session *session, double dt) { editor_advance(session->editor, dt); }

static void open_at(struct session *session, double frame)
{
    panel_open(session, scene, 1280, 720);
    seek(session->editor, frame);
}

SESSION_TEST(test_real_time, open_at(s, 10))
{
    session_key(s, KEY_SPACE, 0); // its frame is 1/60 s
    pass(s, 0.5);
    pass(s, 0.25);
    assert_near(shown_frame(s->editor), 10 + 24 * (0.75 + 1.0 / 60), 1e-9);
}

SESSION_TEST(test_speed, open_at(s, 10))
{
    static const double slower[] = {0.5, 0.25, 0.1, 0.1}, faster[] = {0.25, 0.5, 1, 2, 4, 4};
    for (int i = 0; i < 4; i++) {
        session_type(s, "-");
        assert_near(playback_of(s->editor)->speed, slower[i], 0);
    }
    playback_of(s->editor)->playing = true;
    pass(s, 1);
    assert_near(shown_frame(s->editor), 12.4, 1e-9);
    for (int i = 0; i < 6; i++) {
        session_type(s, i % 2 ? "+" : "=");
        assert_near(playback_of(s->editor)->speed, faster[i], 0);
    }
    seek(s->editor, 0);
    playback_of(s->editor)->playing = true;
    pass(s, 0.5);
    assert_near(shown_frame(s->editor), 48, 1e-9);
    assert_true(history_is_saved(s->history)); // a matter of the view
}

/// Whatever the time between pictures, the clock is kept; whole frames without a picture are counted.
SESSION_TEST(test_dropped_frames, open_at(s, 0))
{
    session_key(s, KEY_SPACE, 0);
    for (int i = 0; i < 119; i++) pass(s, 1.0 / 60);
    assert_int_equal(playback_of(s->editor)->dropped, 0);
    assert_near(shown_frame(s->editor), 48, 1e-9);
    pass(s, 0.25); // from 48 to 54: 49 … 53 were not shown
    assert_int_equal(playback_of(s->editor)->dropped, 5);
    pass(s, 0.3125); // to 61.5: nor 55 … 60
    assert_int_equal(playback_of(s->editor)->dropped, 11);
    session_key(s, KEY_SPACE, 0);
    session_key(s, KEY_SPACE, 0); // counted from the start of playing
    assert_int_equal(playback_of(s->editor)->dropped, 0);
}

/// What a display of 60 pictures a second cannot show at four times the speed was not dropped.
SESSION_TEST(test_fast_is_not_dropped, open_at(s, 0))
{
    playback_of(s->editor)->speed = 4;
    session_key(s, KEY_SPACE, 0);
    for (int i = 0; i < 200; i++) pass(s, 1.0 / 60);
    assert_int_equal(playback_of(s->editor)->dropped, 0);
}

SESSION_TEST(test_part, open_at(s, 20))
{
    session_type(s, "[");
    seek(s->editor, 30);
    session_type(s, "]");
    seek(s->editor, 80);
    session_key(s, KEY_SPACE, 0); // from outside it begins at the start
    assert_near(shown_frame(s->editor), 20 + 0.4, 1e-9);
    pass(s, 0.25);
    assert_near(shown_frame(s->editor), 26.4, 1e-9);
    pass(s, 0.25); // 32.4: around
    assert_near(shown_frame(s->editor), 22.4, 1e-9);
    session_key(s, 'L', MOD_CTRL);
    pass(s, 1);
    assert_near(shown_frame(s->editor), 30, 1e-9); // no loop: stops at its end
    assert_false(playback_of(s->editor)->playing);
    session_key(s, KEY_SPACE, 0);
    assert_near(shown_frame(s->editor), 20.4, 1e-9);
}

static void ruler_at(struct session *session, double frame)
{
    session_move(session, x_of(session->editor, frame), layout_of(session->editor)->ruler.y + 10);
}

static void assert_range(const struct session *session, double first, double last)
{
    double range[2];
    playback_range(&session->editor->core, range);
    assert_near(range[0], first, 0);
    assert_near(range[1], last, 0);
}

SESSION_TEST(test_part_on_the_ruler, open_at(s, 5))
{
    s->mods = MOD_SHIFT;
    ruler_at(s, 60.2);
    session_press(s, BUTTON_LEFT, 1);
    ruler_at(s, 40.3);
    assert_range(s, 40, 60);
    session_release(s, BUTTON_LEFT);
    assert_near(shown_frame(s->editor), 5, 0); // the playhead stays
    session_press(s, BUTTON_LEFT, 1);
    ruler_at(s, 90);
    assert_range(s, 40, 90);
    session_key(s, KEY_ESCAPE, 0); // takes the drag back
    assert_range(s, 40, 60);
    session_release(s, BUTTON_LEFT);
    history_begin(s->history, "Range", 0);
    assert_done(edit_range(s->document, 0, 50, RANGE_REFUSE, &error));
    history_end(s->history);
    assert_range(s, 40, 50); // what the scene still has of it
    history_undo(s->history);
    session_press(s, BUTTON_LEFT, 1);
    session_release(s, BUTTON_LEFT);
    assert_range(s, 0, 100);
}

/// A part without an end, or with all of the scene in it, is all of it.
SESSION_TEST(test_no_part, open_at(s, 40))
{
    session_type(s, "]");
    assert_range(s, 0, 40);
    seek(s->editor, 60);
    session_type(s, "["); // after its end: to the scene's end
    assert_range(s, 60, 100);
    seek(s->editor, 0);
    session_type(s, "[");
    assert_range(s, 0, 100);
    assert_false(plays_part(s->editor));
}

/// Scrubbing shows frames exactly, and what lies between them with Ctrl, from the press on.
SESSION_TEST(test_scrubbing, open_at(s, 0))
{
    for (double frame = 7; frame < 90; frame += 13) {
        ruler_at(s, frame + 0.3);
        session_press(s, BUTTON_LEFT, 1);
        assert_true(playback_of(s->editor)->position == 2 * frame); // bit for bit a sample
        ruler_at(s, frame + 1.4);
        assert_true(playback_of(s->editor)->position == 2 * (frame + 1));
        session_release(s, BUTTON_LEFT);
    }
    s->mods = MOD_CTRL;
    ruler_at(s, 33.4);
    session_press(s, BUTTON_LEFT, 1);
    assert_near(shown_frame(s->editor), 33.4, 0.01);
    ruler_at(s, 35.6);
    assert_near(shown_frame(s->editor), 35.6, 0.01);
    session_release(s, BUTTON_LEFT);
}

static void click_on(struct session *session, const char *control, enum event_button button)
{
    session_point(session, control);
    session_press(session, button, 1);
    session_release(session, button);
}

SESSION_TEST(test_controls, open_at(s, 10))
{
    click_on(s, "widget(play)", BUTTON_LEFT);
    assert_true(playback_of(s->editor)->playing);
    click_on(s, "widget(play)", BUTTON_LEFT);
    assert_false(playback_of(s->editor)->playing);
    click_on(s, "widget(loop)", BUTTON_LEFT);
    assert_false(is_on(s->editor, SWITCH_LOOP));
    click_on(s, "widget(speed)", BUTTON_LEFT);
    assert_near(playback_of(s->editor)->speed, 2, 0);
    s->mods = MOD_SHIFT;
    click_on(s, "widget(speed)", BUTTON_LEFT);
    click_on(s, "widget(speed)", BUTTON_LEFT);
    assert_near(playback_of(s->editor)->speed, 0.5, 0);
    s->mods = 0;
    session_wheel(s, -1);
    assert_near(playback_of(s->editor)->speed, 0.25, 0);
    click_on(s, "widget(speed)", BUTTON_RIGHT);
    assert_near(playback_of(s->editor)->speed, 1, 0);
    assert_int_equal(s->document->splines[0]->knot_count, 2);
}
