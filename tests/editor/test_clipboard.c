/// Knots as text and on the clipboard: what is read, what is refused and with which words, and what pasting does.
#include "panel_session.h"
#include "scene/knots.h"

static const char FIVE[] =
    "{\"wiggly\": 1, \"frames\": [0, 96], \"splines\": [{\"name\": \"sway\", \"frequency\": 1,"
    "\"damping\": 0.1, \"knots\": [{\"frame\": 10, \"value\": 0}, {\"frame\": 20.5, \"value\": 1, \"slope\": 2,"
    "\"stiffness\": 50}, {\"frame\": 30, \"value\": -1}, {\"frame\": 40, \"value\": 0.5},"
    "{\"frame\": 60, \"value\": 0, \"mark\": \"kept\"}]}]}";

static const struct spline *sway(const struct session *s) { return s->document->splines[0]; }

static void paste(struct session *s, const char *text)
{
    session_send(s, (struct event){.kind = EVENT_PASTE, .text = text});
    session_frame(s);
}

/// The text of the session's clipboard, as the app would have put it there; for the caller to free.
static char *copy(struct session *s, int key)
{
    session_key(s, key, MOD_CTRL);
    assert_int_equal(session_asked(s).kind, REQUEST_COPY);
    char *text = strdup(copied(s->editor));
    assert_non_null(text);
    return text;
}

TEST(test_text_reads_back_equal)
{
    struct knot knots[] = {{.frame = -3.25, .value = 1.0 / 3, .stiffness = KNOT_DEFAULT_STIFFNESS},
                           {.frame = 7, .value = -2e-9, .has_slope = true, .slope = 0.1, .stiffness = 12}};
    struct knot_list list;
    char *text = knots_print(&(struct knot_list){.knots = knots, .count = 2});
    assert_non_null(strstr(text, "{ \"frame\": 7, \"value\": -2e-9, \"slope\": 0.1, \"stiffness\": 12 }"));
    assert_done(knots_parse("clipboard", text, &list, &error));
    assert_int_equal(list.count, 2);
    for (int k = 0; k < 2; k++) {
        assert_near(list.knots[k].frame, knots[k].frame, 0);
        assert_near(list.knots[k].value, knots[k].value, 0);
        assert_near(list.knots[k].slope, knots[k].slope, 0);
        assert_near(list.knots[k].stiffness, knots[k].stiffness, 0);
        assert_int_equal(list.knots[k].has_slope, knots[k].has_slope);
    }
    knot_list_free(&list);
    free(text);
}

TEST(test_csv_in_its_dialects)
{
    static const char *const texts[] = {
        "1,2\n3,4.5,0.25,80\n",
        "frame,value,slope,stiffness\r\n1,2\r\n3,4.5,0.25,80\r\n",
        "1;2\n\n# a comment\n3;4,5;0,25;80",
        "\xEF\xBB\xBFvalue\tframe\tnote\tstiffness\tslope\n2\t1\t\t\t\n\"4.5\"\t3\thi\t80\t0.25",
        " 1 , 2 \n 3 , 4.5 , 0.25 , 80 ",
        "1,2\r\n\r\n\t\r\n \n  # a comment\r\n3,4.5,0.25,80\r\n\r\n", // blank lines of every kind
        "\"1\",\"2\"\n\"3\",\"4.5\",\"0.25\",\"80\"",
    };
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
        struct knot_list list;
        struct error error = {0};
        if (!knots_parse("clipboard", texts[i], &list, &error)) fail_msg("%zu: %s", i, error.text);
        assert_int_equal(list.count, 2);
        assert_near(list.knots[0].frame, 1, 0);
        assert_near(list.knots[0].value, 2, 0);
        assert_false(list.knots[0].has_slope);
        assert_near(list.knots[0].stiffness, KNOT_DEFAULT_STIFFNESS, 0);
        assert_near(list.knots[1].frame, 3, 0);
        assert_near(list.knots[1].value, 4.5, 0);
        assert_true(list.knots[1].has_slope);
        assert_near(list.knots[1].slope, 0.25, 0);
        assert_near(list.knots[1].stiffness, 80, 0);
        knot_list_free(&list);
    }
}

/// What `wiggly solve` writes has other columns after the first two; they are no slopes.
TEST(test_solved_samples_are_knots)
{
    struct knot_list list;
    assert_true(knots_parse("clipboard", "frame,sway,sway.re,sway.im\n0,1,1,0.5\n1,2,2,0.25\n", &list, NULL));
    assert_int_equal(list.count, 2);
    assert_near(list.knots[1].value, 2, 0);
    assert_false(list.knots[1].has_slope);
    knot_list_free(&list);
}

