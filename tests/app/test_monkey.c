/// A monkey at the whole app: random events through its own queue, figures and documents included, and after each frame
/// everything that must hold whatever was done.
///
///     MONKEY_SEED=7 MONKEY_EVENTS=1000000 build/tests/app test_monkey    runs one seed, as long as wanted
///     MONKEY_RECORD=/tmp/m.replay …                                  writes down what it does
#include "beast.h"
#include "blind.h"
#include "invariants.h"
#include "puppet.h"
#include "questions.h"

#include "app/personal.h"
#include <dirent.h>
#include <sys/stat.h>
#include <unistd.h>

enum {
    SEEDS = 8,
    EVENTS = 12500,
    RELOAD_EVERY = 64,
    UNDO_EVERY = 3000,
    RESCUE_EVERY = 32,
    FOCUS_EVERY = 20,
    LOST_EVERY = 100,
    MOST_SAMPLES = 20000,
    LONG_PART = 20
};

// --- its actions, from a seed: keys, chords, drags, typing, files. It aims at things on the screen, because random clicks mostly do nothing.
// Its files are in the working folder.

/// Files that the monkey opens or tries to open.
struct monkey_files {
    const char *good[16], *bad[256];
    int good_count, bad_count;
};

struct monkey {
    struct blind *blind;
    const struct monkey_files *files;
    uint64_t random; ///< state of the generator, not 0
    float x, y;      ///< pointer
    unsigned mods;   ///< held while the pointer moves
    int sent;        ///< events
};

/// The next number of an xorshift generator, below `end`.
static int below(struct monkey *m, int end)
{
    m->random ^= m->random << 13;
    m->random ^= m->random >> 7;
    m->random ^= m->random << 17;
    return (int)((m->random >> 16) % (uint64_t)end);
}

static bool one_in(struct monkey *m, int many) { return below(m, many) == 0; }

static void monkey_send(struct monkey *m, struct event event)
{
    m->sent++;
    blind_send(m->blind, event);
}

static void monkey_key(struct monkey *m, int key, unsigned mods)
{
    monkey_send(m, (struct event){.kind = EVENT_KEY, .key = key, .action = ACTION_PRESS, .mods = mods});
    if (one_in(m, 8)) return; // held until a later action
    monkey_send(m, (struct event){.kind = EVENT_KEY, .key = key, .action = ACTION_RELEASE, .mods = mods});
}

static void monkey_type(struct monkey *m, const char *text)
{
    for (; *text; text++) monkey_send(m, (struct event){.kind = EVENT_TEXT, .codepoint = (unsigned char)*text});
}

static void monkey_move(struct monkey *m, float x, float y)
{
    m->x = x;
    m->y = y;
    monkey_send(m, (struct event){.kind = EVENT_POINTER, .x = x, .y = y, .mods = m->mods});
}

static void monkey_button(struct monkey *m, enum event_button button, enum event_action action, int clicks)
{
    monkey_send(m, (struct event){.kind = EVENT_BUTTON,
                                  .button = button,
                                  .action = action,
                                  .clicks = clicks,
                                  .x = m->x,
                                  .y = m->y,
                                  .mods = m->mods});
}

/// The screen position of a knot, a handle, a tail …; false if there is none of that kind.
static bool find_thing(struct monkey *m, float *x, float *y)
{
    struct app *app = &m->blind->app;
    const struct document *d = app->work.document;
    const struct spline *spline = active_spline(app->work.editor);
    const int tails = document_count_rigs(d, RIG_TAIL);
    const char *tail = tails > 0 ? d->rigs[document_find_rig(d, RIG_TAIL, below(m, tails))]->name : NULL;
    char target[512] = "";
    int which = below(m, 9);
    if (document_find_rig(d, RIG_MODEL, 0) >= 0 && one_in(m, 2)) {
        static const char *const bones[] = {"tail_1", "tail_5", "ear_L_1", "ear_R_1", "head", "leg_FL_1"};
        snprintf(target, sizeof target, "bone(%s)", bones[below(m, 6)]);
        return editor_target(app->work.editor, target, x, y, NULL);
    }
    if (which < 3 && spline && spline->knot_count > 0) {
        const int knot = below(m, spline->knot_count);
        snprintf(target, sizeof target, "knot(%.200s,%d)", spline->name, knot);
        if (which == 0)
            snprintf(target, sizeof target, "handle(%.200s,%d,%d)", spline->name, knot, 2 * below(m, 2) - 1);
    } else if (which < 6 && tail) {
        snprintf(target, sizeof target, "tail(%.200s,%g)", tail, below(m, 100) / 100.0);
        if (which == 3) snprintf(target, sizeof target, "body(%.200s)", tail);
    } else if (which == 6) {
        snprintf(target, sizeof target, "warning(0)");
    } else if (which == 7) {
        snprintf(target, sizeof target, "divider(%s)", one_in(m, 2) ? "stage" : "inspector");
    } else {
        snprintf(target, sizeof target, "ruler(%d)", d->first_frame + below(m, d->last_frame - d->first_frame + 1));
    }
    return editor_target(app->work.editor, target, x, y, NULL);
}

