/// Splines of every kind: each holds what is asked of it, to the bit, and has the same bits however it is solved: by a fresh solver or one
/// with a past, in anybody's memory, in a batch over threads, on strided arrays, its knots in any order, in a host that traps, rounds
/// another way or drops tiny numbers.
#include "near.h"

/// Allocations that are still granted; counts down.
static long granted = -1;

static void *failing_calloc(size_t count, size_t size) { return granted-- == 0 ? NULL : calloc(count, size); }

#define calloc failing_calloc
#include "spline/batch.c"
#include "spline/solver.c"
#undef calloc

#include "curve.h"
#include "uniform.h"
#include <fenv.h>
#include <limits.h>
#ifdef __SSE2__
#include <xmmintrin.h>
#endif

enum { SAMPLES = 130, KNOTS = 9, HELD = KNOTS + SAMPLES, COUNT = 60, GUARD = 8 };

/// Splines of one filter, which a solver keeps from one to the next.
static const struct kind {
    const char *what;
    wiggly_mode mode;
    wiggly_start start;
    wiggly_passive passive;
    double frequency, damping, calm; ///< 0: 1.5, 0.1, 1
    int grid;                        ///< knots only on multiples of this; 0: anywhere
    bool undamped, moves, paced, limited, varies, winds_up;
    bool far;    ///< from the equilibrium, slow, and with slopes alone
    bool pairs;  ///< of knots, no two as far apart
    double told; ///< of the errors (struct tally), of those that differ in their knots alone and of all others
} kinds[] = {
    {.what = "complex from rest", .start = WIGGLY_REST, .frequency = 2.5, .damping = 0.3, .told = -22.996112},
    {.what = "real from rest", .mode = WIGGLY_REAL, .start = WIGGLY_REST, .damping = 2, .told = -23.908351},
    {.what = "half calm", .calm = 0.5, .told = -22.750616},
    {.what = "fast loops", .start = WIGGLY_LOOP, .frequency = 6, .told = -23.016013},
    {.what = "fast real loops", .mode = WIGGLY_REAL, .start = WIGGLY_LOOP, .frequency = 6, .told = -24.608950},
    {.what = "pivots that lose digits", .undamped = true, .calm = 0.001, .grid = 8, .told = -20.895614},
    {.what = "more lengths than there is room for", .pairs = true, .told = -22.875268},
    {.what = "filters from rest", .passive = WIGGLY_FILTER, .start = WIGGLY_REST, .damping = 0.3, .told = -22.788674},
    {.what = "moving equilibria", .moves = true, .told = -21.231711},
    {.what = "cubics on them", .mode = WIGGLY_CUBIC, .moves = true, .told = -24.790625},
    {.what = "filters on them", .passive = WIGGLY_FILTER, .moves = true, .told = -23.519141},
    {.what = "real loops on them", .mode = WIGGLY_REAL, .start = WIGGLY_LOOP, .moves = true, .told = -23.132523},
    {.what = "frequencies that vary", .paced = true, .told = -24.167595},
    {.what = "limits", .frequency = 2, .damping = 0.05, .limited = true, .told = -23.026872},
    {.what = "limited cubics on moving equilibria",
     .mode = WIGGLY_CUBIC,
     .moves = true,
     .limited = true,
     .told = -24.786458},
    {.what = "limits far from the equilibrium", .frequency = 0.06, .far = true, .limited = true, .told = -18.695699},
    {.what = "variations", .varies = true, .told = -22.798186},
    {.what = "real variations from rest",
     .mode = WIGGLY_REAL,
     .start = WIGGLY_REST,
     .varies = true,
     .told = -24.431106},
    {.what = "varied loops", .start = WIGGLY_LOOP, .varies = true, .told = -23.653114},
    {.what = "limited variations", .limited = true, .varies = true, .told = -22.424590},
    {.what = "wind-up", .winds_up = true, .told = -25.826456},
    {.what = "wind-up from rest, of a frequency that varies",
     .start = WIGGLY_REST,
     .winds_up = true,
     .paced = true,
     .told = -25.545897},
    {.what = "loops that wind up", .start = WIGGLY_LOOP, .winds_up = true, .told = -25.551344},
};

/// A spline, and what a solver of its own makes of it.
static struct one {
    wiggly_desc desc;
    wiggly_knot knots[KNOTS];
    double y[SAMPLES], pace[SAMPLES], numbers[5 * SAMPLES];
    wiggly_curve curve;
    wiggly_status status;
} ones[SAMPLES];

static const char *what;
static int count;

static wiggly_desc describe(const struct kind *kind)
{
    wiggly_desc desc = wiggly_default_desc();
    desc.samples = SAMPLES;
    desc.mode = kind->mode, desc.start = kind->start, desc.passive = kind->passive;
    desc.calm = kind->calm > 0 ? kind->calm : 1;
    desc.frequency.value = kind->frequency > 0 ? kind->frequency : 1.5;
    desc.damping.value = kind->undamped ? 0 : kind->damping > 0 ? kind->damping : 0.1;
    desc.bandwidth.value = desc.damping.value;
    if (kind->far) desc.equilibrium.value = 20;
    if (kind->varies) desc.variation = kind->limited ? 1 : 0.3;
    if (kind->winds_up) desc.wind_up = 0.6;
    desc.has_low = kind->limited && !kind->far, desc.has_high = kind->limited;
    desc.low = -1.02, desc.high = 1.01;
    return desc;
}

