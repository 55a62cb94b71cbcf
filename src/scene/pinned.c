/// Solves groups of splines through their pins.
///
/// A point of a tail or chain moves by Σ Re(c x) only near one pose. So this is a Gauss-Newton method: it starts from the motion without
/// pins, and each round uses the pulls at the pose of the last one. No round is undone, so that the motion depends continuously on the
/// pins' places (pin_aim()). A soft character needs one round.
#include "base/need.h"
#include "maths/maths.h"
#include "scene/pins.h"
#include "scene/storage.h"
#include <math.h>
#include <string.h>

enum { MOST_ROUNDS = 8, FIRST_ROOM = 8 };

/// Keeps references to the rigs, so that a changed rig never has the address of an old one.
static void hold_rigs(struct pinned *pinned, struct rig *const *rigs, int count)
{
    for (int r = 0; r < count; r++) rig_hold(rigs[r]);
    for (int r = 0; r < pinned->rig_count; r++) rig_drop(pinned->rigs[r]);
    if (count > 0) memcpy(pinned->rigs, rigs, (size_t)count * sizeof *rigs);
    pinned->rig_count = count;
}

void pinned_free(struct pinned *pinned)
{
    hold_rigs(pinned, NULL, 0);
    wiggly_group_destroy(pinned->solver);
    pool_free(&pinned->pool);
    *pinned = (struct pinned){0};
}

static void create(struct pinned *pinned, int splines, int samples)
{
    struct pool *pool = &pinned->pool;
    const struct pinned_room *room = &pinned->room;
    const size_t count = (size_t)splines, group = (size_t)room->group, pins = (size_t)room->pins;
    pinned->rigs = pool_take(pool, (size_t)room->rigs, sizeof *pinned->rigs);
    pinned->left = pool_take(pool, pins, sizeof *pinned->left);
    pinned->which = pool_take(pool, count, sizeof *pinned->which);
    pinned->order = pool_take(pool, count, sizeof *pinned->order);
    pinned->placed = pool_take(pool, count, sizeof *pinned->placed);
    pinned->was = pool_take(pool, count, sizeof *pinned->was);
    pinned->bases = pool_take(pool, count, sizeof *pinned->bases);
    pinned->weight = pool_take(pool, count, sizeof *pinned->weight);
    pinned->members = pool_take(pool, group, sizeof *pinned->members);
    pinned->descs = pool_take(pool, group, sizeof *pinned->descs);
    pinned->curves = pool_take(pool, group, sizeof *pinned->curves);
    pinned->weights = pool_take(pool, group, sizeof *pinned->weights);
    pinned->knots = pool_take(pool, (size_t)room->all_knots, sizeof *pinned->knots);
    pinned->c = pool_take(pool, group, sizeof *pinned->c);
    pinned->held = pool_take(pool, pins, sizeof *pinned->held);
    pinned->pins = pool_take(pool, pins, sizeof *pinned->pins);
    pinned->pulls = pool_take(pool, pins * group, sizeof *pinned->pulls);
    if (room->bounds > 0) floors_resize(pinned, samples);
    if (room->group > 0 && wiggly_group_create_bounded(samples, room->knots, room->group, room->pins, room->bounds,
                                                       &pinned->solver) != WIGGLY_OK)
        need_failed();
}

/// Writes each spline's group to `which`. Returns the size of the largest group.
static int find_groups(const struct document *document, int *which)
{
    int largest = 0;
    pin_groups_find(document, which);
    for (int s = 0; s < document->spline_count; s++) {
        int count = 0;
        for (int i = s; which[s] == s && i < document->spline_count; i++) count += which[i] == s;
        if (count > largest) largest = count;
    }
    return largest;
}

static void grow(int *room, int needed)
{
    if (*room < FIRST_ROOM) *room = FIRST_ROOM;
    while (*room < needed) *room *= 2;
}

