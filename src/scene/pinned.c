/// Solves groups of splines through their pins.
///
/// A tail or chain bends, so its points move by Σ Re(c x) only near a pose: Gauss-Newton, from the motion without pins on, each round with
/// the pulls at the pose of the last one that came nearer. A soft character needs one round.
#include "scene/pinned.h"
#include "base/hash.h"
#include "scene/pin_groups.h"
#include "scene/pins.h"
#include "scene/rig_key.h"
#include "scene/storage.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_ROUNDS = 8, MOST_MISSES = 2, FIRST_ROOM = 8 };

static const double FIRST_STEP = 0.5; ///< of a rig's size: how far one round may take a point of a tail or chain
static const double STALLED = 1e-4;   ///< change of the distance squared, as a part of it, that ends the rounds
static const double SMALLER = 0.25;   ///< factor of the step after a round that came no nearer

/// Frees what a pointer leads to, and lets it lead nowhere: a failed resize leaves what the end frees again.
#define DROP(pointer) (free(pointer), (pointer) = NULL)

static void free_solver(struct pinned *pinned)
{
    wiggly_group_destroy(pinned->solver);
    DROP(pinned->descs);
    DROP(pinned->curves);
    DROP(pinned->weights);
    DROP(pinned->members);
    DROP(pinned->c);
    DROP(pinned->held);
    DROP(pinned->left);
    for (int i = 0; i < 2; i++) {
        DROP(pinned->round[i].pins);
        DROP(pinned->round[i].pulls);
    }
    pinned->solver = NULL;
    pinned->group = pinned->pins = 0;
}

static void free_splines(struct pinned *pinned)
{
    DROP(pinned->which);
    DROP(pinned->order);
    DROP(pinned->placed);
    DROP(pinned->was);
    DROP(pinned->weight);
    pinned->splines = 0;
}

void pinned_free(struct pinned *pinned)
{
    free_solver(pinned);
    free_splines(pinned);
    floors_free(&pinned->floors);
    free(pinned->knots);
    *pinned = (struct pinned){0};
}

static bool resize_splines(struct pinned *pinned, int splines)
{
    const size_t count = (size_t)splines;
    if (splines <= pinned->splines) return true;
    free_splines(pinned);
    pinned->which = calloc(count, sizeof *pinned->which);
    pinned->order = calloc(count, sizeof *pinned->order);
    pinned->placed = calloc(count, sizeof *pinned->placed);
    pinned->was = calloc(count, sizeof *pinned->was);
    pinned->weight = calloc(count, sizeof *pinned->weight);
    pinned->rigs_key = pinned->pins_key = 0;
    if (!pinned->which || !pinned->order || !pinned->placed || !pinned->was || !pinned->weight) return false;
    pinned->splines = splines;
    return true;
}

/// What a group takes.
struct room {
    int samples, knots, group, pins, bounds;
};

static bool create_solver(struct pinned *pinned, const struct room *room)
{
    const size_t splines = (size_t)room->group, pins = (size_t)room->pins;
    free_solver(pinned);
    pinned->descs = calloc(splines, sizeof *pinned->descs);
    pinned->curves = calloc(splines, sizeof *pinned->curves);
    pinned->weights = calloc(splines, sizeof *pinned->weights);
    pinned->members = calloc(splines, sizeof *pinned->members);
    pinned->c = calloc(splines, sizeof *pinned->c);
    pinned->held = calloc(pins, sizeof *pinned->held);
    pinned->left = calloc(pins, sizeof *pinned->left);
    bool good = pinned->descs && pinned->curves && pinned->weights && pinned->members && pinned->c && pinned->held &&
                pinned->left;
    for (int i = 0; i < 2; i++) {
        pinned->round[i].pins = calloc(pins, sizeof *pinned->round[i].pins);
        pinned->round[i].pulls = calloc(pins * splines, sizeof *pinned->round[i].pulls);
        good &= pinned->round[i].pins && pinned->round[i].pulls;
    }
    good = good && wiggly_group_create_bounded(room->samples, room->knots, room->group, room->pins, room->bounds,
                                               &pinned->solver) == WIGGLY_OK;
    if (!good) {
        free_solver(pinned);
        return false;
    }
    pinned->samples = room->samples;
    pinned->most_knots = room->knots;
    pinned->group = room->group;
    pinned->pins = room->pins;
    pinned->bounds = room->bounds;
    return true;
}

