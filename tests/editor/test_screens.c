/// Every screen in every size, at every scale, dark and light: all text is whole, apart from other text, in its panel, and can be read; and
/// upright windows, where the panels lie below each other.
#include "base/file.h"
#include "hands.h"
#include "legible.h"

#define KNOTS                                                                                                        \
    "'knots': [{'frame': 0, 'value': 0}, {'frame': 30, 'value': 1, 'slope': 1}, {'frame': 70, 'value': -0.3}]"
#define SPLINE(name) "{'name': '" name "', 'frequency': 1.25, 'damping': 0.1, " KNOTS "}"
#define LONG_NAME "a spline whose name is far longer than any panel is wide, by a good deal"

/// Eight splines and three tails, some with names that fit nowhere.
static const char crowded[] =
    "{'about': 'A title of a scene that goes on for longer than the width of a stage allows. And a "
    "text below it that would fill a page, were there one, and has to be content with a few lines at the upper "
    "left of the stage, out of the way of what stands in its middle, however small the window is made; what is left "
    "over is not shown, and nobody will miss it, since it says nothing that was not said before, at length.', "
    "'frames': [0, 96], 'splines': [" SPLINE("sway") "," SPLINE("up") "," SPLINE("ears") "," SPLINE(LONG_NAME) "," //
    SPLINE("head") "," SPLINE("breath") "," SPLINE("left hand") "," SPLINE(
        "tip") "], 'rigs': [{'type': 'tail', "
               "'name': 'tail', 'channels': [{'spline': 'sway'}, {'spline': 'up', 'axis': 'up'}]}, {'type': 'tail', "
               "'name': "
               "'another tail, whose name is rather long as well', 'spline': 'head', 'position': [1.2, 0.26, 0]}, "
               "{'type': "
               "'tail', 'name': 'third', 'spline': 'breath', 'position': [-1.2, 0.26, 0]}]}";

/// Large numbers, tracks, many splines.
static const char huge[] =
    "{'frames': [-100000, -75001], 'substeps': 4, 'splines': [{'name': '" LONG_NAME "', 'mode': 'real', 'frequency': "
    "123456.789, 'damping': 12345678, 'equilibrium': -1e300, 'knots': [{'frame': -99999.75, 'value': -123456789.125, "
    "'slope': 1e200, 'stiffness': 1e250}]}, {'name': 'b', 'frequency': {'spline': '" LONG_NAME "'}, 'equilibrium': "
    "{'spline': 'c'}, 'knots': [{'frame': -80000, 'value': 0}]}, {'name': 'c'}, {'name': 'd'}, {'name': 'e'}, "
    "{'name': 'f'}, {'name': 'g'}, {'name': 'h'}, {'name': 'i'}, {'name': 'j'}], 'rigs': [{'type': 'tail', 'name': "
    "'t', 'joints': 2, 'rest': [-12345.5, 30000], 'channels': [{'spline': 'b', 'lag': [1, 2], 'gain': 5}, {'spline': "
    "'" LONG_NAME "'}]}, {'type': 'tail', 'name': 'u', 'spline': 'c'}]}";

static const char small[] =
    "{'frames': [0, 96], 'splines': [{'name': 'sway', 'frequency': 1, 'knots': [{'frame': 0, 'value': 0, 'slope': "
    "1}, "
    "{'frame': 36, 'value': 1}]}], 'rigs': [{'type': 'tail', 'name': 'tail', 'spline': 'sway'}]}";

static const char long_message[] =
    "a sentence that goes on and on about what is wrong with this file until there is no room left for it in the "
    "line, whatever the width of the window may be, even on the largest of screens, and then some more";

static int list_names(void *user, const char *folder, char names[][256], int max)
{
    (void)user;
    const int count = strcmp(folder, ".") == 0 ? max < 30 ? max : 30 : 0;
    for (int i = 0; i < count; i++) snprintf(names[i], 256, i ? "scene%d.json" : "figures/", i);
    return count;
}

