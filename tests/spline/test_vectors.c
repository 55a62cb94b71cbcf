/// Exact answers in 60-digit arithmetic, through the same path as the app: scene file → document → solver, by the chain and by the band, which
/// agree to 1e-9 of the range. tests/vectors has splines, tests/vectors/pins groups with pins. The tolerances are those of
/// docs/mathematics.md: 1e-9 of the range for cubic splines, else 1e-8. The textbook, by which other tests judge the solver, has to meet them
/// to 1e-12.
#include "documents.h"

#include "base/file.h"
#include "curve.h"
#include "scene/evaluate.h"
#include "textbook.h"
#include <dirent.h>
#include <jansson.h>

enum { MOST_SPLINES = 8, MOST_PINS = 40, MOST_KNOTS = 64, WAYS = 3 };

static struct textbook book;

/// Calls `check` with each scene's path without .json; returns the number of scenes.
static int each_vector(const char *folder, void (*check)(const char *path))
{
    DIR *directory = opendir(folder);
    int count = 0;
    assert_non_null(directory);
    for (struct dirent *entry; (entry = readdir(directory));) {
        char path[512], *dot = strstr(entry->d_name, ".json");
        if (!dot) continue;
        snprintf(path, sizeof path, "%s/%.*s", folder, (int)(dot - entry->d_name), entry->d_name);
        check(path);
        count++;
    }
    closedir(directory);
    return count;
}

/// The numbers of PATH.csv after its header: the time, then total, Re x and Im x of each spline. The caller frees them.
static double *table_of(const char *path, int splines, int rows)
{
    const int count = (1 + 3 * splines) * rows;
    char name[520], *text, *end;
    size_t size;
    snprintf(name, sizeof name, "%s.csv", path);
    assert_done(file_read(name, (size_t)1 << 26, &text, &size, &error));
    double *numbers = malloc(sizeof *numbers * (size_t)count);
    const char *at = strchr(text, '\n');
    for (int i = 0; i < count; i++, at = end) {
        numbers[i] = strtod(at + 1, &end);
        if (end == at + 1) fail_msg("%s: fewer than %d numbers", name, count);
    }
    free(text);
    return numbers;
}

/// The largest difference in total, Re x and Im x to what is at `exact`, `columns` numbers a sample, relative to the total's range or
/// magnitude.
static double error_of(const double *total, const double *re, const double *im, int samples, const double *exact,
                       int columns)
{
    double low = INFINITY, high = -INFINITY, worst = 0;
    for (int i = 0; i < samples; i++, exact += columns) {
        low = fmin(low, exact[0]), high = fmax(high, exact[0]);
        worst = fmax(worst, fabs(total[i] - exact[0]));
        worst = fmax(worst, fmax(fabs(re[i] - exact[1]), fabs(im[i] - exact[2])));
        if (isnan(total[i] + re[i] + im[i])) return INFINITY;
    }
    const double size = fmax(high - low, fmax(fabs(low), fabs(high)));
    return size > 0 ? worst / size : worst;
}

static double curve_error(const wiggly_curve *curve, const double *exact, int columns)
{
    return error_of(curve->total, curve->re, curve->im, curve->samples, exact, columns);
}

/// How far two curves are apart, of the range.
static double apart(const wiggly_curve *a, const wiggly_curve *b)
{
    double *rows = malloc(3 * sizeof *rows * (size_t)b->samples);
    for (int i = 0; i < b->samples; i++)
        rows[3 * i] = b->total[i], rows[3 * i + 1] = b->re[i], rows[3 * i + 2] = b->im[i];
    const double error = curve_error(a, rows, 3);
    free(rows);
    return error;
}

