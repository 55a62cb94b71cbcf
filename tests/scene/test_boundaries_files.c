/// The limits of files, pictures, the clipboard and of names that are taken: what lies at each is taken, what lies one above it is refused with
/// a sentence. Large files are holes, which take no disk.

#include "app/recovery.h"
#include "app/replay.h"
#include "app/settings.h"
#include "base/file.h"
#include "base/png.h"
#include "blind.h"
#include "folder.h"
#include "model/character.h"
#include "model/gltf.h"
#include "model/surface.h"
#include "questions.h"
#include "scene/knots.h"
#include "scene/load.h"
#include "scene/paint.h"
#include "scene/text.h"
#include <jansson.h>
#include <sys/stat.h>
#include <unistd.h>

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

static char *filled(size_t size, char with)
{
    char *text = malloc(size + 1);
    assert_non_null(text);
    memset(text, with, size);
    text[size] = '\0';
    return text;
}

/// A file of 1 MiB.
TEST_WITH(folder_make, folder_remove, settings_of_a_size)
{
    enum { MOST = 1 << 20 };
    for (size_t size = MOST - 1; size <= MOST + 1; size++) {
        struct error error;
        char *text = filled(size, ' ');
        memcpy(text, "{\"theme\": \"dark\"}", 17);
        assert_true(file_write_atomic(folder_path("settings"), text, size, &error));
        struct settings *settings = settings_load(folder_path("settings"), &error);
        const bool taken = size <= MOST;
        assert_int_equal(error.kind != ERROR_NONE, !taken);
        assert_int_equal(settings_get(settings, "theme") != NULL, taken);
        if (!taken) says(&error, "settings: expected at most 1 MiB, got a larger file");
        settings_free(settings);
        free(text);
    }
}

/// At 1 GiB they are read and refused for what they hold; that is not done here.
TEST_WITH(folder_make, folder_remove, work_of_a_size)
{
    const size_t above = ((size_t)1 << 30) + 1;
    struct error error = {0};
    assert_null(paint_read(hole("paint.npy", "", 0, above), &error));
    says(&error, "paint.npy: expected at most 1024 MiB, got a larger file");
}

/// The pictures of an OBJ's materials: one of 256 MiB, and one of a byte more.
TEST_WITH(folder_make, folder_remove, pictures_of_a_size)
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

static void store(void *user, const void *bytes, size_t size)
{
    assert_true(file_write_atomic(user, bytes, size, NULL));
}

