/// What a hand reaches for daily: pause, undo, the palette.
#include "hands.h"

#include <limits.h>
#include <unistd.h>

static const char scene[] =
    "{\"frames\": [0, 100], \"substeps\": 2, \"splines\": [{\"name\": \"sway\", \"frequency\": 1, "
    "\"damping\": 0.1, \"knots\": [{\"frame\": 0, \"value\": 0}, {\"frame\": 40, \"value\": 1}]}]}";

static const char flat[] =
    "{\"frames\": [0, 100], \"splines\": [{\"name\": \"sway\", \"bandwidth\": 1, \"frequency\": 1, \"damping\": 0.1, "
    "\"knots\": [{\"frame\": 0, \"value\": 0}, {\"frame\": 90, \"value\": 0}]}]}";

static const char open_scene[] = "{\"frames\": [0, 100], \"splines\": [{\"name\": \"sway\", \"frequency\": 1, "
                                 "\"damping\": 0.1, \"knots\": [{\"frame\": 0, "
                                 "\"value\": 0}, {\"frame\": 90, \"value\": 1}, {\"frame\": 100, \"value\": 2}]}]}";

static const char pinned[] = "{'frames': [0, 100], 'splines': [{'name': 'sway', 'frequency': 1, 'damping': 0.1, "
                             "'knots': [<0 0>, <40 1>]}], 'rigs': "
                             "[{'type': 'tail', 'name': 'tail', 'channels': [{'spline': 'sway', 'axis': 'side', "
                             "'gain': 9, 'lag': 6}], 'pins': "
                             "[{'joint': 9, 'frame': 60, 'to': [0.3, 0.5, 0.1]}]}]}";

/// What the status line shows is where the playhead is, so that the next edit moves nothing.
SESSION_TEST(test_pause_stops_on_a_frame, panel_open(s, scene, 1280, 720))
{
    seek(s->editor, 20);
    session_key(s, KEY_SPACE, 0);
    for (double dt = 0.01; dt < 0.05; dt += 0.01) {
        editor_advance(s->editor, dt);
        const double frame = shown_frame(s->editor);
        session_key(s, KEY_SPACE, 0);
        assert_near(shown_frame(s->editor), round(frame), 0);
        session_key(s, KEY_SPACE, 0);
    }
}

/// Undo gives back what was selected and in sight as the step began, redo as it ended.
SESSION_TEST(test_undo_returns_to_the_place, panel_open(s, scene, 1280, 720))
{
    session_click(s, "knot(sway,1)");
    const unsigned id = s->document->splines[0]->knots[1].id;
    const struct plotted plot = *plot_of(s->editor);
    const struct camera camera = *camera_of(s->editor);
    session_key(s, KEY_DELETE, 0);
    assert_int_equal(selected(s->editor), 0);
    session_key(s, KEY_UP, MOD_CTRL | MOD_SHIFT); // orbits
    *plot_of(s->editor) = (struct plotted){50, 60, 7, 8};
    session_key(s, 'Z', MOD_CTRL);
    assert_int_equal(selected(s->editor), 1);
    assert_true(selection_has(selection_of(s->editor), id));
    assert_memory_equal(plot_of(s->editor), &plot, sizeof plot);
    assert_memory_equal(camera_of(s->editor), &camera, sizeof camera);
    session_key(s, 'Z', MOD_CTRL | MOD_SHIFT);
    assert_int_equal(selected(s->editor), 0);
}

/// A drag beyond the edge widens the view about the pointer: what lies under it stays there.
SESSION_TEST(test_zoom_stays_under_the_pointer, panel_open(s, scene, 1280, 720))
{
    const struct plotted before = *plot_of(s->editor) = (struct plotted){-2, 102, -0.4, 1.2};
    session_frame(s);
    session_pull(s, "knot(sway,0)", 0, -40, 6);
    session_release(s, BUTTON_LEFT);
    for (int i = 0; i < 60; i++) session_frame(s);
    float xy[2];
    session_where(s, "knot(sway,0)", xy);
    assert_near(xy[0], s->x, 1);
    assert_near(xy[1], s->y, 1);
    assert_true(plot_of(s->editor)->value0 < before.value0);
}

