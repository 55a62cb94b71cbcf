/// Every limit that a scene, an edit or the library names: what lies one below it and at it is taken, what lies one above it is refused
/// with a sentence that says the limit. The limits stand here as numbers, as the manual has them.

#include "world.h"

#include "folder.h"
#include "scene/text.h"
#include <wiggly/more.h>

#define FRAMES "{'wiggly': 1, 'frames': [0, 48]"
#define SPLINE "'splines': [{'name': 's', 'knots': [{'frame': 0, 'value': 1}]}]"
#define RIGS FRAMES ", " SPLINE ", 'rigs': ["

/// A scene is taken, or refused with a sentence that says this.
static void judge(const char *text, const char *says)
{
    struct error error = {0};
    struct document *document = scene_parse("bounds.json", text, strlen(text), NULL, &error);
    if (!says != !!document) fail_msg("%s: %.200s", says ? "taken" : error.text, text);
    if (says && !strstr(error.text, says)) fail_msg("\"%s\" does not say \"%s\"", error.text, says);
    document_destroy(document);
}

/// A number with a least and a most that are taken; `format` is the scene with it.
static const struct number {
    const char *format;
    long least, most;
    const char *says;
} numbers[] = {
    {FRAMES ", 'substeps': %ld}", 1, 1024, "from 1 to 1024"},
    {FRAMES ", 'fps': %ld}", 1, 100000, "above 0 and at most 100000"},
    {"{'wiggly': 1, 'frames': [%ld, -999999990]}", -1000000000, -999999990, "expected"},
    {"{'wiggly': 1, 'frames': [999999990, %ld]}", 999999990, 1000000000, "expected"},
    {"{'wiggly': 1, 'frames': [1, %ld]}", 1, 100000, "expected"},
    {"{'wiggly': 1, 'substeps': 10, 'frames': [0, %ld]}", 0, 9999, "expected"},
    {RIGS "{'type': 'tail', 'name': 't', 'spline': 's', 'joints': %ld}]}", 1, 256, "from 1 to 256"},
    {FRAMES ", 'splines': [{'name': 's', 'variation': {'amount': 0.5, 'seed': %ld}}]}", 0, 999999,
     "from 0 to 999999"},
};

TEST(numbers_of_a_scene)
{
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++) {
        const struct number *n = &numbers[i];
        const long tries[] = {n->least - 1,
                              n->most + 1,
                              n->least,
                              n->most,
                              n->least + (n->least < n->most),
                              n->most - (n->most > n->least)};
        for (int k = 0; k < 6; k++) {
            char text[512];
            snprintf(text, sizeof text, json(n->format), tries[k]); // NOLINT: a format of the table above
            judge(text, k < 2 ? n->says : NULL);
        }
    }
}

static void append(struct text *text, const char *format, ...)
{
    char piece[512];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(piece, sizeof piece, format, arguments); // NOLINT: formats of this file
    va_end(arguments);
    text_string(text, json(piece));
}

/// Elements with commas between, of which the format may have the index.
static void append_many(struct text *text, const char *format, int count)
{
    for (int i = 0; i < count; i++) {
        if (i > 0) text_string(text, ",");
        append(text, format, i);
    }
}

static struct document *document_of(struct text *text)
{
    text_bytes(text, "", 1);
    return document_of_text(text->data);
}

static void judge_text(struct text *text, const char *says)
{
    text_bytes(text, "", 1);
    judge(text->data, says);
    free(text->data);
    *text = (struct text){0};
}

#define CHAIN                                                                                                        \
    "{'type': 'model', 'name': 'm', 'model': 'm.glb'}, {'type': 'chain', 'name': 'c', 'model': 'm', 'from': 'a', "   \
    "'to': 'b', 'channels': [{'spline': 's', 'axis': 'side', 'lag': ["
#define PINNED                                                                                                       \
    "{'wiggly': 1, 'frames': [0, 1023], 'splines': [{'name': 's', 'frequency': 1}], 'rigs': [{'type': 'tail', "      \
    "'name': 't', 'spline': 's', 'pins': ["

