/// Each allocation fails once: no signal, no success that is none, nothing half-written, one sentence, and unsaved work is kept.
///
/// Libraries' allocations count, too, because the program replaces malloc for the whole process. The graphics driver's do not; these tests
/// draw nothing.
#include "blind.h"
#include "folder.h"
#include "gltf_builder.h"

#include "app/personal.h"
#include "base/json.h"
#include "base/lapack.h"
#include "base/png.h"
#include "commands/commands.h"
#include "scene/load.h"
#include <dirent.h>
#include <errno.h>
#include <stdatomic.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

// --- runs a function once for each of its allocations, which then fails, in a child process

#if defined __SANITIZE_ADDRESS__ || defined __SANITIZE_THREAD__ || !defined __GLIBC__
enum { CAN_STARVE = 0 }; // the sanitizer's allocator conflicts
static atomic_long allocations;
static long starve_at;
static int starve_on, starve_on_last;
#else
enum { CAN_STARVE = 1 };
static atomic_long allocations; ///< since the last reset
static long starve_at = -1;     ///< index of the failing allocation; negative: none
static int starve_on;           ///< later allocations fail, too
static int starve_on_last;      ///< in the last run

void *__libc_malloc(size_t size);
void *__libc_calloc(size_t count, size_t size);
void *__libc_realloc(void *old, size_t size);
void *__libc_memalign(size_t alignment, size_t size);

static int starves(void)
{
    const long n = atomic_fetch_add(&allocations, 1);
    const int fails = starve_at >= 0 && (starve_on ? n >= starve_at : n == starve_at);
    if (fails) errno = ENOMEM; // libraries check it
    return fails;
}

void *malloc(size_t size) { return starves() ? NULL : __libc_malloc(size); }
void *calloc(size_t count, size_t size) { return starves() ? NULL : __libc_calloc(count, size); }
void *realloc(void *old, size_t size) { return starves() ? NULL : __libc_realloc(old, size); }
void *aligned_alloc(size_t alignment, size_t size) { return starves() ? NULL : __libc_memalign(alignment, size); }
#endif

/// Returns the exit status: 0 only if everything succeeded correctly.
typedef int starved(void *user);

/// Runs it in a child with one allocation failing (negative: none) or, if `on`, all from there. Returns waitpid()'s status; `*count` (may
/// be NULL) receives the number of allocations.
static int starve_once(starved *run, void *user, long at, int on, long *count)
{
    int ends[2];
    long counted = 0;
    assert_int_equal(pipe(ends), 0);
    fflush(stdout);
    fflush(stderr);
    const pid_t child = fork();
    if (child == 0) {
        if (!getenv("STARVE_LOUD") && !(freopen("/dev/null", "w", stdout) && freopen("/dev/null", "w", stderr)))
            _exit(9);
        starve_on = on;
        atomic_store(&allocations, 0);
        starve_at = at;
        const int status = run(user);
        starve_at = -1;
        counted = atomic_load(&allocations);
        if (write(ends[1], &counted, sizeof counted) != sizeof counted) _exit(9);
        _exit(status);
    }
    int status;
    assert_int_equal(waitpid(child, &status, 0), child);
    close(ends[1]);
    if (count) *count = read(ends[0], &counted, sizeof counted) == sizeof counted ? counted : 0;
    close(ends[0]);
    return status;
}

/// Checks from outside after a run that ended with `status`, also by need().
typedef void starve_check(void *user, int status);