/// A widget of the inspector or the open dialog.
static bool find_widget(struct monkey *m, float *x, float *y)
{
    const struct editor *editor = m->blind->app.work.editor;
    const struct ui *ui = asked(editor) != DIALOG_NONE ? &dialog_of(editor)->ui : inspector_of(editor);
    if (ui->stop_count == 0) return false;
    const struct rect r = ui->stop[below(m, ui->stop_count)].rect;
    *x = r.x + r.w * (float)below(m, 101) / 100;
    *y = r.y + r.h * (float)below(m, 101) / 100;
    return true;
}

static void monkey_point(struct monkey *m)
{
    const struct rect window = layout_of(m->blind->app.work.editor)->window;
    float x = window.w * (float)(below(m, 1100) - 50) / 1000, y = window.h * (float)(below(m, 1100) - 50) / 1000;
    const int what = below(m, 5);
    if (what < 2) find_thing(m, &x, &y);
    if (what == 2 || what == 3) find_widget(m, &x, &y);
    monkey_move(m, x, y);
}

static unsigned any_mods(struct monkey *m)
{
    static const unsigned mods[] = {MOD_SHIFT,           MOD_CTRL,          MOD_ALT, MOD_CTRL | MOD_SHIFT, MOD_SUPER,
                                    MOD_ALT | MOD_SHIFT, MOD_ALT | MOD_CTRL};
    const int n = below(m, 12); // none for five of twelve
    return n < 5 ? 0 : mods[n - 5];
}

static void any_key(struct monkey *m)
{
    int key = one_in(m, 2) ? ' ' + below(m, 'Z' - ' ' + 1) : KEY_ESCAPE + below(m, KEY_COUNT - KEY_ESCAPE);
    if (key == KEY_F12) return; // there is no picture to save
    if (one_in(m, 4)) {
        monkey_send(m, (struct event){.kind = EVENT_KEY, .key = key, .action = (enum event_action)below(m, 3)});
    } else {
        monkey_key(m, key, any_mods(m));
    }
}

/// Keys that edit curves.
static void edit_key(struct monkey *m)
{
    static const int keys[] = {'I', 'I', 'I', 'T', 'M',        'V', 'S', 'X', 'Y',
                               'R', 'P', 'D', 'E', KEY_DELETE, 'N', 'U', 'K', 'J'};
    static const int held[] = {'F', 'Z', 'B', 'C', 'L', 'K'};
    if (one_in(m, 4)) {
        const int letter = held[below(m, 6)];
        monkey_send(m, (struct event){.kind = EVENT_KEY, .key = letter, .action = ACTION_PRESS});
        for (int i = below(m, 6); i > 0; i--) monkey_key(m, one_in(m, 2) ? KEY_UP : KEY_DOWN, 0);
        monkey_send(m, (struct event){.kind = EVENT_KEY, .key = letter, .action = ACTION_RELEASE});
    } else if (one_in(m, 3)) {
        monkey_key(m, KEY_RIGHT + below(m, 4), any_mods(m) | MOD_ALT);
    } else {
        monkey_key(m, keys[below(m, sizeof keys / sizeof keys[0])], one_in(m, 4) ? any_mods(m) : 0);
    }
}

static void click(struct monkey *m)
{
    const enum event_button button = one_in(m, 6) ? (enum event_button)below(m, 3) : BUTTON_LEFT;
    if (!one_in(m, 4)) monkey_point(m);
    m->mods = one_in(m, 3) ? any_mods(m) : 0;
    monkey_button(m, button, ACTION_PRESS, 1 + one_in(m, 4));
    if (!one_in(m, 10)) monkey_button(m, button, ACTION_RELEASE, 1);
}

