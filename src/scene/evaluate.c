/// Solves the splines that have changed and their followers in dependency order: each alone, or in groups that pins and floors join.
#include "scene/evaluate.h"
#include "base/hash.h"
#include "base/need.h"
#include "maths/maths.h"
#include "scene/pins.h"
#include "scene/text.h"
#include "spline/forced_response.h"
#include <assert.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { FIRST_KNOTS = 256, ROWS = 5 }; ///< rows of each curve: total, y, re, im, omega

/// The motion of a joint that a spline's equilibrium follows, read for every sample.
struct baked {
    uint64_t key; ///< hash of what was read; 0: nothing yet
    double gain;
    double *raw, *samples; ///< without gain and with it
    bool is_new;           ///< the spline must be solved again
};

struct spline_state {
    struct spline *held; ///< as it was solved
    struct baked baked;
    bool solved; ///< in this update
    bool forced; ///< must be solved even if it is unchanged, because something that moves its pinned rigs has changed
};

enum { FLOORS_MOST_BOUNDS = 256 }; ///< per group

struct floors {
    wiggly_bound *bounds;
    int *rig, *vertex;       ///< of each bound
    double (*c)[2];          ///< of each bound, for each member
    struct low_point *low;   ///< of the current rig, at each sample
    int in_hand;             ///< that rig, if nothing has been solved since; else -1
    double *room;            ///< memory for finding them
    double *sunk;            ///< per rig and sample: depth below its floor at which knots and pins hold it
    struct floor_left *left; ///< of each rig
    int count;               ///< bounds
};

/// A pin of the current group.
struct held_pin {
    int rig;
    const struct pin *pin;
    bool is_found;
    struct pin_point from; ///< the point at which its pulls were found
    double passed[3];      ///< Σ Re(c x) there
    double ease;           ///< how easily splines move it without pins: |c| over all pulls
};

/// Capacities.
struct pinned_room {
    int knots;      ///< of one spline, as the solver needs them
    int all_knots;  ///< of all splines
    int group;      ///< splines of the largest
    int pins, rigs; ///< of the document
    int bounds;     ///< 0: no rig has a floor
};

struct pinned {
    struct pool pool;
    struct pinned_room room;
    wiggly_group *solver;
    struct floors floors;
    bool served;       ///< groups were solved in the last update
    uint64_t version;  ///< of the source then
    struct rig **rigs; ///< as they were solved
    int rig_count;
    struct pin_left *left; ///< of all pins of the document
    int left_count;

    // of each spline
    int *which; ///< pin_groups_find()
    int *order;
    bool *placed;   ///< by pin_groups_order(), then: solved, if need be, in this update
    bool *was;      ///< it was solved in a group
    bool *bases;    ///< of the group in hand, pin_groups_find_bases()
    double *weight; ///< of pulling it

    // The current group of an update
    struct evaluation *evaluation;
    const struct document *document;
    int group; ///< as `which` has it
    int *members;
    int count;
    wiggly_desc *descs; ///< of the members, as the next two
    wiggly_curve *curves;
    double *weights;
    wiggly_knot *knots;
    pin_pull *c; ///< of a pin, for each member
    struct held_pin *held;
    int held_count;
    wiggly_pin *pins;   ///< one a held pin
    wiggly_pull *pulls; ///< of all pins, as many for each as the group has splines
};

struct storage {
    struct pool pool;
    wiggly_solver *solver;
    int solver_knots;
    double fps; ///< of the last update, as the next three
    int substeps, first_frame;
    uint64_t edits, version;
    wiggly_knot *knots; ///< of the spline being solved; solver_knots
    int *order;         ///< one for each spline, as the next two
    struct order_space space;
    struct spline_state *state;
    bool is_new; ///< the curves have a new layout, and none is solved
    struct pinned pinned;
};

// --- descriptions for the solver

/// What a parameter of a spline follows, sample by sample; NULL: a constant, or a motion that is not read yet.
static const double *track_of(const struct evaluation *evaluation, const struct document *document, int spline,
                              enum parameter parameter)
{
    const struct param *param = &document->splines[spline]->parameter[parameter];
    if (param->track >= 0) return evaluation->curves[param->track].total;
    return param->motion ? evaluation_motion(evaluation, spline) : NULL;
}

const double *evaluation_motion(const struct evaluation *evaluation, int spline)
{
    const struct baked *baked = &evaluation->storage->state[spline].baked;
    return baked->key != 0 ? baked->samples : NULL;
}

// The solver takes the motion of a base as the equilibrium y, and what hangs there moves by x alone. So knots go in with y added, and
// y is taken out of what comes back: values, curves and tracks are of x.

/// Whether a spline hangs on a base.
static bool hangs(const struct spline *spline)
{
    const struct joint_motion *motion = spline->parameter[PARAMETER_EQUILIBRIUM].motion;
    return motion && motion->of == MOTION_BASE;
}

double evaluation_offset(const struct evaluation *evaluation, const struct document *document, int spline,
                         double position)
{
    bool settles = false;
    if (!evaluation || spline >= evaluation->count || evaluation->samples == 0) return 0;
    const struct spline *of = document->splines[spline];
    for (int k = 0; k < of->knot_count; k++) settles |= of->knots[k].settles;
    if (!settles) return 0;

    // y less what it follows, read between samples as y is: from up to four of them.
    enum { AROUND = 4 };
    const wiggly_curve *curve = &evaluation->curves[spline];
    const double *own = hangs(of) ? NULL : track_of(evaluation, document, spline, PARAMETER_EQUILIBRIUM);
    const int last = curve->samples - 1;
    const bool is_loop = curve->start == WIGGLY_LOOP;
    const double at = is_loop ? position - last * floor(position / last) : fmin(fmax(position, 0), last);
    const int from = is_loop ? (int)at - 1 : (int)fmax((int)at - 1, 0);
    const int count = is_loop || from + AROUND <= last + 1 ? AROUND : last + 1 - from;
    double y[AROUND], none[AROUND] = {0};
    for (int k = 0; k < count; k++) {
        const int i = is_loop ? (from + k + last) % last : from + k;
        y[k] = curve->y[i] - (own ? own[i] : of->parameter[PARAMETER_EQUILIBRIUM].value);
    }
    const wiggly_curve around = {.y = y, .re = none, .im = none, .samples = count, .mode = WIGGLY_CUBIC};
    return wiggly_evaluate(&around, at - from).y;
}

/// The motion of the base that a spline hangs on, as described for the solver; NULL: it does not hang.
static const double *base_of(const struct spline *spline, const wiggly_desc *desc)
{
    return hangs(spline) ? desc->equilibrium.track : NULL;
}