/// Whatever is edited, some of the active curve stays in sight.
SESSION_TEST(test_edits_keep_the_curve_in_sight, panel_open(s, scene, 1280, 720))
{
    *plot_of(s->editor) = (struct plotted){0, 100, 50, 51};
    session_key(s, 'A', MOD_CTRL);
    session_key(s, KEY_DELETE, 0);
    for (int i = 0; i < 60; i++) session_frame(s);
    assert_true(plot_of(s->editor)->value0 < 0);
}

/// The palette finds a command by other words for it, too; three scattered letters find nothing.
SESSION_TEST(test_palette_knows_other_words, panel_open(s, scene, 1280, 720))
{
    static const char *const found[][2] = {
        {"duration", "Scale the selection"},
        {"retime", "Scale the selection"},
        {"reverse", "Scale the selection"},
        {"weight", "Feel heavy"},
        {"bake", "Export: Blender, film, table"},
        {"fps", "First and last frame, frame rate"},
        {"length", "First and last frame, frame rate"},
        {"mute", "Solo: show only this spline, or all again"},
        {"lock", "Pin the point where it is"},
        {"flip", "Mirror the chain to the other side"},
        {"loop", "Unfold Spline: kind, equilibrium, start"},
        {"offset", "Unfold Tail or chain set-up: channels"},
        {"clean", "Remove all paint"},
    };
    for (size_t i = 0; i < sizeof found / sizeof *found; i++) {
        session_key(s, KEY_F3, 0);
        panel_type(s, found[i][0]);
        if (!shown_text(s->editor, found[i][1])) fail_msg("“%s” does not find “%s”", found[i][0], found[i][1]);
        session_key(s, KEY_ESCAPE, 0);
    }
    session_key(s, KEY_F3, 0);
    panel_type(s, "fgr");
    assert_true(shown_text(s->editor, "No command matches. Esc closes."));
}

/// A taken name is refused, and what was typed stays to be mended.
SESSION_TEST(test_refused_name_stays,
             panel_open(s, "{\"frames\": [0, 99], \"splines\": [" PANEL_SPLINES "]}", 1280, 720))
{
    session_key(s, KEY_F2, 0);
    panel_type(s, "pace");
    session_key(s, KEY_ENTER, 0);
    assert_said_error(s->editor, "a spline called pace already exists");
    assert_true(inspector_of(s->editor)->typing);
    panel_type(s, "2");
    session_key(s, KEY_ENTER, 0);
    assert_string_equal(s->document->splines[0]->name, "pace2");
}

/// A spline that rests everywhere cannot drift, however wide its band.
SESSION_TEST(test_flat_curve_has_no_warning, panel_open(s, flat, 1280, 720))
{
    assert_int_equal(warnings_of(s->editor)->count, 0);
}

/// An open list hides what lies under it: nothing there has a tooltip or lights up.
SESSION_TEST(test_list_covers_what_lies_under_it, panel_open(s, scene, 1280, 720))
{
    session_hover(s, "knot(sway,1)");
    assert_non_null(hovered(s->editor));
    session_key(s, 'A', 0);
    session_hover(s, "knot(sway,1)");
    assert_null(hovered(s->editor));
}

static int list_nothing(void *user, const char *folder, char names[][256], int most)
{
    (void)user, (void)folder, (void)names, (void)most;
    return 0;
}

/// The dialog says where a new name will lie.
SESSION_TEST(test_save_dialog_names_the_folder, panel_open(s, scene, 1280, 720))
{
    list_files(s->editor, &(struct editor_app){.list = list_nothing});
    char folder[PATH_MAX], text[PATH_MAX + 32];
    session_key(s, 'S', MOD_CTRL | MOD_SHIFT);
    panel_type(s, "a-new-name");
    snprintf(text, sizeof text, "A new file in %s.", getcwd(folder, sizeof folder));
    assert_non_null(shown_text(s->editor, text));
    panel_type(s, "/x");
    assert_non_null(shown_text(s->editor, "There is no such folder."));
}

