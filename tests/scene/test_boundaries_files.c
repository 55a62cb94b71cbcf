/// The limits of files, pictures, the clipboard and of names that are taken: what lies at each is taken, what lies one above it is refused with
/// a sentence. Large files are holes, which take no disk. And file systems that refuse rights, syncing, renaming or a name.

#include "app/personal.h"
#include "app/replay.h"
#include "base/file.h"
#include "base/png.h"
#include "blind.h"
#include "documents.h"
#include "folder.h"
#include "model/character.h"
#include "model/gltf.h"
#include "model/surface.h"
#include "questions.h"
#include "scene/load.h"
#include "scene/text.h"
#include <errno.h>
#include <fcntl.h>
#include <jansson.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#define FOLDER_TEST(name) TEST_WITH(folder_make, folder_remove, name)

static void says(const struct error *error, const char *fragment)
{
    if (!strstr(error->text, fragment)) fail_msg("\"%s\" does not say \"%s\"", error->text, fragment);
}

/// Begins a file that is a hole behind its first bytes.
static const char *hole(const char *name, const void *start, size_t length, size_t size)
{
    const char *path = folder_path(name);
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(start, 1, length, file), length);
    assert_int_equal(fclose(file), 0);
    assert_int_equal(truncate(path, (off_t)size), 0);
    return path;
}

static void assert_holds(const char *path, const char *text)
{
    size_t size;
    char *data;
    assert_done(file_read(path, 100, &data, &size, &error));
    assert_string_equal(data, text);
    free(data);
}

static char *filled(size_t size, char with, const char *start)
{
    char *text = malloc(size + 1);
    assert_non_null(text);
    memset(text, with, size);
    memcpy(text, start, strlen(start));
    text[size] = '\0';
    return text;
}

/// A file of 1 MiB.
FOLDER_TEST(settings_of_a_size)
{
    enum { MOST = 1 << 20 };
    for (size_t size = MOST - 1; size <= MOST + 1; size++) {
        struct error error;
        char *text = filled(size, ' ', "{\"theme\": \"dark\"}");
        struct settings *settings = settings_load(folder_file("settings", text), &error);
        const bool taken = size <= MOST;
        assert_int_equal(error.kind != ERROR_NONE, !taken);
        assert_int_equal(settings_get(settings, "theme") != NULL, taken);
        if (!taken) says(&error, "settings: expected at most 1 MiB, got a larger file");
        settings_free(settings);
        free(text);
    }
}

/// At 1 GiB they are read and refused for what they hold; that is not done here.
FOLDER_TEST(work_of_a_size)
{
    const size_t above = ((size_t)1 << 30) + 1;
    struct error error = {0};
    assert_null(paint_read(hole("paint.npy", "", 0, above), &error));
    says(&error, "paint.npy: expected at most 1024 MiB, got a larger file");
}

/// The pictures of an OBJ's materials: one of 256 MiB, and one of a byte more.
FOLDER_TEST(pictures_of_a_size)
{
    enum { MOST = 256 << 20 };
    static const char obj[] = "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n",
                      mtl[] = "newmtl a\nmap_Kd a.png\n", png[] = "\x89PNG\r\n\x1a\n";
    folder_file("a.mtl", mtl);
    folder_file("a.obj", obj);
    for (size_t size = MOST; size <= MOST + 1; size++) {
        struct surface surface;
        hole("a.png", png, strlen(png), size);
        assert_done(surface_read(folder_path("a.obj"), &surface, &error));
        const bool taken = size <= MOST;
        assert_int_equal(surface.looks.materials[0].image_size, taken ? size : 0);
        if (taken) assert_null(surface.looks.left_out);
        if (!taken) assert_string_equal(surface.looks.left_out, "a.png");
        surface_free(&surface);
    }
}

