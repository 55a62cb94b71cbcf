/// Status line and dialogs; and of all panels: no text leaves its panel, none lies over another.
#include "panel_session.h"

static const char small_scene[] =
    "{\"wiggly\": 1, \"frames\": [0, 96], \"splines\": [{\"name\": \"sway\", \"frequency\": 1, \"knots\": "
    "[{\"frame\": 0, \"value\": 0, \"slope\": 1}, {\"frame\": 36, \"value\": 1}]}],"
    "\"rigs\": [{\"type\": \"tail\", \"name\": \"tail\", \"spline\": \"sway\"}]}";

/// Long names, large numbers, tracks, many splines: whatever makes a panel crowded.
static const char crowded_scene[] =
    "{\"wiggly\": 1, \"frames\": [-100000, -75001], \"substeps\": 4, \"splines\": ["
    "{\"name\": \"a spline whose name is far longer than any panel is wide, by a good deal\", \"mode\": \"real\", "
    "\"frequency\": 123456.789, \"damping\": 12345678, \"equilibrium\": -1e300, \"knots\": [{\"frame\": -99999.75, "
    "\"value\": -123456789.125, \"slope\": 1e200, \"stiffness\": 1e250}]},"
    "{\"name\": \"b\", \"frequency\": {\"spline\": \"a spline whose name is far longer than any panel is wide, by a "
    "good deal\"}, \"equilibrium\": {\"spline\": \"c\"}, \"knots\": [{\"frame\": -80000, \"value\": 0}]},"
    "{\"name\": \"c\"}, {\"name\": \"d\"}, {\"name\": \"e\"}, {\"name\": \"f\"}, {\"name\": \"g\"}, {\"name\": "
    "\"h\"}, {\"name\": \"i\"}, {\"name\": \"j\"}], \"rigs\": [{\"type\": \"tail\", \"name\": \"t\", \"joints\": 2, "
    "\"rest\": "
    "[-12345.5, 30000], \"channels\": [{\"spline\": \"b\", \"lag\": [1, 2], \"gain\": 5}, {\"spline\": \"a spline "
    "whose name "
    "is far longer than any panel is wide, by a good deal\"}]}, {\"type\": \"tail\", \"name\": \"u\", \"spline\": "
    "\"c\"}]}";

// --- geometry ---------------------------------------------------------------------------------------------------------

/// What a text covers, a little less high than its line so that neighbours in a paragraph may touch.
static struct rect text_rect(const struct drawlist *list, const struct draw_command *command)
{
    float width = font_width(command->font, command->width, list->text + command->first);
    return (struct rect){command->x, command->y - 0.8f * command->width, width, command->width};
}

static void assert_text_in_panel(const struct drawlist *list, const struct draw_command *command, struct rect panel)
{
    struct rect r = text_rect(list, command);
    bool inside = r.x >= panel.x && r.x + r.w <= panel.x + panel.w + 0.01f;
    // A line that is cut by its clip is one scrolled half out of sight.
    bool scrolled = r.y < command->clip.y || r.y + r.h > command->clip.y + command->clip.h;
    inside &= scrolled || (r.y >= panel.y && r.y + r.h <= panel.y + panel.h);
    if (!inside) fail_msg("“%s” at %g, %g leaves its panel", list->text + command->first, (double)r.x, (double)r.y);
}

/// Texts from command `first` on lie in `panel` and apart from each other. Returns how many there are.
static int assert_texts_apart(const struct drawlist *list, int first, struct rect panel)
{
    int count = 0;
    assert_false(list->overflow);
    for (int i = first; i < list->count; i++) {
        const struct draw_command *a = &list->commands[i];
        if (a->kind != DRAW_TEXT) continue;
        count++;
        assert_text_in_panel(list, a, panel);
        for (int j = first; j < i; j++) {
            const struct draw_command *b = &list->commands[j];
            if (b->kind != DRAW_TEXT) continue;
            struct rect both = rect_intersect(text_rect(list, a), text_rect(list, b));
            both = rect_intersect(both, rect_intersect(a->clip, b->clip));
            if (both.w > 0 && both.h > 0) {
                fail_msg("“%s” lies over “%s”", list->text + a->first, list->text + b->first);
            }
        }
    }
    return count;
}

