/// Every screen in every size, at every scale, dark and light: all text is whole, apart from other text, and can be read.
#include "base/file.h"
#include "legible.h"
#include "panel_session.h"

#define KNOTS                                                                                                        \
    "\"knots\": [{\"frame\": 0, \"value\": 0}, {\"frame\": 30, \"value\": 1, \"slope\": 1}, {\"frame\": 70, "        \
    "\"value\": -0.3}]"
#define SPLINE(name) "{\"name\": \"" name "\", \"frequency\": 1.25, \"damping\": 0.1, " KNOTS "}"

#define LONG_NAME "a spline whose name is far longer than any panel is wide"
#define SPLINES SPLINE("sway") "," SPLINE("up") "," SPLINE("ears") "," SPLINE(LONG_NAME) ","
#define MORE_SPLINES SPLINE("head") "," SPLINE("breath") "," SPLINE("left hand") "," SPLINE("tip")

/// Eight splines and three tails, some with names that fit nowhere.
static const char crowded[] =
    "{\"wiggly\": 1, \"about\": \"A title of a scene that goes on for longer than the width of a stage allows. And a "
    "text below it that would fill a page, were there one, and has to be content with a few lines at the upper "
    "left of the stage, out of the way of what stands in its middle, however small the window is made; what is left "
    "over is not shown, and nobody will miss it, since it says nothing that was not said before, at length.\", "
    "\"frames\": [0, 96], \"splines\": [" SPLINES MORE_SPLINES
    "], \"rigs\": [{\"type\": \"tail\", \"name\": \"tail\", "
    "\"channels\": [{\"spline\": \"sway\"}, {\"spline\": \"up\", \"axis\": \"up\"}]}, "
    "{\"type\": \"tail\", \"name\": \"another tail, whose name is rather long as well\", \"spline\": \"head\", "
    "\"position\": [1.2, 0.26, 0]}, {\"type\": \"tail\", \"name\": \"third\", \"spline\": \"breath\", "
    "\"position\": [-1.2, 0.26, 0]}]}";

static const char long_message[] =
    "a sentence that goes on and on about what is wrong with this file until there is no room left for it in the "
    "line, whatever the width of the window may be, even on the largest of screens, and then some more";

