/// Normalises curves of different sizes: the others are scaled to the height of the active one.
///
/// Let a … b be the values that the active curve takes and c … d those of another: the other's value v is drawn where the
/// active one's a + (v − c)·(b − a)/(d − c) is.
#include "editor/core/core.h"
#include "editor/curves/curves.h"
#include "editor/curves/view.h"
#include <math.h>

static bool has_height(const double range[2]) { return range[1] - range[0] > 1e-12 * fmax(1, fabs(range[0])); }

/// Where the values of one spline are drawn as those of another.
static struct value_map map_between(const struct curves *curves, int active, int spline)
{
    const struct value_map as_it_is = {1, 0};
    const struct curve_cache *cache = &curves->cache;
    bool known = spline < cache->range_count && active >= 0 && active < cache->range_count;
    if (!curves->options.normalise || spline == active || !known) return as_it_is;
    const double *to = cache->range[active], *from = cache->range[spline];
    if (!has_height(to)) return as_it_is;
    if (!has_height(from)) return (struct value_map){1, (to[0] + to[1]) / 2 - from[0]};
    double scale = (to[1] - to[0]) / (from[1] - from[0]);
    return (struct value_map){scale, to[0] - scale * from[0]};
}

struct value_map normal_map(const struct curves *curves, const struct core *core, int spline)
{
    return map_between(curves, core->active, spline);
}

float curves_y_of(const struct curves *curves, const struct core *core, int spline, double value)
{
    struct value_map map = normal_map(curves, core, spline);
    return curves_y(curves, core, map.scale * value + map.offset);
}

void normal_update(struct curves *curves, const struct core *core, const struct editor_world *world)
{
    struct curve_cache *cache = &curves->cache;
    const struct evaluation *evaluation = world->evaluation;
    if (!curves->options.normalise || core->drag.owner || !evaluation) return;
    cache->range_count = evaluation->count < CURVES_MAX_RANGES ? evaluation->count : CURVES_MAX_RANGES;
    for (int s = 0; s < cache->range_count; s++) {
        for (int highest = 0; highest < 2; highest++) {
            int sample = evaluation_extreme(evaluation, s, 0, evaluation->samples - 1, highest);
            cache->range[s][highest] = evaluation->curves[s].total[sample];
        }
    }
}

void curves_toggle_normal(struct curves *curves, struct core *core, const struct editor_world *world)
{
    curves->options.normalise = !curves->options.normalise;
    normal_update(curves, core, world);
    curves_frame_all(curves, core, world);
    core_message(
        core, false,
        curves->options.normalise
            ? "Normalised: every curve is as high as the active one. The axis shows the active curve's values."
            : "All curves share one axis again.");
}

void curves_activate(struct curves *curves, struct core *core, int before)
{
    const struct value_map map = map_between(curves, before, core->active);
    view_rescale(curves, core, map.scale, map.offset);
}
