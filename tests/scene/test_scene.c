/// Documents: what is loaded, saved, printed and solved.
#include "documents.h"
#include "folder.h"

#include "base/names.h"
#include "scene/edit.h"
#include "scene/evaluate.h"
#include "scene/text.h"
#include <dirent.h>
#include <sys/stat.h>
#include <unistd.h>

enum { PATH_SIZE = 512, HEARD_SIZE = 2048 };

// --- numbers

TEST(test_numbers)
{
    static const struct {
        double value;
        const char *text;
    } cases[] = {
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
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[NUMBER_TEXT_SIZE];
        assert_int_equal(number_print(cases[i].value, text), strlen(cases[i].text));
        assert_string_equal(text, cases[i].text);
    }
}

/// Random bit patterns: every exponent is as likely, subnormals and the neighbours of powers of two among them.
TEST(test_numbers_read_back)
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
        if (digits < 2 || fabs(value) < 1e-5 * 10 || fabs(value) >= 1e15) continue;
        if (text[strlen(text) - 1] == '0' || fabs(value) < 1) continue;
        snprintf(shorter, sizeof shorter, "%.*g", (int)digits - 1, value);
        if (strtod(shorter, NULL) == value) fail_msg("%s could be %s", text, shorter);
    }
}

// --- load and print

TEST(test_defaults)
{
    struct document *document =
        document_of_text("{\"frames\": [0, 120], \"splines\": [{\"name\": \"x\", \"knots\": [{\"frame\": 3, "
                         "\"value\": 2}]}], \"rigs\": [{\"type\": \"tail\", \"name\": \"t\", \"spline\": \"x\"}]}");
    assert_prints(document, "{\n"
                            "  \"wiggly\": 1,\n"
                            "  \"fps\": 24,\n"
                            "  \"substeps\": 1,\n"
                            "  \"frames\": [0, 120],\n"
                            "  \"splines\": [\n"
                            "    {\n"
                            "      \"name\": \"x\",\n"
                            "      \"mode\": \"complex\",\n"
                            "      \"frequency\": 0,\n"
                            "      \"damping\": 0,\n"
                            "      \"bandwidth\": 0.1,\n"
                            "      \"calm\": 1,\n"
                            "      \"equilibrium\": 0,\n"
                            "      \"start\": \"free\",\n"
                            "      \"knots\": [\n"
                            "        { \"frame\": 3, \"value\": 2 }\n"
                            "      ]\n"
                            "    }\n"
                            "  ],\n"
                            "  \"rigs\": [\n"
                            "    {\n"
                            "      \"type\": \"tail\",\n"
                            "      \"name\": \"t\",\n"
                            "      \"joints\": 24,\n"
                            "      \"length\": 1.6,\n"
                            "      \"position\": [0, 0, 0],\n"
                            "      \"rest\": 0,\n"
                            "      \"channels\": [\n"
                            "        { \"spline\": \"x\", \"axis\": \"side\", \"lag\": 6.5, \"gain\": 5 }\n"
                            "      ]\n"
                            "    }\n"
                            "  ]\n"
                            "}\n");
    document_destroy(document);
    document = document_of_text("{\"frames\": [-3, -3]}");
    assert_prints(document, "{\n  \"wiggly\": 1,\n  \"fps\": 24,\n  \"substeps\": 1,\n  \"frames\": [-3, -3],\n"
                            "  \"splines\": [],\n  \"rigs\": []\n}\n");
    document_destroy(document);
}

/// Windows programs begin texts with one; the lines of messages count as without it.
TEST(test_a_byte_order_mark_is_skipped)
{
#define MARKED(frames) "\xEF\xBB\xBF{\n\"frames\": " frames "}"
    struct document *document = document_of_text(MARKED("[0, 9]"));
    assert_int_equal(document->last_frame, 9);
    document_destroy(document);
    assert_refusal(scene_parse("a.json", MARKED("0"), strlen(MARKED("0")), NULL, &error) != NULL, "a.json:2: frames");
    assert_refusal(scene_parse("a.json", MARKED("0,"), strlen(MARKED("0,")), NULL, &error) != NULL, "a.json:2");
}

