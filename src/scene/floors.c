/// Keeps the lowest points of characters above their floors.
///
/// Cutting planes: the lowest vertex of every dip below the floor becomes a bound, the group is solved with all bounds so far, and again
/// until no vertex is deeper than the tolerance. Each solve is convex, and its answer a function of the bounds alone.
///
/// Knots and pins come first. Where they hold a character below its floor, the floor sinks as deep there, and rises again over a quarter
/// of a period: otherwise the curve would have to jump up to it in one sample.
#include "scene/floors.h"
#include "base/need.h"
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

bool floors_any(const struct document *document)
{
    for (int r = 0; r < document->rig_count; r++) {
        if (rig_has_floor(document->rigs[r])) return true;
    }
    return false;
}

void floors_resize(struct floors *floors, const struct document *document, int group)
{
    const int samples = document_samples(document), rigs = document->rig_count;
    if (!floors_any(document)) return;
    if (floors->bounds && samples <= floors->samples && group <= floors->splines && rigs <= floors->rigs) return;
    floors_free(floors);
    const size_t n = (size_t)samples, bounds = FLOORS_MOST_BOUNDS;
    floors->bounds = need_zeroed(bounds, sizeof *floors->bounds);
    floors->rig = need_zeroed(bounds, sizeof *floors->rig);
    floors->vertex = need_zeroed(bounds, sizeof *floors->vertex);
    floors->c = need_zeroed(bounds * (size_t)group, sizeof *floors->c);
    floors->low = need_zeroed(n, sizeof *floors->low);
    floors->room = need_zeroed(LOW_POINT_ROOM * (size_t)low_point_samples(samples), sizeof *floors->room);
    floors->sunk = need_zeroed(n * (size_t)rigs, sizeof *floors->sunk);
    floors->left = need_zeroed((size_t)rigs, sizeof *floors->left);
    floors->samples = samples;
    floors->splines = group;
    floors->rigs = rigs;
}

static bool concerns(const int *which, const struct rig *rig, int group)
{
    return rig_has_floor(rig) && rig_input_count(rig) > 0 && which[rig_input(rig, 0)] == group;
}

bool floors_concern(const int *which, const struct document *document, int group)
{
    for (int r = 0; r < document->rig_count; r++) {
        if (concerns(which, document->rigs[r], group)) return true;
    }
    return false;
}

/// Where the floor in hand is at a sample.
static double level(const struct floors *floors, const struct document *document, int rig, int sample)
{
    return document->rigs[rig]->character.floor - floors->sunk[rig * floors->samples + sample];
}

static double depth(const struct floors *floors, const struct document *document, int rig, int sample)
{
    return level(floors, document, rig, sample) - floors->low[sample].height;
}

static bool find_low(struct floors *floors, const struct floor_group *group, const struct document *document, int rig)
{
    const struct pin_source *source = group->source;
    if (floors->in_hand == rig) return true;
    if (!source->lowest(source->context, group->evaluation, document, rig, document->rigs[rig]->character.floor,
                        floors->room, floors->low))
        return false;
    floors->in_hand = rig;
    return true;
}

/// Writes the bound of a vertex that is to be no lower than `height`; returns the size of its rig.
static double put_bound(const struct floor_group *group, const struct document *document, int rig, int sample,
                        struct low_point low, double height, wiggly_bound *bound, double (*c)[2])
{
    const struct pin_source *source = group->source;
    const struct pin pin = {.frame = document_frame(document, sample), .point = low.vertex};
    struct pin_point point = {.size = 1};
    source->find(source->context, group->evaluation, document, rig, &pin, group->members, group->count, group->c,
                 &point);
    *bound = (wiggly_bound){.sample = sample, .c = (const double(*)[2])c, .least = height - point.at[1]};
    for (int i = 0; i < group->count; i++) {
        const wiggly_curve *curve = &group->curves[i];
        memcpy(c[i], group->c[i][1], sizeof c[i]);
        bound->least += c[i][0] * curve->re[sample] - c[i][1] * curve->im[sample];
    }
    return point.size;
}

/// Samples of a quarter of a period of the slowest member.
static double samples_to_rise(const struct floor_group *group, int sample)
{
    double slowest = INFINITY;
    for (int i = 0; i < group->count; i++) {
        const wiggly_desc *desc = &group->descs[i];
        const double frequency = desc->frequency.track ? desc->frequency.track[sample] : desc->frequency.value;
        if (frequency > 0) slowest = fmin(slowest, frequency);
    }
    return RISE / (slowest * group->descs[0].step);
}

