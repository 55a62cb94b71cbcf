/// The selected knots' slopes: on, off, flat, Catmull-Rom, turned and stiffened by keys.
#include "editor/core/core.h"
#include "editor/core/knots.h"
#include "editor/core/selection.h"
#include <math.h>

/// Kinds for core_merge_key(), different from nudge.c's.
enum nudge_kind { NUDGE_SLOPE = 50, NUDGE_STIFFNESS };

static const double FIRM = 1000; ///< default stiffness, 1/s
static const double TURN = 0.05,
                    FIRMER = 1.25; ///< per key press: of the visible values, a second; factor on the stiffness
static const double SLOPE_RESOLUTION = 1e-3; ///< of the visible values, a second

/// The curve's slope at a knot, in values a second.
static double slope_at(const struct core *core, int spline, const struct knot *knot)
{
    int sample = document_sample(core->document, knot->frame);
    double slope = evaluation_slope(core->evaluation, core->document, spline, sample);
    return isfinite(slope) ? slope : 0;
}

/// Computes a knot's slope, in values a second.
typedef double slope_rule(const struct core *core, struct knot_place at);

static double flat(const struct core *core, struct knot_place at)
{
    (void)core;
    (void)at;
    return 0;
}

/// Catmull-Rom: the slope of the chord between both neighbours; at an end, to the only neighbour. A loop wraps around.
static double catmull_rom(const struct core *core, struct knot_place at)
{
    const struct document *document = core->document;
    const struct spline *spline = document->splines[at.spline];
    const struct knot *knots = spline->knots;
    int count = spline->knot_count, k = at.knot;
    bool loop = spline_start(spline) == WIGGLY_LOOP && count > 1;
    double period = document->last_frame - document->first_frame;
    int before = k > 0 ? k - 1 : loop ? count - 1 : 0, after = k + 1 < count ? k + 1 : loop ? 0 : count - 1;
    double frames = knots[after].frame - knots[before].frame;
    if (loop && (k == 0 || k == count - 1)) frames += period;
    if (loop && count == 2) return 0; /* the same knot on both sides */
    const double rise =
        core_knot_value(core, at.spline, &knots[after]) - core_knot_value(core, at.spline, &knots[before]);
    return frames > 0 ? rise / frames * document->fps : 0;
}

/// A change of every selected knot in one step.
struct knot_change {
    const char *label;
    uint64_t kind;    ///< for merging; 0: never
    bool on;          ///< turns missing slopes on, or all off
    slope_rule *rule; ///< or NULL
    double slope;     ///< added
    double stiffness; ///< multiplied
};

static void change_knots(struct core *core, const struct knot_change *change)
{
    const struct document *document = core->document;
    const uint64_t merge = change->kind ? core_merge_key(core, change->kind) : 0;
    if (selected_count(core) == 0 || !core_step(core, change->label, merge)) return;
    for (struct knot_place at = SELECTED_START; selected_next(core, &at);) {
        const struct knot *before = knot_at(document, at);
        if (before->still) continue;
        const bool fresh = change->on && !before->has_slope;
        struct knot knot = *before;
        if (fresh) knot.slope = slope_at(core, at.spline, before);
        if (!(before->stiffness > 0)) knot.stiffness = FIRM;
        knot.has_slope = change->on;
        if (change->rule) knot.slope = change->rule(core, at);
        if (change->rule || change->slope != 0 || fresh)
            knot.slope = core_round(knot.slope + change->slope, SLOPE_RESOLUTION * core->visible);
        knot.stiffness = fmin(fmax(knot.stiffness * change->stiffness, 1e-3), 1e9);
        core_put_knot(core, at.spline, &knot);
    }
    core_edited(core, -1);
}

void slopes_turn(struct core *core, int direction)
{
    struct knot_change change = {.label = "Change slope",
                                 .kind = NUDGE_SLOPE,
                                 .on = true,
                                 .slope = TURN * direction * core->visible,
                                 .stiffness = 1};
    change_knots(core, &change);
}

void slopes_stiffen(struct core *core, int direction)
{
    struct knot_change change = {.label = "Change stiffness",
                                 .kind = NUDGE_STIFFNESS,
                                 .on = true,
                                 .stiffness = direction > 0 ? FIRMER : 1 / FIRMER};
    change_knots(core, &change);
}

/// Still knots do not count, because they cannot have slopes.
static bool all_sloped(const struct core *core)
{
    bool all = true;
    for (struct knot_place at = SELECTED_START; selected_next(core, &at);) {
        const struct knot *knot = knot_at(core->document, at);
        all &= knot->has_slope || knot->still;
    }
    return all;
}

void slopes_set(struct core *core, int how)
{
    const bool off = how == SLOPES_TOGGLE && all_sloped(core);
    const struct knot_change changes[] = {
        [SLOPES_TOGGLE] = {.label = off ? "Slope off" : "Slope on", .on = !off, .stiffness = 1},
        [SLOPES_FLAT] = {.label = "Slope flat", .on = true, .rule = flat, .stiffness = 1},
        [SLOPES_SMOOTH] = {.label = "Slope smooth", .on = true, .rule = catmull_rom, .stiffness = 1},
    };
    change_knots(core, &changes[how]);
}
