/// Keeps the lowest points of characters above their floors.
///
/// Cutting planes: the lowest vertex of every dip below the floor becomes a bound, the group is solved with all bounds so far, and again
/// until no vertex is deeper than the tolerance. Each solve is convex, and its answer a function of the bounds alone.
///
/// Knots and pins come first. Where they hold a character below its floor, the floor sinks as deep there, and rises again over a quarter
/// of a period: otherwise the curve would have to jump up to it in one sample.
#include "scene/floors.h"
#include "scene/storage.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_ROUNDS = 24 };

static const double DEEP = 1e-5; ///< of a character's size: how far below a floor does not count
static const double HELD =
    0.04; ///< reach below which knots and pins leave a point no way (docs/mathematics.md, Pins, Reach)
static const double RISE = 0.25; ///< periods

void floors_free(struct floors *floors)
{
    free(floors->bounds);
    free(floors->rig);
    free(floors->vertex);
    free(floors->c);
    free(floors->low);
    free(floors->room);
    free(floors->sunk);
    free(floors->left);
    *floors = (struct floors){0};
}

static bool has_floor(const struct rig *rig) { return rig->kind == RIG_CHARACTER && rig->character.has_floor; }

bool floors_any(const struct document *document)
{
    for (int r = 0; r < document->rig_count; r++) {
        if (has_floor(&document->rigs[r])) return true;
    }
    return false;
}

bool floors_resize(struct floors *floors, const struct document *document, int group)
{
    const int samples = document_samples(document), rigs = document->rig_count;
    if (!floors_any(document)) return true;
    if (floors->bounds && samples <= floors->samples && group <= floors->splines && rigs <= floors->rigs) return true;
    floors_free(floors);
    const size_t n = (size_t)samples, bounds = FLOORS_MOST_BOUNDS;
    floors->bounds = calloc(bounds, sizeof *floors->bounds);
    floors->rig = calloc(bounds, sizeof *floors->rig);
    floors->vertex = calloc(bounds, sizeof *floors->vertex);
    floors->c = calloc(bounds * (size_t)group, sizeof *floors->c);
    floors->low = calloc(n, sizeof *floors->low);
    floors->room = calloc(LOW_POINT_ROOM * n, sizeof *floors->room);
    floors->sunk = calloc(n * (size_t)rigs, sizeof *floors->sunk);
    floors->left = calloc((size_t)rigs, sizeof *floors->left);
    if (!floors->bounds || !floors->rig || !floors->vertex || !floors->c || !floors->low || !floors->room ||
        !floors->sunk || !floors->left) {
        floors_free(floors);
        return false;
    }
    floors->samples = samples;
    floors->splines = group;
    floors->rigs = rigs;
    return true;
}

static bool concerns(const struct pinned *pinned, const struct rig *rig, int which)
{
    return has_floor(rig) && rig_input_count(rig) > 0 && pinned->which[rig_input(rig, 0)] == which;
}

bool floors_concern(const struct pinned *pinned, const struct document *document, int which)
{
    for (int r = 0; r < document->rig_count; r++) {
        if (concerns(pinned, &document->rigs[r], which)) return true;
    }
    return false;
}

/// Where the floor in hand is at a sample.
static double level(const struct floors *floors, const struct document *document, int rig, int sample)
{
    return document->rigs[rig].character.floor - floors->sunk[rig * floors->samples + sample];
}

static double depth(const struct floors *floors, const struct document *document, int rig, int sample)
{
    return level(floors, document, rig, sample) - floors->low[sample].height;
}

static bool find_low(struct evaluation *evaluation, const struct document *document, int rig)
{
    struct floors *floors = &evaluation->storage->pinned.floors;
    const struct pin_source *source = &evaluation->pins;
    return source->lowest(source->context, evaluation, document, rig, document->rigs[rig].character.floor,
                          floors->room, floors->low);
}

/// Writes the bound of a vertex that is to be no lower than `height`; returns the size of its rig.
static double put_bound(struct evaluation *evaluation, const struct document *document, int rig, int sample,
                        struct low_point low, double height, wiggly_bound *bound, double (*c)[2])
{
    struct pinned *pinned = &evaluation->storage->pinned;
    const struct pin_source *source = &evaluation->pins;
    const struct pin pin = {.frame = document_frame(document, sample), .point = low.vertex};
    struct pin_point point = {.size = 1};
    source->find(source->context, evaluation, document, rig, &pin, pinned->members, pinned->count, pinned->c, &point);
    *bound = (wiggly_bound){.sample = sample, .c = (const double(*)[2])c, .least = height - point.at[1]};
    for (int i = 0; i < pinned->count; i++) {
        const wiggly_curve *curve = &pinned->curves[i];
        memcpy(c[i], pinned->c[i][1], sizeof c[i]);
        bound->least += c[i][0] * curve->re[sample] - c[i][1] * curve->im[sample];
    }
    return point.size;
}

/// Samples of a quarter of a period of the slowest member.
static double samples_to_rise(const struct pinned *pinned, int sample)
{
    double slowest = INFINITY;
    for (int i = 0; i < pinned->count; i++) {
        const wiggly_desc *desc = &pinned->descs[i];
        const wiggly_param *pull = desc->spring_friction ? &desc->spring : &desc->frequency;
        const double value = pull->track ? pull->track[sample] : pull->value;
        const double frequency = desc->spring_friction ? sqrt(fmax(0, value)) / (2 * 3.14159265358979323846) : value;
        if (frequency > 0) slowest = fmin(slowest, frequency);
    }
    return RISE / (slowest * pinned->descs[0].step);
}

