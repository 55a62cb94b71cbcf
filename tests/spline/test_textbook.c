/// The judge of the solver is judged itself: the textbook's answers against those of tests/vectors (60-digit arithmetic).
#include "textbook.h"
#include "vectors.h"
#include <jansson.h>

enum { MAX_SPLINES = 4, MAX_KNOTS = 64 };

static const char folder[] = "tests/vectors";

/// A scene's splines; the total of one that is another's track is what the CSV says.
struct scene {
    json_t *root;
    int samples, substeps, first_frame, count;
    double *table;
    double totals[MAX_SPLINES][TEXTBOOK_MAX];
};

/// false where it has more samples than the textbook takes.
static bool read_scene(struct scene *scene, const char *name)
{
    char path[512];
    snprintf(path, sizeof path, "%s/%s.json", folder, name);
    scene->root = json_load_file(path, 0, NULL);
    assert_non_null(scene->root);
    json_t *frames = json_object_get(scene->root, "frames"), *substeps = json_object_get(scene->root, "substeps");
    scene->first_frame = (int)json_integer_value(json_array_get(frames, 0));
    scene->substeps = substeps ? (int)json_integer_value(substeps) : 1;
    scene->samples = ((int)json_integer_value(json_array_get(frames, 1)) - scene->first_frame) * scene->substeps + 1;
    scene->count = (int)json_array_size(json_object_get(scene->root, "splines"));
    if (scene->samples > TEXTBOOK_MAX) return false;
    const int columns = 1 + 3 * scene->count;
    scene->table = vectors_table(folder, name, columns, scene->samples);
    for (int i = 0; i < scene->samples * scene->count; i++)
        scene->totals[i % scene->count][i / scene->count] =
            scene->table[i / scene->count * columns + 1 + 3 * (i % scene->count)];
    return true;
}

static int index_of(const char *const *names, const char *text)
{
    int i = 0;
    while (strcmp(names[i], text) != 0) i++;
    return i;
}

static int choice(const json_t *spline, const char *key, const char *const *names)
{
    const char *text = json_string_value(json_object_get(spline, key));
    return text ? index_of(names, text) : 0;
}

static void read_param(const struct scene *scene, const json_t *spline, const char *key, wiggly_param *param)
{
    const json_t *value = json_object_get(spline, key);
    if (json_is_number(value)) param->value = json_number_value(value);
    if (!json_is_object(value)) return;
    const char *names[MAX_SPLINES];
    for (int s = 0; s < scene->count; s++) {
        const json_t *other = json_array_get(json_object_get(scene->root, "splines"), (size_t)s);
        names[s] = json_string_value(json_object_get(other, "name"));
    }
    param->track = scene->totals[index_of(names, json_string_value(json_object_get(value, "spline")))];
}

static wiggly_desc read_desc(const struct scene *scene, const json_t *spline, wiggly_knot *knots)
{
    wiggly_desc desc = wiggly_default_desc();
    const json_t *fps = json_object_get(scene->root, "fps"), *calm = json_object_get(spline, "calm"), *knot;
    desc.samples = scene->samples;
    desc.step = 1 / ((fps ? json_number_value(fps) : 24) * scene->substeps);
    desc.mode = (wiggly_mode)choice(spline, "mode", (const char *[]){"complex", "real", "cubic"});
    desc.start = (wiggly_start)choice(spline, "start", (const char *[]){"free", "rest", "loop"});
    desc.passive = (wiggly_passive)choice(spline, "passive", (const char *[]){"oscillator", "filter"});
    if (calm) desc.calm = json_number_value(calm);
    desc.wind_up = json_number_value(json_object_get(spline, "wind_up"));
    read_param(scene, spline, "frequency", &desc.frequency);
    read_param(scene, spline, "damping", &desc.damping);
    read_param(scene, spline, "bandwidth", &desc.bandwidth);
    read_param(scene, spline, "equilibrium", &desc.equilibrium);
    const json_t *k = json_object_get(spline, "spring"), *gamma = json_object_get(spline, "friction");
    if (k || gamma)
        wiggly_from_spring(json_number_value(k), json_number_value(gamma), &desc.frequency.value,
                           &desc.damping.value);
    desc.knots = knots;
    size_t n;
    json_array_foreach(json_object_get(spline, "knots"), n, knot)
    {
        const json_t *slope = json_object_get(knot, "slope"), *stiffness = json_object_get(knot, "stiffness"),
                     *phase = json_object_get(knot, "im");
        double frame = json_number_value(json_object_get(knot, "frame"));
        knots[desc.knot_count++] = (wiggly_knot){
            .sample = (int)floor((frame - scene->first_frame) * scene->substeps + 0.5),
            .value = json_number_value(json_object_get(knot, "value")),
            .has_slope = slope != NULL,
            .slope = json_number_value(slope),
            .stiffness = stiffness ? json_number_value(stiffness) : 1000,
            .has_phase = phase != NULL,
            .phase = json_number_value(phase),
            .still = json_is_true(json_object_get(knot, "still")),
            .settles = json_is_true(json_object_get(knot, "settles")),
        };
    }
    return desc;
}