/// 16,384 pixels a side, read and written.
FOLDER_TEST(pictures_of_a_width)
{
    enum { MOST = 16384 };
    static const char gltf[] =
        "{'asset':{'version':'2.0'},'nodes':[{}],'images':[{'uri':'a.png'}],'textures':[{'source':0}],'materials':"
        "[{'pbrMetallicRoughness':{'baseColorTexture':{'index':0}}}]}";
    struct error error = {0};
    unsigned char *pixels = calloc(MOST + 1, 4);
    assert_non_null(pixels);
    folder_file("a.gltf", json(gltf));
    for (int width = MOST - 1; width <= MOST + 1; width++) {
        struct gltf model;
        char path[128];
        snprintf(path, sizeof path, "%s", folder_path("a.png"));
        assert_int_equal(png_write(path, width, 1, pixels, &error), width <= MOST);
        if (width > MOST) says(&error, "expected a picture of 1 to 16384 pixels a side, got 16385 × 1");
        int size;
        unsigned char *png = png_encode(&(struct png_picture){width, 1, 4, pixels}, PNG_FAST, &size);
        assert_true(file_write_atomic(path, png, (size_t)size, NULL));
        free(png);
        if (!gltf_read(folder_path("a.gltf"), &model, &error)) fail_msg("%s", error.text);
        assert_int_equal(model.image_count, width <= MOST);
        if (width <= MOST) assert_int_equal(model.images[0].width, width);
        if (width > MOST)
            assert_string_equal(model.not_shown,
                                "image a.png (expected PNG or JPEG of at most 16384 pixels a side: unknown)");
        gltf_free(&model);
    }
    free(pixels);
}

/// Reads a file of so many bytes, beside its text, whose nodes show a mesh of 4,095 vertices; where there is more, another node shows a
/// triangle.
static bool read_nodes(size_t bytes, int nodes, bool more, struct error *error)
{
    char start[1024];
    struct gltf gltf;
    struct text text = {0};
    hole("many.bin", "", 0, bytes);
    snprintf(start, sizeof start,
             "{'asset':{'version':'2.0'},'buffers':[{'uri':'many.bin','byteLength':%zu}],'bufferViews':[{'buffer':0,"
             "'byteLength':98316}],'accessors':[{'componentType':5126,'type':'VEC3','count':4095,'bufferView':0},"
             "{'componentType':5126,'type':'VEC3','count':3,'bufferView':0}],'meshes':[{'primitives':[{'attributes':"
             "{'POSITION':0}}]},{'primitives':[{'attributes':{'POSITION':1}}]}],'nodes':[",
             bytes);
    text_string(&text, json(start));
    for (int i = 0; i < nodes; i++) text_string(&text, i ? ",{\"mesh\":0}" : "{\"mesh\":0}");
    text_string(&text, more ? ",{\"mesh\":1}]}" : "]}");
    assert_true(file_write_atomic(folder_path("many.gltf"), text.data, text.size, error));
    free(text.data);
    if (!gltf_read(folder_path("many.gltf"), &gltf, error)) return false;
    gltf_free(&gltf);
    return true;
}

/// 2^24 − 1 vertices together, and with another triangle 2^24 + 2; triangles have three. In a small file 2^23 and 32 for each of its bytes.
FOLDER_TEST(vertices_of_a_model)
{
    struct error error = {0};
    if (!is_thorough()) skip();
    if (!read_nodes(2 << 20, 4097, false, &error)) fail_msg("%s", error.text);
    assert_false(read_nodes(2 << 20, 4097, true, &error));
    says(&error, "nodes: expected at most 16777216 vertices together, got 16777218");
    error = (struct error){0};
    if (!read_nodes(98316, 2800, false, &error)) fail_msg("%s", error.text);
    assert_false(read_nodes(98316, 3200, false, &error));
    says(&error, " vertices together in a file of this size, got 13104000");
}

