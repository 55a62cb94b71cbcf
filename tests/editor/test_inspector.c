/// The inspector: what its widgets do to the document, by the events of mouse and keyboard.
#include "panel_session.h"
#include "shown.h"

static const char scene[] =
    "{\"wiggly\": 1, \"frames\": [0, 96], \"splines\": [" PANEL_SPLINES "],"
    "\"rigs\": [{\"type\": \"tail\", \"name\": \"tail\", \"joints\": 3, \"rest\": [4, -2, 1], \"channels\": ["
    "{\"spline\": \"sway\", \"axis\": \"side\", \"lag\": 6.5, \"gain\": [3, 6, 9]},"
    "{\"spline\": \"lift\", \"axis\": \"up\", \"lag\": 5, \"gain\": 4}]}]}";

static const struct param *parameter(const struct session *f, int spline, enum parameter which)
{
    return &f->document->splines[spline]->parameter[which];
}

SESSION_TEST(test_drag_is_one_undo_step, panel_open(s, scene, 1280, 720))
{
    panel_drag(s, "frequency", 2.5);
    assert_near(parameter(s, 0, PARAMETER_FREQUENCY)->value, 2.5, 0);
    assert_true(inspector_is_dragging(s->editor->inspector));
    panel_release(s);
    assert_false(history_is_open(s->history));
    assert_string_equal(history_undo_label(s->history), "Set frequency");
    session_key(s, 'Z', MOD_CTRL);
    assert_near(parameter(s, 0, PARAMETER_FREQUENCY)->value, 1, 0);
    assert_null(history_undo_label(s->history));
    session_key(s, 'Y', MOD_CTRL);
    assert_near(parameter(s, 0, PARAMETER_FREQUENCY)->value, 2.5, 0);
}

SESSION_TEST(test_escape_takes_a_drag_back, panel_open(s, scene, 1280, 720))
{
    panel_drag(s, "damping", 1);
    assert_near(parameter(s, 0, PARAMETER_DAMPING)->value, 1, 0);
    session_key(s, KEY_ESCAPE, 0);
    assert_near(parameter(s, 0, PARAMETER_DAMPING)->value, 0.1, 0);
    assert_false(history_is_open(s->history));
    assert_null(history_undo_label(s->history));
    panel_release(s);
}

/// Closing the window in the middle of a drag must not leave a half-open step behind.
SESSION_TEST(test_closing_ends_a_drag, panel_open(s, scene, 1280, 720))
{
    panel_drag(s, "frequency", 3);
    session_send(s, (struct event){.kind = EVENT_CLOSE});
    assert_false(history_is_open(s->history));
    assert_int_equal(asked(s->editor), DIALOG_UNSAVED);
}

SESSION_TEST(test_typed_nonsense_is_said_and_refused, panel_open(s, scene, 1280, 720))
{
    panel_enter(s, "damping", "lots");
    assert_said_error(s->editor, "damping: expected a number");
    session_key(s, 'A', 0);
    session_key(s, KEY_ESCAPE, 0);
    panel_enter(s, "damping", "1.5"); // more than complex mode takes
    assert_said(s->editor, "damping: expected 0 … 1");
    assert_near(parameter(s, 0, PARAMETER_DAMPING)->value, 0.1, 0);
    assert_null(history_undo_label(s->history));
}

SESSION_TEST(test_typing_keeps_keys_from_the_editor, panel_open(s, scene, 1280, 720))
{
    panel_press(s, "frequency", 2);
    panel_release(s);
    assert_true(inspector_of(s->editor)->typing);
    session_key(s, 'A', MOD_CTRL); // all of what is typed, not all knots
    panel_type(s, "v m.");
    assert_int_equal(selection_count(selection_of(s->editor), s->document->splines[0]), 0);
    session_key(s, KEY_END, 0);
    session_key(s, 'A', MOD_CTRL);
    panel_type(s, "x");
    assert_string_equal(inspector_of(s->editor)->text.bytes, "x");
    session_key(s, KEY_DELETE, 0);
    session_key(s, KEY_SPACE, 0);
    assert_int_equal(look(s->editor), LOOK_WIGGLY);
    assert_int_equal(spline_mode(s->document->splines[0]), WIGGLY_COMPLEX);
    assert_int_equal(s->document->splines[0]->knot_count, 3);
    assert_false(playback_of(s->editor)->playing);
    session_key(s, KEY_F1, 0);
    assert_true(looked_up(s->editor) == LOOKUP_KEYS);
    session_key(s, KEY_ESCAPE, 0);
    session_key(s, KEY_ESCAPE, 0);
    assert_false(inspector_of(s->editor)->typing);
    session_key(s, 'V', 0);
    assert_int_equal(look(s->editor), LOOK_STIFF);
}