/// Unknown keys stay, wherever they are, behind the known ones and in their own order; those named like parameters as
/// well.
TEST(test_unknown_keys_are_kept)
{
    struct document *document = document_of_text(
        "{\"z\": [1, 2.50, {\"k\": null}, []], \"frames\": [0, 9], \"a\": 9007199254740993, \"splines\": [\n"
        "{\"name\": \"q\\\"\\\\\\u0001\\u00e9\", \"mode\": \"real\", \"note\": true, \"frequency\": {\"by\": \"me\", "
        "\"spline\": \"w\"}, \"knots\": [{\"frequency\": {}, \"value\": 1, \"frame\": 2}]}, {\"name\": \"w\", "
        "\"mode\": "
        "\"cubic\"}], \"rigs\": [{\"type\": \"tail\", \"name\": \"t\", \"color\": \"red\", \"channels\": [{\"u\": 1, "
        "\"spline\": \"w\"}]}]}");
    assert_prints(
        document,
        "{\n  \"wiggly\": 1,\n  \"fps\": 24,\n  \"substeps\": 1,\n  \"frames\": [0, 9],\n  \"splines\": [\n"
        "    {\n      \"name\": \"q\\\"\\\\\\u0001é\",\n      \"mode\": \"real\",\n"
        "      \"frequency\": { \"spline\": \"w\", \"by\": \"me\" },\n      \"damping\": 0,\n      \"calm\": 1,\n"
        "      \"equilibrium\": 0,\n      \"start\": \"free\",\n      \"knots\": [\n"
        "        { \"frame\": 2, \"value\": 1, \"frequency\": {} }\n      ],\n      \"note\": true\n    },\n"
        "    {\n      \"name\": \"w\",\n      \"mode\": \"cubic\",\n      \"equilibrium\": 0,\n"
        "      \"start\": \"free\",\n      \"knots\": []\n    }\n  ],\n  \"rigs\": [\n    {\n"
        "      \"type\": \"tail\",\n      \"name\": \"t\",\n      \"joints\": 24,\n      \"length\": 1.6,\n"
        "      \"position\": [0, 0, 0],\n      \"rest\": 0,\n      \"channels\": [\n"
        "        { \"spline\": \"w\", \"axis\": \"side\", \"lag\": 6.5, \"gain\": 5, \"u\": 1 }\n      ],\n"
        "      \"color\": \"red\"\n    }\n  ],\n"
        "  \"z\": [1, 2.5, { \"k\": null }, []],\n  \"a\": 9007199254740993\n}\n");
    document_destroy(document);
}

/// Old scenes may have meadows. They are no rigs, but saving keeps them as they are, even if their spline is gone.
TEST(test_meadows_of_old_scenes_are_kept)
{
    static const char
        meadow[] = "{ \"type\": \"meadow\", \"name\": \"reeds\", \"spline\": \"wind\", \"area\": [6, 4.50], "
                   "\"mood\": { \"mild\": 9007199254740993 } }",
        kept[] = "    { \"type\": \"meadow\", \"name\": \"reeds\", \"spline\": \"wind\", \"area\": [6, 4.5], "
                 "\"mood\": { \"mild\": 9007199254740993 } }";
    static const char tail[] = "{\"type\": \"tail\", \"name\": \"t\", \"channels\": []}";
    const struct {
        const char *before, *after;
        int rigs;
    } cases[] = {{"", "", 0}, {"", tail, 1}, {tail, "", 1}};
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
        char text[1024], expected[1024];
        snprintf(text, sizeof text,
                 "{\"frames\": [0, 9], \"splines\": [{\"name\": \"wind\"}], \"rigs\": [%s%s%s%s%s]}", cases[c].before,
                 cases[c].before[0] ? ", " : "", meadow, cases[c].after[0] ? ", " : "", cases[c].after);
        struct document *document = document_of_text(text);
        assert_int_equal(document->rig_count, cases[c].rigs);
        assert_true(scene_has_meadow(document));
        assert_done(edit_spline_remove(document, 0, &error));
        snprintf(expected, sizeof expected, "%s\n%s\n  ]\n}\n", cases[c].rigs ? "    }," : "  \"rigs\": [", kept);
        for (int round = 0; round < 2; round++) { // the second time from what was saved
            char *saved = text_of_document(document);
            if (!strstr(saved, expected)) fail_msg("%s does not hold %s", saved, expected);
            document_destroy(document);
            document = document_of_text(saved);
            free(saved);
        }
        document_destroy(document);
    }
}

