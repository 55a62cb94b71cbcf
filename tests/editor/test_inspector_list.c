/// The inspector's scene, list of splines, tracks and palette, by the events of mouse and keyboard.
#include "panel_session.h"

static const char scene[] =
    "{\"wiggly\": 1, \"frames\": [0, 96], \"splines\": [" PANEL_SPLINES "],"
    "\"rigs\": [{\"type\": \"tail\", \"name\": \"tail\", \"joints\": 3, \"channels\": ["
    "{\"spline\": \"sway\", \"axis\": \"side\"}, {\"spline\": \"lift\", \"axis\": \"up\"}]}]}";

static const char *active_name(const struct session *f) { return f->document->splines[active(f->editor)]->name; }

SESSION_TEST(test_a_spline_is_added_at_the_playhead, panel_open(s, scene, 1280, 720))
{
    session_click(s, "ruler(24)");
    const char *before = session_saved(s);
    panel_click(s, "splines.add");
    assert_string_equal(active_name(s), "spline");
    assert_near(s->document->splines[3]->knots[0].frame, 24, 0);
    assert_near(s->document->splines[3]->parameter[PARAMETER_FREQUENCY].value, 1, 0);
    assert_one_step(s, before);
    session_key(s, 'Z', MOD_CTRL);
    assert_true(active(s->editor) >= 0 && active(s->editor) < 3);
}

/// What is being edited stays what it is when the list around it changes, and when that is undone.
SESSION_TEST(test_the_active_spline_is_followed, panel_open(s, scene, 1280, 720))
{
    panel_click(s, "spline.pace");
    const char *before = session_saved(s);
    panel_click(s, "splines.down");
    assert_string_equal(active_name(s), "pace");
    assert_int_equal(active(s->editor), 2);
    assert_one_step(s, before);
    assert_string_equal(active_name(s), "pace");
    session_key(s, 'Z', MOD_CTRL);
    assert_string_equal(active_name(s), "pace");
    panel_click(s, "splines.copy");
    assert_string_equal(active_name(s), "pace 2");
    panel_click(s, "splines.delete"); // nothing follows it: no question
    assert_int_equal(s->document->spline_count, 3);
    assert_int_equal(asked(s->editor), DIALOG_NONE);
}

/// Deleting what others follow asks; then they keep the value of that frame, and the tail lets go of it.
SESSION_TEST(test_deleting_a_followed_spline_asks, panel_open(s, scene, 1280, 720))
{
    session_click(s, "ruler(90)");
    panel_click(s, "spline.pace");
    const char *before = session_saved(s);
    panel_click(s, "splines.delete");
    assert_int_equal(asked(s->editor), DIALOG_ASK);
    session_key(s, KEY_ESCAPE, 0);
    assert_int_equal(s->document->spline_count, 3);
    panel_click(s, "splines.delete");
    session_key(s, 'D', 0);
    assert_int_equal(s->document->spline_count, 2);
    assert_int_equal(s->document->splines[1]->parameter[PARAMETER_FREQUENCY].track, -1);
    assert_near(s->document->splines[1]->parameter[PARAMETER_FREQUENCY].value, 2, 1e-9);
    assert_int_equal(document_tail(s->document, 0)->channels[1].spline, 1);
    assert_one_step(s, before);
    panel_click(s, "spline.lift");
    before = session_saved(s);
    panel_click(s, "splines.delete");
    session_key(s, KEY_ENTER, 0);
    assert_int_equal(document_tail(s->document, 0)->channel_count, 1);
    assert_one_step(s, before);
}

/// The only spline may go as well; what is left still draws, and can be added to.
SESSION_TEST(test_an_empty_list, panel_open(s, scene, 960, 680))
{
    for (int i = 0; i < 3; i++) {
        panel_click(s, "splines.delete");
        if (asked(s->editor) == DIALOG_ASK) session_key(s, 'D', 0);
    }
    assert_int_equal(s->document->spline_count, 0);
    assert_int_equal(active(s->editor), -1);
    panel_click(s, "splines.delete");
    panel_click(s, "splines.copy");
    panel_click(s, "splines.add");
    assert_string_equal(active_name(s), "spline");
}

SESSION_TEST(test_renaming, panel_open(s, scene, 1280, 720))
{
    const char *before = session_saved(s);
    panel_press(s, "spline.sway", 2);
    panel_release(s);
    panel_type(s, "swing");
    session_key(s, KEY_ENTER, 0);
    assert_string_equal(s->document->splines[0]->name, "swing");
    assert_one_step(s, before);
    panel_click(s, "section.splines"); // F2 opens the list again
    session_key(s, KEY_F2, 0);
    panel_type(s, "pace");
    session_key(s, KEY_ENTER, 0);
    assert_string_equal(s->document->splines[0]->name, "swing");
    assert_said(s->editor, "a spline called pace already exists");
    session_key(s, KEY_F2, 0);
    session_key(s, KEY_END, 0); // the name that is there is what is edited
    panel_type(s, "s");
    session_key(s, KEY_ENTER, 0);
    assert_string_equal(s->document->splines[0]->name, "swings");
    session_key(s, 'Z', MOD_CTRL);
    session_key(s, KEY_F2, 0);
    session_key(s, KEY_DELETE, 0); // all is selected
    session_key(s, KEY_ENTER, 0);
    assert_string_equal(s->document->splines[0]->name, "swing");
    assert_said(s->editor, "a spline needs a name");
    assert_int_equal(s->document->splines[0]->knot_count, 3);
}