/// A press, a path in small or large steps, perhaps keys on the way, and usually a release.
static void drag(struct monkey *m)
{
    const enum event_button button = one_in(m, 5) ? (enum event_button)below(m, 3) : BUTTON_LEFT;
    const int reach = one_in(m, 3) ? 200 : 20;
    monkey_point(m);
    m->mods = one_in(m, 3) ? any_mods(m) : 0;
    monkey_button(m, button, ACTION_PRESS, 1);
    for (int i = 1 + below(m, 8); i > 0; i--) {
        monkey_move(m, m->x + (float)(below(m, 2 * reach + 1) - reach),
                    m->y + (float)(below(m, 2 * reach + 1) - reach));
        if (one_in(m, 12)) edit_key(m);
        if (one_in(m, 40)) any_key(m);
    }
    if (!one_in(m, 15)) monkey_button(m, button, ACTION_RELEASE, 1);
}

/// Types numbers and nonsense. No slash, so that saving stays in the working folder.
static void type(struct monkey *m)
{
    static const char *const texts[] = {
        "1e308", "-1e308", "1e-308", "999999999999", "2147483648", "1/0", "12*(3+4)", "",      "0",   "1",
        "2.5",   "-3",     "1e9",    "-1e-9",        "nan",        "inf", "12",       "48",    "120", "0.05",
        "24",    "tail",   "sway",   "#ff8800",      "a name",     "\"",  "\\",       "1e400", "1,5", "-"};
    if (one_in(m, 3)) monkey_key(m, 'A', MOD_CTRL);
    if (one_in(m, 5)) {
        uint32_t codepoint = (uint32_t)below(m, 0x30000);
        if (codepoint != '/') monkey_send(m, (struct event){.kind = EVENT_TEXT, .codepoint = codepoint});
    } else {
        monkey_type(m, texts[below(m, sizeof texts / sizeof texts[0])]);
    }
    if (!one_in(m, 4)) monkey_key(m, KEY_ENTER, 0);
}

/// Types a number, most likely an invalid one, into a visible field.
static void field(struct monkey *m)
{
    float x, y;
    if (!find_widget(m, &x, &y)) return;
    monkey_move(m, x, y);
    monkey_button(m, BUTTON_LEFT, ACTION_PRESS, 2);
    monkey_button(m, BUTTON_LEFT, ACTION_RELEASE, 1);
    monkey_key(m, 'A', MOD_CTRL);
    type(m);
}

/// Adds and removes rigs, switches theme and scale.
static void rig(struct monkey *m)
{
    static const int keys[] = {KEY_DOWN, KEY_DOWN, KEY_UP, KEY_ENTER, KEY_ENTER, KEY_TAB};
    const int what = below(m, 4);
    if (what == 0) {
        monkey_key(m, KEY_DELETE, MOD_SHIFT);
    } else if (what == 1) {
        static const int settings[] = {KEY_F10, KEY_F8};
        monkey_key(m, settings[below(m, 2)], one_in(m, 2) ? MOD_SHIFT : 0);
    } else {
        monkey_key(m, 'A', 0);
        for (int i = below(m, 6); i > 0; i--) monkey_key(m, keys[below(m, 6)], 0);
        if (one_in(m, 3)) monkey_type(m, m->files->good[below(m, m->files->good_count)]); // no slash
        monkey_key(m, KEY_ENTER, 0);
    }
}

/// Exports in the background, in any format.
static void export(struct monkey *m)
{
    static const char *const names[] = {"x.glb", "x.usda", "x.bvh", "x.csv", "x.npy", "x.xyz", "nowhere/x.glb"};
    monkey_key(m, 'E', MOD_CTRL);
    monkey_key(m, 'A', MOD_CTRL);
    monkey_type(m, names[below(m, sizeof names / sizeof names[0])]);
    monkey_key(m, one_in(m, 4) ? KEY_ENTER : KEY_ESCAPE, 0); // else most of its time is spent on writing files
}

static void wheel(struct monkey *m)
{
    if (one_in(m, 2)) monkey_point(m);
    monkey_send(m, (struct event){.kind = EVENT_WHEEL,
                                  .dx = (float)(below(m, 5) - 2),
                                  .dy = (float)(below(m, 9) - 4),
                                  .x = m->x,
                                  .y = m->y,
                                  .mods = any_mods(m)});
}