/// A tail on a moving base: coordinates that follow splines, a channel without the base's part, and what only others know.
TEST(test_moving_bases_are_kept)
{
    struct document *document = document_of_text(
        "{\"frames\": [0, 9], \"splines\": [{\"name\": \"walk\", \"position\": 3}], \"rigs\": [{\"type\": \"tail\", "
        "\"name\": \"t\", \"frequency\": 1, \"position\": [{\"by\": \"me\", \"spline\": \"walk\"}, 0.26, "
        "{\"spline\": \"walk\"}], \"spline\": \"walk\", \"of\": \"displacement\"}]}");
    const struct tail *tail = document_tail(document, 0);
    assert_int_equal(tail->position[0].track, 0);
    assert_int_equal(tail->position[1].track, -1);
    assert_near(tail->position[1].value, 0.26, 0);
    assert_int_equal(tail->channels[0].of, PART_DISPLACEMENT);
    char *text = text_of_document(document);
    assert_non_null(
        strstr(text, "\"position\": [{ \"spline\": \"walk\", \"by\": \"me\" }, 0.26, { \"spline\": \"walk\" }],"));
    assert_non_null(strstr(text, "\"axis\": \"side\", \"of\": \"displacement\", \"lag\": 6.5"));
    assert_non_null(strstr(text, "\"position\": 3\n"));  // a spline's unknown key
    assert_non_null(strstr(text, "\"frequency\": 1\n")); // a tail's
    free(text);
    document_destroy(document);
}

static void assert_same_param(const struct param *a, const struct param *b)
{
    assert_true(a->value == b->value && a->track == b->track);
    assert_true(!a->motion == !b->motion);
    if (!a->motion) return;
    assert_string_equal(a->motion->model, b->motion->model);
    assert_string_equal(a->motion->joint, b->motion->joint);
    assert_int_equal(a->motion->of, b->motion->of);
    assert_true(a->motion->gain == b->motion->gain);
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
        for (int p = 0; p < PARAMETER_COUNT; p++) {
            assert_same_param(&again->splines[i]->parameter[p], &document->splines[i]->parameter[p]);
        }
    }
    free(text);
    document_destroy(again);
    document_destroy(document);
}

TEST(test_round_trips)
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

TEST(test_knots_on_samples)
{
    struct document *document =
        document_of_text("{\"frames\": [-10, 10], \"substeps\": 4, \"fps\": 25, \"splines\": [{\"name\": \"x\", "
                         "\"knots\": [{\"frame\": 10.12, \"value\": 3}, {\"frame\": -10.125, \"value\": 1}, "
                         "{\"frame\": 0.125, \"value\": 2}]}]}");
    const struct spline *spline = document->splines[0];
    assert_int_equal(document_samples(document), 81);
    assert_near(document_step(document), 0.01, 1e-18);
    assert_near(spline->knots[0].value, 1, 0);
    assert_near(spline->knots[0].frame, -10.125, 0);
    assert_int_equal(spline_find_knot(document, spline, 0), 0);
    assert_int_equal(spline_find_knot(document, spline, 41), 1); // a half goes up
    assert_int_equal(spline_find_knot(document, spline, 80), 2);
    assert_int_equal(spline_find_knot(document, spline, 40), -1);
    assert_int_equal(document_sample(document, 1e300), INT32_MAX / 2);
    assert_int_equal(document_sample(document, -1e300), -(INT32_MAX / 2));
    assert_near(document_frame(document, 41), 0.25, 0);
    document_destroy(document);
}

// --- warnings

static void hear(void *user, bool is_error, const char *sentence)
{
    char *heard = user;
    size_t used = strlen(heard);
    snprintf(heard + used, HEARD_SIZE - used, "%s%s\n", is_error ? "error: " : "", sentence);
}

