/// The inspector's scene, list of splines, tracks and palette, by the events of mouse and keyboard.
#include "editor/core/spline_list.h"
#include "inside.h"
#include "panel_session.h"

static const char scene[] =
    "{\"wiggly\": 1, \"frames\": [0, 96], \"splines\": [" PANEL_SPLINES "],"
    "\"rigs\": [{\"type\": \"tail\", \"name\": \"tail\", \"joints\": 3, \"channels\": ["
    "{\"spline\": \"sway\", \"axis\": \"side\"}, {\"spline\": \"lift\", \"axis\": \"up\"}]}]}";

static const char *active_name(const struct session *f) { return f->document->splines[f->editor->core.active]->name; }

TEST(test_a_spline_is_added_at_the_playhead)
{
    struct session f;
    panel_open(&f, scene, 1280, 720);
    session_click(&f, "ruler(24)");
    char *before = session_saved(&f);
    panel_click(&f, "spline.add");
    assert_string_equal(active_name(&f), "spline");
    assert_near(f.document->splines[3]->knots[0].frame, 24, 0);
    assert_near(f.document->splines[3]->parameter[PARAMETER_FREQUENCY].value, 1, 0);
    assert_one_step(&f, before);
    session_key(&f, 'Z', MOD_CTRL);
    assert_true(f.editor->core.active >= 0 && f.editor->core.active < 3);
    free(before);
    session_close(&f);
}

/// What is being edited stays what it is when the list around it changes, and when that is undone.
TEST(test_the_active_spline_is_followed)
{
    struct session f;
    panel_open(&f, scene, 1280, 720);
    panel_click(&f, "spline.pace");
    char *before = session_saved(&f);
    panel_click(&f, "spline.down");
    assert_string_equal(active_name(&f), "pace");
    assert_int_equal(f.editor->core.active, 2);
    assert_one_step(&f, before);
    assert_string_equal(active_name(&f), "pace");
    session_key(&f, 'Z', MOD_CTRL);
    assert_string_equal(active_name(&f), "pace");
    panel_click(&f, "spline.copy");
    assert_string_equal(active_name(&f), "pace 2");
    panel_click(&f, "spline.delete"); // nothing follows it: no question
    assert_int_equal(f.document->spline_count, 3);
    assert_int_equal(f.editor->dialogs->dialog.kind, DIALOG_NONE);
    free(before);
    session_close(&f);
}

/// Deleting what others follow asks; then they keep the value of that frame, and the tail lets go of it.
TEST(test_deleting_a_followed_spline_asks)
{
    struct session f;
    panel_open(&f, scene, 1280, 720);
    session_click(&f, "ruler(90)");
    panel_click(&f, "spline.pace");
    char *before = session_saved(&f);
    panel_click(&f, "spline.delete");
    assert_int_equal(f.editor->dialogs->dialog.kind, DIALOG_ASK);
    session_key(&f, KEY_ESCAPE, 0);
    assert_int_equal(f.document->spline_count, 3);
    panel_click(&f, "spline.delete");
    session_key(&f, 'D', 0);
    assert_int_equal(f.document->spline_count, 2);
    assert_int_equal(f.document->splines[1]->parameter[PARAMETER_FREQUENCY].track, -1);
    assert_near(f.document->splines[1]->parameter[PARAMETER_FREQUENCY].value, 2, 1e-9);
    assert_int_equal(document_tail(f.document, 0)->channels[1].spline, 1);
    assert_one_step(&f, before);
    free(before);
    panel_click(&f, "spline.lift");
    before = session_saved(&f);
    panel_click(&f, "spline.delete");
    session_key(&f, KEY_ENTER, 0);
    assert_int_equal(document_tail(f.document, 0)->channel_count, 1);
    assert_one_step(&f, before);
    free(before);
    session_close(&f);
}

/// The only spline may go as well; what is left still draws, and can be added to.
TEST(test_an_empty_list)
{
    struct session f;
    panel_open(&f, scene, 960, 600);
    for (int i = 0; i < 3; i++) {
        panel_click(&f, "spline.delete");
        if (f.editor->dialogs->dialog.kind == DIALOG_ASK) session_key(&f, 'D', 0);
    }
    assert_int_equal(f.document->spline_count, 0);
    assert_int_equal(f.editor->core.active, -1);
    panel_click(&f, "spline.delete");
    panel_click(&f, "spline.copy");
    panel_click(&f, "spline.add");
    assert_string_equal(active_name(&f), "spline");
    session_close(&f);
}