/// Fails each allocation, alone and with all after it, in at most `most` runs at a fixed stride; a twelfth of that in `make test`, every
/// allocation both ways if STARVE_ALL is set. Every run must end by itself, at least one with an error. `check` may be NULL.
static void starve_checked(const char *what, starved *run, starve_check *check, void *user, long most)
{
    long all = 0, refused = 0, runs = 0;
    if (!is_thorough()) most = 8 + most / 12;
    int status = starve_once(run, user, -1, 0, &all);
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
        fail_msg("%s: status %x with all of its memory", what, status);
    const int both = getenv("STARVE_ALL") || 2 * all <= most;
    const long stride = both || all <= most ? 1 : (all + most - 1) / most;
    for (long k = 0; k < all; k += both ? runs % 2 : stride, runs++) {
        starve_on_last = (int)(runs % 2);
        status = starve_once(run, user, k, starve_on_last, NULL);
        if (!WIFEXITED(status)) fail_msg("%s: signal %d at allocation %ld of %ld", what, WTERMSIG(status), k, all);
        if (WEXITSTATUS(status) > 3)
            fail_msg("%s: wrong (%d) at allocation %ld of %ld", what, WEXITSTATUS(status), k, all);
        if (check) check(user, WEXITSTATUS(status));
        refused += WEXITSTATUS(status) != 0;
    }
    if (refused == 0) fail_msg("%s: none of %ld failures was noticed", what, runs);
    print_message("           %s: %ld runs, every %ld. of %ld allocations failed%s\n", what, runs, stride, all,
                  both ? " both ways" : "");
}

static void starve(const char *what, starved *run, void *user, long most)
{
    starve_checked(what, run, NULL, user, most);
}

// --- what is starved

/// The fonts as the app reads and rasterises them.
static int read_fonts(void *user)
{
    struct atlas atlas;
    struct error error = {0};
    (void)user;
    font_init();
    if (!atlas_build(1, &atlas, &error)) return strstr(error.text, "memory") ? 3 : 4;
    atlas_free(&atlas);
    return 0;
}

enum { SIDE = 64 };

/// A picture; it is whole where it is said to be written, and else not there.
static int write_picture(void *user)
{
    static unsigned char pixels[4 * SIDE * SIDE];
    struct error error = {0};
    const char *path = user;
    unsigned seed = 1;
    for (size_t i = 0; i < sizeof pixels; i++)
        pixels[i] = (unsigned char)((seed = seed * 1664525u + 1013904223u) >> 29);
    unlink(path);
    if (png_write(path, SIDE, SIDE, pixels, &error)) return access(path, F_OK) == 0 ? 0 : 4;
    return access(path, F_OK) != 0 && strstr(error.text, "emory") ? 3 : 5;
}

/// Tokens that end in every way the reader looks past, each longer than any before it; it is whole where it is said to be read.
static int read_tokens(void *user)
{
    static const char text[] =
        "[true, 0.12345678901234567890, \"\\u00e9 and \xc3\xa9\xe2\x82\xac, more than 32 bytes of them\",\n"
        "-1.00000000000000000000000000000000000000000000000000000000000000000001e-10]";
    json_error_t error;
    (void)user;
    json_t *json = json_read(text, sizeof text - 1, 0, &error);
    if (!json) return json_error_code(&error) == json_error_out_of_memory ? 3 : 4;
    const double last = json_number_value(json_array_get(json, 3));
    const bool whole = json_array_size(json) == 4 && last > -1.1e-10 && last < -0.9e-10;
    json_decref(json);
    return whole ? 0 : 5;
}

/// A command line, what it writes, and what is in that with all of its memory.
struct job {
    const char *line;
    int (*run)(int argc, char **argv);
    char output[128]; ///< "" where there is none
    char *expected;
    size_t size;
};

static char *content(const char *path, size_t *size)
{
    char *data = NULL;
    return file_read(path, (size_t)1 << 30, &data, size, NULL) ? data : NULL;
}

static int run_job(void *user)
{
    struct job *job = user;
    static char words[2048];
    char *argv[48] = {0};
    char errors[128];
    int argc = 0;
    snprintf(words, sizeof words, "%s", job->line);
    for (char *word = strtok(words, " "); word; word = strtok(NULL, " ")) argv[argc++] = word;
    snprintf(errors, sizeof errors, "%s", folder_path("errors"));
    const long at = starve_at;
    starve_at = -1; // what opens a file of the test's own has memory
    if (!getenv("STARVE_LOUD") && !(freopen(errors, "w", stderr) && freopen(errors, "a", stdout))) return 9;
    setvbuf(stderr, NULL, _IONBF, 0);
    if (job->output[0]) unlink(job->output);
    atomic_store(&allocations, 0);
    starve_at = at;
    const int status = job->run(argc, argv);
    starve_at = -1;
    fflush(stdout);
    return status;
}

static int is_unfinished(const struct dirent *entry) { return strncmp(entry->d_name, ".wiggly-", 8) == 0; }

