/// Paint on characters as data: strokes and their undo, files that are saved and read, what a recovery file keeps.
#include "base/npy.h"
#include "commands/commands.h"
#include "documents.h"
#include "folder.h"
#include "puppet.h"
#include "rig/models.h"
#include "scene/edit.h"
#include "scene/history.h"
#include <unistd.h>

enum { COORDINATES = 2, VERTICES = 50 };

static const char scene[] =
    "{\"wiggly\": 1, \"frames\": [0, 48], \"splines\": [{\"name\": \"s\", \"knots\": []}], \"rigs\": ["
    "{\"type\": \"character\", \"model\": \"m.glb\", \"coordinates\": [{\"name\": \"a\", \"spline\": \"s\"}]}]}";

struct studio {
    struct document *document;
    struct history *history;
};

static struct model_rig *rig_of(const struct studio *s) { return first_model(s->document); }

static void studio_open(struct studio *s)
{
    s->document = document_of_text(scene);
    s->history = history_create(s->document);
}

static void studio_close(struct studio *s)
{
    history_destroy(s->history);
    document_destroy(s->document);
}

#define STUDIO_TEST(name) TEST_OF(struct studio, s, studio_open(s), studio_close(s), name)

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

/// The document's paint is the studio's.
static void assert_same_paint(const struct studio *s, const struct document *document)
{
    const struct paint *paint = first_model(document)->painted;
    assert_non_null(paint);
    assert_int_equal(paint->coordinates, COORDINATES);
    assert_int_equal(paint->vertices, VERTICES);
    assert_memory_equal(paint->values, rig_of(s)->painted->values, sizeof(float[COORDINATES * VERTICES][2]));
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

/// A stroke is one step and comes back byte by byte. One that is cancelled leaves nothing; one that goes on for long goes on from its last frame.
STUDIO_TEST(strokes_are_steps)
{
    static const struct {
        int coordinate, vertex, number;
        double value;
    } rows[] = {{1, 10, 1, 2.5}, {1, 11, 1, 0.5}, {1, 16, 0, 0.2f}, {1, 17, 0, 0}, {0, 10, 1, 0}};
    float before[COORDINATES * VERTICES][2], after[COORDINATES * VERTICES][2];
    paint_stroke(s);
    assert_int_equal(history_count(s->history), 1);
    for (int i = 0; i < 5; i++)
        assert_near(value_of(s, rows[i].coordinate, rows[i].vertex)[rows[i].number], rows[i].value, 0);
    memcpy(before, rig_of(s)->painted->values, sizeof before);
    history_begin(s->history, "Paint", 0);
    dab(s, 0, 12, -1, 0.25f);
    for (int i = 0; i < 1000; i++) dab(s, 20, 3, 0, 0.001f * (float)i);
    history_end(s->history);
    memcpy(after, rig_of(s)->painted->values, sizeof after);
    assert_near(value_of(s, 1, 20)[1], 0.999, 1e-6);
    history_begin(s->history, "Paint", 0);
    dab(s, 0, VERTICES, 1, 1);
    history_restart(s->history);
    assert_memory_equal(rig_of(s)->painted->values, after, sizeof after);
    history_end(s->history);
    assert_int_equal(history_count(s->history), 2);
    assert_true(history_undo(s->history));
    assert_memory_equal(rig_of(s)->painted->values, before, sizeof before);
    assert_true(history_redo(s->history));
    assert_memory_equal(rig_of(s)->painted->values, after, sizeof after);
    while (history_undo(s->history)) continue;
    assert_null(rig_of(s)->painted);
    while (history_redo(s->history)) continue;
    assert_memory_equal(rig_of(s)->painted->values, after, sizeof after);
}

STUDIO_TEST(paint_that_is_no_number_is_refused)
{
    static const struct {
        int coordinate, vertex;
        float value[1][2];
    } rows[] = {{0, 3, {{NAN, 0}}},      {0, 3, {{0, INFINITY}}},    {0, 3, {{11, 0}}}, {0, 3, {{0, -2000}}},
                {0, VERTICES, {{0, 0}}}, {COORDINATES, 3, {{0, 0}}}, {0, 3, {{0, 0}}}}; // the last: no paint yet
    struct error error;
    history_begin(s->history, "Paint", 0);
    for (int i = 6; i >= 0; i--) {
        const struct dab made = {rows[i].coordinate, 1, &rows[i].vertex, rows[i].value};
        if (edit_paint(s->document, 0, &made, &error)) fail_msg("row %d", i);
        if (i == 6) new_paint(s);
    }
    assert_true(paint_is_plain(rig_of(s)->painted));
    history_end(s->history);
}

static bool is_there(const char *name) { return access(folder_path(name), F_OK) == 0; }

/// Paths in the document start there.
static void settle(struct studio *s)
{
    free(s->document->folder);
    s->document->folder = strdup(folder);
    assert_non_null(s->document->folder);
}

static void save(struct studio *s) { assert_done(scene_save(s->document, folder_path("walk.json"), &error)); }

/// A studio whose paint is in a file of that name.
static void open_beside(struct studio *s, const char *name)
{
    studio_open(s);
    rig_of(s)->paint_file = strdup(name);
    settle(s);
}

/// The file has the paint of the studio inside.
static void assert_holds_paint(const struct studio *s, const char *path)
{
    struct document *document = document_of_file(path);
    assert_null(first_model(document)->paint_file);
    assert_same_paint(s, document);
    document_destroy(document);
}

/// Saved text reads back as itself, and only paint makes it version 2. A coordinate without paint is null. What is not saved is in the
/// recovery file.
STUDIO_TEST(paint_is_saved_in_its_scene)
{
    char *plain = text_of_document(s->document);
    assert_non_null(strstr(plain, "\"wiggly\": 1,"));
    assert_null(strstr(plain, "paint"));
    paint_stroke(s);
    save(s);
    assert_holds_paint(s, folder_path("walk.json"));
    char *text = text_of_document(s->document);
    assert_non_null(strstr(text, "\"wiggly\": 2,"));
    assert_non_null(strstr(text, "\"vertices\": 50,\n      \"paint\": [\n        null,\n        \"AAAA"));
    assert_loads_again(s->document);
    assert_done(
        scene_save_for(s->document, folder_path("kept"), &(struct scene_origin){.path = "/walk.json"}, &error));
    assert_holds_paint(s, folder_path("kept"));
    while (history_undo(s->history)) continue;
    assert_prints(s->document, plain);
    free(plain);
    free(text);
}

/// A scene of before: its file of paint is read, put into the scene with the next save, and left where it is.
STUDIO_TEST(paint_beside_a_scene_is_read_and_stays)
{
    struct studio old;
    open_beside(&old, "walk-paint.npy");
    paint_stroke(s);
    assert_done(paint_write(rig_of(s)->painted, folder_path("walk-paint.npy"), &error));
    save(&old);
    struct document *document = document_of_file(folder_path("walk.json"));
    assert_done(scene_read_paint(document, &error));
    assert_same_paint(s, document);
    assert_done(scene_save(document, folder_path("walk.json"), &error));
    assert_holds_paint(s, folder_path("walk.json"));
    assert_true(is_there("walk-paint.npy"));
    document_destroy(document);
    studio_close(&old);
}

/// Writes x.npy with this dictionary, and `size` bytes of numbers.
static void write_npy(const char *dictionary, const void *numbers, size_t size)
{
    FILE *file = fopen(folder_path("x.npy"), "wb");
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
        struct studio s;
        open_beside(&s, "x.npy");
        write_npy(cases[i].dictionary, numbers, cases[i].size);
        assert_refusal(scene_read_paint(s.document, &error), cases[i].says);
        assert_refusal(scene_read_paint(s.document, &error), folder_path("x.npy"));
        save(&s);
        paint_stroke(&s); // goes into the scene: the broken file may be worth mending
        save(&s);
        assert_holds_paint(&s, folder_path("walk.json"));
        assert_true(is_there("x.npy"));
        studio_close(&s);
    }
    struct studio s;
    open_beside(&s, "missing.npy");
    assert_false(scene_read_paint(s.document, NULL));
    save(&s);
    struct document *again = document_of_file(folder_path("walk.json"));
    assert_string_equal(first_model(again)->paint_file, "missing.npy");
    document_destroy(again);
    studio_close(&s);
}