static int doubled(int had, int needed)
{
    int room = had > FIRST_ROOM ? had : FIRST_ROOM;
    while (room < needed) room *= 2;
    return room;
}

static bool resize_solver(struct pinned *pinned, const struct room *needed)
{
    if (pinned->solver && needed->samples <= pinned->samples && needed->knots <= pinned->most_knots &&
        needed->group <= pinned->group && needed->pins <= pinned->pins && needed->bounds <= pinned->bounds)
        return true;
    const struct room room = {
        needed->samples > pinned->samples ? needed->samples : pinned->samples,
        doubled(pinned->most_knots, needed->knots), needed->group > pinned->group ? needed->group : pinned->group,
        doubled(pinned->pins, needed->pins), needed->bounds > pinned->bounds ? needed->bounds : pinned->bounds};
    pinned->rigs_key = pinned->pins_key = 0;
    return create_solver(pinned, &room);
}

static bool resize_knots(struct pinned *pinned, int knots)
{
    if (knots <= pinned->knot_capacity) return true;
    const int room = doubled(pinned->knot_capacity, knots);
    wiggly_knot *more = realloc(pinned->knots, (size_t)room * sizeof *more);
    if (!more) return false;
    pinned->knots = more;
    pinned->knot_capacity = room;
    return true;
}

static int count_members(const struct pinned *pinned, int splines, int which)
{
    int count = 0;
    for (int s = 0; s < splines; s++) count += pinned->which[s] == which;
    return count;
}

bool pinned_resize(struct storage *storage, const struct document *document)
{
    struct pinned *pinned = &storage->pinned;
    struct room room = {.samples = document_samples(document), .pins = pins_count(document)};
    int knots = 0;
    if (!pins_hold_any(document)) return true;
    if (!resize_splines(pinned, document->spline_count)) return false;
    pin_groups_find(document, pinned->which);
    for (int s = 0; s < document->spline_count; s++) {
        const int own = storage_knot_room(&document->splines[s], room.samples);
        const int group = pinned->which[s] == s ? count_members(pinned, document->spline_count, s) : 0;
        knots += document->splines[s].knot_count;
        if (pinned->which[s] >= 0 && own > room.knots) room.knots = own;
        if (group > room.group) room.group = group;
    }
    room.bounds = floors_any(document) ? FLOORS_MOST_BOUNDS : 0;
    return room.group == 0 || (resize_solver(pinned, &room) && resize_knots(pinned, knots) &&
                               floors_resize(&pinned->floors, document, pinned->group));
}

/// Marks what was solved in a group, or is to be.
static void force_all(struct storage *storage, int splines)
{
    const struct pinned *pinned = &storage->pinned;
    for (int s = 0; s < splines; s++) storage->forced[s] |= pinned->was[s] || pinned->which[s] >= 0;
}

/// Weighs the splines that are new in groups, or all of these.
static void weigh(struct evaluation *evaluation, const struct document *document, bool all)
{
    struct pinned *pinned = &evaluation->storage->pinned;
    const struct pin_source *source = &evaluation->pins;
    for (int s = 0; s < evaluation->count; s++) {
        if (pinned->which[s] < 0 || (pinned->was[s] && !all)) continue;
        pinned->weight[s] = 0;
        for (int r = 0; r < document->rig_count; r++)
            source->weigh(source->context, document, r, &s, 1, &pinned->weight[s]);
        if (!(pinned->weight[s] > 0)) pinned->weight[s] = 1; // what moves nothing has no say
    }
}

