/// Solves groups of splines through their pins.
///
/// A tail or chain bends, so its points move by Σ Re(c x) only near a pose: Gauss-Newton, from the motion without pins on, each round with
/// the pulls at the pose of the last one. No round is taken back, so that the motion is a continuous function of where pins are to be
/// (pin_aim.c). A soft character needs one round.
#include "scene/pinned.h"
#include "base/need.h"
#include "scene/evaluate.h"
#include "scene/pins.h"
#include "scene/storage.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_ROUNDS = 8, FIRST_ROOM = 8 };

static void free_solver(struct pinned *pinned)
{
    wiggly_group_destroy(pinned->solver);
    free(pinned->descs);
    free(pinned->curves);
    free(pinned->weights);
    free(pinned->members);
    free(pinned->c);
    free(pinned->held);
    free(pinned->left);
    free(pinned->round.pins);
    free(pinned->round.pulls);
}

static void free_splines(struct pinned *pinned)
{
    free(pinned->which);
    free(pinned->order);
    free(pinned->placed);
    free(pinned->bases);
    free(pinned->was);
    free(pinned->weight);
}

/// Holds the rigs as they are, so that none that differs has the address of one of them.
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
    free(pinned->rigs);
    free_solver(pinned);
    free_splines(pinned);
    floors_free(&pinned->floors);
    free(pinned->knots);
    *pinned = (struct pinned){0};
}

static void resize_splines(struct pinned *pinned, int splines)
{
    const size_t count = (size_t)splines;
    if (splines <= pinned->splines) return;
    free_splines(pinned);
    pinned->which = need_zeroed(count, sizeof *pinned->which);
    pinned->order = need_zeroed(count, sizeof *pinned->order);
    pinned->placed = need_zeroed(count, sizeof *pinned->placed);
    pinned->bases = need_zeroed(count, sizeof *pinned->bases);
    pinned->was = need_zeroed(count, sizeof *pinned->was);
    pinned->weight = need_zeroed(count, sizeof *pinned->weight);
    pinned->served = false;
    pinned->splines = splines;
}

/// What a group takes.
struct room {
    int samples, knots, group, pins, bounds;
};

static void create_solver(struct pinned *pinned, const struct room *room)
{
    const size_t splines = (size_t)room->group, pins = (size_t)room->pins;
    free_solver(pinned);
    pinned->descs = need_zeroed(splines, sizeof *pinned->descs);
    pinned->curves = need_zeroed(splines, sizeof *pinned->curves);
    pinned->weights = need_zeroed(splines, sizeof *pinned->weights);
    pinned->members = need_zeroed(splines, sizeof *pinned->members);
    pinned->c = need_zeroed(splines, sizeof *pinned->c);
    pinned->held = need_zeroed(pins, sizeof *pinned->held);
    pinned->left = need_zeroed(pins, sizeof *pinned->left);
    pinned->round.pins = need_zeroed(pins, sizeof *pinned->round.pins);
    pinned->round.pulls = need_zeroed(pins * splines, sizeof *pinned->round.pulls);
    if (wiggly_group_create_bounded(room->samples, room->knots, room->group, room->pins, room->bounds,
                                    &pinned->solver) != WIGGLY_OK)
        need_failed();
    pinned->samples = room->samples;
    pinned->most_knots = room->knots;
    pinned->group = room->group;
    pinned->pins = room->pins;
    pinned->bounds = room->bounds;
}

static int doubled(int had, int needed)
{
    int room = had > FIRST_ROOM ? had : FIRST_ROOM;
    while (room < needed) room *= 2;
    return room;
}

static void resize_solver(struct pinned *pinned, const struct room *needed)
{
    if (pinned->solver && needed->samples <= pinned->samples && needed->knots <= pinned->most_knots &&
        needed->group <= pinned->group && needed->pins <= pinned->pins && needed->bounds <= pinned->bounds)
        return;
    const struct room room = {
        needed->samples > pinned->samples ? needed->samples : pinned->samples,
        doubled(pinned->most_knots, needed->knots), needed->group > pinned->group ? needed->group : pinned->group,
        doubled(pinned->pins, needed->pins), needed->bounds > pinned->bounds ? needed->bounds : pinned->bounds};
    pinned->served = false;
    create_solver(pinned, &room);
}

static void resize_knots(struct pinned *pinned, int knots)
{
    if (knots <= pinned->knot_capacity) return;
    pinned->knot_capacity = doubled(pinned->knot_capacity, knots);
    pinned->knots = need_more(pinned->knots, (size_t)pinned->knot_capacity, sizeof *pinned->knots);
}

static void resize_rigs(struct pinned *pinned, int rigs)
{
    if (rigs <= pinned->rig_capacity) return;
    pinned->rigs = need_more(pinned->rigs, (size_t)rigs, sizeof *pinned->rigs);
    pinned->rig_capacity = rigs;
}