static void play(struct monkey *m)
{
    static const int keys[] = {KEY_SPACE, KEY_SPACE, KEY_LEFT, KEY_RIGHT, KEY_HOME, KEY_END};
    static const char *const typed[] = {"[", "]", "-", "+", "=", ",", ".", "<", ">"};
    if (one_in(m, 2)) monkey_type(m, typed[below(m, sizeof typed / sizeof typed[0])]);
    monkey_key(m, keys[below(m, sizeof keys / sizeof keys[0])], one_in(m, 4) ? MOD_SHIFT : 0);
}

static void clipboard(struct monkey *m)
{
    static const char *const texts[] = {"0,0.5\n2,-1,3\n7,1e9\n",
                                        "[{\"frame\": 3, \"value\": 1}, {\"frame\": 9, \"value\": 2, \"slope\": 1}]",
                                        "[{\"frame\": 3, \"value\": 1}, {\"frame\": 3, \"value\": 2}]",
                                        "frame;value\n1;2,5\n4;3,5\n",
                                        "[{\"frame\": 1e300, \"value\": 1}]",
                                        "hello",
                                        "\n\n",
                                        "{\"knots\": [{\"frame\": 0, \"value\": -1}]}",
                                        "[1, [2, [3"};
    if (one_in(m, 3)) platform_set_clipboard(m->blind->app.platform, texts[below(m, sizeof texts / sizeof texts[0])]);
    static const int keys[] = {'A', 'C', 'X', 'V', 'V', 'D'};
    monkey_key(m, keys[below(m, 6)], MOD_CTRL);
}

static void window(struct monkey *m)
{
    static const float scales[] = {1, 1.5f, 2};
    const int what = below(m, 4);
    if (what == 0) {
        monkey_send(m, (struct event){.kind = EVENT_SIZE,
                                      .x = (float)(100 + below(m, 2000)),
                                      .y = (float)(100 + below(m, 1200)),
                                      .scale = scales[below(m, 3)]});
    } else if (what == 1) {
        monkey_send(m, (struct event){.kind = EVENT_SIZE, .x = 1280, .y = 720, .scale = 1});
    } else {
        monkey_send(m, (struct event){.kind = what == 2 ? EVENT_CLOSE : EVENT_EXPOSE});
    }
}

static const char *any_file(struct monkey *m)
{
    const struct monkey_files *files = m->files;
    return one_in(m, 3) ? files->bad[below(m, files->bad_count)] : files->good[below(m, files->good_count)];
}

/// Opens and saves documents and figures, and answers the question about unsaved work.
static void document(struct monkey *m)
{
    static const char *const names[] = {"new.json", "a.json", "b.json", "sub/c.json", "nowhere/d.json", "sub", ""};
    switch (below(m, 8)) {
    case 0:
        m->sent++;
        blind_drop(m->blind, any_file(m));
        break;
    case 1:
        monkey_key(m, 'N', MOD_CTRL);
        break;
    case 2:
        monkey_key(m, 'O', MOD_CTRL);
        monkey_key(m, 'D', 0); // discards unsaved work
        if (one_in(m, 3)) {    // a recent file
            for (int i = 1 + below(m, 4); i > 0; i--) monkey_key(m, KEY_DOWN, 0);
            monkey_key(m, KEY_ENTER, 0);
            return;
        }
        monkey_key(m, 'A', MOD_CTRL);
        monkey_type(m, any_file(m));
        monkey_key(m, KEY_ENTER, 0);
        return;
    case 3:
        monkey_key(m, 'S', MOD_CTRL | MOD_SHIFT);
        monkey_key(m, 'A', MOD_CTRL);
        monkey_type(m, names[below(m, sizeof names / sizeof names[0])]);
        monkey_key(m, KEY_ENTER, 0);
        if (one_in(m, 2)) monkey_key(m, KEY_ENTER, 0);
        return;
    case 4:
        monkey_key(m, 'S', MOD_CTRL);
        return;
    default:
        monkey_key(m, '1' + below(m, one_in(m, 3) ? 7 : 4), MOD_CTRL); // most often one that is quick to show
        return;
    }
    if (one_in(m, 2)) monkey_key(m, 'D', 0);
}

