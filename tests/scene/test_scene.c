/// Documents: what is loaded, printed, warned of and saved.
#include "documents.h"
#include "folder.h"

#include "base/names.h"
#include "scene/edit.h"
#include "scene/load.h"
#include "scene/text.h"
#include <dirent.h>
#include <sys/stat.h>
#include <unistd.h>

enum { PATH_SIZE = 512, HEARD_SIZE = 2048 };

// --- numbers

TEST(numbers_are_short)
{
    static const struct {
        double value;
        const char *text;
    } rows[] = {
        {0, "0"},
        {-0.0, "0"},
        {1, "1"},
        {-24, "-24"},
        {120, "120"},
        {1000000, "1000000"},
        {123456789012345, "123456789012345"},
        {1e15, "1e15"},
        {0.1, "0.1"},
        {0.1 + 0.2, "0.30000000000000004"},
        {-1.5, "-1.5"},
        {21.49, "21.49"},
        {0.00001, "0.00001"},
        {0.000001, "1e-6"},
        {1.25e-7, "1.25e-7"},
        {1e22, "1e22"},
        {1.7976931348623157e308, "1.7976931348623157e308"},
        {2.2250738585072014e-308, "2.2250738585072014e-308"},
        {5e-324, "5e-324"},
        {9007199254740992, "9.007199254740992e15"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        char text[NUMBER_TEXT_SIZE];
        assert_int_equal(number_print(rows[i].value, text), strlen(rows[i].text));
        assert_string_equal(text, rows[i].text);
    }
}

/// Random bit patterns: every exponent is as likely, subnormals and the neighbours of powers of two among them.
TEST(numbers_read_back)
{
    srand(7);
    for (int i = 0; i < 200000; i++) {
        uint64_t bits = 0;
        for (int k = 0; k < 4; k++) bits = bits << 16 ^ (uint64_t)(unsigned)rand();
        if (i % 4 == 0) bits &= ~(uint64_t)0 << 52;
        double value;
        memcpy(&value, &bits, sizeof value);
        if (!isfinite(value)) continue;
        char text[NUMBER_TEXT_SIZE], shorter[PATH_SIZE];
        size_t digits = 0, length = number_print(value, text);
        assert_true(length < NUMBER_TEXT_SIZE);
        if (strtod(text, NULL) != value) fail_msg("%.17g was written as %s", value, text);
        for (const char *c = text; *c && *c != 'e'; c++) digits += *c >= '0' && *c <= '9';
        if (digits < 2 || fabs(value) < 1 || fabs(value) >= 1e15 || text[length - 1] == '0') continue;
        snprintf(shorter, sizeof shorter, "%.*g", (int)digits - 1, value);
        if (strtod(shorter, NULL) == value) fail_msg("%s could be %s", text, shorter);
    }
}

// --- load and print

static const char head[] = "{\n  'wiggly': 1,\n  'fps': 24,\n  'substeps': 1,\n  'frames': ";

/// Scenes, and what is printed behind the frames.
static const struct printed {
    const char *scene, *frames, *rest;
} printed[] = {
    {"{'frames': [-3, -3]}", "[-3, -3]", "  'splines': [],\n  'rigs': []\n}\n"},
    // defaults
    {"{'frames': [0, 120], 'splines': [{'name': 'x', 'knots': [{'frame': 3, 'value': 2}]}], 'rigs': [{'type': "
     "'tail', "
     "'name': 't', 'spline': 'x'}]}",
     "[0, 120]",
     "  'splines': [\n    {\n      'name': 'x',\n      'mode': 'complex',\n      'frequency': 0,\n      'damping': "
     "0,\n"
     "      'bandwidth': 0.1,\n      'calm': 1,\n      'equilibrium': 0,\n      'start': 'free',\n      'knots': [\n"
     "        { 'frame': 3, 'value': 2 }\n      ]\n    }\n  ],\n  'rigs': [\n    {\n      'type': 'tail',\n"
     "      'name': 't',\n      'joints': 24,\n      'length': 1.6,\n      'position': [0, 0, 0],\n      'rest': 0,\n"
     "      'channels': [\n        { 'spline': 'x', 'axis': 'side', 'lag': 6.5, 'gain': 5 }\n      ]\n    }\n  "
     "]\n}\n"},
    // unknown keys stay, wherever they are, behind the known ones and in their own order; those named like parameters as well
    {"{'z': [1, 2.50, {'k': null}, []], 'frames': [0, 9], 'a': 9007199254740993, 'splines': [\n{'name': "
     "'q\\\"\\\\\\u0001\\u00e9', 'mode': 'real', 'note': true, 'frequency': {'by': 'me', 'spline': 'w'}, 'knots': "
     "[{'frequency': {}, 'value': 1, 'frame': 2}]}, {'name': 'w', 'mode': 'cubic'}], 'rigs': [{'type': 'tail', "
     "'name': "
     "'t', 'color': 'red', 'channels': [{'u': 1, 'spline': 'w'}]}]}",
     "[0, 9]",
     "  'splines': [\n    {\n      'name': 'q\\\"\\\\\\u0001é',\n      'mode': 'real',\n"
     "      'frequency': { 'spline': 'w', 'by': 'me' },\n      'damping': 0,\n      'calm': 1,\n"
     "      'equilibrium': 0,\n      'start': 'free',\n      'knots': [\n"
     "        { 'frame': 2, 'value': 1, 'frequency': {} }\n      ],\n      'note': true\n    },\n"
     "    {\n      'name': 'w',\n      'mode': 'cubic',\n      'equilibrium': 0,\n"
     "      'start': 'free',\n      'knots': []\n    }\n  ],\n  'rigs': [\n    {\n"
     "      'type': 'tail',\n      'name': 't',\n      'joints': 24,\n      'length': 1.6,\n"
     "      'position': [0, 0, 0],\n      'rest': 0,\n      'channels': [\n"
     "        { 'spline': 'w', 'axis': 'side', 'lag': 6.5, 'gain': 5, 'u': 1 }\n      ],\n"
     "      'color': 'red'\n    }\n  ],\n"
     "  'z': [1, 2.5, { 'k': null }, []],\n  'a': 9007199254740993\n}\n"},
};

TEST(what_is_printed)
{
    for (size_t i = 0; i < sizeof printed / sizeof *printed; i++) {
        char expected[4096];
        snprintf(expected, sizeof expected, "%s%s,\n%s", json(head), printed[i].frames, json(printed[i].rest));
        struct document *document = document_of_text(json(printed[i].scene));
        assert_prints(document, expected);
        document_destroy(document);
    }
}

#define SPLINES "{'frames': [0, 9], 'splines': [{'name': 'walk', 'position': 3}, {'name': 's'}], 'rigs': "

/// What is read of rigs is printed again; %s takes the place of what stands in both.
static const struct kept {
    const char *scene, *text, *part;
} kept[] = {
    // a tail on a moving base, and what only others know
    {SPLINES
     "[{'type': 'tail', 'name': 't', 'frequency': 1, 'position': %s, 'spline': 'walk', 'of': 'displacement'}]}",
     "'position': %s,", "[{ 'spline': 'walk', 'by': 'me' }, 0.26, { 'spline': 'walk' }]"},
    {SPLINES "[{'type': 'tail', 'name': 't', 'frequency': %s}]}", "'frequency': %s\n", "1"},
    {SPLINES "[{'type': 'tail', 'name': 't', 'spline': 'walk', 'of': '%s'}]}",
     "'axis': 'side', 'of': '%s', 'lag': 6.5", "displacement"},
    {SPLINES "[]%s}", "%s      'position': 3\n", ""},
    // characters
    {SPLINES "[{'type': 'tail', 'name': 'a'}, {'type': 'character', 'model': '%s'}, {'type': 'tail', 'name': 'b'}]}",
     "{\n      'type': 'model',\n      'model': '%s',\n", "../models/a.glb"},
    {SPLINES "[{'type': 'character', 'model': 'a.glb', 'glow': 3, 'paint': '%s'}]}",
     "'paint': '%s',\n      'glow': 3", "a.npy"},
    {SPLINES "[{'type': 'character', 'model': 'a.glb', 'carpet': 'red', 'floor': %s}]}", "'floor': %s", "-0.5"},
    {SPLINES "[{'type': 'character', 'model': 'a.glb', 'coordinates': [%s]}]}", "'coordinates': [\n        %s\n",
     "{ 'name': 'up', 'spline': 's', 'amplitude': 0.5, 'lag': 30, 'tint': 'red' }"},
    {SPLINES "[{'type': 'character', 'model': 'a.glb', 'coordinates': [{'name': 'up', 'spline': 's'}]}]%s}",
     "      'type': 'model',\n      'model': 'a.glb',\n      'position': [0, 0, 0],\n      'scale': 1,\n      "
     "'turn': 0,\n"
     "      'coordinates': [\n"
     "        { 'name': 'up', 'spline': 's', 'amplitude': 1, 'lag': 0 }\n      ]\n    }\n%s",
     ""},
    // equilibria that follow a joint
    {"{'frames': [0, 9], 'splines': [{'name': 's', 'equilibrium': %s}], 'rigs': [{'type': 'model', 'name': 'dog', "
     "'model': 'd.glb'}, {'type': 'chain', 'name': 'tail', 'model': 'dog', 'from': 'a', 'to': 'b'}]}",
     "'equilibrium': %s",
     "{ 'model': 'dog', 'joint': 'hips', 'of': 'across', 'gain': -2.5, 'chain': 'tail', 'why': 1 }"},
    {"{'frames': [0, 9], 'splines': [{'name': 's', 'equilibrium': {'model': 'd.glb', 'joint': 'head', 'of': "
     "'turn'}}], "
     "'rigs': [{'type': 'model', 'name': 'dog', 'model': 'd.glb'}]%s}",
     "{ 'model': 'd.glb', 'joint': 'head', 'of': 'turn', 'gain': 1 }%s", ""},
    // backgrounds
    {"{'frames': [0, 9], 'background': %s}", "'background': %s,\n",
     "{ 'file': 'walk.mp4', 'offset': -8, 'by': 'me' }"},
    {"{'frames': [0, 9], 'background': {'offset': 0, 'file': 'no/such'}}%s",
     "'background': { 'file': 'no/such' },\n%s", ""},
    // knots
    {"{'frames': [0, 9], 'splines': [{'name': 's', 'knots': [%s]}]}", "'knots': [\n        %s\n",
     "{ 'frame': 2, 'settles': true, 'value': 1, 'im': -1, 'slope': 3, 'stiffness': 7 }"},
    {"{'frames': [0, 9], 'splines': [{'name': 's', 'knots': [%s]}]}", "'knots': [\n        %s\n",
     "{ 'frame': 2, 'still': true, 'tag': 1 }"},
};

TEST(what_is_read_is_kept)
{
    for (size_t i = 0; i < sizeof kept / sizeof *kept; i++) {
        char scene[1024], expected[512];
        snprintf(scene, sizeof scene, kept[i].scene, kept[i].part);      // NOLINT: formats of the table above
        snprintf(expected, sizeof expected, kept[i].text, kept[i].part); // NOLINT
        struct document *document = document_of_text(json(scene));
        char *text = text_of_document(document);
        if (!strstr(text, json(expected))) fail_msg("%s\n does not hold %s", text, expected);
        assert_loads_again(document);
        document_destroy(document);
        free(text);
    }
}

/// Windows programs begin texts with one; the lines of messages count as without it.
TEST(a_byte_order_mark_is_skipped)
{
#define MARKED(frames) "\xEF\xBB\xBF{\n\"frames\": " frames "}"
    struct document *document = document_of_text(MARKED("[0, 9]"));
    assert_int_equal(document->last_frame, 9);
    document_destroy(document);
    assert_refusal(scene_parse("a.json", MARKED("0"), strlen(MARKED("0")), NULL, &error) != NULL, "a.json:2: frames");
    assert_refusal(scene_parse("a.json", MARKED("0,"), strlen(MARKED("0,")), NULL, &error) != NULL, "a.json:2");
}

/// Old scenes may have meadows. They are no rigs, but saving keeps them as they are, even if their spline is gone.
TEST(meadows_of_old_scenes_are_kept)
{
    static const char meadow[] = "{ 'type': 'meadow', 'name': 'reeds', 'spline': 'wind', 'area': [6, 4.5], "
                                 "'mood': { 'mild': 9007199254740993 } }";
    static const char *const around[][2] = {
        {"", ""}, {"", ", {'type': 'tail', 'name': 't'}"}, {"{'type': 'tail', 'name': 't'}, ", ""}};
    for (int n = 0; n < 3; n++) {
        char text[1024], expected[1024];
        snprintf(text, sizeof text, "{'frames': [0, 9], 'splines': [{'name': 'wind'}], 'rigs': [%s%s%s]}",
                 around[n][0], meadow, around[n][1]);
        struct document *document = document_of_text(json(text));
        assert_int_equal(document->rig_count, n > 0);
        assert_true(scene_has_meadow(document));
        assert_done(edit_spline_remove(document, 0, &error));
        snprintf(expected, sizeof expected, "%s\n    %s\n  ]\n}\n", n > 0 ? "    }," : "  'rigs': [", meadow);
        for (int round = 0; round < 2; round++) { // the second time from what was saved
            char *saved = text_of_document(document);
            if (!strstr(saved, json(expected))) fail_msg("%s does not hold %s", saved, expected);
            document_destroy(document);
            document = document_of_text(saved);
            free(saved);
        }
        document_destroy(document);
    }
}

static void assert_same_param(const struct param *a, const struct param *b)
{
    assert_true(a->value == b->value && a->track == b->track);
    assert_true(!a->motion == !b->motion && (!a->motion || motion_equals(a->motion, b->motion)));
}

static void assert_round_trip(const char *path)
{
    struct document *document = document_of_file(path);
    char *text = text_of_document(document);
    struct document *again = document_of_text(text);
    assert_prints(again, text);
    assert_true(scene_hash(document) == scene_hash(again));
    assert_int_equal(again->spline_count, document->spline_count);
    for (int i = 0; i < document->spline_count; i++) {
        assert_int_equal(again->splines[i]->knot_count, document->splines[i]->knot_count);
        for (int p = 0; p < PARAMETER_COUNT; p++)
            assert_same_param(&again->splines[i]->parameter[p], &document->splines[i]->parameter[p]);
    }
    free(text);
    document_destroy(again);
    document_destroy(document);
}

TEST(scenes_of_ours_come_back)
{
    static const char *const folders[] = {"tests/vectors", "assets/scenes"};
    int count = 0;
    for (int i = 0; i < 2; i++) {
        DIR *all = opendir(folders[i]);
        assert_non_null(all);
        for (struct dirent *entry; (entry = readdir(all));) {
            char path[PATH_SIZE];
            if (!strstr(entry->d_name, ".json")) continue;
            snprintf(path, sizeof path, "%s/%s", folders[i], entry->d_name);
            assert_round_trip(path);
            count++;
        }
        closedir(all);
    }
    assert_true(count > 30);
}

TEST(knots_are_on_samples)
{
    struct document *document =
        document_of_text(json("{'frames': [-10, 10], 'substeps': 4, 'fps': 25, 'splines': [{'name': 'x', 'knots': "
                              "[{'frame': 10.12, 'value': 3}, {'frame': -10.125, 'value': 1}, {'frame': 0.125, "
                              "'value': 2}]}]}"));
    const struct spline *spline = document->splines[0];
    assert_int_equal(document_samples(document), 81);
    assert_near(document_step(document), 0.01, 1e-18);
    assert_file_says(document, "s0.k0={'frame':-10.125,'value':1}", "knots");
    static const int rows[][3] = {{0, 0, 0}, {41, 1, 1}, {80, 2, 2}, {40, -1, 1}, {1, -1, 1}, {81, -1, 3}};
    for (int i = 0; i < 6; i++) { // a half goes up
        assert_int_equal(spline_find_knot(document, spline, rows[i][0]), rows[i][1]);
        assert_int_equal(spline_lower_bound(document, spline, rows[i][0]), rows[i][2]);
    }
    assert_int_equal(document_sample(document, 1e300), INT32_MAX / 2);
    assert_int_equal(document_sample(document, -1e300), -(INT32_MAX / 2));
    assert_near(document_frame(document, 41), 0.25, 0);
    document_destroy(document);
}

// --- warnings and errors

static void hear(void *user, bool is_error, const char *sentence)
{
    char *heard = user;
    size_t used = strlen(heard);
    snprintf(heard + used, HEARD_SIZE - used, "%s%s\n", is_error ? "error: " : "", sentence);
}

/// All of a file's problems are reported, each with its line, whatever came before.
TEST(problems_are_told)
{
    static const char *const rows[][2] = {
        {"{'frames': [0, 9],\n'hey': 1,\n'splines': [{'name': 'x',\n'hey': 2}]}",
         "s.json:4: splines[0].hey: unknown key: kept, but it has no effect\n"},
        {"{'frames': [0, 9], 'splines': [{'name': 'x'}], 'rigs': [{'type': 'tail', 'name': 't', 'channels': []},\n"
         "{'type': 'meadow', 'spline': 'x'}, {'type': 'meadow'}]}",
         "s.json:2: rigs[1]: meadows are no longer shown; the file keeps them\n"},
        {"{'frames': [0, 9], 'splines': [{'name': 'x', 'frequency':\n11, 'bandwidth': 0.2}]}",
         "s.json:2: splines[0].frequency: 13.2 Hz is above half the sample rate, 12 Hz: it aliases\n"},
        {"{'frames': [0, 9], 'splines': [{'name': 'x', 'frequency':\n10, 'bandwidth': 0.2}]}", ""},
        {"{'frames': [0, 9], 'splines': [{'name': 'x', 'mode': 'real', 'frequency': 1, 'knots': [\n{'frame': 5, "
         "'value': 0, 'im': 1},\n{'frame': 3, 'value': 0, 'im': 1},\n{'frame': 4, 'value': 0, 'slope': 1}]}]}",
         "s.json:3: splines[0].knots[1].im: the pose holds only its value, because only Wiggly splines have a phase\n"
         "s.json:4: splines[0].knots[2].slope: slope has no effect: both samples beside it have knots\n"},
        {"{'fps': 0,\n'frames': [0, 9],\n'splines': [{'name': 1,\n'mode': 'x',\n'calm': 2,\n'knots': [{'frame': "
         "1}]}, "
         "{}],\n'rigs': [1]}",
         "error: s.json:1: fps: expected a number above 0 and at most 100000, got 0\n"
         "error: s.json:3: splines[0].name: expected a string, got a number\n"
         "error: s.json:6: splines[1].name: expected a string, got nothing\n"
         "error: s.json:4: splines[0].mode: expected 'complex', 'real' or 'cubic', got 'x'\n"
         "error: s.json:5: splines[0].calm: expected a number from 0 to 1, got 2\n"
         "error: s.json:6: splines[0].knots[0].value: expected a number, got nothing\n"
         "error: s.json:7: rigs[0]: expected an object, got a number\n"},
        // a key written with escapes is the same key, and its line is found
        {"{'fr\\u0061mes':\n[0, '9']}", "error: s.json:2: frames[1]: expected a whole number, got a string\n"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        const char *text = json(rows[i][0]);
        char heard[HEARD_SIZE] = "";
        struct problems problems = {hear, heard, 0, 0};
        document_destroy(scene_parse("s.json", text, strlen(text), &problems, NULL));
        assert_string_equal(heard, json(rows[i][1]));
    }
}

// --- save

static void assert_file_is(const char *path, const char *expected)
{
    char *text;
    size_t size;
    assert_done(file_read(path, PATH_SIZE, &text, &size, &error));
    assert_string_equal(text, expected);
    free(text);
}

static char a_bone[] = "tail_1";

/// Paths may have any bytes, also such as look like what the file has for others; names are UTF-8.
TEST(paths_may_have_any_bytes)
{
    static char paths[][24] = {
        "caf\xe9/r\xc3\xa9.glb", "\xff\xfe\x80.glb",     "尻尾.glb",   "\xe5\xb0", "\xed\xa0\x80",
        "\xf4\x8f\xba\x80",      "\xf4\x8f\xbb\xbf\xbf", "a\"\\\x01\n"};
    for (size_t i = 0; i < 2 * sizeof paths / sizeof *paths; i++) {
        struct document *document = document_create(), *back;
        struct rig model = {.kind = RIG_MODEL, .model = {.model = paths[i / 2], .scale = 1}},
                   chain = {.kind = RIG_CHAIN, .chain = {.model = paths[i / 2], .from = a_bone, .to = a_bone}};
        assert_done(edit_rig_add(document, &model, &error));
        struct rig *added = document->rigs[0];
        char *valid = name_from(added->name, strlen(added->name));
        assert_string_equal(added->name, valid);
        free(valid);
        if (i % 2 == 0) chain.chain.model = added->name;
        if (i % 2 == 1) free(added->name), added->name = NULL;
        assert_done(edit_rig_add(document, &chain, &error));
        size_t size;
        char *text = scene_print(document, document->folder, NULL, &size);
        assert_done(back = scene_parse("text", text, size, NULL, &error));
        assert_string_equal(back->rigs[0]->model.model, paths[i / 2]);
        assert_string_equal(back->rigs[1]->chain.model, chain.chain.model);
        document_destroy(document);
        document_destroy(back);
        free(text);
    }
}

static int count_files(void)
{
    int count = -2;
    DIR *all = opendir(folder);
    assert_non_null(all);
    while (readdir(all)) count++;
    closedir(all);
    return count;
}

/// A link stays a link, the mode stays, nothing is left beside the file, and a failure leaves the old content.
TEST_WITH(folder_make, folder_remove, a_file_is_replaced_as_it_is)
{
    char expected[PATH_SIZE];
    struct document *document = document_of_text("{\"frames\": [0, 7]}");
    struct error error = {0};
    struct stat about;
    assert_int_equal(symlink("scene.json", folder_path("link.json")), 0);
    for (document->last_frame = 7; document->last_frame < 9; document->last_frame++) {
        // through a link that leads nowhere yet, and then to a file with a mode
        assert_true(scene_save(document, folder_path("link.json"), &error));
        snprintf(expected, sizeof expected, "%s[0, %d],\n  \"splines\": [],\n  \"rigs\": []\n}\n", json(head),
                 document->last_frame);
        assert_file_is(folder_path("scene.json"), expected);
        if (document->last_frame == 7) assert_int_equal(chmod(folder_path("scene.json"), 0640), 0);
    }
    assert_int_equal(lstat(folder_path("link.json"), &about), 0);
    assert_true(S_ISLNK(about.st_mode));
    assert_int_equal(stat(folder_path("scene.json"), &about), 0);
    assert_int_equal(about.st_mode & 0777, 0640);
    assert_int_equal(count_files(), 2);
    assert_false(scene_save(document, folder, &error));
    assert_int_equal(error.kind, ERROR_ENVIRONMENT);
    assert_true(scene_save(document, "/dev/null", &error)); // which must stay a device
    assert_int_equal(stat("/dev/null", &about), 0);
    assert_true(S_ISCHR(about.st_mode));
    assert_false(scene_save(document, "/dev/full", &error));
    assert_non_null(strstr(error.text, "No space left"));
    document_destroy(document);
}

/// "Save as" into another folder: the file there leads to the same model; the document that goes on keeps its folder.
TEST_WITH(folder_make, folder_remove, a_scene_saved_elsewhere_finds_its_model)
{
    char absolute[PATH_LIMIT];
    const char *path = folder_path("deeper/scene.json");
    assert_int_equal(mkdir(folder_path("deeper"), 0777), 0);
    struct document *document = document_of_text(json(
        "{'frames': [0, 9], 'splines': [{'name': 's', 'equilibrium': {'model': 'dog.glb', 'joint': 'head', 'of': "
        "'up'}}], 'rigs': [{'type': 'character', 'model': 'models/a.glb'}, {'type': 'model', 'model': 'dog.glb'}], "
        "'background': {'file': 'films/walk.mp4'}}"));
    document->folder = strdup(folder);
    assert_done(scene_save(document, path, &error));
    assert_string_equal(first_model(document)->model, "models/a.glb");
    struct document *loaded = document_of_file(path);
    assert_file_says(
        loaded, "r0.model='../models/a.glb'; s0.equilibrium.model='../dog.glb'; background.file='../films/walk.mp4'",
        "saved elsewhere");
    assert_true(path_resolve(loaded->folder, first_model(loaded)->model, absolute));
    assert_string_equal(absolute, folder_path("models/a.glb"));
    document_destroy(document);
    document_destroy(loaded);
}

/// A file that recovers a scene says which one, and of what content; only this user may read it.
TEST_WITH(folder_make, folder_remove, a_recovery_knows_its_scene)
{
    static const struct scene_origin origins[] = {{"/home/me/walk \xff\"1\".json", 0x5f3a91c07be2d846}, {"", 0}};
    struct document *document = document_of_text("{\"frames\": [0, 7]}");
    struct stat about;
    for (int i = 0; i < 2; i++) {
        const char *path = folder_path("walk.json");
        assert_done(scene_save_for(document, path, &origins[i], &error));
        const struct scene_origin read = scene_read_origin(path);
        assert_string_equal(read.path, origins[i].path);
        assert_true(read.content == origins[i].content);
        assert_int_equal(stat(path, &about), 0);
        assert_int_equal(about.st_mode & 0777, 0600);
    }
    assert_string_equal(scene_read_origin(folder_path("missing.json")).path, "");
    document_destroy(document);
}

// --- knots on the clipboard

TEST(knots_are_read_and_written)
{
#define TWO                                                                                                          \
    "[\n  { 'frame': 1, 'value': 2 },\n  { 'frame': 3, 'value': -4, 'im': 1, 'slope': 5, 'stiffness': 6 }\n]\n"
#define STILL "[\n  { 'frame': 1, 'value': 2 },\n  { 'frame': 3, 'still': true }\n]\n"
    static const char *const rows[][2] = {
        {TWO, TWO},
        {"{'knots': " TWO "}", TWO},
        {"# two\n\n1,2\n3,-4,5,6,1\n", TWO},
        {"1;2\n3;-4,0;5;6;1\n", TWO},
        {"stiffness\tim\tframe\tvalue\tslope\n\t\t1\t2\t\n6\t1\t3\t-4\t5\n", TWO},
        {"1,2\n3,still", STILL},
        {STILL, STILL},
        {"[\n  { 'spline': 'x', 'frame': 1, 'value': 2 }\n]\n",
         "[\n  { 'spline': 'x', 'frame': 1, 'value': 2 }\n]\n"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        struct knot_list list = {0};
        assert_done(knots_parse("c", json(rows[i][0]), &list, &error));
        char *text = knots_print(&list);
        assert_string_equal(text, json(rows[i][1]));
        knot_list_free(&list);
        free(text);
    }
    char *none = knots_print(&(const struct knot_list){0});
    assert_string_equal(none, "[]\n");
    free(none);
}
