/// Dialogs by their keys and buttons: open, save, quit, recover, export; and the card for new users.
#include "hands.h"

#include "app/state.h"

static const char scene[] =
    "{'frames': [0, 48], 'substeps': 2, 'splines': [{'name': 'sway', 'knots': [{'frame': 0, 'value': 0}, {'frame': "
    "12, 'value': 1}]}], 'rigs': [{'type': 'tail', 'name': 'fox', 'spline': 'sway'}, {'type': 'tail', 'name': 'cat', "
    "'spline': 'sway'}]}";

static int listings;

static int list_names(void *user, const char *folder, char names[][256], int max)
{
    static const char *const here[] = {"selfie.json",  "figures/", "figure1.json",
                                       "figure3.json", "two.json", "walk.png"};
    static const char *const figures[] = {"one.json", "two.json"};
    const bool is_here = strcmp(folder, ".") == 0;
    const int count = is_here ? 6 : strcmp(folder, "figures/") == 0 ? 2 : -1;
    (void)user;
    assert_true(max >= 6);
    listings++;
    for (int i = 0; i < count; i++) snprintf(names[i], 256, "%s", is_here ? here[i] : figures[i]);
    return count;
}

static int list_recent(void *user, struct dialog_recent *files, int most)
{
    static const char *const paths[] = {"/home/me/scenes/walk.json", "/home/me/gone.json", "/run.json"};
    (void)user;
    assert_true(most >= 3);
    for (int i = 0; i < 3; i++) {
        snprintf(files[i].path, sizeof files[i].path, "%s", paths[i]);
        files[i].missing = i == 1;
    }
    return 3;
}

static void open_files(struct session *s, const char *path)
{
    panel_open(s, scene, 960, 600);
    list_files(s->editor, &(struct editor_app){.list = list_names, .recent = list_recent});
    set_path(s->editor, path);
    listings = 0;
}

// --- open ---------------------------------------------------------------------------------------------------------------

WALK(test_recent_files, open_files(s, "x.json"),
     "key Ctrl+O; is matches 8; shows /home/me/scenes; shows no longer exists;"
     "key Down Down Enter; asks nothing; is refused /home/me/gone.json no longer exists.;"
     "type x; is refused ;" // another file: what was wrong with that one is off the screen
     "key Backspace Up Enter; asks open /home/me/scenes/walk.json")

/// A picture, or a folder of them, is neither opened nor saved over, but added.
WALK(test_backgrounds_are_added, open_files(s, "x.json"),
     "key Ctrl+O; type walk; is matches 1; key Escape; key F3; type reference; key Enter; is asked add;"
     "is matches 2; key Down Enter; is typed figures/; key Enter; asks add figures/; answer add no; is refused no;"
     "key Escape F3; type video; key Enter; type wa; is matches 1; key Enter; asks add walk.png")

/// Typing filters them as it filters the folder's names, and they are not offered for saving.
WALK(test_recent_files_are_filtered, open_files(s, "x.json"),
     "key Ctrl+O; type AL; is matches 1;"
     "key Enter; asks open AL;" // walk.json does not begin so, hence it is not meant unless it is chosen
     "answer open AL: no such file; key Down Enter; asks open /home/me/scenes/walk.json; answer open no;"
     "key Escape Ctrl+O; type t; is matches 1; key Tab; is typed two.json;"
     "key Escape Ctrl+Shift+S; is recent 0")

/// One click chooses a name and opens a recent file; two open a name.
WALK(test_the_mouse_in_the_list, open_files(s, "x.json"),
     "key Ctrl+O; tap two.json; asks nothing; is typed two.json;"
     "key Escape Ctrl+O; tap two.json; again; asks open two.json; opened; answer open;"
     "key Ctrl+O; wait; tap walk.json; asks open /home/me/scenes/walk.json; answer open no;"
     "key Escape Ctrl+O; wheel -1; is choice 2; wheel 1; is choice 0")