/// Looping playback of curves that do not close says so at the ruler's end, and a click there closes them.
SESSION_TEST(test_open_curves_are_closed, panel_open(s, open_scene, 1280, 720))
{
    struct error error;
    float x, y;
    assert_false(editor_target(s->editor, "seam()", &x, &y, &error));
    session_key(s, KEY_SPACE, 0);
    session_key(s, 'L', MOD_CTRL); // playback no longer loops
    assert_false(editor_target(s->editor, "seam()", &x, &y, &error));
    session_key(s, 'L', MOD_CTRL);
    session_frame(s);
    const char *before = session_saved(s);
    session_click(s, "seam()");
    assert_said(s->editor, "Closed 1 curve");
    assert_int_equal(spline_start(s->document->splines[0]), WIGGLY_LOOP);
    assert_int_equal(s->document->splines[0]->knot_count, 2); // that on the last frame repeats the first
    assert_one_step(s, before);
    session_frame(s);
    assert_false(editor_target(s->editor, "seam()", &x, &y, &error));
}

/// In a page, the browser keeps its own keys and those without a command; Tab leaves after the last field.
SESSION_TEST(test_browser_keeps_its_keys, panel_open(s, scene, 1280, 720))
{
    static const struct {
        int key;
        unsigned mods;
        bool kept;
    } keys[] = {
        {KEY_F5, 0, false},          {KEY_F6, MOD_SHIFT, false}, {KEY_F1, 0, true},
        {'R', MOD_CTRL, false},      {'L', MOD_CTRL, false},     {'W', MOD_CTRL, false},
        {'T', MOD_CTRL, false},      {'F', MOD_CTRL, false},     {'P', MOD_CTRL, false},
        {KEY_LEFT, MOD_ALT, false},  {'Z', MOD_CTRL, true},      {'L', MOD_CTRL | MOD_SHIFT, true},
        {KEY_LEFT, MOD_CTRL, true},  {KEY_DELETE, 0, true},      {KEY_TAB, 0, true},
        {KEY_HOME, MOD_SHIFT, true}, {KEY_TAB, MOD_CTRL, false},
    };
    for (size_t i = 0; i < sizeof keys / sizeof *keys; i++) {
        if (editor_keeps(s->editor, keys[i].key, keys[i].mods) != keys[i].kept)
            fail_msg("key %d with %u: expected %d", keys[i].key, keys[i].mods, keys[i].kept);
    }
    int fields = 0;
    while (fields < 500 && editor_keeps(s->editor, KEY_TAB, 0)) session_key(s, KEY_TAB, 0), fields++;
    assert_in_range(fields, 5, 200);
    assert_true(editor_keeps(s->editor, KEY_TAB, MOD_SHIFT));
    for (; fields > 1; fields--) session_key(s, KEY_TAB, MOD_SHIFT);
    assert_false(editor_keeps(s->editor, KEY_TAB, MOD_SHIFT));
    session_key(s, KEY_F3, 0); // what is typed there keeps Tab and the clipboard's keys
    assert_true(editor_keeps(s->editor, KEY_TAB, 0) && editor_keeps(s->editor, 'F', MOD_CTRL));
}

/// Nobody knows a browser's home folder.
SESSION_TEST(test_page_names_no_home, panel_open(s, scene, 1280, 720))
{
    setenv("HOME", "/home/web_user", true);
    tell(s->editor, false, "%s", "Wrote /home/web_user/walk.gif.");
    assert_said(s->editor, "Wrote /home/web_user/walk.gif.");
    s->editor->core.app.in_page = true;
    tell(s->editor, false, "%s", "Wrote /home/web_user/walk.gif, /home/web_user/a.png.");
    assert_string_equal(said(s->editor), "Wrote walk.gif, a.png.");
}

