/// What is written, and what is said, where the JSON library runs out of memory: at each allocation once, and from each on.
#include "base/file.h"
#include "base/json.h"
#include "export_scene.h"
#include "model/character.h"
#include "puppet.h"

/// A fox of three joints; it once more with a chain, as an imported character of two files.
static const char fox_text[] =
    "{\"wiggly\": 1, \"frames\": [0, 4], \"splines\": [{\"name\": \"s\", \"frequency\": 1, \"knots\": [{\"frame\": "
    "0, "
    "\"value\": 1}]}], \"rigs\": [{\"type\": \"tail\", \"name\": \"tail\", \"joints\": 3, \"spline\": \"s\"}]}";
static const char chain_text[] =
    "{\"wiggly\": 1, \"frames\": [0, 4], \"splines\": [{\"name\": \"s\", \"frequency\": 1, \"knots\": [{\"frame\": "
    "0, "
    "\"value\": 2}]}], \"rigs\": [{\"type\": \"model\", \"name\": \"fox\", \"model\": \"fox.gltf\", \"clip\": "
    "\"fox\"}, {\"type\": \"chain\", \"name\": \"end\", \"model\": \"fox\", \"from\": \"tail_1\", \"to\": "
    "\"tail_2\", "
    "\"channels\": [{\"spline\": \"s\"}]}]}";
static const char soft_text[] =
    "{\"wiggly\": 1, \"frames\": [0, 4], \"splines\": [{\"name\": \"s\", \"frequency\": 1, \"knots\": [{\"frame\": "
    "0, "
    "\"value\": 1}]}], \"rigs\": [{\"type\": \"character\", \"name\": \"ball\", \"model\": \"ball.glb\", "
    "\"coordinates\": [{\"name\": \"a\", \"spline\": \"s\"}]}]}";

static long calls, fails_at;
static bool goes_on; ///< failing

static void *stingy(size_t size)
{
    const bool fails = goes_on ? calls >= fails_at : calls == fails_at;
    calls++;
    return fails ? NULL : malloc(size);
}

/// A run with memory for only so many calls.
typedef bool run(void *user, struct error *error);

static bool run_short(run *made, void *user, long at, bool forever, struct error *error)
{
    calls = 0;
    fails_at = at;
    goes_on = forever;
    json_read_with(stingy);
    const bool done = made(user, error);
    json_read_with(NULL);
    return done;
}

/// Lets `made` fail at each `step`th of its calls, once and for good. What it writes to `path` is the same as ever, or nothing, and the error is about memory.
static void starve(run *made, void *user, const char *path, long step)
{
    struct error error = {0};
    size_t size, expected_size;
    int refused = 0;
    if (!run_short(made, user, -1, false, &error)) fail_msg("%s", error.text);
    const long all = calls;
    char *expected = bytes_of(path, &expected_size);
    const int files = files_in_folder();
    for (long n = 0; n < 2 * (all / step); n++) {
        remove(path);
        error.text[0] = '\0';
        if (run_short(made, user, n / 2 * step, n % 2, &error)) {
            char *bytes = bytes_of(path, &size);
            assert_int_equal(size, expected_size);
            assert_memory_equal(bytes, expected, size);
            free(bytes);
            continue;
        }
        refused++;
        if (!strstr(error.text, "memory")) fail_msg("call %ld of %ld: %s", n / 2 * step, all, error.text);
        assert_int_equal(files_in_folder(), files - 1); // nor a temporary one
    }
    if (refused < all / step) fail_msg("%d refusals in 2 x %ld calls", refused, all / step);
    free(expected);
    assert_true(made(user, &error)); // for who comes next
}

static void write_text(const char *name, const char *text)
{
    struct error error;
    assert_true(file_write_atomic(folder_path(name), text, strlen(text), &error));
}

struct exported {
    struct opened scene;
    char path[128];
};

static bool export_it(void *user, struct error *error)
{
    struct exported *exported = user;
    struct export_report report;
    const struct export_options usual = {0};
    return export_write(posing_of(&exported->scene), exported->path, &usual, &report, error);
}

static void starve_export(const char *scene, const char *text, const char *name, long step)
{
    struct exported exported;
    write_text(scene, text);
    snprintf(exported.path, sizeof exported.path, "%s/%s", folder, name);
    exported.scene = open_scene(folder_path(scene));
    starve(export_it, &exported, exported.path, step);
    close_scene(&exported.scene);
}

static bool write_character(void *user, struct error *error)
{
    return character_write(folder_path("ball.glb"), user, true, error);
}

static void exports_are_whole_or_not_there(void **state)
{
    (void)state;
    struct character ball = puppet_character(0.3f, 1);
    starve(write_character, &ball, folder_path("ball.glb"), 1);
    character_free(&ball);
    starve_export("soft.json", soft_text, "soft.glb", 1);
    starve_export("fox.json", fox_text, "fox.gltf", 29);
}

/// One that came as .gltf gets its clip there, and is gathered into a .glb.
static void so_are_files_of_others_with_a_clip_more(void **state)
{
    (void)state;
    starve_export("chain.json", chain_text, "chain.gltf", 41);
    starve_export("chain.json", chain_text, "chain.glb", 41);
}

/// A whole file that cannot be read for want of memory is not called broken.
static void reading_says_that_memory_is_short(void **state)
{
    (void)state;
    struct error error;
    struct character character;
    const char *path = folder_path("ball.glb");
    for (long at = 0;; at++) {
        calls = 0;
        fails_at = at;
        json_read_with(stingy);
        const bool done = character_read(path, &character, &error);
        json_read_with(NULL);
        if (done) break;
        if (!strstr(error.text, "memory")) fail_msg("call %ld: %s", at, error.text);
    }
    assert_int_equal(character.coordinate_count, 1);
    character_free(&character);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(exports_are_whole_or_not_there),
        cmocka_unit_test(so_are_files_of_others_with_a_clip_more),
        cmocka_unit_test(reading_says_that_memory_is_short),
    };
    return cmocka_run_group_tests(tests, folder_make, folder_remove);
}