/// Overwrites a file with `text` or another file's content, only in the working folder.
static void overwrite(const char *path, const char *text, const char *from)
{
    char folder[4096];
    const bool inside =
        path[0] != '/' || (getcwd(folder, sizeof folder) && strncmp(path, folder, strlen(folder)) == 0);
    FILE *source = inside && from ? fopen(from, "r") : NULL, *file = inside ? fopen(path, "w") : NULL;
    if (file && text) fputs(text, file);
    for (int c; file && source && (c = fgetc(source)) != EOF;) fputc(c, file);
    if (source) fclose(source);
    if (file) fclose(file);
}

/// Another program or window writes the scene's file or the settings; then the window gets the focus and the question an answer.
static void another(struct monkey *m)
{
    static const char *const settings[] = {"{\"theme\": \"light\", \"ui_scale\": 1.5}",
                                           "{\"theme\" \"dark\", \"ui_scale\": 1e999}", "",
                                           "recent = a.json\nrecent = /nowhere\nrecent = \nstage_share = -5\n"};
    static const int answers[] = {'K', 'T', 'S', KEY_ESCAPE, KEY_ENTER};
    const char *path = app_path(&m->blind->app);
    if (one_in(m, 3)) {
        overwrite("wiggly/settings", settings[below(m, 4)], NULL);
    } else if (path[0]) {
        overwrite(path, NULL, any_file(m));
    }
    monkey_send(m, (struct event){.kind = EVENT_FOCUS});
    if (one_in(m, 2)) monkey_key(m, 'S', MOD_CTRL);
    monkey_key(m, answers[below(m, 5)], 0);
}

/// Queues the monkey's next action.
static void monkey_act(struct monkey *m)
{
    static const struct habit {
        void (*act)(struct monkey *m);
        int weight;
    } habits[] = {{click, 48},   {drag, 36}, {monkey_point, 10}, {any_key, 24}, {edit_key, 36},
                  {type, 16},    {wheel, 8}, {clipboard, 12},    {play, 7},     {window, 2},
                  {document, 1}, {field, 8}, {rig, 3},           {export, 1},   {another, 1}};
    int left = below(m, 213);
    const struct habit *habit = habits;
    while (left >= habit->weight) left -= habit++->weight;
    habit->act(m);
}

// --- its files

static char folder[] = "/tmp/wiggly-monkey-XXXXXX", home[4096];
static struct monkey_files files;
static char bad[256][512];

/// A character in two coordinates, an imported one with a chain in its tail, and a scene that is long enough to be solved in the background,
/// and not too long for keep_small().
static const char *const scenes[][2] = {
    {"puppet.json",
     "{\"wiggly\": 1, \"frames\": [0, 48], \"splines\": [{\"name\": \"s\", \"frequency\": 1, \"knots\": "
     "[{\"frame\": 0, \"value\": 1}, {\"frame\": 20, \"value\": -1}]}], \"rigs\": [{\"type\": \"character\", "
     "\"model\": \"puppet.glb\", \"coordinates\": [{\"name\": \"a\", \"spline\": \"s\"}]}, "
     "{\"type\": \"tail\", \"name\": \"t\", \"spline\": \"s\"}]}"},
    {"beast.json",
     "{\"wiggly\": 1, \"frames\": [0, 48], \"splines\": [{\"name\": \"wag\", \"frequency\": 1, \"knots\": "
     "[{\"frame\": 0, \"value\": 1}]}], \"rigs\": [{\"type\": \"model\", \"name\": \"beast\", \"model\": "
     "\"beast.glb\", \"clip\": \"Walk\", \"coordinates\": [{\"name\": \"belly\", \"spline\": \"wag\"}]}, {\"type\": "
     "\"chain\", \"name\": \"tail\", \"model\": \"beast\", "
     "\"from\": \"tail_1\", \"to\": \"tail_8\", \"channels\": [{\"spline\": \"wag\", \"axis\": \"side\", "
     "\"gain\": {\"ramp\": [[0, 4], [0.5, 9], [1, 12]]}}]}]}"},
    {"long.json", "{\"wiggly\": 1, \"frames\": [0, 3000], \"splines\": [{\"name\": \"s\", \"start\": \"loop\", "
                  "\"frequency\": 1, \"knots\": [{\"frame\": 0, \"value\": 1}, {\"frame\": 20, \"value\": -1}]}], "
                  "\"rigs\": [{\"type\": \"tail\", \"name\": \"t\", \"spline\": \"s\"}]}"},
};