/// From no knot on, in twos side by side now and then; of every sort and in any order.
static int make_knots(const struct kind *kind, int i, uint64_t *seed, wiggly_knot *knots)
{
    const bool is_dense = i % 2 || i % 8 == 4; // the rest is spread out
    const int wanted = kind->far ? 4 : i % (KNOTS + 1), room = (SAMPLES - 1) / (is_dense ? KNOTS : wanted + 1);
    int made = 0;
    if (kind->pairs) {
        knots[0] = (wiggly_knot){.value = 1};
        knots[1] = (wiggly_knot){.sample = i % (SAMPLES - 1) + 1, .value = uniform(seed)};
        return 2;
    }
    for (int k = 0; k < wanted; k++) {
        int sample = k == 0 && i % 8 == 4 ? 0 : room * k + (int)(uniform(seed) * (room - 1));
        const bool beside = kind->grid == 0 && k > 0 && uniform(seed) < 0.2;
        if (beside) sample = knots[made - 1].sample + 1;
        if (kind->grid > 0) sample -= sample % kind->grid;
        if (made > 0 && sample <= knots[made - 1].sample) continue;
        const double sort = i % 3 || kind->winds_up ? uniform(seed) : 0.5;
        wiggly_knot *knot = &knots[made++];
        *knot = (wiggly_knot){.sample = sample, .value = 2 * uniform(seed) - 1, .slope = NAN, .phase = NAN};
        knot->has_slope = kind->far || sort < 0.2;
        knot->has_phase = sort > 0.8 && !kind->far;
        knot->still = i % 3 == 2 && sort > 0.4 && sort < 0.5 && !kind->limited;
        knot->settles = kind->winds_up && !knot->still && uniform(seed) < 0.3;
        if (knot->has_slope) knot->slope = 4 * uniform(seed) - 2, knot->stiffness = k % 2 ? 50 : 0;
        if (knot->has_phase) knot->phase = uniform(seed) - 0.5;
    }
    for (int k = 0; k < made && i % 4 == 1; k += 2) {
        const wiggly_knot first = knots[k];
        knots[k] = knots[made - 1], knots[made - 1] = first;
    }
    return made;
}

static bool has_knot(const wiggly_desc *desc, int sample)
{
    for (int k = 0; k < desc->knot_count; k++) {
        if (desc->knots[k].sample == sample) return true;
    }
    return false;
}

/// The spline before, with another value, sample and slope, length or frequency.
static void make_edited(struct one *one, const struct one *before, int i, uint64_t *seed)
{
    wiggly_desc *desc = &one->desc;
    wiggly_knot *knot = &one->knots[i % (before->desc.knot_count + !before->desc.knot_count)];
    int last = 0;
    *desc = before->desc;
    memcpy(one->knots, before->knots, sizeof one->knots);
    for (int k = 0; k < desc->knot_count; k++) last = one->knots[k].sample > last ? one->knots[k].sample : last;
    desc->knots = one->knots;
    if (i % 8 < 4) knot->value = 2 * uniform(seed) - 1;
    if (i % 8 == 5 && !has_knot(desc, knot->sample + 1) && knot->sample + 2 < SAMPLES) knot->sample++;
    if (i % 8 == 5 && !knot->still) knot->has_slope = !knot->has_slope, knot->slope = 1, knot->stiffness = 3;
    if (i % 8 > 5) desc->samples = last + 2 + 37 * i % (SAMPLES - 1 - last);
    if (i % 16 == 15) desc->frequency.value = 1.3;
}

/// One that nobody can solve now and then: two knots on one sample, a value that is no number, or (where all may differ) a calm of 7.
static void spoil(struct one *one, int i, bool alike)
{
    if (one->desc.knot_count < 4) return;
    if (i % 20 == 9) one->knots[3].sample = one->knots[2].sample;
    if (i % 20 == 19) one->knots[3].value = NAN, one->knots[3].still = false;
    if (i % 20 == 14 && !alike) one->desc.calm = 7;
}

/// The same description with another value of one member.
static void change_member(wiggly_desc *desc, const desc_member *member, const double *track)
{
    void *at = (char *)desc + member->offset;
    wiggly_param *param = member->kind == DESC_PARAM ? at : NULL;
    if (param && track) param->track = track;
    if (param && !track) param->value = 0.3;
    if (member->kind == DESC_NUMBER) *(double *)at = 0.2 + 0.5 * *(double *)at; // another number, whatever it was
    if (member->kind == DESC_COUNT) *(int *)at += 1;
    if (member->kind == DESC_CHOICE) *(unsigned char *)at ^= 1; // the low byte
}

static wiggly_desc describe_all(const struct kind *kind)
{
    static const wiggly_knot keys[] = {{.sample = 8, .value = 1},
                                       {.sample = 45, .value = -0.5, .has_slope = true, .stiffness = 20},
                                       {.sample = 110, .value = 2}};
    wiggly_desc desc = describe(kind);
    desc.samples = SAMPLES - 1;
    desc.bandwidth.value = 0.2, desc.equilibrium.value = 0.25, desc.calm = 0.5;
    desc.low = -20, desc.high = 20, desc.has_low = desc.has_high = !kind->winds_up;
    desc.knots = keys, desc.knot_count = 3;
    return desc;
}

