/// A monkey's random actions from a seed: keys, chords, drags, typing, files. It aims at things on the screen, because random clicks mostly
/// do nothing. Its files are in the working folder.
#ifndef TESTS_MONKEY_H
#define TESTS_MONKEY_H

#include "blind.h"
#include "questions.h"

#include <unistd.h>

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
static inline int below(struct monkey *m, int end)
{
    m->random ^= m->random << 13;
    m->random ^= m->random >> 7;
    m->random ^= m->random << 17;
    return (int)((m->random >> 16) % (uint64_t)end);
}

static inline bool one_in(struct monkey *m, int many) { return below(m, many) == 0; }

static inline void monkey_send(struct monkey *m, struct event event)
{
    m->sent++;
    blind_send(m->blind, event);
}

static inline void monkey_key(struct monkey *m, int key, unsigned mods)
{
    monkey_send(m, (struct event){.kind = EVENT_KEY, .key = key, .action = ACTION_PRESS, .mods = mods});
    if (one_in(m, 8)) return; // held until a later action
    monkey_send(m, (struct event){.kind = EVENT_KEY, .key = key, .action = ACTION_RELEASE, .mods = mods});
}

static inline void monkey_type(struct monkey *m, const char *text)
{
    for (; *text; text++) monkey_send(m, (struct event){.kind = EVENT_TEXT, .codepoint = (unsigned char)*text});
}

static inline void monkey_move(struct monkey *m, float x, float y)
{
    m->x = x;
    m->y = y;
    monkey_send(m, (struct event){.kind = EVENT_POINTER, .x = x, .y = y, .mods = m->mods});
}

static inline void monkey_button(struct monkey *m, enum event_button button, enum event_action action, int clicks)
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
static inline bool find_thing(struct monkey *m, float *x, float *y)
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
static inline bool find_widget(struct monkey *m, float *x, float *y)
{
    const struct editor *editor = m->blind->app.work.editor;
    const struct ui *ui = asked(editor) != DIALOG_NONE ? &dialog_of(editor)->ui : inspector_of(editor);
    if (ui->stop_count == 0) return false;
    const struct rect r = ui->stop[below(m, ui->stop_count)].rect;
    *x = r.x + r.w * (float)below(m, 101) / 100;
    *y = r.y + r.h * (float)below(m, 101) / 100;
    return true;
}

static inline void monkey_point(struct monkey *m)
{
    const struct rect window = layout_of(m->blind->app.work.editor)->window;
    float x = window.w * (float)(below(m, 1100) - 50) / 1000, y = window.h * (float)(below(m, 1100) - 50) / 1000;
    const int what = below(m, 5);
    if (what < 2) find_thing(m, &x, &y);
    if (what == 2 || what == 3) find_widget(m, &x, &y);
    monkey_move(m, x, y);
}

static inline unsigned any_mods(struct monkey *m)
{
    static const unsigned mods[] = {MOD_SHIFT,           MOD_CTRL,          MOD_ALT, MOD_CTRL | MOD_SHIFT, MOD_SUPER,
                                    MOD_ALT | MOD_SHIFT, MOD_ALT | MOD_CTRL};
    const int n = below(m, 12); // none for five of twelve
    return n < 5 ? 0 : mods[n - 5];
}

static inline void any_key(struct monkey *m)
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
static inline void edit_key(struct monkey *m)
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
        monkey_key(m, KEY_LEFT + below(m, 4), any_mods(m) | MOD_ALT);
    } else {
        monkey_key(m, keys[below(m, sizeof keys / sizeof keys[0])], one_in(m, 4) ? any_mods(m) : 0);
    }
}

static inline void click(struct monkey *m)
{
    const enum event_button button = one_in(m, 6) ? (enum event_button)below(m, 3) : BUTTON_LEFT;
    if (!one_in(m, 4)) monkey_point(m);
    m->mods = one_in(m, 3) ? any_mods(m) : 0;
    monkey_button(m, button, ACTION_PRESS, 1 + one_in(m, 4));
    if (!one_in(m, 10)) monkey_button(m, button, ACTION_RELEASE, 1);
}

/// A press, a path in small or large steps, perhaps keys on the way, and usually a release.
static inline void drag(struct monkey *m)
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
static inline void type(struct monkey *m)
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
static inline void field(struct monkey *m)
{
    float x, y;
    if (!find_widget(m, &x, &y)) return;
    monkey_move(m, x, y);
    monkey_button(m, BUTTON_LEFT, ACTION_PRESS, 2);
    monkey_button(m, BUTTON_LEFT, ACTION_RELEASE, 1);
    monkey_key(m, 'A', MOD_CTRL);
    type(m);
}

