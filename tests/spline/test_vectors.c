/// Every scene of tests/vectors against its exact answers (60-digit arithmetic), through the same path as the app:
/// scene file → document → solver, by the chain and by the band, which agree to 1e-9 of the range. The tolerances are those of docs/mathematics.md: 1e-9 of the range for cubic splines, else 1e-8. One
/// is a loop of calm 0 that its equilibrium drives in resonance: its answer is the one with calm 0.05, and the solver says so.
#include "documents.h"

#include "scene/evaluate.h"
#include "vectors.h"

static const char folder[] = "tests/vectors";

static void check_spline(const char *name, const struct document *document, const struct evaluation *evaluation,
                         const double *expected, int spline)
{
    const struct spline *of = document->splines[spline];
    const char *solver = evaluation_solver(evaluation);
    double worst = vectors_error(&evaluation->curves[spline], expected, 1 + 3 * document->spline_count, spline);
    double tolerance = spline_mode(of) == WIGGLY_CUBIC ? 1e-9 : 1e-8;
    if (!(worst <= tolerance)) fail_msg("%s, %s, %s: off by %g of its range", name, of->name, solver, worst);
    bool calmed = strcmp(name, "loop_resonant") == 0 && strcmp(of->name, "x") == 0;
    if (evaluation->status[spline] != (calmed ? WIGGLY_CALMED : WIGGLY_OK))
        fail_msg("%s, %s, %s: %s", name, of->name, solver, wiggly_status_text(evaluation->status[spline]));
}

/// Largest difference between two curves in total, Re x and Im x, relative to the total's range or magnitude.
static double difference(const wiggly_curve *a, const wiggly_curve *b)
{
    double low = INFINITY, high = -INFINITY, worst = 0;
    for (int i = 0; i < a->samples; i++) {
        low = fmin(low, a->total[i]);
        high = fmax(high, a->total[i]);
        worst = fmax(worst, fabs(a->total[i] - b->total[i]));
        worst = fmax(worst, fmax(fabs(a->re[i] - b->re[i]), fabs(a->im[i] - b->im[i])));
    }
    return worst > 0 ? worst / fmax(high - low, fmax(fabs(low), fabs(high))) : 0;
}

static void check_document(const char *name, const struct document *document, const double *expected)
{
    struct evaluation chain = {.solver = SOLVER_CHAIN}, band = {.solver = SOLVER_BAND};
    evaluation_update(&chain, document, false);
    evaluation_update(&band, document, false);
    for (int s = 0; s < document->spline_count; s++) {
        check_spline(name, document, &chain, expected, s);
        check_spline(name, document, &band, expected, s);
        double apart = difference(&chain.curves[s], &band.curves[s]);
        if (!(apart <= 1e-9))
            fail_msg("%s, %s: band and chain are %g of its range apart", name, document->splines[s]->name, apart);
    }
    evaluation_free(&chain);
    evaluation_free(&band);
}

static void check_scene(const char *name)
{
    char path[512];
    snprintf(path, sizeof path, "%s/%s.json", folder, name);
    struct document *document = document_of_file(path);
    double *expected = vectors_table(folder, name, 1 + 3 * document->spline_count, document_samples(document));
    check_document(name, document, expected);
    free(expected);
    document_destroy(document);
}

TEST(chain_and_band_meet_every_vector) { assert_true(vectors_each(folder, check_scene) >= 35); }

/// An undamped spline between two knots far apart, and after them: the band and the chain have one curve.
TEST(long_gaps_lose_nothing)
{
    static const struct {
        int gap, after;
        const char *more;
    } rows[] = {{300, 40, ""},
                {2000, 40, ""},
                {200, 400, ", \"mode\": \"real\""},
                {200, 400, ""},
                {400, 40, ", \"passive\": \"filter\""},
                {400, 40, ", \"damping\": {\"spline\": \"pace\"}"}};
    for (size_t r = 0; r < sizeof rows / sizeof *rows; r++) {
        char text[400];
        snprintf(
            text, sizeof text,
            "{\"wiggly\": 1, \"fps\": 60, \"frames\": [0, %d], \"splines\": [{\"name\": \"pace\", \"mode\": "
            "\"cubic\", "
            "\"knots\": [{\"frame\": 0, \"value\": 2}]}, {\"name\": \"x\", \"frequency\": 2, \"bandwidth\": 0.02, "
            "\"knots\": [{\"frame\": %d, \"value\": 1, \"im\": 0.3}, {\"frame\": 0, \"value\": 0, \"im\": 0}]%s}]}",
            rows[r].gap + rows[r].after, rows[r].gap, rows[r].more);
        struct document *document = document_of_text(text);
        struct evaluation own = {0}, chain = {.solver = SOLVER_CHAIN};
        evaluation_update(&own, document, false);
        evaluation_update(&chain, document, false);
        assert_string_equal(evaluation_solver(&own), "band");
        assert_near(difference(&own.curves[1], &chain.curves[1]), 0, 1e-8);
        evaluation_free(&own);
        evaluation_free(&chain);
        document_destroy(document);
    }
}