/// Names that begin so come before those that have it in their middle. The folder is listed once, not at every key.
SESSION_TEST(test_open_completes_paths, open_files(s, "x.json"))
{
    const struct dialog *dialog = dialog_of(s->editor);
    hands(s, "key Ctrl+O; type fi; is matches 4");
    assert_string_equal(dialog->match[0].name, "figures/");
    hands(s, "key Tab; is typed figure");
    assert_int_equal(listings, 1);
    hands(s, "key Down Enter; is typed figures/; is matches 2; asks nothing;" // into the folder
             "key Down Down Enter; asks open figures/two.json; answer open figures/two.json:3: expected a number;"
             "is asked open; key Enter; asks open figures/two.json; opened; answer open; is asked none;"
             "key Ctrl+O; type figures/t; is matches 1; hides Nothing matches.;"
             "key Enter; asks open figures/two.json; answer open;" // the only file that can be meant
             "key Ctrl+O; type nobody; shows Nothing matches.");
}

WALK(test_a_dialog_takes_every_key, open_files(s, "x.json"),
     "key Ctrl+O; type vim. ; key Ctrl+Z F1 Delete; is look wiggly; is lookup none; is typed vim. ; kept")

// --- save, and quit -------------------------------------------------------------------------------------------------------

/// What has no file yet asks where, until it succeeds; then it starts from where the file is, not from its bare name.
WALK(test_save_as_stays_until_it_succeeds, open_files(s, ""),
     "key Ctrl+S; is asked save-as; is typed untitled.json;"
     "type no/such/dog; key Enter; asks save-as no/such/dog.json;"
     "answer save-as no/such/dog.json: there is no such folder; is asked save-as;"
     "is refused no/such/dog.json: there is no such folder; said;"
     "key 20*Backspace Enter; asks nothing;" // nothing typed
     "type untitled.json; key Enter; asks save-as untitled.json;"
     "path pets/dog.json; answer save-as; is asked none;"
     "key Ctrl+S; asks save; key Ctrl+Shift+S; is typed pets/dog.json")

/// Changes something, then asks to quit.
static void open_unsaved(struct session *s, const char *path)
{
    open_files(s, path);
    hands(s, "key Right I Ctrl+Q; is asked unsaved");
}

SESSION_TEST(test_quitting_asks_for_unsaved_work, open_unsaved(s, "dog.json"))
{
    hands(s, "key Escape; is asked none; asks nothing;"
             "key Ctrl+Q; type d; asks quit;"
             "key Ctrl+Q Right Enter; asks quit"); // Discard
    session_close(s);
    open_files(s, "dog.json");
    hands(s, "key Ctrl+Q; asks quit"); // nothing to lose
}

/// The work in memory stays until it is saved. What was never saved asks where first, and the S is no part of the name.
SESSION_TEST(test_quit_waits_for_the_save, open_unsaved(s, "dog.json"))
{
    hands(s,
          "type s; asks save; asks nothing; answer save dog.json: the disk is full; asks nothing; is asked unsaved;"
          "type s; asks save");
    history_mark_saved(s->history);
    hands(s, "path pets/dog.json; answer save; asks quit");
    session_close(s);
    open_unsaved(s, "");
    hands(s, "type s; is asked save-as; is typed untitled.json;"
             "key Enter; asks save-as untitled.json; path pets/dog.json; answer save-as; asks quit");
}

WALK(test_cancelled_save_as_forgets_what_was_to_follow, open_unsaved(s, ""),
     "type s; key Escape Ctrl+Shift+S Enter; asks save-as untitled.json;"
     "path pets/dog.json; answer save-as; asks nothing") // does not quit after all

// --- recovery -----------------------------------------------------------------------------------------------------------

static void open_offer(struct session *s)
{
    open_files(s, "x.json");
    hands(s, "offer; shows Recover unsaved work on walk.json?");
}

/// The keys are the dialog's. What is broken leaves the choice open, and so does what answers something else.
SESSION_TEST(test_recover, open_offer(s))
{
    hands(s, "key Delete; kept; key Enter; asks recover; answer recover recovery-1:3: expected a number;"
             "is asked recover; key R; asks recover");
    tell(s->editor, true, "Unsaved work cannot be kept.");
    hands(s, "is asked recover; answer screenshot; is asked recover; opened; answer recover; is asked none");
}

/// Discarding offers the next one, if there is one; Esc, or closing the window, decides it later.
WALK(test_discard_and_later, open_offer(s),
     "tap Discard; asks forget; offer; answer forget; is asked recover; key Escape; is asked none; asks nothing;"
     "offer; tap Discard; asks forget; answer forget; is asked none;"
     "offer; close; asks quit")

// --- the card -----------------------------------------------------------------------------------------------------------

