/// The Export dialog: the name's ending is the format, what the format lets choose, and what is remembered.
#include "panel_session.h"
#include "shown.h"

#include "app/state.h"

static const char scene[] = "{\"frames\": [0, 48], \"substeps\": 2, \"splines\": [{\"name\": \"sway\", \"knots\": "
                            "[{\"frame\": 0, \"value\": 0}, {\"frame\": 12, \"value\": 1}]}],"
                            "\"rigs\": [{\"type\": \"tail\", \"name\": \"fox\", \"spline\": \"sway\"},"
                            " {\"type\": \"tail\", \"name\": \"cat\", \"spline\": \"sway\"}]}";

static struct exporting *of(struct session *s) { return &s->editor->dialogs->exporting; }

static void open_other(struct session *s, const char *text, const char *path, float width, float height)
{
    panel_open(s, text, width, height);
    list_files(s->editor, &(struct editor_app){.format_count = exporting_format_count()});
    set_path(s->editor, path);
    session_key(s, 'E', MOD_CTRL);
    assert_int_equal(dialog_of(s->editor)->kind, DIALOG_EXPORT);
}

static void open_session(struct session *s, const char *path, float width, float height)
{
    open_other(s, scene, path, width, height);
}

static void click_at(struct session *s, float x, float y, int clicks)
{
    session_move(s, x, y);
    session_press(s, BUTTON_LEFT, clicks);
    session_release(s, BUTTON_LEFT);
}

static void click(struct session *s, const char *text)
{
    const struct draw_command *command = shown_text(s->editor, text);
    if (!command) fail_msg("“%s” is not on the screen", text);
    click_at(s, command->x + 4, command->y - 4, 1);
}

/// Types over the number that is so far right of a word.
static void enter(struct session *s, const char *word, float right, const char *number)
{
    const struct draw_command *command = shown_text(s->editor, word);
    if (!command) fail_msg("“%s” is not on the screen", word);
    click_at(s, command->x + right, command->y - 4, 2);
    panel_type(s, number);
    session_key(s, KEY_ENTER, 0);
}

static struct request asked_for(struct session *s)
{
    struct request request = session_asked(s);
    assert_int_equal(request.kind, REQUEST_EXPORT);
    return request;
}

SESSION_TEST(test_enter_exports_the_scene, open_session(s, "work/walk.json", 1280, 720))
{
    assert_non_null(shown_text(s->editor, "Write walk.glb"));
    session_key(s, KEY_ENTER, 0);
    struct request request = asked_for(s);
    assert_string_equal(request.path, "work/walk.glb");
    assert_false(request.wish.part);
    assert_int_equal(request.wish.keys, 0);
}