SESSION_TEST(test_arrows_belong_to_the_focus, panel_open(s, scene, 1280, 720))
{
    inspector_of(s->editor)->focus = panel_id(s, "frequency");
    session_key(s, KEY_RIGHT, 0);
    session_key(s, KEY_RIGHT, 0);
    assert_near(parameter(s, 0, PARAMETER_FREQUENCY)->value, 1.1, 0);
    assert_near(playback_of(s->editor)->position, 0, 0);
    session_key(s, 'Z', MOD_CTRL); // the run of nudges is one step
    assert_near(parameter(s, 0, PARAMETER_FREQUENCY)->value, 1, 0);
    session_key(s, KEY_ESCAPE, 0);
    session_key(s, KEY_RIGHT, 0);
    assert_near(playback_of(s->editor)->position, 1, 0);
    assert_near(parameter(s, 0, PARAMETER_FREQUENCY)->value, 1, 0);
}

SESSION_TEST(test_only_what_counts_is_shown, panel_open(s, scene, 1280, 1700))
{
    assert_false(panel_shows(s, "bandwidth"));
    panel_click(s, "section.advanced");
    assert_true(panel_shows(s, "bandwidth"));
    panel_click(s, "mode.real");
    assert_int_equal(spline_mode(s->document->splines[0]), WIGGLY_REAL);
    assert_false(panel_shows(s, "bandwidth"));
    panel_click(s, "mode.cubic");
    assert_false(panel_shows(s, "frequency"));
    panel_click(s, "spline.lift");
    assert_int_equal(active(s->editor), 2);
    assert_false(panel_shows(s, "frequency")); // a track drives it
    assert_true(panel_shows(s, "damping"));
    panel_click(s, "start.loop");
    assert_int_equal(spline_start(s->document->splines[2]), WIGGLY_LOOP);
    panel_click(s, "look.cubic");
    assert_int_equal(look(s->editor), LOOK_CUBIC);
}

SESSION_TEST(test_knot_is_edited_in_place, panel_open(s, scene, 1280, 1600))
{
    unsigned id = s->document->splines[0]->knots[1].id;
    selection_set(selection_of(s->editor), id, true);
    panel_enter(s, "value", "0.75");
    assert_near(s->document->splines[0]->knots[1].value, 0.75, 0);
    panel_enter(s, "value", "8"); // above all that was in sight
    for (int frame = 0; frame < 90; frame++) session_frame(s);
    assert_true(plot_of(s->editor)->value1 > 8);
    panel_enter(s, "frame", "70"); // past its neighbour
    assert_near(s->document->splines[0]->knots[2].frame, 70, 0);
    assert_int_equal(s->document->splines[0]->knots[2].id, id);
    panel_enter(s, "frame", "60"); // where another knot sits
    assert_near(s->document->splines[0]->knots[2].frame, 70, 0);
    assert_true(said_error(s->editor));
    panel_pull(s, "frame", 600, 0, 1); // far beyond the scene: it stops at the last frame
    assert_near(s->document->splines[0]->knots[2].frame, 96, 0);
    panel_click(s, "has_slope");
    assert_true(s->document->splines[0]->knots[2].has_slope);
    panel_enter(s, "stiffness", "50");
    assert_near(s->document->splines[0]->knots[2].stiffness, 50, 0);
}

SESSION_TEST(test_one_knot_has_one_frame, panel_open(s, scene, 1280, 1400))
{
    assert_non_null(shown_text(s->editor, "3, frames 0 … 60"));
    panel_click(s, "spline.lift");
    assert_non_null(shown_text(s->editor, "1, frame 10"));
}