static void assert_heard(const char *text, const char *expected)
{
    char heard[HEARD_SIZE] = "";
    struct problems problems = {hear, heard, 0, 0};
    struct error error = {0};
    document_destroy(scene_parse("s.json", text, strlen(text), &problems, &error));
    assert_string_equal(heard, expected);
}

TEST(test_warnings)
{
    assert_heard("{\"frames\": [0, 9],\n\"hey\": 1,\n\"splines\": [{\"name\": \"x\",\n\"hey\": 2}]}",
                 "s.json:4: splines[0].hey: unknown key: kept, but it has no effect\n");
    assert_heard(
        "{\"frames\": [0, 9], \"splines\": [{\"name\": \"x\"}], \"rigs\": [{\"type\": \"tail\", \"name\": \"t\", "
        "\"channels\": []},\n{\"type\": \"meadow\", \"spline\": \"x\"}, {\"type\": \"meadow\"}]}",
        "s.json:2: rigs[1]: meadows are no longer shown; the file keeps them\n");
    assert_heard("{\"frames\": [0, 9], \"splines\": [{\"name\": \"x\", \"frequency\":\n11, \"bandwidth\": 0.2}]}",
                 "s.json:2: splines[0].frequency: 13.2 Hz is above half the sample rate, 12 Hz: it aliases\n");
    assert_heard(
        "{\"frames\": [0, 9], \"splines\": [{\"name\": \"x\", \"mode\": \"real\", \"frequency\": 1, \"knots\": [\n"
        "{\"frame\": 5, \"value\": 0, \"im\": 1},\n{\"frame\": 3, \"value\": 0, \"im\": 1},\n"
        "{\"frame\": 4, \"value\": 0, \"slope\": 1}]}]}",
        "s.json:3: splines[0].knots[1].im: the pose holds only its value, because only Wiggly splines have a phase\n"
        "s.json:4: splines[0].knots[2].slope: slope has no effect: both samples beside it have knots\n");
}

/// All of a file's problems are reported, each with its line, whatever came before.
TEST(test_every_error_is_reported)
{
    assert_heard("{\"fps\": 0,\n\"frames\": [0, 9],\n\"splines\": [{\"name\": 1,\n\"mode\": \"x\",\n\"calm\": 2,\n"
                 "\"knots\": [{\"frame\": 1}]}, {}],\n\"rigs\": [1]}",
                 "error: s.json:1: fps: expected a number above 0 and at most 100000, got 0\n"
                 "error: s.json:3: splines[0].name: expected a string, got a number\n"
                 "error: s.json:6: splines[1].name: expected a string, got nothing\n"
                 "error: s.json:4: splines[0].mode: expected \"complex\", \"real\" or \"cubic\", got \"x\"\n"
                 "error: s.json:5: splines[0].calm: expected a number from 0 to 1, got 2\n"
                 "error: s.json:6: splines[0].knots[0].value: expected a number, got nothing\n"
                 "error: s.json:7: rigs[0]: expected an object, got a number\n");
}