/// How many of something: `head`, elements with their number, `tail`.
static const struct count {
    const char *head, *element, *tail;
    int least, most;
    const char *says;
} counts[] = {
    {FRAMES ", 'rigs': [", "{'type': 'tail', 'name': 't%d'}", "]}", 0, 1024, "at most 1024 elements"},
    {RIGS "{'type': 'tail', 'name': 't', 'channels': [", "{'spline': 's', 'axis': 'side'}", "]}]}", 0, 64,
     "at most 64 elements"},
    {RIGS "{'type': 'tail', 'name': 't', 'joints': 4, 'spline': 's', 'lag': {'ramp': [", "[0.%04d, 1]", "]}}]}", 2,
     32, "from 2 to 32"},
    {RIGS CHAIN, "1", "]}]}]}", 1, 256, "from 1 to 256"},
    {RIGS "{'type': 'character', 'model': 'm.glb', 'coordinates': [", "{'name': 'c%d', 'spline': 's'}", "]}]}", 0, 4,
     "at most 4 elements"},
    {PINNED, "{'frame': %d, 'joint': 3, 'to': [0, 0, 0]}", "]}]}", 0, 1024, "at most 1024"},
};

TEST(counts_of_a_scene)
{
    for (size_t i = 0; i < sizeof counts / sizeof *counts; i++) {
        const struct count *c = &counts[i];
        const int tries[] = {c->most + 1, c->least - 1, c->least, c->least + 1, c->most - 1, c->most};
        for (int k = 0; k < 6; k++) {
            struct text text = {0};
            if (tries[k] < 0) continue;
            append(&text, c->head);
            append_many(&text, c->element, tries[k]);
            append(&text, c->tail);
            judge_text(&text, k < 2 ? c->says : NULL);
        }
    }
    for (int levels = 62; levels <= 64; levels++) { // the scene itself is the first
        struct text text = {0};
        append(&text, FRAMES ", 'unknown': ");
        for (int i = 0; i < levels; i++) append(&text, "[");
        for (int i = 0; i < levels; i++) append(&text, "]");
        append(&text, "}");
        judge_text(&text, levels < 64 ? NULL : "at most 64 levels");
    }
}

/// Each parameter of a spline: its own least and most number, and the next number beyond.
TEST(parameters_of_a_spline)
{
    int tried = 0;
    for (enum parameter p = 0; p < PARAMETER_COUNT; p++) {
        const struct parameter_row *row = &parameter_rows[p];
        if (row->kind == PARAMETER_CHOICE || row->kind == PARAMETER_LIMIT) continue;
        if (p == PARAMETER_VARIATION || p == PARAMETER_SEED) continue; // members of an object
        const double ends[] = {row->minimum, parameter_maximum(p, WIGGLY_COMPLEX)};
        for (int k = 0; k < 4; k++) {
            const double end = ends[k / 2], beyond = nextafter(end, k / 2 ? INFINITY : -INFINITY);
            struct text text = {0};
            if (!isfinite(end)) continue;
            append(&text, FRAMES ", 'splines': [{'name': 's', '%s': %.17g}]}", parameter_key(p),
                   k % 2 ? beyond : end);
            judge_text(&text, k % 2 ? parameter_key(p) : NULL);
            tried++;
        }
    }
    assert_true(tried >= 14);
}

/// A hundred thousand knots over all splines: in a file one more is refused; one taken away can be put back, and no other.
TEST(knots_of_a_scene)
{
    enum { MOST = 100000, EACH = MOST / 2 };
    for (int count = MOST; count <= MOST + 1; count++) {
        struct text text = {0};
        append(&text, "{'wiggly': 1, 'frames': [0, 60000], 'splines': [{'name': 's', 'knots': [");
        append_many(&text, "{'frame':%d,'value':0}", EACH);
        append(&text, "]},{'name': 't', 'knots': [");
        append_many(&text, "{'frame':%d,'value':0}", count - EACH);
        append(&text, "]}]}");
        if (count > MOST) {
            judge_text(&text, "at most 100000 knots");
            continue;
        }
        struct world world;
        text_bytes(&text, "", 1);
        world_open_scene(&world, text.data);
        free(text.data);
        assert_false(world_step(&world, world_do(&world, "insert s 50050 1")));
        assert_string_equal(world.error.text, "the limit of 100000 knots is reached");
        assert_false(world_step(&world, world_do(&world, "copy s")));
        assert_string_equal(world.error.text, "the limit is 100000 knots over all splines");
        world_must(&world, world_do(&world, "remove s 5"));
        world_must(&world, world_do(&world, "insert s 50050 1"));
        assert_false(world_step(&world, world_do(&world, "insert s 5 1")));
        world_close(&world);
    }
}