/// Lets the floor sink around a sample.
static void sink(double *sunk, int samples, int at, double by, double rise)
{
    for (int i = 0; i < samples; i++) {
        const double left = 1 - abs(i - at) / (rise + 1);
        if (left > 0) sunk[i] = fmax(sunk[i], by * left * left);
    }
}

static bool is_held(const struct floor_group *group, int sample)
{
    for (int i = 0; i < group->count; i++) {
        for (int k = 0; k < group->descs[i].knot_count; k++) {
            if (group->descs[i].knots[k].sample == sample) return true;
        }
    }
    for (int h = 0; h < group->pin_count; h++) {
        if (group->pins[h].sample == sample) return true;
    }
    return false;
}

/// Lets a rig's floor sink where knots and pins hold it lower.
static void find_sunk(struct floors *floors, const struct floor_group *group, const struct document *document,
                      int rig)
{
    double *sunk = floors->sunk + rig * floors->samples;
    memset(sunk, 0, sizeof *sunk * (size_t)group->samples);
    if (!find_low(floors, group, document, rig)) return;
    for (int i = 0; i < group->samples; i++) {
        const double by = document->rigs[rig]->character.floor - floors->low[i].height;
        if (!(by > 0) || !is_held(group, i)) continue;
        put_bound(group, document, rig, i, floors->low[i], 0, &floors->bounds[0], floors->c);
        const double held = 1 - wiggly_group_reach(group->solver, &floors->bounds[0]) / HELD;
        if (held > 0) sink(sunk, group->samples, i, by * held, samples_to_rise(group, i));
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
static bool add_bounds(struct floors *floors, const struct floor_group *group, const struct document *document,
                       int rig)
{
    const int samples = group->samples;
    bool any = false;
    if (!find_low(floors, group, document, rig)) return false;
    for (int i = 0; i < samples && floors->count < FLOORS_MOST_BOUNDS; i++) {
        const double deep = depth(floors, document, rig, i);
        if (!(deep > 0) || (i > 0 && depth(floors, document, rig, i - 1) > deep)) continue;
        if (i + 1 < samples && depth(floors, document, rig, i + 1) >= deep) continue;
        const int b = floors->count;
        const struct low_point low = floors->low[i];
        const double size = put_bound(group, document, rig, i, low, level(floors, document, rig, i),
                                      &floors->bounds[b], floors->c + b * group->count);
        if (!(deep > DEEP * size) || is_bound(floors, rig, i, low.vertex)) continue;
        floors->rig[b] = rig;
        floors->vertex[b] = low.vertex;
        floors->count++;
        any = true;
    }
    return any;
}

/// What the floor misses after all.
static void measure(struct floors *floors, const struct document *document, int rig, int samples)
{
    struct floor_left *left = &floors->left[rig];
    *left = (struct floor_left){.sample = -1};
    for (int i = 0; i < samples; i++) {
        const double by = document->rigs[rig]->character.floor - floors->low[i].height;
        if (by > left->depth) *left = (struct floor_left){by, i};
    }
}

wiggly_status floors_solve(struct floors *floors, const struct floor_group *group, const struct document *document,
                           wiggly_status status)
{
    floors->count = 0;
    floors->in_hand = -1;
    for (int r = 0; r < document->rig_count; r++) {
        if (concerns(group->which, document->rigs[r], group->group)) find_sunk(floors, group, document, r);
    }
    for (int n = 0; n < MOST_ROUNDS && status < WIGGLY_ERROR_ARGUMENT; n++) {
        bool any = false;
        for (int r = 0; r < document->rig_count; r++) {
            if (!concerns(group->which, document->rigs[r], group->group)) continue;
            any = add_bounds(floors, group, document, r) || any;
            measure(floors, document, r, group->samples);
        }
        if (!any) break;
        status = wiggly_group_solve_bounded(group->solver, group->descs, group->weights, group->curves, group->count,
                                            group->pins, group->pin_count, floors->bounds, floors->count);
        for (int i = 0; i < group->count; i++) group->shown[group->members[i]] = group->curves[i];
        floors->in_hand = -1;
    }
    return status;
}