/// The textbook's own answer; the total of a spline that is another's track is what the table says.
static void check_textbook(const char *path, const struct document *document, const struct evaluation *evaluation,
                           int s, const double *table, wiggly_status expected)
{
    static double tracks[4][TEXTBOOK_MAX];
    static double total[TEXTBOOK_MAX], re[TEXTBOOK_MAX], im[TEXTBOOK_MAX];
    const int columns = 1 + 3 * document->spline_count;
    wiggly_knot knots[MOST_KNOTS];
    wiggly_status status;
    assert_in_range(document->splines[s]->knot_count, 0, MOST_KNOTS);
    wiggly_desc desc = evaluation_describe(evaluation, document, s, knots);
    wiggly_param *params[] = {&desc.frequency, &desc.damping, &desc.bandwidth, &desc.equilibrium};
    for (int p = 0; p < 4; p++) {
        int of = 0;
        if (!params[p]->track) continue;
        while (params[p]->track != evaluation->curves[of].total) of++;
        for (int i = 0; i < desc.samples; i++) tracks[p][i] = table[columns * i + 1 + 3 * of];
        params[p]->track = tracks[p];
    }
    if (!textbook_curve(&desc, &book, &status, total, re, im)) fail_msg("%s, the textbook: singular", path);
    const double worst = error_of(total, re, im, desc.samples, table + 1 + 3 * s, columns);
    if (!(worst <= 1e-12)) fail_msg("%s, spline %d, the textbook: off by %g of its range", path, s, worst);
    if (status != expected) fail_msg("%s, spline %d, the textbook: %s", path, s, wiggly_status_text(status));
}

static int checked; ///< scenes that the textbook can hold

/// One is a loop of calm 0 that its equilibrium drives in resonance: its answer is the one with calm 0.05, and all say so.
static void check_scene(const char *path)
{
    char name[520];
    snprintf(name, sizeof name, "%s.json", path);
    struct document *document = document_of_file(name);
    const int samples = document_samples(document), columns = 1 + 3 * document->spline_count;
    double *table = table_of(path, document->spline_count, samples);
    const char *const names[WAYS] = {"chain", "band", samples <= SOLVER_LONGEST_BAND ? "band" : "chain"};
    struct evaluation ways[WAYS] = {{.solver = SOLVER_CHAIN}, {.solver = SOLVER_BAND}, {.solver = SOLVER_BY_LENGTH}};
    for (int w = 0; w < WAYS; w++) {
        evaluation_update(&ways[w], document, false);
        assert_string_equal(evaluation_solver(&ways[w]), names[w]);
    }
    for (int s = 0; s < document->spline_count; s++) {
        const struct spline *of = document->splines[s];
        const bool is_calmed = strstr(path, "/loop_resonant") && strcmp(of->name, "x") == 0;
        const wiggly_status expected = is_calmed ? WIGGLY_CALMED : WIGGLY_OK;
        const double tolerance = spline_mode(of) == WIGGLY_CUBIC ? 1e-9 : 1e-8;
        for (int w = 0; w < WAYS; w++) {
            const double worst = curve_error(&ways[w].curves[s], table + 1 + 3 * s, columns);
            if (!(worst <= tolerance) || ways[w].status[s] != expected)
                fail_msg("%s, %s, by the %s: %s, off by %g of its range", path, of->name, evaluation_solver(&ways[w]),
                         wiggly_status_text(ways[w].status[s]), worst);
        }
        const double between = apart(&ways[0].curves[s], &ways[1].curves[s]);
        if (!(between <= 1e-9)) fail_msg("%s, %s: band and chain are %g of its range apart", path, of->name, between);
        if (samples <= TEXTBOOK_MAX) check_textbook(path, document, &ways[0], s, table, expected);
    }
    checked += samples <= TEXTBOOK_MAX;
    for (int w = 0; w < WAYS; w++) evaluation_free(&ways[w]);
    free(table);
    document_destroy(document);
}

TEST(chain_band_and_textbook_meet_every_vector)
{
    assert_true(each_vector("tests/vectors", check_scene) >= 35);
    assert_true(checked >= 60);
}

