/// Every limit that a scene, an edit or the library names: what lies one below it and at it is taken, what lies one above it is refused
/// with a sentence that says the limit. The limits stand here as numbers, as the manual has them.

#include "folder.h"
#include "world.h"

#include "base/file.h"

enum { TEXT = 1 << 20 };

#define FRAMES "\"wiggly\": 1, \"frames\": [0, 48]"
#define SPLINE "\"splines\": [{\"name\": \"s\", \"knots\": [{\"frame\": 0, \"value\": 1}]}]"
#define TAIL "\"type\": \"tail\", \"name\": \"t\""
#define SOFT "\"type\": \"character\", \"model\": \"m.glb\""
#define RIGS "{" FRAMES ", " SPLINE ", \"rigs\": ["

static struct document *parse(const char *text, size_t size, struct error *error)
{
    *error = (struct error){0};
    return scene_parse("bounds.json", text, size, NULL, error);
}

static void takes(const char *text)
{
    struct error error;
    struct document *document = parse(text, strlen(text), &error);
    if (!document) fail_msg("%s\nin %.200s", error.text, text);
    document_destroy(document);
}

static void refuses(const char *text, const char *fragment)
{
    struct error error;
    struct document *document = parse(text, strlen(text), &error);
    if (document) fail_msg("taken: %.200s", text);
    if (!strstr(error.text, fragment)) fail_msg("\"%s\" does not say \"%s\"", error.text, fragment);
}

/// A number with a least and a most that are taken; `format` is the scene with it.
static const struct number {
    const char *format;
    long least, most;
    const char *says;
} numbers[] = {
    {"{" FRAMES ", \"substeps\": %ld}", 1, 1024, "from 1 to 1024"},
    {"{" FRAMES ", \"fps\": %ld}", 1, 100000, "above 0 and at most 100000"},
    {"{\"wiggly\": 1, \"frames\": [%ld, -999999990]}", -1000000000, -999999990, NULL},
    {"{\"wiggly\": 1, \"frames\": [999999990, %ld]}", 999999990, 1000000000, NULL},
    {"{\"wiggly\": 1, \"frames\": [1, %ld]}", 1, 100000, NULL},
    {"{\"wiggly\": 1, \"substeps\": 10, \"frames\": [0, %ld]}", 0, 9999, NULL},
    {RIGS "{\"type\": \"tail\", \"name\": \"t\", \"spline\": \"s\", \"joints\": %ld}]}", 1, 256, "from 1 to 256"},
    {"{" FRAMES ", \"splines\": [{\"name\": \"s\", \"variation\": {\"amount\": 0.5, \"seed\": %ld}}]}", 0, 999999,
     "from 0 to 999999"},
};

TEST(numbers_of_a_scene)
{
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++) {
        const struct number *n = &numbers[i];
        const long good[] = {n->least, n->least + (n->least < n->most), n->most - (n->most > n->least), n->most};
        char text[512];
        for (int k = 0; k < 4; k++) {
            snprintf(text, sizeof text, n->format, good[k]);
            takes(text);
        }
        snprintf(text, sizeof text, n->format, n->least - 1);
        refuses(text, n->says ? n->says : "expected");
        snprintf(text, sizeof text, n->format, n->most + 1);
        refuses(text, n->says ? n->says : "expected");
    }
}

/// How many of something: `head`, elements with "%d" for their number (twice), `tail`.
static const struct count {
    const char *head, *element, *tail;
    int least, most;
    const char *says;
} counts[] = {
    {"{" FRAMES ", \"rigs\": [", "{\"type\": \"tail\", \"name\": \"t%d\"}", "]}", 0, 1024, "at most 1024 elements"},
    {RIGS "{\"type\": \"tail\", \"name\": \"t\", \"channels\": [", "{\"spline\": \"s\", \"axis\": \"side\"}", "]}]}",
     0, 64, "at most 64 elements"},
    {RIGS "{\"type\": \"tail\", \"name\": \"t\", \"joints\": 4, \"spline\": \"s\", \"lag\": {\"ramp\": [",
     "[0.%04d, 1]", "]}}]}", 2, 32, "from 2 to 32"},
    {RIGS "{\"type\": \"model\", \"name\": \"m\", \"model\": \"m.glb\"}, {\"type\": \"chain\", \"name\": \"c\", "
          "\"model\": \"m\", \"from\": \"a\", \"to\": \"b\", \"channels\": [{\"spline\": \"s\", \"axis\": \"side\", "
          "\"lag\": [",
     "1", "]}]}]}", 1, 256, "from 1 to 256"},
    {RIGS "{\"type\": \"character\", \"model\": \"m.glb\", \"coordinates\": [",
     "{\"name\": \"c%d\", \"spline\": \"s\"}", "]}]}", 0, 4, "at most 4 elements"},
    {"{\"wiggly\": 1, \"frames\": [0, 1023], \"splines\": [{\"name\": \"s\", \"frequency\": 1}], \"rigs\": "
     "[{\"type\": \"tail\", \"name\": \"t\", \"spline\": \"s\", \"pins\": [",
     "{\"frame\": %d, \"joint\": 3, \"to\": [0, 0, 0]}", "]}]}", 0, 1024, "at most 1024"},
    {"{" FRAMES ", \"unknown\": ", "[", "", 0, 63, "at most 64 levels"}, // the scene itself is the first
};