SESSION_TEST(test_rows_are_dragged_to_their_place, panel_open(s, scene, 1280, 720))
{
    const char *before = session_saved(s);
    panel_press(s, "spline.sway", 1);
    session_drag(s, 0, 2 * UI_ROW, 4);
    assert_string_equal(s->document->splines[0]->name, "sway"); // not before it is dropped
    panel_release(s);
    assert_string_equal(s->document->splines[2]->name, "sway");
    assert_string_equal(active_name(s), "sway");
    assert_one_step(s, before);
}

SESSION_TEST(test_colours, panel_open(s, scene, 1280, 720))
{
    const char *before = session_saved(s);
    panel_click(s, "color.pace");
    panel_click(s, "color.3");
    assert_int_equal(s->document->splines[1]->color, 0x1F9E7A);
    assert_false(inspector_of(s->editor)->popup.id);
    assert_one_step(s, before);
    panel_click(s, "color.pace");
    panel_click(s, "color.type");
    panel_type(s, "#12345");
    session_key(s, KEY_ENTER, 0);
    assert_int_equal(s->document->splines[1]->color, 0x1F9E7A);
    assert_said(s->editor, "colour: expected something like #FFB000, got “#12345”");
    panel_click(s, "color.type");
    panel_type(s, "#123456");
    session_key(s, KEY_ENTER, 0);
    assert_int_equal(s->document->splines[1]->color, 0x123456);
    panel_click(s, "color.none");
    assert_saved(s, before);
}

SESSION_TEST(test_hidden_and_solo_curves, panel_open(s, scene, 1280, 720))
{
    assert_int_equal(s->editor->curves->cache.other_count, 2);
    panel_click(s, "eye.pace");
    assert_int_equal(s->editor->curves->cache.other_count, 1);
    panel_click(s, "spline.pace"); // the order of the list does not matter to what is hidden
    panel_click(s, "splines.up");
    assert_false(curves_show_spline(s->editor, 0));
    panel_click(s, "solo.lift");
    assert_true(curves_show_spline(s->editor, 2));
    assert_false(curves_show_spline(s->editor, 1));
    panel_click(s, "solo.lift");
    panel_click(s, "eye.pace");
    assert_int_equal(s->editor->curves->cache.other_count, 2);
    assert_true(history_is_saved(s->history) == false); // by the reordering alone
}

/// Attached from the list, which has no spline that would make a cycle; detached, it keeps the value at the playhead.
SESSION_TEST(test_a_track_is_attached_and_detached, panel_open(s, scene, 1280, 760))
{
    session_click(s, "ruler(90)");
    const char *before = session_saved(s);
    panel_click(s, "follow.damping");
    assert_true(panel_shows(s, "item.pace"));
    assert_false(panel_shows(s, "item.sway"));
    panel_click(s, "item.pace");
    assert_int_equal(s->document->splines[0]->parameter[PARAMETER_DAMPING].track, 1);
    assert_one_step(s, before);
    assert_false(panel_shows(s, "damping"));
    panel_click(s, "spline.pace");
    panel_click(s, "follow.equilibrium");
    assert_false(ui_popup_is_open(inspector_of(s->editor), "follow")); // both others follow it
    assert_said(s->editor, "no other spline for pace to follow");
    panel_click(s, "spline.sway");
    session_frame(s);
    panel_click(s, "follow.damping");
    assert_int_equal(s->document->splines[0]->parameter[PARAMETER_DAMPING].track, -1);
    assert_near(s->document->splines[0]->parameter[PARAMETER_DAMPING].value, 1, 0); // 2, as far as damping goes
}

SESSION_TEST(test_frames_per_second_ask, panel_open(s, scene, 1280, 1600))
{
    panel_click(s, "section.scene");
    const char *before = session_saved(s);
    panel_enter(s, "scene.fps", "48");
    assert_int_equal(asked(s->editor), DIALOG_ASK);
    assert_near(s->document->fps, 24, 0);
    session_key(s, 'S', 0);
    assert_near(s->document->fps, 48, 0);
    assert_near(s->document->splines[0]->knots[1].frame, 72, 0);
    assert_int_equal(s->document->last_frame, 192);
    assert_one_step(s, before);
    session_key(s, 'Z', MOD_CTRL);
    panel_enter(s, "scene.fps", "48");
    session_key(s, 'F', 0);
    assert_near(s->document->splines[0]->knots[1].frame, 36, 0);
    panel_enter(s, "scene.fps", "0");
    assert_said(s->editor, "rate: expected");
    session_key(s, KEY_ESCAPE, 0);
}