TEST(test_renaming)
{
    struct session f;
    panel_open(&f, scene, 1280, 720);
    char *before = session_saved(&f);
    panel_press(&f, "spline.sway", 2);
    panel_release(&f);
    panel_type(&f, "swing");
    session_key(&f, KEY_ENTER, 0);
    assert_string_equal(f.document->splines[0]->name, "swing");
    assert_one_step(&f, before);
    panel_click(&f, "section.splines"); // F2 opens the list again
    session_key(&f, KEY_F2, 0);
    panel_type(&f, "pace");
    session_key(&f, KEY_ENTER, 0);
    assert_string_equal(f.document->splines[0]->name, "swing");
    assert_non_null(strstr(f.editor->core.message.text, "a spline called pace already exists"));
    session_key(&f, KEY_F2, 0);
    session_key(&f, KEY_END, 0); // the name that is there is what is edited
    panel_type(&f, "s");
    session_key(&f, KEY_ENTER, 0);
    assert_string_equal(f.document->splines[0]->name, "swings");
    session_key(&f, 'Z', MOD_CTRL);
    session_key(&f, KEY_F2, 0);
    session_key(&f, KEY_DELETE, 0); // all is selected
    session_key(&f, KEY_ENTER, 0);
    assert_string_equal(f.document->splines[0]->name, "swing");
    assert_non_null(strstr(f.editor->core.message.text, "a spline needs a name"));
    assert_int_equal(f.document->splines[0]->knot_count, 3);
    free(before);
    session_close(&f);
}

TEST(test_rows_are_dragged_to_their_place)
{
    struct session f;
    panel_open(&f, scene, 1280, 720);
    char *before = session_saved(&f);
    panel_press(&f, "spline.sway", 1);
    session_drag(&f, 0, 2 * UI_ROW, 4);
    assert_string_equal(f.document->splines[0]->name, "sway"); // not before it is dropped
    panel_release(&f);
    assert_string_equal(f.document->splines[2]->name, "sway");
    assert_string_equal(active_name(&f), "sway");
    assert_one_step(&f, before);
    free(before);
    session_close(&f);
}

TEST(test_colours)
{
    struct session f;
    panel_open(&f, scene, 1280, 720);
    char *before = session_saved(&f);
    panel_click(&f, "color.pace");
    panel_click(&f, "color.3");
    assert_int_equal(f.document->splines[1]->color, 0x1F9E7A);
    assert_false(f.editor->inspector->ui.popup.id);
    assert_one_step(&f, before);
    panel_click(&f, "color.pace");
    panel_click(&f, "color.type");
    panel_type(&f, "#12345");
    session_key(&f, KEY_ENTER, 0);
    assert_int_equal(f.document->splines[1]->color, 0x1F9E7A);
    assert_non_null(strstr(f.editor->core.message.text, "colour: expected something like #FFB000, got “#12345”"));
    panel_click(&f, "color.type");
    panel_type(&f, "#123456");
    session_key(&f, KEY_ENTER, 0);
    assert_int_equal(f.document->splines[1]->color, 0x123456);
    panel_click(&f, "color.none");
    assert_saved(&f, before);
    free(before);
    session_close(&f);
}

TEST(test_hidden_and_solo_curves)
{
    struct session f;
    panel_open(&f, scene, 1280, 720);
    assert_int_equal(f.editor->curves->cache.other_count, 2);
    panel_click(&f, "eye.pace");
    assert_int_equal(f.editor->curves->cache.other_count, 1);
    panel_click(&f, "spline.pace"); // the order of the list does not matter to what is hidden
    panel_click(&f, "spline.up");
    assert_false(spline_list_shows(&f.editor->core, f.document, 0));
    panel_click(&f, "solo.lift");
    assert_true(spline_list_shows(&f.editor->core, f.document, 2));
    assert_false(spline_list_shows(&f.editor->core, f.document, 1));
    panel_click(&f, "solo.lift");
    panel_click(&f, "eye.pace");
    assert_int_equal(f.editor->curves->cache.other_count, 2);
    assert_true(history_is_saved(f.history) == false); // by the reordering alone
    session_close(&f);
}

/// Attached from the list, which has no spline that would make a cycle; detached, it keeps the value at the playhead.
TEST(test_a_track_is_attached_and_detached)
{
    struct session f;
    panel_open(&f, scene, 1280, 720);
    session_click(&f, "ruler(90)");
    char *before = session_saved(&f);
    panel_click(&f, "follow.damping");
    assert_true(panel_shows(&f, "item.pace"));
    assert_false(panel_shows(&f, "item.sway"));
    panel_click(&f, "item.pace");
    assert_int_equal(f.document->splines[0]->parameter[PARAMETER_DAMPING].track, 1);
    assert_one_step(&f, before);
    assert_false(panel_shows(&f, "damping"));
    panel_click(&f, "spline.pace");
    panel_click(&f, "follow.equilibrium");
    assert_false(ui_popup_is_open(&f.editor->inspector->ui, "follow")); // both others follow it
    assert_non_null(strstr(f.editor->core.message.text, "no other spline for pace to follow"));
    panel_click(&f, "spline.sway");
    session_frame(&f);
    panel_click(&f, "follow.damping");
    assert_int_equal(f.document->splines[0]->parameter[PARAMETER_DAMPING].track, -1);
    assert_near(f.document->splines[0]->parameter[PARAMETER_DAMPING].value, 1, 0); // 2, as far as damping goes
    free(before);
    session_close(&f);
}