/// The same limits, where an edit would go beyond.
TEST(limits_of_edits)
{
    static const char timed[] =
        "{'frames': [0, 48], 'splines': [{'name': 'sway', 'knots': [{'frame': 12, 'value': 1}]}]}";
    static const char rate[] = "frames per second must be above 0 and at most 100000";
    static const char subs[] = "substeps must be from 1 to 1024";
    static const char far[] = "frames must be from -1000000000 to 1000000000";
    static const char high[] = "at most 20000 samples where a spline has a low or high limit, got 20001";
    static const char *const rows[][2] = {
        {"fps 99999 | fps 100000 | substeps 2 | substeps 1 | substeps 1023 | substeps 1024 | range 0 99999 refuse",
         NULL},
        {"fps 100001 | fps 0 | fps nan", rate},
        {"substeps 1025 | substeps 0", subs},
        {"range 0 100000 refuse", "at most 100000 samples a spline, got 100001"},
        {"range 0 1000000000 refuse", "at most 100000 samples a spline, got 1000000001"},
        {"range 0 1000000001 refuse | range -1000000001 0 refuse | range 0 2147483647 refuse", far},
        {"range 0 20000 refuse; set sway high 1e6 | set sway high 1e6; range 0 20000 refuse", high},
        {"range 0 19999 refuse; set sway high 1e6 | set sway high 1e6; range 0 19999 refuse; copy sway; copy sway",
         NULL},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) assert_edits(json(timed), rows[i][0], rows[i][1]);
}

WORLD_TEST(rigs_of_an_edit, world_open(world))
{
    while (world->document->rig_count < 1024)
        world_must(world, edit_tail_add(world_edit(world), world->document->rig_count - 1, -1, &world->error));
    assert_false(world_step(world, world_do(world, "tail 0 -1")));
    assert_string_equal(world->error.text, "there are 1024 rigs, and no more fit");
    judge(world_print(world), NULL);
}

WORLD_TEST(channels_of_an_edit, world_open(world))
{
    while (document_tail(world->document, 0)->channel_count < 64)
        world_must(world, world_do(world, "channel t pluck up displacement"));
    assert_refused(world, world_do(world, "channel t pluck up total"), "t: at most 64 channels fit");
}

/// So many samples each of so many splines, the first ones with a limit.
TEST(samples_of_a_scene)
{
    static const char one[] =
        "splines[0].limits: expected at most 20000 samples where a spline has a low or high limit",
                      all[] =
                          "splines[10].limits: expected at most 200000 samples over all splines with a low or high "
                          "limit, got 11 times 18182";
    static const struct {
        int splines, samples, limited;
        const char *says; ///< NULL: taken
        int longest;      ///< frames that fit
    } rows[] = {
        {10, 100000, 0, NULL, 99999},
        {1, 100001, 0, "frames: expected at most 100000 samples a spline, got 100001", 0},
        {11, 90909, 0, NULL, 90908},
        {11, 90910, 0, "frames: expected at most 1000000 samples over all splines, got 11 times 90910", 0},
        {2, 20000, 1, NULL, 19999},
        {12, 20000, 10, NULL, 19999},
        {12, 18181, 11, NULL, 18180},
        {12, 18182, 11, all, 0},
        {2, 20001, 1, one, 0},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        struct text text = {0};
        append(&text, "{'wiggly': 1, 'frames': [0, %d], 'splines': [", rows[i].samples - 1);
        for (int s = 0; s < rows[i].splines; s++)
            append(&text, "%s{'name': 's%d'%s}", s ? ", " : "", s,
                   s < rows[i].limited ? ", 'limits': [0, null]" : "");
        append(&text, "]}");
        if (!rows[i].says) {
            struct document *document = document_of(&text);
            assert_int_equal(document_longest(document), rows[i].longest);
            document_destroy(document);
        }
        judge_text(&text, rows[i].says);
    }
}