/// How fast it moves at a sample, as the solver sees it.
static double base_speed(const double *base, const wiggly_desc *desc, int sample)
{
    const int last = desc->samples - 1;
    const bool loops = desc->start == WIGGLY_LOOP, ends = sample == last && !loops;
    const int behind = sample > 0 ? sample - 1 : loops && last > 0 ? last - 1 : 0;
    const int ahead = sample < last ? sample + 1 : loops && last > 0 ? 1 : last;
    return (base[ahead] - base[behind]) / (ends ? 1 : 2) / desc->step;
}

/// Takes the base out of a solved curve.
static void take_base(const struct spline *spline, const wiggly_desc *desc, wiggly_curve *curve)
{
    const double *const base = base_of(spline, desc);
    for (int i = 0; base && i < desc->samples; i++) {
        curve->y[i] -= base[i];
        curve->total[i] -= base[i];
    }
}

/// What is to be solved for one spline, its knots left out; tracks point into the curves and into baked motions.
static wiggly_desc describe(const struct evaluation *evaluation, const struct document *document, int spline,
                            bool cubic)
{
    wiggly_desc desc = wiggly_default_desc();
    desc.samples = document_samples(document);
    desc.step = document_step(document);
    for (enum parameter p = 0; p < PARAMETER_COUNT; p++) {
        parameter_describe(p, document->splines[spline]->parameter[p].value,
                           track_of(evaluation, document, spline, p), &desc);
    }
    desc.has_low = desc.low > -INFINITY;
    desc.has_high = desc.high < INFINITY;
    if (base_of(document->splines[spline], &desc)) desc.has_low = desc.has_high = false; // they would hold y + x
    if (cubic && desc.mode != WIGGLY_CUBIC) {
        desc.mode = WIGGLY_CUBIC;
        desc.passive = WIGGLY_OSCILLATOR; // holds its last value, so that a tail does not wind through its body
    }
    return desc;
}

/// Adds the spline's knots; `knots` must have room for them.
static void add_knots(wiggly_desc *desc, const struct document *document, int spline, wiggly_knot *knots)
{
    const struct spline *of = document->splines[spline];
    const double *const base = base_of(of, desc);
    for (int i = 0; i < of->knot_count; i++) {
        const struct knot *knot = &of->knots[i];
        knots[i] = (wiggly_knot){.sample = document_sample(document, knot->frame),
                                 .has_slope = knot->has_slope,
                                 .value = knot->still ? 0 : knot->value,
                                 .slope = knot->slope,
                                 .stiffness = knot->stiffness,
                                 .phase = knot->phase,
                                 .has_phase = knot->has_phase,
                                 .still = knot->still,
                                 .settles = knot->settles};
        if (!base || knot->still) continue;
        knots[i].value += base[knots[i].sample];
        knots[i].slope += base_speed(base, desc, knots[i].sample);
    }
    desc->knots = knots;
    desc->knot_count = of->knot_count;
}

/// Knots that the solver needs room for; with limits, also one for each sample that may be held.
static int knot_room(const struct spline *spline, int samples)
{
    return spline->knot_count + (spline_is_limited(spline) ? samples : 0);
}

/// A curve at rest, used if there is no solution.
static void flatten(wiggly_curve *curve, const wiggly_desc *desc)
{
    double *const rows[] = {curve->total, curve->y, curve->re, curve->im, curve->omega};
    for (size_t r = 0; r < sizeof rows / sizeof *rows; r++)
        memset(rows[r], 0, sizeof(double) * (size_t)desc->samples);
    curve->samples = desc->samples;
    curve->step = desc->step;
    curve->first = 0;
    curve->mode = desc->mode;
    curve->start = WIGGLY_FREE;
}

// --- groups of splines that pins and floors join
//
// A point of a tail or chain moves by Σ Re(c x) only near one pose. So this is a Gauss-Newton method: it starts from the motion without
// pins, and each round uses the pulls at the pose of the last one. No round is undone, so that the motion depends continuously on the
// pins' places (pin_aim()). A soft character needs one round.

enum { PIN_ROUNDS = 8, FIRST_ROOM = 8 };

/// Keeps references to the rigs, so that a changed rig never has the address of an old one.
static void hold_rigs(struct pinned *pinned, struct rig *const *rigs, int count)
{
    for (int r = 0; r < count; r++) rig_hold(rigs[r]);
    for (int r = 0; r < pinned->rig_count; r++) rig_drop(pinned->rigs[r]);
    if (count > 0) memcpy(pinned->rigs, rigs, (size_t)count * sizeof *rigs);
    pinned->rig_count = count;
}

static void pinned_free(struct pinned *pinned)
{
    hold_rigs(pinned, NULL, 0);
    wiggly_group_destroy(pinned->solver);
    pool_free(&pinned->pool);
    *pinned = (struct pinned){0};
}

static void grow(int *room, int needed)
{
    if (*room < FIRST_ROOM) *room = FIRST_ROOM;
    while (*room < needed) *room *= 2;
}

