/// Splines solved together so that points are where they must be: against exact answers (tests/vectors/pins, 60-digit arithmetic), random
/// groups in other orders, and what is refused.
#include "documents.h"

#include "curve.h"
#include "scene/evaluate.h"
#include "vectors.h"
#include <jansson.h>

enum { MOST_SPLINES = 8, MOST_PINS = 40 };

static const char folder[] = "tests/vectors/pins";

/// A group as a file has it.
struct sheet {
    int splines, pins;
    int spline[MOST_SPLINES]; ///< of the scene
    double weights[MOST_SPLINES];
    wiggly_pull pulls[MOST_PINS][MOST_SPLINES];
    wiggly_pin pin[MOST_PINS];
    double left[MOST_PINS][3];
};

static void read_pin(struct sheet *sheet, const json_t *names, const json_t *from, int p)
{
    wiggly_pin *pin = &sheet->pin[p];
    *pin = (wiggly_pin){.sample = (int)json_integer_value(json_object_get(from, "sample")), .pulls = sheet->pulls[p]};
    for (int s = 0; s < sheet->splines; s++) {
        const char *name = json_string_value(json_array_get(names, (size_t)s));
        const json_t *c = json_object_get(json_object_get(from, "pulls"), name);
        if (!c) continue;
        wiggly_pull *pull = &sheet->pulls[p][pin->pull_count++];
        pull->spline = s;
        for (size_t i = 0; i < 6; i++)
            pull->c[i / 2][i % 2] = json_number_value(json_array_get(json_array_get(c, i / 2), i % 2));
    }
    for (size_t i = 0; i < 3; i++) pin->to[i] = json_number_value(json_array_get(json_object_get(from, "to"), i));
}

static void read_sheet(struct sheet *sheet, const json_t *file, const struct document *document)
{
    const json_t *names = json_object_get(file, "group"), *pins = json_object_get(file, "pins");
    sheet->splines = (int)json_array_size(names);
    sheet->pins = (int)json_array_size(pins);
    for (int s = 0; s < sheet->splines; s++) {
        const char *name = json_string_value(json_array_get(names, (size_t)s));
        sheet->weights[s] = json_number_value(json_object_get(json_object_get(file, "weight"), name));
        for (int i = 0; i < document->spline_count; i++) {
            if (strcmp(document->splines[i]->name, name) == 0) sheet->spline[s] = i;
        }
    }
    for (int p = 0; p < sheet->pins; p++) {
        read_pin(sheet, names, json_array_get(pins, (size_t)p), p);
        const json_t *left = json_array_get(json_object_get(file, "left"), (size_t)p);
        for (size_t i = 0; i < 3; i++) sheet->left[p][i] = json_number_value(json_array_get(left, i));
    }
}

static struct document *document_of(const json_t *file)
{
    char *text = json_dumps(json_object_get(file, "scene"), 0);
    struct document *document = document_of_text(text);
    free(text);
    return document;
}

static void check_group(const char *name, struct sheet *sheet, const struct document *document,
                        const double *expected, wiggly_method method)
{
    struct evaluation evaluation = {0};
    const int samples = document_samples(document);
    evaluation_update(&evaluation, document, false);
    wiggly_group *group;
    assert_int_equal(wiggly_group_create(samples, 16, sheet->splines, sheet->pins, &group), WIGGLY_OK);
    wiggly_group_set_method(group, method);
    wiggly_desc descs[MOST_SPLINES];
    wiggly_curve curves[MOST_SPLINES];
    wiggly_knot knots[MOST_SPLINES][16];
    double *memory = calloc((size_t)(5 * samples * sheet->splines), sizeof *memory);
    for (int s = 0; s < sheet->splines; s++) {
        descs[s] = evaluation_describe(&evaluation, document, sheet->spline[s], knots[s]);
        curves[s] = curve_in(memory + 5 * samples * s, samples);
    }
    wiggly_status status =
        wiggly_group_solve(group, descs, sheet->weights, curves, sheet->splines, sheet->pin, sheet->pins);
    if (status != WIGGLY_OK) fail_msg("%s: %s", name, wiggly_status_text(status));
    for (int s = 0; s < sheet->splines; s++) {
        const double worst = vectors_error(&curves[s], expected, 1 + 3 * sheet->splines, s);
        if (!(worst <= 1e-8)) fail_msg("%s, spline %d: off by %g of its range", name, s, worst);
    }
    for (int p = 0; p < sheet->pins; p++) {
        for (int i = 0; i < 3; i++) assert_near(sheet->pin[p].left[i], sheet->left[p][i], 1e-9);
    }
    free(memory);
    wiggly_group_destroy(group);
    evaluation_free(&evaluation);
}