/// A key written with escapes is the same key, and its line is found.
TEST(test_escaped_keys)
{
    assert_heard("{\"fr\\u0061mes\":\n[0, \"9\"]}",
                 "error: s.json:2: frames[1]: expected a whole number, got a string\n");
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
TEST(test_paths_of_any_bytes)
{
    static char paths[][24] = {
        "caf\xe9/r\xc3\xa9.glb", "\xff\xfe\x80.glb",     "尻尾.glb",   "\xe5\xb0", "\xed\xa0\x80",
        "\xf4\x8f\xba\x80",      "\xf4\x8f\xbb\xbf\xbf", "a\"\\\x01\n"};
    for (size_t i = 0; i < 2 * sizeof paths / sizeof *paths; i++) {
        struct document *document = document_create(), *back;
        struct rig model = {.kind = RIG_MODEL, .model = {.model = paths[i / 2], .scale = 1}},
                   chain = {.kind = RIG_CHAIN, .chain = {.model = paths[i / 2], .from = a_bone, .to = a_bone}};
        size_t size;
        assert_done(edit_rig_add(document, &model, &error));
        struct rig *added = document->rigs[0];
        char *valid = name_from(added->name, strlen(added->name));
        assert_string_equal(added->name, valid);
        free(added->name);
        added->name = i % 2 == 0 ? valid : NULL;
        if (added->name) chain.chain.model = added->name;
        if (!added->name) free(valid);
        assert_done(edit_rig_add(document, &chain, &error));
        char *text = scene_print(document, &size);
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
    int count = 0;
    DIR *all = opendir(folder);
    assert_non_null(all);
    while (readdir(all)) count++;
    closedir(all);
    return count - 2;
}

/// A link stays a link, the mode stays, nothing is left beside the file, and a failure leaves the old content.
TEST_WITH(folder_make, folder_remove, test_save)
{
    char path[PATH_SIZE], link[PATH_SIZE];
    char expected[] = "{\n  \"wiggly\": 1,\n  \"fps\": 24,\n  \"substeps\": 1,\n  \"frames\": [0, 7],\n"
                      "  \"splines\": [],\n  \"rigs\": []\n}\n";
    struct document *document = document_of_text("{\"frames\": [0, 7]}");
    struct error error = {0};
    snprintf(path, sizeof path, "%s", folder_path("scene.json"));
    snprintf(link, sizeof link, "%s", folder_path("link.json"));
    assert_int_equal(symlink("scene.json", link), 0);
    assert_true(scene_save(document, link, &error)); // through a link that leads nowhere yet
    assert_file_is(path, expected);
    assert_int_equal(chmod(path, 0640), 0);
    document->last_frame = 8;
    expected[strcspn(expected, "7")] = '8';
    assert_true(scene_save(document, link, &error));
    assert_file_is(path, expected);
    struct stat about;
    assert_int_equal(lstat(link, &about), 0);
    assert_true(S_ISLNK(about.st_mode));
    assert_int_equal(stat(path, &about), 0);
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

// --- evaluation

/// d follows c in the equilibrium, c follows b in the frequency, b is a cubic whose frequency "follows" a without
/// effect.
static const char chain[] =
    "{\"frames\": [0, 48], \"splines\": ["
    "{\"name\": \"d\", \"equilibrium\": {\"spline\": \"c\"}, \"frequency\": 1, \"start\": \"rest\"},"
    "{\"name\": \"c\", \"frequency\": {\"spline\": \"b\"}, \"knots\": [{\"frame\": 0, \"value\": 0}, {\"frame\": 20, "
    "\"value\": 1}]},"
    "{\"name\": \"b\", \"mode\": \"cubic\", \"frequency\": {\"spline\": \"a\"}, \"knots\": [{\"frame\": 0, "
    "\"value\": 1}, {\"frame\": 48, \"value\": 2}]},"
    "{\"name\": \"a\", \"mode\": \"cubic\", \"knots\": [{\"frame\": 9, \"value\": 3}]}]}";

/// A document and its curves.
struct solved {
    struct document *document;
    struct evaluation evaluation;
};

static void solved_open(struct solved *s, const char *text)
{
    s->document = document_of_text(text);
    evaluation_update(&s->evaluation, s->document, false);
}

static void solved_close(struct solved *s)
{
    evaluation_free(&s->evaluation);
    document_destroy(s->document);
}

#define SOLVED_TEST(name, text) TEST_OF(struct solved, s, solved_open(s, text), solved_close(s), name)

SOLVED_TEST(test_a_scene_without_splines, "{\"frames\": [0, 120]}")
{
    assert_int_equal(s->evaluation.solved_splines, 0);
}

/// Solves anew what hangs on these splines; how many that were.
static long solved_again(struct solved *s, const bool edited[4], bool as_cubics)
{
    for (int i = 0; i < 4; i++)
        if (edited[i]) document_own_spline(s->document, i);
    evaluation_update(&s->evaluation, s->document, as_cubics);
    return s->evaluation.solved_splines;
}

SOLVED_TEST(test_only_followers_are_solved, chain)
{
    assert_int_equal(s->evaluation.solved_splines, 4);
    assert_int_equal(s->evaluation.solved_samples, 4 * 49);
    assert_int_equal(s->evaluation.solved_knots, 5);
    for (int i = 0; i < 4; i++) assert_int_equal(s->evaluation.status[i], WIGGLY_OK);
    assert_near(s->evaluation.curves[1].total[20], 1, 0);
    assert_near(s->evaluation.curves[0].y[20], 1, 0);
    static const struct {
        bool edited[4];
        int solved, solved_as_cubics;
    } cases[] = {
        {{false, false, false, false}, 0, 0}, {{true, false, false, false}, 1, 1},
        {{false, true, false, false}, 2, 2},  {{false, false, true, false}, 3, 1},
        {{false, false, false, true}, 1, 1},  {{true, false, false, true}, 2, 2},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        assert_int_equal(solved_again(s, cases[i].edited, false), cases[i].solved);
    evaluation_update(&s->evaluation, s->document, true); // another look solves all
    assert_int_equal(s->evaluation.solved_splines, 4);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        assert_int_equal(solved_again(s, cases[i].edited, true), cases[i].solved_as_cubics);
}

/// What is solved bit by bit, as edits come, is what is solved at once: a curve is a function of the document.
SOLVED_TEST(test_partial_solves_agree, chain)
{
    struct evaluation whole = {0};
    document_own_spline(s->document, 2)->knots[1].value = 0.25;
    evaluation_update(&s->evaluation, s->document, false);
    evaluation_update(&whole, s->document, false);
    for (int i = 0; i < 4; i++) {
        assert_memory_equal(s->evaluation.curves[i].total, whole.curves[i].total, 49 * sizeof(double));
        assert_memory_equal(s->evaluation.curves[i].im, whole.curves[i].im, 49 * sizeof(double));
    }
    evaluation_free(&whole);
}

TEST(test_evaluation_fits_the_document)
{
    struct document *small = document_of_text("{\"frames\": [0, 5], \"splines\": [{\"name\": \"x\"}]}"),
                    *large = document_of_text(chain);
    struct evaluation evaluation = {0};
    evaluation_update(&evaluation, small, false);
    evaluation_update(&evaluation, large, false);
    assert_int_equal(evaluation.solved_splines, 4); // nothing was solved before
    const double *kept = evaluation.curves[0].total;
    document_touch(large);
    evaluation_update(&evaluation, large, false);
    assert_ptr_equal(evaluation.curves[0].total, kept);
    evaluation_update(&evaluation, large, false);
    assert_int_equal(evaluation.solved_splines, 0);
    evaluation_update(&evaluation, small, false);
    assert_int_equal(evaluation.solved_splines, 1);
    evaluation_free(&evaluation);
    document_destroy(small);
    document_destroy(large);
}

/// A value that no curve can pass: nothing moves any more, the status says why, and nothing that reads the curve falls over.
SOLVED_TEST(test_a_value_beyond_reach_is_flat,
            "{\"frames\": [0, 40], \"splines\": [{\"name\": \"a\", \"knots\": [{\"frame\": 0, \"value\": 1}, "
            "{\"frame\": 30, \"value\": -1.7e308}]}]}")
{
    char sentence[EVALUATION_SENTENCE];
    assert_int_equal(s->evaluation.status[0], WIGGLY_ERROR_KNOT_NUMBER);
    assert_true(evaluation_sentence(&s->evaluation, 0, sentence));
    assert_non_null(strstr(sentence, "the knot at frame 30: "));
    document_own_spline(s->document, 0)->knots[1].value = -1;
    evaluation_update(&s->evaluation, s->document, false);
    assert_near(s->evaluation.curves[0].total[30], -1, 0);
    document_own_spline(s->document, 0)->knots[1].value = -1.7e308;
    evaluation_update(&s->evaluation, s->document, false);
    assert_int_equal(s->evaluation.status[0], WIGGLY_ERROR_KNOT_NUMBER);
    wiggly_value value = wiggly_evaluate(&s->evaluation.curves[0], 12.5);
    assert_near(value.y + value.re, 0, 0);
}