static void show(struct session *f) { drawlist_clear(drawn_by(f->editor), layout_of(f->editor)->window); }

static void check_inspector(struct session *f)
{
    const struct spline *spline = active_spline(f->editor);
    for (int selected = 0; selected < 2; selected++) {
        if (selected && spline->knot_count > 0) {
            selection_set(selection_of(f->editor), spline->knots[0].id, true);
        }
        for (int page = 0; page < 3; page++) {
            sections(f->editor)->offset = 150.0f * (float)page;
            show(f);
            inspector_show(f->editor->inspector, false);
            assert_true(assert_texts_apart(drawn_by(f->editor), 0, layout_of(f->editor)->inspector) > 15);
        }
    }
}

static void check_status(struct session *f)
{
    static const char long_message[] =
        "a sentence that goes on and on about what is wrong with this file until there is no room left for it "
        "in the line, whatever the width of the window may be, and then some more";
    static const char *const messages[] = {"", "Saved.", long_message};
    tell_figures(f->editor, 1234, 123456);
    editor_advance(f->editor, 1);
    for (size_t m = 0; m < sizeof messages / sizeof messages[0]; m++) {
        tell(f->editor, true, "%s", messages[m]);
        show(f);
        status_show(f->editor);
        const int texts = assert_texts_apart(drawn_by(f->editor), 0, layout_of(f->editor)->status);
        // The figures and the scene's name may give way to a long message.
        assert_in_range(texts, messages[m] == long_message ? 7 : 9, 9);
    }
}

static void check_dialogs(struct session *f)
{
    const struct request quit = {.kind = REQUEST_QUIT};
    struct core *core = &f->editor->core;
    assert_true(core_step(core, "Change start", 0));
    assert_true(core_set_parameter(core, 0, PARAMETER_START, WIGGLY_REST));
    core_close(core);
    for (int kind = 0; kind < 4; kind++) {
        if (kind == 0) dialog_open(f->editor->dialogs, DIALOG_OPEN, "");
        if (kind == 1) dialogs_save_as(f->editor->dialogs);
        if (kind == 2) dialogs_leave(f->editor->dialogs, &quit);
        if (kind == 3) offer_recovery(f->editor, &(struct recovery_offer){"walk.json", "1 May 2026, 10:00", 2});
        for (int failed = 0; failed < 2; failed++) {
            show(f);
            dialogs_show(f->editor->dialogs);
            assert_true(assert_texts_apart(drawn_by(f->editor), 0, layout_of(f->editor)->window) >= 4);
            dialog_of(f->editor)->awaited = REQUEST_SAVE;
            panel_answer(
                f, REQUEST_SAVE, false,
                "/a/long/path/to/a/folder/that/is/not/there/at/all/scene.json: expected a folder that exists, got "
                "one that does not; and the disk is full besides, so that this needs a good many lines to be told");
        }
        session_key(f, KEY_ESCAPE, 0);
        assert_int_equal(asked(f->editor), DIALOG_NONE);
    }
}

static int calls;

static int list_names(void *user, const char *folder, char names[][256], int max)
{
    static const char long_name[] =
        "a name so long that it does not fit into any dialog, however wide it was made, and "
        "that goes on after that.json";
    static const char *const root[] = {"figures/", "figure1.json", "figure3.json", "tail.json", long_name};
    static const char *const figures[] = {"one.json", "two.json"};
    bool in_root = strcmp(folder, ".") == 0;
    const char *const *source = in_root ? root : figures;
    int count = in_root ? 5 : strcmp(folder, "figures/") == 0 ? 2 : -1;
    (void)user;
    calls++;
    for (int i = 0; i < count && i < max; i++) snprintf(names[i], 256, "%s", source[i]);
    return count;
}

TEST(test_no_text_leaves_its_panel_or_overlaps)
{
    static const float sizes[][2] = {{1280, 720}, {960, 600}, {2000, 1200}};
    static const char *const scenes[] = {small_scene, crowded_scene};
    for (int i = 0; i < 6; i++) {
        struct session f;
        panel_open(&f, scenes[i % 2], sizes[i / 2][0], sizes[i / 2][1]);
        set_path(f.editor, i % 2 ? "a scene with a name that is rather too long to show.json" : "x.json");
        list_files(f.editor, &(struct editor_app){.list = list_names});
        for (int s = 0; s < f.document->spline_count; s++) {
            activate(f.editor, s);
            check_inspector(&f);
        }
        check_status(&f);
        check_dialogs(&f);
        session_close(&f);
    }
}