static void check_file(const char *name)
{
    char path[512];
    json_error_t problem;
    snprintf(path, sizeof path, "%s/%s.json", folder, name);
    json_t *file = json_load_file(path, 0, &problem);
    if (!file) fail_msg("%s: %s", path, problem.text);
    struct document *document = document_of(file);
    static struct sheet sheet;
    memset(&sheet, 0, sizeof sheet);
    read_sheet(&sheet, file, document);
    double *expected = vectors_table(folder, name, 1 + 3 * sheet.splines, document_samples(document));
    check_group(name, &sheet, document, expected, WIGGLY_CHAIN);
    check_group(name, &sheet, document, expected, WIGGLY_BAND);
    free(expected);
    document_destroy(document);
    json_decref(file);
}

TEST(every_vector_is_met) { assert_true(vectors_each(folder, check_file) >= 9); }

// --- random groups ---------------------------------------------------------------------------------------------------

enum { SAMPLES = 240, KNOTS = 8 };

/// A group with everything it needs.
struct random_group {
    int splines, pins, samples;
    wiggly_desc descs[MOST_SPLINES];
    wiggly_knot knots[MOST_SPLINES][KNOTS];
    double weights[MOST_SPLINES];
    wiggly_pull pulls[MOST_PINS][MOST_SPLINES];
    wiggly_pin pin[MOST_PINS];
    double track[SAMPLES];
};

static unsigned seed;

static double uniform(double low, double high)
{
    seed = seed * 1664525 + 1013904223;
    return low + (high - low) * (seed >> 8) / (1 << 24);
}

static int below(int end) { return (int)uniform(0, end) % end; }

static void make_knots(struct random_group *g, int s)
{
    wiggly_desc *desc = &g->descs[s];
    bool taken[SAMPLES] = {false};
    desc->knots = g->knots[s];
    desc->knot_count = below(KNOTS);
    for (int k = 0; k < desc->knot_count; k++) {
        int sample;
        do sample = below(g->samples - 1);
        while (taken[sample]);
        taken[sample] = true;
        g->knots[s][k] = (wiggly_knot){
            .sample = sample, .value = uniform(-1, 1), .has_slope = below(4) == 0, .stiffness = uniform(1, 1000)};
    }
}

static void make_spline(struct random_group *g, int s)
{
    wiggly_desc *desc = &g->descs[s];
    *desc = wiggly_default_desc();
    desc->samples = g->samples;
    desc->mode = below(3) == 0 ? WIGGLY_REAL : WIGGLY_COMPLEX;
    static const wiggly_start starts[] = {WIGGLY_REST, WIGGLY_LOOP, WIGGLY_FREE, WIGGLY_FREE};
    desc->start = starts[below(4)];
    desc->passive = below(4) == 0 ? WIGGLY_FILTER : WIGGLY_OSCILLATOR;
    desc->frequency.value = uniform(0.6, 3);
    desc->damping.value = uniform(0.02, 0.3);
    desc->bandwidth.value = uniform(0, 0.2);
    if (below(3) == 0) desc->equilibrium.track = g->track;
    make_knots(g, s);
    g->weights[s] = uniform(0.5, 2);
}

/// Pins sit on neighbouring frames, on knots and at both sides of a loop's seam more often than chance would have it.
static void make_pin(struct random_group *g, int p)
{
    wiggly_pin *pin = &g->pin[p];
    const wiggly_desc *desc = &g->descs[below(g->splines)];
    int near = p > 0 ? g->pin[p - 1].sample : 0;
    if (desc->knot_count > 0 && below(2)) near = desc->knots[below(desc->knot_count)].sample;
    pin->sample = below(3) == 0 ? near + below(3) - 1 : below(g->samples);
    if (below(5) == 0) pin->sample = below(2) * g->samples;
    pin->sample = pin->sample < 0 ? 0 : pin->sample >= g->samples - 1 ? g->samples - 2 : pin->sample;
    pin->pulls = g->pulls[p];
    pin->pull_count = g->splines;
    for (int s = 0; s < g->splines; s++) {
        wiggly_pull *pull = &g->pulls[p][s];
        pull->spline = s;
        for (int i = 0; i < 6; i++) pull->c[i / 2][i % 2] = uniform(-1, 1);
    }
    for (int i = 0; i < 3; i++) pin->to[i] = uniform(-1, 1);
}