/// 16,384 pixels a side, read and written.
TEST_WITH(folder_make, folder_remove, pictures_of_a_width)
{
    enum { MOST = 16384 };
    static const char gltf[] = "{\"asset\":{\"version\":\"2.0\"},\"nodes\":[{}],\"images\":[{\"uri\":\"a.png\"}],"
                               "\"textures\":[{\"source\":0}],\"materials\":[{\"pbrMetallicRoughness\":"
                               "{\"baseColorTexture\":{\"index\":0}}}]}";
    struct error error = {0};
    unsigned char *pixels = calloc(MOST + 1, 4);
    assert_non_null(pixels);
    folder_file("a.gltf", gltf);
    for (int width = MOST - 1; width <= MOST + 1; width++) {
        struct gltf model;
        char path[128];
        snprintf(path, sizeof path, "%s", folder_path("a.png"));
        assert_int_equal(png_write(path, width, 1, pixels, &error), width <= MOST);
        if (width > MOST) says(&error, "expected a picture of 1 to 16384 pixels a side, got 16385 × 1");
        png_encode(store, path, &(struct png_picture){width, 1, 4, pixels}, PNG_FAST);
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
    char path[128];
    struct gltf gltf;
    struct text text = {0};
    snprintf(path, sizeof path, "%s", folder_path("many.gltf"));
    hole("many.bin", "", 0, bytes);
    text_string(&text, "{\"asset\":{\"version\":\"2.0\"},\"buffers\":[{\"uri\":\"many.bin\",\"byteLength\":");
    text_number(&text, (double)bytes);
    text_string(&text, "}],\"bufferViews\":[{\"buffer\":0,\"byteLength\":98316}],\"accessors\":["
                       "{\"componentType\":5126,\"type\":\"VEC3\",\"count\":4095,\"bufferView\":0},"
                       "{\"componentType\":5126,\"type\":\"VEC3\",\"count\":3,\"bufferView\":0}],\"meshes\":["
                       "{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]},"
                       "{\"primitives\":[{\"attributes\":{\"POSITION\":1}}]}],\"nodes\":[");
    for (int i = 0; i < nodes; i++) text_string(&text, i ? ",{\"mesh\":0}" : "{\"mesh\":0}");
    text_string(&text, more ? ",{\"mesh\":1}]}" : "]}");
    assert_true(file_write_atomic(path, text.data, text.size, error));
    free(text.data);
    if (!gltf_read(path, &gltf, error)) return false;
    gltf_free(&gltf);
    return true;
}

/// 2^24 − 1 vertices together, and with another triangle 2^24 + 2; triangles have three. In a small file 2^23 and 32 for each of its bytes.
TEST_WITH(folder_make, folder_remove, vertices_of_a_model)
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
TEST_WITH(folder_make, folder_remove, vertices_of_a_character)
{
    enum { VERTICES = 1 << 18, BYTES = 12 * VERTICES, FEW = 8 };
    for (int coordinates = FEW; coordinates <= 8 * FEW; coordinates *= 8) {
        struct character character;
        struct error error;
        struct text text = {0};
        text_bytes(&text, "....................", 20);
        text_string(
            &text,
            "{\"asset\":{\"version\":\"2.0\"},\"buffers\":[{\"byteLength\":3145728}],"
            "\"bufferViews\":[{\"buffer\":0,\"byteLength\":3145728}],"
            "\"accessors\":[{\"componentType\":5126,\"type\":\"VEC3\",\"count\":262144,"
            "\"bufferView\":0}],\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"targets\":[{}");
        for (int i = 0; i < coordinates; i++) text_string(&text, ",{}");
        text_string(&text, "]}],\"extras\":{\"targetNames\":[\"a.im\"");
        for (int i = 0; i < coordinates; i++) text_string(&text, ",\"a.re\"");
        text_string(&text, "]}}],\"nodes\":[{\"mesh\":0}]}");
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
TEST_WITH(folder_make, folder_remove, text_on_the_clipboard)
{
    enum { MOST = 16 << 20 };
    struct blind blind;
    blind_open(&blind, NULL);
    for (size_t size = MOST - 1; size <= MOST + 1; size++) {
        char *text = filled(size, '#');
        memcpy(text, "0,1\n", 4);
        platform_set_clipboard(blind.app.platform, text);
        const char *taken = app_clipboard_text(&blind.app);
        assert_int_equal(taken != NULL, size <= MOST);
        if (!taken) assert_said(blind.app.work.editor, "more than 16 MB");
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
TEST_WITH(folder_make, folder_remove, lines_of_a_replay)
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
TEST_WITH(folder_make, folder_remove, letters_of_a_number)
{
    for (int zeros = 58; zeros <= 60; zeros++) {
        char text[128];
        struct knot_list list;
        struct error error = {0};
        snprintf(text, sizeof text, "0,1.%.*se5,2\n", zeros,
                 "000000000000000000000000000000000000000000000000000000000000");
        const int letters = zeros + 4;
        const bool good = knots_parse("c", text, &list, &error);
        assert_int_equal(good, letters <= 63);
        if (good) assert_near(list.knots[0].value, 1e5, 0);
        if (!good) says(&error, "c:1: expected a value or still after the frame");
        if (good) knot_list_free(&list);
    }
}

static int warned, last_warning;

static void count_warning(void *user, bool is_error, const char *sentence)
{
    (void)user;
    warned += !is_error;
    last_warning += strstr(sentence, "further unknown keys are kept silently") != NULL;
}

TEST_WITH(folder_make, folder_remove, unknown_keys)
{
    for (int keys = 63; keys <= 65; keys++) {
        struct text text = {0};
        struct problems problems = {.report = count_warning};
        text_string(&text, "{\"wiggly\": 1, \"frames\": [0, 1]");
        for (int i = 0; i < keys; i++) {
            char member[32];
            snprintf(member, sizeof member, ", \"x%d\": 1", i);
            text_string(&text, member);
        }
        text_string(&text, "}");
        warned = last_warning = 0;
        struct document *document = scene_parse("s", text.data, text.size, &problems, NULL);
        assert_non_null(document);
        assert_int_equal(warned, keys < 64 ? keys : 64);
        assert_int_equal(last_warning, keys >= 64);
        assert_int_equal(json_object_size(document->extra), keys);
        document_destroy(document);
        free(text.data);
    }
}

static void take_name(const char *format, int number)
{
    char name[64];
    snprintf(name, sizeof name, format, number);
    hole(name, "", 0, 0);
}

/// The temporary files of a save: this process has written a hundred there already.
TEST_WITH(folder_make, folder_remove, names_of_temporary_files)
{
    struct error error = {0};
    char format[64];
    snprintf(format, sizeof format, ".wiggly-%ld-%%d.tmp", (long)getpid());
    for (int i = 0; i < 99; i++) take_name(format, i);
    assert_true(file_write_atomic(folder_path("a"), "1", 1, &error));
    take_name(format, 99);
    assert_false(file_write_atomic(folder_path("a"), "2", 1, &error));
    says(&error, "/a: cannot be written: File exists");
    size_t size;
    char *data;
    assert_true(file_read(folder_path("a"), 10, &data, &size, &error));
    assert_string_equal(data, "1");
    free(data);
}

/// Rescued scenes beside the scene's own file; with a thousand there, the next goes to the home folder.
TEST_WITH(folder_make, folder_remove, names_of_rescued_scenes)
{
    static const char scene[] =
        "{\"wiggly\": 1, \"frames\": [0, 48], \"splines\": [{\"name\": \"s\", \"knots\": []}]}";
    char *home = getenv("HOME") ? strdup(getenv("HOME")) : NULL, own[80];
    struct error error = {0};
    struct blind blind;
    snprintf(own, sizeof own, "%s/home", folder);
    assert_int_equal(mkdir(own, 0700), 0);
    assert_int_equal(setenv("HOME", own, 1), 0);
    folder_file("walk.json", scene);
    blind_open(&blind, folder_path("walk.json"));
    blind_frame(&blind);
    blind_send(&blind, (struct event){.kind = EVENT_KEY, .key = 'I', .action = ACTION_PRESS});
    blind_frame(&blind);
    assert_false(history_is_saved(blind.app.work.history));
    hole("walk.recovered.json", "", 0, 0);
    for (int i = 2; i <= 999; i++) take_name("walk.recovered-%d.json", i);
    fail(&error, ERROR_ENVIRONMENT, "the end");
    app_rescue(&blind.app, &error);
    says(&error, "/walk.recovered-1000.json: open it to continue");
    fail(&error, ERROR_ENVIRONMENT, "the end");
    app_rescue(&blind.app, &error);
    says(&error, "/home/walk.recovered.json: open it to continue");
    blind_close(&blind);
    if (home) setenv("HOME", home, 1);
    free(home);
}