/// Every other one differs from the rest in one member of its description.
static void make_members(const struct kind *kind)
{
    count = 0;
    for (const desc_member *m = desc_members; m->name; m++) {
        for (int track = 0; track < (m->kind == DESC_PARAM ? 2 : 1); track++) {
            ones[count++].desc = describe_all(kind);
            ones[count].desc = describe_all(kind);
            for (int k = 0; k < SAMPLES; k++) ones[count].y[k] = 0.4 + 0.1 * sin(0.05 * k);
            change_member(&ones[count].desc, m, track ? ones[count].y : NULL);
            count++;
        }
    }
}

/// All of a kind; `alike`: they differ in their knots alone.
static void make_ones(const struct kind *kind, bool alike)
{
    uint64_t seed = 5;
    count = kind->pairs ? SAMPLES - 1 : COUNT;
    for (int i = 0; i < count; i++) {
        struct one *one = &ones[i], *moving = &ones[alike ? 0 : i];
        one->desc = describe(kind);
        one->desc.knots = one->knots;
        if (alike || kind->pairs || i % 4 == 0) {
            one->desc.knot_count = make_knots(kind, i, &seed, one->knots);
            if (!alike && !kind->far) one->desc.equilibrium.value = 0.25 * (i % 8);
            if (!alike) one->desc.variation_seed = i % 3, one->desc.variation *= i % 5 > 0;
            if (!alike && i % 8 == 0 && !kind->far && kind->grid == 0) {
                one->desc.frequency.value *= 0.2 + 2 * uniform(&seed);
                one->desc.damping.value *= 3 * uniform(&seed);
                one->desc.wind_up *= 0.3 + 1.7 * uniform(&seed);
            }
        } else {
            make_edited(one, one - 1, i, &seed);
        }
        const int last = one->desc.samples - 1;
        for (int k = 0; k < SAMPLES; k++) {
            moving->y[k] = 0.2 * sin(0.1 * k * (alike ? 1 : 1 + i / 4)) + one->desc.equilibrium.value;
            moving->pace[k] = 1.5 + 0.5 * sin((alike ? 0.05 : 0.05 + 0.003 * (i / 4)) * k);
        }
        if (kind->start == WIGGLY_LOOP) moving->pace[last] = moving->pace[0]; // y goes on, and is not read
        if (kind->moves) one->desc.equilibrium.track = moving->y;
        if (kind->paced) one->desc.frequency.track = moving->pace;
    }
    for (int i = 0; i < count; i++) spoil(&ones[i], i, alike);
}

// --- what each holds -------------------------------------------------------------------------------------------------