static void check_spline(const struct scene *scene, const char *name, int s)
{
    static struct textbook book;
    const json_t *spline = json_array_get(json_object_get(scene->root, "splines"), (size_t)s);
    wiggly_knot knots[MAX_KNOTS];
    wiggly_desc desc = read_desc(scene, spline, knots);
    wiggly_status status;
    double total[TEXTBOOK_MAX], re[TEXTBOOK_MAX], im[TEXTBOOK_MAX];
    if (!textbook_curve(&desc, &book, &status, total, re, im)) fail_msg("%s, spline %d: singular", name, s);
    const wiggly_curve curve = {.size = sizeof curve, .samples = scene->samples, .total = total, .re = re, .im = im};
    const double worst = vectors_error(&curve, scene->table, 1 + 3 * scene->count, s);
    if (!(worst <= 1e-12)) fail_msg("%s, spline %d: off by %g of its range", name, s, worst);
    bool resonant = strcmp(name, "loop_resonant") == 0 && s == 1; // its swing has no answer at calm 0
    assert_int_equal(status, resonant ? WIGGLY_CALMED : WIGGLY_OK);
}

static int checked;

static void check_scene(const char *name)
{
    static struct scene scene;
    const bool fits = read_scene(&scene, name);
    for (int s = 0; fits && s < scene.count; s++) check_spline(&scene, name, s);
    checked += fits;
    if (fits) free(scene.table);
    json_decref(scene.root);
}

TEST(the_textbook_meets_every_vector)
{
    vectors_each(folder, check_scene);
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
    assert_true(desc->samples <= TEXTBOOK_MAX && desc->knot_count <= MAX_KNOTS);
    desc->step = 1 / fps;
    desc->mode = (wiggly_mode)mode;
    desc->start = (wiggly_start)start;
    desc->passive = (wiggly_passive)passive;
    desc->knots = knots;
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
    static struct textbook book;
    static double tracks[4][TEXTBOOK_MAX], expected[TEXTBOOK_MAX][3];
    double total[TEXTBOOK_MAX], re[TEXTBOOK_MAX], im[TEXTBOOK_MAX];
    wiggly_knot knots[MAX_KNOTS] = {0};
    wiggly_desc desc;
    int problems = 0;
    FILE *file = fopen("tests/textbook/small.txt", "r");
    assert_non_null(file);
    for (; read_problem(file, &desc, tracks, knots, expected); problems++) {
        if (!textbook_as(&desc, WIGGLY_OK, &book, total, re, im)) fail_msg("problem %d: singular", problems);
        for (int i = 0; i < desc.samples; i++) {
            double size = 1 + fabs(expected[i][1]) + fabs(expected[i][2]);
            double off = fmax(fabs(total[i] - expected[i][0]), fabs(re[i] - expected[i][1]));
            if (!(fmax(off, fabs(im[i] - expected[i][2])) <= 1e-12 * size))
                fail_msg("problem %d, sample %d: %g %g %g", problems, i, total[i], re[i], im[i]);
        }
    }
    fclose(file);
    assert_true(problems >= 24);
}
