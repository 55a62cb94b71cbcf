/// The dialogs that deal with files of before: recent ones, and work that an earlier run left behind.
#include "panel_session.h"
#include "shown.h"

static const char scene[] = "{\"frames\": [0, 48], \"splines\": [{\"name\": \"sway\", \"knots\": "
                            "[{\"frame\": 0, \"value\": 0}, {\"frame\": 12, \"value\": 1}]}]}";

static int list_names(void *user, const char *folder, char names[][256], int max)
{
    (void)user;
    (void)folder;
    assert_true(max >= 2);
    strcpy(names[0], "one.json");
    strcpy(names[1], "two.json");
    return 2;
}

static int list_recent(void *user, struct dialog_recent *files, int most)
{
    (void)user;
    assert_true(most >= 3);
    strcpy(files[0].path, "/home/me/scenes/walk.json");
    strcpy(files[1].path, "/home/me/gone.json");
    strcpy(files[2].path, "/run.json");
    files[0].missing = files[2].missing = false;
    files[1].missing = true;
    return 3;
}

static void open_session(struct session *session)
{
    panel_open(session, scene, 960, 600);
    list_files(session->editor, &(struct editor_app){.list = list_names, .recent = list_recent});
}

static void expect_request(struct session *session, enum request_kind kind, const char *path)
{
    struct request request = session_asked(session);
    assert_int_equal(request.kind, kind);
    assert_string_equal(request.path, path);
}

static void click(struct session *session, const char *text, int clicks)
{
    const struct draw_command *command = shown_text(session->editor, text);
    if (!command) fail_msg("“%s” is not on the screen", text);
    session_move(session, command->x + 4, command->y - 4);
    for (int i = 1; i <= clicks; i++) {
        session_press(session, BUTTON_LEFT, i);
        session_release(session, BUTTON_LEFT);
    }
}

SESSION_TEST(test_recent_files, open_session(s))
{
    session_key(s, 'O', MOD_CTRL);
    assert_int_equal(dialog_of(s->editor)->match_count, 5);
    assert_non_null(shown_text(s->editor, "/home/me/scenes"));
    assert_non_null(shown_text(s->editor, "no longer exists"));
    session_key(s, KEY_DOWN, 0);
    session_key(s, KEY_DOWN, 0);
    session_key(s, KEY_ENTER, 0);
    expect_request(s, REQUEST_NONE, "");
    assert_non_null(strstr(asked_error(s->editor), "/home/me/gone.json no longer exists"));
    panel_type(s, "x"); // another file: what was wrong with that one is off the screen
    assert_string_equal(asked_error(s->editor), "");
    session_key(s, KEY_BACKSPACE, 0);
    session_key(s, KEY_UP, 0);
    session_key(s, KEY_ENTER, 0);
    expect_request(s, REQUEST_OPEN, "/home/me/scenes/walk.json");
}

/// Typing filters them as it filters the folder's names, and they are not offered for saving.
SESSION_TEST(test_recent_files_are_filtered, open_session(s))
{
    session_key(s, 'O', MOD_CTRL);
    panel_type(s, "AL"); // of walk.json
    assert_int_equal(dialog_of(s->editor)->match_count, 1);
    session_key(s, KEY_ENTER, 0); // it does not begin so, hence it is not meant unless it is chosen
    expect_request(s, REQUEST_OPEN, "AL");
    panel_answer(s, REQUEST_OPEN, false, "AL: no such file");
    session_key(s, KEY_DOWN, 0);
    session_key(s, KEY_ENTER, 0);
    expect_request(s, REQUEST_OPEN, "/home/me/scenes/walk.json");
    panel_answer(s, REQUEST_OPEN, false, "no");
    session_key(s, KEY_ESCAPE, 0);
    session_key(s, 'O', MOD_CTRL);
    panel_type(s, "t");
    assert_int_equal(dialog_of(s->editor)->match_count, 1);
    session_key(s, KEY_TAB, 0);
    assert_string_equal(typed(s->editor), "two.json");
    session_key(s, KEY_ESCAPE, 0);
    session_key(s, 'S', MOD_CTRL | MOD_SHIFT);
    assert_int_equal(dialog_of(s->editor)->recent_count, 0);
}