static void print_count(char *text, const struct count *c, int count)
{
    char *at = text + sprintf(text, "%s", c->head);
    const bool nested = c->element[0] == '[' && !c->element[1];
    for (int i = 0; i < count; i++) {
        if (i > 0 && !nested) *at++ = ',';
        at += snprintf(at, 128, c->element, i); // NOLINT: a format of the table above
    }
    for (int i = 0; nested && i < count; i++) *at++ = ']';
    if (nested && count == 0) *at++ = '0';
    sprintf(at, "%s%s", c->tail, nested ? "}" : "");
}

TEST(counts_of_a_scene)
{
    char *text = malloc(TEXT);
    assert_non_null(text);
    for (size_t i = 0; i < sizeof counts / sizeof *counts; i++) {
        const struct count *c = &counts[i];
        const int good[] = {c->least, c->least + 1, c->most - 1, c->most};
        for (int k = 0; k < 4; k++) {
            print_count(text, c, good[k]);
            takes(text);
        }
        if (c->least > 0) {
            print_count(text, c, c->least - 1);
            refuses(text, c->says);
        }
        print_count(text, c, c->most + 1);
        refuses(text, c->says);
    }
    free(text);
}

/// Pins count over all rigs together.
TEST(pins_of_two_rigs)
{
    char *text = malloc(TEXT);
    assert_non_null(text);
    for (int most = 1023; most <= 1025; most++) {
        char *at = text + sprintf(text, "{\"wiggly\": 1, \"frames\": [0, 600], \"splines\": [{\"name\": \"s\", "
                                        "\"frequency\": 1}], \"rigs\": [");
        for (int rig = 0, i = 0; rig < 2; rig++) {
            at += sprintf(at, "%s{\"type\": \"tail\", \"name\": \"t%d\", \"spline\": \"s\", \"pins\": [",
                          rig ? "," : "", rig);
            for (int first = i; i < (rig ? most : 512); i++)
                at += sprintf(at, "%s{\"frame\": %d, \"joint\": 3, \"to\": [0, 0, 0]}", i > first ? "," : "",
                              i - first);
            at += sprintf(at, "]}");
        }
        sprintf(at, "]}");
        if (most <= 1024) takes(text);
        if (most > 1024) refuses(text, "at most 1024 pins over all rigs");
    }
    free(text);
}

/// Each parameter of a spline: its own least and most number, and the next number beyond.
TEST(parameters_of_a_spline)
{
    static const char scene[] = "{" FRAMES ", \"splines\": [{\"name\": \"s\", \"%s\": %.17g}]}";
    int tried = 0;
    for (int p = 0; p < PARAMETER_COUNT; p++) {
        const struct parameter_row *row = &parameter_rows[p];
        const char *key = parameter_key((enum parameter)p);
        char text[256];
        if (row->kind == PARAMETER_CHOICE || row->kind == PARAMETER_LIMIT) continue;
        if (p == PARAMETER_VARIATION || p == PARAMETER_SEED) continue; // members of an object
        const double ends[] = {row->minimum, parameter_maximum((enum parameter)p, WIGGLY_COMPLEX)};
        for (int k = 0; k < 2; k++) {
            if (!isfinite(ends[k])) continue;
            snprintf(text, sizeof text, scene, key, ends[k]);
            takes(text);
            snprintf(text, sizeof text, scene, key, nextafter(ends[k], k ? INFINITY : -INFINITY));
            refuses(text, key);
            tried++;
        }
    }
    assert_true(tried >= 7);
}