bool pinned_begin(struct evaluation *evaluation, const struct document *document)
{
    struct storage *storage = evaluation->storage;
    struct pinned *pinned = &storage->pinned;
    struct pin_cycle cycle;
    const int count = evaluation->count, pins = pins_count(document);
    const bool serves =
        pins_hold_any(document) && pinned->pins >= pins && evaluation->pins.find && !evaluation->cubic;
    if (pinned->splines < count || (!serves && pinned->pins_key == 0)) return false;
    for (int s = 0; s < count; s++) pinned->which[s] = -1;
    if (serves) pin_groups_find(document, pinned->which);
    const uint64_t rigs = serves ? hash_word(rigs_key(document), evaluation->pins.version) : 0;
    const uint64_t own = serves ? pins_key(document) : 0;
    const bool moved = rigs != pinned->rigs_key;
    if (moved || own != pinned->pins_key) force_all(storage, count);
    weigh(evaluation, document, moved);
    for (int s = 0; s < count; s++) pinned->was[s] = pinned->which[s] >= 0;
    pinned->rigs_key = rigs;
    pinned->pins_key = own;
    if (!serves || !pin_groups_order(document, pinned->which, storage->order, pinned->placed, pinned->order, &cycle))
        return false;
    for (int s = 0; s < count; s++) pinned->placed[s] = false;
    return true;
}

static void note_moved(int spline, void *context)
{
    struct storage *storage = context;
    if (storage->pinned.placed[spline] && storage->solved[spline]) storage->pinned.base_moved = true;
}

bool pinned_base_moved(struct evaluation *evaluation, const struct document *document, int which)
{
    struct storage *storage = evaluation->storage;
    storage->pinned.base_moved = false;
    pin_groups_visit_bases(document, storage->pinned.which, which, note_moved, storage);
    return storage->pinned.base_moved;
}

/// What comes after the group although it moves its rigs follows it: it counts as still, whatever it was before.
static void still(int spline, void *context)
{
    struct evaluation *evaluation = context;
    const struct pinned *pinned = &evaluation->storage->pinned;
    if (pinned->placed[spline]) return;
    storage_flatten(&evaluation->curves[spline], &pinned->descs[0]);
    evaluation->storage->forced[spline] = true;
}

/// The splines of a group and what is asked of each.
static void find_members(struct evaluation *evaluation, const struct document *document, int which)
{
    struct storage *storage = evaluation->storage;
    struct pinned *pinned = &storage->pinned;
    wiggly_knot *knots = pinned->knots;
    pinned->count = 0;
    for (int s = 0; s < evaluation->count; s++) {
        if (pinned->which[s] != which) continue;
        const int i = pinned->count++;
        pinned->members[i] = s;
        pinned->weights[i] = pinned->weight[s];
        pinned->curves[i] = evaluation->curves[s];
        pinned->descs[i] = storage_describe(storage, evaluation->curves, document, s, false);
        storage_add_knots(&pinned->descs[i], document, s, knots);
        knots += document->splines[s].knot_count;
    }
}

static void find_held(struct pinned *pinned, const struct document *document, int which)
{
    pinned->held_count = 0;
    for (int r = 0; r < document->rig_count; r++) {
        const struct rig *rig = &document->rigs[r];
        const int spline = rig_point_spline(rig);
        const bool is_held = spline >= 0 && pinned->which[spline] == which;
        for (int i = 0; is_held && i < rig->pin_count; i++)
            pinned->held[pinned->held_count++] = (struct held_pin){.rig = r, .pin = i};
    }
}

static const struct pin *pin_of(const struct document *document, const struct held_pin *held)
{
    return &document->rigs[held->rig].pins[held->pin];
}