static struct random_group *make_group(unsigned number, int splines, int pins)
{
    static struct random_group g;
    memset(&g, 0, sizeof g);
    seed = number * 2654435761u + 1;
    g.splines = splines;
    g.pins = pins;
    g.samples = SAMPLES;
    for (int i = 0; i < SAMPLES; i++) g.track[i] = 0.3 * sin(0.05 * i);
    for (int s = 0; s < splines; s++) make_spline(&g, s);
    for (int p = 0; p < pins; p++) make_pin(&g, p);
    return &g;
}

static wiggly_status solve_group(struct random_group *g, wiggly_method method, double *memory, wiggly_curve *curves)
{
    wiggly_group *group;
    assert_int_equal(wiggly_group_create(g->samples, KNOTS, g->splines, g->pins, &group), WIGGLY_OK);
    wiggly_group_set_method(group, method);
    for (int s = 0; s < g->splines; s++) curves[s] = curve_in(memory + 5 * g->samples * s, g->samples);
    wiggly_status status = wiggly_group_solve(group, g->descs, g->weights, curves, g->splines, g->pin, g->pins);
    wiggly_group_destroy(group);
    return status;
}

static double largest(const wiggly_curve *curves, int splines)
{
    double size = 0;
    for (int s = 0; s < splines; s++) {
        for (int i = 0; i < curves[s].samples; i++)
            size = fmax(size, fmax(fabs(curves[s].re[i]), fabs(curves[s].im[i])));
    }
    return size;
}

/// Splines and pins from the last to the first.
static void turn_round(struct random_group *g)
{
    static struct random_group was;
    was = *g;
    for (int s = 0; s < g->splines; s++) {
        const int from = g->splines - 1 - s;
        g->descs[s] = was.descs[from];
        memcpy(g->knots[s], was.knots[from], sizeof g->knots[s]);
        g->descs[s].knots = g->knots[s];
        g->weights[s] = was.weights[from];
    }
    for (int p = 0; p < g->pins; p++) {
        const int from = g->pins - 1 - p;
        g->pin[p] = was.pin[from];
        g->pin[p].pulls = g->pulls[p];
        memcpy(g->pulls[p], was.pulls[from], sizeof g->pulls[p]);
        for (int s = 0; s < g->splines; s++) g->pulls[p][s].spline = g->splines - 1 - s;
    }
}

TEST(the_order_of_splines_and_pins_is_no_matter)
{
    static double memory[2][5 * SAMPLES * MOST_SPLINES];
    wiggly_curve curves[2][MOST_SPLINES];
    double worst = 0;
    for (unsigned n = 0; n < 200; n++) {
        struct random_group *g = make_group(n, 2 + below(4), 1 + below(6));
        double left[MOST_PINS][3];
        wiggly_status first = solve_group(g, WIGGLY_CHAIN, memory[0], curves[0]);
        for (int p = 0; p < g->pins; p++) memcpy(left[p], g->pin[p].left, sizeof left[p]);
        turn_round(g);
        wiggly_status second = solve_group(g, WIGGLY_BAND, memory[1], curves[1]);
        if (first != WIGGLY_OK || second != WIGGLY_OK) fail_msg("group %u: %d, %d", n, first, second);
        double size = largest(curves[1], g->splines), apart = 0;
        for (int s = 0; s < g->splines; s++) {
            const wiggly_curve *one = &curves[0][s], *other = &curves[1][g->splines - 1 - s];
            for (int i = 0; i < g->samples; i++) {
                apart = fmax(apart, fabs(one->re[i] - other->re[i]));
                apart = fmax(apart, fabs(one->im[i] - other->im[i]));
            }
            for (int k = 0; k < g->descs[g->splines - 1 - s].knot_count; k++) {
                const wiggly_knot *knot = &g->knots[g->splines - 1 - s][k];
                assert_near(one->total[knot->sample], knot->value, 0);
            }
        }
        for (int p = 0; p < g->pins; p++) {
            for (int i = 0; i < 3; i++) assert_near(left[g->pins - 1 - p][i], g->pin[p].left[i], 1e-7 * size);
        }
        worst = fmax(worst, apart / size);
    }
    if (!(worst <= 1e-8)) fail_msg("turned round, groups are %g of the largest x apart", worst);
}