/// Coordinates that move no vertex take no byte of the file: a small one has few.
FOLDER_TEST(vertices_of_a_character)
{
    enum { VERTICES = 1 << 18, BYTES = 12 * VERTICES, FEW = 8 };
    for (int coordinates = FEW; coordinates <= 8 * FEW; coordinates *= 8) {
        struct character character;
        struct error error;
        struct text text = {0};
        text_bytes(&text, "....................", 20);
        text_string(&text,
                    json("{'asset':{'version':'2.0'},'buffers':[{'byteLength':3145728}],'bufferViews':[{'buffer':0,"
                         "'byteLength':3145728}],'accessors':[{'componentType':5126,'type':'VEC3','count':262144,"
                         "'bufferView':0}],'meshes':[{'primitives':[{'attributes':{'POSITION':0},'targets':[{}"));
        for (int i = 0; i < coordinates; i++) text_string(&text, ",{}");
        text_string(&text, json("]}],'extras':{'targetNames':['a.im'"));
        for (int i = 0; i < coordinates; i++) text_string(&text, ",\"a.re\"");
        text_string(&text, json("]}}],'nodes':[{'mesh':0}]}"));
        while (text.size % 4) text_string(&text, " ");
        const uint32_t json = (uint32_t)text.size - 20, chunk[2] = {BYTES, 0x004E4942},
                       header[5] = {0x46546C67, 2, (uint32_t)text.size + 8 + BYTES, json, 0x4E4F534A};
        memcpy(text.data, header, sizeof header);
        text_bytes(&text, (const char *)chunk, sizeof chunk);
        const char *path = hole("a.glb", text.data, text.size, text.size + BYTES);
        assert_int_equal(character_read(path, &character, &error), coordinates == FEW);
        if (coordinates > FEW) says(&error, " vertices in a file of this size, got 64 times 262144");
        character_free(&character);
        free(text.data);
    }
}

/// 16 MiB of text on the clipboard.
FOLDER_TEST(text_on_the_clipboard)
{
    enum { MOST = 16 << 20 };
    struct blind blind;
    blind_open(&blind, NULL);
    for (size_t size = MOST - 1; size <= MOST + 1; size++) {
        char *text = filled(size, '#', "0,1\n");
        platform_set_clipboard(blind.app.platform, text);
        blind.app.paste = true;
        blind_frame(&blind);
        assert_int_equal(strstr(said(blind.app.work.editor), "more than 16 MB") == NULL, size <= MOST);
        free(text);
    }
    blind_close(&blind);
}

static bool place(void *user, const char *target, float *x, float *y, struct error *error)
{
    (void)user, (void)target, (void)error;
    *x = *y = 9;
    return true;
}

#define REPLAY(size, rest) "wiggly-replay 1\nsize " size "\nscale 1\n" rest

/// What is refused is refused with its line.
FOLDER_TEST(lines_of_a_replay)
{
    static const struct {
        const char *text, *says; ///< NULL: taken
    } rows[] = {
        {REPLAY("63 63", "frames 9\n"), "r:2: expected a width and a height from 64 to 16384"},
        {REPLAY("64 64", "frames 9\n"), NULL},
        {REPLAY("16384 16384", "frames 9\n"), NULL},
        {REPLAY("16385 16385", "frames 9\n"), "r:2: expected a width and a height from 64 to 16384"},
        {REPLAY("640 480", "frames 9999999\n"), NULL},
        {REPLAY("640 480", "frames 10000000\n9999999 close\n"), NULL},
        {REPLAY("640 480", "frames 10000001\n"), "r:4: expected a number of frames up to 10000000, got \"10000001\""},
        {REPLAY("640 480", "frames 0\n9999999 close\n"), NULL}, // one that was cut short
        {REPLAY("640 480", "frames 0\n10000000 close\n"), "r:5: expected an event in a frame from 0 to 9999999"},
        {REPLAY("640 480", "frames 0\n99999999999999999999 close\n"), "r:5: expected an event in a frame from 0 to"},
        {"hello\n", "r:1: expected \"wiggly-replay 1\", got \"hello\""},
        {"\f\f\n", "expected \"wiggly-replay 1\""},
        {"wiggly-replay 1\n\v\n", "expected a header with size and frames"},
#define LINE(text) REPLAY("640 480", "frames 1200\n" text "\n")
        {LINE("5 key A\n3 key B"), "r:6: expected an event in a frame from 5 to 1199, got \"3\""},
        {LINE("1200 key A"), "r:5: expected an event in a frame from 0 to 1199, got \"1200\""},
        {LINE("99999999999999999999 key A"), "r:5: expected an event in a frame"},
        {LINE("5 key"), "r:5: expected the name of a key, got the end of the line"},
        {LINE("5 wheel 0 1e39 100 100"), "r:5: expected a number, got \"1e39\""},
        {LINE("5 pointer @knot(sway,2)+1e39,0"),
         "r:5: expected an offset such as +4,-3 behind the target, got \"+1e39,0\""},
        {LINE("5 close now"), "r:5: expected the end of the line, got \"now\""},
        {LINE("5 size 0 0"), "r:5: expected a width and a height from 64"},
        {LINE("5 paste"), "r:5: expected a text, got the end of the line"},
        {LINE("5 size 64 64\r\n  \n\t\n9 wheel 0 1 400 500 shift ctrl alt super"), NULL},
#undef LINE
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        struct error error = {0};
        struct event event;
        struct replay *replay = replay_parse("r", rows[i].text, strlen(rows[i].text), &error);
        for (long frame = 0; replay && frame < 20; frame++)
            while (replay_next(replay, frame, place, NULL, &event, &error)) continue;
        if (!rows[i].says) assert_int_equal(error.kind, ERROR_NONE);
        if (rows[i].says) says(&error, rows[i].says);
        replay_destroy(replay);
    }
    assert_refusal(replay_parse("r", "wiggly-replay 1\0\n", 17, &error) != NULL, "r: expected text, got a NUL byte");
}