#define HOLDS(condition)                                                                                             \
    do {                                                                                                             \
        if (!(condition)) fail_msg("%s: spline %d: not %s", what, i, #condition);                                    \
    } while (0)

/// Its knots and limits to the bit, a loop its seam, a free start what is before it.
static void check_held(const struct one *one, int i)
{
    const wiggly_desc *desc = &one->desc;
    const wiggly_curve *c = &one->curve;
    const int last = desc->samples - 1;
    HOLDS(c->knot == -1 && c->samples == desc->samples && c->step == desc->step && c->mode == desc->mode);
    const double last_digit = desc->wind_up > 0 ? 1e-15 : 0; // knots that settle move y
    const bool is_driven = desc->mode != WIGGLY_CUBIC && (desc->equilibrium.track || desc->variation != 0);
    for (int k = 0; k < desc->knot_count; k++) {
        const wiggly_knot *knot = &desc->knots[k];
        HOLDS(knot->still || c->total[knot->sample] == knot->value);
        HOLDS(!knot->settles || fabs(c->re[knot->sample]) < 1e-12);
        if (knot->has_phase && desc->mode == WIGGLY_COMPLEX) HOLDS(fabs(c->im[knot->sample] - knot->phase) < 1e-12);
    }
    for (int k = 0; k <= last; k++) {
        const wiggly_value at = wiggly_evaluate(c, k);
        if (desc->start == WIGGLY_LOOP && k == last) break; // it is the first one
        HOLDS(isfinite(c->im[k]) && fabs(c->total[k] - c->y[k] - c->re[k]) <= 1e-9 * (1 + fabs(c->y[k])));
        HOLDS(at.y == c->y[k] && at.re == c->re[k] && at.im == c->im[k]);
        if (k >= c->first && desc->knot_count > 0) { // else the start is where it is
            HOLDS(!desc->has_low || c->total[k] >= desc->low);
            HOLDS(!desc->has_high || c->total[k] <= desc->high);
        }
        if (desc->start == WIGGLY_FREE && k < c->first && !desc->equilibrium.track) {
            HOLDS(fabs(c->re[k] - c->re[c->first]) <= last_digit && fabs(c->im[k] - c->im[c->first]) <= last_digit);
            HOLDS(fabs(wiggly_evaluate(c, k + 0.4).re - c->re[k]) < 1e-12);
        }
        if (desc->knot_count == 0 && !is_driven) HOLDS(c->total[k] == c->y[k] && c->im[k] == 0);
    }
    if (desc->start == WIGGLY_LOOP) {
        const wiggly_value end = wiggly_evaluate(c, last + 0.25), start = wiggly_evaluate(c, 0.25);
        HOLDS(c->total[last] == c->total[0] && c->im[last] == c->im[0]);
        HOLDS(end.re == start.re && end.im == start.im);
    }
}

// --- the same bits ---------------------------------------------------------------------------------------------------

enum { TRAPS = FE_DIVBYZERO | FE_INVALID | FE_OVERFLOW };

/// A host that traps on floating-point exceptions, rounds upwards, and flushes tiny numbers to zero.
static void enter_strange_host(void)
{
    feclearexcept(FE_ALL_EXCEPT);
    fesetround(FE_UPWARD);
#ifdef __SSE2__
    _mm_setcsr(_mm_getcsr() | 0x8040);
#endif
#ifdef FE_NOMASK_ENV
    feenableexcept(TRAPS);
#endif
}

/// Fails unless it has its own state back.
static void leave_strange_host(void)
{
    const int rounding = fegetround();
    bool same = true;
#ifdef FE_NOMASK_ENV
    same = fegetexcept() == TRAPS;
#endif
#ifdef __SSE2__
    same = same && (_mm_getcsr() & 0x8040) == 0x8040;
#endif
    fesetenv(FE_DFL_ENV);
    if (rounding != FE_UPWARD || !same) fail_msg("%s: the host's state is lost", what);
}

static wiggly_curve curve_of(double *numbers)
{
    memset(numbers, 0x5A, 5 * SAMPLES * sizeof *numbers);
    wiggly_curve curve = curve_in(numbers, SAMPLES);
    curve.knot = 77;
    return curve;
}

/// Fails unless both have the same bits, in all arrays that `seen` has.
static void check_same(const char *way, int i, wiggly_status status, const wiggly_curve *seen)
{
    const wiggly_curve *is = &ones[i].curve;
    const double *const a[] = {is->total, is->y, is->re, is->im, is->omega}, *const b[] = {seen->total, seen->y,
                                                                                           seen->re, seen->im,
                                                                                           seen->omega};
    bool same = status == ones[i].status && seen->knot == is->knot;
    for (int c = 0; c < 5; c++) same &= !b[c] || memcmp(a[c], b[c], SAMPLES * sizeof(double)) == 0;
    same &= seen->samples == is->samples && seen->step == is->step && seen->first == is->first;
    same &= seen->mode == is->mode && seen->start == is->start;
    same &= seen->error == is->error && seen->refinements == is->refinements;
    if (!same) fail_msg("%s, %s: spline %d is another one (%d, not %d)", what, way, i, status, ones[i].status);
}

/// A solver for all of them, in memory of just its size.
static struct {
    unsigned char *memory;
    size_t size;
    wiggly_solver *solver;
} used;

/// All values as large, or as small, as numbers can hardly be: the same curve in another unit, to the bit.
static void check_scaled(int i)
{
    static double y[SAMPLES], numbers[5 * SAMPLES];
    static float floats[SAMPLES];
    const double scale = i % 2 ? 0x1p600 : 0x1p-600;
    wiggly_desc desc = ones[i].desc;
    bool has_size = desc.variation == 0; // a variation is a share of the farthest knot, or of 1
    for (int k = 0; k < desc.knot_count; k++) has_size = has_size || !desc.knots[k].still;
    if (!has_size) return;
    wiggly_knot knots[KNOTS];
    wiggly_curve curve = curve_of(numbers);
    for (int k = 0; k < desc.knot_count; k++) {
        knots[k] = desc.knots[k];
        knots[k].value *= scale, knots[k].slope *= scale, knots[k].phase *= scale;
    }
    for (int k = 0; k < SAMPLES; k++) y[k] = scale * (desc.equilibrium.track ? desc.equilibrium.track[k] : 0);
    desc.knots = knots;
    if (desc.equilibrium.track) desc.equilibrium.track = y;
    desc.equilibrium.value *= scale, desc.low *= scale, desc.high *= scale;
    memset(floats, 0x5A, sizeof floats);
    const float untouched = floats[0];
    curve.floats = floats;
    const wiggly_status status = wiggly_solve(used.solver, &desc, &curve);
    const bool is_filled = status < WIGGLY_ERROR_ARGUMENT;
    bool same = true;
    for (int k = 0; k < SAMPLES; k++)
        same = same && (is_filled && k < desc.samples ? floats[k] == (float)curve.total[k] : floats[k] == untouched);
    for (int k = 0; is_filled && k < 4 * SAMPLES; k++) {
        if (k % SAMPLES < desc.samples) numbers[k] /= scale; // not ω
    }
    if (!same) fail_msg("%s: spline %d has other floats", what, i);
    if (desc.has_low || desc.has_high) curve.error = ones[i].curve.error; // the search tells another bound
    check_same("in another unit", i, status, &curve);
}

/// One after the other, each as it is and then in ways that do not matter.
static void check_used(void)
{
    static double numbers[5 * SAMPLES];
    static float floats[3 * SAMPLES];
    for (int i = 0; i < count; i++) {
        struct later {
            wiggly_desc desc;
            double more;
        } later = {.desc = ones[i].desc};
        wiggly_desc *desc = &later.desc;
        wiggly_curve curve = curve_of(numbers);
        check_same("by a used solver", i, wiggly_solve(used.solver, desc, &curve), &curve);
        curve = curve_of(numbers);
        enter_strange_host();
        const wiggly_status there = wiggly_solve(used.solver, desc, &curve);
        leave_strange_host();
        check_same("in a strange host", i, there, &curve);
        check_scaled(i);
        wiggly_knot turned[KNOTS];
        for (int k = 0; k < desc->knot_count; k++) turned[k] = desc->knots[desc->knot_count - 1 - k];
        if (ones[i].status < WIGGLY_ERROR_ARGUMENT) desc->knots = turned; // else it names one
        desc->size = sizeof later;
        if (desc->variation == 0) desc->variation_seed = 99;
        if (desc->mode == WIGGLY_CUBIC) desc->variation = 1;
        curve = curve_of(numbers);
        curve.y = curve.re = curve.im = curve.omega = NULL;
        check_same("with what does not matter", i, wiggly_solve(used.solver, desc, &curve), &curve);
        for (int k = 0; k < 3 * SAMPLES; k++) floats[k] = -77;
        curve = (wiggly_curve){.size = sizeof curve, .floats = floats, .stride = 3};
        check_same("as floats", i, wiggly_solve(used.solver, desc, &curve), &curve);
        for (int k = 0; k < SAMPLES; k++) {
            const bool is_filled = ones[i].status < WIGGLY_ERROR_ARGUMENT && k < desc->samples;
            assert_true(floats[3 * k] == (is_filled ? (float)ones[i].curve.total[k] : -77));
            assert_true(floats[3 * k + 1] == -77 && floats[3 * k + 2] == -77);
        }
        later.more = 1; // what this version does not know
        assert_int_equal(wiggly_solve(used.solver, desc, &curve), WIGGLY_ERROR_SIZE);
    }
}

/// In a batch, in memory of just its size, twice: the second time with tables that are kept, in a strange host.
static void check_batch(int threads)
{
    static double numbers[SAMPLES][5 * SAMPLES];
    static float floats[SAMPLES][SAMPLES];
    wiggly_desc desc[SAMPLES];
    wiggly_curve curve[SAMPLES];
    wiggly_status status[SAMPLES], largest = WIGGLY_OK;
    wiggly_batch *batch = NULL;
    const size_t size = wiggly_batch_memsize(SAMPLES, HELD, threads);
    unsigned char *memory = malloc(size + GUARD);
    memset(memory, 0xa5, size + GUARD);
    granted = 0;
    assert_int_equal(wiggly_batch_create_at(memory, size - 1, SAMPLES, HELD, threads, &batch), WIGGLY_ERROR_MEMORY);
    assert_int_equal(wiggly_batch_create_at(memory + 1, size, SAMPLES, HELD, threads, &batch), WIGGLY_ERROR_ARGUMENT);
    assert_int_equal(wiggly_batch_create_at(memory, size, SAMPLES, HELD, threads, &batch), WIGGLY_OK);
    for (int i = 0; i < count; i++) {
        desc[i] = ones[i].desc;
        largest = ones[i].status > largest ? ones[i].status : largest;
    }
    for (int round = 0; round < 2; round++) {
        for (int i = 0; i < count; i++) {
            curve[i] = curve_of(numbers[i]);
            if (i % 5 == 0) curve[i].omega = curve[i].y = curve[i].re = NULL; // not asked for
            curve[i].floats = floats[i];
        }
        if (round) enter_strange_host();
        const wiggly_status said = wiggly_batch_solve(batch, desc, curve, status, count);
        if (round) leave_strange_host();
        assert_int_equal(said, largest);
        for (int i = 0; i < count; i++) {
            check_same("in a batch", i, status[i], &curve[i]);
            if (status[i] < WIGGLY_ERROR_ARGUMENT) assert_true(floats[i][5] == (float)ones[i].curve.total[5]);
        }
    }
    granted = -1;
    wiggly_batch_destroy(batch);
    for (size_t i = size; i < size + GUARD; i++) assert_int_equal(memory[i], 0xa5);
    free(memory);
}

/// What a spline's knots are in, one number for each.
enum part { AT, VALUE, SLOPE, STIFFNESS, PHASE, STILL, SETTLES, PARTS };

enum { PAD = 3, OUT = 4 };

static double part[PARTS][SAMPLES * KNOTS * PAD];
static double row[OUT][SAMPLES * SAMPLES * PAD];

/// How numbers lie: strides of knots and of samples.
static const struct layout {
    const char *what;
    ptrdiff_t knot_by_spline, knot_by_number, by_spline, by_number;
} layouts[] = {
    {"rows", KNOTS, 1, SAMPLES, 1},
    {"columns", 1, SAMPLES, 1, SAMPLES},
    {"apart", KNOTS *PAD, PAD, SAMPLES *PAD, PAD},
};

/// The places of a spline's knots among those in the arrays; NaN in the others.
static void put_knots(const struct layout *l, int i, int *place)
{
    const wiggly_desc *desc = &ones[i].desc;
    for (int k = 0, n = 0; k < KNOTS; k++) {
        const ptrdiff_t at = i * l->knot_by_spline + k * l->knot_by_number;
        const bool is_left_out = n == desc->knot_count || (KNOTS - k > desc->knot_count - n && (i + k) % 2);
        const wiggly_knot *knot = is_left_out ? &(wiggly_knot){0} : &desc->knots[n];
        part[AT][at] = is_left_out ? NAN : knot->sample + 0.3; // rounded
        part[VALUE][at] = knot->value;
        part[SLOPE][at] = knot->has_slope ? knot->slope : NAN;
        part[STIFFNESS][at] = knot->stiffness;
        part[PHASE][at] = knot->has_phase ? knot->phase : NAN;
        part[STILL][at] = knot->still, part[SETTLES][at] = knot->settles;
        if (!is_left_out) place[n++] = k;
    }
}

static void check_many(int threads)
{
    static wiggly_status status[SAMPLES];
    static int knot[SAMPLES], place[SAMPLES][KNOTS];
    wiggly_batch *batch;
    assert_int_equal(wiggly_batch_create(SAMPLES, HELD, threads, &batch), WIGGLY_OK);
    for (size_t n = 0; n < sizeof layouts / sizeof *layouts; n++) {
        const struct layout *l = &layouts[n];
        wiggly_many many = {.size = sizeof many, .count = count, .knot_count = KNOTS, .status = status, .knot = knot};
        wiggly_numbers *const in[PARTS] = {&many.sample, &many.value, &many.slope,  &many.stiffness,
                                           &many.phase,  &many.still, &many.settles};
        wiggly_rows *const out[OUT] = {&many.total, &many.y, &many.re, &many.im};
        for (int p = 0; p < PARTS; p++) *in[p] = (wiggly_numbers){part[p], l->knot_by_spline, l->knot_by_number};
        for (int p = 0; p < OUT; p++) *out[p] = (wiggly_rows){row[p], l->by_spline, l->by_number};
        for (int p = 0; p < OUT; p++) memset(row[p], 0x5A, sizeof row[p]);
        for (int i = 0; i < count; i++) put_knots(l, i, place[i]);
        wiggly_batch_solve_many(batch, &ones[0].desc, &many);
        for (int i = 0; i < count; i++) {
            const wiggly_curve *is = &ones[i].curve;
            const double *const own[OUT] = {is->total, is->y, is->re, is->im};
            bool same = status[i] == ones[i].status && knot[i] == (is->knot < 0 ? -1 : place[i][is->knot]);
            for (int p = 0; p < OUT; p++) {
                for (int k = 0; k < SAMPLES; k++)
                    same &= memcmp(&row[p][i * l->by_spline + k * l->by_number], &own[p][k], sizeof(double)) == 0;
            }
            if (!same) fail_msg("%s, %s: spline %d is another one (%d)", what, l->what, i, status[i]);
        }
    }
    wiggly_batch_destroy(batch);
}

/// How the splines of a kind went.
struct tally {
    int solved, wrong, lost_digits, refined, limited_again;
    double told; ///< the mean logarithm of the errors
};

static struct tally check_ones(const char *name)
{
    struct tally tally = {0};
    what = name;
    for (int i = 0; i < count; i++) {
        struct one *one = &ones[i];
        wiggly_solver *solver;
        assert_int_equal(wiggly_create(SAMPLES, HELD, &solver), WIGGLY_OK);
        one->curve = curve_of(one->numbers);
        one->status = wiggly_solve(solver, &one->desc, &one->curve);
        if (one->status < WIGGLY_ERROR_ARGUMENT) check_held(one, i), tally.solved++;
        tally.wrong += one->status >= WIGGLY_ERROR_ARGUMENT;
        tally.lost_digits += one->curve.error > 0;
        tally.refined += one->curve.refinements > 0;
        tally.limited_again += solver->limits.solves > 1;
        if (one->status < WIGGLY_ERROR_ARGUMENT) tally.told += log10(one->curve.error + 1e-18) / count;
        wiggly_destroy(solver);
    }
    check_used();
    for (int threads = 1; threads <= 3; threads++) check_batch(threads);
    return tally;
}

static double check_kind(const struct kind *kind)
{
    make_ones(kind, true);
    const struct tally alike = check_ones(kind->what);
    for (int threads = 1; threads <= 2; threads++) check_many(threads);
    make_ones(kind, false);
    const struct tally edited = check_ones(kind->what);
    if (!kind->pairs && !kind->far) assert_true(alike.wrong >= 2 && edited.wrong >= 2);
    assert_true(alike.solved > count / 2 && edited.solved > count / 2);
    if (kind->grid > 0) assert_true(alike.lost_digits > 0);
    if (kind->far) assert_true(alike.refined > 0);
    if (kind->limited && kind->frequency > 1) assert_true(alike.limited_again + edited.limited_again > 0);
    return alike.told + edited.told;
}

/// The bits are the same everywhere: another number is another bound, or another search; write it here if it is meant.
static void check_told(const char *of, double told, double expected)
{
    if (!(fabs(told - expected) < 1e-5)) fail_msg("%s: .told = %.6f", of, told);
}

TEST(every_kind_holds_what_is_asked_and_has_the_same_bits)
{
    double told = 0;
    for (int n = 0; n < 18; n++) {
        const struct kind plain = {.what = "mode, start and filter alone",
                                   .mode = (wiggly_mode)(n % 3),
                                   .start = (wiggly_start)(n / 3 % 3),
                                   .passive = (wiggly_passive)(n / 9)};
        told += check_kind(&plain) / 18;
    }
    check_told("mode, start and filter alone", told, -24.305237);
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++)
        check_told(kinds[k].what, check_kind(&kinds[k]), kinds[k].told);
}