/// Nothing is selected: the section says what knots there are and works without pointing at one; what is below stays where it is.
SESSION_TEST(test_the_knot_section_without_a_knot, panel_open(s, scene, 1280, 1400))
{
    float x, y[2];
    assert_true(widget_at(s->editor, "section.splines", &x, &y[0]));
    playback_of(s->editor)->position = 20;
    panel_click(s, "knot.insert");
    assert_int_equal(s->document->splines[0]->knot_count, 4);
    assert_near(s->document->splines[0]->knots[1].frame, 20, 0);
    assert_true(widget_at(s->editor, "section.splines", &x, &y[1]));
    assert_near(y[1], y[0], 0);
    assert_false(panel_shows(s, "knot.insert"));
    session_key(s, KEY_ESCAPE, 0);
    panel_click(s, "knot.next");
    assert_near(playback_of(s->editor)->position, 36, 0);
    session_key(s, KEY_ESCAPE, 0);
    panel_click(s, "knot.all");
    assert_true(panel_shows(s, "slope.flat"));
}

/// Several knots at once: typed numbers are set, drags and frames move, and what is not possible changes nothing.
SESSION_TEST(test_several_knots, panel_open(s, scene, 1280, 1600))
{
    session_key(s, 'A', MOD_CTRL);
    assert_false(panel_shows(s, "stiffness")); // no slopes yet
    panel_enter(s, "value", "0.25");
    for (int k = 0; k < 3; k++) assert_near(s->document->splines[0]->knots[k].value, 0.25, 0);
    session_key(s, 'Z', MOD_CTRL); // one step
    assert_near(s->document->splines[0]->knots[1].value, 1, 0);
    panel_pull(s, "value", 50, 0, 5);
    assert_near(s->document->splines[0]->knots[0].value, 0.5, 1e-12);
    assert_near(s->document->splines[0]->knots[2].value, 0, 1e-12);
    session_key(s, 'Z', MOD_CTRL);
    assert_null(history_undo_label(s->history));
    panel_enter(s, "frame", "10");
    assert_near(s->document->splines[0]->knots[0].frame, 10, 0);
    assert_near(s->document->splines[0]->knots[2].frame, 70, 0);
    panel_enter(s, "frame", "40"); // the last one would leave the scene
    assert_near(s->document->splines[0]->knots[0].frame, 10, 0);
    assert_said(s->editor, "frame 100 is outside 0 to 96");
    panel_pull(s, "frame", 60, 0, 60); // as far as it goes
    assert_near(s->document->splines[0]->knots[2].frame, 96, 0);
    assert_near(s->document->splines[0]->knots[1].frame, 72, 0);
    session_key(s, 'T', 0);
    panel_enter(s, "stiffness", "50");
    for (int k = 0; k < 3; k++) assert_near(s->document->splines[0]->knots[k].stiffness, 50, 0);
    panel_enter(s, "slope", "steep");
    assert_said(s->editor, "slope: expected a number");
}

SESSION_TEST(test_frame_drag_passes_through_a_neighbour, panel_open(s, scene, 1280, 720))
{
    selection_set(selection_of(s->editor), s->document->splines[0]->knots[1].id, true);
    panel_press(s, "frame", 1);
    float x = s->x;
    for (int moved = 3; moved <= 30; moved++) session_move(s, x + (float)moved, s->y);
    assert_near(s->document->splines[0]->knots[2].frame, 66, 0);
    assert_near(s->document->splines[0]->knots[1].frame, 60, 0);
    panel_release(s);
    session_key(s, 'Z', MOD_CTRL);
    assert_near(s->document->splines[0]->knots[1].frame, 36, 0);
}