/// Adds and removes rigs, switches theme, scale and presentation.
static inline void rig(struct monkey *m)
{
    static const int keys[] = {KEY_DOWN, KEY_DOWN, KEY_UP, KEY_ENTER, KEY_ENTER, KEY_TAB};
    const int what = below(m, 4);
    if (what == 0) {
        monkey_key(m, KEY_DELETE, MOD_SHIFT);
    } else if (what == 1) {
        static const int settings[] = {KEY_F10, KEY_F8, KEY_F5};
        monkey_key(m, settings[below(m, 3)], one_in(m, 2) ? MOD_SHIFT : 0);
    } else {
        monkey_key(m, 'A', 0);
        for (int i = below(m, 6); i > 0; i--) monkey_key(m, keys[below(m, 6)], 0);
        if (one_in(m, 3)) monkey_type(m, m->files->good[below(m, m->files->good_count)]); // no slash
        monkey_key(m, KEY_ENTER, 0);
    }
}

/// Exports in the background, in any format.
static inline void export(struct monkey *m)
{
    static const char *const names[] = {"x.glb", "x.usda", "x.bvh", "x.csv", "x.npy", "x.xyz", "nowhere/x.glb"};
    monkey_key(m, 'E', MOD_CTRL);
    monkey_key(m, 'A', MOD_CTRL);
    monkey_type(m, names[below(m, sizeof names / sizeof names[0])]);
    monkey_key(m, one_in(m, 4) ? KEY_ENTER : KEY_ESCAPE, 0); // else most of its time is spent on writing files
}

static inline void wheel(struct monkey *m)
{
    if (one_in(m, 2)) monkey_point(m);
    monkey_send(m, (struct event){.kind = EVENT_WHEEL,
                                  .dx = (float)(below(m, 5) - 2),
                                  .dy = (float)(below(m, 9) - 4),
                                  .x = m->x,
                                  .y = m->y,
                                  .mods = any_mods(m)});
}

static inline void play(struct monkey *m)
{
    static const int keys[] = {KEY_SPACE, KEY_SPACE, KEY_LEFT, KEY_RIGHT, KEY_HOME, KEY_END};
    static const char *const typed[] = {"[", "]", "-", "+", "=", ",", ".", "<", ">"};
    if (one_in(m, 2)) monkey_type(m, typed[below(m, sizeof typed / sizeof typed[0])]);
    monkey_key(m, keys[below(m, sizeof keys / sizeof keys[0])], one_in(m, 4) ? MOD_SHIFT : 0);
}

static inline void clipboard(struct monkey *m)
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

static inline void window(struct monkey *m)
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

static inline const char *any_file(struct monkey *m)
{
    const struct monkey_files *files = m->files;
    return one_in(m, 3) ? files->bad[below(m, files->bad_count)] : files->good[below(m, files->good_count)];
}

/// Opens and saves documents and figures, and answers the question about unsaved work.
static inline void document(struct monkey *m)
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
        monkey_key(m, '1' + below(m, 7), MOD_CTRL);
        return;
    }
    if (one_in(m, 2)) monkey_key(m, 'D', 0);
}

/// Overwrites a file with `text` or another file's content, only in the working folder.
static inline void overwrite(const char *path, const char *text, const char *from)
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
static inline void another(struct monkey *m)
{
    static const char *const settings[] = {"{\"theme\": \"light\", \"ui_scale\": 1.5}",
                                           "{\"theme\" \"dark\", \"ui_scale\": 1e999}", "",
                                           "recent = a.json\nrecent = /nowhere\nrecent = \nstage_share = -5\n"};
    static const int answers[] = {'K', 'T', 'S', KEY_ESCAPE, KEY_ENTER};
    const char *path = app_path(&m->blind->app);
    if (one_in(m, 3)) {
        overwrite("config/wiggly/settings", settings[below(m, 4)], NULL);
    } else if (path[0]) {
        overwrite(path, NULL, any_file(m));
    }
    monkey_send(m, (struct event){.kind = EVENT_FOCUS});
    if (one_in(m, 2)) monkey_key(m, 'S', MOD_CTRL);
    monkey_key(m, answers[below(m, 5)], 0);
}

/// Queues the monkey's next action.
static inline void monkey_act(struct monkey *m)
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

#endif