// --- what a user would miss ------------------------------------------------------------------------------------------

/// A group without pins is its splines, and one that has solved others before gives the same bits as a new one.
TEST(nothing_that_is_kept_changes_a_bit)
{
    static double memory[3][5 * SAMPLES * MOST_SPLINES];
    wiggly_curve curves[3][MOST_SPLINES];
    wiggly_group *group;
    wiggly_solver *solver;
    assert_int_equal(wiggly_group_create(SAMPLES, KNOTS, 4, 6, &group), WIGGLY_OK);
    assert_int_equal(wiggly_create(SAMPLES, KNOTS, &solver), WIGGLY_OK);
    for (unsigned n = 0; n < 20; n++) {
        struct random_group *g = make_group(n, 4, 6);
        for (int s = 0; s < 4; s++) {
            for (int k = 1; k < 3; k++) curves[k][s] = curve_in(memory[k] + 5 * SAMPLES * s, SAMPLES);
        }
        assert_int_equal(solve_group(g, WIGGLY_CHAIN, memory[0], curves[0]), WIGGLY_OK);
        assert_int_equal(wiggly_group_solve(group, g->descs, g->weights, curves[1], 4, g->pin, 6), WIGGLY_OK);
        assert_memory_equal(memory[0], memory[1], sizeof(double) * 5 * SAMPLES * 4);
        assert_int_equal(wiggly_group_solve(group, g->descs, g->weights, curves[1], 4, NULL, 0), WIGGLY_OK);
        for (int s = 0; s < 4; s++) assert_int_equal(wiggly_solve(solver, &g->descs[s], &curves[2][s]), WIGGLY_OK);
        assert_memory_equal(memory[1], memory[2], sizeof(double) * 5 * SAMPLES * 4);
    }
    wiggly_destroy(solver);
    wiggly_group_destroy(group);
}

/// One spline that moves a point along a line: what is across it cannot be had, and is said.
TEST(what_is_out_of_reach_is_left)
{
    static double memory[5 * SAMPLES * MOST_SPLINES];
    wiggly_curve curve;
    struct random_group *g = make_group(1, 1, 1);
    g->descs[0].mode = WIGGLY_REAL;
    g->pin[0] = (wiggly_pin){.sample = 100, .pulls = g->pulls[0], .pull_count = 1, .to = {0.5, 0.25, 0}};
    g->pulls[0][0] = (wiggly_pull){.c = {{2, 0}, {0, 0}, {0, 0}}};
    assert_int_equal(solve_group(g, WIGGLY_CHAIN, memory, &curve), WIGGLY_OK);
    assert_near(curve.re[100], 0.25, 1e-12);
    assert_near(g->pin[0].left[0], 0, 1e-12);
    assert_near(g->pin[0].left[1], 0.25, 0);
}

/// A spline that the pins do not move is to the bit what it is alone, also where they name it and where it is one that could not be
/// pulled.
TEST(who_is_not_pulled_is_as_alone)
{
    static double memory[2][5 * SAMPLES * MOST_SPLINES];
    wiggly_curve curves[MOST_SPLINES], alone = curve_in(memory[1], SAMPLES);
    wiggly_solver *solver;
    assert_int_equal(wiggly_create(SAMPLES, KNOTS, &solver), WIGGLY_OK);
    for (unsigned n = 0; n < 20; n++) {
        struct random_group *g = make_group(n, 3, 2);
        for (int p = 0; p < 2; p++) g->pulls[p][2] = (wiggly_pull){.spline = 2};
        if (n % 2) g->descs[2].calm = 0;
        const wiggly_status expected = wiggly_solve(solver, &g->descs[2], &alone);
        assert_int_equal(solve_group(g, WIGGLY_CHAIN, memory[0], curves), expected);
        assert_memory_equal(memory[0] + 2 * 5 * SAMPLES, memory[1], sizeof(double) * 5 * SAMPLES);
    }
    wiggly_destroy(solver);
}