/// A hundred thousand knots: loaded, one taken away and put back, and no other. In a file one more is refused.
TEST(knots_of_a_scene)
{
    enum { MOST = 100000, EACH = MOST / 2 };
    struct error error;
    char *text = malloc((size_t)40 * MOST);
    assert_non_null(text);
    for (int count = MOST; count <= MOST + 1; count++) {
        char *at = text + sprintf(text, "{\"wiggly\": 1, \"frames\": [0, 60000], \"splines\": [{\"name\": \"s\", "
                                        "\"knots\": [{\"frame\": 0, \"value\": 0}");
        for (int k = 1; k < EACH; k++) at += sprintf(at, ",{\"frame\":%d,\"value\":0}", k);
        at += sprintf(at, "]},{\"name\": \"t\", \"knots\": [{\"frame\": 0, \"value\": 0}");
        for (int k = 1; k < count - EACH; k++) at += sprintf(at, ",{\"frame\":%d,\"value\":0}", k);
        at += sprintf(at, "]}]}");
        struct world world = {.document = parse(text, (size_t)(at - text), &error)};
        if (count > MOST) {
            assert_null(world.document);
            assert_non_null(strstr(error.text, "at most 100000 knots"));
            continue;
        }
        if (!world.document) fail_msg("%s", error.text);
        world.history = history_create(world.document);
        const unsigned first = world.document->splines[0]->knots[5].id;
        assert_false(world_step(&world, edit_insert(&world, 0, EACH + 50, 1)));
        assert_string_equal(world.error.text, "the limit of 100000 knots is reached");
        world_must(&world, edit_knot_remove(world_edit(&world), 0, first, &world.error));
        world_must(&world, edit_insert(&world, 0, EACH + 50, 1));
        assert_false(world_step(&world, edit_insert(&world, 0, 5, 1)));
        history_destroy(world.history);
        document_destroy(world.document);
    }
    free(text);
}

/// Whether an edit that fits the document's limits is taken, and any other refused with a sentence.
static void assert_taken(struct world *world, bool done, const char *says)
{
    if (says) {
        assert_refused(world, done, says);
    } else {
        world_must(world, done);
    }
}

/// The same limits, where an edit would go beyond.
TEST(limits_of_edits)
{
    static const char rate[] = "frames per second must be above 0 and at most 100000";
    static const char subs[] = "substeps must be from 1 to 1024";
    static const char far[] = "frames must be from -1000000000 to 1000000000";
    static const struct {
        double fps;
        const char *says; ///< NULL: taken
    } rates[] = {{99999, NULL}, {100000, NULL}, {100001, rate}, {0, rate}, {(double)NAN, rate}};
    static const struct {
        int substeps;
        const char *says;
    } steps[] = {{2, NULL}, {1, NULL}, {1023, NULL}, {1024, NULL}, {1025, subs}, {0, subs}};
    static const struct {
        int first, last;
        const char *says;
    } ranges[] = {{0, 99999, NULL},
                  {0, 100000, "at most 100000 samples a spline, got 100001"},
                  {0, 1000000000, "at most 100000 samples a spline, got 1000000001"},
                  {0, 1000000001, far},
                  {-1000000001, 0, far},
                  {0, 0x7fffffff, far}};
    struct world world;
    for (size_t i = 0; i < sizeof rates / sizeof *rates; i++) {
        world_open(&world);
        assert_taken(&world, edit_fps(world_edit(&world), rates[i].fps, false, &world.error), rates[i].says);
        world_close(&world);
    }
    for (size_t i = 0; i < sizeof steps / sizeof *steps; i++) {
        world_open(&world);
        assert_taken(&world, edit_substeps(world_edit(&world), steps[i].substeps, &world.error), steps[i].says);
        world_close(&world);
    }
    for (size_t i = 0; i < sizeof ranges / sizeof *ranges; i++) {
        world_open(&world);
        assert_taken(&world, edit_frames(&world, ranges[i].first, ranges[i].last), ranges[i].says);
        world_close(&world);
    }
}

WORLD_TEST(rigs_of_an_edit, world_open(world))
{
    while (world->document->rig_count < 1024) {
        world_must(world, edit_tail_add(world_edit(world), world->document->rig_count - 1, -1, &world->error));
    }
    assert_false(world_step(world, edit_tail_add(world_edit(world), 0, -1, &world->error)));
    assert_string_equal(world->error.text, "there are 1024 rigs, and no more fit");
    const char *text = world_print(world);
    takes(text);
}