/// Reads one problem and its answer; false at the end of the file.
static bool read_problem(FILE *file, wiggly_desc *desc, double tracks[4][TEXTBOOK_MAX], wiggly_knot *knots,
                         double expected[][3])
{
    int mode, start, passive, has_slope;
    double fps;
    *desc = wiggly_default_desc();
    if (fscanf(file, "%d %lf %d %d %d %lf %*d %d", &desc->samples, &fps, &mode, &start, &passive, &desc->calm,
               &desc->knot_count) != 7)
        return false;
    assert_true(desc->samples <= TEXTBOOK_MAX && desc->knot_count <= MOST_KNOTS);
    desc->step = 1 / fps, desc->knots = knots;
    desc->mode = (wiggly_mode)mode, desc->start = (wiggly_start)start, desc->passive = (wiggly_passive)passive;
    wiggly_param *params[] = {&desc->frequency, &desc->damping, &desc->bandwidth, &desc->equilibrium};
    for (int p = 0; p < 4; p++) {
        int varies;
        assert_int_equal(fscanf(file, "%*s %d", &varies), 1);
        for (int i = 0; i < (varies ? desc->samples : 1); i++)
            assert_int_equal(fscanf(file, "%lf", &tracks[p][i]), 1);
        *params[p] = (wiggly_param){tracks[p][0], varies ? tracks[p] : NULL};
    }
    for (wiggly_knot *k = knots; k < knots + desc->knot_count; k++) {
        assert_int_equal(
            fscanf(file, " knot %d %lf %d %lf %lf", &k->sample, &k->value, &has_slope, &k->slope, &k->stiffness), 5);
        k->has_slope = has_slope;
    }
    for (int i = 0; i < desc->samples; i++) {
        assert_int_equal(fscanf(file, "%lf %lf %lf", &expected[i][0], &expected[i][1], &expected[i][2]), 3);
    }
    return true;
}

/// tests/textbook/small.txt: what the vectors lack. A problem is a line of samples, rate, mode, start, passive, calm, 0, and
/// knots; its parameters (0: a number, 1: a track); its knots (sample, value, whether a slope, slope, stiffness); and total,
/// Re x, Im x of every sample in 60-digit arithmetic.
TEST(the_textbook_meets_every_small_problem)
{
    static double tracks[4][TEXTBOOK_MAX], expected[TEXTBOOK_MAX][3];
    static double total[TEXTBOOK_MAX], re[TEXTBOOK_MAX], im[TEXTBOOK_MAX];
    wiggly_knot knots[MOST_KNOTS] = {0};
    wiggly_desc desc;
    int problems = 0;
    FILE *file = fopen("tests/textbook/small.txt", "r");
    assert_non_null(file);
    for (; read_problem(file, &desc, tracks, knots, expected); problems++) {
        if (!textbook_as(&desc, WIGGLY_OK, &book, total, re, im)) fail_msg("problem %d: singular", problems);
        for (int i = 0; i < desc.samples; i++) {
            const double size = 1 + fabs(expected[i][1]) + fabs(expected[i][2]);
            const double off = fmax(fabs(total[i] - expected[i][0]), fabs(re[i] - expected[i][1]));
            if (!(fmax(off, fabs(im[i] - expected[i][2])) <= 1e-12 * size))
                fail_msg("problem %d, sample %d: %g %g %g", problems, i, total[i], re[i], im[i]);
        }
    }
    fclose(file);
    assert_true(problems >= 24);
}

// --- groups with pins ------------------------------------------------------------------------------------------------

/// A group as a file has it, and its splines by their numbers in the scene.
struct sheet {
    json_t *file;
    int splines, pins, number[MOST_SPLINES];
    double weights[MOST_SPLINES];
    wiggly_pull pulls[MOST_PINS][MOST_SPLINES];
    wiggly_pin pin[MOST_PINS];
};

static double number_at(const json_t *array, int i) { return json_number_value(json_array_get(array, (size_t)i)); }

