/// Keeps the lowest points of characters above their floors.
///
/// Cutting planes: the lowest vertex of every dip below the floor becomes a bound, and the group is solved again with all bounds so
/// far, until no vertex is deeper than the tolerance. Each solve is convex, and its result depends on the bounds alone.
///
/// Knots and pins have priority. Where they hold a character below its floor, the floor sinks to that depth and rises again over a
/// quarter of a period; otherwise the curve would jump up to it within a sample.
#include "scene/storage.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_ROUNDS = 24 };

static const double DEEP = 1e-5; ///< depth below a floor that is tolerated, as a share of the character's size
static const double HELD =
    0.04; ///< reach below which knots and pins leave a point no way (docs/mathematics.md, Pins, Reach)
static const double RISE = 0.25; ///< periods

void floors_resize(struct pinned *pinned, int samples)
{
    struct floors *floors = &pinned->floors;
    struct pool *pool = &pinned->pool;
    const size_t n = (size_t)samples, bounds = (size_t)pinned->room.bounds, rigs = (size_t)pinned->room.rigs;
    floors->bounds = pool_take(pool, bounds, sizeof *floors->bounds);
    floors->rig = pool_take(pool, bounds, sizeof *floors->rig);
    floors->vertex = pool_take(pool, bounds, sizeof *floors->vertex);
    floors->c = pool_take(pool, bounds * (size_t)pinned->room.group, sizeof *floors->c);
    floors->low = pool_take(pool, n, sizeof *floors->low);
    floors->room = pool_take(pool, LOW_POINT_ROOM * (size_t)low_point_samples(samples), sizeof *floors->room);
    floors->sunk = pool_take(pool, n * rigs, sizeof *floors->sunk);
    floors->left = pool_take(pool, rigs, sizeof *floors->left);
}

/// Whether a rig of the current group has a floor.
static bool concerns(const struct pinned *pinned, int index)
{
    const struct rig *rig = pinned->document->rigs[index];
    return rig_has_floor(rig) && rig_input_count(rig) > 0 && pinned->which[rig_input(rig, 0)] == pinned->group;
}

bool floors_concern(const struct pinned *pinned)
{
    bool any = false;
    for (int r = 0; r < pinned->document->rig_count; r++) any |= concerns(pinned, r);
    return any;
}

static double floor_of(const struct pinned *pinned, int rig) { return pinned->document->rigs[rig]->character.floor; }

/// How far a rig's floor has sunk at each sample.
static double *sunk_of(const struct pinned *pinned, int rig)
{
    return pinned->floors.sunk + rig * pinned->evaluation->samples;
}

/// The current floor's height at a sample.
static double level(const struct pinned *pinned, int rig, int sample)
{
    return floor_of(pinned, rig) - sunk_of(pinned, rig)[sample];
}

static double depth(const struct pinned *pinned, int rig, int sample)
{
    return level(pinned, rig, sample) - pinned->floors.low[sample].height;
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
    const struct model_source *source = &pinned->evaluation->models;
    struct floors *floors = &pinned->floors;
    wiggly_bound *bound = &floors->bounds[b];
    double(*c)[2] = floors->c + b * pinned->count;
    const struct pin pin = {.frame = document_frame(pinned->document, sample), .point = floors->low[sample].vertex};
    struct pin_point point = {.size = 1};
    source->find(source->context, pinned->evaluation, pinned->document, rig, &pin, pinned->members, pinned->count,
                 pinned->c, &point);
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

/// Samples of a quarter of a period of the slowest member.
static double samples_to_rise(const struct pinned *pinned, int sample)
{
    double slowest = INFINITY;
    for (int i = 0; i < pinned->count; i++) {
        const wiggly_desc *desc = &pinned->descs[i];
        const double frequency = desc->frequency.track ? desc->frequency.track[sample] : desc->frequency.value;
        if (frequency > 0) slowest = fmin(slowest, frequency);
    }
    return RISE / (slowest * pinned->descs[0].step);
}

/// Lowers the floor around a sample.
static void sink(double *sunk, int samples, int at, double by, double rise)
{
    for (int i = 0; i < samples; i++) {
        const double left = 1 - abs(i - at) / (rise + 1);
        if (left > 0) sunk[i] = fmax(sunk[i], by * left * left);
    }
}

static bool is_held(const struct pinned *pinned, int sample)
{
    for (int i = 0; i < pinned->count; i++) {
        for (int k = 0; k < pinned->descs[i].knot_count; k++) {
            if (pinned->descs[i].knots[k].sample == sample) return true;
        }
    }
    for (int h = 0; h < pinned->held_count; h++) {
        if (pinned->pins[h].sample == sample) return true;
    }
    return false;
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
        if (!(by > 0) || !is_held(pinned, i)) continue;
        put_bound(pinned, 0, rig, i, 0);
        const double held = 1 - wiggly_group_reach(pinned->solver, &pinned->floors.bounds[0]) / HELD;
        if (held > 0) sink(sunk, samples, i, by * held, samples_to_rise(pinned, i));
    }
}