/// The pointer's shape says that a number is dragged, and where a text is typed.
SESSION_TEST(test_the_pointer_says_what_it_does, panel_open(s, scene, 1280, 720))
{
    assert_int_equal(editor_cursor(s->editor), CURSOR_ARROW);
    panel_drag(s, "damping", 0.3);
    assert_int_equal(editor_cursor(s->editor), CURSOR_HORIZONTAL);
    panel_release(s);
    assert_int_equal(editor_cursor(s->editor), CURSOR_HORIZONTAL);
    panel_press(s, "damping", 2);
    panel_release(s);
    assert_int_equal(editor_cursor(s->editor), CURSOR_TEXT);
    session_key(s, KEY_ESCAPE, 0);
    panel_click(s, "section.knot");
    assert_int_equal(editor_cursor(s->editor), CURSOR_ARROW);
}

TEST(test_tail_array_scales_as_a_whole)
{
    struct session f;
    panel_open(&f, scene, 1280, 1600);
    panel_drag(&f, "gain", 18);
    assert_near(document_tail(f.document, 0)->channels[0].gain.value[0], 6, 1e-12);
    assert_near(document_tail(f.document, 0)->channels[0].gain.value[2], 18, 0);
    session_move(&f, 0, 300); // through zero and back in the same drag nothing is lost
    assert_near(document_tail(f.document, 0)->channels[0].gain.value[2], 0, 0);
    panel_drag(&f, "gain", 9);
    assert_near(document_tail(f.document, 0)->channels[0].gain.value[0], 3, 1e-12);
    panel_release(&f);
    session_key(&f, 'Z', MOD_CTRL);
    assert_near(document_tail(f.document, 0)->channels[0].gain.value[0], 3, 0);
    session_key(&f, KEY_PAGE_UP, 0); // the tail's numbers are those of the spline that is edited
    assert_int_equal(shown_channel(f.editor), 1);
    session_key(&f, KEY_PAGE_DOWN, 0);
    assert_int_equal(shown_channel(f.editor), 0);
    panel_click(&f, "channel.1");
    panel_drag(&f, "lag", 12);
    panel_release(&f);
    assert_near(document_tail(f.document, 0)->channels[1].lag.value[0], 12, 0);
    assert_near(document_tail(f.document, 0)->channels[0].lag.value[0], 6.5, 0);
    session_close(&f);
}

static bool shows_text(struct session *f, const char *part)
{
    struct drawlist *list = drawn_by(f->editor);
    drawlist_clear(list, layout_of(f->editor)->window);
    inspector_show(f->editor->inspector, false);
    for (int i = 0; i < list->count; i++) {
        if (list->commands[i].kind == DRAW_TEXT && strstr(list->text + list->commands[i].first, part)) return true;
    }
    return false;
}

/// Which way splines go follows from the document's length alone.
TEST(test_the_solver_is_said)
{
    struct session f;
    static const struct {
        const char *scene, *solver;
    } both[] = {
        {"{\"frames\": [0, 4095], \"splines\": [{\"name\": \"s\", \"frequency\": 1, \"knots\": []}]}", "band"},
        {"{\"frames\": [0, 4096], \"splines\": [{\"name\": \"s\", \"frequency\": 1, \"knots\": []}]}", "chain"}};
    for (int n = 0; n < 2; n++) {
        panel_open(&f, both[n].scene, 1280, 2000);
        panel_click(&f, "section.scene");
        assert_true(shows_text(&f, both[n].solver));
        session_close(&f);
    }
}

SESSION_TEST(
    test_says_what_the_solver_and_the_poles_mean,
    panel_open(
        s,
        "{\"wiggly\": 1, \"frames\": [0, 96], \"splines\": [{\"name\": \"a\", \"mode\": \"real\", \"frequency\": 1, "
        "\"knots\": [{\"frame\": 0, \"value\": 1}, {\"frame\": 12, \"value\": -1}, {\"frame\": 24, \"value\": "
        "1}]}]}",
        1280, 720))
{
    char words[24];
    assert_int_equal(s->work.evaluation.status[0], WIGGLY_OK);
    s->work.evaluation.status[0] = WIGGLY_CALMED;
    snprintf(words, sizeof words, "%s", wiggly_status_text(s->work.evaluation.status[0]));
    assert_true(shows_text(s, words));
    s->work.evaluation.status[0] = WIGGLY_OK;
    assert_true(shows_text(s, "Rings forever"));
    panel_drag(s, "damping", 0.5);
    panel_release(s);
    session_frame(s);
    assert_false(shows_text(s, words));
    assert_true(shows_text(s, "Settles to 5 % 21 frames after the last knot."));
    panel_drag(s, "damping", 2);
    panel_release(s);
    assert_true(shows_text(s, "Settles to 5 % 45 frames after"));
    panel_enter(s, "frequency", "20");
    assert_true(shows_text(s, "half the sample rate"));
}