static int list_long(void *user, const char *folder, char names[][256], int max)
{
    strcpy(names[3],
           "a name so long that it does not fit into any dialog, however wide it was made, and that goes on");
    return list_names(user, folder, names, max < 3 ? max : 3) + 1;
}

static int list_recent(void *user, struct dialog_recent *files, int most)
{
    (void)user;
    for (int i = 0; i < 3 && i < most; i++) {
        snprintf(files[i].path, sizeof files[i].path, "/home/somebody/animation/of/a/long/film/shot%d.json", i);
        files[i].missing = i == 2;
    }
    return most < 3 ? most : 3;
}

// --- screens ------------------------------------------------------------------------------------------------------------

static void open_changed(struct session *s) { dialogs_ask_changed(s->editor->dialogs, "walk.json", true); }

/// A long name beside the figures.
static void open_busy(struct session *s) { tell_figures(s->editor, 0, 8465); }

static void open_failed(struct session *s)
{
    dialog_of(s->editor)->awaited = REQUEST_SAVE_AS;
    panel_answer(s, REQUEST_SAVE_AS, false, long_message);
}

static void open_poles(struct session *s) { editor_show_subject(s->editor, true, false); }

static void open_message(struct session *s)
{
    tell(s->editor, true, "%s", long_message);
    tell_figures(s->editor, 1234, 123456);
}

#define LONG_PATH "path /home/somebody/a scene with a name that is rather too long to show.json"

static const struct screen {
    const char *name, *steps;
    void (*open)(struct session *s); ///< after the steps; NULL: that is all
    bool cut;                        ///< shows something that is too long for any place
    bool narrow, wide;               ///< in windows as narrow as they can be made; in others
} screens[] = {
    {"start", "welcome", NULL, false, true, true},
    {"drag", "pull knot(sway,1) 14 -30 3", NULL, false, false, true},
    {"pull", "pull tail(tail,0.9) 30 -20 3", NULL, false, false, true},
    {"help", "key F1", NULL, false, true, true},
    {"found keys", "key F1; type knot", NULL, false, false, true},
    {"palette", "key F3; type slope", NULL, false, true, true},
    {"few controls", "key F9", NULL, false, false, true}, // as it is at the first start
    {"open", "key Ctrl+O", NULL, false, true, true},
    {"save as", "key Ctrl+Shift+S", NULL, false, true, true},
    {"export", "key Ctrl+E", NULL, false, true, false},
    {"quit", "click preset.heavy; key Ctrl+Q", NULL, false, true, true},
    {"recover", "offer", NULL, false, true, true},
    {"save failed", "key Ctrl+Shift+S", open_failed, false, true, true},
    {"colours", "click section.feel; click color.sway", NULL, false, false, true},
    {"add menu", "key A", NULL, false, false, true},
    {"one knot", "click knot(sway,1)", open_poles, false, false, true},
    {"all knots", "click knot(sway,0); key Ctrl+A", NULL, false, false, true},
    {"history",
     "click preset.heavy; click preset.whip; key Ctrl+Z; click section.feel; click section.knot;"
     "click section.spline; click section.rigs; click section.tail; click section.history; click section.scene",
     NULL, false, false, true},
    {"message", LONG_PATH, open_message, true, true, true},
    {"overlays", "key O P N U", NULL, false, false, true},
    {"changed", "", open_changed, false, true, true},
    {"busy", LONG_PATH, open_busy, true, true, true},
};

enum { SCREENS = sizeof screens / sizeof *screens };

static int problems_of(struct session *s, const char *where, bool whole)
{
    const struct layout *layout = layout_of(s->editor);
    const struct legible_ground ground = {layout->window, layout->stage, whole};
    return legible_problems(drawn_by(s->editor), &ground, where);
}

