/// The paper's figures as scenes: each shows what the paper says it shows. The scenes with the character stand on their feet, in one piece.
#include "curve.h"
#include "documents.h"

#include "rig/posing.h"
#include <complex.h>

struct figure_scene {
    struct document *document;
    struct evaluation evaluation;
    struct models *models;
    const struct figure *figure; ///< of the first character, or NULL
};

/// Opens and solves it.
static void open_scene(struct figure_scene *s, const char *path)
{
    *s = (struct figure_scene){.document = document_of_file(path), .models = models_create()};
    assert_done(models_update(s->models, s->document, &error));
    s->figure = models_figure(s->models, s->document, document_find_rig(s->document, RIG_MODEL, 0));
    evaluation_update(&s->evaluation, s->document, false);
    for (int i = 0; i < s->evaluation.count; i++) assert_int_equal(s->evaluation.status[i], WIGGLY_OK);
}

static void close_scene(struct figure_scene *s)
{
    evaluation_free(&s->evaluation);
    models_destroy(s->models);
    document_destroy(s->document);
}

static struct rig_pose pose_at(const struct figure_scene *s, int sample)
{
    struct rig_pose pose;
    const struct posing posing = {.document = s->document, .evaluation = &s->evaluation, .models = s->models};
    assert_true(rig_pose(&posing, 0, sample, &pose));
    return pose;
}