SESSION_TEST(test_mouse_in_the_list, open_session(s))
{
    session_key(s, 'O', MOD_CTRL);
    click(s, "two.json", 1); // a name is chosen first
    expect_request(s, REQUEST_NONE, "");
    assert_string_equal(typed(s->editor), "two.json");
    session_key(s, KEY_ESCAPE, 0);
    session_key(s, 'O', MOD_CTRL);
    click(s, "two.json", 2);
    expect_request(s, REQUEST_OPEN, "two.json");
    editor_open(s->editor, &s->world);
    panel_answer(s, REQUEST_OPEN, true, "");
    session_key(s, 'O', MOD_CTRL);
    session_frame(s);
    click(s, "walk.json", 1); // one click opens a recent file
    expect_request(s, REQUEST_OPEN, "/home/me/scenes/walk.json");
}

SESSION_TEST(test_the_wheel_goes_through_the_list, open_session(s))
{
    session_key(s, 'O', MOD_CTRL);
    session_wheel(s, -1);
    assert_int_equal(dialog_of(s->editor)->choice, 2);
    session_wheel(s, 1);
    assert_int_equal(dialog_of(s->editor)->choice, 0);
}

static const struct recovery_offer offer = {.name = "walk.json", .when = "21 November 2026, 10:00:00", .others = 1};

static void open_offer(struct session *session)
{
    open_session(session);
    offer_recovery(session->editor, &offer);
    session_frame(session);
    assert_non_null(shown_text(session->editor, "Recover unsaved work on walk.json?"));
}

SESSION_TEST(test_recover, open_offer(s))
{
    session_key(s, KEY_DELETE, 0); // the keys are the dialog's
    assert_int_equal(s->document->splines[0]->knot_count, 2);
    session_key(s, KEY_ENTER, 0);
    expect_request(s, REQUEST_RECOVER, "");
    panel_answer(s, REQUEST_RECOVER, false,
                 "recovery-1:3: expected a number"); // it is broken: the choice is open again
    assert_int_equal(asked(s->editor), DIALOG_RECOVER);
    session_key(s, 'R', 0);
    expect_request(s, REQUEST_RECOVER, "");
    tell(s->editor, true, "Unsaved work cannot be kept."); // no answer to it
    assert_int_equal(asked(s->editor), DIALOG_RECOVER);
    panel_answer(s, REQUEST_SCREENSHOT, true, ""); // nor is this one
    assert_int_equal(asked(s->editor), DIALOG_RECOVER);
    editor_open(s->editor, &s->world);
    panel_answer(s, REQUEST_RECOVER, true, "");
    assert_int_equal(asked(s->editor), DIALOG_NONE);
}

SESSION_TEST(test_discard_and_later, open_offer(s))
{
    click(s, "Discard", 1);
    expect_request(s, REQUEST_FORGET, "");
    offer_recovery(s->editor, &offer); // there is another one
    panel_answer(s, REQUEST_FORGET, true, "");
    assert_int_equal(asked(s->editor), DIALOG_RECOVER);
    session_key(s, KEY_ESCAPE, 0);
    assert_int_equal(asked(s->editor), DIALOG_NONE);
    expect_request(s, REQUEST_NONE, "");
    offer_recovery(s->editor, &offer);
    session_frame(s);
    click(s, "Discard", 1);
    expect_request(s, REQUEST_FORGET, "");
    panel_answer(s, REQUEST_FORGET, true, ""); // that was the last one
    assert_int_equal(asked(s->editor), DIALOG_NONE);
    offer_recovery(s->editor, &offer);
    session_send(s, (struct event){.kind = EVENT_CLOSE}); // closing the window decides it later
    expect_request(s, REQUEST_QUIT, "");
}

/// The card for new users goes with a click on it (and only there), Esc, the help, or an edit; not by itself.
SESSION_TEST(test_welcome, open_session(s))
{
    assert_null(shown_text(s->editor, "Got it"));
    welcome(s->editor);
    session_frame(s);
    session_key(s, KEY_RIGHT, 0);
    assert_non_null(shown_text(s->editor, "Got it"));
    click(s, "Got it", 1);
    assert_false(is_welcoming(s->editor));
    welcome(s->editor);
    session_key(s, KEY_ESCAPE, 0);
    assert_false(is_welcoming(s->editor));
    welcome(s->editor);
    session_key(s, KEY_F1, 0);
    assert_false(is_welcoming(s->editor));
    session_key(s, KEY_F1, 0);
    welcome(s->editor);
    session_hold(s, KEY_F1, ACTION_PRESS); // and Esc within the same slow frame
    session_key(s, KEY_ESCAPE, 0);
    assert_false(is_welcoming(s->editor));
    welcome(s->editor);
    session_key(s, 'I', 0);
    assert_int_equal(s->document->splines[0]->knot_count, 3);
    assert_false(is_welcoming(s->editor));
    assert_null(shown_text(s->editor, "Got it"));
}