SESSION_TEST(test_a_range_asks_for_its_knots, panel_open(s, scene, 1280, 1640))
{
    panel_click(s, "section.scene");
    session_click(s, "ruler(80)");
    const char *before = session_saved(s);
    panel_enter(s, "scene.last", "50");
    assert_int_equal(asked(s->editor), DIALOG_ASK);
    session_key(s, 'T', 0);
    assert_int_equal(s->document->splines[0]->knot_count, 2);
    assert_near(playback_of(s->editor)->position, 50, 0); // inside again
    assert_one_step(s, before);
    session_key(s, 'Z', MOD_CTRL);
    panel_enter(s, "scene.last", "50");
    session_key(s, 'M', 0);
    assert_near(s->document->splines[0]->knots[2].frame, 50, 0);
    panel_enter(s, "scene.last", "50.5");
    assert_said(s->editor, "last: expected a whole number, got 50.5");
    panel_enter(s, "scene.first", "60");
    assert_said(s->editor, "the last frame must not be before the first");
    panel_enter(s, "scene.first", "-10"); // the playhead stays on its frame
    assert_near(playback_of(s->editor)->position, 60, 0);
    panel_enter(s, "scene.substeps", "4");
    assert_near(shown_frame(s->editor), 50, 0);
    assert_int_equal(s->document->substeps, 4);
}

/// More frames than the splines' samples allow are refused in the field, and nothing is asked about knots.
SESSION_TEST(a_range_has_an_end, panel_open(s, scene, 1280, 2000))
{
    panel_click(s, "section.scene");
    panel_enter(s, "scene.substeps", "4");
    const int longest = (SPLINE_MAX_SAMPLES - 1) / 4;
    const char *before = session_saved(s);
    char most[64];
    panel_enter(s, "scene.last", "999999999");
    assert_int_equal(asked(s->editor), DIALOG_NONE);
    snprintf(most, sizeof most, "last: expected -1000000000 … %d, got 999999999", longest);
    assert_string_equal(said(s->editor), most);
    panel_enter(s, "scene.first", "-999999999");
    snprintf(most, sizeof most, "first: expected %d … 1000000000", s->document->last_frame - longest);
    assert_said(s->editor, most);
    assert_saved(s, before);
    snprintf(most, sizeof most, "%d", longest);
    panel_enter(s, "scene.last", most);
    assert_int_equal(s->document->last_frame, longest);
}

static unsigned next_random(unsigned *seed) { return (*seed = *seed * 1664525u + 1013904223u) >> 8; }

static void random_input(struct session *f, unsigned *seed)
{
    static const int keys[] = {KEY_ENTER, KEY_ESCAPE, KEY_TAB, KEY_UP, KEY_DOWN,  KEY_LEFT,
                               KEY_RIGHT, KEY_DELETE, KEY_F2,  '3',    KEY_SPACE, KEY_BACKSPACE};
    struct rect area = layout_of(f->editor)->inspector;
    switch (next_random(seed) % 6) {
    case 0:
    case 1:
        session_press(f, next_random(seed) % 8 ? BUTTON_LEFT : BUTTON_RIGHT, 1 + (int)(next_random(seed) % 4 == 0));
        break;
    case 2:
        session_release(f, BUTTON_LEFT);
        break;
    case 3:
        session_key(f, keys[next_random(seed) % 12], 0);
        session_send(f, (struct event){.kind = EVENT_TEXT, .codepoint = '0' + next_random(seed) % 75});
        break;
    case 4:
        session_wheel(f, (float)(next_random(seed) % 7) - 3);
        break;
    default:
        session_move(f, area.x + (float)(next_random(seed) % 280), (float)(next_random(seed) % 700));
        break;
    }
    if (next_random(seed) % 200 == 0) session_key(f, 'Z', MOD_CTRL);
}

/// Whatever is pressed, dragged and typed: the document stays one that loads, and all of it can be undone.
TEST(test_random_input_comes_back)
{
    int steps = 0;
    for (unsigned seed = 1; seed <= (unsigned)quick_or_all(2, 6); seed++) {
        struct session f;
        unsigned random = seed;
        panel_open(&f, scene, 1280, 1600);
        panel_click(&f, "section.scene");
        const char *first = session_saved(&f);
        for (int i = 0; i < 3000 && f.document->spline_count < 50; i++) random_input(&f, &random);
        for (int i = 0; i < 3; i++) session_key(&f, KEY_ESCAPE, 0);
        session_release(&f, BUTTON_LEFT);
        session_key(&f, KEY_ESCAPE, 0);
        assert_loads_again(f.document);
        assert_false(history_is_open(f.history));
        while (history_undo(f.history)) steps++;
        assert_saved(&f, first);
        session_close(&f);
    }
    assert_true(steps >= quick_or_all(10, 60));
}