/// A number field calculates; + * and / go on from the value that it has.
SESSION_TEST(test_fields_calculate, panel_open(s, scene, 1280, 720))
{
    static const struct {
        const char *typed;
        double frequency; ///< which was 1.5; 0: refused
    } rows[] = {{"2", 2},       {"+1", 2.5},  {"*2", 3},     {"/3", 0.5},   {"12/24", 0.5},   {"+-0.5", 1},
                {"1+2*1,5", 4}, {"3 - 1", 2}, {"* 2 Hz", 3}, {"1e0", 1},    {"+1,25/0,5", 4}, {"0x2", 0},
                {"1/0", 0},     {"+", 0},     {"2*", 0},     {"2 Hz*2", 0}, {"1+-+2", 0},     {"inf", 0}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        hands(s, "enter frequency 1.5; enter frequency %s", rows[i].typed);
        const double expected = rows[i].frequency > 0 ? rows[i].frequency : 1.5;
        const double got = s->document->splines[0]->parameter[PARAMETER_FREQUENCY].value;
        if (fabs(got - expected) > 1e-12) fail_msg("1.5, then “%s”: %g, expected %g", rows[i].typed, got, expected);
        session_key(s, KEY_ESCAPE, 0);
    }
}

static void right_click(struct session *s, const char *target)
{
    session_point(s, target);
    session_press(s, BUTTON_RIGHT, 1);
    session_release(s, BUTTON_RIGHT);
}

/// The menu acts on what was clicked, whatever was selected before: on the knot, not the pin; on the pin, not the knot.
SESSION_TEST(test_menu_acts_on_what_is_under_it, panel_open(s, pinned, 1280, 720))
{
    session_click(s, "pintime(tail,0)");
    right_click(s, "knot(sway,1)");
    hands(s, "key Enter; is rigs.0.pins.# 1; is splines.0.knots.# 1; key Ctrl+Z; click knot(sway,1)");
    right_click(s, "pintime(tail,0)");
    hands(s, "key Enter; is rigs.0.pins.# nothing; is splines.0.knots.# 2");
}

/// A right-click lists what can be done there; Enter runs the first, and typing goes on in the palette.
SESSION_TEST(test_right_click_is_a_menu, panel_open(s, scene, 1280, 720))
{
    right_click(s, "knot(sway,1)");
    assert_int_equal(lookup_of(s->editor)->kind, LOOKUP_MENU);
    assert_int_equal(selected(s->editor), 1);
    hands(s,
          "shows Delete the selection; shows Scale the selection; shows Simplify: fewer knots; hides Go to the start;"
          "hides Undo; key Enter");
    assert_int_equal(s->document->splines[0]->knot_count, 1);
    right_click(s, "ruler(50)");
    hands(s, "shows Play from here; type undo; key Enter");
    assert_int_equal(s->document->splines[0]->knot_count, 2);
    session_point(s, "stage(0.5,0.5)");
    session_press(s, BUTTON_RIGHT, 1);
    session_drag(s, 30, 0, 3); // orbits
    session_release(s, BUTTON_RIGHT);
    assert_int_equal(lookup_of(s->editor)->kind, LOOKUP_NONE);
    session_press(s, BUTTON_RIGHT, 1);
    session_release(s, BUTTON_RIGHT);
    hands(s, "shows Onion skin; key Escape; is lookup none");
}

/// Paste in place keeps the frames, paste mirrored turns the values over, once; a selection is mirrored over all its splines.
SESSION_TEST(test_paste_in_place_and_mirrored, panel_open(s, scene, 1280, 720))
{
    static const struct {
        const char *command;
        double frame, value; ///< of the pasted knot
    } rows[] = {{"Paste at the pl", 90, 1},
                {"Paste in place", 40, 1},
                {"Paste mirrored", 90, -1},
                {"Paste at the pl", 90, 1}};
    session_click(s, "knot(sway,1)");
    session_key(s, 'C', MOD_CTRL);
    char *copied = strdup(session_asked(s).text);
    session_key(s, KEY_DELETE, 0);
    seek(s->editor, 90);
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        session_key(s, KEY_F3, 0);
        panel_type(s, rows[i].command);
        session_key(s, KEY_ENTER, 0);
        session_send(s, (struct event){.kind = EVENT_PASTE, .text = copied});
        const struct knot *knot = &s->document->splines[0]->knots[1];
        if (knot->frame != rows[i].frame || knot->value != rows[i].value)
            fail_msg("%s: %g at frame %g", rows[i].command, knot->value, knot->frame);
        session_key(s, 'Z', MOD_CTRL);
    }
    free(copied);
    session_key(s, 'Z', MOD_CTRL);
    session_key(s, 'A', MOD_CTRL);
    const char *before = session_saved(s);
    session_key(s, KEY_F3, 0);
    panel_type(s, "mirror the sel");
    session_key(s, KEY_ENTER, 0);
    assert_near(s->document->splines[0]->knots[1].value, -1, 0);
    assert_one_step(s, before);
}

