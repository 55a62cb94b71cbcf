/// The inspector at the first start: what an animator needs first, each further section when it is wanted, and More for the rest.
#include "panel_session.h"
#include "shown.h"

static void open_first(struct session *s)
{
    session_open_file(s, "assets/scenes/tail.json");
    show_more(s->editor, false);
    session_frame(s);
}

/// Controls that Tab reaches, without the headers of sections; the comparison counts once.
static int count_controls(const struct session *s)
{
    static const char *const headers[] = {"section.feel", "section.knot", "section.splines"};
    const struct ui *ui = inspector_of(s->editor);
    int count = ui->stop_count;
    for (int i = 0; i < ui->stop_count; i++) {
        for (size_t h = 0; h < sizeof headers / sizeof headers[0]; h++)
            count -= ui->stop[i].id == ui_id(ui, headers[h]);
    }
    return count;
}

SESSION_TEST(test_twenty_controls_at_the_first_start, open_first(s))
{
    static const char *const shown[] = {"preset.cat", "frequency",   "damping",     "wind-up", "lag",       "gain",
                                        "knot.next",  "spline.sway", "splines.add", "more",    "look.stiff"};
    static const char *const hidden[] = {"follow.frequency", "gain.ramp",      "gain.curve",     "eye.sway",
                                         "color.sway",       "splines.delete", "section.spline", "section.rigs",
                                         "section.tail",     "section.pins",   "section.poles",  "section.history"};
    for (size_t i = 0; i < sizeof shown / sizeof shown[0]; i++) assert_true(panel_shows(s, shown[i]));
    for (size_t i = 0; i < sizeof hidden / sizeof hidden[0]; i++) assert_false(panel_shows(s, hidden[i]));
    session_frame(s);
    assert_in_range(count_controls(s), 10, 20);
    assert_true(session_shows(s, "Wiggly"));
    assert_false(session_shows(s, "Spring")); // no spline of the scene is one
}

SESSION_TEST(test_more_opens_the_rest_and_closes_it, open_first(s))
{
    panel_click(s, "more");
    assert_true(panel_shows(s, "follow.frequency"));
    session_key(s, KEY_F9, 0);
    assert_false(panel_shows(s, "follow.frequency"));
    session_key(s, KEY_F9, 0);
    sections(s->editor)->offset = 1e6f;
    session_frame(s);
    assert_true(panel_shows(s, "section.history"));
}

/// A section comes with what it is about, and goes with it.
SESSION_TEST(test_sections_come_when_they_are_wanted, open_first(s))
{
    session_key(s, 'H', 0); // pins the tip
    assert_true(panel_shows(s, "section.pins"));
    session_key(s, KEY_ESCAPE, 0);
    assert_false(panel_shows(s, "section.pins"));
    session_key(s, 'A', 0);
    panel_type(s, "tai");
    session_key(s, KEY_ENTER, 0);
    assert_true(panel_shows(s, "section.tail"));
    panel_click(s, "section.tail"); // closed, it is no longer wanted
    assert_false(panel_shows(s, "section.tail"));
}

/// Without splines there is something to begin with.
TEST(test_an_empty_scene_is_not_an_empty_inspector)
{
    struct session s;
    session_open(&s, "{\"wiggly\": 1, \"frames\": [0, 96]}");
    show_more(s.editor, false);
    assert_true(panel_shows(&s, "rig.add") && panel_shows(&s, "splines.add"));
    session_close(&s);
}

/// Where a widget is, down the inspector.
static float height_of(struct session *s, const char *name)
{
    float x, y;
    if (!widget_at(s->editor, name, &x, &y)) fail_msg("the inspector does not show %s", name);
    return y;
}