static void run(const char *format, const char *what)
{
    char command[3 * 4096];
    snprintf(command, sizeof command, format, home, what, what); // NOLINT
    if (system(command) != 0) fail_msg("%s", command);
}

/// A scene as it was before any monkey wrote over it.
static void restore(const char *name)
{
    for (int i = 0; i < 3; i++) {
        const char *text = strcmp(name, scenes[i][0]) == 0 ? scenes[i][1] : NULL;
        if (text) assert_done(file_write_atomic(name, text, strlen(text), &error));
        if (text) return;
    }
    run("cp '%s/assets/scenes/%s' '%s'", name);
}

static int make_files(void **state)
{
    static const char *const good[] = {"tail.json",  "follow.json", "figure3.json", "puppet.json",
                                       "beast.json", "long.json",   "beast.glb"};
    struct character character = puppet_character(0.2f, 2);
    struct dirent **entries;
    (void)state;
    if (!getcwd(home, sizeof home) || !mkdtemp(folder) || chdir(folder) != 0 || mkdir("sub", 0700) != 0) return -1;
    for (int i = 0; i < character.vertex_count; i++) character.coordinates[0].re[i][1] = 0.2f;
    assert_done(character_write("puppet.glb", &character, true, &error));
    character_free(&character);
    assert_true(beast_write_as("beast.glb", true));
    for (int i = 0; i < 7; i++) {
        if (i < 6) restore(good[i]);
        files.good[files.good_count++] = good[i];
    }
    blind_home(folder); // settings, recent files and recovery
    run("cp -r '%s/tests/bad' bad",
        ""); // as the monkey saves beside what it opens; sorted, so that a seed says which it opens
    const int count = scandir("bad", &entries, NULL, alphasort);
    assert_in_range(count, 3, 250);
    for (int i = 0; i < count; i++) {
        snprintf(bad[i], sizeof bad[i], "%s/bad/%s", folder, entries[i]->d_name);
        files.bad[files.bad_count++] = bad[i];
        free(entries[i]);
    }
    free(entries);
    files.bad[files.bad_count++] = "not there.json";
    return 0;
}

static int remove_files(void **state)
{
    (void)state;
    snprintf(home, sizeof home, "%s", folder);
    if (chdir("/") != 0) return -1;
    run("rm -rf %s", "");
    return 0;
}

// --- what must hold

/// The document as it was put on the table.
struct origin {
    unsigned serial;
    char *text, *folder;
};

static void remember(struct origin *origin, const struct document *document)
{
    free(origin->text);
    free(origin->folder);
    origin->serial = document->serial;
    origin->text = text_of_document(document);
    origin->folder = strdup(document->folder ? document->folder : "");
}

/// Notices a document that was put on the table: it has no history. (A figure is a step of the one before.) One that was saved
/// elsewhere calls its characters' files by other names.
static void watch_origin(struct origin *origin, const struct app *app)
{
    const struct document *d = app->work.document;
    bool fresh = history_count(app->work.history) == 0 && d->serial != origin->serial;
    bool moved = d->serial == origin->serial && strcmp(origin->folder, d->folder ? d->folder : "") != 0;
    if (!origin->text || fresh) remember(origin, d);
    if (moved) origin->serial = 0;
}

static void assert_curves_are_finite(const struct app *app)
{
    const struct evaluation *e = &app->work.evaluation;
    for (int s = 0; s < e->count; s++) {
        for (int i = 0; i < e->samples; i++) {
            if (!isfinite(e->curves[s].total[i])) fail_msg("spline %d is not finite at sample %d", s, i);
        }
    }
}

/// A step is open only while something is dragged. Knots of the active spline alone are selected, and of those that were removed
/// only such as undo can bring back: no knot to come is.
static void assert_editor(const struct app *app)
{
    struct editor *editor = app->work.editor;
    const struct document *d = app->work.document;
    bool dragging = is_dragging(editor) || inspector_is_dragging(editor->inspector);
    const struct ui *ui = inspector_of(editor);
    if (history_is_open(app->work.history) && !dragging) {
        fail_msg("a step is open, and nothing is dragged: %d %d, %x %d, dialog %d", is_dragging(editor),
                 editor->core.input.drag.moved, ui->held, ui->moved, asked(editor));
    }
    if (d->spline_count == 0) assert_int_equal(active(editor), -1);
    if (d->spline_count > 0) assert_in_range(active(editor), 0, d->spline_count - 1);
    if (active(editor) >= 0) assert_int_equal(d->splines[active(editor)]->id, editor->core.focus.active_id);
    for (unsigned id = d->next_id; id < editor->core.focus.selection.capacity; id++) {
        assert_false(selection_has(selection_of(editor), id));
    }
    assert_in_range(playback_of(editor)->position, 0, document_samples(d) - 1);
}