/// So many samples each of so many splines, the first ones with a limit.
static void write_long(char *text, int splines, int samples, int limited)
{
    char *at = text + sprintf(text, "{\"wiggly\": 1, \"frames\": [0, %d], \"splines\": [", samples - 1);
    for (int s = 0; s < splines; s++) {
        const char *limits = s < limited ? ", \"limits\": [0, null]" : "";
        at += sprintf(at, "%s{\"name\": \"s%d\"%s}", s ? ", " : "", s, limits);
    }
    sprintf(at, "]}");
}

TEST(samples_of_a_scene)
{
    static const struct {
        int splines, samples;
        int limited;
        const char *says; ///< NULL: taken
    } cases[] = {
        {10, 100000, 0, NULL},
        {1, 100001, 0, "frames: expected at most 100000 samples a spline, got 100001"},
        {11, 90909, 0, NULL},
        {11, 90910, 0, "frames: expected at most 1000000 samples over all splines, got 11 times 90910"},
        {2, 20000, 1, NULL},
        {12, 20000, 10, NULL},
        {12, 18182, 11,
         "splines[10].limits: expected at most 200000 samples over all splines with a low or high limit, got 11 "
         "times "
         "18182"},
        {2, 20001, 1, "splines[0].limits: expected at most 20000 samples where a spline has a low or high limit"},
    };
    char text[2000];
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        write_long(text, cases[i].splines, cases[i].samples, cases[i].limited);
        if (cases[i].says)
            refuses(text, cases[i].says);
        else
            takes(text);
    }
}

/// A limited spline in a longer scene, and a longer scene with a limited spline.
WORLD_TEST(samples_of_limits, world_open(world))
{
    static const char *const says = "at most 20000 samples where a spline has a low or high limit, got 20001";
    world_must(world, edit_frames(world, 0, 20000));
    assert_refused(world, edit_number(world, 0, PARAMETER_HIGH, 1e6), says);
    world_must(world, edit_range(world_edit(world), 0, 19999, RANGE_REFUSE, &world->error));
    world_must(world, edit_number(world, 0, PARAMETER_HIGH, 1e6));
    assert_refused(world, edit_frames(world, 0, 20000), says);
    assert_int_equal(document_longest(world->document), 19999);
}

/// Each pin takes a solve of each spline that it moves, and a floor one of each dip.
TEST(samples_of_pins)
{
    static const struct {
        int pins, splines, last; ///< frame
        const char *rig, *says;  ///< what the file has before the pins; NULL: taken
    } cases[] = {
        {5, 2, 99999, TAIL, NULL},
        {10, 2, 52427, TAIL, NULL},
        {10, 2, 52428, TAIL, "rigs[0].pins: expected at most 1048576 samples over all pins"},
        {11, 2, 52427, TAIL, "rigs[0].pins: expected at most 1048576 samples over all pins"},
        {10, 3, 52427, TAIL, "rigs[0].pins: expected at most 1048576 samples over all pins"},
        {0, 2, 10484, SOFT ", \"floor\": 0", NULL},
        {0, 2, 10485, SOFT ", \"floor\": 0", "rigs[0].floor: expected at most 1048576 samples over all pins"},
        {0, 2, 99999, SOFT, NULL},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[4000],
            *at = text + sprintf(text, "{\"wiggly\": 1, \"frames\": [0, %d], \"splines\": [", cases[i].last);
        const bool is_soft = cases[i].pins == 0;
        for (int s = 0; s < cases[i].splines; s++)
            at += sprintf(at, "%s{\"name\": \"s%d\", \"frequency\": 1}", s ? ", " : "", s);
        at += sprintf(at, "], \"rigs\": [{%s, \"%s\": [", cases[i].rig, is_soft ? "coordinates" : "channels");
        for (int s = 0; s < cases[i].splines; s++)
            at += sprintf(at, "%s{\"name\": \"c\", \"spline\": \"s%d\"}", s ? ", " : "", s);
        at += sprintf(at, "], \"pins\": [");
        for (int p = 0; p < cases[i].pins; p++)
            at += sprintf(at, "%s{\"frame\": %d, \"joint\": 3, \"to\": [0, 0, 0]}", p ? ", " : "", p);
        sprintf(at, "]}]}");
        if (cases[i].says)
            refuses(text, cases[i].says);
        else
            takes(text);
    }
}