/// Makes room for the document's groups. Without pins it costs nothing.
static void pinned_resize(struct evaluation *evaluation, const struct document *document)
{
    struct storage *storage = evaluation->storage;
    struct pinned *pinned = &storage->pinned;
    struct pinned_room room = pinned->room;
    int knots = 0, *which = storage->space.stack;
    if (!pins_hold_any(document)) return;
    pin_groups_find(document, which);
    for (int s = 0; s < document->spline_count; s++) {
        int members = 0;
        for (int i = s; which[s] == s && i < document->spline_count; i++) members += which[i] == s;
        if (members > room.group) room.group = members;
    }
    for (int s = 0; s < document->spline_count; s++) {
        knots += document->splines[s]->knot_count;
        if (which[s] >= 0) grow(&room.knots, knot_room(document->splines[s], evaluation->samples));
    }
    grow(&room.all_knots, knots);
    grow(&room.pins, pins_count(document));
    grow(&room.rigs, document->rig_count);
    for (int r = 0; r < document->rig_count; r++) {
        if (rig_has_floor(document->rigs[r])) room.bounds = FLOORS_MOST_BOUNDS;
    }
    if (memcmp(&room, &pinned->room, sizeof room) == 0) return;
    for (int s = 0; pinned->was && s < evaluation->count; s++) storage->state[s].forced |= pinned->was[s];
    pinned_free(pinned);
    pinned->room = room;

    struct pool *pool = &pinned->pool;
    const size_t count = (size_t)evaluation->count, group = (size_t)room.group, pins = (size_t)room.pins,
                 rigs = (size_t)room.rigs;
    pinned->rigs = pool_take(pool, rigs, sizeof *pinned->rigs);
    pinned->left = pool_take(pool, pins, sizeof *pinned->left);
    pinned->which = pool_take(pool, count, sizeof *pinned->which);
    pinned->order = pool_take(pool, count, sizeof *pinned->order);
    pinned->placed = pool_take(pool, 2 * count, sizeof *pinned->placed);
    pinned->was = pool_take(pool, count, sizeof *pinned->was);
    pinned->bases = pinned->placed + count;
    pinned->weight = pool_take(pool, count, sizeof *pinned->weight);
    pinned->members = pool_take(pool, group, sizeof *pinned->members);
    pinned->descs = pool_take(pool, group, sizeof *pinned->descs);
    pinned->curves = pool_take(pool, group, sizeof *pinned->curves);
    pinned->weights = pool_take(pool, group, sizeof *pinned->weights);
    pinned->knots = pool_take(pool, (size_t)room.all_knots, sizeof *pinned->knots);
    pinned->c = pool_take(pool, group, sizeof *pinned->c);
    pinned->held = pool_take(pool, pins, sizeof *pinned->held);
    pinned->pins = pool_take(pool, pins, sizeof *pinned->pins);
    pinned->pulls = pool_take(pool, pins * group, sizeof *pinned->pulls);
    if (room.bounds > 0) {
        struct floors *floors = &pinned->floors;
        const size_t samples = (size_t)evaluation->samples, bounds = (size_t)room.bounds;
        const size_t numbers = LOW_POINT_ROOM * (size_t)low_point_samples(evaluation->samples);
        floors->bounds = pool_take(pool, bounds, sizeof *floors->bounds);
        floors->rig = pool_take(pool, bounds, sizeof *floors->rig);
        floors->vertex = pool_take(pool, bounds, sizeof *floors->vertex);
        floors->c = pool_take(pool, bounds * group, sizeof *floors->c);
        floors->low = pool_take(pool, samples, sizeof *floors->low);
        floors->room = pool_take(pool, numbers, sizeof *floors->room);
        floors->sunk = pool_take(pool, samples * rigs, sizeof *floors->sunk);
        floors->left = pool_take(pool, rigs, sizeof *floors->left);
    }
    if (room.group > 0 && wiggly_group_create_bounded(evaluation->samples, room.knots, room.group, room.pins,
                                                      room.bounds, &pinned->solver) != WIGGLY_OK)
        need_failed();
}

/// Whether a rig differs from the solved one; `beside_pins`: in more than its pins.
static bool rigs_differ(const struct pinned *pinned, bool beside_pins)
{
    const struct document *document = pinned->document;
    bool differ = pinned->rig_count != document->rig_count;
    for (int r = 0; !differ && r < document->rig_count; r++) {
        const struct rig *solved = pinned->rigs[r], *rig = document->rigs[r];
        differ = beside_pins ? !rig_equals(solved, rig) : solved != rig;
    }
    return differ;
}

/// Begins an update: orders the splines for groups, and finds which must be solved again because rigs or pins have changed. Returns whether
/// there are groups; if not, storage->order is the order.
static bool pinned_begin(struct evaluation *evaluation, const struct document *document)
{
    struct storage *storage = evaluation->storage;
    struct pinned *pinned = &storage->pinned;
    struct pin_cycle cycle;
    const int count = evaluation->count;
    const bool serves = pins_hold_any(document) && evaluation->models.find && !evaluation->cubic;
    pinned->evaluation = evaluation;
    pinned->document = document;
    if (!serves && !pinned->served) return false;
    for (int s = 0; s < count; s++) pinned->which[s] = -1;
    if (serves) pin_groups_find(document, pinned->which);
    const bool anew = serves != pinned->served || pinned->version != evaluation->models.version;
    const bool differs = anew || rigs_differ(pinned, false);
    for (int s = 0; s < count && differs; s++) storage->state[s].forced |= pinned->was[s] || pinned->which[s] >= 0;
    const bool all = anew || rigs_differ(pinned, true);
    for (int s = 0; s < count; s++) { // the weights of splines that are new in a group, or of all
        if (pinned->which[s] < 0 || (pinned->was[s] && !all)) continue;
        const struct model_source *source = &evaluation->models;
        pinned->weight[s] = 0;
        for (int r = 0; r < document->rig_count; r++)
            pinned->weight[s] += source->weigh(source->context, document, r, s);
        if (!(pinned->weight[s] > 0)) pinned->weight[s] = 1; // splines that move nothing
    }
    for (int s = 0; s < count; s++) pinned->was[s] = pinned->which[s] >= 0;
    pinned->served = serves;
    pinned->version = evaluation->models.version;
    hold_rigs(pinned, document->rigs, serves ? document->rig_count : 0);
    if (!serves || !pin_groups_order(document, pinned->which, storage->order, pinned->placed, pinned->order, &cycle))
        return false;
    for (int s = 0; s < count; s++) pinned->placed[s] = false;
    return true;
}

/// Finds a pin's point, so many samples later, on the present curves and, unless `c` is NULL, the members' pulls on it.
static bool find_point(const struct pinned *pinned, int rig, const struct pin *pin, double later, pin_pull *c,
                       struct pin_point *point)
{
    const struct model_source *source = &pinned->evaluation->models;
    const struct pin_query query = {rig, pin, pinned->members, c ? pinned->count : 0, later};
    return source->find(source->context, pinned->evaluation, pinned->document, &query, c, point);
}

/// Solves the group with so many pins and bounds, and publishes the curves for finding points.
static wiggly_status solve_round(struct pinned *pinned, int pins, int bounds)
{
    const wiggly_status status =
        wiggly_group_solve_bounded(pinned->solver, pinned->descs, pinned->weights, pinned->curves, pinned->count,
                                   pinned->pins, pins, pinned->floors.bounds, bounds);
    for (int i = 0; i < pinned->count; i++) {
        const int s = pinned->members[i];
        if (status < WIGGLY_ERROR_ARGUMENT)
            take_base(pinned->document->splines[s], &pinned->descs[i], &pinned->curves[i]);
        pinned->evaluation->curves[s] = pinned->curves[i];
    }
    return status;
}

static const double PIN_STEP = 0.5;     ///< largest step, as a share of the reach
static const double PIN_DAMPING = 4;    ///< less lets drags far out of reach jump (tests/scene/test_pins_scene.c)
static const double PIN_FIRMNESS = 0.3; ///< with less, they curl tails up; with more, less of what can be reached is