SESSION_TEST(test_views, panel_open(s, scene, 1280, 720))
{
    static const struct {
        int key;
        float eye[3]; ///< the side of the target that it lies on
    } rows[] = {{'1', {0, 0, 1}}, {'3', {1, 0, 0}}, {'7', {0, 1, 0}}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        float view[16], projection[16], eye[3];
        session_key(s, rows[i].key, 0);
        const struct camera *camera = camera_of(s->editor);
        camera_matrices(camera, 1, view, projection, eye);
        for (int k = 0; k < 3; k++)
            assert_near((eye[k] - camera->target[k]) / camera->distance, rows[i].eye[k], 0.08);
    }
}

/// A still knot's row is the value that it comes to rest at.
WALK(test_still_knot_shows_its_equilibrium, panel_open(s, scene, 1280, 720),
     "more off; lacks equilibrium; click knot(sway,1); lacks equilibrium; key Shift+P; enter equilibrium 0.25; "
     "sway.equilibrium 0.25; label Set equilibrium; finds follow.equilibrium")

/// On a phone, rows are as high as a finger needs.
SESSION_TEST(test_rows_of_a_phone, panel_open(s, scene, 390, 844))
{
    for (int wide = 0; wide < 2; wide++) {
        editor_resize(s->editor, wide ? 1280 : 390, 844, 1);
        session_frame(s);
        session_point(s, "widget(frequency)");
        const float above = s->y;
        session_point(s, "widget(damping)");
        assert_near(s->y - above, wide ? 24 : 32, 0);
    }
}

static const char later[] =
    "{'frames': [0, 100], 'splines': [{'name': 'sway', 'frequency': 1, 'damping': 0.1, 'start': 'loop', 'knots': "
    "[<10 "
    "0>, <60 1>]}], 'rigs': [{'type': 'tail', 'name': 'tail', 'channels': [{'spline': 'sway', 'gain': 9}], 'offset': "
    "3}]}";

/// A tail that its splines move later is held, where it is dragged, by a knot that much earlier; around the seam of a loop, too.
WALK(test_a_drag_of_a_tail_with_an_offset, session_open(s, later),
     "seek 35; carry tail(tail,0.9) 20 0; sway.knots 3; sway.1.frame 32; is playhead 35; once; key Ctrl+Z;"
     "seek 1; carry tail(tail,0.9) 20 0; sway.knots 3; sway.2.frame 98; is playhead 1; once")

// The list of splines: `ears` is a folder, `left` and `right` bend a tail, `far` is alone.
#define EAR(name, value, end)                                                                                        \
    "{'name': '" name "', 'frequency': 1, 'damping': 0.1, 'knots': [<0 0>, <40 " value ">]}" end
static const char listed[] = "{'frames': [0, 100], 'splines': [" EAR("sway", "1", ",")
    EAR("left', 'folder': 'ears", "2", ",") EAR("right', 'folder': 'ears", "3", ",")
        EAR("far", "4",
            "],") "'rigs': [{'type': 'tail', 'name': 'tail', "
                  "'channels': [{'spline': 'left', 'lag': 6}, {'spline': 'right', 'axis': 'up', 'lag': 3}]}]}";