/// Solves the group with a round's pins, or without any, and shows the curves to whoever finds points.
static wiggly_status solve_round(struct evaluation *evaluation, struct pin_round *round, bool with_pins)
{
    struct pinned *pinned = &evaluation->storage->pinned;
    const wiggly_status status = wiggly_group_solve(pinned->solver, pinned->descs, pinned->weights, pinned->curves,
                                                    pinned->count, round->pins, with_pins ? pinned->held_count : 0);
    for (int i = 0; i < pinned->count; i++) evaluation->curves[pinned->members[i]] = pinned->curves[i];
    return status;
}

/// Re(c x) of all members at a sample.
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

/// Finds the points, and the pulls on them as the splines are now.
static void find_pulls(struct evaluation *evaluation, const struct document *document, struct pin_round *round)
{
    struct pinned *pinned = &evaluation->storage->pinned;
    const struct pin_source *source = &evaluation->pins;
    for (int h = 0; h < pinned->held_count; h++) {
        struct held_pin *held = &pinned->held[h];
        wiggly_pin *pin = &round->pins[h];
        wiggly_pull *pulls = &round->pulls[h * pinned->count];
        *pin = (wiggly_pin){.sample = document_sample(document, pin_of(document, held)->frame), .pulls = pulls};
        held->is_found = source->find(source->context, evaluation, document, held->rig, pin_of(document, held),
                                      pinned->members, pinned->count, pinned->c, &held->from);
        if (!held->is_found) continue;
        pin->pull_count = pinned->count;
        for (int i = 0; i < pinned->count; i++) {
            pulls[i].spline = i;
            memcpy(pulls[i].c, pinned->c[i], sizeof pulls[i].c);
        }
        pass(pinned, pulls, pin->sample, held->passed);
        memcpy(held->at, held->from.at, sizeof held->at);
    }
}

/// Sets how far x is to take each point: to its place, but a tail's or chain's no farther than `step` of its size.
static void aim(const struct pinned *pinned, const struct document *document, const struct pin_round *round,
                double step)
{
    for (int h = 0; h < pinned->held_count; h++) {
        const struct held_pin *held = &pinned->held[h];
        const double *to = pin_of(document, held)->to;
        double way[3], length = 0, factor = 1;
        if (!held->is_found) continue;
        for (int k = 0; k < 3; k++) {
            way[k] = to[k] - held->from.at[k];
            length = hypot(length, way[k]);
        }
        if (!held->from.is_linear && length > step * held->from.size) factor = step * held->from.size / length;
        for (int k = 0; k < 3; k++) round->pins[h].to[k] = held->passed[k] + factor * way[k];
    }
}

/// How far all points are from their places, squared.
static double distance(const struct pinned *pinned, const struct document *document)
{
    double sum = 0;
    for (int h = 0; h < pinned->held_count; h++) {
        const struct held_pin *held = &pinned->held[h];
        const double *to = pin_of(document, held)->to;
        for (int k = 0; held->is_found && k < 3; k++) sum += (to[k] - held->at[k]) * (to[k] - held->at[k]);
    }
    return sum;
}

/// Finds where the points are now; whether each is at its place, or where it was before.
static bool look(struct evaluation *evaluation, const struct document *document)
{
    struct pinned *pinned = &evaluation->storage->pinned;
    const struct pin_source *source = &evaluation->pins;
    bool there = true;
    for (int h = 0; h < pinned->held_count; h++) {
        struct held_pin *held = &pinned->held[h];
        struct pin_point now;
        double missed = 0, moved = 0;
        if (!held->is_found) continue;
        const struct pin *pin = pin_of(document, held);
        source->find(source->context, evaluation, document, held->rig, pin, NULL, 0, NULL, &now);
        for (int k = 0; k < 3; k++) {
            missed = hypot(missed, pin->to[k] - now.at[k]);
            moved = hypot(moved, now.at[k] - held->from.at[k]);
            held->at[k] = now.at[k];
        }
        there &= held->from.is_linear || missed <= now.slack || moved <= now.slack;
    }
    return there;
}