/// An edit is held to the same.
TEST(samples_of_an_edit_with_pins)
{
    struct error refusal;
    struct document *document = document_of_text(
        "{\"frames\": [0, 95324], \"splines\": [{\"name\": \"s\", \"frequency\": 1}], \"rigs\": [{" TAIL
        ", \"spline\": \"s\"}]}");
    for (int p = 0; p < 11; p++)
        assert_done(edit_pin_add(document, 0, &(struct pin){.frame = p, .point = 3}, &error));
    assert_false(edit_pin_add(document, 0, &(struct pin){.frame = 11, .point = 3}, &refusal));
    assert_non_null(strstr(refusal.text, "t: pins: expected at most 1048576 samples over all pins"));
    assert_false(edit_range(document, 0, 95325, RANGE_REFUSE, &refusal));
    assert_int_equal(document->rigs[0]->pin_count, 11);
    assert_int_equal(document->last_frame, 95324);
    document_destroy(document);
}

/// Joints of tails count once, and again for each channel.
TEST(joints_of_all_tails)
{
    static const struct {
        int tails, joints, channels;
        bool is_taken;
    } cases[] = {{781, 256, 0, true},  {782, 256, 0, false}, {12, 256, 64, true},
                 {13, 256, 64, false}, {1000, 100, 1, true}, {1001, 100, 1, false}};
    struct error refusal;
    char *text = malloc(TEXT);
    assert_non_null(text);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char *at = text + sprintf(text, "%s", RIGS);
        for (int t = 0; t < cases[i].tails; t++) {
            at += sprintf(at, "%s{\"type\": \"tail\", \"name\": \"t%d\", \"joints\": %d, \"channels\": [",
                          t ? ", " : "", t, cases[i].joints);
            for (int c = 0; c < cases[i].channels; c++) at += sprintf(at, "%s{\"spline\": \"s\"}", c ? "," : "");
            at += sprintf(at, "]}");
        }
        sprintf(at, "]}");
        if (!cases[i].is_taken) {
            refuses(text,
                    "rigs: expected at most 200000 joints over all tails, counted once and for each channel, got ");
            continue;
        }
        struct document *document = document_of_text(text);
        assert_false(edit_tail_add(document, 0, -1, &refusal)); // one more of the same
        document_destroy(document);
    }
    free(text);
}

/// A name has no limit: a long one comes back from its file byte by byte.
TEST(names_of_any_length)
{
    static const int lengths[] = {1, 63, 64, 65, 255, 256, 257, 1023, 1024, 1025, 100000};
    char *text = malloc(TEXT), *name = malloc(TEXT);
    assert_true(text && name);
    for (size_t i = 0; i < sizeof lengths / sizeof *lengths; i++) {
        memset(name, 'n', (size_t)lengths[i]);
        name[lengths[i]] = '\0';
        sprintf(text,
                "{" FRAMES ", \"splines\": [{\"name\": \"%s\"}], \"rigs\": [{\"type\": \"tail\", \"name\": \"%s\"}]}",
                name, name);
        struct document *document = document_of_text(text);
        char *printed = text_of_document(document);
        document_destroy(document);
        document = document_of_text(printed);
        assert_string_equal(document->splines[0]->name, name);
        assert_prints(document, printed);
        document_destroy(document);
        free(printed);
    }
    free(text);
    free(name);
}

/// A file of exactly as many bytes as are read, one less, one more; sparse where it is large.
TEST_WITH(folder_make, folder_remove, bytes_of_a_file)
{
    struct error error = {0};
    char *data;
    size_t size;
    for (size_t limit = 9; limit <= 11; limit++) {
        assert_true(file_write_atomic(folder_path("ten"), "0123456789", 10, &error));
        const bool read = file_read(folder_path("ten"), limit, &data, &size, &error);
        assert_int_equal(read, limit >= 10);
        if (read) {
            assert_int_equal(size, 10);
            assert_string_equal(data, "0123456789");
            free(data);
        }
    }
}

TEST(pins_and_bounds_of_a_group)
{
    wiggly_group *group;
    for (int pins = 4095; pins <= 4097; pins++) {
        const wiggly_status expected = pins <= WIGGLY_MOST_PINS ? WIGGLY_OK : WIGGLY_ERROR_ARGUMENT;
        group = NULL;
        assert_int_equal(wiggly_group_create(2, 1, 1, pins, &group), expected);
        if (expected == WIGGLY_OK) wiggly_group_destroy(group);
    }
    for (int one = -1; one <= 1; one++) {
        wiggly_solver *solver = NULL;
        const wiggly_status status = wiggly_create(one, 1, &solver);
        assert_int_equal(status, one >= 1 ? WIGGLY_OK : WIGGLY_ERROR_ARGUMENT);
        if (status == WIGGLY_OK) wiggly_destroy(solver);
    }
}