// --- behaviour --------------------------------------------------------------------------------------------------------

static void expect_request(struct session *f, enum request_kind kind, const char *path)
{
    struct request request = session_asked(f);
    assert_int_equal(request.kind, kind);
    assert_string_equal(request.path, path);
}

static void answer_saved(struct session *f, enum request_kind kind, const char *path)
{
    set_path(f->editor, path);
    panel_answer(f, kind, true, "");
}

SESSION_TEST(test_save_as_stays_until_it_succeeds, panel_open(s, small_scene, 1280, 720))
{
    set_path(s->editor, "");
    session_key(s, 'S', MOD_CTRL); // has no file yet, so it asks
    assert_int_equal(asked(s->editor), DIALOG_SAVE_AS);
    assert_string_equal(typed(s->editor), "untitled.json");
    panel_type(s, "no/such/dog");
    session_key(s, KEY_ENTER, 0);
    expect_request(s, REQUEST_SAVE_AS, "no/such/dog.json");
    panel_answer(s, REQUEST_SAVE_AS, false, "no/such/dog.json: there is no such folder");
    assert_int_equal(asked(s->editor), DIALOG_SAVE_AS);
    assert_non_null(strstr(asked_error(s->editor), "no such folder"));
    assert_string_equal(said(s->editor), "");
    for (int i = 0; i < 20; i++) session_key(s, KEY_BACKSPACE, 0);
    session_key(s, KEY_ENTER, 0); // nothing typed
    expect_request(s, REQUEST_NONE, "");
    panel_type(s, "untitled.json");
    session_key(s, KEY_ENTER, 0);
    expect_request(s, REQUEST_SAVE_AS, "untitled.json");
    answer_saved(s, REQUEST_SAVE_AS, "pets/dog.json");
    assert_int_equal(asked(s->editor), DIALOG_NONE);
    session_key(s, 'S', MOD_CTRL);
    expect_request(s, REQUEST_SAVE, "");
    session_key(s, 'S', MOD_CTRL | MOD_SHIFT); // starts from where the file is, not from its bare name
    assert_string_equal(typed(s->editor), "pets/dog.json");
}

/// Changes something, then asks to quit.
static void open_unsaved(struct session *f, bool has_path)
{
    panel_open(f, small_scene, 1280, 720);
    set_path(f->editor, has_path ? "pets/dog.json" : "");
    panel_click(f, "mode.real");
    session_key(f, 'Q', MOD_CTRL);
    assert_int_equal(asked(f->editor), DIALOG_UNSAVED);
}

TEST(test_quitting_asks_for_unsaved_work)
{
    struct session f;
    open_unsaved(&f, true);
    session_key(&f, KEY_ESCAPE, 0);
    assert_int_equal(asked(f.editor), DIALOG_NONE);
    expect_request(&f, REQUEST_NONE, "");
    session_key(&f, 'Q', MOD_CTRL);
    panel_type(&f, "d");
    expect_request(&f, REQUEST_QUIT, "");
    session_close(&f);

    open_unsaved(&f, true);
    session_key(&f, KEY_RIGHT, 0);
    session_key(&f, KEY_ENTER, 0); // Discard
    expect_request(&f, REQUEST_QUIT, "");
    session_close(&f);

    panel_open(&f, small_scene, 1280, 720); // nothing to lose
    session_key(&f, 'Q', MOD_CTRL);
    expect_request(&f, REQUEST_QUIT, "");
    session_close(&f);
}