/// Where it says that it is done, the file is what it always is; where not, there is none, and one sentence says why.
static void check_job(void *user, int status)
{
    const struct job *job = user;
    struct dirent **entries = NULL;
    size_t size = 0;
    char *bytes = job->output[0] && access(job->output, F_OK) == 0 ? content(job->output, &size) : NULL;
    if (status == 0 && job->output[0] && !bytes) fail_msg("%s: nothing is written", job->line);
    if (bytes && (size != job->size || memcmp(bytes, job->expected, size) != 0)) // or the first of two files
        fail_msg("%s: status %d, and something else is written", job->line, status);
    free(bytes);
    assert_int_equal(scandir(folder, &entries, is_unfinished, NULL), 0);
    free(entries);
    if (status == 0 || getenv("STARVE_LOUD")) return;
    char *said = content(folder_path("errors"), &size);
    if (!said || size == 0 || !strstr(said, "memory")) fail_msg("%s: status %d says '%s'", job->line, status, said);
    free(said);
}

enum { ROWS = 5, BONES = 4 };

/// ribbon.gltf, of four bones with a clip and a picture: all that a character has, in a thirtieth of the dog's allocations, so that each can
/// fail.
static void write_ribbon(void)
{
    static struct builder b;
    float at[ROWS][2][3] = {{{0}}}, uv[ROWS][2][2] = {{{0}}}, weights[ROWS][2][4] = {{{0}}},
          inverse[BONES][16] = {{0}};
    unsigned char joints[ROWS][2][4] = {{{0}}};
    unsigned short corners[ROWS - 1][6];
    const float times[] = {0, 0.5f, 1}, turns[][4] = {{0, 0, 0, 1}, {0, 0, 0.38268343f, 0.92387953f}, {0, 0, 0, 1}};
    for (int row = 0; row < ROWS; row++) {
        for (int side = 0; side < 2; side++) {
            at[row][side][0] = (float)side * 0.2f - 0.1f;
            at[row][side][1] = (float)row * 0.25f;
            memcpy(uv[row][side], at[row][side], sizeof uv[row][side]);
            joints[row][side][0] = (unsigned char)(row < BONES ? row : BONES - 1);
            weights[row][side][0] = 1;
        }
        if (row == ROWS - 1) break;
        const int first = 2 * row, quad[] = {0, 1, 2, 1, 3, 2};
        for (int i = 0; i < 6; i++) corners[row][i] = (unsigned short)(first + quad[i]);
        for (int i = 0; i < 4; i++) inverse[row][5 * i] = 1;
        inverse[row][13] = -(float)row * 0.25f;
    }
    b = (struct builder){.size = 0};
    add_data(&b, FLOAT, "VEC3", 2 * ROWS, at, sizeof at);
    add_data(&b, UBYTE, "VEC4", 2 * ROWS, joints, sizeof joints);
    add_data(&b, FLOAT, "VEC4", 2 * ROWS, weights, sizeof weights);
    add_data(&b, USHORT, "SCALAR", 6 * (ROWS - 1), corners, sizeof corners);
    add_data(&b, FLOAT, "MAT4", BONES, inverse, sizeof inverse);
    add_data(&b, FLOAT, "SCALAR", 3, times, sizeof times);
    add_data(&b, FLOAT, "VEC4", 3, turns, sizeof turns);
    add_data(&b, FLOAT, "VEC2", 2 * ROWS, uv, sizeof uv);
    unsigned char pixels[4 * 8 * 8];
    for (size_t i = 0; i < sizeof pixels; i++) pixels[i] = (unsigned char)(i * 37);
    assert_true(png_write(folder_path("ribbon.png"), 8, 8, pixels, NULL));
    const char *text = builder_json(
        &b, "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"JOINTS_0\":1,\"WEIGHTS_0\":2,\"TEXCOORD_"
            "0\":7},"
            "\"indices\":3,\"material\":0}]}],\"materials\":[{\"pbrMetallicRoughness\":{\"baseColorTexture\":{"
            "\"index\":0}}}],"
            "\"textures\":[{\"source\":0}],\"images\":[{\"uri\":\"ribbon.png\"}],\"skins\":[{\"joints\":[1,2,3,4],"
            "\"inverseBindMatrices\":4}],\"nodes\":["
            "{\"mesh\":0,\"skin\":0},{\"name\":\"body\",\"children\":[2]},"
            "{\"name\":\"tail_1\",\"translation\":[0,0.25,0],\"children\":[3]},"
            "{\"name\":\"tail_2\",\"translation\":[0,0.25,0],\"children\":[4]},"
            "{\"name\":\"tail_3\",\"translation\":[0,0.25,0]}],\"scenes\":[{\"nodes\":[0,1]}],\"scene\":0,"
            "\"animations\":[{\"name\":\"Sway\",\"samplers\":[{\"input\":5,\"output\":6}],\"channels\":["
            "{\"sampler\":0,\"target\":{\"node\":1,\"path\":\"rotation\"}}]}]");
    folder_file("ribbon.gltf", text);
}

