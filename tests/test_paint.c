/// Paint on characters as data: strokes and their undo, files that are saved, read and refused, what a recovery file keeps.
#include "app/recovery.h"
#include "base/npy.h"
#include "commands/commands.h"
#include "puppet.h"
#include "rig/models.h"
#include "scene/edit.h"
#include "scene/history.h"
#include "scene/load.h"
#include "scene/paint.h"
#include "temporary.h"

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

TEST(a_stroke_is_one_step_and_comes_back_byte_by_byte)
{
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
TEST(a_stroke_goes_on_or_is_cancelled)
{
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

TEST(paint_that_is_no_number_is_refused)
{
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

static void save(struct studio *s, const char *folder, const char *name)
{
    struct error error = {0};
    if (!scene_save(s->document, in(folder, name), &error)) fail_msg("%s", error.text);
}

static struct document *load(const char *folder, const char *name)
{
    struct error error = {0};
    struct document *document = scene_load(in(folder, name), NULL, &error);
    if (!document) fail_msg("%s", error.text);
    if (!scene_read_paint(document, &error)) fail_msg("%s", error.text);
    return document;
}

/// The file has the paint of the studio inside.
static void assert_holds_paint(const struct studio *s, const char *path)
{
    struct error error = {0};
    struct document *document = scene_load(path, NULL, &error);
    if (!document) fail_msg("%s", error.text);
    const struct paint *paint = document_character(document, 0)->painted;
    assert_null(document_character(document, 0)->paint_file);
    assert_non_null(paint);
    assert_int_equal(paint->coordinates, COORDINATES);
    assert_int_equal(paint->vertices, VERTICES);
    assert_memory_equal(paint->values, rig_of(s)->painted->values, sizeof(float[COORDINATES * VERTICES][2]));
    document_destroy(document);
}

static char *printed(const struct document *document)
{
    size_t size;
    return scene_print(document, &size);
}

/// Saved text reads back as itself, and only paint makes it version 2. A coordinate without paint is null.
TEST(paint_is_saved_in_its_scene)
{
    const char *folder = fresh_folder();
    struct error error = {0};
    struct studio s = studio_open(scene);
    char *plain = printed(s.document);
    assert_non_null(strstr(plain, "\"wiggly\": 1,"));
    assert_null(strstr(plain, "paint"));
    paint_stroke(&s);
    save(&s, folder, "walk.json");
    assert_holds_paint(&s, in(folder, "walk.json"));
    char *text = printed(s.document);
    assert_non_null(strstr(text, "\"wiggly\": 2,"));
    assert_non_null(strstr(text, "\"vertices\": 50,\n      \"paint\": [\n        null,\n        \"AAAA"));
    struct document *again = scene_parse("again", text, strlen(text), NULL, &error);
    if (!again) fail_msg("%s", error.text);
    char *second = printed(again);
    assert_string_equal(second, text);
    while (history_undo(s.history)) continue;
    char *undone = printed(s.document);
    assert_string_equal(undone, plain);
    document_destroy(again);
    free(plain);
    free(text);
    free(second);
    free(undone);
    studio_close(&s);
    remove_folder(folder);
}

/// A scene of before: its file of paint is read, put into the scene with the next save, and left where it is.
TEST(paint_beside_a_scene_is_read_and_stays)
{
    const char *folder = fresh_folder();
    struct studio s = studio_open(scene), old = studio_open(scene);
    struct error error = {0};
    paint_stroke(&s);
    assert_true(paint_write(rig_of(&s)->painted, in(folder, "walk-paint.npy"), &error));
    rig_of(&old)->paint_file = strdup("walk-paint.npy");
    settle_in(&old, folder);
    save(&old, folder, "walk.json");
    struct document *document = load(folder, "walk.json");
    assert_memory_equal(document_character(document, 0)->painted->values, rig_of(&s)->painted->values,
                        sizeof(float[COORDINATES * VERTICES][2]));
    assert_true(scene_save(document, in(folder, "walk.json"), &error));
    assert_holds_paint(&s, in(folder, "walk.json"));
    assert_true(is_there(folder, "walk-paint.npy"));
    document_destroy(document);
    studio_close(&s);
    studio_close(&old);
    remove_folder(folder);
}

TEST(paint_that_is_broken_in_its_scene_is_refused)
{
    static const struct {
        const char *members, *says;
    } cases[] = {
        {"\"paint\": [\"AAAA\"]", "expected \"vertices\", how many there are, beside it, got nothing"},
        {"\"vertices\": 0, \"paint\": [\"AAAA\"]", "expected a whole number from 1 to "},
        {"\"vertices\": 1, \"paint\": []", "expected a string for each coordinate, got none"},
        {"\"vertices\": 1, \"paint\": [null, 7]", "paint[1]: expected a string in base64 or null, got a number"},
        {"\"vertices\": 1, \"paint\": [\"AA*A\"]", "paint[0]: expected base64, got something else"},
        {"\"vertices\": 2, \"paint\": [\"AAAAAAAAAAA=\"]", "paint[0]: expected the 16 bytes of 2 vertices, got 8"},
        {"\"vertices\": 1, \"paint\": [\"AADAfwAAAAA=\"]",
         "paint[0]: coordinate 0, vertex 0: expected the logarithm of an amplitude within ±10, got "},
        {"\"vertices\": 134217728, \"paint\": [null, null]",
         "vertices: expected at most 134217728 vertices over all"},
        {"\"paint\": {}", "paint: expected a string, got an object"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[512];
        struct error error = {0};
        snprintf(text, sizeof text,
                 "{\"wiggly\": 2, \"frames\": [0, 48], \"splines\": [], \"rigs\": [{\"type\": \"character\", "
                 "\"model\": \"m.glb\", \"coordinates\": [], %s}]}",
                 cases[i].members);
        assert_null(scene_parse("test", text, strlen(text), NULL, &error));
        if (!strstr(error.text, cases[i].says)) fail_msg("'%s' lacks '%s'", error.text, cases[i].says);
    }
}

/// An .npy file with this dictionary, and `size` bytes of numbers.
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

TEST(broken_paint_is_said_and_stays_named)
{
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
        rig_of(&s)->paint_file = strdup("x.npy");
        settle_in(&s, folder);
        write_npy(in(folder, "x.npy"), cases[i].dictionary, numbers, cases[i].size);
        assert_false(scene_read_paint(s.document, &error));
        if (!strstr(error.text, cases[i].says)) fail_msg("'%s' lacks '%s'", error.text, cases[i].says);
        assert_non_null(strstr(error.text, in(folder, "x.npy")));
        save(&s, folder, "walk.json");
        paint_stroke(&s); // goes into the scene: the broken file may be worth mending
        save(&s, folder, "walk.json");
        assert_holds_paint(&s, in(folder, "walk.json"));
        assert_true(is_there(folder, "x.npy"));
        studio_close(&s);
    }
    struct studio s = studio_open(scene);
    struct error error = {0};
    rig_of(&s)->paint_file = strdup("missing.npy");
    settle_in(&s, folder);
    assert_false(scene_read_paint(s.document, &error));
    save(&s, folder, "walk.json");
    struct document *again = scene_load(in(folder, "walk.json"), NULL, &error);
    assert_string_equal(document_character(again, 0)->paint_file, "missing.npy");
    document_destroy(again);
    studio_close(&s);
    remove_folder(folder);
}

/// Paint that NumPy's users write: float64, big endian, Fortran order.
TEST(other_layouts_are_read)
{
    const char *folder = fresh_folder();
    const double doubles[8] = {0.5, 1, 1.5, 2, 2.5, 3, 3.5, 4}; // a of vertices 0 … 3, then their ψ
    unsigned char swapped[8][8];
    for (int i = 0; i < 64; i++) swapped[i / 8][i % 8] = ((const unsigned char *)&doubles[i / 8])[7 - i % 8];
    for (int kind = 0; kind < 2; kind++) {
        struct studio s = studio_open(scene);
        struct error error = {0};
        rig_of(&s)->paint_file = strdup("x.npy");
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

/// What is not saved is in the recovery file.
TEST(a_recovery_file_keeps_paint)
{
    const char *folder = fresh_folder();
    struct studio s = studio_open(scene);
    struct recovery_slot slot;
    struct error error = {0};
    paint_stroke(&s);
    if (!recovery_claim(folder, &slot, &error)) fail_msg("%s", error.text);
    assert_true(scene_save_for(s.document, slot.path, &(struct scene_origin){.path = "/walk.json"}, &error));
    assert_holds_paint(&s, slot.path);
    recovery_release(&slot);
    studio_close(&s);
    remove_folder(folder);
}

/// Paint of another model is said, kept, and not put on.
TEST(paint_for_another_model_is_kept)
{
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
    assert_holds_paint(&s, in(folder, "walk.json"));
    models_destroy(models);
    character_free(&character);
    studio_close(&s);
    remove_folder(folder);
}

/// NumPy gets what the scene has, and can give it back.
TEST(paint_goes_out_and_in_as_npy)
{
    const char *folder = fresh_folder();
    struct character character = puppet_character(0.2f, 1);
    struct studio s = studio_open(scene);
    struct error error = {0};
    assert_true(character_write(in(folder, "m.glb"), &character, true, &error));
    settle_in(&s, folder);
    assert_true(edit_paint_new(s.document, 0, 1, character.vertex_count, &error));
    rig_of(&s)->painted->values[3][1] = 0.5f;
    save(&s, folder, "walk.json");
    char *words[] = {
        "export", "--quiet", "--paint", "-o", strdup(in(folder, "out.npy")), strdup(in(folder, "walk.json")), NULL};
    assert_int_equal(command_export(6, words), 0);
    struct paint *paint = paint_read(words[4], &error);
    assert_non_null(paint);
    assert_int_equal(paint->vertices, character.vertex_count);
    assert_near((double)paint->values[3][1], 0.5, 0);
    words[4][strlen(words[4]) - 3] = 'x';
    assert_int_equal(command_export(6, words), 2);
    paint_drop(paint);
    free(words[4]);
    free(words[5]);
    character_free(&character);
    studio_close(&s);
    remove_folder(folder);
}
