/// Paint on characters as data: strokes and their undo, files that are saved, read and refused, what a recovery file keeps.
#include "app/recovery.h"
#include "base/npy.h"
#include "puppet.h"
#include "rig/models.h"
#include "scene/edit.h"
#include "scene/history.h"
#include "scene/load.h"
#include "temporary.h"
#include <string.h>

enum { COORDINATES = 2, VERTICES = 50 };

static const char scene[] =
    "{\"wiggly\": 1, \"frames\": [0, 48], \"splines\": [{\"name\": \"s\", \"knots\": []}], \"rigs\": ["
    "{\"type\": \"character\", \"model\": \"m.glb\", \"coordinates\": [{\"name\": \"a\", \"spline\": \"s\"}]}]}";

struct studio {
    struct document *document;
    struct history *history;
};

static struct character_rig *rig_of(const struct studio *s) { return document_character(s->document, 0); }

static struct studio studio_open(const char *text)
{
    struct error error = {0};
    struct studio s = {scene_parse("test", text, strlen(text), NULL, &error), NULL};
    if (!s.document) fail_msg("%s", error.text);
    s.history = history_create(s.document);
    return s;
}

static void studio_close(struct studio *s)
{
    history_destroy(s->history);
    document_destroy(s->document);
}

/// One moment of a brush: `count` vertices of coordinate 1 from `first` on get (a, ψ).
static void dab(struct studio *s, int first, int count, float swell, float lead)
{
    int vertices[VERTICES];
    float values[VERTICES][2];
    for (int i = 0; i < count; i++) {
        vertices[i] = first + i;
        values[i][0] = swell;
        values[i][1] = lead;
    }
    const struct dab made = {1, count, vertices, (const float(*)[2])values};
    assert_true(edit_paint(s->document, 0, &made, NULL));
}

static void new_paint(struct studio *s) { assert_true(edit_paint_new(s->document, 0, COORDINATES, VERTICES, NULL)); }

/// A stroke of three dabs, with the paint it is the first on.
static void paint_stroke(struct studio *s)
{
    history_begin(s->history, "Paint", 0);
    if (!rig_of(s)->painted) new_paint(s);
    dab(s, 10, 5, 0.1f, 0.5f);
    dab(s, 12, 5, 0.2f, 1.5f);
    dab(s, 10, 1, 0.3f, 2.5f);
    history_end(s->history);
}

static const float *value_of(const struct studio *s, int coordinate, int vertex)
{
    return rig_of(s)->painted->values[coordinate * VERTICES + vertex];
}

static void a_stroke_is_one_step_and_comes_back_byte_by_byte(void **state)
{
    (void)state;
    struct studio s = studio_open(scene);
    float before[COORDINATES * VERTICES][2], after[COORDINATES * VERTICES][2];
    paint_stroke(&s);
    assert_int_equal((int)history_count(s.history), 1);
    assert_near((double)value_of(&s, 1, 10)[1], 2.5, 0);
    assert_near((double)value_of(&s, 1, 11)[1], 0.5, 0);
    assert_near((double)value_of(&s, 1, 16)[0], 0.2f, 0);
    assert_near((double)value_of(&s, 1, 17)[0], 0, 0);
    assert_near((double)value_of(&s, 0, 10)[1], 0, 0);
    memcpy(before, rig_of(&s)->painted->values, sizeof before);
    history_begin(s.history, "Paint", 0);
    dab(&s, 0, 12, -1, 0.25f);
    history_end(s.history);
    memcpy(after, rig_of(&s)->painted->values, sizeof after);
    assert_true(history_undo(s.history));
    assert_memory_equal(rig_of(&s)->painted->values, before, sizeof before);
    assert_true(history_redo(s.history));
    assert_memory_equal(rig_of(&s)->painted->values, after, sizeof after);
    assert_true(history_undo(s.history));
    assert_true(history_undo(s.history));
    assert_null(rig_of(&s)->painted);
    while (history_redo(s.history)) continue;
    assert_memory_equal(rig_of(&s)->painted->values, after, sizeof after);
    studio_close(&s);
}

/// A stroke that is cancelled leaves nothing; one that goes on for long goes on from its last frame.
static void a_stroke_goes_on_or_is_cancelled(void **state)
{
    (void)state;
    struct studio s = studio_open(scene);
    paint_stroke(&s);
    history_begin(s.history, "Paint", 0);
    for (int i = 0; i < 1000; i++) dab(&s, 20, 3, 0, 0.001f * (float)i);
    history_end(s.history);
    history_begin(s.history, "Paint", 0);
    dab(&s, 0, VERTICES, 1, 1);
    history_restart(s.history);
    assert_near((double)value_of(&s, 1, 0)[0], 0, 0);
    assert_near((double)value_of(&s, 1, 20)[1], 0.999, 1e-6);
    history_end(s.history);
    assert_int_equal((int)history_count(s.history), 2);
    studio_close(&s);
}