/// A model is read with its picture, or not at all: "not enough memory" is not said as if the picture were at fault.
static int read_model(void *user)
{
    struct gltf gltf;
    struct error error = {0};
    if (!gltf_read(user, &gltf, &error)) return strstr(error.text, "memory") ? 3 : 4;
    const bool whole = gltf.image_count == 1;
    gltf_free(&gltf);
    return whole ? 0 : 5;
}

/// Of the reader of tokens each, for only some fill its buffer.
TEST(readers_and_writers)
{
    static const struct {
        const char *what, *file;
        starved *run;
        long most;
    } rows[] = {{"fonts", "", read_fonts, 300},
                {"a picture", "picture.png", write_picture, 300},
                {"JSON", "", read_tokens, 1000},
                {"a model", "ribbon.gltf", read_model, 1000}};
    write_ribbon();
    for (int i = 0; i < 4; i++) {
        char path[128];
        snprintf(path, sizeof path, "%s", folder_path(rows[i].file));
        starve(rows[i].what, rows[i].run, path, rows[i].most);
    }
}

/// The dog itself only in a sample: it has 15,000 to 30,000 allocations, which take an hour. OpenBLAS does not survive as it starts.
enum kind { ALL, DOG, THOROUGH, LAPACK };

static const struct {
    enum kind kind;
    int (*run)(int argc, char **argv);
    const char *output, *line; ///< %s: the test's folder
    long most;
} commands[] = {
    {ALL, command_check, NULL, "check assets/scenes/tail.json", 1100},
    {ALL, command_check, NULL, "check assets/scenes/hands.json", 150},
    {ALL, command_check, NULL, "check assets/scenes/dog.json", 100},
    {ALL, command_solve, "out.csv", "solve assets/scenes/tail.json -o %s/out.csv", 400},
    {ALL, command_solve, "out.csv", "solve assets/scenes/hands.json -o %s/out.csv", 2000},
    {ALL, command_export, "out.glb", "export assets/scenes/tail.json --frames 0:3 -o %s/out.glb", 150},
    {THOROUGH, command_export, "out.gltf", "export assets/scenes/tail.json --frames 0:3 -o %s/out.gltf", 150},
    {ALL, command_export, "out.usda", "export assets/scenes/tail.json --frames 0:3 -o %s/out.usda", 150},
    {THOROUGH, command_export, "out.bvh", "export assets/scenes/tail.json --frames 0:3 -o %s/out.bvh", 150},
    {ALL, command_export, "out.csv", "export assets/scenes/tail.json --frames 0:3 -o %s/out.csv", 150},
    {THOROUGH, command_export, "out.npy", "export assets/scenes/tail.json --frames 0:3 -o %s/out.npy", 150},
    {DOG, command_export, "out.glb", "export assets/scenes/dog.json --frames 0:3 -o %s/out.glb", 100},
    {DOG, command_export, "out.usda", "export assets/scenes/dog.json --frames 0:3 -o %s/out.usda", 100},
    {DOG, command_rig, "dog.json", "rig assets/models/dog.glb --chain tail_1:tail_8 -o %s/dog.json", 100},
    {DOG, command_rig, "dog.glb", "rig assets/models/dog.glb --chain ear_1_L -o %s/dog.glb", 100},
    {ALL, command_rig, "out.glb", "rig %s/ribbon.gltf --chain tail_1:tail_3 -o %s/out.glb", 2000},
    {ALL, command_rig, "ribbon.json", "rig %s/ribbon.gltf --chain tail_1:tail_3 -o %s/ribbon.json", 200},
    {ALL, command_export, "out.glb", "export %s/ribbon.json --frames 0:3 -o %s/out.glb", 200},
    {ALL, command_export, "out.usda", "export %s/ribbon.json --frames 0:3 -o %s/out.usda", 200},
    {ALL, command_simulate, "box.npy",
     "simulate %s/box.obj --shake side --tets 60 --seconds 1 --fps 24 --substeps 2 -o %s/box.npy", 200},
    {LAPACK, command_analyze, "box.glb",
     "analyze %s/box.npy --rest %s/box.rest.obj --fps 24 --method cpca --modes 1 -o %s/box.glb", 200},
};