/// The card for new users goes with a click on it (and only there), Esc, the help, or an edit; not by itself.
SESSION_TEST(test_welcome, open_files(s, "x.json"))
{
    hands(s, "hides Got it; welcome; key Right; shows Got it; tap Got it; is welcoming 0;"
             "welcome; key Escape; is welcoming 0;"
             "welcome; key F1; is welcoming 0; key F1; welcome");
    session_hold(s, KEY_F1, ACTION_PRESS); // and Esc within the same slow frame
    hands(s, "key Escape; is welcoming 0;"
             "welcome; key I; is splines.0.knots.# 3; is welcoming 0; hides Got it");
}

/// What the card says suits the scene, and the status line; also after a character of one's own is dropped on the window.
TEST(test_advice_names_what_is_there)
{
#define SWING "[{'name': 'swing', 'knots': [{'frame': 0, 'value': 1}]}]"
#define KNOTLESS "[{'name': 'swing', 'knots': []}]"
#define BEAR "{'type': 'character', 'model': '/home/ada/bear.glb', 'coordinates': [{'name': 'a', 'spline': 'swing'}]}"
#define REX "{'type': 'model', 'name': 'rex', 'model': '/home/ada/rex.glb'}"
    static const struct {
        const char *splines, *rigs, *card, *status;
    } rows[] = {
        {SWING, "{'type': 'tail', 'name': 't', 'channels': [{'spline': 'swing'}]}", "Drag the fox",
         "Drag the fox, its tail or a knot. Space plays, F1 shows all keys"},
        {SWING, BEAR, "Drag the character",
         "Drag the character to pin a point of it, or a knot. Space plays, F1 shows all keys"},
        {SWING,
         REX ", {'type': 'chain', 'name': 'tail', 'model': 'rex', 'from': 'a', 'to': 'b', 'channels': [{'spline': "
             "'swing'}]}",
         "Pull a chain", "Drag a chain or a knot, or click a bone to make another chain. F1 shows all keys"},
        {SWING, REX, "Click a bone", "Click a bone, then press Shift+J to let it swing. F1 shows all keys"},
        {"[]", REX, "Press Shift+J", "Click a bone, then press Shift+J to let it swing. F1 shows all keys"},
        {KNOTLESS, BEAR, "adds a knot to a curve",
         "Drag the character to pin a point of it. Space plays, F1 shows all keys"},
        {KNOTLESS, "", "Double-click", "Double-click to set a knot. Space plays, F1 shows all keys"},
        {SWING, "", "Drop a .glb", "Drag a knot. Space plays, F1 shows all keys"},
        {SWING, "", "Double-click", "Drag a knot. Space plays, F1 shows all keys"},
    };
    for (size_t r = 0; r < sizeof rows / sizeof *rows; r++) {
        struct session s;
        char text[1024];
        snprintf(text, sizeof text, "{'frames': [0, 24], 'splines': %s, 'rigs': [%s]}", rows[r].splines,
                 rows[r].rigs);
        panel_open(&s, text, 1280, 720);
        hush(s.editor); // that there is no such model
        hands(&s, "welcome; shows %s; shows %s", rows[r].card, rows[r].status);
        if (strcmp(rows[r].card, "Press Shift+J") == 0) hands(&s, "hides Drop a .glb");
        session_send(&s, (struct event){.kind = EVENT_DROP, .path = "/home/ada/rex.glb"});
        hands(&s, "asks open /home/ada/rex.glb");
        session_close(&s);
    }
}

/// In the smallest window all buttons are inside of the dialog, which has a margin of 12 pixels.
SESSION_TEST(test_buttons_fit_the_smallest_window, open_files(s, "x.json"))
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
            if (!shown || shown->x < left || shown->x >= 480 - left || shown->y >= 320 - 16)
                fail_msg("“%s” is outside", all[saving][i]);
        }
        session_key(s, KEY_ESCAPE, 0);
    }
}

// --- export: the name's ending is the format, what the format lets choose, and what is remembered ----------------------------

static void open_export(struct session *s, const char *text, const char *path, float width, float height)
{
    panel_open(s, text, width, height);
    list_files(s->editor, &(struct editor_app){.format_count = exporting_format_count()});
    set_path(s->editor, path);
    hands(s, "key Ctrl+E; is asked export");
}

#define EXPORT_TEST(name) SESSION_TEST(name, open_export(s, scene, "walk.json", 1280, 720))