static void paint_that_is_no_number_is_refused(void **state)
{
    (void)state;
    struct studio s = studio_open(scene);
    const float broken[][2] = {{NAN, 0}, {0, INFINITY}, {11, 0}, {0, -2000}};
    struct error error;
    const int vertex = 3, beyond = VERTICES;
    struct dab made = {0, 1, &vertex, NULL};
    history_begin(s.history, "Paint", 0);
    made.values = broken;
    assert_false(edit_paint(s.document, 0, &made, &error)); // no paint yet
    new_paint(&s);
    for (int i = 0; i < 4; i++) {
        made.values = &broken[i];
        assert_false(edit_paint(s.document, 0, &made, &error));
    }
    made = (struct dab){0, 1, &beyond, (const float[][2]){{0, 0}}};
    assert_false(edit_paint(s.document, 0, &made, &error));
    made = (struct dab){COORDINATES, 1, &vertex, (const float[][2]){{0, 0}}};
    assert_false(edit_paint(s.document, 0, &made, &error));
    assert_true(paint_is_plain(rig_of(&s)->painted));
    history_end(s.history);
    studio_close(&s);
}

/// An empty folder for one test.
static const char *fresh_folder(void)
{
    static char folder[64];
    snprintf(folder, sizeof folder, "/tmp/wiggly-test-XXXXXX");
    assert_non_null(mkdtemp(folder));
    return folder;
}

static void remove_folder(const char *folder)
{
    char command[128];
    snprintf(command, sizeof command, "rm -rf %s", folder);
    assert_int_equal(system(command), 0);
}

static const char *in(const char *folder, const char *name)
{
    static char paths[8][256];
    static int next;
    next = (next + 1) % 8;
    snprintf(paths[next], sizeof paths[next], "%s/%s", folder, name);
    return paths[next];
}

static bool is_there(const char *folder, const char *name) { return access(in(folder, name), F_OK) == 0; }

/// Paths in the document start there.
static void settle_in(struct studio *s, const char *folder)
{
    free(s->document->folder);
    s->document->folder = strdup(folder);
    assert_non_null(s->document->folder);
}

/// Saves as the app does.
static void save(struct studio *s, const char *folder, const char *name)
{
    struct error error = {0};
    const char *path = in(folder, name);
    if (!scene_save(s->document, path, &error)) fail_msg("%s", error.text);
    history_set_path(s->history, path);
}

static struct document *load(const char *folder, const char *name)
{
    struct error error = {0};
    struct document *document = scene_load(in(folder, name), NULL, &error);
    if (!document) fail_msg("%s", error.text);
    if (!scene_read_paint(document, &error)) fail_msg("%s", error.text);
    return document;
}

static void assert_loads(const struct studio *s, const char *folder, const char *name, const char *file)
{
    struct document *document = load(folder, name);
    const struct paint *paint = document_character(document, 0)->painted;
    assert_string_equal(document_character(document, 0)->file->path, file);
    assert_non_null(paint);
    assert_int_equal(paint->coordinates, COORDINATES);
    assert_int_equal(paint->vertices, VERTICES);
    assert_memory_equal(paint->values, rig_of(s)->painted->values, sizeof(float[COORDINATES * VERTICES][2]));
    document_destroy(document);
}

static void paint_is_saved_beside_its_scene(void **state)
{
    (void)state;
    const char *folder = fresh_folder();
    struct studio s = studio_open(scene);
    save(&s, folder, "plain.json");
    assert_false(is_there(folder, "plain-paint.npy"));
    paint_stroke(&s);
    save(&s, folder, "walk.json");
    assert_loads(&s, folder, "walk.json", "walk-paint.npy");
    history_begin(s.history, "Paint", 0);
    dab(&s, 30, 3, 0, 3);
    history_end(s.history);
    save(&s, folder, "walk.json"); // a new file takes the place of its own
    assert_loads(&s, folder, "walk.json", "walk-paint-2.npy");
    assert_false(is_there(folder, "walk-paint.npy"));
    save(&s, folder, "run.json"); // save as: the old one stays
    assert_loads(&s, folder, "run.json", "run-paint.npy");
    history_begin(s.history, "Paint", 0);
    dab(&s, 30, 3, 0, -3);
    history_end(s.history);
    save(&s, folder, "run.json");
    assert_loads(&s, folder, "run.json", "run-paint-2.npy");
    struct document *walk = load(folder, "walk.json");
    assert_near((double)document_character(walk, 0)->painted->values[VERTICES + 30][1], 3, 0);
    document_destroy(walk);
    while (history_undo(s.history)) continue;
    save(&s, folder, "run.json"); // nothing is painted any more
    struct document *run = load(folder, "run.json");
    assert_null(document_character(run, 0)->file->path);
    document_destroy(run);
    while (history_redo(s.history)) continue;
    save(&s, folder, "run.json");
    assert_loads(&s, folder, "run.json", "run-paint-2.npy");
    studio_close(&s);
    remove_folder(folder);
}