/// With all of its memory, then without. What it writes is left for the next.
TEST(commands_one_after_the_other)
{
    struct lapack lapack;
    char description[128];
    const bool has_lapack = lapack_load(&lapack, description, sizeof description);
    write_ribbon();
    folder_file("box.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
                           "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 4 8 7 3\nf 1 5 8 4\nf 2 3 7 6\n");
    for (size_t i = 0; i < sizeof commands / sizeof *commands; i++) {
        char line[1024];
        struct job job = {.line = line, .run = commands[i].run};
        if (commands[i].kind == DOG        ? getenv("STARVE_ALL") != NULL
            : commands[i].kind == THOROUGH ? !is_thorough()
                                           : commands[i].kind == LAPACK && !has_lapack)
            continue;
        snprintf(line, sizeof line, commands[i].line, folder, folder, folder); // NOLINT
        if (commands[i].output) snprintf(job.output, sizeof job.output, "%s", folder_path(commands[i].output));
        const int status = starve_once(run_job, &job, -1, 0, NULL);
        if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
            fail_msg("%s: status %x with all of its memory", line, status);
        if (job.output[0]) job.expected = content(job.output, &job.size);
        starve_checked(line, run_job, check_job, &job, commands[i].most);
        if (job.output[0]) assert_done(file_write_atomic(job.output, job.expected, job.size, &error));
        free(job.expected);
    }
    if (has_lapack) lapack_unload(&lapack);
}

enum { STEPS = 12 };

/// A session of so many frames, and how many of them the process has made: it is shared with the process that looks on.
struct session {
    char path[128];
    char *after[STEPS + 1]; ///< the document after each frame, and at first, with all of the memory
    int *done;
};

static char *text_of(const struct document *document)
{
    size_t size;
    return scene_print(document, "/", NULL, &size);
}

/// A short session at a desk: start, edits, playing, undo, opening a figure, copying. `seen` (NULL: nobody) is handed the document after each frame.
static int run_session(struct session *session,
                       void (*seen)(struct session *session, const struct document *document))
{
    enum { EXAMPLE = -1 };
    static const struct {
        int key;
        unsigned mods;
    } keys[STEPS] = {
        {KEY_ESCAPE, 0},  {KEY_RIGHT, 0}, {'I', 0}, {' ', 0},        {'Z', MOD_CTRL}, {'Z', MOD_CTRL | MOD_SHIFT},
        {'N', MOD_SHIFT}, {EXAMPLE, 0},   {'F', 0}, {'C', MOD_CTRL}, {KEY_F1, 0},     {KEY_ESCAPE, 0}};
    struct error error = {0};
    struct blind blind;
    struct app *app = &blind.app;
    const long at = starve_at;
    starve_at = -1; // what is starved begins with the first frame
    blind_open(&blind, session->path);
    personal_start(app);
    *session->done = 0;
    if (seen) seen(session, app->work.document);
    history_mark_unsaved(app->work.history);
    atomic_store(&allocations, 0);
    starve_at = at;
    for (int i = 0; !app->failed && i < STEPS; i++) {
        const struct event event = {
            .kind = EVENT_KEY, .key = keys[i].key, .mods = keys[i].mods, .action = ACTION_PRESS};
        if (keys[i].key == EXAMPLE) {
            blind_send_example(&blind, "figure 3");
        } else {
            event_queue_push(&app->platform->queue, &event);
        }
        app_frame(app);
        *session->done = i + 1;
        if (seen) seen(session, app->work.document);
    }
    starve_at = -1;
    const bool good = !app->failed;
    if (!good) app_rescue(app, &error);
    personal_end(app, !good);
    return good ? 0 : 3;
}