/// Lets go of everything.
static void hands_off(struct monkey *m)
{
    m->mods = 0;
    for (int i = 0; i < 6; i++) {
        blind_send_key(m->blind, KEY_ESCAPE, 0);
        for (int b = 0; b < 3; b++) monkey_button(m, (enum event_button)b, ACTION_RELEASE, 1);
        blind_frame(m->blind);
    }
    assert_false(history_is_open(m->blind->app.work.history));
}

/// Undoing everything gives the first document byte by byte, doing it all again the last one.
static void assert_undone(struct monkey *m, struct origin *origin)
{
    struct app *app = &m->blind->app;
    hands_off(m);
    watch_origin(origin, app);
    const size_t all = history_count(app->work.history), done = history_done(app->work.history);
    undo_to(app->work.editor, all);
    char *last = text_of_document(app->work.document);
    undo_to(app->work.editor, 0);
    blind_frame(m->blind);
    if (history_dropped(app->work.history) > 0 || app->work.document->serial != origin->serial)
        remember(origin, app->work.document);
    assert_prints(app->work.document, origin->text);
    undo_to(app->work.editor, all);
    blind_frame(m->blind);
    assert_prints(app->work.document, last);
    undo_to(app->work.editor, done);
    free(last);
}

/// With absolute paths, wherever the document is from.
static char *printed_anywhere(const struct document *document)
{
    size_t size;
    return scene_print(document, "/", NULL, &size);
}

/// As when the display is lost: the work is in a recovery file, and that gives the document.
static void assert_rescued(struct app *app)
{
    if (history_is_saved(app->work.history)) return;
    const char *path = personal_rescue(app);
    assert_non_null(path);
    struct document *rescued = document_of_file(path);
    char *own = printed_anywhere(app->work.document), *again = printed_anywhere(rescued);
    assert_string_equal(again, own);
    document_destroy(rescued);
    free(again);
    free(own);
}

/// What takes long to solve is undone: the monkey has no patience.
static void keep_small(struct app *app)
{
    while (document_samples(app->work.document) * (app->work.document->spline_count + 1) > MOST_SAMPLES) {
        undo(app->work.editor);
        if (!history_label(app->work.history, history_done(app->work.history))) return;
    }
}

static int number(const char *name, int fallback)
{
    const char *text = getenv(name);
    return text ? atoi(text) : fallback;
}

static int event_count(void) { return number("MONKEY_EVENTS", quick_or_all(EVENTS / 4, EVENTS)); }

/// A monkey and what is known of its document.
struct run {
    struct blind blind;
    struct monkey monkey;
    struct origin origin;
    uint64_t checked; ///< revision
    int next_undo, frame;
};

static void forget_origin(struct origin *origin)
{
    free(origin->text);
    free(origin->folder);
    *origin = (struct origin){0};
}

/// A frame of what a monkey does, and all that must hold after it.
static void step(struct run *run)
{
    struct monkey *m = &run->monkey;
    struct app *app = &run->blind.app;
    watch_origin(&run->origin, app);
    for (int i = one_in(m, 4) ? below(m, 4) : 0; i >= 0; i--) monkey_act(m); // mostly each in its own frame
    blind_frame(m->blind);
    watch_origin(&run->origin, app);
    if (!history_is_open(app->work.history)) keep_small(app);
    assert_editor(app);
    assert_ids(app->work.editor);
    const int frame = run->frame++;
    if (history_revision(app->work.history) == run->checked) return;
    run->checked = history_revision(app->work.history);
    assert_invariants(app->work.document);
    if (app->row.splines_solved > 0) assert_curves_are_finite(app);
    if (frame % RELOAD_EVERY == 0) assert_loads_again(app->work.document);
    if (frame % RESCUE_EVERY == 0) assert_rescued(app);
    if (m->sent < run->next_undo) return;
    run->next_undo += UNDO_EVERY;
    assert_undone(m, &run->origin);
}

static const struct monkey *playing; ///< for what is said of a crash