/// A pin that is where its point passes in any case changes nothing, whatever the spline's frequency does.
TEST(a_pin_on_the_way_changes_nothing)
{
    static double memory[2][5 * SAMPLES * MOST_SPLINES], frequency[SAMPLES];
    wiggly_curve curves[MOST_SPLINES], alone = curve_in(memory[1], SAMPLES);
    wiggly_solver *solver;
    assert_int_equal(wiggly_create(SAMPLES, KNOTS, &solver), WIGGLY_OK);
    for (int i = 0; i < SAMPLES; i++) frequency[i] = 2 + sin(0.03 * i);
    for (unsigned n = 0; n < 12; n++) {
        struct random_group *g = make_group(n, 1, 1);
        wiggly_desc *desc = &g->descs[0];
        desc->start = (wiggly_start)(n % 3);
        desc->frequency.track = frequency;
        desc->knot_count = 3;
        for (int k = 0; k < 3; k++) g->knots[0][k] = (wiggly_knot){.sample = 40 + 80 * k, .value = k % 2};
        g->pin[0].sample = 70;
        assert_int_equal(wiggly_solve(solver, desc, &alone), WIGGLY_OK);
        for (int i = 0; i < 3; i++) {
            const double *c = g->pulls[0][0].c[i];
            g->pin[0].to[i] = c[0] * alone.re[70] - c[1] * alone.im[70];
        }
        assert_int_equal(solve_group(g, WIGGLY_CHAIN, memory[0], curves), WIGGLY_OK);
        for (int i = 0; i < SAMPLES; i++) assert_near(curves[0].total[i], alone.total[i], 1e-8);
    }
    wiggly_destroy(solver);
}

/// On a filter whose equilibrium moves, two pins that one spline can meet are met.
TEST(pins_on_a_moving_equilibrium_are_met)
{
    static double memory[5 * SAMPLES * MOST_SPLINES];
    for (unsigned n = 0; n < 60; n++) {
        wiggly_curve curve;
        struct random_group *g = make_group(n, 1, 2);
        wiggly_desc *desc = &g->descs[0];
        desc->passive = WIGGLY_FILTER;
        desc->equilibrium.track = g->track;
        for (int i = 0; i < SAMPLES; i++) g->track[i] = 3 * sin((0.05 + 0.01 * n) * i);
        desc->knot_count = 2;
        g->knots[0][0].sample = 60, g->knots[0][1].sample = 200;
        for (int p = 0; p < 2; p++) {
            g->pin[p].sample = 100 + (int)(1 + n % 20) * p;
            g->pulls[p][0] = (wiggly_pull){.c = {{1, 0}, {0, 0}, {0, 0}}};
        }
        assert_int_equal(solve_group(g, WIGGLY_CHAIN, memory, &curve), WIGGLY_OK);
        for (int p = 0; p < 2; p++) assert_near(g->pin[p].left[0], 0, 1e-9 * largest(&curve, 1));
    }
}

/// Pins on neighbouring frames that hardly anything holds: what the rounds leave of them belongs to the error.
TEST(a_pin_that_is_missed_is_not_called_met)
{
    static double memory[5 * SAMPLES * MOST_SPLINES];
    int missed = 0;
    for (unsigned n = 0; n < 200; n++) {
        wiggly_curve curve;
        struct random_group *g = make_group(n, 1, 5);
        wiggly_desc *desc = &g->descs[0];
        desc->calm = 1e-12;
        desc->frequency.value *= 0.01;
        desc->equilibrium.track = NULL;
        desc->knot_count = 1;
        g->knots[0][0].sample = 60;
        for (int p = 0; p < 5; p++) {
            g->pin[p].sample = 100 + p;
            g->pulls[p][0] = (wiggly_pull){.c = {{1, 0}, {0, 0}, {0, 0}}};
        }
        const wiggly_status status = solve_group(g, WIGGLY_CHAIN, memory, &curve);
        double left = 0;
        for (int p = 0; p < 5; p++) left = fmax(left, fabs(g->pin[p].left[0]) / largest(&curve, 1));
        if (left <= 1e-8) continue;
        missed++;
        assert_int_equal(status, WIGGLY_INEXACT);
        if (!(curve.error >= left)) fail_msg("group %u: %g is missed, and an error of %g told", n, left, curve.error);
    }
    print_message("%d missed\n", missed);
    assert_true(missed > 0);
}