static void assert_finite_and_loadable(struct session *f)
{
    session_frame(f);
    for (int s = 0; s < f->work.evaluation.count; s++) {
        for (int i = 0; i < f->work.evaluation.samples; i++) {
            assert_true(isfinite(f->work.evaluation.curves[s].total[i]) &&
                        isfinite(f->work.evaluation.curves[s].im[i]));
        }
    }
    assert_loads_again(f->document);
}

/// A scene of one spline with `knots` knots, an array of them on every frame.
static char *scene_of(int knots, const char *mode, const char *start)
{
    char *text = malloc(64 * (size_t)knots + 1024);
    assert_non_null(text);
    int n =
        sprintf(text,
                "{\"wiggly\": 1, \"frames\": [0, 480], \"splines\": [{\"name\": \"a\", \"mode\": \"%s\", \"start\": "
                "\"%s\", \"frequency\": 1, \"damping\": 0.1, \"knots\": [",
                mode, start);
    for (int k = 0; k < knots; k++) {
        n += sprintf(text + n, "%s{\"frame\": %d, \"value\": %d}", k ? ", " : "", 2 + k, k * 7 % 5 - 2);
    }
    sprintf(text + n, "]}], \"rigs\": [{\"type\": \"tail\", \"name\": \"t\", \"spline\": \"a\"}]}");
    return text;
}

/// Drags every slider that is shown to both of its ends and far beyond. Returns the number of drags.
static int try_all_sliders(struct session *f)
{
    int tried = 0;
    static const struct {
        const char *name;
        double ends[2];
    } sliders[] = {{"frequency", {0, 12}}, {"damping", {0, 1}}, {"damping", {0, 3}}, {"bandwidth", {0, 1}},
                   {"calm", {0, 1}},       {"lag", {0, 30}},    {"gain", {0, 20}},   {"rest", {-15, 15}}};
    for (size_t s = 0; s < sizeof sliders / sizeof sliders[0]; s++) {
        for (int end = 0; end < 2; end++) {
            if (!panel_shows(f, sliders[s].name)) continue;
            panel_drag(f, sliders[s].name, sliders[s].ends[end]);
            session_move(f, end ? 20000 : -20000, f->y);
            panel_release(f);
            assert_false(history_is_open(f->history));
            assert_finite_and_loadable(f);
            tried++;
        }
    }
    return tried;
}

TEST(test_extremes_stay_finite_and_loadable)
{
    static const int knots[] = {0, 1, 2, 400};
    static const char *const modes[] = {"complex", "real", "cubic"};
    static const char *const starts[] = {"free", "rest", "loop"};
    for (int k = 0; k < 4; k++) {
        for (int m = 0; m < 3; m++) {
            char *text = scene_of(knots[k], modes[m], starts[(m + k) % 3]);
            struct session f;
            panel_open(&f, text, 1280, 1600);
            panel_click(&f, "section.advanced");
            assert_int_equal(try_all_sliders(&f), m == 0 ? 16 : m == 1 ? 14 : 6);
            session_close(&f);
            free(text);
        }
    }
}

/// The status line shows it after the panel was laid out.
TEST(test_the_hint_of_a_position_outlives_the_panel)
{
    static const char tail[] =
        "{\"wiggly\": 1, \"frames\": [0, 48], \"splines\": [{\"name\": \"s\", \"knots\": []}], "
        "\"rigs\": [{\"type\": \"tail\", \"name\": \"t\", \"spline\": \"s\"}]}";
    struct session s;
    float x, y;
    panel_open(&s, tail, 1280, 1400);
    assert_true(widget_at(s.editor, "position.y", &x, &y));
    session_move(&s, x, y);
    session_frame(&s);
    assert_string_equal(inspector_of(s.editor)->hint, "Position of the body along y");
    session_close(&s);
}
