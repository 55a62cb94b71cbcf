/// Saving, keeping unsaved work and exporting, with each system call failing in turn or being the last: what is on disk is old or new,
/// and whole.
#include "folder.h"
#include "traced.h"

#include "app/autosave.h"
#include "base/file.h"
#include "commands/commands.h"
#include "scene/load.h"
#include "scene/paint.h"
#include <stdio.h>
#include <string.h>

#if !defined __x86_64__ || defined __SANITIZE_ADDRESS__ || defined __SANITIZE_THREAD__
static void all(void **state)
{
    (void)state;
    print_message("skip - the registers of system calls are x86-64's, and a sanitizer has calls of its own\n");
    skip();
}
#else
enum { COORDINATES = 1, VERTICES = 8, OLD = 24, NEW = 25, NEXT = 26 };

static const char scene[] =
    "{\"wiggly\": 1, \"frames\": [0, 48], \"splines\": [{\"name\": \"s\", \"knots\": []}], \"rigs\": "
    "[{\"type\": \"character\", \"name\": \"c\", \"model\": \"m.glb\", \"coordinates\": "
    "[{\"name\": \"a\", \"spline\": \"s\"}]}]}";

/// Something that writes a file, and what is to be on disk after it.
struct job {
    traced *run;
    int (*version)(void); ///< OLD, NEW, or anything else where it is neither
    void (*next)(void);   ///< what the user does after a crash, or NULL
    struct document *document;
    struct recovery_slot slot;
};

static const char *work(const char *name)
{
    static char paths[4][192];
    static int next;
    next = (next + 1) % 4;
    snprintf(paths[next], sizeof paths[next], "%s/work/%s", folder, name);
    return paths[next];
}

static void command(const char *format)
{
    char line[512];
    snprintf(line, sizeof line, format, folder, folder, folder, folder); // NOLINT
    assert_int_equal(system(line), 0);
}

/// Gives document and paint a mark of their version, as unsaved edits.
static void mark(struct document *document, int version)
{
    struct character_rig *rig = document_character(document, 0);
    paint_destroy(rig->painted);
    rig->painted = paint_create(COORDINATES, VERTICES);
    assert_non_null(rig->painted);
    for (int v = 0; v < VERTICES; v++) rig->painted->values[v][1] = (float)version;
    rig->painted->version += 1000u * (unsigned)version;
    document->fps = version;
}

static int save(void *user)
{
    struct job *job = user;
    struct error error = {0};
    return scene_save(job->document, job->document->path, &error) ? 0 : error.text[0] ? 3 : 9;
}

/// Scene and paint belong together.
static int saved_version(void)
{
    struct error error = {0};
    struct document *document = scene_load(work("walk.json"), NULL, &error);
    if (!document || !scene_read_paint(document, &error)) fail_msg("%s", error.text);
    const int version = (int)document->fps;
    const struct paint *paint = document_character(document, 0)->painted;
    assert_non_null(paint);
    for (int v = 0; v < VERTICES; v++) assert_int_equal((int)paint->values[v][1], version);
    document_destroy(document);
    return version;
}

/// Saves once more: there is one scene then, one file of paint, and nothing that an earlier save left.
static void save_next(void)
{
    struct error error = {0};
    assert_true(
        file_write_atomic(folder_path("elsewhere"), "", 0, &error)); // for a program looks once for what is left
    struct document *document = scene_load(work("walk.json"), NULL, &error);
    if (!document || !scene_read_paint(document, &error)) fail_msg("%s", error.text);
    assert_true(document_set_path(document, work("walk.json")));
    mark(document, NEXT);
    if (!scene_save(document, document->path, &error)) fail_msg("%s", error.text);
    document_destroy(document);
    assert_int_equal(saved_version(), NEXT);
    command("test $(ls -A %s/work | wc -l) = 2 || { ls -A %s/work >&2; false; }");
}

/// Runs it as it is, then with each call failing in three ways, then with each call being the last.
static void torment(const char *what, struct job *job)
{
    static const int errors[] = {ENOSPC, EIO, EACCES, 0};
    int runs = 0;
    for (int e = 0; e < 4; e++) {
        int count = 0;
        command("rm -rf %s/work && cp -r %s/old %s/work");
        assert_int_equal(job->version(), OLD);
        assert_int_equal(trace(job->run, job, (struct trouble){-1, errors[e]}, &count), 0);
        assert_int_equal(job->version(), NEW);
        assert_true(count > 4);
        for (int n = 0; n < count; n++, runs++) {
            command("rm -rf %s/work && cp -r %s/old %s/work");
            const int status = trace(job->run, job, (struct trouble){n, errors[e]}, NULL), version = job->version();
            const bool good = version == NEW || (version == OLD && status != 0);
            if (!good || status > 3)
                fail_msg("%s, call %d of %d, error %d: status %d, version %d", what, n, count, errors[e], status,
                         version);
            if (job->next && errors[e] == 0) job->next();
        }
    }
    print_message("           %s: %d runs\n", what, runs);
}