static void read_sheet(struct sheet *sheet, const struct document *document)
{
    const json_t *names = json_object_get(sheet->file, "group"), *pins = json_object_get(sheet->file, "pins");
    sheet->splines = (int)json_array_size(names), sheet->pins = (int)json_array_size(pins);
    for (int p = 0; p < sheet->pins; p++) {
        const json_t *from = json_array_get(pins, (size_t)p);
        wiggly_pin *pin = &sheet->pin[p];
        pin->sample = (int)json_integer_value(json_object_get(from, "sample"));
        pin->pulls = sheet->pulls[p];
        for (int i = 0; i < 3; i++) pin->to[i] = number_at(json_object_get(from, "to"), i);
        for (int s = 0; s < sheet->splines; s++) {
            const char *name = json_string_value(json_array_get(names, (size_t)s));
            const json_t *c = json_object_get(json_object_get(from, "pulls"), name);
            if (!c) continue;
            wiggly_pull *pull = &sheet->pulls[p][pin->pull_count++];
            pull->spline = s;
            for (int i = 0; i < 6; i++) pull->c[i / 2][i % 2] = number_at(json_array_get(c, (size_t)i / 2), i % 2);
        }
    }
    for (int s = 0; s < sheet->splines; s++) {
        const char *name = json_string_value(json_array_get(names, (size_t)s));
        sheet->weights[s] = json_number_value(json_object_get(json_object_get(sheet->file, "weight"), name));
        while (strcmp(document->splines[sheet->number[s]]->name, name) != 0) sheet->number[s]++;
    }
}

static void check_group(const char *path)
{
    static struct sheet sheet;
    char name[520];
    json_error_t problem;
    snprintf(name, sizeof name, "%s.json", path);
    sheet = (struct sheet){.file = json_load_file(name, 0, &problem)};
    if (!sheet.file) fail_msg("%s: %s", name, problem.text);
    char *text = json_dumps(json_object_get(sheet.file, "scene"), 0);
    struct document *document = document_of_text(text);
    read_sheet(&sheet, document);
    const int samples = document_samples(document), columns = 1 + 3 * sheet.splines;
    double *table = table_of(path, sheet.splines, samples),
           *memory = calloc((size_t)(5 * samples * MOST_SPLINES), sizeof *memory);
    struct evaluation evaluation = {0};
    evaluation_update(&evaluation, document, false);
    for (int method = WIGGLY_CHAIN; method <= WIGGLY_BAND; method++) {
        wiggly_group *group;
        wiggly_desc descs[MOST_SPLINES];
        wiggly_curve curves[MOST_SPLINES];
        wiggly_knot knots[MOST_SPLINES][16];
        assert_int_equal(wiggly_group_create(samples, 16, sheet.splines, sheet.pins, &group), WIGGLY_OK);
        wiggly_group_set_method(group, (wiggly_method)method);
        for (int s = 0; s < sheet.splines; s++) {
            descs[s] = evaluation_describe(&evaluation, document, sheet.number[s], knots[s]);
            curves[s] = curve_in(memory + 5 * samples * s, samples);
        }
        const wiggly_status status =
            wiggly_group_solve(group, descs, sheet.weights, curves, sheet.splines, sheet.pin, sheet.pins);
        if (status != WIGGLY_OK) fail_msg("%s: %s", path, wiggly_status_text(status));
        for (int s = 0; s < sheet.splines; s++) {
            const double worst = curve_error(&curves[s], table + 1 + 3 * s, columns);
            if (!(worst <= 1e-8)) fail_msg("%s, spline %d: off by %g of its range", path, s, worst);
        }
        for (int i = 0; i < 3 * sheet.pins; i++) {
            const json_t *left = json_array_get(json_object_get(sheet.file, "left"), (size_t)i / 3);
            const double off = sheet.pin[i / 3].left[i % 3] - number_at(left, i % 3);
            if (!(fabs(off) <= 1e-9)) fail_msg("%s, pin %d: what is left of it is off by %g", path, i / 3, off);
        }
        wiggly_group_destroy(group);
    }
    evaluation_free(&evaluation);
    free(memory), free(table), free(text);
    document_destroy(document);
    json_decref(sheet.file);
}

TEST(groups_meet_every_vector) { assert_true(each_vector("tests/vectors/pins", check_group) >= 9); }