/// All members are on the list, and a solver that has kept the factor of one description solves the next one, which differs in one of
/// them, as a fresh one does.
TEST(a_solver_notices_another_value_of_any_member)
{
    for (int n = 0; n < 12; n++) {
        const struct kind kind = {.mode = n < 9 ? (wiggly_mode)(n % 3) : WIGGLY_COMPLEX,
                                  .start = (wiggly_start)(n < 9 ? n / 3 : n - 9),
                                  .winds_up = n >= 9};
        make_members(&kind);
        check_ones("members");
    }
}

TEST(the_filter_is_kept_where_every_member_that_it_is_of_is_the_same)
{
    const struct kind kind = {.mode = WIGGLY_REAL, .start = WIGGLY_REST};
    wiggly_desc desc = describe_all(&kind), copy = desc_settings(&desc);
    assert_true(desc_same_filter(&desc, &copy));
    assert_null(copy.knots);
    for (const desc_member *m = desc_members; m->name; m++) {
        wiggly_desc other = desc;
        change_member(&other, m, NULL);
        assert_int_equal(desc_same_filter(&desc, &other), !m->filters);
    }
}

/// What else computes, in a strange host: a group, the frequency that explains knots, poles, values at odd times.
TEST(a_strange_host_changes_no_bit)
{
    static const double times[] = {1.3, NAN, INFINITY, -1};
    static const wiggly_knot knots[] = {{.sample = 0, .value = 3e-310},
                                        {.sample = 24, .value = 1, .has_slope = true, .slope = 2},
                                        {.sample = 40, .value = -0.4},
                                        {.sample = 70, .value = 0.2}};
    static struct results {
        double numbers[5 * SAMPLES];
        wiggly_value values[8];
        wiggly_explanation best[2];
        wiggly_poles poles;
        wiggly_status status;
    } results[2];
    const wiggly_desc desc = {.size = sizeof desc,
                              .knots = knots,
                              .knot_count = 4,
                              .samples = SAMPLES,
                              .frequency.value = 1.3,
                              .damping.value = 0.1};
    const wiggly_pull pull = {.c = {{1}}};
    wiggly_pin pin = {.sample = 50, .pulls = &pull, .pull_count = 1, .to = {0.3}};
    wiggly_group *group;
    what = "all but the solver";
    assert_int_equal(wiggly_group_create(SAMPLES, 4, 1, 1, &group), WIGGLY_OK);
    for (int is_strange = 0; is_strange < 2; is_strange++) {
        struct results *r = &results[is_strange];
        wiggly_curve curve = curve_of(r->numbers);
        if (is_strange) enter_strange_host();
        r->status = wiggly_group_solve(group, &desc, &(double){1}, &curve, 1, &pin, 1);
        wiggly_explain(&desc, r->best);
        r->poles = wiggly_poles_at(&desc, 3);
        for (int t = 0; t < 4; t++) r->values[t] = wiggly_evaluate(&curve, times[t]);
        wiggly_evaluate_many(&curve, times, 4, &r->values[4], NULL);
        if (is_strange) leave_strange_host();
        assert_int_equal(r->status, WIGGLY_OK);
    }
    assert_memory_equal(&results[1], &results[0], sizeof *results);
    wiggly_group_destroy(group);
}