/// What the card says suits the scene: before and after a character of one's own is dropped on the window.
SESSION_TEST(test_welcome_with_a_character, open_session(s))
{
    welcome(s->editor);
    session_frame(s);
    assert_non_null(shown_text(s->editor, "Drop a .glb"));
    session_send(s, (struct event){.kind = EVENT_DROP, .path = "/home/ada/rex.glb"});
    expect_request(s, REQUEST_OPEN, "/home/ada/rex.glb");
    session_close(s);
    panel_open(
        s,
        "{\"frames\": [0, 24], \"splines\": [], \"rigs\": [{\"type\": \"model\", \"model\": \"/home/ada/rex.glb\"}]}",
        1280, 720);
    welcome(s->editor);
    session_frame(s);
    assert_non_null(shown_text(s->editor, "Press Shift+J"));
    assert_null(shown_text(s->editor, "Drop a .glb"));
}

/// Opens a scene with the card on; whether card and status line say what is to be said of it.
static void expect_advice(const char *json, const char *first, const char *status)
{
    struct session s;
    panel_open(&s, json, 1280, 720);
    hush(s.editor); // that there is no such model
    welcome(s.editor);
    session_frame(&s);
    assert_non_null(shown_text(s.editor, first));
    assert_non_null(shown_text(s.editor, status));
    session_close(&s);
}

TEST(test_advice_names_what_is_there)
{
#define SWING_BY(knots) "{\"frames\": [0, 24], \"splines\": [{\"name\": \"swing\", \"knots\": [" knots "]}]"
#define SWING SWING_BY("{\"frame\": 0, \"value\": 1}")
#define REX "{\"type\": \"model\", \"name\": \"rex\", \"model\": \"/home/ada/rex.glb\"}"
    expect_advice(SWING
                  ", \"rigs\": [{\"type\": \"tail\", \"name\": \"t\", \"channels\": [{\"spline\": \"swing\"}]}]}",
                  "Drag the fox", "Drag the fox, its tail or a knot. Space plays, F1 shows all keys");
    expect_advice(
        SWING ", \"rigs\": [{\"type\": \"character\", \"model\": \"/home/ada/bear.glb\", \"coordinates\": []}]}",
        "Drag the character", "Drag the character to pin a point of it, or a knot. Space plays, F1 shows all keys");
    expect_advice(SWING
                  ", \"rigs\": [" REX
                  ", {\"type\": \"chain\", \"name\": \"tail\", \"model\": \"rex\", \"from\": \"a\", \"to\": \"b\", "
                  "\"channels\": [{\"spline\": \"swing\"}]}]}",
                  "Pull a chain", "Drag a chain or a knot, or click a bone to make another chain. F1 shows all keys");
    expect_advice(SWING ", \"rigs\": [" REX "]}", "Click a bone",
                  "Click a bone, then press Shift+J to let it swing. F1 shows all keys");
    expect_advice(SWING_BY("") ", \"rigs\": [{\"type\": \"character\", \"model\": \"/home/ada/bear.glb\", "
                               "\"coordinates\": []}]}",
                  "adds a knot to a curve",
                  "Drag the character to pin a point of it. Space plays, F1 shows all keys");
    expect_advice(SWING_BY("") "}", "Double-click", "Double-click to set a knot. Space plays, F1 shows all keys");
    expect_advice(SWING "}", "Double-click", "Drag a knot. Space plays, F1 shows all keys");
}

/// In the smallest window all buttons are inside of the dialog, which has a margin of 12 pixels.
SESSION_TEST(test_buttons_fit_the_smallest_window, open_session(s))
{
    static const char *const all[][4] = {{"Keep mine", "Take theirs", "Save as", "Cancel"}, {"Cancel", "Save"}};
    for (int saving = 0; saving < 2; saving++) {
        editor_resize(s->editor, 480, 320, 1);
        if (!saving) dialogs_ask_changed(s->editor->dialogs, "walk.json", true);
        if (saving) dialogs_save_as(s->editor->dialogs);
        session_frame(s);
        const char *title = saving ? "Save the scene as" : "walk.json has changed on the disk";
        const float left = shown_text(s->editor, title)->x;
        for (int i = 0; i < 4 && all[saving][i]; i++) {
            const struct draw_command *shown = shown_text(s->editor, all[saving][i]);
            assert_non_null(shown);
            assert_true(shown->x >= left && shown->x < 480 - left && shown->y < 320 - 16);
        }
        session_key(s, KEY_ESCAPE, 0);
    }
}