/// Double-clicks the number that is so far right of a word.
static void fill(struct session *s, const char *word, float right, const char *number)
{
    const struct draw_command *text = shown_text(s->editor, word);
    if (!text) fail_msg("“%s” is not on the screen", word);
    session_move(s, text->x + right, text->y - 4);
    session_click_here(s, 2);
    panel_type(s, number);
}

static struct request exported(struct session *s)
{
    const struct request request = session_asked(s);
    assert_int_equal(request.kind, REQUEST_EXPORT);
    return request;
}

SESSION_TEST(test_enter_exports_the_scene, open_export(s, scene, "work/walk.json", 1280, 720))
{
    hands(s, "shows Write walk.glb; key Enter");
    const struct request request = exported(s);
    assert_string_equal(request.path, "work/walk.glb");
    assert_true(!request.wish.part && request.wish.keys == 0);
}

/// A character's own file is not what Enter writes over, whether its scene has a file beside it or none; and a name without an ending gets
/// one.
TEST(test_what_enter_writes)
{
    static const char dog[] =
        "{'frames': [0, 24], 'splines': [], 'rigs': [{'type': 'model', 'model': '/somewhere/rex.glb'}]}";
    static const struct {
        const char *scene, *path, *typed, *writes;
    } rows[] = {
        {dog, "", "", "/somewhere/rex-animated.glb"},
        {dog, "/somewhere/rex.json", "", "/somewhere/rex-animated.glb"},
        {dog, "/somewhere/walk.json", "", "/somewhere/walk.glb"},
        {dog, "/elsewhere/rex.json", "", "/elsewhere/rex.glb"},
        {scene, "", "v1.2", "v1.2.glb"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        struct session s;
        open_export(&s, rows[i].scene, rows[i].path, 1280, 720);
        hands(&s, "type %s; key Enter; asks export %s", rows[i].typed, rows[i].writes);
        session_close(&s);
    }
}

WALK(test_the_ending_is_the_format, open_export(s, scene, "walk.json", 1280, 720),
     "type take.csv; is export.ending .csv; hides clip;" // over the selected name
     "key Down; is export.path take.gif; hides .pc2; type take.npy; wait; shows .npy; key Down;"
     "is export.path take.gif; key Up; is export.path take.csv; tap More formats; shows .pc2; key Up;"
     "is export.path take.bvh; tap .mp4; shows Write take.mp4;"
     "shows 49 pictures, 24 a second. ↑ ↓ choose the format, Tab goes to the choices.;"
     "tap take.mp4; type 2; shows Write take.mp42.mp4") // back in the name, where typing goes on

EXPORT_TEST(test_choices_are_asked_for)
{
    static const struct {
        const char *word, *number;
        float right;
        int keys; ///< then
    } fields[] = {{"frames", "12", 120, 0}, {"keys a frame", "1", 130, 1}, {"keys a frame", "4", 130, 4}};
    for (int i = 0; i < 3; i++) {
        fill(s, fields[i].word, fields[i].right, fields[i].number);
        hands(s, "key Enter; is export.keys %d", fields[i].keys);
    }
    hands(s, "tap as the scene; type Swing; is export.path walk.glb;" // the name is another line of text
             "tap all rigs; shows 145 keys, 96 a second. ↑ ↓ choose the format, Tab goes to the choices.;"
             "hides signed morph targets;" // tails have none
             "tap Write walk.glb");
    const struct export_wish wish = exported(s).wish;
    assert_true(wish.part && wish.first == 12 && wish.last == 48 && wish.keys == 4);
    assert_string_equal(wish.clip, "Swing");
    assert_int_equal(wish.rig, s->document->rigs[0]->id);
}

/// A file that holds one rig is offered no other choice than one. Pictures have a size. Esc belongs to a number while it is typed.
EXPORT_TEST(test_choices_of_formats)
{
    hands(s, "tap More formats; tap .pc2; hides all rigs; tap fox; tap cat; shows fox; tap .gif; shows 640");
    fill(s, "size", 120, "320");
    hands(s, "key Enter; tap Write walk.gif");
    const struct export_wish wish = exported(s).wish;
    assert_true(wish.width == 320 && wish.height == 360);
    hands(s, "answer export; key Ctrl+E");
    fill(s, "frames", 120, "5");
    hands(s, "key Escape; is asked export");
    assert_true(s->editor->dialogs->exporting.memory.wish.first == 0);
}

/// However long their names are, and alike at the beginning.
TEST(test_rigs_of_long_names_can_be_chosen)
{
    char text[1024], stem[201] = "";
    struct session s;
    for (int i = 0; i < 50; i++) strcat(stem, "尻");
    snprintf(text, sizeof text,
             "{'frames': [0, 48], 'splines': [{'name': 'sway'}], 'rigs': [{'type': 'tail', 'name': '%s1', 'spline': "
             "'sway'}, {'type': 'tail', 'name': '%s2', 'spline': 'sway'}]}",
             stem, stem);
    open_export(&s, text, "two.json", 1280, 720);
    hands(&s, "tap all rigs");
    session_click_here(&s, 1);
    hands(&s, "tap Write two.glb");
    assert_int_equal(exported(&s).wish.rig, s.document->rigs[1]->id);
    session_close(&s);
}

/// Chains go with their character, also where joints alone are written.
SESSION_TEST(
    test_joints_are_those_of_the_character,
    open_export(s,
                "{'frames': [0, 48], 'splines': [{'name': 'sway'}], 'rigs': [{'type': 'model', 'name': "
                "'dog', 'model': 'dog.glb'}, {'type': 'chain', 'name': 'brush', 'model': 'dog', 'from': 'a', "
                "'to': 'b', 'channels': [{'spline': 'sway'}]}, {'type': 'chain', 'name': 'ear', 'model': "
                "'dog', 'from': 'c', 'to': 'd', 'channels': [{'spline': 'sway'}]}]}",
                "dog.json", 1280, 720))
{
    hands(
        s,
        "tap More formats; tap .pc2; hides brush; hides all clips; tap .bvh; hides brush; hides all clips; tap .glb");
    const struct draw_command *label = shown_text(s->editor, "all clips");
    assert_non_null(label);
    session_move(s, label->x - 20, label->y - 4);
    session_click_here(s, 1);
    assert_true(s->editor->dialogs->exporting.memory.wish.all_clips);
}

/// A loop's last frame is its first, which a .gif does not show twice; nor does it show more than 50 pictures a second.
SESSION_TEST(test_pictures_of_a_loop,
             open_export(s,
                         "{'fps': 60, 'frames': [0, 120], 'splines': [{'name': 'sway', 'start': 'loop', 'knots': "
                         "[{'frame': 0, 'value': 1}]}]}",
                         "walk.json", 1280, 720))
{
    hands(s, "tap More formats; tap .png; shows 121 pictures, 60 a second. ↑ ↓ choose the format, Tab goes to the "
             "choices.;"
             "tap .gif; shows 100 pictures, 50 a second. ↑ ↓ choose the format, Tab goes to the choices.");
}

/// Nothing else is done meanwhile.
EXPORT_TEST(test_cancelling)
{
    hands(s, "key Enter; asks export walk.glb");
    s->editor->core.app.figures = &(struct figures){.ui_scale = 1, .done = 30, .total = 97};
    hands(s, "wait; shows 30 of 97. Esc cancels and leaves nothing behind.;"
             "key Delete; type x; kept; is export.path walk.glb;"
             "key Escape; asks stop; tap Cancel; asks stop;"
             "answer export Cancelled. Nothing was written.; wait; shows Cancelled. Nothing was written.;"
             "key Escape; is asked none; asks nothing");
}

/// The next scene gets its own name, in the format of last time, whichever that was.
EXPORT_TEST(test_remembered)
{
    hands(s, "type films/first.webm; tap transparent; key Escape Ctrl+E; shows films/first.webm; key Escape; opened;"
             "path work/run.json; key Ctrl+E; shows work/run.webm");
    for (int format = 0; format < exporting_format_count(); format++) {
        struct export_memory memory = {.path = "films/first"};
        strncat(memory.path, export_formats[format].ending, 16);
        hands(s, "key Escape");
        dialogs_set_export(s->editor->dialogs, &memory);
        hands(s, "key Ctrl+E");
        assert_string_equal(strrchr(s->editor->dialogs->exporting.memory.path, '.'), export_formats[format].ending);
    }
}

SESSION_TEST(test_an_export_in_a_small_window, open_export(s, scene, "walk.json", 640, 400))
{
    const struct draw_command *button = shown_text(s->editor, "Write walk.glb");
    assert_true(button && button->y < 400);
    panel_type(s, "walk.png"); // the last of the list comes into sight
    const struct draw_command *row = shown_text(s->editor, ".png");
    assert_true(row && row->y > row->clip.y && row->y < row->clip.y + row->clip.h);
}