/// Whether the bound after the last is already among those before.
static bool is_bound(const struct floors *floors)
{
    const int last = floors->count;
    for (int b = 0; b < last; b++) {
        if (floors->rig[b] == floors->rig[last] && floors->bounds[b].sample == floors->bounds[last].sample &&
            floors->vertex[b] == floors->vertex[last])
            return true;
    }
    return false;
}

/// Adds a bound for the deepest vertex of every dip. Returns whether there was any.
static bool add_bounds(struct pinned *pinned, int rig)
{
    const int samples = pinned->evaluation->samples;
    struct floors *floors = &pinned->floors;
    bool any = false;
    if (!find_low(pinned, rig)) return false;
    for (int i = 0; i < samples && floors->count < FLOORS_MOST_BOUNDS; i++) {
        const double deep = depth(pinned, rig, i);
        if (!(deep > 0) || (i > 0 && depth(pinned, rig, i - 1) > deep)) continue;
        if (i + 1 < samples && depth(pinned, rig, i + 1) >= deep) continue;
        const double size = put_bound(pinned, floors->count, rig, i, level(pinned, rig, i));
        if (!(deep > DEEP * size) || is_bound(floors)) continue;
        floors->count++;
        any = true;
    }
    return any;
}

/// Measures how far the rig is below its floor in the end.
static void measure(struct pinned *pinned, int rig)
{
    struct floor_left *left = &pinned->floors.left[rig];
    *left = (struct floor_left){.sample = -1};
    for (int i = 0; i < pinned->evaluation->samples; i++) {
        const double by = floor_of(pinned, rig) - pinned->floors.low[i].height;
        if (by > left->depth) *left = (struct floor_left){by, i};
    }
}

wiggly_status floors_solve(struct pinned *pinned, wiggly_status status)
{
    struct floors *floors = &pinned->floors;
    const int rigs = pinned->document->rig_count;
    floors->count = 0;
    floors->in_hand = -1;
    for (int r = 0; r < rigs; r++) {
        if (concerns(pinned, r)) find_sunk(pinned, r);
    }
    for (int n = 0; n < MOST_ROUNDS && status < WIGGLY_ERROR_ARGUMENT; n++) {
        bool any = false;
        for (int r = 0; r < rigs; r++) {
            if (!concerns(pinned, r)) continue;
            any |= add_bounds(pinned, r);
            measure(pinned, r);
        }
        if (!any) break;
        status =
            wiggly_group_solve_bounded(pinned->solver, pinned->descs, pinned->weights, pinned->curves, pinned->count,
                                       pinned->pins, pinned->held_count, floors->bounds, floors->count);
        for (int i = 0; i < pinned->count; i++) pinned->evaluation->curves[pinned->members[i]] = pinned->curves[i];
        floors->in_hand = -1;
    }
    return status;
}

const struct floor_left *evaluation_floor(const struct evaluation *evaluation, int rig)
{
    const struct storage *storage = evaluation->storage;
    return storage && storage->pinned.floors.left && rig < storage->pinned.room.rigs
               ? &storage->pinned.floors.left[rig]
               : NULL;
}