static int wrong_knot; ///< of the second spline, as status_of() found it

static wiggly_status status_of(struct random_group *g)
{
    static double memory[5 * SAMPLES * MOST_SPLINES];
    wiggly_curve curves[MOST_SPLINES];
    memory[0] = 17;
    wiggly_status status = solve_group(g, WIGGLY_CHAIN, memory, curves);
    if (status >= WIGGLY_ERROR_ARGUMENT) assert_near(memory[0], 17, 0); // nothing is touched
    wrong_knot = curves[1].knot;
    return status;
}

TEST(what_cannot_be_held_is_refused)
{
    static const wiggly_status expected[] = {WIGGLY_ERROR_PIN,      WIGGLY_ERROR_PIN,       WIGGLY_ERROR_PIN,
                                             WIGGLY_ERROR_PIN,      WIGGLY_ERROR_PIN,       WIGGLY_ERROR_NUMBER,
                                             WIGGLY_ERROR_NUMBER,   WIGGLY_ERROR_ARGUMENT,  WIGGLY_ERROR_SIZE,
                                             WIGGLY_ERROR_ARGUMENT, WIGGLY_ERROR_KNOT_TWICE};
    static const wiggly_knot twice[] = {{.sample = 3}, {.sample = 3}};
    for (int i = 0; i < 11; i++) {
        struct random_group *g = make_group(2, 2, 1);
        if (i == 0) g->pin[0].sample = SAMPLES;
        if (i == 1) {
            g->descs[1].start = WIGGLY_LOOP;
            g->descs[1].knot_count = 0;
            g->pin[0].sample = SAMPLES - 1;
        }
        if (i == 2) g->descs[0].mode = WIGGLY_CUBIC;
        if (i == 3) g->descs[0].calm = 0;
        if (i == 4) g->descs[0].frequency.value = 0;
        if (i == 5) g->pin[0].to[1] = NAN;
        if (i == 6) g->weights[0] = 0;
        if (i == 7) g->pulls[0][1].spline = 2;
        if (i == 8) g->descs[1].size = 0;
        if (i == 9) g->descs[1].samples = 0;
        if (i == 10) g->descs[1].knots = twice, g->descs[1].knot_count = 2;
        assert_int_equal(status_of(g), expected[i]);
        if (i == 10) assert_int_equal(wrong_knot, 1);
    }
}

/// In a scene of two samples there is nothing to pull.
TEST(pins_of_a_scene_too_short_are_passed_over)
{
    struct random_group *g = make_group(3, 2, 1);
    g->samples = 2;
    g->pin[0].sample = 1;
    for (int s = 0; s < 2; s++)
        g->descs[s].samples = 2, g->descs[s].knot_count = 0, g->descs[s].equilibrium.track = NULL;
    assert_int_equal(status_of(g), WIGGLY_OK);
    for (int i = 0; i < 3; i++) assert_near(g->pin[0].left[i], g->pin[0].to[i], 0);
}

/// A spline that is too short to be pulled, if large, keeps no pin from those that can reach it.
TEST(a_spline_too_short_bars_no_other)
{
    static double memory[5 * SAMPLES * MOST_SPLINES];
    wiggly_curve curves[MOST_SPLINES];
    struct random_group *g = make_group(3, 2, 1);
    for (int s = 0; s < 2; s++) {
        g->descs[s].start = WIGGLY_FREE;
        g->descs[s].mode = WIGGLY_REAL;
        g->descs[s].equilibrium.track = NULL;
    }
    g->descs[0].samples = 2;
    g->descs[0].knot_count = 0;
    g->pin[0] = (wiggly_pin){.sample = 1, .pulls = g->pulls[0], .pull_count = 2, .to = {0, 0.5, 0}};
    g->pulls[0][0] = (wiggly_pull){.spline = 0, .c = {{1, 0}}};
    g->pulls[0][1] = (wiggly_pull){.spline = 1, .c = {{0, 0}, {1e-3, 0}}};
    assert_int_equal(solve_group(g, WIGGLY_CHAIN, memory, curves), WIGGLY_OK);
    assert_near(g->pin[0].left[1], 0, 1e-9);
}