/// What is in the way is left alone; a scene that cannot be written leaves no paint behind and the document as it was.
static void saving_loses_nothing(void **state)
{
    (void)state;
    const char *folder = fresh_folder();
    struct studio s = studio_open(scene);
    struct error error;
    settle_in(&s, folder);
    paint_stroke(&s);
    FILE *other = fopen(in(folder, "walk-paint.npy"), "w");
    fputs("another's", other);
    fclose(other);
    save(&s, folder, "walk.json");
    assert_loads(&s, folder, "walk.json", "walk-paint-2.npy");
    mkdir(in(folder, "taken.json"), 0777);
    assert_false(scene_save(s.document, in(folder, "taken.json"), &error));
    assert_false(is_there(folder, "taken-paint.npy"));
    assert_string_equal(rig_of(&s)->file->path, "walk-paint-2.npy");
    assert_false(scene_save(s.document, "/nowhere/at/all.json", &error));
    assert_string_equal(rig_of(&s)->file->path, "walk-paint-2.npy");
    save(&s, folder, "walk.json");
    assert_loads(&s, folder, "walk.json", "walk-paint-2.npy");
    studio_close(&s);
    remove_folder(folder);
}

static void paint_more(struct studio *s, float lead)
{
    history_begin(s->history, "Paint", 0);
    dab(s, 30, 3, 0, lead);
    history_end(s->history);
}

/// A scene that cannot be saved keeps the paint that it had, not what is new since.
static void paint_and_scene_are_saved_together(void **state)
{
    (void)state;
    const char *folder = fresh_folder();
    struct studio s = studio_open(scene);
    struct error error;
    paint_stroke(&s);
    save(&s, folder, "walk.json");
    assert_int_equal(rename(in(folder, "walk.json"), in(folder, "old.json")), 0);
    assert_int_equal(mkdir(in(folder, "walk.json"), 0777), 0);
    paint_more(&s, 3);
    assert_false(scene_save(s.document, in(folder, "walk.json"), &error));
    assert_int_equal(rmdir(in(folder, "walk.json")), 0);
    while (history_undo(s.history)) continue;
    paint_stroke(&s);
    assert_loads(&s, folder, "old.json", "walk-paint.npy");
    assert_false(is_there(folder, "walk-paint-2.npy"));
    assert_int_equal(rename(in(folder, "old.json"), in(folder, "walk.json")), 0);
    paint_more(&s, 2);
    save(&s, folder, "walk.json");
    assert_loads(&s, folder, "walk.json", "walk-paint-2.npy");
    studio_close(&s);
    remove_folder(folder);
}

/// A copy of the scene names the same paint, and goes on doing so.
static void a_copy_keeps_its_paint(void **state)
{
    (void)state;
    const char *folder = fresh_folder();
    struct studio s = studio_open(scene);
    char command[600];
    paint_stroke(&s);
    save(&s, folder, "walk.json");
    snprintf(command, sizeof command, "cp %s %s", in(folder, "walk.json"), in(folder, "copy.json"));
    assert_int_equal(system(command), 0);
    assert_loads(&s, folder, "copy.json", "walk-paint.npy");
    struct document *before = load(folder, "copy.json");
    paint_more(&s, 3);
    save(&s, folder, "walk.json");
    assert_loads(&s, folder, "walk.json", "walk-paint-2.npy");
    struct document *copy = load(folder, "copy.json");
    assert_memory_equal(document_character(copy, 0)->painted->values, document_character(before, 0)->painted->values,
                        sizeof(float[COORDINATES * VERTICES][2]));
    document_destroy(before);
    document_destroy(copy);
    studio_close(&s);
    remove_folder(folder);
}