void pinned_resize(struct evaluation *evaluation, const struct document *document)
{
    struct storage *storage = evaluation->storage;
    struct pinned *pinned = &storage->pinned;
    struct pinned_room room = pinned->room;
    int knots = 0, *which = storage->space.stack;
    if (!pins_hold_any(document)) return;
    const int largest = find_groups(document, which);
    if (largest > room.group) room.group = largest;
    for (int s = 0; s < document->spline_count; s++) {
        knots += document->splines[s]->knot_count;
        if (which[s] >= 0) grow(&room.knots, storage_knot_room(document->splines[s], evaluation->samples));
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
    create(pinned, evaluation->count, evaluation->samples);
}

/// Computes the weights of splines that are new in a group, or of all.
static void weigh(struct pinned *pinned, bool all)
{
    const struct document *document = pinned->document;
    const struct model_source *source = &pinned->evaluation->models;
    for (int s = 0; s < pinned->evaluation->count; s++) {
        if (pinned->which[s] < 0 || (pinned->was[s] && !all)) continue;
        pinned->weight[s] = 0;
        for (int r = 0; r < document->rig_count; r++)
            source->weigh(source->context, document, r, &s, 1, &pinned->weight[s]);
        if (!(pinned->weight[s] > 0)) pinned->weight[s] = 1; // splines that move nothing
    }
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

bool pinned_begin(struct evaluation *evaluation, const struct document *document)
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
    weigh(pinned, anew || rigs_differ(pinned, true));
    for (int s = 0; s < count; s++) pinned->was[s] = pinned->which[s] >= 0;
    pinned->served = serves;
    pinned->version = evaluation->models.version;
    hold_rigs(pinned, document->rigs, serves ? document->rig_count : 0);
    if (!serves || !pin_groups_order(document, pinned->which, storage->order, pinned->placed, pinned->bases,
                                     pinned->order, &cycle))
        return false;
    for (int s = 0; s < count; s++) pinned->placed[s] = false;
    return true;
}

bool pinned_take(struct pinned *pinned, int which)
{
    const struct evaluation *evaluation = pinned->evaluation;
    bool moved = false;
    pinned->group = which;
    pin_groups_find_bases(pinned->document, pinned->which, which, pinned->bases);
    for (int s = 0; s < evaluation->count; s++)
        moved |= pinned->bases[s] && pinned->placed[s] && evaluation->storage->state[s].solved;
    return moved;
}

/// Splines that come after the group but move its rigs are taken as still, so the result does not depend on their last state.
static void still_bases(const struct pinned *pinned)
{
    for (int s = 0; s < pinned->evaluation->count; s++) {
        if (!pinned->bases[s] || pinned->placed[s]) continue;
        storage_flatten(&pinned->evaluation->curves[s], &pinned->descs[0]);
        pinned->evaluation->storage->state[s].forced = true;
    }
}

static void find_members(struct pinned *pinned)
{
    const struct evaluation *evaluation = pinned->evaluation;
    wiggly_knot *knots = pinned->knots;
    pinned->count = 0;
    for (int s = 0; s < evaluation->count; s++) {
        if (pinned->which[s] != pinned->group) continue;
        const int i = pinned->count++;
        pinned->members[i] = s;
        pinned->weights[i] = pinned->weight[s];
        pinned->curves[i] = evaluation->curves[s];
        pinned->descs[i] = storage_describe(evaluation, pinned->document, s, false);
        storage_add_knots(&pinned->descs[i], pinned->document, s, knots);
        knots += pinned->descs[i].knot_count;
    }
}

static void find_held(struct pinned *pinned)
{
    pinned->held_count = 0;
    for (int r = 0; r < pinned->document->rig_count; r++) {
        const struct rig *rig = pinned->document->rigs[r];
        const int spline = rig_point_spline(rig);
        const bool is_held = spline >= 0 && pinned->which[spline] == pinned->group;
        for (int i = 0; is_held && i < rig->pin_count; i++)
            pinned->held[pinned->held_count++] = (struct held_pin){.rig = r, .pin = &rig->pins[i]};
    }
}

/// Finds a pin's point on the present curves and, unless `c` is NULL, the members' pulls on it.
static bool find_point(const struct pinned *pinned, int rig, const struct pin *pin, pin_pull *c,
                       struct pin_point *point)
{
    const struct model_source *source = &pinned->evaluation->models;
    return source->find(source->context, pinned->evaluation, pinned->document, rig, pin, pinned->members,
                        c ? pinned->count : 0, c, point);
}

/// Solves the group with or without its pins, and publishes the curves for finding points.
static wiggly_status solve_round(struct pinned *pinned, bool with_pins)
{
    const wiggly_status status = wiggly_group_solve(pinned->solver, pinned->descs, pinned->weights, pinned->curves,
                                                    pinned->count, pinned->pins, with_pins ? pinned->held_count : 0);
    for (int i = 0; i < pinned->count; i++) pinned->evaluation->curves[pinned->members[i]] = pinned->curves[i];
    return status;
}

static const double STEP = 0.5;     ///< largest step, as a share of the reach
static const double DAMPING = 4;    ///< less lets drags far out of reach jump (tests/test_pins_drag.c)
static const double FIRMNESS = 0.3; ///< with less, they curl tails up; with more, less of what can be reached is

static double dot(const double a[3], const double b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// How easily splines move a point: |c| over all of a pin's pulls.
static double pin_ease(const wiggly_pin *pin)
{
    double sum = 0;
    for (int i = 0; i < pin->pull_count; i++) {
        for (int k = 0; k < 3; k++) {
            const double *c = pin->pulls[i].c[k];
            sum += c[0] * c[0] + c[1] * c[1];
        }
    }
    return sqrt(sum);
}

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

/// The way to a place, or to the nearest place the point can reach from its base. Returns its length.
static double find_way(const struct pin_point *from, const double to[3], double way[3])
{
    double out[3];
    for (int k = 0; k < 3; k++) out[k] = to[k] - from->base[k];
    const double far = sqrt(dot(out, out));
    for (int k = 0; k < 3; k++)
        way[k] = (far > from->reach ? from->base[k] + out[k] * (from->reach / far) : to[k]) - from->at[k];
    return sqrt(dot(way, way));
}

/// Shortens an offset that would need a large x.
static void damp(const wiggly_pull *pulls, int count, double damping, double way[3])
{
    double l[3][3], left[3] = {way[0], way[1], way[2]};
    if (!(damping > 0)) return;
    factor(pulls, count, damping, l);
    forward(l, left);
    backward(l, left);
    for (int k = 0; k < 3; k++) way[k] -= damping * left[k];
}

static void weigh_pulls(wiggly_pin *pin, wiggly_pull *pulls, double least)
{
    double l[3][3];
    factor(pulls, pin->pull_count, least, l);
    forward(l, pin->to);
    for (int i = 0; i < pin->pull_count; i++) {
        for (int part = 0; part < 2; part++) {
            double c[3] = {pulls[i].c[0][part], pulls[i].c[1][part], pulls[i].c[2][part]};
            forward(l, c);
            for (int k = 0; k < 3; k++) pulls[i].c[k][part] = c[k];
        }
    }
}

/// Sets the target of x for a point that is at `from`, where Σ Re(c x) is `passed`; `ease` is pin_ease() without pins. A tail or chain is
/// moved only part of the way if it is far or hard to move. Its conditions (also `pulls`, the pin's) are weighted so that splines that
/// barely move it, measured without pins, give way. Everything is continuous in `to` and `from`.
///
/// With C = Σ c cᵀ of the pulls at a round's pose, r the point's reach from its base, and v its way, first cut to r/2:
///
///     v ← C (C + 4 |c⁰|² (|v|/r)^{3/2})⁻¹ v             a far way takes no step that would curl the rig up; a near one is taken whole
///     rows ← L⁻¹ rows,  L Lᵀ = C + 0.3 |c⁰|²             a curled rig does not count as easily moved in all directions alike
///
/// where |c⁰| is from the motion without pins. The place itself is moved to within r of the base.
static void pin_aim(const struct pin_point *from, double ease, const double to[3], const double passed[3],
                    wiggly_pin *pin, wiggly_pull *pulls)
{
    const bool is_bent = !from->is_linear && ease > 0 && from->reach > 0;
    double way[3] = {to[0] - from->at[0], to[1] - from->at[1], to[2] - from->at[2]};
    if (is_bent) {
        const double far = find_way(from, to, way), part = fmin(1, STEP * from->reach / far);
        const double share = part * far / from->reach;
        for (int k = 0; k < 3; k++) way[k] *= part;
        damp(pulls, pin->pull_count, DAMPING * ease * ease * share * sqrt(share), way);
    }
    for (int k = 0; k < 3; k++) pin->to[k] = passed[k] + way[k];
    if (is_bent) weigh_pulls(pin, pulls, FIRMNESS * ease * ease);
}

/// Σ Re(c x) of all members at a sample.
static void pass(const struct pinned *pinned, const wiggly_pull *pulls, int sample, double passed[3])
{
    for (int k = 0; k < 3; k++) {
        passed[k] = 0;
        for (int i = 0; i < pinned->count; i++) {
            const wiggly_curve *curve = &pinned->curves[i];
            passed[k] += pulls[i].c[k][0] * curve->re[sample] - pulls[i].c[k][1] * curve->im[sample];
        }
    }
}

/// Finds the points, and the present pulls on them; the first time without pins.
static void find_pulls(struct pinned *pinned, bool is_first)
{
    for (int h = 0; h < pinned->held_count; h++) {
        struct held_pin *held = &pinned->held[h];
        wiggly_pin *pin = &pinned->pins[h];
        wiggly_pull *pulls = &pinned->pulls[h * pinned->count];
        *pin = (wiggly_pin){.sample = document_sample(pinned->document, held->pin->frame), .pulls = pulls};
        held->is_found = find_point(pinned, held->rig, held->pin, pinned->c, &held->from);
        if (!held->is_found) continue;
        pin->pull_count = pinned->count;
        for (int i = 0; i < pinned->count; i++) {
            pulls[i].spline = i;
            memcpy(pulls[i].c, pinned->c[i], sizeof pulls[i].c);
        }
        pass(pinned, pulls, pin->sample, held->passed);
        if (is_first) held->ease = pin_ease(pin);
    }
}

/// Sets the target of x for each point.
static void aim(const struct pinned *pinned)
{
    for (int h = 0; h < pinned->held_count; h++) {
        const struct held_pin *held = &pinned->held[h];
        wiggly_pull *pulls = &pinned->pulls[h * pinned->count];
        if (held->is_found) pin_aim(&held->from, held->ease, held->pin->to, held->passed, &pinned->pins[h], pulls);
    }
}

static double distance(const double a[3], const double b[3])
{
    return maths_hypot(maths_hypot(a[0] - b[0], a[1] - b[1]), a[2] - b[2]);
}

/// Whether each point is at its place, or no longer moves.
static bool look(const struct pinned *pinned)
{
    bool there = true;
    for (int h = 0; h < pinned->held_count; h++) {
        const struct held_pin *held = &pinned->held[h];
        struct pin_point now;
        if (!held->is_found) continue;
        find_point(pinned, held->rig, held->pin, NULL, &now);
        there &= held->from.is_linear || distance(held->pin->to, now.at) <= now.slack ||
                 distance(now.at, held->from.at) <= now.slack;
    }
    return there;
}

static bool all_linear(const struct pinned *pinned)
{
    bool all = true;
    for (int h = 0; h < pinned->held_count; h++) all &= !pinned->held[h].is_found || pinned->held[h].from.is_linear;
    return all;
}

/// Does rounds, starting from the solved motion without pins.
static wiggly_status approach(struct pinned *pinned)
{
    wiggly_status status = WIGGLY_OK;
    const int most = all_linear(pinned) ? 1 : MOST_ROUNDS;
    for (int n = 0; n < most; n++) {
        aim(pinned);
        status = solve_round(pinned, true);
        if (status >= WIGGLY_ERROR_ARGUMENT || n + 1 == most || look(pinned)) break;
        find_pulls(pinned, false);
    }
    return status;
}

bool pinned_solve(struct pinned *pinned, wiggly_status *status)
{
    const bool has_floor = floors_concern(pinned);
    wiggly_group_set_method(pinned->solver, pinned->evaluation->solver == SOLVER_BAND ? WIGGLY_BAND : WIGGLY_CHAIN);
    find_members(pinned);
    for (int i = 0; has_floor && i < pinned->count; i++) { // as where pins pull: they are passed over, pressed or not
        pinned->descs[i].has_low = pinned->descs[i].has_high = false;
    }
    still_bases(pinned);
    find_held(pinned);
    *status = solve_round(pinned, false);
    if (*status >= WIGGLY_ERROR_ARGUMENT) return false;
    find_pulls(pinned, true);
    if (pinned->held_count > 0) *status = approach(pinned);
    if (has_floor) *status = floors_solve(pinned, *status);
    return *status < WIGGLY_ERROR_ARGUMENT;
}

void pinned_measure(struct pinned *pinned)
{
    const struct document *document = pinned->document;
    pinned->left_count = 0;
    if (!pinned->solver || !pinned->evaluation->models.find) return;
    for (int r = 0; r < document->rig_count; r++) {
        for (int i = 0; i < document->rigs[r]->pin_count; i++) {
            const struct pin *pin = &document->rigs[r]->pins[i];
            struct pin_left *left = &pinned->left[pinned->left_count++];
            struct pin_point now;
            *left = (struct pin_left){.is_found = find_point(pinned, r, pin, NULL, &now)};
            if (!left->is_found) continue;
            left->size = now.size;
            for (int k = 0; k < 3; k++) {
                left->at[k] = now.at[k];
                left->way[k] = pin->to[k] - now.at[k];
            }
        }
    }
}

const struct pin_left *evaluation_pin(const struct evaluation *evaluation, const struct document *document, int rig,
                                      int pin)
{
    const struct storage *storage = evaluation->storage;
    int number = pin;
    for (int r = 0; r < rig; r++) number += document->rigs[r]->pin_count;
    return storage && number < storage->pinned.left_count ? &storage->pinned.left[number] : NULL;
}
