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