/// Each pin takes a solve of each spline that it moves, and a floor one of each dip. Pins count over all rigs together.
TEST(samples_of_pins)
{
    static const char pins[] = "rigs[0].pins: expected at most 1048576 samples over all pins",
                      floors[] = "rigs[0].floor: expected at most 1048576 samples over all pins";
    static const char tail[] = "'type': 'tail', 'name': 't'", soft[] = "'type': 'character', 'model': 'm.glb'";
    static const struct {
        int pins, splines, last; ///< frame
        const char *rig, *says;  ///< what the file has before the pins; NULL: taken
    } rows[] = {
        {5, 2, 99999, tail, NULL},
        {10, 2, 52427, tail, NULL},
        {10, 2, 52428, tail, pins},
        {11, 2, 52427, tail, pins},
        {10, 3, 52427, tail, pins},
        {0, 2, 10484, "'type': 'character', 'model': 'm.glb', 'floor': 0", NULL},
        {0, 2, 10485, "'type': 'character', 'model': 'm.glb', 'floor': 0", floors},
        {0, 2, 99999, soft, NULL},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        struct text text = {0};
        append(&text, "{'wiggly': 1, 'frames': [0, %d], 'splines': [", rows[i].last);
        append_many(&text, "{'name': 's%d', 'frequency': 1}", rows[i].splines);
        append(&text, "], 'rigs': [{%s, '%s': [", rows[i].rig, rows[i].pins > 0 ? "channels" : "coordinates");
        append_many(&text, "{'name': 'c', 'spline': 's%d'}", rows[i].splines);
        append(&text, "], 'pins': [");
        append_many(&text, "{'frame': %d, 'joint': 3, 'to': [0, 0, 0]}", rows[i].pins);
        append(&text, "]}]}");
        judge_text(&text, rows[i].says);
    }
    for (int most = 1023; most <= 1025; most++) {
        struct text text = {0};
        append(&text, PINNED);
        append_many(&text, "{'frame': %d, 'joint': 3, 'to': [0, 0, 0]}", 512);
        append(&text, "]}, {'type': 'tail', 'name': 'u', 'spline': 's', 'pins': [");
        append_many(&text, "{'frame': %d, 'joint': 3, 'to': [0, 0, 0]}", most - 512);
        append(&text, "]}]}");
        judge_text(&text, most > 1024 ? "at most 1024 pins over all rigs" : NULL);
    }
}

/// An edit is held to the same.
TEST(pins_of_an_edit)
{
    struct world world;
    world_open_scene(&world,
                     json("{'frames': [0, 95324], 'splines': [{'name': 's', 'frequency': 1}], 'rigs': [{'type': "
                          "'tail', 'name': 't', 'spline': 's'}]}"));
    world_do_all(&world,
                 "pin t 0 3 0 0 0; pin t 1 3 0 0 0; pin t 2 3 0 0 0; pin t 3 3 0 0 0; pin t 4 3 0 0 0; pin t 5 3 0 "
                 "0 0; pin t 6 3 0 0 0; pin t 7 3 0 0 0; pin t 8 3 0 0 0; pin t 9 3 0 0 0; pin t 10 3 0 0 0");
    world_must(&world, true);
    static const char *const edits[] = {"pin t 11 3 0 0 0", "range 0 95325 refuse"};
    for (int i = 0; i < 2; i++) {
        assert_false(world_step(&world, world_do(&world, edits[i])));
        assert_non_null(strstr(world.error.text, "t: pins: expected at most 1048576 samples over all pins"));
        assert_file_says(world.document, "r0.p#=11; frames=[0,95324]", edits[i]);
    }
    world_must(&world, world_do(&world, "range 0 200 refuse"));
    for (int n = 11; n < 1024; n++)
        world_must(&world,
                   edit_pin_set(world_edit(&world), 0, &(struct pin){n % 200, n / 200 + 4, {0}, 0, NULL}, NULL));
    assert_refused(&world, world_do(&world, "pin t 1 0 0 0 0"), "the limit of 1024 pins is reached");
    world_close(&world);
}