TEST(test_bad_text_is_refused_in_one_sentence)
{
    static const struct {
        const char *text, *sentence;
    } cases[] = {
        {"1,2\n3\n", "clipboard:2: expected a value or still after the frame (frame,value[,slope[,stiffness[,im]]]), "
                     "got nothing"},
        {"1,2\n3,x\n",
         "clipboard:2: expected a value or still after the frame (frame,value[,slope[,stiffness[,im]]]), got \"x\""},
        {"hello", "clipboard:1: expected a frame from -1000000000 to 1000000000, got \"hello\""},
        {"1,2\n\nlater,3\n", "clipboard:3: expected a frame from -1000000000 to 1000000000, got \"later\""},
        {"1e30,2", "clipboard:1: expected a frame from -1000000000 to 1000000000, got \"1e30\""},
        {"1,2,steep", "clipboard:1: expected a number as the slope, got \"steep\""},
        {"1,2,0,-4", "clipboard:1: expected a number above 0 as the stiffness, got \"-4\""},
        {"1,nan", "clipboard:1: expected a value or still after the frame (frame,value[,slope[,stiffness[,im]]]), "
                  "got \"nan\""},
        {"frame,value\n", "clipboard:1: expected knots as JSON or as lines frame,value, got nothing"},
        {"[]", "clipboard:1: scene: expected at least one knot, got none"},
        {"{\"knots\": 3}", "clipboard:1: knots: expected an array, got a number"},
        {"[{\"frame\": 1}]", "clipboard:1: [0].value: expected a number, got nothing"},
        {"[{\"frame\": 1, \"value\": 2},\n{\"frame\": \"a\", \"value\": 2}]",
         "clipboard:2: [1].frame: expected a number, got a string"},
        {"[{\"frame\": 1, \"value\": 2}", NULL}, // whatever the sentence, its place is
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct knot_list list = {0};
        struct error error = {0};
        assert_false(knots_parse("clipboard", cases[i].text, &list, &error));
        assert_null(list.knots);
        if (cases[i].sentence) assert_string_equal(error.text, cases[i].sentence);
        assert_ptr_equal(strstr(error.text, "clipboard:"), error.text);
    }
}

SESSION_TEST(test_copy_and_paste_at_the_playhead, session_open(s, FIVE))
{
    session_click(s, "knot(sway,1)");
    session_click_with(s, MOD_SHIFT, "knot(sway,2)");
    char *text = copy(s, 'C');
    session_click(s, "ruler(70)");
    const char *original = session_saved(s);
    session_key(s, 'V', MOD_CTRL);
    assert_int_equal(session_asked(s).kind, REQUEST_PASTE);
    paste(s, text);
    assert_int_equal(sway(s)->knot_count, 7);
    assert_near(sway(s)->knots[5].frame, 70, 0);
    assert_near(sway(s)->knots[5].slope, 2, 0);
    assert_near(sway(s)->knots[5].stiffness, 50, 0);
    assert_near(sway(s)->knots[6].frame, 79.5, 0);
    assert_near(sway(s)->knots[6].value, -1, 0);
    assert_int_equal(selection_count(selection_of(s->editor), sway(s)), 2);
    assert_true(selection_has(selection_of(s->editor), sway(s)->knots[5].id)); // what was pasted is selected
    assert_one_step(s, original);
    free(text);
}

SESSION_TEST(test_cut_is_one_step, session_open(s, FIVE))
{
    session_key(s, 'A', MOD_CTRL);
    const char *original = session_saved(s);
    char *text = copy(s, 'X');
    assert_int_equal(sway(s)->knot_count, 0);
    assert_string_equal(history_undo_label(s->history), "Cut knots");
    assert_one_step(s, original);
    session_click(s, "ruler(10)");
    paste(s, text);
    assert_int_equal(sway(s)->knot_count, 5); // where they were
    assert_near(sway(s)->knots[1].frame, 20.5, 0);
    free(text);
}

/// The second knot would hit the one at 40, the third of the next text the end of the range.
SESSION_TEST(test_a_paste_that_does_not_fit_changes_nothing, session_open(s, FIVE))
{
    session_click(s, "ruler(35)");
    const char *original = session_saved(s);
    paste(s, "0,1\n5,2\n");
    assert_string_equal(said(s->editor), "sway: there is already a knot at frame 40");
    paste(s, "0,1\n1,2\n200,3\n");
    assert_string_equal(said(s->editor), "sway: frame 235 is outside 0 to 96");
    paste(s, "0,1\n0,2\n");
    assert_string_equal(said(s->editor), "sway: there is already a knot at frame 35");
    paste(s, "nonsense");
    assert_true(said_error(s->editor));
    assert_null(history_undo_label(s->history));
    assert_saved(s, original);
    paste(s, " \n");
    assert_string_equal(said(s->editor), "The clipboard has no text.");
}

SESSION_TEST(test_copies_come_behind_and_pass_through, session_open(s, FIVE))
{
    session_click(s, "knot(sway,2)");
    session_click_with(s, MOD_SHIFT, "knot(sway,3)");
    const char *original = session_saved(s);
    session_key(s, 'D', MOD_CTRL); // 30, 40 → 50, and 60 is taken: 51, 61
    assert_int_equal(sway(s)->knot_count, 7);
    assert_near(sway(s)->knots[4].frame, 51, 0);
    assert_near(sway(s)->knots[6].frame, 61, 0);
    assert_near(sway(s)->knots[6].value, 0.5, 0);
    assert_one_step(s, original);
    session_key(s, 'A', MOD_CTRL);
    original = session_saved(s);
    session_key(s, 'D', MOD_CTRL); // 10 … 61, the copies from 62 on: the scene gets longer
    assert_int_equal(sway(s)->knot_count, 14);
    assert_int_equal(s->document->last_frame, 113);
    assert_said(s->editor, "now ends on frame 113");
    assert_one_step(s, original);
    session_key(s, 'Z', MOD_CTRL);
    session_click(s, "knot(sway,5)");
    session_key(s, 'D', MOD_CTRL);
    const char *now = session_saved(s), *mark = strstr(now, "\"mark\": \"kept\"");
    assert_non_null(mark);
    assert_non_null(strstr(mark + 1, "\"mark\": \"kept\"")); // keys that nobody here knows are copied too
}