// --- wrong calls, and no memory --------------------------------------------------------------------------------------

/// A stride of 0 gives all splines the same knots; what is not asked for is not filled.
TEST(knots_may_be_shared)
{
    static const double at[] = {3, 40, 70}, value[] = {0, 1, -1};
    const wiggly_desc desc = {.size = sizeof desc, .samples = SAMPLES, .frequency.value = 1};
    const wiggly_many many = {.size = sizeof many,
                              .count = 2,
                              .knot_count = 3,
                              .sample = {at, 0, 1},
                              .value = {value, 0, 1},
                              .total = {row[0], SAMPLES, 1}};
    wiggly_batch *batch;
    assert_int_equal(wiggly_batch_create(SAMPLES, 3, 1, &batch), WIGGLY_OK);
    assert_int_equal(wiggly_batch_solve_many(batch, &desc, &many), WIGGLY_OK);
    assert_memory_equal(row[0], row[0] + SAMPLES, SAMPLES * sizeof(double));
    assert_true(row[0][40] == 1 && row[0][SAMPLES + 70] == -1);
    wiggly_batch_destroy(batch);
}

TEST(wrong_calls_are_named)
{
    const wiggly_desc good = {.size = sizeof good, .samples = SAMPLES}, unsized = {.samples = SAMPLES};
    const wiggly_numbers in = {part[AT], 0, 1};
    const wiggly_many none = {.size = sizeof none}, small = {.size = 0}, less = {.size = sizeof less, .count = -1},
                      no_values = {.size = sizeof none, .count = 1, .knot_count = 1, .sample = in},
                      too_many = {.size = sizeof none, .count = 1, .knot_count = 9, .sample = in, .value = in};
    unsigned char *const memory = used.memory;
    wiggly_batch *batch = NULL, *other = NULL;
    wiggly_solver *solver = NULL;
    for (int k = 0; k < 9; k++) part[AT][k] = k;
    assert_int_equal(wiggly_batch_create(SAMPLES, 6, 1, &batch), WIGGLY_OK);
#define ROW(call, expected)                                                                                          \
    {                                                                                                                \
#call, call, expected                                                                                        \
    }
    const struct {
        const char *call;
        wiggly_status said, expected;
    } rows[] = {
        ROW(wiggly_batch_solve_many(batch, &good, &none), WIGGLY_OK),
        ROW(wiggly_batch_solve_many(batch, &good, &small), WIGGLY_ERROR_SIZE),
        ROW(wiggly_batch_solve_many(batch, &unsized, &none), WIGGLY_ERROR_SIZE),
        ROW(wiggly_batch_solve_many(batch, NULL, &none), WIGGLY_ERROR_ARGUMENT),
        ROW(wiggly_batch_solve_many(batch, &good, NULL), WIGGLY_ERROR_ARGUMENT),
        ROW(wiggly_batch_solve_many(NULL, &good, &none), WIGGLY_ERROR_ARGUMENT),
        ROW(wiggly_batch_solve_many(batch, &good, &less), WIGGLY_ERROR_ARGUMENT),
        ROW(wiggly_batch_solve_many(batch, &good, &no_values), WIGGLY_ERROR_ARGUMENT),
        ROW(wiggly_batch_solve_many(batch, &good, &too_many), WIGGLY_ERROR_CAPACITY),
        ROW(wiggly_batch_solve(batch, NULL, NULL, NULL, 0), WIGGLY_OK),
        ROW(wiggly_batch_solve(batch, NULL, NULL, NULL, 3), WIGGLY_ERROR_ARGUMENT),
        ROW(wiggly_batch_solve(NULL, NULL, NULL, NULL, 0), WIGGLY_ERROR_ARGUMENT),
        ROW(wiggly_batch_create(0, 1, 1, &other), WIGGLY_ERROR_ARGUMENT),
        ROW(wiggly_batch_create(10, 1, 0, &other), WIGGLY_ERROR_ARGUMENT),
        ROW(wiggly_batch_create(10, 1, 2, NULL), WIGGLY_ERROR_ARGUMENT),
        ROW(wiggly_create_at(memory, used.size - 1, SAMPLES, HELD, &solver), WIGGLY_ERROR_MEMORY),
        ROW(wiggly_create_at(memory + 1, used.size, SAMPLES, HELD, &solver), WIGGLY_ERROR_ARGUMENT),
    };
    for (size_t r = 0; r < sizeof rows / sizeof *rows; r++) {
        if (rows[r].said != rows[r].expected) fail_msg("%s: %s", rows[r].call, wiggly_status_text(rows[r].said));
    }
    wiggly_batch_destroy(batch);
    wiggly_batch_destroy(NULL);
    wiggly_destroy(NULL);
    assert_int_equal(wiggly_batch_memsize(0, 1, 1), 0);
    assert_int_equal(wiggly_batch_memsize(10, 1, 0), 0);
    assert_int_equal(wiggly_memsize(0, 0), 0);
    assert_int_equal(wiggly_memsize(10, -1), 0);
    assert_true(wiggly_memsize(10, INT_MAX) > wiggly_memsize(10, INT_MAX - 1));
}