#define FIGURE_TEST(name)                                                                                            \
    TEST_OF(struct figure_scene, s, open_scene(s, "assets/scenes/" #name ".json"), close_scene(s), name)

static const wiggly_curve *curve_of(const struct figure_scene *s, const char *name)
{
    int spline = document_find_spline(s->document, name);
    assert_true(spline >= 0);
    return &s->evaluation.curves[spline];
}

/// Extrema strictly between two samples, and the smallest of their magnitudes.
static int count_extrema(const double *row, int from, int to, double *smallest)
{
    int count = 0;
    *smallest = INFINITY;
    for (int i = from + 1; i < to; i++) {
        const bool is_high = row[i] > row[i - 1] && row[i] >= row[i + 1];
        const bool is_low = row[i] < row[i - 1] && row[i] <= row[i + 1];
        if (!is_high && !is_low) continue;
        count++;
        *smallest = fmin(*smallest, fabs(row[i]));
    }
    return count;
}

/// The same everywhere on a cubic.
static double third_difference(const double *row, int at)
{
    return row[at + 2] - 3 * row[at + 1] + 3 * row[at] - row[at - 1];
}

static void assert_hits_knots(const struct figure_scene *s, const char *name)
{
    const struct spline *spline = s->document->splines[document_find_spline(s->document, name)];
    for (int i = 0; i < spline->knot_count; i++) {
        int sample = document_sample(s->document, spline->knots[i].frame);
        assert_near(curve_of(s, name)->total[sample], spline->knots[i].value, 0);
    }
}

/// With the resonance at zero on the left the curve is a familiar cubic, rising without a swing; where the
/// resonance has jumped up it oscillates on its way to the third knot.
FIGURE_TEST(figure1)
{
    double smallest;
    const double *total = curve_of(s, "curve")->total;
    assert_hits_knots(s, "curve");
    for (int i = 1; i < 90; i++) assert_true(total[i] > total[i - 1]);
    for (int i = 2; i < 85; i++) assert_near(third_difference(total, i), third_difference(total, 1), 1e-12);
    assert_true(count_extrema(total, 96, 178, &smallest) >= 6);
}

/// Three keyed knots on the real part; the imaginary part is computed, and turns a quarter of a period with it.
FIGURE_TEST(figure3)
{
    const wiggly_curve *shown = curve_of(s, "curve");
    double re = 0, im = 0, cross = 0;
    assert_hits_knots(s, "curve");
    for (int i = 40; i < 104; i++) {
        re += shown->re[i] * shown->re[i];
        im += shown->im[i] * shown->im[i];
        cross += shown->re[i] * shown->im[i];
    }
    assert_true(im > 0.5 * re && im < 2 * re);
    assert_true(fabs(cross) < 0.2 * sqrt(re * im));
}

/// The third knot moves by a tenth of its span, and the curve stretches: as many swings, none of them lost. The sharp resonance of a
/// spring cannot stretch, and finds another way.
FIGURE_TEST(figure4)
{
    double smallest;
    assert_hits_knots(s, "before");
    assert_hits_knots(s, "moved");
    assert_int_equal(count_extrema(curve_of(s, "before")->total, 36 + 3, 108 - 3, &smallest), 5);
    for (int is_spring = 0; is_spring < 2; is_spring++) {
        assert_int_equal(count_extrema(curve_of(s, "moved")->total, 36 + 3, 115 - 3, &smallest), 5);
        assert_near(smallest, is_spring ? 0.598 : 0.795, 0.0005);
        for (int i = 0; i < s->document->spline_count; i++)
            document_own_spline(s->document, i)->parameter[PARAMETER_MODE].value = WIGGLY_REAL;
        evaluation_update(&s->evaluation, s->document, false);
    }
}

/// The same filter run forwards on its own: x_{i+1} = a x_i + b x_{i−1} − g (y_{i+1} − 2y_i + y_{i−1}) from rest (eq. 25).
static void assert_forward_response(const wiggly_curve *shown, const struct spline *spline, double step)
{
    const double omega = 2 * M_PI * spline->parameter[PARAMETER_FREQUENCY].value;
    const double zeta = spline->parameter[PARAMETER_DAMPING].value;
    const double turn = omega * spline->parameter[PARAMETER_BANDWIDTH].value;
    const double complex pole = -zeta * omega + I * omega * sqrt(1 - zeta * zeta);
    const double complex l0 = cexp((pole + I * turn) * step), l1 = cexp((pole - I * turn) * step);
    const double complex a = l0 + l1, b = -l0 * l1, g = cexp(pole * step);
    const double *y = shown->y;
    double complex before = 0, now = 0;
    for (int i = 1; i + 1 < shown->samples; i++) {
        double complex next = a * now + b * before - g * (y[i + 1] - 2 * y[i] + y[i - 1]);
        assert_near(shown->re[i + 1], creal(next), 1e-9);
        assert_near(shown->im[i + 1], cimag(next), 1e-9);
        before = now;
        now = next;
    }
}

/// The passive response follows the step of the equilibrium late, overshoots and dies down; the edited curve goes
/// through the knot and is the same kind of motion.
FIGURE_TEST(figure5)
{
    double smallest, largest = 0;
    const wiggly_curve *still = curve_of(s, "equilibrium"), *loose = curve_of(s, "free"),
                       *edited = curve_of(s, "edited");
    for (int i = 0; i <= 192; i++) {
        assert_near(loose->y[i], still->total[i], 0);
        largest = fmax(largest, loose->total[i]);
    }
    assert_forward_response(loose, s->document->splines[document_find_spline(s->document, "free")],
                            document_step(s->document));
    assert_true(largest > 1.1);
    assert_true(count_extrema(loose->total, 55, 150, &smallest) >= 6);
    assert_true(fabs(loose->re[192]) < 0.1 * (largest - 1));
    assert_hits_knots(s, "edited");
    assert_near(edited->total[100], 0.2, 0);
    assert_true(fabs(edited->re[192]) < 0.2);
    assert_near(edited->total[0], loose->total[0], 1e-12); // both start from rest
}

/// How far a tail's joint has turned the tail aside, radians.
static double heading(const struct pose *pose, int joint)
{
    const float *z = &pose->matrix[joint][8];
    return atan2(z[0], z[2]);
}

/// Each joint bends as the first one does, later by its lag: the tip reaches its turning point well after the base.
FIGURE_TEST(figure6)
{
    enum { BASE = 0, LATE = 18 };
    const struct tail *tail = document_tail(s->document, 0);
    double bend[2][128], best = -INFINITY;
    int lag = 0, count = s->evaluation.samples;
    assert_in_range(count, 100, 128);
    for (int i = 0; i < count; i++) {
        const struct rig_pose pose = pose_at(s, i);
        bend[0][i] = heading(&pose.strand, BASE);
        bend[1][i] = heading(&pose.strand, LATE) - heading(&pose.strand, LATE - 1);
    }
    for (int shift = 0; shift < 24; shift++) {
        double sum = 0;
        for (int i = 24; i + shift < count; i++) sum += bend[0][i] * bend[1][i + shift];
        if (sum > best) lag = shift, best = sum;
    }
    double expected = LATE * tail->channels[0].lag.value[0] / 360 * 24; // frames, at 1 Hz
    assert_true(fabs(lag - expected) <= 1.5);
}

// --- the character of figure 7

/// Degrees by which a part leads x in its movement along an axis: the argument of the sum over its vertices.
static double lead(const struct figure *figure, const char *name, int axis, const float lo[3], const float hi[3])
{
    const struct coordinate *c = &figure->character.coordinates[figure_find(figure, name)];
    double complex sum = 0;
    for (int i = 0; i < figure->character.vertex_count; i++) {
        const float *p = figure->character.position[i];
        bool inside = true;
        for (int k = 0; k < 3; k++) inside = inside && lo[k] <= p[k] && p[k] <= hi[k];
        if (inside) sum += (double)c->re[i][axis] + I * (double)c->im[i][axis];
    }
    assert_true(cabs(sum) > 0);
    return carg(sum) * 180 / M_PI;
}

/// Over no edge of the mesh does the movement turn by more than a few degrees where there is any to speak of.
static void assert_smooth_phases(const struct figure *figure)
{
    const struct character *character = &figure->character;
    const int at = figure_find(figure, "up");
    const struct coordinate *up = &character->coordinates[at];
    const double least = 0.1 * (double)figure->largest[at][1];
    for (int i = 0; i < character->index_count; i++) {
        const uint32_t a = character->indices[i], b = character->indices[i % 3 == 2 ? i - 2 : i + 1];
        const double complex from = (double)up->re[a][1] + I * (double)up->im[a][1];
        const double complex to = (double)up->re[b][1] + I * (double)up->im[b][1];
        if (cabs(from) < least || cabs(to) < least) continue;
        assert_true(fabs(carg(to / from)) * 180 / M_PI < 20);
    }
}

/// Of the mesh, each vertex moved by Re(z Ñ).
static double volume_at(const struct character *c, const struct coordinate *n, double complex z)
{
    double sum = 0;
    for (int i = 0; i < c->index_count; i += 3) {
        double p[3][3];
        for (int k = 0; k < 9; k++) {
            const uint32_t v = c->indices[i + k / 3];
            p[k / 3][k % 3] = (double)c->position[v][k % 3] + creal(z) * (double)n->re[v][k % 3] -
                              cimag(z) * (double)n->im[v][k % 3];
        }
        for (int k = 0; k < 3; k++) {
            const int l = (k + 1) % 3, m = (k + 2) % 3;
            sum += p[0][k] * (p[1][l] * p[2][m] - p[1][m] * p[2][l]) / 6;
        }
    }
    return sum;
}

/// Flesh keeps its volume: at amplitude 1 to 5 % in every phase, of every coordinate that the model has.
static void assert_keeps_volume(const struct character *c)
{
    enum { PHASES = 36 };
    assert_int_equal(c->coordinate_count, 6);
    for (int k = 0; k < c->coordinate_count; k++) {
        const struct coordinate *n = &c->coordinates[k];
        const double rest = volume_at(c, n, 0);
        for (int i = 0; i < PHASES; i++) {
            const double change = volume_at(c, n, cexp(2 * M_PI * I * i / PHASES)) / rest - 1;
            if (!(fabs(change) <= 0.05)) fail_msg("%s: %+.3f of the volume", n->name, change);
        }
    }
}

/// "The phase varies smoothly over the character, with the motion of the arms and hands being delayed significantly
/// compared to the body."
FIGURE_TEST(figure7)
{
    static const float head[2][3] = {{-0.3f, 1.2f, -1}, {0.3f, 2, 1}};
    static const float left_hand[2][3] = {{0.6f, 0, -1}, {1, 2, 1}}, right_hand[2][3] = {{-1, 0, -1}, {-0.6f, 2, 1}};
    const double body = lead(s->figure, "up", 1, head[0], head[1]);
    const double left = lead(s->figure, "up", 1, left_hand[0], left_hand[1]);
    const double right = lead(s->figure, "up", 1, right_hand[0], right_hand[1]);
    assert_true(fabs(body) < 20);
    assert_true(body - left > 35 && body - left < 120);
    assert_true(fabs(left - right) < 15);
    assert_int_equal(first_model(s->document)->phases, 1);
    assert_smooth_phases(s->figure);
    assert_keeps_volume(&s->figure->character);
}

/// Feet stay where they are, whatever the spline does, and the character stays in one piece: within reach of where it rests.
static void assert_stands(const struct figure_scene *s)
{
    for (int i = 0; i < s->evaluation.samples; i++) {
        const struct rig_pose pose = pose_at(s, i);
        float lo[3], hi[3];
        rig_bounds(&pose, lo, hi);
        const float x = pose.model.root[12], y = pose.model.ground;
        assert_near((double)lo[1], (double)y, 0.02);
        assert_true(hi[1] < y + 2.0f && hi[1] > y + 1.1f && hi[0] < x + 1.4f && lo[0] > x - 1.4f);
    }
}

TEST(characters_stand_on_their_feet)
{
    static const char *const names[] = {"figure7", "up-down", "side-to-side", "character", "compositing"};
    for (size_t n = 0; n < sizeof names / sizeof *names; n++) {
        struct figure_scene scene;
        char path[64];
        snprintf(path, sizeof path, "assets/scenes/%s.json", names[n]);
        open_scene(&scene, path);
        assert_stands(&scene);
        close_scene(&scene);
    }
}

/// Eq. 30: one spline of nine knots moves both coordinates, one a quarter of a swing behind the other.
FIGURE_TEST(character)
{
    const struct model_rig *rig = first_model(s->document);
    assert_int_equal(s->document->spline_count, 1);
    assert_int_equal(s->document->splines[0]->knot_count, 9);
    assert_int_equal(rig->drive_count, 2);
    assert_int_equal(rig->drives[0].spline, rig->drives[1].spline);
    assert_near(rig->drives[1].lag - rig->drives[0].lag, 90, 0);
}

// --- the classical splines at both ends of the scale

/// What SciPy makes of four knots at every eighth frame: CubicSpline(bc_type="natural") without tangents, and CubicHermiteSpline.
static const double classical[2][13] = {{0, 0.490290290, 0.862862863, 1, 0.827360694, 0.444110777, -0.007207207,
                                         -0.384050717, -0.548181515, -0.460360360, -0.180347014, 0.227794461, 0.7},
                                        {0, 0.333333333, 0.777777778, 1, 0.868312757, 0.539094650, 0.111111111,
                                         -0.316872428, -0.623456790, -0.633333333, -0.376543210, 0.087654321, 0.7}};

/// The largest difference between our cubic and one of those.
static double cubic_error(int substeps, double stiffness, const double expected[13])
{
    wiggly_knot knots[] = {{.sample = 0, .value = 0, .slope = 0.5},
                           {.sample = 24, .value = 1, .slope = 0},
                           {.sample = 60, .value = -0.5, .slope = -1},
                           {.sample = 96, .value = 0.7, .slope = 2}};
    const int samples = 96 * substeps + 1;
    double worst = 0;
    for (int i = 0; i < 4; i++) {
        knots[i].sample *= substeps;
        knots[i].has_slope = stiffness > 0;
        knots[i].stiffness = stiffness;
    }
    wiggly_desc desc = wiggly_default_desc();
    desc.mode = WIGGLY_CUBIC;
    desc.passive = WIGGLY_FILTER; // the textbook's ends: nothing is held behind the last knot
    desc.samples = samples;
    desc.step = 1.0 / (24 * substeps);
    desc.knots = knots;
    desc.knot_count = 4;
    wiggly_curve curve = curve_create(samples);
    curve_solve(&curve, &desc);
    for (int i = 0; i < 13; i++) worst = fmax(worst, fabs(curve.total[8 * i * substeps] - expected[i]));
    curve_destroy(&curve);
    return worst;
}

TEST(a_cubic_is_the_natural_spline)
{
    const double coarse = cubic_error(4, 0, classical[0]), fine = cubic_error(32, 0, classical[0]);
    assert_true(coarse < 1e-3 && fine < 1e-5);
    assert_true(fine < coarse / 50); // as h²
}

/// With tangents that are held more and more firmly: global smoothness at one end of the scale, local support at the other.
TEST(stiff_tangents_make_the_hermite_cubic)
{
    double before = INFINITY;
    for (double stiffness = 0.01; stiffness < 1e5; stiffness *= 100) {
        const double error = cubic_error(32, stiffness, classical[1]);
        assert_true(error < before);
        before = error;
    }
    const double coarse = cubic_error(16, 1e8, classical[1]), fine = cubic_error(64, 1e8, classical[1]);
    assert_true(coarse < 0.01 && fine < 0.3 * coarse); // as h: eq. 9 holds the slope half a sample late
}