/// Each begins with that scene and `sway` as the active spline.
TEST(test_list_of_splines)
{
    static const char *const rows[] = {
        // Ctrl adds and takes away, Shift extends; a click on one of several selects it alone, also after it
        "with Ctrl; click spline.far; chosen 2; active 0; click spline.far; chosen 1; click spline.sway; chosen 1",
        "with Shift; click spline.right; chosen 3; active 0; with; click spline.left; chosen 1; active 1",
        "with Shift; click spline.right; with; press spline.left; chosen 3; active 1; release; chosen 1",
        "with Shift; click spline.right; key PageDown; chosen 1",
        "click folder.ears; chosen 2; active 1; with Ctrl; click spline.far; chosen 3; click folder.ears;"
        "chosen 2; key Escape; chosen 1; active 1",
        // what is done to them is one step, which brings them back when it is undone
        "with Shift; click spline.right; with; keep; mentions 3 splines; enter frequency 2; sway.frequency 2;"
        "right.frequency 2; far.frequency 1; once; click spline.far; key Ctrl+Z; chosen 3; kept",
        "with Ctrl; click spline.far; with; click preset.jelly; sway.damping 0.06; far.damping 0.06;"
        "left.damping 0.1; once",
        "click spline.left; with Ctrl; click spline.right; with; enter lag 12; is rigs.0.channels.0.lag 12;"
        "is rigs.0.channels.1.lag 6; once; ignores tail (; click tail(tail,0.8); mentions tail (2 splines)",
        "with Ctrl; click spline.far; with; hold F; key Up; let F; sway.frequency 1.05; far.frequency 1.05; once",
        "with Shift; click spline.left; with; click color.left; click color.3; is splines.0.color #1F9E7A;"
        "is splines.1.color #1F9E7A; is splines.2.color nothing; once",
        "click folder.ears; key F3; type duplicate the spl; key Enter; is splines.# 6; chosen 2;"
        "is active.name left 2; is splines.4.name right 2; is splines.4.folder ears; once",
        "with Ctrl; click spline.far; with; key F3; type delete the spl; key Enter; is splines.# 2; is asked none;"
        "once",
        "click folder.ears; key F3; type delete the spl; key Enter; mentions left and others are used in 2 places;"
        "key D; is splines.# 2; is rigs.0.channels.# 0; once",
        "curves.others 3; with Ctrl; click spline.left; with; click eye.left; curves.others 2; is curve:0 0; kept;"
        "click eye.far; curves.others 1",
        // a locked spline cannot be hit, boxed, nudged, or given a knot; its knots are no longer selected
        "click knot(sway,1); selected 1; click lock.sway; is splines.0.locked true; selected 0; once; keep;"
        "click knot(sway,1); selected 0; key Ctrl+A; selected 0; key I;"
        "says sway is locked: open its lock in the list first.; again curve(sway,20,0.9); kept; click lock.sway;"
        "is splines.0.locked nothing",
        "click spline.far; click lock.ears; is splines.1.locked true; is splines.2.locked true;"
        "is splines.0.locked nothing; once; click lock.ears; kept",
        "click lock.far; pull knot(far,1) 0 -30; release; far.1.value 4; active 0",
        // folders: dragged into and out of, made, renamed, given up
        "press spline.far; drag 0 -60; release; is splines.1.name far; is splines.1.folder ears; once", // below its head
        "press spline.far; drag 0 -72; release; is splines.1.name far; is splines.1.folder ears; once",    // onto it
        "press spline.far; drag 0 -86; release; is splines.1.name far; is splines.1.folder nothing; once", // above it
        "click fold.ears; press spline.far; drag 0 -24; release; is splines.3.folder ears; once",
        "press spline.left; drag 0 38; release; is splines.2.name left; is splines.2.folder ears; once", // within
        "press spline.left; drag 0 66; release; is splines.3.name left; is splines.3.folder nothing; once",
        "press folder.ears; drag 0 -44; release; is splines.0.name left; is splines.1.folder ears;"
        "is splines.2.name sway; once",
        "with Ctrl; click spline.far; with; key F3; type into a folder; key Enter; is splines.0.name sway;"
        "is splines.1.name far; is splines.1.folder sway; once; finds folder.sway",
        "click spline.left; key F3; type into a folder; key Enter; is splines.2.name left;"
        "is splines.2.folder nothing; is splines.1.folder ears; once",
        "again folder.ears; type whiskers; key Enter; is splines.1.folder whiskers; is splines.2.folder whiskers;"
        "once",
        "again folder.ears; key Delete Enter; is splines.1.folder nothing; lacks folder.ears; once",
        "click spline.far; key F3; type spline up; key Enter; is splines.2.name far; is splines.2.folder ears;"
        "key F3; type spline up; key Enter; is splines.1.folder ears; key F3; type spline up; key Enter;"
        "is splines.0.name far; is splines.0.folder nothing",
        "click fold.ears; lacks spline.left; finds spline.far; kept; key PageDown; lacks spline.left; key F2;"
        "is typing 1; type ear; key Enter; finds spline.ear",
        // by keyboard
        "tab spline.left; key Enter; active 1; key Tab Tab Tab; key Enter; is splines.1.locked true"};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        struct session s;
        panel_open(&s, listed, 1280, 720);
        hands(&s, "click spline.sway; keep; %s", rows[i]);
        session_close(&s);
    }
}

