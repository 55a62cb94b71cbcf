/// The list of a save that never ended (scene/leftovers.h), as somebody hostile would leave it: a save does its work whatever is there,
/// and removes nothing but its scene's own paint that no scene names.
#include "folder.h"
#include "near.h"

#include "base/file.h"
#include "scene/load.h"
#include "scene/paint.h"
#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

static const char scene[] =
    "{\"wiggly\": 1, \"frames\": [0, 48], \"splines\": [{\"name\": \"s\", \"knots\": []}], \"rigs\": "
    "[{\"type\": \"character\", \"name\": \"c\", \"model\": \"m.glb\", \"coordinates\": "
    "[{\"name\": \"a\", \"spline\": \"s\"}]}]}";

static const char list[] = ".walk.json.saving";

static void write_text(const char *name, const char *text)
{
    FILE *file = fopen(folder_path(name), "w");
    assert_non_null(file);
    fputs(text, file);
    assert_int_equal(fclose(file), 0);
}

static bool is_there(const char *name)
{
    struct stat about;
    return lstat(folder_path(name), &about) == 0;
}

/// A text of as many bytes, with the same line over and over.
static void write_lines(const char *line, size_t size)
{
    FILE *file = fopen(folder_path(list), "w");
    assert_non_null(file);
    for (size_t n = 0; n < size; n += strlen(line)) fputs(line, file);
    assert_int_equal(fclose(file), 0);
}

static void nothing(void) {}
static void a_list(void) { write_text(list, "7\n"); }
static void a_link(void) { assert_int_equal(symlink("precious.json", folder_path(list)), 0); }
static void a_link_to_nothing(void) { assert_int_equal(symlink("nothing", folder_path(list)), 0); }
static void a_link_to_a_list(void)
{
    write_text("their list", "7\n");
    assert_int_equal(symlink("their list", folder_path(list)), 0);
}
static void a_folder(void) { assert_int_equal(mkdir(folder_path(list), 0755), 0); }
static void a_pipe(void) { assert_int_equal(mkfifo(folder_path(list), 0666), 0); }
static void names(void) { write_text(list, "../precious.json\nprecious.json\n"); }
static void a_name_behind(void) { write_text(list, "9\n../../precious.json\n7\n"); }
static void a_negative_number(void) { write_text(list, "-7\n"); }
static void numbers_that_overflow(void) { write_text(list, "4294967303\n99999999999999999999999\n"); }
static void bytes(void) { write_text(list, "\x01\xff\x1b[31m\n\n\n;rm -rf .\n"); }
static void many_numbers(void) { write_lines("7\n1\n", 12000); }
static void a_huge_list(void) { write_lines("7\n", 1 << 22); }

static void unreadable(void)
{
    a_list();
    assert_int_equal(chmod(folder_path(list), 0), 0);
}

static int locked = -1;

/// As while another program saves.
static void a_locked_list(void)
{
    a_list();
    locked = open(folder_path(list), O_RDWR);
    assert_true(locked >= 0 && flock(locked, LOCK_EX) == 0);
}

/// A save that was killed has added walk-paint-7.npy, which the list may name; whoever has put in its place a link gets back what that
/// leads to.
static void a_link_as_paint(void)
{
    a_list();
    assert_int_equal(unlink(folder_path("walk-paint-7.npy")), 0);
    assert_int_equal(symlink("precious.json", folder_path("walk-paint-7.npy")), 0);
}

static void a_folder_as_paint(void)
{
    a_list();
    assert_int_equal(unlink(folder_path("walk-paint-7.npy")), 0);
    assert_int_equal(mkdir(folder_path("walk-paint-7.npy"), 0755), 0);
}

/// What is there, whether the file it may name goes, and whether it stays.
struct hostile {
    const char *what;
    void (*make)(void);
    bool removes, stays;
};

static const struct hostile hostiles[] = {
    {"nothing", nothing, false, false},
    {"a list", a_list, true, false},
    {"a link", a_link, false, true},
    {"a link to nothing", a_link_to_nothing, false, true},
    {"a link to a list", a_link_to_a_list, false, true},
    {"a folder", a_folder, false, true},
    {"a pipe", a_pipe, false, true},
    {"names", names, false, false},
    {"a name behind a number", a_name_behind, false, false},
    {"a negative number", a_negative_number, false, false},
    {"numbers that overflow", numbers_that_overflow, false, false},
    {"bytes", bytes, false, false},
    {"many numbers", many_numbers, true, false},
    {"a huge list", a_huge_list, false, false},
    {"an unreadable list", unreadable, false, true},
    {"a locked list", a_locked_list, false, true},
    {"a link as paint", a_link_as_paint, true, false},
    {"a folder as paint", a_folder_as_paint, false, false},
};