/// Lets the floor sink around a sample.
static void sink(double *sunk, int samples, int at, double by, double rise)
{
    for (int i = 0; i < samples; i++) {
        const double left = 1 - abs(i - at) / (rise + 1);
        if (left > 0) sunk[i] = fmax(sunk[i], by * left * left);
    }
}

static bool is_held(const struct pinned *pinned, const struct pin_round *round, bool with_pins, int sample)
{
    for (int i = 0; i < pinned->count; i++) {
        for (int k = 0; k < pinned->descs[i].knot_count; k++) {
            if (pinned->descs[i].knots[k].sample == sample) return true;
        }
    }
    for (int h = 0; with_pins && h < pinned->held_count; h++) {
        if (round->pins[h].sample == sample) return true;
    }
    return false;
}

/// Lets a rig's floor sink where knots and pins hold it lower.
static void find_sunk(struct evaluation *evaluation, const struct document *document, int rig,
                      const struct pin_round *round, bool with_pins)
{
    struct pinned *pinned = &evaluation->storage->pinned;
    struct floors *floors = &pinned->floors;
    double *sunk = floors->sunk + rig * floors->samples;
    memset(sunk, 0, sizeof *sunk * (size_t)evaluation->samples);
    if (!find_low(evaluation, document, rig)) return;
    for (int i = 0; i < evaluation->samples; i++) {
        const double by = document->rigs[rig].character.floor - floors->low[i].height;
        if (!(by > 0) || !is_held(pinned, round, with_pins, i)) continue;
        put_bound(evaluation, document, rig, i, floors->low[i], 0, &floors->bounds[0], floors->c);
        const double held = 1 - wiggly_group_reach(pinned->solver, &floors->bounds[0]) / HELD;
        if (held > 0) sink(sunk, evaluation->samples, i, by * held, samples_to_rise(pinned, i));
    }
}

static bool is_bound(const struct floors *floors, int rig, int sample, int vertex)
{
    for (int b = 0; b < floors->count; b++) {
        if (floors->rig[b] == rig && floors->bounds[b].sample == sample && floors->vertex[b] == vertex) return true;
    }
    return false;
}

/// Adds the deepest vertex of every dip; whether there was any.
static bool add_bounds(struct evaluation *evaluation, const struct document *document, int rig)
{
    struct pinned *pinned = &evaluation->storage->pinned;
    struct floors *floors = &pinned->floors;
    const int samples = evaluation->samples;
    bool any = false;
    if (!find_low(evaluation, document, rig)) return false;
    for (int i = 0; i < samples && floors->count < FLOORS_MOST_BOUNDS; i++) {
        const double deep = depth(floors, document, rig, i);
        if (!(deep > 0) || (i > 0 && depth(floors, document, rig, i - 1) > deep)) continue;
        if (i + 1 < samples && depth(floors, document, rig, i + 1) >= deep) continue;
        const int b = floors->count;
        const struct low_point low = floors->low[i];
        const double size = put_bound(evaluation, document, rig, i, low, level(floors, document, rig, i),
                                      &floors->bounds[b], floors->c + b * pinned->count);
        if (!(deep > DEEP * size) || is_bound(floors, rig, i, low.vertex)) continue;
        floors->rig[b] = rig;
        floors->vertex[b] = low.vertex;
        floors->count++;
        any = true;
    }
    return any;
}

/// What the floor misses after all.
static void measure(struct evaluation *evaluation, const struct document *document, int rig)
{
    struct floors *floors = &evaluation->storage->pinned.floors;
    struct floor_left *left = &floors->left[rig];
    *left = (struct floor_left){.sample = -1};
    for (int i = 0; i < evaluation->samples; i++) {
        const double by = document->rigs[rig].character.floor - floors->low[i].height;
        if (by > left->depth) *left = (struct floor_left){by, i};
    }
}

wiggly_status floors_solve(struct evaluation *evaluation, const struct document *document, int which,
                           struct pin_round *round, bool with_pins, wiggly_status status)
{
    struct pinned *pinned = &evaluation->storage->pinned;
    struct floors *floors = &pinned->floors;
    floors->count = 0;
    for (int r = 0; r < document->rig_count; r++) {
        if (concerns(pinned, &document->rigs[r], which)) find_sunk(evaluation, document, r, round, with_pins);
    }
    for (int n = 0; n < MOST_ROUNDS && status < WIGGLY_ERROR_ARGUMENT; n++) {
        bool any = false;
        for (int r = 0; r < document->rig_count; r++) {
            if (!concerns(pinned, &document->rigs[r], which)) continue;
            any = add_bounds(evaluation, document, r) || any;
            measure(evaluation, document, r);
        }
        if (!any) break;
        status = wiggly_group_solve_bounded(pinned->solver, pinned->descs, pinned->weights, pinned->curves,
                                            pinned->count, round->pins, with_pins ? pinned->held_count : 0,
                                            floors->bounds, floors->count);
        for (int i = 0; i < pinned->count; i++) evaluation->curves[pinned->members[i]] = pinned->curves[i];
    }
    return status;
}

const struct floor_left *evaluation_floor(const struct evaluation *evaluation, int rig)
{
    const struct storage *storage = evaluation->storage;
    return storage && storage->pinned.floors.bounds && rig < storage->pinned.floors.rigs
               ? &storage->pinned.floors.left[rig]
               : NULL;
}