static int list_names(void *user, const char *folder, char names[][256], int max)
{
    (void)user;
    int count = strcmp(folder, ".") == 0 ? max < 30 ? max : 30 : 0;
    for (int i = 0; i < count; i++) snprintf(names[i], 256, i ? "scene%d.json" : "figures/", i);
    return count;
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

static void open_start(struct session *s) { welcome(s->editor); }

static void open_drag(struct session *s)
{
    session_point(s, "knot(sway,1)");
    session_press(s, BUTTON_LEFT, 1);
    session_drag(s, 14, -30, 3);
}

static void open_pull(struct session *s)
{
    session_point(s, "tail(tail,0.9)");
    session_press(s, BUTTON_LEFT, 1);
    session_drag(s, 30, -20, 3);
}

static void open_help(struct session *s) { session_key(s, KEY_F1, 0); }

static void open_found(struct session *s)
{
    session_key(s, KEY_F1, 0);
    panel_type(s, "knot");
}

static void open_palette(struct session *s)
{
    session_key(s, KEY_F3, 0);
    panel_type(s, "slope");
}

/// The inspector as it is at the first start.
static void open_few(struct session *s) { session_key(s, KEY_F9, 0); }

static void open_open(struct session *s) { session_key(s, 'O', MOD_CTRL); }

static void open_save(struct session *s) { session_key(s, 'S', MOD_CTRL | MOD_SHIFT); }

static void open_export(struct session *s) { session_key(s, 'E', MOD_CTRL); }

static void open_quit(struct session *s)
{
    panel_click(s, "preset.heavy");
    session_key(s, 'Q', MOD_CTRL);
}

static void open_recover(struct session *s)
{
    offer_recovery(s->editor, &(struct recovery_offer){"walk.json", "21 November 2026, 10:00:00", 2});
}

static void open_changed(struct session *s) { dialogs_ask_changed(s->editor->dialogs, "walk.json", true); }

/// A long name beside the figures.
static void open_busy(struct session *s)
{
    tell_figures(s->editor, 0, 8465);
    set_path(s->editor, "/home/somebody/a scene with a name that is rather too long to show.json");
}

static void open_failed(struct session *s)
{
    session_key(s, 'S', MOD_CTRL | MOD_SHIFT);
    dialog_of(s->editor)->awaited = REQUEST_SAVE_AS;
    panel_answer(s, REQUEST_SAVE_AS, false, long_message);
}

static void open_colors(struct session *s)
{
    panel_click(s, "section.feel");
    panel_click(s, "color.sway");
}

static void open_add(struct session *s) { session_key(s, 'A', 0); }

static void open_knots(struct session *s)
{
    session_click(s, "knot(sway,1)");
    unfold(s->editor, "section.poles");
}

static void open_all_knots(struct session *s)
{
    session_click(s, "knot(sway,0)");
    session_key(s, 'A', MOD_CTRL);
}

static void open_history(struct session *s)
{
    static const char *const closed[] = {"section.feel",   "section.knot", "section.splines",
                                         "section.spline", "section.rigs", "section.tail"};
    panel_click(s, "preset.heavy");
    panel_click(s, "preset.whip");
    session_key(s, 'Z', MOD_CTRL);
    for (size_t i = 0; i < sizeof closed / sizeof closed[0]; i++) panel_click(s, closed[i]);
    panel_click(s, "section.history");
    panel_click(s, "section.scene");
}

static void open_message(struct session *s)
{
    set_path(s->editor, "/home/somebody/a scene with a name that is rather too long to show.json");
    tell(s->editor, true, "%s", long_message);
    tell_figures(s->editor, 1234, 123456);
}

static void open_overlays(struct session *s)
{
    session_key(s, 'O', 0);
    session_key(s, 'P', 0);
    session_key(s, 'N', 0);
    session_key(s, 'U', 0);
}

static const struct screen {
    const char *name;
    void (*open)(struct session *s);
    bool cut; ///< shows something that is too long for any place
} screens[] = {
    {"start", open_start, false},         {"drag", open_drag, false},        {"pull", open_pull, false},
    {"help", open_help, false},           {"found keys", open_found, false}, {"palette", open_palette, false},
    {"few controls", open_few, false},    {"open", open_open, false},        {"save as", open_save, false},
    {"quit", open_quit, false},           {"recover", open_recover, false},  {"save failed", open_failed, false},
    {"colours", open_colors, false},      {"add menu", open_add, false},     {"one knot", open_knots, false},
    {"all knots", open_all_knots, false}, {"history", open_history, false},  {"message", open_message, true},
    {"overlays", open_overlays, false},   {"changed", open_changed, false},  {"busy", open_busy, true},
};

// --- the walk -----------------------------------------------------------------------------------------------------------

static int problems_of(struct session *s, const char *where, bool whole)
{
    const struct layout *layout = layout_of(s->editor);
    struct legible_ground ground = {layout->window, layout->stage, whole};
    return legible_problems(drawn_by(s->editor), &ground, where);
}

/// The panel scrolled all the way down, page by page.
static int walk_inspector(struct session *s, const char *where, bool whole)
{
    struct ui_list *scroll = sections(s->editor);
    int problems = 0;
    for (int page = 0; page < 8; page++) {
        scroll->offset = 0.5f * layout_of(s->editor)->inspector.h * (float)page;
        session_frame(s);
        problems += problems_of(s, where, whole);
    }
    return problems;
}

static int walk(const char *scene, const struct screen *screen, const float size[3], bool whole)
{
    struct session s;
    char where[160];
    snprintf(where, sizeof where, "%s, %s, %gx%g at %g", screen->name, theme()->name, (double)size[0],
             (double)size[1], (double)size[2]);
    session_open(&s, scene);
    editor_resize(s.editor, size[0], size[1], size[2]);
    list_files(s.editor, &(struct editor_app){.list = list_names, .recent = list_recent});
    session_frame(&s);
    screen->open(&s);
    session_frame(&s);
    int problems = problems_of(&s, where, whole) + walk_inspector(&s, where, whole);
    session_close(&s);
    return problems;
}

static int walk_all(const char *scene, bool whole)
{
    static const float sizes[][3] = {{960, 600, 1},   {960, 600, 1.5f}, {960, 600, 2},     {1280, 720, 1},
                                     {1280, 720, 2},  {1920, 1080, 1},  {1707, 960, 1.5f}, {2560, 1440, 1},
                                     {3840, 2160, 1}, {1920, 1080, 2}};
    int problems = 0;
    for (int kind = 0; kind < THEME_COUNT; kind++) {
        theme_use((enum theme_kind)kind);
        for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
            if (!is_thorough() && (i + (size_t)kind) % 5 != 1) continue;
            for (size_t k = 0; k < sizeof screens / sizeof *screens; k++) {
                problems += walk(scene, &screens[k], sizes[i], whole && !screens[k].cut);
            }
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
    assert_int_equal(walk_all(scene, true), 0);
    free(scene);
}

/// In windows as narrow as they can be made, words may be cut short, but stay apart and inside.
TEST(test_narrow_windows)
{
    static const float sizes[][3] = {{640, 480, 1}, {560, 400, 1}, {480, 320, 1}, {390, 792, 3}, {360, 560, 2}};
    static const struct screen narrow[] = {
        {"start", open_start, true},     {"help", open_help, true},       {"open", open_open, true},
        {"save as", open_save, true},    {"quit", open_quit, true},       {"save failed", open_failed, true},
        {"changed", open_changed, true}, {"recover", open_recover, true}, {"message", open_message, true},
        {"busy", open_busy, true},       {"palette", open_palette, true}, {"export", open_export, true},
    };
    int problems = 0;
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        for (size_t k = 0; k < sizeof narrow / sizeof *narrow; k++)
            problems += walk(crowded, &narrow[k], sizes[i], false);
    }
    assert_int_equal(problems, 0);
}

TEST(test_crowded_on_every_screen) { assert_int_equal(walk_all(crowded, false), 0); }