static struct document *painted(const char *path, float mark)
{
    struct error error = {0};
    struct document *document = scene_parse("walk", scene, sizeof scene - 1, NULL, &error);
    if (!document) fail_msg("%s", error.text);
    document->folder = strdup(folder);
    document_set_path(document, path);
    struct character_rig *rig = document_character(document, 0);
    rig->painted = paint_create(1, 8);
    assert_non_null(rig->painted);
    rig->painted->values[7][1] = mark;
    return document;
}

static void change(struct document *document, float mark)
{
    struct paint *paint = document_character(document, 0)->painted;
    paint->values[7][1] = mark;
    paint->version++;
}

static float saved_mark(const char *path)
{
    struct error error = {0};
    struct document *document = scene_load(path, NULL, &error);
    if (!document || !scene_read_paint(document, &error)) fail_msg("%s", error.text);
    const float mark = document_character(document, 0)->painted->values[7][1];
    document_destroy(document);
    return mark;
}

static const char precious[] = "2\n\"not a scene, and not ours\"";

static void try_one(const struct hostile *hostile)
{
    char path[128];
    struct error error = {0};
    snprintf(path, sizeof path, "%s", folder_path("walk.json"));
    write_text("precious.json", precious);
    struct document *document = painted(path, 1);
    if (!scene_save(document, path, &error)) fail_msg("%s: %s", hostile->what, error.text);
    write_text("walk-paint-7.npy", "left by a save that was killed");
    hostile->make();
    change(document, 2);
    const bool root = geteuid() == 0 && hostile->make == unreadable; // root may read everything
    if (root) assert_int_equal(chmod(folder, 0777) || seteuid(65534), 0);
    const bool saved = scene_save(document, path, &error);
    if (root) assert_int_equal(seteuid(0), 0);
    if (!saved) fail_msg("%s: %s", hostile->what, error.text);
    assert_near(saved_mark(path), 2, 0);
    if (is_there("walk-paint-7.npy") == hostile->removes)
        fail_msg("%s: walk-paint-7.npy is %s", hostile->what, hostile->removes ? "there" : "gone");
    if (is_there(list) != hostile->stays) fail_msg("%s: it is %s", hostile->what, hostile->stays ? "gone" : "there");
    char *data;
    size_t size;
    if (!file_read(folder_path("precious.json"), 100, &data, &size, &error)) fail_msg("%s", error.text);
    assert_string_equal(data, precious);
    free(data);
    document_destroy(document);
    if (locked >= 0) close(locked);
    locked = -1;
}

static void a_hostile_list_harms_nothing(void **state)
{
    for (size_t i = 0; i < sizeof hostiles / sizeof *hostiles; i++) {
        assert_int_equal(folder_make(state), 0);
        try_one(&hostiles[i]);
        folder_remove(state);
    }
}

/// A copy of the scene is the only one that names the old paint, and another program has written it: with escapes where ours has none.
static void paint_that_a_copy_names_stays(void **state)
{
    static const struct {
        const char *scene, *paint, *named;
    } copies[] = {{"walk.json", "walk-paint.npy", "walk-paint.npy"},
                  {"walk.json", "walk-paint.npy", ".\\/walk\\u002dpaint.npy"},
                  {"gähnen.json", "gähnen-paint.npy", "g\\u00e4hnen-paint.npy"},
                  {"a \"b\".json", "a \"b\"-paint.npy", "a \\\"b\\\"-paint.npy"},
                  {"𝄞.json", "𝄞-paint.npy", "\\ud834\\udd1e-paint.npy"}};
    for (size_t i = 0; i < sizeof copies / sizeof *copies; i++) {
        struct error error = {0};
        char path[128], text[512];
        assert_int_equal(folder_make(state), 0);
        snprintf(path, sizeof path, "%s", folder_path(copies[i].scene));
        struct document *document = painted(path, 1);
        if (!scene_save(document, path, &error)) fail_msg("%s", error.text);
        assert_true(is_there(copies[i].paint));
        snprintf(text, sizeof text,
                 "{\"wiggly\": 1, \"frames\": [0, 48], \"splines\": [{\"name\": \"s\", \"knots\": []}], \"rigs\": "
                 "[{\"type\": \"character\", "
                 "\"name\": \"c\", \"model\": \"m.glb\", \"paint\": \"%s\", \"coordinates\": [{\"name\": \"a\", "
                 "\"spline\": \"s\"}]}]}",
                 copies[i].named);
        write_text("copy.json", text);
        change(document, 2);
        if (!scene_save(document, path, &error)) fail_msg("%s", error.text);
        assert_near(saved_mark(path), 2, 0);
        assert_near(saved_mark(folder_path("copy.json")), 1, 0);
        document_destroy(document);
        folder_remove(state);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_hostile_list_harms_nothing),
        cmocka_unit_test(paint_that_a_copy_names_stays),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