static double dot(const double a[3], const double b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// L of L Lᵀ = C + least.
static void factor(const wiggly_pull *pulls, int count, double least, double l[3][3])
{
    for (int j = 0; j < 3; j++) {
        for (int k = 0; k <= j; k++) {
            l[j][k] = j == k ? least : 0;
            for (int i = 0; i < count; i++)
                l[j][k] += pulls[i].c[j][0] * pulls[i].c[k][0] + pulls[i].c[j][1] * pulls[i].c[k][1];
            for (int m = 0; m < k; m++) l[j][k] -= l[j][m] * l[k][m];
            l[j][k] = j == k ? sqrt(l[j][j]) : l[j][k] / l[k][k];
        }
    }
}

/// v ← L⁻¹ v
static void forward(const double l[3][3], double v[3])
{
    for (int j = 0; j < 3; j++) {
        for (int k = 0; k < j; k++) v[j] -= l[j][k] * v[k];
        v[j] /= l[j][j];
    }
}

/// v ← L⁻ᵀ v
static void backward(const double l[3][3], double v[3])
{
    for (int j = 2; j >= 0; j--) {
        for (int k = j + 1; k < 3; k++) v[j] -= l[k][j] * v[k];
        v[j] /= l[j][j];
    }
}

/// Sets the target of x for a pin's point at `held->from`. A tail or chain is
/// moved only part of the way if it is far or hard to move. Its conditions (also `pulls`, the pin's) are weighted so that splines that
/// barely move it, measured without pins, give way. Everything is continuous in `to` and `from`.
///
/// With C = Σ c cᵀ of the pulls at a round's pose, r the point's reach from its base, and v its way, first cut to r/2:
///
///     v ← C (C + 4 |c⁰|² (|v|/r)^{3/2})⁻¹ v             a far way takes no step that would curl the rig up; a near one is taken whole
///     rows ← L⁻¹ rows,  L Lᵀ = C + 0.3 |c⁰|²             a curled rig does not count as easily moved in all directions alike
///
/// where |c⁰|, `held->ease`, is from the motion without pins. The place itself is moved to within r of the base.
static void pin_aim(const struct held_pin *held, wiggly_pin *pin, wiggly_pull *pulls)
{
    const struct pin_point *from = &held->from;
    const double *to = held->pin->to, ease = held->ease;
    const bool is_bent = !from->is_linear && ease > 0 && from->reach > 0;
    double way[3] = {to[0] - from->at[0], to[1] - from->at[1], to[2] - from->at[2]}, l[3][3];

    if (is_bent) {
        double out[3];
        for (int k = 0; k < 3; k++) out[k] = to[k] - from->base[k];
        const double away = sqrt(dot(out, out));
        for (int k = 0; k < 3; k++)
            way[k] = (away > from->reach ? from->base[k] + out[k] * (from->reach / away) : to[k]) - from->at[k];

        const double far = sqrt(dot(way, way)), part = fmin(1, PIN_STEP * from->reach / far);
        const double share = part * far / from->reach, damping = PIN_DAMPING * ease * ease * share * sqrt(share);
        for (int k = 0; k < 3; k++) way[k] *= part;
        if (damping > 0) {
            double left[3] = {way[0], way[1], way[2]};
            factor(pulls, pin->pull_count, damping, l);
            forward(l, left);
            backward(l, left);
            for (int k = 0; k < 3; k++) way[k] -= damping * left[k];
        }
    }
    for (int k = 0; k < 3; k++) pin->to[k] = held->passed[k] + way[k];

    if (!is_bent) return;
    factor(pulls, pin->pull_count, PIN_FIRMNESS * ease * ease, l);
    forward(l, pin->to);
    for (int i = 0; i < pin->pull_count; i++) {
        for (int part = 0; part < 2; part++) {
            double c[3] = {pulls[i].c[0][part], pulls[i].c[1][part], pulls[i].c[2][part]};
            forward(l, c);
            for (int k = 0; k < 3; k++) pulls[i].c[k][part] = c[k];
        }
    }
}

/// The sample nearest to a position on a curve, and how far beyond it that is.
static int nearest_sample(const wiggly_curve *curve, double position, double *beyond)
{
    const int last = curve->samples - 1;
    const bool is_loop = curve->start == WIGGLY_LOOP;
    if (is_loop) position -= last * floor(position / last);
    position = fmin(fmax(position, 0), last);
    *beyond = position - rint(position);
    const int sample = (int)rint(position);
    return is_loop && sample == last ? 0 : sample;
}

/// Finds the points, and the present pulls on them; the first time without pins. Between samples a pull on the nearest one, turned as far as x
/// turns from there, is near the derivative, and further rounds remove the rest.
static void find_pulls(struct pinned *pinned, bool is_first)
{
    for (int h = 0; h < pinned->held_count; h++) {
        struct held_pin *held = &pinned->held[h];
        wiggly_pin *pin = &pinned->pins[h];
        wiggly_pull *pulls = &pinned->pulls[h * pinned->count];
        const double read =
            document_sample(pinned->document, held->pin->frame) - document_delay(pinned->document, held->rig);
        double beyond;
        const int spline = rig_point_spline(pinned->document->rigs[held->rig]);
        *pin = (wiggly_pin){.sample = nearest_sample(&pinned->evaluation->curves[spline], read, &beyond),
                            .pulls = pulls};
        held->is_found = find_point(pinned, held->rig, held->pin, 0, pinned->c, &held->from);
        if (!held->is_found) continue;
        pin->pull_count = pinned->count;
        for (int i = 0; i < pinned->count; i++) {
            const wiggly_curve *curve = &pinned->curves[i];
            const bool is_there =
                nearest_sample(curve, read, &beyond) == pin->sample; // beyond an end some splines wrap
            const bool turns = curve->mode == WIGGLY_COMPLEX;
            const maths_point turn = maths_turn(turns ? curve->omega[pin->sample] * curve->step * beyond : 0);
            pulls[i].spline = i;
            for (int k = 0; k < 3; k++) {
                const double *c = pinned->c[i][k];
                pulls[i].c[k][0] = is_there ? c[0] * turn.cos - c[1] * turn.sin : 0;
                pulls[i].c[k][1] = is_there ? c[0] * turn.sin + c[1] * turn.cos : 0;
            }
        }
        for (int k = 0; k < 3; k++) {
            held->passed[k] = 0;
            for (int i = 0; i < pinned->count; i++) {
                const wiggly_curve *curve = &pinned->curves[i];
                held->passed[k] +=
                    pulls[i].c[k][0] * curve->re[pin->sample] - pulls[i].c[k][1] * curve->im[pin->sample];
            }
        }
        if (!is_first) continue;
        double sum = 0;
        for (int i = 0; i < pin->pull_count; i++) {
            for (int k = 0; k < 3; k++)
                sum += pulls[i].c[k][0] * pulls[i].c[k][0] + pulls[i].c[k][1] * pulls[i].c[k][1];
        }
        held->ease = sqrt(sum);
    }
}

static double distance(const double a[3], const double b[3])
{
    return maths_hypot(maths_hypot(a[0] - b[0], a[1] - b[1]), a[2] - b[2]);
}

/// Does rounds, starting from the solved motion without pins, until each point is at its place or no longer moves.
static wiggly_status approach(struct pinned *pinned)
{
    wiggly_status status = WIGGLY_OK;
    bool is_linear = true;
    for (int h = 0; h < pinned->held_count; h++)
        is_linear &= !pinned->held[h].is_found || pinned->held[h].from.is_linear;
    const int most = is_linear ? 1 : PIN_ROUNDS;
    for (int n = 0; n < most; n++) {
        for (int h = 0; h < pinned->held_count; h++) {
            if (pinned->held[h].is_found)
                pin_aim(&pinned->held[h], &pinned->pins[h], &pinned->pulls[h * pinned->count]);
        }
        status = solve_round(pinned, pinned->held_count, 0);
        if (status >= WIGGLY_ERROR_ARGUMENT || n + 1 == most) break;

        bool there = true;
        for (int h = 0; h < pinned->held_count; h++) {
            const struct held_pin *held = &pinned->held[h];
            struct pin_point now;
            if (!held->is_found) continue;
            find_point(pinned, held->rig, held->pin, 0, NULL, &now);
            there &= held->from.is_linear || distance(held->pin->to, now.at) <= now.slack ||
                     distance(now.at, held->from.at) <= now.slack;
        }
        if (there) break;
        find_pulls(pinned, false);
    }
    return status;
}

// --- floors: keeps the lowest points of characters above them
//
// Cutting planes: the lowest vertex of every dip below the floor becomes a bound, and the group is solved again with all bounds so
// far, until no vertex is deeper than the tolerance. Each solve is convex, and its result depends on the bounds alone.
//
// Knots and pins have priority. Where they hold a character below its floor, the floor sinks to that depth and rises again over a
// quarter of a period; otherwise the curve would jump up to it within a sample.

enum { FLOOR_ROUNDS = 24 };

static const double DEEP = 1e-5; ///< floor_depth below a floor that is tolerated, as a share of the character's size
static const double NO_REACH =
    0.04; ///< reach below which knots and pins leave a point no way (docs/mathematics.md, Pins, Reach)
static const double RISE = 0.25; ///< periods

/// Whether a rig of the current group has a floor.
static bool floor_concerns(const struct pinned *pinned, int index)
{
    const struct rig *rig = pinned->document->rigs[index];
    return rig_has_floor(rig) && rig_input_count(rig) > 0 && pinned->which[rig_input(rig, 0)] == pinned->group;
}

static double floor_of(const struct pinned *pinned, int rig) { return pinned->document->rigs[rig]->model.floor; }

/// How far a rig's floor has sunk at each sample.
static double *sunk_of(const struct pinned *pinned, int rig)
{
    return pinned->floors.sunk + rig * pinned->evaluation->samples;
}

/// The current floor's height at a sample.
static double floor_level(const struct pinned *pinned, int rig, int sample)
{
    return floor_of(pinned, rig) - sunk_of(pinned, rig)[sample];
}

static double floor_depth(const struct pinned *pinned, int rig, int sample)
{
    return floor_level(pinned, rig, sample) - pinned->floors.low[sample].height;
}

static bool find_low(struct pinned *pinned, int rig)
{
    const struct model_source *source = &pinned->evaluation->models;
    struct floors *floors = &pinned->floors;
    if (floors->in_hand == rig) return true;
    if (!source->lowest(source->context, pinned->evaluation, pinned->document, rig, floor_of(pinned, rig),
                        floors->room, floors->low))
        return false;
    floors->in_hand = rig;
    return true;
}

/// Writes bound `b`: the lowest vertex at a sample must be at `height` or above. Returns the size of its rig.
static double put_bound(struct pinned *pinned, int b, int rig, int sample, double height)
{
    struct floors *floors = &pinned->floors;
    wiggly_bound *bound = &floors->bounds[b];
    double(*c)[2] = floors->c + b * pinned->count;
    const struct pin pin = {.frame = document_frame(pinned->document, sample), .point = floors->low[sample].vertex};
    struct pin_point point = {.size = 1};
    find_point(pinned, rig, &pin, document_delay(pinned->document, rig), pinned->c, &point);
    *bound = (wiggly_bound){.sample = sample, .c = (const double(*)[2])c, .least = height - point.at[1]};
    for (int i = 0; i < pinned->count; i++) {
        const wiggly_curve *curve = &pinned->curves[i];
        memcpy(c[i], pinned->c[i][1], sizeof c[i]);
        bound->least += c[i][0] * curve->re[sample] - c[i][1] * curve->im[sample];
    }
    floors->rig[b] = rig;
    floors->vertex[b] = pin.point;
    return point.size;
}

/// How far a bound is missed.
static double bound_missed(const struct pinned *pinned, int b)
{
    const wiggly_bound *bound = &pinned->floors.bounds[b];
    double missed = bound->least;
    for (int i = 0; i < pinned->count; i++)
        missed -= bound->c[i][0] * pinned->curves[i].re[bound->sample] -
                  bound->c[i][1] * pinned->curves[i].im[bound->sample];
    return missed;
}

/// Lowers a rig's floor where knots and pins hold the rig below it.
static void find_sunk(struct pinned *pinned, int rig)
{
    const int samples = pinned->evaluation->samples;
    double *sunk = sunk_of(pinned, rig);
    memset(sunk, 0, sizeof *sunk * (size_t)samples);
    if (!find_low(pinned, rig)) return;
    for (int i = 0; i < samples; i++) {
        const double by = floor_of(pinned, rig) - pinned->floors.low[i].height;
        bool has_knot = false;
        for (int m = 0; by > 0 && m < pinned->count; m++) {
            for (int k = 0; k < pinned->descs[m].knot_count; k++) has_knot |= pinned->descs[m].knots[k].sample == i;
        }
        for (int h = 0; by > 0 && h < pinned->held_count; h++) has_knot |= pinned->pins[h].sample == i;
        if (!(by > 0) || !has_knot) continue;
        put_bound(pinned, 0, rig, i, 0);
        const double held = 1 - wiggly_group_reach(pinned->solver, &pinned->floors.bounds[0]) / NO_REACH;
        if (!(held > 0)) continue;

        // It rises again over a quarter of a period of the slowest member.
        double slowest = INFINITY;
        for (int m = 0; m < pinned->count; m++) {
            const wiggly_desc *desc = &pinned->descs[m];
            const double frequency = desc->frequency.track ? desc->frequency.track[i] : desc->frequency.value;
            if (frequency > 0) slowest = fmin(slowest, frequency);
        }
        const double rise = RISE / (slowest * pinned->descs[0].step);
        for (int k = 0; k < samples; k++) {
            const double left = 1 - abs(k - i) / (rise + 1);
            if (left > 0) sunk[k] = fmax(sunk[k], by * held * left * left);
        }
    }
}

/// Solves the current group again, above its floors; `status` is the result without them.
static wiggly_status floors_solve(struct pinned *pinned, wiggly_status status)
{
    struct floors *floors = &pinned->floors;
    const int rigs = pinned->document->rig_count;
    floors->count = 0;
    floors->in_hand = -1;
    for (int r = 0; r < rigs; r++) {
        if (floor_concerns(pinned, r)) find_sunk(pinned, r);
    }
    for (int n = 0; n < FLOOR_ROUNDS && status < WIGGLY_ERROR_ARGUMENT; n++) {
        bool any = false;
        for (int r = 0; r < rigs; r++) {
            if (!floor_concerns(pinned, r)) continue;

            // A bound for the deepest vertex of every dip.
            const int end = find_low(pinned, r) ? pinned->evaluation->samples : 0;
            for (int i = 0; i < end && floors->count < FLOORS_MOST_BOUNDS; i++) {
                const double deep = floor_depth(pinned, r, i);
                if (!(deep > 0) || (i > 0 && floor_depth(pinned, r, i - 1) > deep)) continue;
                if (i + 1 < end && floor_depth(pinned, r, i + 1) >= deep) continue;
                const double size = put_bound(pinned, floors->count, r, i, floor_level(pinned, r, i));
                // One that is met while its vertex is deep gets another tangent of the vertex's curve.
                bool is_missed = false;
                for (int b = 0; b < floors->count; b++) {
                    is_missed |= floors->rig[b] == r && floors->bounds[b].sample == i &&
                                 floors->vertex[b] == floors->vertex[floors->count] &&
                                 bound_missed(pinned, b) > deep / 2;
                }
                if (!(deep > DEEP * size) || is_missed) continue;
                floors->count++;
                any = true;
            }
            struct floor_left *left = &floors->left[r];
            *left = (struct floor_left){.sample = -1};
            for (int i = 0; i < pinned->evaluation->samples; i++) {
                const double by = floor_of(pinned, r) - floors->low[i].height;
                if (by > left->depth) *left = (struct floor_left){by, i};
            }
        }
        if (!any) break;
        status = solve_round(pinned, pinned->held_count, floors->count);
        floors->in_hand = -1;
    }
    return status;
}

/// Solves the current group into the members' curves. false if it cannot be solved together.
static bool pinned_solve(struct pinned *pinned, wiggly_status *status)
{
    const struct evaluation *evaluation = pinned->evaluation;
    const struct document *document = pinned->document;
    bool has_floor = false;
    for (int r = 0; r < document->rig_count; r++) has_floor |= floor_concerns(pinned, r);
    wiggly_group_set_method(pinned->solver, evaluation->solver == SOLVER_BAND ? WIGGLY_BAND : WIGGLY_CHAIN);

    wiggly_knot *knots = pinned->knots;
    pinned->count = 0;
    for (int s = 0; s < evaluation->count; s++) {
        if (pinned->which[s] != pinned->group) continue;
        const int i = pinned->count++;
        pinned->members[i] = s;
        pinned->weights[i] = pinned->weight[s];
        pinned->curves[i] = evaluation->curves[s];
        pinned->descs[i] = describe(evaluation, document, s, false);
        add_knots(&pinned->descs[i], document, s, knots);
        knots += pinned->descs[i].knot_count;
    }
    for (int i = 0; has_floor && i < pinned->count; i++) { // as where pins pull: they are passed over, pressed or not
        pinned->descs[i].has_low = pinned->descs[i].has_high = false;
    }

    // Splines that come after the group but move its rigs are taken as still, so the result does not depend on their last state.
    for (int s = 0; s < evaluation->count; s++) {
        if (!pinned->bases[s] || pinned->placed[s]) continue;
        flatten(&evaluation->curves[s], &pinned->descs[0]);
        evaluation->storage->state[s].forced = true;
    }

    pinned->held_count = 0;
    for (int r = 0; r < document->rig_count; r++) {
        const struct rig *rig = document->rigs[r];
        const int spline = rig_point_spline(rig);
        const bool is_held = spline >= 0 && pinned->which[spline] == pinned->group;
        for (int i = 0; is_held && i < rig->pin_count; i++)
            pinned->held[pinned->held_count++] = (struct held_pin){.rig = r, .pin = &rig->pins[i]};
    }

    *status = solve_round(pinned, 0, 0);
    if (*status >= WIGGLY_ERROR_ARGUMENT) return false;
    find_pulls(pinned, true);
    if (pinned->held_count > 0) *status = approach(pinned);
    if (has_floor) *status = floors_solve(pinned, *status);
    return *status < WIGGLY_ERROR_ARGUMENT;
}

const struct pin_left *evaluation_pin(const struct evaluation *evaluation, const struct document *document, int rig,
                                      int pin)
{
    const struct storage *storage = evaluation->storage;
    int number = pin;
    for (int r = 0; r < rig; r++) number += document->rigs[r]->pin_count;
    return storage && number < storage->pinned.left_count ? &storage->pinned.left[number] : NULL;
}

const struct floor_left *evaluation_floor(const struct evaluation *evaluation, int rig)
{
    const struct storage *storage = evaluation->storage;
    return storage && storage->pinned.floors.left && rig < storage->pinned.room.rigs
               ? &storage->pinned.floors.left[rig]
               : NULL;
}

// --- an update

static void free_storage(struct evaluation *evaluation)
{
    struct storage *storage = evaluation->storage;
    if (!storage) return;
    for (int s = 0; s < evaluation->count; s++) spline_drop(storage->state[s].held);
    wiggly_destroy(storage->solver);
    pinned_free(&storage->pinned);
    pool_free(&storage->pool);
    free(storage);
    evaluation->storage = NULL;
}

/// Makes room for the document's splines.
static void make_room(struct evaluation *evaluation, const struct document *document)
{
    const int splines = document->spline_count, samples = document_samples(document);
    int needed = 0, knots = FIRST_KNOTS;
    for (int i = 0; i < splines; i++) {
        const int room = knot_room(document->splines[i], samples);
        if (room > needed) needed = room;
    }
    while (knots < needed) knots *= 2;
    if (evaluation->storage && evaluation->count == splines && evaluation->samples == samples &&
        evaluation->storage->solver_knots >= needed)
        return;
    free_storage(evaluation);

    struct storage *storage = evaluation->storage = need_zeroed(1, sizeof *storage);
    struct pool *pool = &storage->pool;
    const size_t count = (size_t)splines, n = (size_t)samples;
    double *numbers = pool_take(pool, count * ROWS * n, sizeof *numbers);
    evaluation->curves = pool_take(pool, count, sizeof *evaluation->curves);
    evaluation->status = pool_take(pool, count, sizeof *evaluation->status);
    evaluation->count = splines;
    evaluation->samples = samples;
    storage->state = pool_take(pool, count, sizeof *storage->state);
    storage->order = pool_take(pool, count, sizeof *storage->order);
    storage->space.stack = pool_take(pool, count, sizeof *storage->space.stack);
    storage->space.next = pool_take(pool, count, sizeof *storage->space.next);
    storage->knots = pool_take(pool, (size_t)knots, sizeof *storage->knots);
    if (wiggly_create(samples, knots, &storage->solver) != WIGGLY_OK) need_failed();
    storage->solver_knots = knots;
    storage->is_new = true;
    for (int i = 0; i < splines; i++, numbers += ROWS * n) {
        evaluation->curves[i] = (wiggly_curve){.size = sizeof(wiggly_curve),
                                               .total = numbers,
                                               .y = numbers + n,
                                               .re = numbers + 2 * n,
                                               .im = numbers + 3 * n,
                                               .omega = numbers + 4 * n,
                                               .samples = samples,
                                               .mode = WIGGLY_CUBIC};
    }
}

void evaluation_free(struct evaluation *evaluation)
{
    free_storage(evaluation);
    *evaluation = (struct evaluation){0};
}

/// Keeps a reference to the solved spline, so that its address is not reused.
static void mark_solved(struct evaluation *evaluation, const struct document *document, int spline,
                        wiggly_status status)
{
    struct spline_state *state = &evaluation->storage->state[spline];
    struct spline *old = state->held;
    state->held = spline_hold(document->splines[spline]);
    spline_drop(old);
    state->solved = true;
    state->baked.is_new = state->forced = false;
    evaluation->status[spline] = status;
    evaluation->revision++;
    evaluation->solved_splines++;
    evaluation->solved_samples += evaluation->samples;
    evaluation->solved_knots += state->held->knot_count;
}

static void solve_alone(struct evaluation *evaluation, const struct document *document, int spline, bool cubic)
{
    struct storage *storage = evaluation->storage;
    wiggly_curve *curve = &evaluation->curves[spline];
    wiggly_desc desc = describe(evaluation, document, spline, cubic);
    assert(document->splines[spline]->knot_count <= storage->solver_knots);
    add_knots(&desc, document, spline, storage->knots);
    wiggly_set_method(storage->solver, evaluation_method(evaluation));
    const wiggly_status status = wiggly_solve(storage->solver, &desc, curve);
    if (status >= WIGGLY_ERROR_ARGUMENT)
        flatten(curve, &desc);
    else
        take_base(document->splines[spline], &desc, curve);
    mark_solved(evaluation, document, spline, status);
}

/// Whether a spline is out of date: it has changed since it was solved, or a spline that it follows was solved.
static bool is_due(struct evaluation *evaluation, const struct document *document, int spline)
{
    const struct storage *storage = evaluation->storage;
    const struct spline_state *state = &storage->state[spline];
    const struct spline *of = document->splines[spline];
    bool due = storage->is_new || state->held != of || state->baked.is_new || state->forced;
    for (enum parameter p = 0; p < PARAMETER_COUNT && !due; p++) {
        const int track = of->parameter[p].track;
        due = track >= 0 && storage->state[track].solved && spline_uses(of, p, evaluation->cubic);
    }
    return due;
}

wiggly_desc evaluation_describe(const struct evaluation *evaluation, const struct document *document, int spline,
                                wiggly_knot *knots)
{
    wiggly_desc desc = describe(evaluation, document, spline, evaluation->cubic);
    add_knots(&desc, document, spline, knots);
    return desc;
}

static uint64_t hash_text(uint64_t hash, const char *text)
{
    return hash_bytes(hash, text ? text : "", text_size(text));
}

static uint64_t hash_number(uint64_t hash, double number) { return hash_bytes(hash, &number, sizeof number); }

/// Reads motions again if the document's frames, model, clip or chain, or the source's version, have changed; their splines are then
/// solved. An unreadable motion is 0 throughout.
static void motions_bake(struct evaluation *evaluation, const struct document *document)
{
    const int count = evaluation->samples;
    for (int s = 0; s < document->spline_count; s++) {
        const struct param *param = &document->splines[s]->parameter[PARAMETER_EQUILIBRIUM];
        struct baked *baked = &evaluation->storage->state[s].baked;
        if (!param->motion) continue;

        // A hash of everything that the samples depend on; never 0.
        const struct joint_motion *motion = param->motion;
        const struct model_source *source = &evaluation->models;
        const int model = document_find_model(document, motion->model);
        const int chain = motion->chain ? document_find_chain(document, motion->chain) : -1;
        uint64_t key = hash_text(HASH_START, motion->joint);
        key = hash_word(hash_number(key, document->fps), (uint64_t)document->substeps);
        key = hash_word(hash_word(key, (uint64_t)document->first_frame), (uint64_t)document->last_frame);
        const struct model_rig *of = model >= 0 ? &document->rigs[model]->model : NULL;
        const char *coordinate = NULL; // the first that it drives
        for (int d = of ? of->drive_count - 1 : -1; d >= 0; d--)
            coordinate = of->drives[d].spline == s ? of->drives[d].name : coordinate;
        key = hash_text(hash_word(key, (uint64_t)motion->of), coordinate);
        key = hash_word(hash_word(key, source->follow ? 1 : 0), source->version);
        if (of) {
            key = hash_text(hash_text(key, of->model), of->clip);
            key = hash_number(hash_number(key, of->scale), of->turn);
        }
        if (chain >= 0) {
            const struct chain *along = &document->rigs[chain]->chain;
            key = hash_text(hash_text(hash_text(key, along->model), along->from), along->to);
            key = hash_word(hash_number(key, along->turn), along->mirror);
        }
        key |= 1;

        if (key == baked->key && motion->gain == baked->gain) continue;
        if (!baked->raw) {
            baked->raw = pool_take(&evaluation->storage->pool, (size_t)count, sizeof *baked->raw);
            baked->samples = pool_take(&evaluation->storage->pool, (size_t)count, sizeof *baked->samples);
        }
        if (key != baked->key) {
            bool good = source->follow && source->follow(source->context, document, motion, coordinate, baked->raw);
            for (int i = 0; good && i < count; i++) good = isfinite(baked->raw[i]);
            for (int i = 0; !good && i < count; i++) baked->raw[i] = 0;
        }
        for (int i = 0; i < count; i++) baked->samples[i] = motion->gain * baked->raw[i];
        baked->key = key;
        baked->gain = motion->gain;
        baked->is_new = true;
    }
}

bool evaluation_is_of(const struct evaluation *evaluation, const struct document *document)
{
    return evaluation->storage && evaluation->storage->edits == document->edits;
}

void evaluation_update(struct evaluation *evaluation, const struct document *document, bool cubic)
{
    struct order_cycle cycle;
    evaluation->solved_splines = evaluation->solved_samples = evaluation->solved_knots = 0;
    if (evaluation_is_of(evaluation, document) && evaluation->cubic == cubic &&
        evaluation->storage->version == evaluation->models.version)
        return;
    make_room(evaluation, document);

    struct storage *storage = evaluation->storage;
    struct pinned *pinned = &storage->pinned;
    storage->is_new |= cubic != evaluation->cubic || document->fps != storage->fps ||
                       document->substeps != storage->substeps || document->first_frame != storage->first_frame;
    evaluation->cubic = cubic;
    storage->fps = document->fps;
    storage->substeps = document->substeps;
    storage->first_frame = document->first_frame;
    storage->edits = document->edits;
    storage->version = evaluation->models.version;

    motions_bake(evaluation, document);
    if (!scene_order(document, storage->space, storage->order, &cycle)) return; // never: no document has cycles
    pinned_resize(evaluation, document);
    const bool grouped = pinned_begin(evaluation, document);
    const int *order = grouped ? pinned->order : storage->order;
    for (int i = 0; i < evaluation->count; i++) storage->state[i].solved = false;
    for (int i = 0; i < evaluation->count;) {
        if (!grouped || pinned->which[order[i]] < 0) {
            if (is_due(evaluation, document, order[i])) solve_alone(evaluation, document, order[i], cubic);
            if (grouped) pinned->placed[order[i]] = true;
            i++;
            continue;
        }

        // A group of splines is solved if one of them is out of date.
        wiggly_status status = WIGGLY_OK;
        bool due = false;
        int end = i;
        pinned->group = pinned->which[order[i]];
        pin_groups_find_bases(document, pinned->which, pinned->group, pinned->bases);
        for (int s = 0; s < evaluation->count; s++) {
            due |= pinned->bases[s] && pinned->placed[s] && storage->state[s].solved; // it moves the group
            if (pinned->which[s] != pinned->group) continue;
            end++;
            due |= is_due(evaluation, document, s);
        }
        const bool together = due && pinned_solve(pinned, &status);
        for (; i < end; i++) {
            pinned->placed[order[i]] = true;
            if (together) mark_solved(evaluation, document, order[i], status);
            if (due && !together) solve_alone(evaluation, document, order[i], false);
        }
    }
    storage->is_new = false;

    // The remaining offsets of all pins.
    pinned->left_count = 0;
    for (int r = 0; pinned->solver && evaluation->models.find && r < document->rig_count; r++) {
        for (int i = 0; i < document->rigs[r]->pin_count; i++) {
            const struct pin *pin = &document->rigs[r]->pins[i];
            struct pin_left *left = &pinned->left[pinned->left_count++];
            struct pin_point now;
            *left = (struct pin_left){.is_found = find_point(pinned, r, pin, 0, NULL, &now)};
            if (!left->is_found) continue;
            left->size = now.size;
            for (int k = 0; k < 3; k++) {
                left->at[k] = now.at[k];
                left->way[k] = pin->to[k] - now.at[k];
            }
        }
    }
}

wiggly_method evaluation_method(const struct evaluation *evaluation)
{
    if (evaluation->solver != SOLVER_BY_LENGTH) return evaluation->solver == SOLVER_BAND ? WIGGLY_BAND : WIGGLY_CHAIN;
    return evaluation->samples <= SOLVER_LONGEST_BAND ? WIGGLY_BAND : WIGGLY_CHAIN;
}

const char *evaluation_solver(const struct evaluation *evaluation)
{
    return evaluation_method(evaluation) == WIGGLY_BAND ? "band" : "chain";
}

wiggly_value evaluation_at(const struct evaluation *evaluation, int spline, double position)
{
    bool solved = evaluation && spline >= 0 && spline < evaluation->count && evaluation->samples > 0;
    return solved ? wiggly_evaluate(&evaluation->curves[spline], position) : (wiggly_value){0};
}

int evaluation_extreme(const struct evaluation *evaluation, int spline, int first, int last, bool highest)
{
    const double *total = evaluation->curves[spline].total;
    int best = first;
    for (int i = first + 1; i <= last; i++) {
        if (highest ? total[i] > total[best] : total[i] < total[best]) best = i;
    }
    return best;
}

bool evaluation_sentence(const struct evaluation *evaluation, int spline, char *text)
{
    const wiggly_status status = evaluation->status[spline];
    const double error = evaluation->curves[spline].error;
    const int knot = evaluation->curves[spline].knot;
    if (status == WIGGLY_OK) return false;
    if (status >= WIGGLY_ERROR_ARGUMENT && knot >= 0) {
        const struct spline *of = evaluation->storage->state[spline].held;
        snprintf(text, EVALUATION_SENTENCE, "the knot at frame %.6g: %s", of->knots[knot].frame,
                 wiggly_status_text(status));
    } else if (status != WIGGLY_INEXACT) {
        snprintf(text, EVALUATION_SENTENCE, "%s", wiggly_status_text(status));
    } else if (error > 1) {
        snprintf(text, EVALUATION_SENTENCE, "%s: no digit is certain", wiggly_status_text(status));
    } else {
        snprintf(text, EVALUATION_SENTENCE, "%s: %.1e of the curve's size", wiggly_status_text(status), error);
    }
    return true;
}

double evaluation_slope(const struct evaluation *evaluation, const struct document *document, int spline, int sample)
{
    bool solved =
        evaluation && spline >= 0 && spline < evaluation->count && evaluation->samples > sample && sample >= 0;
    if (!solved) return 0;
    const struct spline *of = document->splines[spline];
    wiggly_desc desc = describe(evaluation, document, spline, evaluation->cubic);
    wiggly_knot last = {0};
    if (of->knot_count > 0) {
        last.sample = document_sample(document, of->knots[of->knot_count - 1].frame);
        desc.knots = &last;
        desc.knot_count = 1;
    }
    const size_t samples = (size_t)evaluation->samples, numbers = CURVE_SLOPE_ROOM * samples;
    const double *const base = base_of(of, &desc);
    double *room = desc.equilibrium.track ? need(numbers + 2 * samples, sizeof *room) : NULL;
    wiggly_curve whole = evaluation->curves[spline];
    if (base) { // as it was solved
        whole.y = room + numbers;
        whole.total = whole.y + samples;
        for (size_t i = 0; i < samples; i++) {
            whole.y[i] = evaluation->curves[spline].y[i] + base[i];
            whole.total[i] = evaluation->curves[spline].total[i] + base[i];
        }
    }
    const double slope = curve_slope(&desc, &whole, sample, room) - (base ? base_speed(base, &desc, sample) : 0);
    free(room);
    return slope;
}