/// A character's own file is not what Enter writes over, whether its scene has a file beside it or none.
TEST(test_a_character_keeps_its_file)
{
    static const char with_dog[] =
        "{\"frames\": [0, 24], \"splines\": [], \"rigs\": [{\"type\": \"model\", \"model\": "
        "\"/somewhere/rex.glb\"}]}";
    static const struct {
        const char *path, *expected;
    } cases[] = {
        {"", "/somewhere/rex-animated.glb"},
        {"/somewhere/rex.json", "/somewhere/rex-animated.glb"},
        {"/somewhere/walk.json", "/somewhere/walk.glb"},
        {"/elsewhere/rex.json", "/elsewhere/rex.glb"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct session s;
        panel_open(&s, with_dog, 1280, 720);
        list_files(s.editor, &(struct editor_app){.format_count = exporting_format_count()});
        set_path(s.editor, cases[i].path);
        session_key(&s, 'E', MOD_CTRL);
        session_key(&s, KEY_ENTER, 0);
        assert_string_equal(asked_for(&s).path, cases[i].expected);
        session_close(&s);
    }
}

SESSION_TEST(test_the_ending_is_the_format, open_session(s, "walk.json", 1280, 720))
{
    panel_type(s, "take.csv"); // over the selected name
    assert_string_equal(export_formats[of(s)->format].ending, ".csv");
    assert_null(shown_text(s->editor, "clip"));
    session_key(s, KEY_DOWN, 0);
    assert_string_equal(of(s)->memory.path, "take.pc2");
    click(s, ".mp4");
    assert_non_null(shown_text(s->editor, "Write take.mp4"));
    assert_non_null(
        shown_text(s->editor, "49 pictures, 24 a second. ↑ ↓ choose the format, Tab goes to the choices."));
    click(s, "take.mp4"); // back in the name, where typing goes on
    panel_type(s, "2");
    assert_non_null(shown_text(s->editor, "Write take.mp42.mp4"));
}

SESSION_TEST(test_a_name_without_an_ending_gets_one, open_session(s, "", 1280, 720))
{
    panel_type(s, "v1.2");
    session_key(s, KEY_ENTER, 0);
    assert_string_equal(asked_for(s).path, "v1.2.glb");
}

SESSION_TEST(test_choices_are_asked_for, open_session(s, "walk.json", 1280, 720))
{
    enter(s, "frames", 120, "12");
    enter(s, "keys a frame", 130, "1");
    assert_int_equal(of(s)->memory.wish.keys, 1);
    enter(s, "keys a frame", 130, "4");
    click(s, "as the scene");
    panel_type(s, "Swing");
    assert_string_equal(of(s)->memory.path, "walk.glb"); // the name is another line of text
    click(s, "all rigs");
    assert_non_null(shown_text(s->editor, "145 keys, 96 a second. ↑ ↓ choose the format, Tab goes to the choices."));
    click(s, "Write walk.glb");
    struct request request = asked_for(s);
    assert_true(request.wish.part && request.wish.first == 12 && request.wish.last == 48);
    assert_int_equal(request.wish.keys, 4);
    assert_string_equal(request.wish.clip, "Swing");
    assert_int_equal(request.wish.rig, s->document->rigs[0]->id);
    assert_null(shown_text(s->editor, "signed morph targets")); // tails have none
}

/// A file that holds one rig is offered no other choice than one.
SESSION_TEST(test_one_rig_only, open_session(s, "walk.json", 1280, 720))
{
    click(s, ".pc2");
    assert_null(shown_text(s->editor, "all rigs"));
    click(s, "fox");
    click(s, "cat");
    assert_non_null(shown_text(s->editor, "fox"));
}

/// However long their names are, and alike at the beginning.
TEST(test_rigs_of_long_names_can_be_chosen)
{
    char text[1024], stem[201] = "";
    for (int i = 0; i < 50; i++) strcat(stem, "尻");
    snprintf(text, sizeof text,
             "{\"frames\": [0, 48], \"splines\": [{\"name\": \"sway\"}], \"rigs\": [{\"type\": \"tail\", \"name\": "
             "\"%s1\", \"spline\": \"sway\"}, {\"type\": \"tail\", \"name\": \"%s2\", \"spline\": \"sway\"}]}",
             stem, stem);
    struct session s;
    open_other(&s, text, "two.json", 1280, 720);
    const struct draw_command *label = shown_text(s.editor, "all rigs");
    const float x = label->x + 4, y = label->y - 4;
    for (int i = 0; i < 2; i++) click_at(&s, x, y, 1);
    click(&s, "Write two.glb");
    assert_int_equal(asked_for(&s).wish.rig, s.document->rigs[1]->id);
    session_close(&s);
}

/// Chains go with their character, also where joints alone are written.
TEST(test_joints_are_those_of_the_character)
{
    static const char dog[] = "{\"frames\": [0, 48], \"splines\": [{\"name\": \"sway\"}], \"rigs\": [{\"type\": "
                              "\"model\", \"name\": \"dog\", \"model\": \"dog.glb\"}, {\"type\": \"chain\", "
                              "\"name\": \"brush\", \"model\": \"dog\", \"from\": \"a\", \"to\": \"b\", "
                              "\"channels\": [{\"spline\": \"sway\"}]}, {\"type\": \"chain\", \"name\": \"ear\", "
                              "\"model\": \"dog\", \"from\": \"c\", \"to\": \"d\", \"channels\": [{\"spline\": "
                              "\"sway\"}]}]}";
    struct session s;
    open_other(&s, dog, "dog.json", 1280, 720);
    for (int f = 0; f < 2; f++) {
        click(&s, f ? ".bvh" : ".pc2");
        assert_null(shown_text(s.editor, "brush"));
        assert_null(shown_text(s.editor, "all clips"));
    }
    click(&s, ".glb");
    const struct draw_command *label = shown_text(s.editor, "all clips");
    click_at(&s, label->x - 20, label->y - 4, 1);
    assert_true(of(&s)->memory.wish.all_clips);
    session_close(&s);
}

SESSION_TEST(test_size_of_pictures, open_session(s, "walk.json", 1280, 720))
{
    click(s, ".gif");
    assert_non_null(shown_text(s->editor, "640"));
    enter(s, "size", 120, "320");
    click(s, "Write walk.gif");
    struct request request = asked_for(s);
    assert_int_equal(request.wish.width, 320);
    assert_int_equal(request.wish.height, 360);
}

/// A loop's last frame is its first, which a .gif does not show twice; nor does it show more than 50 pictures a second.
TEST(test_pictures_of_a_loop)
{
    static const char loop[] = "{\"fps\": 60, \"frames\": [0, 120], \"splines\": [{\"name\": \"sway\", "
                               "\"start\": \"loop\", \"knots\": [{\"frame\": 0, \"value\": 1}]}]}";
    struct session s;
    open_other(&s, loop, "walk.json", 1280, 720);
    click(&s, ".png");
    assert_non_null(
        shown_text(s.editor, "121 pictures, 60 a second. ↑ ↓ choose the format, Tab goes to the choices."));
    click(&s, ".gif");
    assert_non_null(
        shown_text(s.editor, "100 pictures, 50 a second. ↑ ↓ choose the format, Tab goes to the choices."));
    session_close(&s);
}

SESSION_TEST(test_cancelling, open_session(s, "walk.json", 1280, 720))
{
    session_key(s, KEY_ENTER, 0);
    asked_for(s);
    s->editor->core.app.figures = &(struct figures){.ui_scale = 1, .done = 30, .total = 97};
    session_frame(s);
    assert_non_null(shown_text(s->editor, "30 of 97. Esc cancels and leaves nothing behind."));
    session_key(s, KEY_DELETE, 0); // nothing else is done meanwhile
    panel_type(s, "x");
    assert_string_equal(of(s)->memory.path, "walk.glb");
    session_key(s, KEY_ESCAPE, 0);
    assert_int_equal(session_asked(s).kind, REQUEST_EXPORT_STOP);
    click(s, "Cancel");
    assert_int_equal(session_asked(s).kind, REQUEST_EXPORT_STOP);
    panel_answer(s, REQUEST_EXPORT, false, "Cancelled. Nothing was written.");
    session_frame(s);
    assert_non_null(shown_text(s->editor, "Cancelled. Nothing was written."));
    session_key(s, KEY_ESCAPE, 0);
    assert_int_equal(dialog_of(s->editor)->kind, DIALOG_NONE);
    assert_int_equal(session_asked(s).kind, REQUEST_NONE);
}

/// Esc belongs to a number while it is typed.
SESSION_TEST(test_escape_in_a_number, open_session(s, "walk.json", 1280, 720))
{
    const struct draw_command *word = shown_text(s->editor, "frames");
    click_at(s, word->x + 120, word->y - 4, 2);
    panel_type(s, "5");
    session_key(s, KEY_ESCAPE, 0);
    assert_int_equal(dialog_of(s->editor)->kind, DIALOG_EXPORT);
    assert_true(of(s)->memory.wish.first == 0);
}

SESSION_TEST(test_remembered, open_session(s, "walk.json", 1280, 720))
{
    panel_type(s, "films/first.webm");
    click(s, "transparent");
    session_key(s, KEY_ESCAPE, 0);
    session_key(s, 'E', MOD_CTRL);
    assert_non_null(shown_text(s->editor, "films/first.webm"));
    session_key(s, KEY_ESCAPE, 0);
    editor_open(s->editor, &s->world);
    set_path(s->editor, "work/run.json");
    session_key(s, 'E', MOD_CTRL);
    assert_non_null(shown_text(s->editor, "work/run.webm")); // its own name, in the format of last time
    for (int format = 0; format < dialog_of(s->editor)->app->format_count; format++) { // whichever that was
        const char *ending = export_formats[format].ending;
        struct export_memory memory = {.path = "films/first"};
        strncat(memory.path, ending, 16);
        session_key(s, KEY_ESCAPE, 0);
        dialogs_set_export(s->editor->dialogs, &memory);
        session_key(s, 'E', MOD_CTRL);
        assert_string_equal(strrchr(s->editor->dialogs->exporting.memory.path, '.'), ending);
    }
}

SESSION_TEST(test_small_windows, open_session(s, "walk.json", 640, 400))
{
    const struct draw_command *button = shown_text(s->editor, "Write walk.glb");
    assert_non_null(button);
    assert_true(button->y < 400);
    panel_type(s, "walk.png"); // the last of the list comes into sight
    const struct draw_command *row = shown_text(s->editor, ".png");
    assert_non_null(row);
    assert_true(row->y > row->clip.y && row->y < row->clip.y + row->clip.h);
}