static int count_members(const struct pinned *pinned, int splines, int which)
{
    int count = 0;
    for (int s = 0; s < splines; s++) count += pinned->which[s] == which;
    return count;
}

void pinned_resize(struct storage *storage, const struct document *document)
{
    struct pinned *pinned = &storage->pinned;
    struct room room = {.samples = document_samples(document), .pins = pins_count(document)};
    int knots = 0;
    if (!pins_hold_any(document)) return;
    resize_splines(pinned, document->spline_count);
    resize_rigs(pinned, document->rig_count);
    pin_groups_find(document, pinned->which);
    for (int s = 0; s < document->spline_count; s++) {
        const int own = storage_knot_room(document->splines[s], room.samples);
        const int group = pinned->which[s] == s ? count_members(pinned, document->spline_count, s) : 0;
        knots += document->splines[s]->knot_count;
        if (pinned->which[s] >= 0 && own > room.knots) room.knots = own;
        if (group > room.group) room.group = group;
    }
    room.bounds = floors_any(document) ? FLOORS_MOST_BOUNDS : 0;
    if (room.group == 0) return;
    resize_solver(pinned, &room);
    resize_knots(pinned, knots);
    floors_resize(&pinned->floors, document, pinned->group);
}

/// Marks what was solved in a group, or is to be.
static void force_all(struct storage *storage, int splines)
{
    const struct pinned *pinned = &storage->pinned;
    for (int s = 0; s < splines; s++) storage->state[s].forced |= pinned->was[s] || pinned->which[s] >= 0;
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

/// Whether a rig is not the one that was solved; `beside_pins`: in more than its pins.
static bool rigs_differ(const struct pinned *pinned, const struct document *document, bool beside_pins)
{
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
    const int count = evaluation->count, pins = pins_count(document);
    const bool serves =
        pins_hold_any(document) && pinned->pins >= pins && evaluation->pins.find && !evaluation->cubic;
    if (pinned->splines < count || (!serves && !pinned->served)) return false;
    for (int s = 0; s < count; s++) pinned->which[s] = -1;
    if (serves) pin_groups_find(document, pinned->which);
    const bool anew = serves != pinned->served || pinned->version != evaluation->pins.version;
    if (anew || rigs_differ(pinned, document, false)) force_all(storage, count);
    weigh(evaluation, document, anew || rigs_differ(pinned, document, true));
    for (int s = 0; s < count; s++) pinned->was[s] = pinned->which[s] >= 0;
    pinned->served = serves;
    pinned->version = evaluation->pins.version;
    hold_rigs(pinned, document->rigs, serves ? document->rig_count : 0);
    if (!serves || !pin_groups_order(document, pinned->which, storage->order, pinned->placed, pinned->bases,
                                     pinned->order, &cycle))
        return false;
    for (int s = 0; s < count; s++) pinned->placed[s] = false;
    return true;
}

bool pinned_base_moved(struct evaluation *evaluation, const struct document *document, int which)
{
    const struct storage *storage = evaluation->storage;
    const struct pinned *pinned = &storage->pinned;
    pin_groups_find_bases(document, pinned->which, which, pinned->bases);
    for (int s = 0; s < evaluation->count; s++) {
        if (pinned->bases[s] && pinned->placed[s] && storage->state[s].solved) return true;
    }
    return false;
}

/// What comes after the group although it moves its rigs follows it: it counts as still, whatever it was before.
static void still_bases(struct evaluation *evaluation)
{
    const struct pinned *pinned = &evaluation->storage->pinned;
    for (int s = 0; s < evaluation->count; s++) {
        if (!pinned->bases[s] || pinned->placed[s]) continue;
        storage_flatten(&evaluation->curves[s], &pinned->descs[0]);
        evaluation->storage->state[s].forced = true;
    }
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
        knots += document->splines[s]->knot_count;
    }
}

static void find_held(struct pinned *pinned, const struct document *document, int which)
{
    pinned->held_count = 0;
    for (int r = 0; r < document->rig_count; r++) {
        const struct rig *rig = document->rigs[r];
        const int spline = rig_point_spline(rig);
        const bool is_held = spline >= 0 && pinned->which[spline] == which;
        for (int i = 0; is_held && i < rig->pin_count; i++)
            pinned->held[pinned->held_count++] = (struct held_pin){.rig = r, .pin = i};
    }
}

static const struct pin *pin_of(const struct document *document, const struct held_pin *held)
{
    return &document->rigs[held->rig]->pins[held->pin];
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

/// Finds the points, and the pulls on them as the splines are now, first without pins.
static void find_pulls(struct evaluation *evaluation, const struct document *document, struct pin_round *round,
                       bool is_first)
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
        if (is_first) held->ease = pin_ease(pin);
    }
}