/// Paint that NumPy's users write: float64, big endian, Fortran order.
TEST(other_layouts_are_read)
{
    const double doubles[8] = {0.5, 1, 1.5, 2, 2.5, 3, 3.5, 4}; // a of vertices 0 … 3, then their ψ
    unsigned char swapped[8][8];
    for (int i = 0; i < 64; i++) swapped[i / 8][i % 8] = ((const unsigned char *)&doubles[i / 8])[7 - i % 8];
    for (int kind = 0; kind < 2; kind++) {
        struct studio s;
        open_beside(&s, "x.npy");
        write_npy(kind ? "{'descr': '>f8', 'fortran_order': True, 'shape': (1, 4, 2), }"
                       : "{'descr': '<f8', 'fortran_order': True, 'shape': (1, 4, 2), }",
                  kind ? (const void *)swapped : (const void *)doubles, sizeof doubles);
        assert_done(scene_read_paint(s.document, &error));
        for (int i = 0; i < 4; i++) {
            assert_near(rig_of(&s)->painted->values[i][0], doubles[i], 0);
            assert_near(rig_of(&s)->painted->values[i][1], doubles[4 + i], 0);
        }
        studio_close(&s);
    }
}

/// Paint of another model is said, kept, and not put on.
STUDIO_TEST(paint_for_another_model_is_kept)
{
    struct character character = puppet_character(0.2f, 1);
    struct models *models = models_create();
    assert_done(character_write(folder_path("m.glb"), &character, true, &error));
    settle(s);
    paint_stroke(s);
    assert_refusal(models_update(models, s->document, &error), "expected paint for the 1 coordinates of ");
    assert_non_null(models_figure(models, s->document, 0));
    assert_true(models_figure(models, s->document, 0)->version == 0);
    save(s);
    assert_holds_paint(s, folder_path("walk.json"));
    models_destroy(models);
    character_free(&character);
}

/// NumPy gets what the scene has, and can give it back.
STUDIO_TEST(paint_goes_out_and_in_as_npy)
{
    struct character character = puppet_character(0.2f, 1);
    assert_done(character_write(folder_path("m.glb"), &character, true, &error));
    settle(s);
    assert_done(edit_paint_new(s->document, 0, 1, character.vertex_count, &error));
    rig_of(s)->painted->values[3][1] = 0.5f;
    save(s);
    char *words[] = {
        "export", "--quiet", "--paint", "-o", strdup(folder_path("out.npy")), strdup(folder_path("walk.json")), NULL};
    assert_int_equal(command_export(6, words), 0);
    struct paint *paint = paint_read(words[4], NULL);
    assert_non_null(paint);
    assert_int_equal(paint->vertices, character.vertex_count);
    assert_near(paint->values[3][1], 0.5, 0);
    words[4][strlen(words[4]) - 3] = 'x';
    assert_int_equal(command_export(6, words), 2);
    paint_drop(paint);
    free(words[4]);
    free(words[5]);
    character_free(&character);
}

TESTS_BETWEEN(folder_make, folder_remove)