/// Shows a screen, and the panel scrolled all the way down, page by page.
static int look_at(const char *scene, const struct screen *screen, const float size[3], bool whole)
{
    struct session s;
    char where[160];
    snprintf(where, sizeof where, "%s, %s, %gx%g at %g", screen->name, theme()->name, (double)size[0],
             (double)size[1], (double)size[2]);
    session_open(&s, scene);
    editor_resize(s.editor, size[0], size[1], size[2]);
    list_files(s.editor, &(struct editor_app){.list = list_names, .recent = list_recent});
    session_frame(&s);
    hands(&s, "%s", screen->steps);
    if (screen->open) screen->open(&s);
    session_frame(&s);
    int problems = problems_of(&s, where, whole);
    for (int page = 0; page < 8; page++) {
        sections(s.editor)->offset = 0.5f * layout_of(s.editor)->inspector.h * (float)page;
        session_frame(&s);
        problems += problems_of(&s, where, whole);
    }
    session_close(&s);
    return problems;
}

static int look_at_all(const char *scene, bool whole)
{
    static const float sizes[][3] = {{960, 600, 1},   {960, 600, 1.5f}, {960, 600, 2},     {1280, 720, 1},
                                     {1280, 720, 2},  {1920, 1080, 1},  {1707, 960, 1.5f}, {2560, 1440, 1},
                                     {3840, 2160, 1}, {1920, 1080, 2}};
    int problems = 0;
    for (int kind = 0; kind < THEME_COUNT; kind++) {
        theme_use((enum theme_kind)kind);
        for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
            if (!is_thorough() && (i + (size_t)kind) % 5 != 1) continue;
            for (int k = 0; k < SCREENS; k++)
                if (screens[k].wide) problems += look_at(scene, &screens[k], sizes[i], whole && !screens[k].cut);
        }
    }
    theme_use(THEME_DARK);
    return problems;
}

TEST(test_the_tail_on_every_screen)
{
    char *scene;
    size_t size;
    assert_done(file_read("assets/scenes/tail.json", 1 << 20, &scene, &size, &error));
    assert_int_equal(look_at_all(scene, true), 0);
    free(scene);
}

TEST(test_crowded_on_every_screen) { assert_int_equal(look_at_all(crowded, false), 0); }

/// In windows as narrow as they can be made, words may be cut short, but stay apart and inside.
TEST(test_narrow_windows)
{
    static const float sizes[][3] = {{640, 480, 1}, {560, 400, 1}, {480, 320, 1}, {390, 792, 3}, {360, 560, 2}};
    int problems = 0;
    for (int i = 0; i < 5 * SCREENS; i++) {
        const struct screen *screen = &screens[i / 5];
        if (screen->narrow) problems += look_at(crowded, screen, sizes[i % 5], false);
    }
    assert_int_equal(problems, 0);
}

// --- each panel alone -------------------------------------------------------------------------------------------------------

/// How many texts of a panel that was drawn alone are there; they are within it, also above and below, and apart.
static int count_texts(struct session *s, struct rect panel, const char *where)
{
    const struct drawlist *list = drawn_by(s->editor);
    const struct legible_ground ground = {.window = panel};
    int count = 0;
    assert_int_equal(legible_problems(list, &ground, where), 0);
    for (int i = 0; i < list->count; i++) {
        const struct draw_command *c = &list->commands[i];
        if (c->kind != DRAW_TEXT) continue;
        const float top = c->y - 0.8f * c->width, bottom = top + c->width;
        const bool scrolled = top < c->clip.y || bottom > c->clip.y + c->clip.h; // a line half out of sight
        if (!scrolled && (top < panel.y || bottom > panel.y + panel.h))
            fail_msg("%s: “%s” leaves its panel", where, list->text + c->first);
        count++;
    }
    return count;
}

static void clear(struct session *s) { drawlist_clear(drawn_by(s->editor), layout_of(s->editor)->window); }

static void check_inspector(struct session *s, int selected, int page)
{
    const struct spline *spline = active_spline(s->editor);
    if (selected && spline->knot_count > 0) selection_set(selection_of(s->editor), spline->knots[0].id, true);
    sections(s->editor)->offset = 150.0f * (float)page;
    clear(s);
    inspector_show(s->editor->inspector, false);
    assert_true(count_texts(s, layout_of(s->editor)->window, spline->name) > 15);
}