/// A right-click on a row selects it, unless it is selected, and lists what can be done with all that are.
SESSION_TEST(test_menu_of_a_row, panel_open(s, listed, 1280, 720))
{
    hands(s, "click folder.ears");
    right_click(s, "widget(spline.right)");
    hands(s, "is lookup menu; chosen 2; shows Rename the spline; shows Put into a folder, or take out; key Escape");
    right_click(s, "widget(spline.far)");
    hands(s, "chosen 1; is active.name far; key Enter; is typing 1; key Escape; kept");
}

/// On a phone the list has colours alone, until a name is typed.
WALK(test_narrow_list, panel_open(s, listed, 390, 844),
     "click spline.sway; with Shift; click spline.right; chosen 3; with; lacks eye.right; key F2; wait; finds "
     "eye.right; type x; key "
     "Enter;"
     "is splines.0.name x; wait; lacks eye.right; click fold.ears; lacks spline.left; click splines.add; active 4")

/// Forty splines: a new one's row is scrolled into sight, and a finger scrolls rows that it has not chosen.
SESSION_TEST(test_a_long_list, panel_open(s, listed, 1280, 720))
{
    for (int i = 0; i < 36; i++) assert_done(edit_spline_add(s->document, -1, NULL, NULL, &error));
    const struct ui_list *list = &s->editor->inspector->lines;
    hands(s,
          "lacks spline.spline_30; lacks splines.add; key F3; type add a spline; key Enter; finds spline.spline_37");
    hands(s, "click spline.spline_36; keep");
    s->finger = true;
    const float before = list->offset;
    hands(s, "carry spline.spline_30 0 60; kept; is active.name spline 30");
    assert_near(list->offset, before - 60, 1);
    hands(s, "carry spline.spline_30 0 30; once");
}

/// The scene's range and rate are above the list; typed numbers may be changes. In a narrow window they are in the panel.
WALK(
    test_range_and_rate_are_at_the_ruler, panel_open(s, scene, 1280, 720),
    "more off; enter scene.last +24; is frames.1 124; once; enter scene.first -10; is frames.0 -10; is asked none;"
    "key F3; type duration; key Enter; type 100; key Enter; is frames.1 100; enter scene.fps 30; is asked ask; key S;"
    "is fps 30")

WALK(test_range_and_rate_on_a_phone, panel_open(s, scene, 390, 844),
     "more off; lacks scene.last; key F3; type duration; key Enter; enter scene.last 90; is frames.1 90")

/// A name that is taken stays in its field, of its own row, when another row is clicked.
WALK(test_a_taken_name_stays_with_its_row,
     panel_open(s, "{'frames': [0, 24], 'splines': [{'name': 'one', 'knots': []}, {'name': 'two', 'knots': []}]}",
                1280, 720),
     "click spline.one; key F2; type two; click spline.two; wait; said two; key Escape; is splines.0.name one")

/// Whatever sets a knot by hand leaves a locked spline alone, and says so.
WALK(test_a_lock_holds_everywhere,
     session_open(s,
                  "{'frames': [0, 96], 'splines': [{'name': 'sway', 'frequency': 1, 'locked': true, 'knots': [<0 0>, "
                  "<24 1>, <48 0>, <72 1>]}], 'rigs': [{'type': 'tail', 'name': 'tail', 'channels': [{'spline': "
                  "'sway', 'gain': 9}]}]}"),
     "keep; seek 12; key I; says sway is locked: open its lock in the list first.; kept; key F3; type reduce; key "
     "Enter;"
     "wait 1; said is locked; lacks tolerance; kept; carry tail(tail,0.8) 20 10; said is locked; kept; click "
     "lock.sway;"
     "carry tail(tail,0.8) 20 10; sway.knots 5")