/// A letter beyond what is kept of a field of CSV would change its number without a word.
FOLDER_TEST(letters_of_a_number)
{
    for (int zeros = 58; zeros <= 60; zeros++) {
        char text[128];
        struct knot_list list;
        struct error error = {0};
        snprintf(text, sizeof text, "0,1.%0*de5,2\n", zeros, 0);
        const bool good = knots_parse("c", text, &list, &error);
        assert_int_equal(good, zeros + 4 <= 63);
        if (!good) says(&error, "c:1: expected a value or still after the frame");
        if (!good) continue;
        assert_near(list.knots[0].value, 1e5, 0);
        knot_list_free(&list);
    }
}

static int warned, last_warning;

static void count_warning(void *user, bool is_error, const char *sentence)
{
    (void)user;
    warned += !is_error;
    last_warning += strstr(sentence, "further unknown keys are kept silently") != NULL;
}

FOLDER_TEST(unknown_keys)
{
    for (int keys = 63; keys <= 65; keys++) {
        char text[2048], *end = text + sprintf(text, "{'wiggly': 1, 'frames': [0, 1]");
        struct problems problems = {.report = count_warning};
        for (int i = 0; i < keys; i++) end += sprintf(end, ", 'x%d': 1", i);
        sprintf(end, "}");
        warned = last_warning = 0;
        struct document *document = scene_parse("s", json(text), strlen(text), &problems, NULL);
        assert_non_null(document);
        assert_int_equal(warned, keys < 64 ? keys : 64);
        assert_int_equal(last_warning, keys >= 64);
        assert_int_equal(json_object_size(document->extra), keys);
        document_destroy(document);
    }
}

static void take_names(const char *format, int from, int to)
{
    for (int i = from; i <= to; i++) {
        char name[64];
        snprintf(name, sizeof name, format, i); // NOLINT: formats of this file
        hole(name, "", 0, 0);
    }
}

/// The temporary files of a save: this process has written a hundred there already.
FOLDER_TEST(names_of_temporary_files)
{
    struct error error = {0};
    char format[64];
    snprintf(format, sizeof format, ".wiggly-%ld-%%d.tmp", (long)getpid());
    take_names(format, 0, 98);
    assert_true(file_write_atomic(folder_path("a"), "1", 1, &error));
    take_names(format, 99, 99);
    assert_false(file_write_atomic(folder_path("a"), "2", 1, &error));
    says(&error, "/a: cannot be written: File exists");
    assert_holds(folder_path("a"), "1");
}

// --- file systems that refuse

enum call { NONE, FSYNC, FCHMOD, RENAME };

static struct {
    enum call call;
    int error;
} refused;

static int answer(enum call call, long done)
{
    if (refused.call != call) return (int)done;
    errno = refused.error;
    return -1;
}

// In place of libc's.
int fsync(int file) { return answer(FSYNC, syscall(SYS_fsync, file)); }
int fchmod(int file, mode_t mode)
{
    return answer(FCHMOD, refused.call == FCHMOD ? 0 : syscall(SYS_fchmod, file, mode));
}
int rename(const char *from, const char *to)
{
    return answer(RENAME, refused.call == RENAME ? 0 : syscall(SYS_renameat2, AT_FDCWD, from, AT_FDCWD, to, 0));
}

