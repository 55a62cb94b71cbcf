/// A monkey at the whole app: random events through its own queue, figures and documents included, and after each frame
/// everything that must hold whatever was done.
///
///     MONKEY_SEED=7 MONKEY_EVENTS=1000000 build/tests/app test_monkey    runs one seed, as long as wanted
///     MONKEY_RECORD=/tmp/m.replay …                                  writes down what it does
#include "app/recovery.h"
#include "beast.h"
#include "invariants.h"
#include "monkey.h"
#include "puppet.h"
#include <dirent.h>
#include <sys/stat.h>

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

static char folder[] = "/tmp/wiggly-monkey-XXXXXX";
static char home[4096];
static struct monkey_files files;
static char *names[256];
static int name_count;

/// The document as it was put on the table.
struct origin {
    unsigned serial;
    char *text, *folder;
};

static const char *keep(const char *name)
{
    char path[512];
    snprintf(path, sizeof path, "%s/bad/%s", folder, name);
    assert_true(name_count < 256);
    return names[name_count++] = strdup(path);
}

/// A scene as it was before any monkey wrote over it.
static void restore(const char *name)
{
    char command[8192];
    snprintf(command, sizeof command, "cp '%s/assets/scenes/%s' '%s'", home, name, name);
    assert_int_equal(system(command), 0);
}

static void copy_scene(const char *name)
{
    restore(name);
    files.good[files.good_count++] = name;
}

/// A character in two coordinates, and a scene that moves it.
static void make_puppet(void)
{
    static const char scene[] = "{\"wiggly\": 1, \"frames\": [0, 48], \"splines\": [{\"name\": \"s\", \"frequency\": "
                                "1, \"knots\": [{\"frame\": 0, "
                                "\"value\": 1}, {\"frame\": 20, \"value\": -1}]}], \"rigs\": [{\"type\": "
                                "\"character\", \"model\": \"puppet.glb\", "
                                "\"coordinates\": [{\"name\": \"a\", \"spline\": \"s\"}]}, "
                                "{\"type\": \"tail\", \"name\": \"t\", \"spline\": \"s\"}]}";
    struct character character = puppet_character(0.2f, 2);
    for (int i = 0; i < character.vertex_count; i++) character.coordinates[0].re[i][1] = 0.2f;
    assert_done(character_write("puppet.glb", &character, true, &error));
    character_free(&character);
    assert_done(file_write_atomic("puppet.json", scene, sizeof scene - 1, &error));
    files.good[files.good_count++] = "puppet.json";
}

/// An imported character with a chain in its tail.
static void make_beast(void)
{
    static const char scene[] =
        "{\"wiggly\": 1, \"frames\": [0, 48], \"splines\": [{\"name\": \"wag\", \"frequency\": 1, \"knots\": "
        "[{\"frame\": 0, \"value\": 1}]}], \"rigs\": [{\"type\": \"model\", \"name\": \"beast\", \"model\": "
        "\"beast.glb\", \"clip\": \"Walk\"}, {\"type\": \"chain\", \"name\": \"tail\", \"model\": \"beast\", "
        "\"from\": \"tail_1\", \"to\": \"tail_8\", \"channels\": [{\"spline\": \"wag\", \"axis\": \"side\", "
        "\"gain\": {\"ramp\": [[0, 4], [0.5, 9], [1, 12]]}}]}]}";
    assert_true(beast_write("beast.glb"));
    assert_done(file_write_atomic("beast.json", scene, sizeof scene - 1, &error));
    files.good[files.good_count++] = "beast.json";
    files.good[files.good_count++] = "beast.glb";
}

/// A scene that is long enough to be solved in the background, and not too long for keep_small().
static void make_long(void)
{
    static const char scene[] = "{\"wiggly\": 1, \"frames\": [0, 3000], \"splines\": [{\"name\": \"s\", \"start\": "
                                "\"loop\", \"frequency\": 1, "
                                "\"knots\": [{\"frame\": 0, \"value\": 1}, {\"frame\": 20, \"value\": -1}]}], "
                                "\"rigs\": [{\"type\": \"tail\", \"name\": \"t\", \"spline\": \"s\"}]}";
    assert_done(file_write_atomic("long.json", scene, sizeof scene - 1, &error));
}

/// Copies, as the monkey saves beside what it opens; sorted, so that a seed says which it opens.
static void copy_bad(void)
{
    char command[8192];
    snprintf(command, sizeof command, "cp -r '%s/tests/bad' bad", home);
    assert_int_equal(system(command), 0);
    struct dirent **entries;
    const int count = scandir("bad", &entries, NULL, alphasort);
    assert_true(count > 2);
    for (int i = 0; i < count; i++) {
        if (files.bad_count < 200) files.bad[files.bad_count++] = keep(entries[i]->d_name);
        free(entries[i]);
    }
    free(entries);
}

static int make_files(void **state)
{
    (void)state;
    if (!getcwd(home, sizeof home) || !mkdtemp(folder) || chdir(folder) != 0 || mkdir("sub", 0700) != 0) return -1;
    copy_scene("tail.json");
    copy_scene("follow.json");
    copy_scene("figure3.json");
    make_puppet();
    make_beast();
    make_long();
    files.good[files.good_count++] = "long.json";
    char own[sizeof folder + 16]; // settings, recent files and recovery
    snprintf(own, sizeof own, "%s/config", folder);
    setenv("XDG_CONFIG_HOME", own, 1);
    snprintf(own, sizeof own, "%s/state", folder);
    setenv("XDG_STATE_HOME", own, 1);
    copy_bad();
    files.bad[files.bad_count++] = "not there.json";
    return 0;
}

static int remove_files(void **state)
{
    (void)state;
    char command[64];
    while (name_count > 0) free(names[--name_count]);
    snprintf(command, sizeof command, "rm -rf %s", folder);
    return chdir("/") != 0 || system(command) != 0;
}

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
    return scene_print_for(document, "/", NULL, &size);
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
        if (!history_redo_label(app->work.history)) return;
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

/// Starts the app as a window does.
static void start(struct run *run, const char *scene)
{
    blind_open(&run->blind, scene);
    personal_start(&run->blind.app);
}

static struct run *new_run(int seed, const char *scene)
{
    struct run *run = calloc(1, sizeof *run);
    assert_non_null(run);
    start(run, scene);
    run->monkey =
        (struct monkey){.blind = &run->blind, .files = &files, .random = (uint64_t)seed * 0x9E3779B97F4A7C15u};
    run->next_undo = UNDO_EVERY;
    return run;
}

/// Ends the app; `lost`: as when it could not decide, so that its unsaved work stays.
static void end(struct run *run, bool lost)
{
    forget_origin(&run->origin);
    personal_end(&run->blind.app, lost);
    blind_close(&run->blind);
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
    make_long(); // the other monkey may have written something else over it
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
    start(run, NULL);
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