/// The figures and the scene's name may give way to a long message.
static void check_status(struct session *s)
{
    static const char *const messages[] = {"", "Saved.", long_message};
    tell_figures(s->editor, 1234, 123456);
    editor_advance(s->editor, 1);
    for (int m = 0; m < 3; m++) {
        tell(s->editor, true, "%s", messages[m]);
        clear(s);
        status_show(s->editor);
        assert_in_range(count_texts(s, layout_of(s->editor)->status, "status"), m == 2 ? 7 : 9, 9);
    }
}

static void check_dialogs(struct session *s)
{
    static const char *const open[] = {"key Ctrl+O", "key Ctrl+Shift+S", "key Right I Ctrl+Q", "offer"};
    for (int i = 0; i < 8; i++) {
        if (i % 2 == 0) hands(s, "%s", open[i / 2]);
        clear(s);
        dialogs_show(s->editor->dialogs);
        assert_true(count_texts(s, layout_of(s->editor)->window, open[i / 2]) >= 4);
        dialog_of(s->editor)->awaited = REQUEST_SAVE;
        panel_answer(s, REQUEST_SAVE, false, long_message);
        if (i % 2 == 1) hands(s, "key Escape; is asked none");
    }
}

TEST(test_no_text_leaves_its_panel_or_overlaps)
{
    static const float sizes[][2] = {{1280, 720}, {960, 600}, {2000, 1200}};
    for (int i = 0; i < 6; i++) {
        struct session s;
        panel_open(&s, i % 2 ? huge : small, sizes[i / 2][0], sizes[i / 2][1]);
        hands(&s, i % 2 ? LONG_PATH : "path x.json");
        list_files(s.editor, &(struct editor_app){.list = list_long});
        for (int n = 0; n < 6 * s.document->spline_count; n++) {
            activate(s.editor, n / 6);
            check_inspector(&s, n / 3 % 2, n % 3);
        }
        check_status(&s);
        check_dialogs(&s);
        session_close(&s);
    }
}

// --- upright windows --------------------------------------------------------------------------------------------------------

SESSION_TEST(test_in_an_upright_window_the_panels_lie_below_each_other, panel_open(s, small, 1280, 720))
{
    static const float sizes[][2] = {{360, 560}, {768, 972}, {390, 792}};
    const struct layout *l = layout_of(s->editor);
    for (int i = 0; i < 3; i++) {
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
    const float middle = l->curves.y, low = l->inspector.y;
    s->finger = true;
    session_move(s, 195, low + 6); // as near as a finger gets
    session_press(s, BUTTON_LEFT, 1);
    hands(s, "drag 0 -56; release");
    assert_near(l->inspector.y, low - 50, 2);
    session_move(s, 195, l->curves.y);
    session_press(s, BUTTON_LEFT, 1);
    session_drag(s, 0, middle - 40 - l->curves.y, 4);
    hands(s, "release; wait");
    assert_near(l->curves.y, middle - 40, 1);
    float knot[2];
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

/// A drag beside the controls scrolls the inspector. A message takes the whole of the status line: there is no room for it beside the
/// controls, until the next click.
SESSION_TEST(test_a_narrow_window, panel_open(s, small, 390, 792))
{
    session_move(s, 30, layout_of(s->editor)->inspector.y + 150);
    session_press(s, BUTTON_LEFT, 1);
    hands(s,
          "drag 0 -80; is scrolled 80; drag 0 500; is scrolled 0; release; at 30 400; is scrolled 0; is "
          "history.saved 1;"
          "shows Auto-key; tell Saved as walk.json; wait; shows Saved as walk.json; hides Auto-key;"
          "at 20 780"); // over the play button
    session_click_here(s, 1);
    hands(s, "is playing 0; shows Auto-key");
    session_click_here(s, 1);
    hands(s, "is playing 1");
}