/// Writes where a call fails; the file holds the new text or the old one, and nothing is left beside it.
static bool write_refused(const char *name, enum call call, int number, const char *old, struct error *error)
{
    refused.call = call, refused.error = number;
    const bool is_saved = file_write_atomic(folder_path(name), "new", 3, error);
    refused.call = NONE;
    if (is_saved || old) assert_holds(folder_path(name), is_saved ? "new" : old);
    char command[128];
    snprintf(command, sizeof command, "ls -A %s | grep -v '^%s$'", folder, name);
    assert_int_not_equal(system(command), 0);
    return is_saved;
}

FOLDER_TEST(rights_and_syncing)
{
    static const struct {
        enum call call;
        int error;
        bool is_saved;
    } rows[] = {
        {FSYNC, EINVAL, true},  {FSYNC, ENOSYS, true},      {FSYNC, ENOTSUP, true}, {FSYNC, EPERM, true},
        {FSYNC, EIO, false},    {FSYNC, ENOSPC, false},     {FCHMOD, EPERM, true},  {FCHMOD, ENOSYS, true},
        {FCHMOD, EINVAL, true}, {FCHMOD, EOPNOTSUPP, true}, {FCHMOD, EIO, false},   {RENAME, EPERM, false},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        struct error error = {0};
        struct stat about;
        const char *path = folder_file("scene", "old");
        assert_int_equal(chmod(path, 0666), 0);
        const bool is_saved = write_refused("scene", rows[i].call, rows[i].error, "old", &error);
        if (is_saved != rows[i].is_saved) fail_msg("row %zu: %s", i, error.text);
        assert_int_equal(stat(path, &about), 0);
        assert_int_equal(about.st_mode & 0777, rows[i].call == FCHMOD && is_saved ? 0600 : 0666);
    }
    struct error error = {0};
    assert_int_equal(unlink(folder_path("scene")), 0);
    assert_true(write_refused("scene", RENAME, EPERM, NULL, &error)); // a new file needs no renaming
}

// --- scenes that are rescued

/// Opens a scene of this name and edits it.
static void open_and_edit(struct blind *blind, const char *name)
{
    char path[400];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    const char *scene = json("{'wiggly': 1, 'frames': [0, 48], 'splines': [{'name': 's', 'knots': []}]}");
    assert_done(file_write_atomic(path, scene, strlen(scene), &error));
    blind_open(blind, path);
    blind_frame(blind);
    blind_key(blind, 'I', 0);
    assert_false(history_is_saved(blind->app.work.history));
}

/// Lets the program end, and finds the work in a new folder of the home folder.
static void assert_rescued(struct blind *blind, enum call call)
{
    struct error error = {0};
    char path[256];
    refused.call = call, refused.error = EPERM;
    fail(&error, ERROR_ENVIRONMENT, "the end");
    app_rescue(&blind->app, &error);
    refused.call = NONE;
    const char *place = strstr(error.text, folder_path("home/wiggly-recovered-"));
    assert_non_null(place);
    assert_int_equal(sscanf(place, "%255[^:]", path), 1);
    struct document *document = document_of_file(path);
    assert_int_equal(document->splines[0]->knot_count, 1);
    document_destroy(document);
}

/// As often as it happens, also where no file can be renamed.
FOLDER_TEST(scenes_are_rescued_to_new_folders)
{
    char *home = getenv("HOME") ? strdup(getenv("HOME")) : NULL;
    struct blind blind;
    assert_int_equal(mkdir(folder_path("home"), 0700), 0);
    assert_int_equal(setenv("HOME", folder_path("home"), 1), 0);
    open_and_edit(&blind, "walk.json");
    assert_rescued(&blind, RENAME);
    assert_rescued(&blind, NONE);
    blind_close(&blind);
    folder_run("test $(ls %s/home/wiggly-recovered-*/untitled.json | wc -l) = 2");
    if (home) setenv("HOME", home, 1);
    free(home);
}