TEST(test_frames_per_second_ask)
{
    struct session f;
    panel_open(&f, scene, 1280, 1600);
    panel_click(&f, "section.scene");
    char *before = session_saved(&f);
    panel_enter(&f, "scene.fps", "48");
    assert_int_equal(f.editor->dialogs->dialog.kind, DIALOG_ASK);
    assert_near(f.document->fps, 24, 0);
    session_key(&f, 'S', 0);
    assert_near(f.document->fps, 48, 0);
    assert_near(f.document->splines[0]->knots[1].frame, 72, 0);
    assert_int_equal(f.document->last_frame, 192);
    assert_one_step(&f, before);
    session_key(&f, 'Z', MOD_CTRL);
    panel_enter(&f, "scene.fps", "48");
    session_key(&f, 'F', 0);
    assert_near(f.document->splines[0]->knots[1].frame, 36, 0);
    panel_enter(&f, "scene.fps", "0");
    assert_non_null(strstr(f.editor->core.message.text, "rate: expected"));
    session_key(&f, KEY_ESCAPE, 0);
    free(before);
    session_close(&f);
}

TEST(test_a_range_asks_for_its_knots)
{
    struct session f;
    panel_open(&f, scene, 1280, 1600);
    panel_click(&f, "section.scene");
    session_click(&f, "ruler(80)");
    char *before = session_saved(&f);
    panel_enter(&f, "scene.last", "50");
    assert_int_equal(f.editor->dialogs->dialog.kind, DIALOG_ASK);
    session_key(&f, 'T', 0);
    assert_int_equal(f.document->splines[0]->knot_count, 2);
    assert_near(f.editor->core.playback.position, 50, 0); // inside again
    assert_one_step(&f, before);
    session_key(&f, 'Z', MOD_CTRL);
    panel_enter(&f, "scene.last", "50");
    session_key(&f, 'M', 0);
    assert_near(f.document->splines[0]->knots[2].frame, 50, 0);
    panel_enter(&f, "scene.last", "50.5");
    assert_non_null(strstr(f.editor->core.message.text, "last: expected a whole number, got 50.5"));
    panel_enter(&f, "scene.first", "60");
    assert_non_null(strstr(f.editor->core.message.text, "the last frame must not be before the first"));
    panel_enter(&f, "scene.first", "-10"); // the playhead stays on its frame
    assert_near(f.editor->core.playback.position, 60, 0);
    panel_enter(&f, "scene.substeps", "4");
    assert_near(core_frame(&f.editor->core, f.document), 50, 0);
    assert_int_equal(f.document->substeps, 4);
    free(before);
    session_close(&f);
}

/// More frames than the splines' samples allow are refused in the field, and nothing is asked about knots.
TEST(a_range_has_an_end)
{
    struct session f;
    panel_open(&f, scene, 1280, 2000);
    panel_click(&f, "section.scene");
    panel_enter(&f, "scene.substeps", "4");
    const int longest = (SPLINE_MAX_SAMPLES - 1) / 4;
    char *before = session_saved(&f), most[64];
    panel_enter(&f, "scene.last", "999999999");
    assert_int_equal(f.editor->dialogs->dialog.kind, DIALOG_NONE);
    snprintf(most, sizeof most, "last: expected -1000000000 … %d, got 999999999", longest);
    assert_string_equal(f.editor->core.message.text, most);
    panel_enter(&f, "scene.first", "-999999999");
    snprintf(most, sizeof most, "first: expected %d … 1000000000", f.document->last_frame - longest);
    assert_non_null(strstr(f.editor->core.message.text, most));
    char *after = session_saved(&f);
    assert_string_equal(after, before);
    snprintf(most, sizeof most, "%d", longest);
    panel_enter(&f, "scene.last", most);
    assert_int_equal(f.document->last_frame, longest);
    free(before);
    free(after);
    session_close(&f);
}

static unsigned next_random(unsigned *seed) { return (*seed = *seed * 1664525u + 1013904223u) >> 8; }

static void random_input(struct session *f, unsigned *seed)
{
    static const int keys[] = {KEY_ENTER, KEY_ESCAPE, KEY_TAB, KEY_UP, KEY_DOWN,  KEY_LEFT,
                               KEY_RIGHT, KEY_DELETE, KEY_F2,  '3',    KEY_SPACE, KEY_BACKSPACE};
    struct rect area = f->editor->core.layout.inspector;
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
        char *first = session_saved(&f);
        for (int i = 0; i < 3000 && f.document->spline_count < 50; i++) random_input(&f, &random);
        for (int i = 0; i < 3; i++) session_key(&f, KEY_ESCAPE, 0);
        session_release(&f, BUTTON_LEFT);
        session_key(&f, KEY_ESCAPE, 0);
        struct error error = {0};
        char *last = session_saved(&f);
        struct document *again = scene_parse("again", last, strlen(last), NULL, &error);
        if (!again) fail_msg("seed %u: what was saved does not load: %s", seed, error.text);
        document_destroy(again);
        assert_false(history_is_open(f.history));
        while (history_undo(f.history)) steps++;
        assert_saved(&f, first);
        free(last);
        free(first);
        session_close(&f);
    }
    assert_true(steps >= quick_or_all(10, 60));
}

int main(void) { return tests_run(NULL, NULL); }