static bool all_linear(const struct pinned *pinned)
{
    bool all = true;
    for (int h = 0; h < pinned->held_count; h++) all &= !pinned->held[h].is_found || pinned->held[h].from.is_linear;
    return all;
}

/// Rounds from the motion without pins on; the curves are those of the round that came nearest, which `solved` receives: NULL for the motion
/// without pins.
static wiggly_status approach(struct evaluation *evaluation, const struct document *document,
                              struct pin_round **solved)
{
    struct pinned *pinned = &evaluation->storage->pinned;
    struct pin_round *best = &pinned->round[0], *next = &pinned->round[1];
    bool is_best = true, has_best = false;
    int misses = 0;
    double step = FIRST_STEP, nearest = distance(pinned, document);
    wiggly_status status = WIGGLY_OK;
    for (int round = 0; round < MOST_ROUNDS && misses < MOST_MISSES && status < WIGGLY_ERROR_ARGUMENT; round++) {
        aim(pinned, document, next, step);
        status = solve_round(evaluation, next, true);
        const bool arrived = look(evaluation, document);
        const double now = distance(pinned, document);
        const bool there = arrived || fabs(now - nearest) <= STALLED * nearest;
        is_best = now <= nearest || there;
        if (is_best) {
            struct pin_round *nearer = next;
            next = best;
            best = nearer;
            has_best = true;
            misses = 0;
            nearest = now;
            if (there) break;
            find_pulls(evaluation, document, next);
        } else {
            step *= SMALLER;
            misses++;
        }
    }
    *solved = has_best ? best : NULL;
    return is_best ? status : solve_round(evaluation, best, has_best);
}

bool pinned_solve(struct evaluation *evaluation, const struct document *document, int which, wiggly_status *status)
{
    struct pinned *pinned = &evaluation->storage->pinned;
    const bool has_floor = floors_concern(pinned, document, which);
    wiggly_group_set_method(pinned->solver, evaluation->storage->method);
    find_members(evaluation, document, which);
    for (int i = 0; has_floor && i < pinned->count; i++) { // as where pins pull: they are passed over, pressed or not
        pinned->descs[i].low = -INFINITY, pinned->descs[i].high = INFINITY;
        pinned->descs[i].steady = 0;
    }
    pin_groups_visit_bases(document, pinned->which, which, still, evaluation);
    find_held(pinned, document, which);
    *status = solve_round(evaluation, &pinned->round[0], false);
    if (*status >= WIGGLY_ERROR_ARGUMENT) return false;
    struct pin_round *solved = &pinned->round[1];
    find_pulls(evaluation, document, solved);
    if (all_linear(pinned)) {
        aim(pinned, document, solved, 0);
        *status = pinned->held_count > 0 ? solve_round(evaluation, solved, true) : *status;
    } else {
        *status = approach(evaluation, document, &solved);
    }
    if (has_floor)
        *status = floors_solve(evaluation, document, which, solved ? solved : &pinned->round[0], solved, *status);
    return *status < WIGGLY_ERROR_ARGUMENT;
}

void pinned_measure(struct evaluation *evaluation, const struct document *document)
{
    struct pinned *pinned = &evaluation->storage->pinned;
    const struct pin_source *source = &evaluation->pins;
    pinned->left_count = 0;
    if (!source->find || pins_count(document) > pinned->pins) return;
    for (int r = 0; r < document->rig_count; r++) {
        for (int i = 0; i < document->rigs[r].pin_count; i++) {
            const struct pin *pin = &document->rigs[r].pins[i];
            struct pin_left *left = &pinned->left[pinned->left_count++];
            struct pin_point now;
            *left = (struct pin_left){
                .is_found = source->find(source->context, evaluation, document, r, pin, NULL, 0, NULL, &now)};
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
    for (int r = 0; r < rig; r++) number += document->rigs[r].pin_count;
    return storage && number < storage->pinned.left_count ? &storage->pinned.left[number] : NULL;
}