/// An .npy file with this dictionary, and `size` bytes of numbers.
/// Characters that name one file, as a scene written by hand may, have a file each from the first save on.
static void shared_paint_is_parted(void **state)
{
    (void)state;
#define NAMING "{\"type\": \"character\", \"model\": \"m.glb\", \"paint\": \"walk-paint.npy\", \"coordinates\": []}"
    static const char two[] =
        "{\"wiggly\": 1, \"frames\": [0, 48], \"splines\": [], \"rigs\": [" NAMING ", " NAMING "]}";
    const char *folder = fresh_folder();
    struct studio s = studio_open(scene);
    paint_stroke(&s);
    save(&s, folder, "walk.json");
    FILE *file = fopen(in(folder, "two.json"), "w");
    assert_true(file && fputs(two, file) >= 0 && fclose(file) == 0);
    struct document *document = load(folder, "two.json");
    struct error error;
    document_set_path(document, in(folder, "two.json"));
    if (!scene_save(document, in(folder, "two.json"), &error)) fail_msg("%s", error.text);
    document_destroy(document);
    document = load(folder, "two.json");
    assert_string_equal(document_character(document, 0)->file->path, "walk-paint.npy");
    assert_string_equal(document_character(document, 1)->file->path, "two-paint.npy");
    assert_memory_equal(document_character(document, 1)->painted->values, rig_of(&s)->painted->values,
                        sizeof(float[COORDINATES * VERTICES][2]));
    document_destroy(document);
    studio_close(&s);
    remove_folder(folder);
}

static void write_npy(const char *path, const char *dictionary, const void *numbers, size_t size)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    fwrite("\x93NUMPY\1\0", 1, 8, file);
    fputc((int)strlen(dictionary), file);
    fputc(0, file);
    fputs(dictionary, file);
    fwrite(numbers, 1, size, file);
    fclose(file);
}

#define F4 "{'descr': '<f4', 'fortran_order': False, 'shape': "