/// Joints of tails count once, and again for each channel.
TEST(joints_of_all_tails)
{
    static const char says[] =
        "rigs: expected at most 200000 joints over all tails, counted once and for each channel, got ";
    static const struct {
        int tails, joints, channels;
        bool is_taken;
    } rows[] = {{781, 256, 0, true},  {782, 256, 0, false}, {12, 256, 64, true},
                {13, 256, 64, false}, {1000, 100, 1, true}, {1001, 100, 1, false}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        struct text text = {0};
        append(&text, RIGS);
        for (int t = 0; t < rows[i].tails; t++) {
            append(&text, "%s{'type': 'tail', 'name': 't%d', 'joints': %d, 'channels': [", t ? ", " : "", t,
                   rows[i].joints);
            append_many(&text, "{'spline': 's'}", rows[i].channels);
            append(&text, "]}");
        }
        append(&text, "]}");
        if (rows[i].is_taken) { // and no more of the same
            struct document *document = document_of(&text);
            assert_false(edit_tail_add(document, 0, -1, NULL));
            document_destroy(document);
        }
        judge_text(&text, rows[i].is_taken ? NULL : says);
    }
}

/// A name has no limit: a long one comes back from its file byte by byte.
TEST(names_of_any_length)
{
    static const int lengths[] = {1, 63, 64, 65, 255, 256, 257, 1023, 1024, 1025, 100000};
    for (size_t i = 0; i < sizeof lengths / sizeof *lengths; i++) {
        char *name = calloc(1, (size_t)lengths[i] + 1);
        struct document *document = document_of_text(
            json("{'frames': [0, 48], 'splines': [{'name': 's'}], 'rigs': [{'type': 'tail', 'name': 't'}]}"));
        memset(name, 'n', (size_t)lengths[i]);
        assert_done(edit_spline_name(document, 0, name, &error));
        assert_done(edit_rig_name(document, 0, name, &error));
        char *printed = text_of_document(document);
        document_destroy(document);
        document = document_of_text(printed);
        assert_string_equal(document->splines[0]->name, name);
        assert_prints(document, printed);
        document_destroy(document);
        free(printed);
        free(name);
    }
}

/// A file of exactly as many bytes as are read, one less, one more.
TEST_WITH(folder_make, folder_remove, bytes_of_a_file)
{
    const char *path = folder_file("ten", "0123456789");
    for (size_t limit = 9; limit <= 11; limit++) {
        struct error error = {0};
        char *data;
        size_t size;
        const bool read = file_read(path, limit, &data, &size, &error);
        assert_int_equal(read, limit >= 10);
        if (!read) continue;
        assert_int_equal(size, 10);
        assert_string_equal(data, "0123456789");
        free(data);
    }
}

TEST(pins_and_bounds_of_a_group)
{
    for (int pins = 4095; pins <= 4097; pins++) {
        wiggly_group *group = NULL;
        const wiggly_status status = wiggly_group_create(2, 1, 1, pins, &group);
        assert_int_equal(status, pins <= WIGGLY_MOST_PINS ? WIGGLY_OK : WIGGLY_ERROR_ARGUMENT);
        if (status == WIGGLY_OK) wiggly_group_destroy(group);
    }
    for (int samples = -1; samples <= 1; samples++) {
        wiggly_solver *solver = NULL;
        const wiggly_status status = wiggly_create(samples, 1, &solver);
        assert_int_equal(status, samples >= 1 ? WIGGLY_OK : WIGGLY_ERROR_ARGUMENT);
        if (status == WIGGLY_OK) wiggly_destroy(solver);
    }
}