/// A solver, and a batch of three threads, allocates once, and solving nothing.
TEST(running_out_of_memory_is_said)
{
    const wiggly_desc desc = {.size = sizeof desc, .samples = 50};
    wiggly_curve curve = {.size = sizeof curve};
    wiggly_batch *batch = NULL;
    wiggly_solver *solver = NULL;
    granted = 0;
    assert_int_equal(wiggly_create(50, 4, &solver), WIGGLY_ERROR_MEMORY);
    granted = 0;
    assert_int_equal(wiggly_batch_create(50, 4, 3, &batch), WIGGLY_ERROR_MEMORY);
    assert_true(solver == NULL && batch == NULL);
    granted = 1;
    assert_int_equal(wiggly_batch_create(50, 4, 3, &batch), WIGGLY_OK);
    assert_int_equal(granted, 0);
    assert_int_equal(wiggly_batch_solve(batch, &desc, &curve, NULL, 1), WIGGLY_OK);
    assert_int_equal(granted, 0);
    granted = -1;
    wiggly_batch_destroy(batch);
}

static int create(__attribute__((unused)) void **state)
{
    used.size = wiggly_memsize(SAMPLES, HELD);
    used.memory = malloc(used.size + GUARD);
    memset(used.memory, 0xa5, used.size + GUARD);
    return (int)wiggly_create_at(used.memory, used.size, SAMPLES, HELD, &used.solver);
}

static int destroy(__attribute__((unused)) void **state)
{
    int touched = 0;
    for (size_t i = used.size; i < used.size + GUARD; i++) touched += used.memory[i] != 0xa5;
    wiggly_destroy(used.solver);
    free(used.memory);
    return touched;
}

TESTS_BETWEEN(create, destroy)