static void broken_paint_is_said_and_stays_named(void **state)
{
    (void)state;
    const char *folder = fresh_folder();
    static const float numbers[8] = {0, 1, 0, 1, 0, NAN, 0, 1};
    static const struct {
        const char *dictionary;
        size_t size;
        const char *says;
    } cases[] = {
        {F4 "(1, 4, 2), }", 32, "coordinate 0, vertex 2: expected a phase in radians within ±1000, got "},
        {F4 "(1, 4, 2), }", 31, "bytes for the shape (1, 4, 2), got "},
        {F4 "(1, 4, 3), }", 32, "expected paint, an array of shape (coordinates, vertices, 2), got (1, 4, 3)"},
        {F4 "(8,), }", 32, "got (8,)"},
        {F4 "(99999999, 99999999, 2), }", 32, "expected paint, an array of shape"},
        {"{'descr': '<i4', 'fortran_order': False, 'shape': (1, 4, 2), }", 32, "expected numbers of type float32"},
        {"{'descr': '<f4'}", 32, "expected the header of an .npy array"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct studio s = studio_open(scene);
        struct error error = {0};
        rig_of(&s)->file->path = strdup("x.npy");
        settle_in(&s, folder);
        write_npy(in(folder, "x.npy"), cases[i].dictionary, numbers, cases[i].size);
        assert_false(scene_read_paint(s.document, &error));
        if (!strstr(error.text, cases[i].says)) fail_msg("'%s' lacks '%s'", error.text, cases[i].says);
        assert_non_null(strstr(error.text, in(folder, "x.npy")));
        save(&s, folder, "walk.json");
        paint_stroke(&s); // goes to a file of its own: the broken one may be worth mending
        save(&s, folder, "walk.json");
        assert_loads(&s, folder, "walk.json", "walk-paint.npy");
        assert_true(is_there(folder, "x.npy"));
        studio_close(&s);
        unlink(in(folder, "walk-paint.npy"));
    }
    struct studio s = studio_open(scene);
    struct error error = {0};
    rig_of(&s)->file->path = strdup("missing.npy");
    settle_in(&s, folder);
    assert_false(scene_read_paint(s.document, &error));
    save(&s, folder, "walk.json");
    struct document *again = scene_load(in(folder, "walk.json"), NULL, &error);
    assert_string_equal(document_character(again, 0)->file->path, "missing.npy");
    document_destroy(again);
    studio_close(&s);
    remove_folder(folder);
}

/// Paint that NumPy's users write: float64, big endian, Fortran order.
static void other_layouts_are_read(void **state)
{
    (void)state;
    const char *folder = fresh_folder();
    const double doubles[8] = {0.5, 1, 1.5, 2, 2.5, 3, 3.5, 4}; // a of vertices 0 … 3, then their ψ
    unsigned char swapped[8][8];
    for (int i = 0; i < 64; i++) swapped[i / 8][i % 8] = ((const unsigned char *)&doubles[i / 8])[7 - i % 8];
    for (int kind = 0; kind < 2; kind++) {
        struct studio s = studio_open(scene);
        struct error error = {0};
        rig_of(&s)->file->path = strdup("x.npy");
        settle_in(&s, folder);
        write_npy(in(folder, "x.npy"),
                  kind ? "{'descr': '>f8', 'fortran_order': True, 'shape': (1, 4, 2), }"
                       : "{'descr': '<f8', 'fortran_order': True, 'shape': (1, 4, 2), }",
                  kind ? (const void *)swapped : (const void *)doubles, sizeof doubles);
        if (!scene_read_paint(s.document, &error)) fail_msg("%s", error.text);
        for (int i = 0; i < 4; i++) {
            assert_near((double)rig_of(&s)->painted->values[i][0], doubles[i], 0);
            assert_near((double)rig_of(&s)->painted->values[i][1], doubles[4 + i], 0);
        }
        studio_close(&s);
    }
    remove_folder(folder);
}

/// What is not saved is in the recovery file, and the document that comes out of it saves into the file it had.
static void a_recovery_file_keeps_paint(void **state)
{
    (void)state;
    const char *folder = fresh_folder();
    struct studio s = studio_open(scene);
    struct recovery_slot slot;
    struct error error = {0};
    char *text = NULL;
    size_t capacity = 0, size;
    paint_stroke(&s);
    save(&s, folder, "walk.json");
    history_begin(s.history, "Paint", 0);
    dab(&s, 40, 3, 0, 1);
    history_end(s.history);
    scene_print_into(s.document, RECOVERY_FOLDER, &text, &capacity, &size);
    scene_print_paint(s.document, &text, &capacity, &size);
    if (!recovery_claim(folder, &slot, &error)) fail_msg("%s", error.text);
    assert_true(recovery_write(&slot, in(folder, "walk.json"), NULL, text, size, &error));
    struct studio t = {recovery_read(&slot, &error), NULL};
    if (!t.document) fail_msg("%s", error.text);
    t.history = history_create(t.document);
    assert_true(scene_read_paint(t.document, &error)); // has nothing to do: the saved file is older
    assert_memory_equal(rig_of(&t)->painted->values, rig_of(&s)->painted->values,
                        sizeof(float[COORDINATES * VERTICES][2]));
    document_set_path(t.document, in(folder, "walk.json"));
    save(&t, folder, "walk.json");
    assert_loads(&s, folder, "walk.json", "walk-paint-2.npy");
    assert_false(is_there(folder, "walk-paint.npy"));
    assert_true(recovery_write(&slot, "", NULL, text, size - 1, &error)); // cut off
    assert_null(recovery_read(&slot, &error));
    recovery_release(&slot);
    free(text);
    studio_close(&s);
    studio_close(&t);
    remove_folder(folder);
}

/// Paint of another model is said, kept, and not put on.
static void paint_for_another_model_is_kept(void **state)
{
    (void)state;
    const char *folder = fresh_folder();
    struct character character = puppet_character(0.2f, 1);
    struct studio s = studio_open(scene);
    struct models *models = models_create();
    struct error error = {0};
    assert_true(character_write(in(folder, "m.glb"), &character, true, &error));
    settle_in(&s, folder);
    paint_stroke(&s);
    assert_false(models_update(models, s.document, &error));
    assert_non_null(strstr(error.text, "expected paint for the 1 coordinates of "));
    assert_non_null(models_figure(models, 0));
    assert_true(models_figure(models, 0)->version == 0);
    save(&s, folder, "walk.json");
    assert_loads(&s, folder, "walk.json", "walk-paint.npy");
    models_destroy(models);
    character_free(&character);
    studio_close(&s);
    remove_folder(folder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_stroke_is_one_step_and_comes_back_byte_by_byte),
        cmocka_unit_test(a_stroke_goes_on_or_is_cancelled),
        cmocka_unit_test(paint_that_is_no_number_is_refused),
        cmocka_unit_test(paint_is_saved_beside_its_scene),
        cmocka_unit_test(saving_loses_nothing),
        cmocka_unit_test(paint_and_scene_are_saved_together),
        cmocka_unit_test(a_copy_keeps_its_paint),
        cmocka_unit_test(shared_paint_is_parted),
        cmocka_unit_test(broken_paint_is_said_and_stays_named),
        cmocka_unit_test(other_layouts_are_read),
        cmocka_unit_test(a_recovery_file_keeps_paint),
        cmocka_unit_test(paint_for_another_model_is_kept),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