static const char mixed[] =
    "{\"wiggly\": 1, \"frames\": [0, 96], \"splines\": ["
    "{\"name\": \"tail\", \"frequency\": 1, \"damping\": 0.1, \"knots\": [{\"frame\": 0, \"value\": 1}]},"
    "{\"name\": \"cubic\", \"mode\": \"cubic\", \"knots\": [{\"frame\": 0, \"value\": 1}]},"
    "{\"name\": \"follows\", \"frequency\": {\"spline\": \"cubic\"}, \"knots\": [{\"frame\": 0, \"value\": 1}]},"
    "{\"name\": \"fast\", \"frequency\": 40, \"knots\": [{\"frame\": 0, \"value\": 1}]},"
    "{\"name\": \"idle\", \"mode\": \"real\", \"knots\": []}],"
    "\"rigs\": [{\"type\": \"tail\", \"name\": \"tail\", \"joints\": 3, \"channels\": ["
    "{\"spline\": \"tail\", \"lag\": {\"ramp\": [[0, 6], [1, 9]]}, \"gain\": [3, 6, 9]},"
    "{\"spline\": \"fast\", \"axis\": \"up\"}]}]}";

/// No row moves when another spline becomes active, whatever kind it is and whatever is said of it; nor with More, beside a spline whose lag
/// or gain is a curve.
SESSION_TEST(test_rows_stay_where_they_are, panel_open(s, mixed, 1280, 2000))
{
    static const char *const rows[] = {"section.knot", "section.splines", "more", "section.rigs", "section.tail"};
    for (int more = 0; more < 2; more++) {
        float before[5];
        const int count = more ? 5 : 3;
        show_more(s->editor, more);
        session_frame(s);
        for (int r = 0; r < count; r++) before[r] = height_of(s, rows[r]);
        for (int i = 0; i < 5; i++) {
            session_key(s, KEY_PAGE_DOWN, 0);
            session_frame(s);
            for (int r = 0; r < count; r++) {
                if (height_of(s, rows[r]) != before[r])
                    fail_msg("%s moves: %g, not %g", rows[r], height_of(s, rows[r]), before[r]);
            }
        }
    }
}

/// A click on a tail makes it the subject: its spline is the active one, and its section comes.
SESSION_TEST(test_a_clicked_tail_is_shown, open_first(s))
{
    const size_t done = history_done(s->history);
    for (int i = 0; i < 2; i++) session_key(s, KEY_PAGE_DOWN, 0); // the breath
    assert_false(panel_shows(s, "section.tail"));
    session_click(s, "tail(tail,0.8)");
    assert_string_equal(active_spline(s->editor)->name, "sway");
    assert_true(panel_shows(s, "section.tail"));
    session_key(s, KEY_PAGE_DOWN, 0);
    session_click(s, "tail(tail,0.8)"); // bent by this spline, too
    assert_string_equal(active_spline(s->editor)->name, "up");
    assert_int_equal(history_done(s->history), done);
}

/// Where a text is drawn; outside the panel if it is scrolled out of sight.
static float drawn_at(const struct session *s, const char *words)
{
    const struct draw_command *text = shown_text(s->editor, words);
    return text ? text->y : -1e6f;
}

/// In the frame in which the panel gets shorter, or a section is asked for, it is drawn where it stays. A section higher than the panel is
/// shown from its top, also if it is half in sight.
SESSION_TEST(test_the_first_frame_is_right, panel_open(s, mixed, 1280, 360))
{
    struct inspector *inspector = s->editor->inspector;
    show_more(s->editor, true);
    session_frame(s);
    inspector->sections.offset = 1e6f;
    session_frame(s);
    for (int unfolded = 0; unfolded < 2; unfolded++) {
        const char *title = unfolded ? "Tail set-up" : "More";
        if (unfolded) inspector_unfold(inspector, "section.tail");
        show_more(s->editor, unfolded);
        session_frame(s);
        const float first = drawn_at(s, title);
        session_frame(s);
        assert_near(drawn_at(s, title), first, 0);
        assert_in_range(first, 0, unfolded ? 2 * UI_ROW : 360);
    }
    inspector->sections.offset += 100;
    inspector_unfold(inspector, "section.tail");
    session_frame(s);
    assert_in_range(drawn_at(s, "Tail set-up"), 0, 2 * UI_ROW);
}