TEST(test_quit_waits_for_the_save)
{
    struct session f;
    open_unsaved(&f, true);
    panel_type(&f, "s");
    expect_request(&f, REQUEST_SAVE, "");
    expect_request(&f, REQUEST_NONE, "");
    panel_answer(&f, REQUEST_SAVE, false, "dog.json: the disk is full");
    expect_request(&f, REQUEST_NONE, ""); // the work in memory stays
    assert_int_equal(asked(f.editor), DIALOG_UNSAVED);
    panel_type(&f, "s");
    expect_request(&f, REQUEST_SAVE, "");
    history_mark_saved(f.history);
    answer_saved(&f, REQUEST_SAVE, "pets/dog.json");
    expect_request(&f, REQUEST_QUIT, "");
    session_close(&f);

    open_unsaved(&f, false); // never saved: first asks where
    panel_type(&f, "s");
    assert_int_equal(asked(f.editor), DIALOG_SAVE_AS);
    assert_string_equal(typed(f.editor), "untitled.json"); // and the S is no part of the name
    session_key(&f, KEY_ENTER, 0);
    expect_request(&f, REQUEST_SAVE_AS, "untitled.json");
    answer_saved(&f, REQUEST_SAVE_AS, "pets/dog.json");
    expect_request(&f, REQUEST_QUIT, "");
    session_close(&f);
}

TEST(test_cancelled_save_as_forgets_what_was_to_follow)
{
    struct session f;
    open_unsaved(&f, false);
    panel_type(&f, "s");
    session_key(&f, KEY_ESCAPE, 0);
    session_key(&f, 'S', MOD_CTRL | MOD_SHIFT);
    session_key(&f, KEY_ENTER, 0);
    expect_request(&f, REQUEST_SAVE_AS, "untitled.json");
    answer_saved(&f, REQUEST_SAVE_AS, "pets/dog.json");
    expect_request(&f, REQUEST_NONE, ""); // does not quit after all
    session_close(&f);
}

TEST(test_open_completes_paths)
{
    calls = 0;
    struct session f;
    panel_open(&f, small_scene, 1280, 720);
    list_files(f.editor, &(struct editor_app){.list = list_names});
    session_key(&f, 'O', MOD_CTRL);
    struct dialog *dialog = dialog_of(f.editor);
    assert_int_equal(dialog->match_count, 5);
    panel_type(&f, "fi");
    assert_int_equal(dialog->match_count, 4); // also in the middle of a name, but after those that begin so
    assert_string_equal(dialog->names[dialog->match[0]], "figures/");
    session_key(&f, KEY_TAB, 0);
    assert_string_equal(dialog->ui.text.bytes, "figure");
    assert_int_equal(calls, 1); // listed once, not at every key
    session_key(&f, KEY_DOWN, 0);
    session_key(&f, KEY_ENTER, 0); // into the folder
    assert_string_equal(dialog->ui.text.bytes, "figures/");
    assert_int_equal(dialog->match_count, 2);
    expect_request(&f, REQUEST_NONE, "");
    session_key(&f, KEY_DOWN, 0);
    session_key(&f, KEY_DOWN, 0);
    session_key(&f, KEY_ENTER, 0);
    expect_request(&f, REQUEST_OPEN, "figures/two.json");
    panel_answer(&f, REQUEST_OPEN, false, "figures/two.json:3: expected a number");
    assert_int_equal(dialog->kind, DIALOG_OPEN);
    session_key(&f, KEY_ENTER, 0);
    expect_request(&f, REQUEST_OPEN, "figures/two.json");
    editor_open(f.editor, &f.world);
    panel_answer(&f, REQUEST_OPEN, true, "");
    assert_int_equal(dialog->kind, DIALOG_NONE);
    session_key(&f, 'O', MOD_CTRL);
    panel_type(&f, "figures/t");
    assert_int_equal(dialog->match_count, 1);
    assert_false(session_shows(&f, "Nothing matches."));
    session_key(&f, KEY_ENTER, 0); // the only file that can be meant
    expect_request(&f, REQUEST_OPEN, "figures/two.json");
    panel_answer(&f, REQUEST_OPEN, true, "");
    session_key(&f, 'O', MOD_CTRL);
    panel_type(&f, "nobody");
    assert_true(session_shows(&f, "Nothing matches."));
    session_close(&f);
}

SESSION_TEST(test_dialog_takes_every_key, panel_open(s, small_scene, 1280, 720))
{
    session_key(s, 'O', MOD_CTRL);
    panel_type(s, "vim. ");
    session_key(s, 'Z', MOD_CTRL);
    session_key(s, KEY_F1, 0);
    session_key(s, KEY_DELETE, 0);
    assert_int_equal(look(s->editor), LOOK_WIGGLY);
    assert_false(looked_up(s->editor) == LOOKUP_KEYS);
    assert_int_equal(s->document->splines[0]->knot_count, 2);
    assert_string_equal(typed(s->editor), "vim. ");
}