static void say_where(void)
{
    if (playing) fprintf(stderr, "monkey: after %d events, in frame %ld\n", playing->sent, playing->blind->app.frame);
}

/// Writes all events to a file as a replay, from here on.
static void record(struct app *app, const char *path)
{
    struct replay_header header = {
        .width = 1280, .height = 720, .scale = 1, .scene_hash = scene_hash(app->work.document)};
    assert_done(app->recording = recording_open(path, &header, &error));
}

static struct run *new_run(int seed, const char *scene)
{
    struct run *run = calloc(1, sizeof *run);
    assert_non_null(run);
    blind_arrive(&run->blind, scene);
    run->monkey =
        (struct monkey){.blind = &run->blind, .files = &files, .random = (uint64_t)seed * 0x9E3779B97F4A7C15u};
    run->next_undo = UNDO_EVERY;
    return run;
}

/// Ends the app; `lost`: as when it could not decide, so that its unsaved work stays.
static void end(struct run *run, bool lost)
{
    forget_origin(&run->origin);
    blind_leave(&run->blind, lost);
}

static void run_seed(int seed, int events, const char *scene)
{
    struct run *run = new_run(seed, scene);
    fprintf(stderr, "monkey: MONKEY_SEED=%d\n", seed);
    playing = &run->monkey;
    const char *path = getenv("MONKEY_RECORD");
    if (path) record(&run->blind.app, path);
    while (run->monkey.sent < events) step(run);
    assert_undone(&run->monkey, &run->origin);
    recording_close(run->blind.app.recording, run->blind.app.frame, NULL);
    playing = NULL;
    end(run, false);
    free(run);
}

TEST(nothing_a_monkey_does_breaks_anything)
{
    const int seed = number("MONKEY_SEED", 0), events = event_count();
    atexit(say_where);
    for (int s = 1; s <= SEEDS; s++) {
        if (seed == 0 || seed == s) run_seed(s, events, NULL);
    }
    if (seed > SEEDS) run_seed(seed, events, NULL);
}

TEST(nor_in_a_long_scene)
{
    restore("long.json"); // the other monkey may have written something else over it
    run_seed(number("MONKEY_SEED", 1), event_count() / LONG_PART, "long.json");
}

/// The display is lost, and the app is started again: it offers what was not saved, and nothing else, while the other one runs.
static void lose_display(struct run *run)
{
    struct app *app = &run->blind.app;
    const bool unsaved = !history_is_saved(app->work.history);
    if (unsaved && !personal_rescue(app)) fail_msg("the work is lost");
    char *lost = printed_anywhere(app->work.document);
    end(run, true);
    blind_arrive(&run->blind, NULL);
    run->checked = 0;
    const bool offered = asked(app->work.editor) == DIALOG_RECOVER;
    assert_int_equal(offered, unsaved);
    const bool recover = !one_in(&run->monkey, 4);
    if (offered) monkey_key(&run->monkey, recover ? 'R' : 'D', 0);
    blind_frame(&run->blind);
    if (offered && recover) {
        char *again = printed_anywhere(app->work.document);
        assert_string_equal(again, lost);
        assert_false(history_is_saved(app->work.history));
        free(again);
    }
    free(lost);
}

/// Two windows on the same files, settings and recovery files, one of which has the focus, and either loses its display now and then.
TEST(nor_do_two_with_the_same_files)
{
    const int seed = number("MONKEY_SEED", 1), events = event_count();
    restore("tail.json");
    struct run *runs[] = {new_run(seed, NULL), new_run(seed + 1, "tail.json")};
    fprintf(stderr, "monkeys: MONKEY_SEED=%d\n", seed);
    struct run *run = runs[0];
    while (runs[0]->monkey.sent + runs[1]->monkey.sent < events) {
        playing = &run->monkey;
        step(run);
        if (one_in(&run->monkey, LOST_EVERY)) lose_display(run);
        if (!one_in(&run->monkey, FOCUS_EVERY)) continue;
        run = runs[run == runs[0]];
        monkey_send(&run->monkey, (struct event){.kind = EVENT_FOCUS});
    }
    playing = NULL;
    for (int i = 0; i < 2; i++) {
        assert_undone(&runs[i]->monkey, &runs[i]->origin);
        end(runs[i], false);
        free(runs[i]);
    }
}

TESTS_BETWEEN(make_files, remove_files)