static void keep_text(struct session *session, const struct document *document)
{
    session->after[*session->done] = text_of(document);
}

static int session(void *user) { return run_session(user, NULL); }

/// A recovery file holds the document as it was after one of the frames. Where there is never any memory again, edits before that may have
/// been refused.
static void check_session(void *user, int status)
{
    const struct session *session = user;
    char path[128];
    snprintf(path, sizeof path, "%s/wiggly/recovery-1", folder_path("state"));
    if (status != 0 && !starve_on_last && access(path, F_OK) == 0) {
        struct document *document = scene_load(path, NULL, NULL);
        assert_non_null(document);
        char *text = text_of(document);
        int frame = 0;
        while (frame <= STEPS && strcmp(text, session->after[frame]) != 0) frame++;
        if (frame > STEPS || frame > *session->done + 1)
            fail_msg("after %d frames the recovery file holds\n%s", *session->done, text);
        free(text);
        document_destroy(document);
    }
    unlink(path);
}

TEST(a_session)
{
    static const char scene[] = "{\"wiggly\": 1, \"frames\": [0, 48], \"splines\": [{\"name\": \"s\", \"knots\": "
                                "[{\"frame\": 0, \"value\": 0}, {\"frame\": 36, \"value\": 1}]}], \"rigs\": "
                                "[{\"type\": \"tail\", \"name\": \"tail\", \"spline\": \"s\"}]}";
    struct session own = {.done = mmap(NULL, sizeof(int), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0)};
    snprintf(own.path, sizeof own.path, "%s", folder_path("session.json"));
    assert_true(own.done != MAP_FAILED && file_write_atomic(own.path, scene, sizeof scene - 1, NULL));
    setenv("XDG_STATE_HOME", folder_path("state"), 1);
    setenv("XDG_CONFIG_HOME", folder_path("config"), 1);
    assert_int_equal(run_session(&own, keep_text), 0);
    starve_checked("a session", session, check_session, &own, 400);
    for (int i = 0; i <= STEPS; i++) free(own.after[i]);
    munmap(own.done, sizeof(int));
}

/// Unsaved work, where memory is short once: it is told, and a later try keeps the work.
static int keep_work(void *user)
{
    struct error error = {0};
    struct recovery_slot slot = {.lock = -1};
    const char *path = user;
    const long at = starve_at;
    starve_at = -1;
    unlink(path);
    snprintf(slot.path, sizeof slot.path, "%s", path);
    struct document *document = scene_load("assets/scenes/hands.json", NULL, &error);
    const struct autosave_work work = {.document = document, .path = "/mine.json", .revision = 7};
    if (!document) return 9;
    char *text = text_of(document);
    atomic_store(&allocations, 0);
    starve_at = at;
    struct autosave *autosave = autosave_open(&slot);
    bool told = false;
    for (int i = 0; i < 2000 && access(path, F_OK) != 0; i++) {
        if (i == 20) starve_at = -1; // there is memory again
        told |= !autosave_update(autosave, &work, i, &error);
        nanosleep(&(struct timespec){.tv_nsec = 2000000}, NULL);
    }
    starve_at = -1;
    autosave_close(autosave, true);
    if (told && !strstr(error.text, "emory")) return 5;
    struct document *kept = scene_load(path, NULL, &error);
    if (!kept) return 6;
    return strcmp(text_of(kept), text) == 0 ? told ? 3 : 0 : 7;
}

TEST(unsaved_work)
{
    char path[128];
    snprintf(path, sizeof path, "%s", folder_path("recovery-1"));
    starve("unsaved work", keep_work, path, 300);
}

static int make_or_skip(void **state)
{
    if (CAN_STARVE) return folder_make(state);
    puts("skip - what allocates here cannot be interposed");
    exit(0);
}
TESTS_BETWEEN(make_or_skip, folder_remove)