/// The figures at the right must not cost a redraw every frame.
SESSION_TEST(test_figures_change_twice_a_second, panel_open(s, small_scene, 1280, 720))
{
    double last = 0;
    int changes = 0;
    for (int frame = 0; frame < 120; frame++) {
        tell_figures(s->editor, 50 + frame % 7, 200 + frame);
        editor_advance(s->editor, 1.0 / 60);
        changes += s->editor->core.status.shown.solve_us != last;
        last = s->editor->core.status.shown.solve_us;
    }
    assert_in_range(changes, 3, 5);
}

// --- upright windows --------------------------------------------------------------------------------------------------

SESSION_TEST(test_in_an_upright_window_the_panels_lie_below_each_other, panel_open(s, small_scene, 1280, 720))
{
    static const float sizes[][2] = {{390, 792}, {360, 560}, {768, 972}};
    const struct layout *l = layout_of(s->editor);
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        const struct rect *const panels[] = {&l->stage, &l->curves, &l->inspector, &l->status};
        float y = 0;
        editor_resize(s->editor, sizes[i][0], sizes[i][1], 1);
        for (int p = 0; p < 4; p++) {
            assert_near(panels[p]->w, sizes[i][0], 0);
            assert_near(panels[p]->y, y, 0);
            assert_true(p == 3 || panels[p]->h >= 120);
            y += panels[p]->h;
        }
        assert_near(y, sizes[i][1], 0);
    }
    editor_resize(s->editor, 390, 792, 1);
    const float middle = l->curves.y, low = l->inspector.y;
    s->finger = true;
    session_move(s, 195, low + 6); // as near as a finger gets
    session_press(s, BUTTON_LEFT, 1);
    session_drag(s, 0, -56, 4);
    session_release(s, BUTTON_LEFT);
    assert_near(l->inspector.y, low - 50, 2);
    session_move(s, 195, l->curves.y);
    session_press(s, BUTTON_LEFT, 1);
    session_drag(s, 0, middle - 40 - l->curves.y, 4);
    session_release(s, BUTTON_LEFT);
    assert_near(l->curves.y, middle - 40, 1);
    float knot[2];
    session_frame(s);
    session_where(s, "knot(sway,1)", knot);
    for (int finger = 0; finger < 2; finger++) {
        s->finger = finger;
        session_move(s, knot[0] + 14, knot[1]);
        session_frame(s);
        assert_int_equal(hovered(s->editor) == &thing_knot, finger);
    }
    editor_resize(s->editor, 792, 390, 1);
    assert_true(l->inspector.x > 400);
}

SESSION_TEST(test_a_drag_beside_its_controls_scrolls_the_inspector, panel_open(s, small_scene, 390, 792))
{
    struct ui_list *scroll = sections(s->editor);
    session_move(s, 30, layout_of(s->editor)->inspector.y + 150);
    session_press(s, BUTTON_LEFT, 1);
    session_drag(s, 0, -80, 4);
    assert_near(scroll->offset, 80, 0);
    session_drag(s, 0, 500, 4);
    assert_near(scroll->offset, 0, 0);
    session_release(s, BUTTON_LEFT);
    session_move(s, 30, 400);
    assert_near(scroll->offset, 0, 0);
    assert_true(history_is_saved(s->history));
}

/// There is no room for it beside the controls.
SESSION_TEST(test_a_message_takes_the_whole_of_a_narrow_status_line, panel_open(s, small_scene, 390, 792))
{
    assert_true(session_shows(s, "Auto-key"));
    tell(s->editor, false, "%s", "Saved as walk.json");
    session_frame(s);
    assert_true(session_shows(s, "Saved as walk.json"));
    assert_false(session_shows(s, "Auto-key"));
    session_move(s, 20, 780); // over the play button
    session_click_here(s, 1);
    assert_false(playback_of(s->editor)->playing);
    assert_true(session_shows(s, "Auto-key"));
    session_click_here(s, 1);
    assert_true(playback_of(s->editor)->playing);
}