static struct document *painted_scene(void)
{
    struct error error = {0};
    command("rm -rf %s/old %s/work && mkdir %s/work");
    struct document *document = scene_parse("walk", scene, sizeof scene - 1, NULL, &error);
    if (!document) fail_msg("%s", error.text);
    document->folder = strdup(work("x"));
    *strrchr(document->folder, '/') = '\0';
    assert_true(document_set_path(document, work("walk.json")));
    mark(document, OLD);
    if (!scene_save(document, document->path, &error)) fail_msg("%s", error.text);
    command("cp -r %s/work %s/old");
    mark(document, NEW);
    return document;
}

static void a_save_with_paint(void **state)
{
    (void)state;
    struct job job = {save, saved_version, save_next, painted_scene(), {0}};
    torment("a save with paint", &job);
    document_destroy(job.document);
}

static int keep(void *user)
{
    struct job *job = user;
    struct error error = {0};
    char text[32];
    snprintf(text, sizeof text, "version %d", NEW);
    return recovery_write(&job->slot, "/walk.json", NULL, text, strlen(text), &error) ? 0 : error.text[0] ? 3 : 9;
}

static int kept_version(void)
{
    char text[128] = "";
    int version = 0;
    FILE *file = fopen(work("recovery-1"), "r");
    if (!file) return OLD; // there was none
    text[fread(text, 1, sizeof text - 1, file)] = '\0';
    fclose(file);
    return sscanf(text, "wiggly-recovery 1 /walk.json\nversion %d", &version) == 1 ? version : 0;
}

static void unsaved_work(void **state)
{
    (void)state;
    struct job job = {keep, kept_version, NULL, NULL, {0}};
    command("rm -rf %s/old && mkdir %s/old");
    snprintf(job.slot.path, sizeof job.slot.path, "%s", work("recovery-1"));
    torment("unsaved work", &job);
}

/// The same by autosave, whose thread writes it: whoever waits for that is told.
static int autosave(void *user)
{
    struct job *job = user;
    struct error error = {0};
    const struct autosave_work unsaved = {.document = job->document, .path = "/walk.json", .revision = 7};
    struct autosave *autosave = autosave_open(&job->slot, &error);
    if (!autosave) return 9;
    const bool good = autosave_flush(autosave, &unsaved, &error);
    autosave_close(autosave, true);
    return good ? 0 : error.text[0] ? 3 : 9;
}

static int autosaved_version(void)
{
    struct error error = {0};
    struct recovery_slot slot = {.lock = -1};
    snprintf(slot.path, sizeof slot.path, "%s", work("recovery-1"));
    struct document *document = recovery_read(&slot, &error);
    if (!document) fail_msg("%s", error.text);
    const int version = (int)document->fps;
    document_destroy(document);
    return version;
}

static void unsaved_work_in_a_thread(void **state)
{
    (void)state;
    struct job job = {autosave, autosaved_version, NULL, painted_scene(), {.lock = -1}};
    snprintf(job.slot.path, sizeof job.slot.path, "%s", work("recovery-1"));
    command("rm -rf %s/old/*");
    job.document->fps = OLD;
    command("rm -rf %s/work && mkdir %s/work");
    assert_int_equal(autosave(&job), 0);
    command("cp %s/work/recovery-1 %s/old");
    job.document->fps = NEW;
    torment("unsaved work in a thread", &job);
    document_destroy(job.document);
}

static int export_it(void *user)
{
    static char export_[] = "export", tail[] = "assets/scenes/tail.json", frames[] = "--frames=0:3", to[] = "-o";
    char path[192], *argv[] = {export_, tail, frames, to, path, NULL};
    (void)user;
    snprintf(path, sizeof path, "%s", work("out.glb"));
    if (!freopen("/dev/null", "w", stdout) || !freopen("/dev/null", "w", stderr)) return 1;
    return command_export(5, argv);
}

static char *exported;
static size_t exported_size;

static int exported_version(void)
{
    char *data;
    size_t size;
    if (!file_read(work("out.glb"), 1 << 24, &data, &size, NULL)) return 0;
    const bool is_old = size == 4 && memcmp(data, "old\n", 4) == 0;
    const bool is_new = size == exported_size && memcmp(data, exported, size) == 0;
    free(data);
    return is_old ? OLD : is_new ? NEW : 0;
}

static void an_export(void **state)
{
    (void)state;
    struct job job = {export_it, exported_version, NULL, NULL, {0}};
    command("rm -rf %s/old %s/work && mkdir %s/work");
    assert_int_equal(trace(export_it, NULL, (struct trouble){-1, 0}, NULL), 0);
    assert_true(file_read(work("out.glb"), 1 << 24, &exported, &exported_size, NULL));
    command("mkdir %s/old && echo old >%s/old/out.glb");
    torment("an export", &job);
    free(exported);
}
#endif

int main(void)
{
    const struct CMUnitTest tests[] = {
#if !defined __x86_64__ || defined __SANITIZE_ADDRESS__ || defined __SANITIZE_THREAD__
        cmocka_unit_test(all),
#else
        cmocka_unit_test(a_save_with_paint),
        cmocka_unit_test(unsaved_work),
        cmocka_unit_test(unsaved_work_in_a_thread),
        cmocka_unit_test(an_export),
#endif
    };
    return cmocka_run_group_tests(tests, folder_make, folder_remove);
}