/// Sets how far x is to take each point.
static void aim(const struct pinned *pinned, const struct document *document, const struct pin_round *round)
{
    for (int h = 0; h < pinned->held_count; h++) {
        const struct held_pin *held = &pinned->held[h];
        wiggly_pull *pulls = &round->pulls[h * pinned->count];
        if (held->is_found)
            pin_aim(&held->from, held->ease, pin_of(document, held)->to, held->passed, &round->pins[h], pulls);
    }
}

static double distance(const double a[3], const double b[3])
{
    return hypot(hypot(a[0] - b[0], a[1] - b[1]), a[2] - b[2]);
}

/// Whether each point is at its place, or where it was before.
static bool look(struct evaluation *evaluation, const struct document *document)
{
    struct pinned *pinned = &evaluation->storage->pinned;
    const struct pin_source *source = &evaluation->pins;
    bool there = true;
    for (int h = 0; h < pinned->held_count; h++) {
        const struct held_pin *held = &pinned->held[h];
        struct pin_point now;
        if (!held->is_found) continue;
        const struct pin *pin = pin_of(document, held);
        source->find(source->context, evaluation, document, held->rig, pin, NULL, 0, NULL, &now);
        there &= held->from.is_linear || distance(pin->to, now.at) <= now.slack ||
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

/// Rounds from the motion without pins on, which has been solved.
static wiggly_status approach(struct evaluation *evaluation, const struct document *document, struct pin_round *round)
{
    const struct pinned *pinned = &evaluation->storage->pinned;
    wiggly_status status = WIGGLY_OK;
    const int most = all_linear(pinned) ? 1 : MOST_ROUNDS;
    for (int n = 0; n < most; n++) {
        aim(pinned, document, round);
        status = solve_round(evaluation, round, true);
        if (status >= WIGGLY_ERROR_ARGUMENT || n + 1 == most || look(evaluation, document)) break;
        find_pulls(evaluation, document, round, false);
    }
    return status;
}

/// Solves the group once more, above its floors.
static wiggly_status lift(struct evaluation *evaluation, const struct document *document, int which,
                          wiggly_status status)
{
    struct pinned *pinned = &evaluation->storage->pinned;
    const struct floor_group group = {.solver = pinned->solver,
                                      .source = &evaluation->pins,
                                      .evaluation = evaluation,
                                      .shown = evaluation->curves,
                                      .samples = evaluation->samples,
                                      .which = pinned->which,
                                      .group = which,
                                      .members = pinned->members,
                                      .count = pinned->count,
                                      .descs = pinned->descs,
                                      .weights = pinned->weights,
                                      .curves = pinned->curves,
                                      .c = pinned->c,
                                      .pins = pinned->round.pins,
                                      .pin_count = pinned->held_count};
    return floors_solve(&pinned->floors, &group, document, status);
}

bool pinned_solve(struct evaluation *evaluation, const struct document *document, int which, wiggly_status *status)
{
    struct pinned *pinned = &evaluation->storage->pinned;
    const bool has_floor = floors_concern(pinned->which, document, which);
    wiggly_group_set_method(pinned->solver, evaluation->solver == SOLVER_BAND ? WIGGLY_BAND : WIGGLY_CHAIN);
    find_members(evaluation, document, which);
    for (int i = 0; has_floor && i < pinned->count; i++) { // as where pins pull: they are passed over, pressed or not
        pinned->descs[i].low = -INFINITY, pinned->descs[i].high = INFINITY;
    }
    still_bases(evaluation);
    find_held(pinned, document, which);
    *status = solve_round(evaluation, &pinned->round, false);
    if (*status >= WIGGLY_ERROR_ARGUMENT) return false;
    find_pulls(evaluation, document, &pinned->round, true);
    if (pinned->held_count > 0) *status = approach(evaluation, document, &pinned->round);
    if (has_floor) *status = lift(evaluation, document, which, *status);
    return *status < WIGGLY_ERROR_ARGUMENT;
}

void pinned_measure(struct evaluation *evaluation, const struct document *document)
{
    struct pinned *pinned = &evaluation->storage->pinned;
    const struct pin_source *source = &evaluation->pins;
    pinned->left_count = 0;
    if (!source->find || pins_count(document) > pinned->pins) return;
    for (int r = 0; r < document->rig_count; r++) {
        for (int i = 0; i < document->rigs[r]->pin_count; i++) {
            const struct pin *pin = &document->rigs[r]->pins[i];
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
    for (int r = 0; r < rig; r++) number += document->rigs[r]->pin_count;
    return storage && number < storage->pinned.left_count ? &storage->pinned.left[number] : NULL;
}

const struct floor_left *evaluation_floor(const struct evaluation *evaluation, int rig)
{
    const struct storage *storage = evaluation->storage;
    return storage && storage->pinned.floors.bounds && rig < storage->pinned.floors.rigs
               ? &storage->pinned.floors.left[rig]
               : NULL;
}
