/// Turns solved splines into polylines: one vertex per pixel column, and one exactly on each knot.
#include "base/hash.h"
#include "editor/core/bones.h"
#include "editor/core/core.h"
#include "editor/core/knots.h"
#include "editor/curves/state.h"
#include "maths/maths.h"
#include <limits.h>
#include <math.h>
#include <string.h>

static uint64_t cache_key(const struct curves *curves, const struct core *core)
{
    uint64_t revision[2] = {history_revision(core->history), core->evaluation ? core->evaluation->revision : 0};
    int choice[3] = {core->active, (int)core->look, core->curves.normalise};
    bool held = core->curves.normalise && core->drag.owner != NULL;
    uint64_t key = hash_bytes(HASH_START, revision, sizeof revision);
    key = hash_bytes(key, choice, sizeof choice);
    key = hash_bytes(key, &held, sizeof held);
    key = hash_bytes(key, &core->visibility, sizeof core->visibility);
    key = hash_bytes(key, &curves->view, sizeof curves->view);
    key = hash_bytes(key, &core->layout.plot, sizeof core->layout.plot);
    return key ? key : 1;
}

/// Moves the nearest column onto each knot of the active spline, unless several knots share that column.
static void hit_knots(struct curves *curves, const struct core *core, double first, double by)
{
    struct curve_cache *cache = &curves->cache;
    const struct spline *spline = core_active_spline(core);
    if (!spline) return;
    int k = spline_lower_bound(core->document, spline, (int)fmax(floor(first - by), 0));
    for (double before = -1; k < spline->knot_count; k++) {
        const double sample = document_sample(core->document, spline->knots[k].frame);
        const double column = floor((sample - first) / by + 0.5);
        if (column >= cache->count) break;
        const double after =
            k + 1 < spline->knot_count
                ? floor((document_sample(core->document, spline->knots[k + 1].frame) - first) / by + 0.5)
                : INFINITY;
        // Where knots share a column, its lowest and highest samples show them.
        if (column >= 0 && column != before && column != after) cache->position[(int)column] = sample;
        before = column;
    }
}

/// A column that covers many samples shows their maximum, the next column their minimum. An oscillation finer than a pixel then fills a
/// band instead of aliasing to a slow wave.
static double outermost(const struct evaluation *evaluation, int spline, double position, double by, bool highest)
{
    if (by <= 1 || spline < 0 || spline >= evaluation->count) return position;
    int first = (int)fmax(ceil(position - by / 2), 0);
    int end = (int)fmin(floor(position + by / 2), evaluation->samples - 1);
    return first <= end ? evaluation_extreme(evaluation, spline, first, end, highest) : position;
}

/// Columns of the visible part of the scene's range.
static void place_columns(struct curves *curves, const struct core *core)
{
    struct curve_cache *cache = &curves->cache;
    const struct document *document = core->document;
    double left = fmax(curves->view.frame0, document->first_frame);
    double right = fmin(curves->view.frame1, document->last_frame);
    cache->count = 0;
    if (!(right > left)) return;
    double pixels = (right - left) * curves_pixels_per_frame(curves, core);
    cache->count = (int)fmin(fmax(ceil(pixels) + 1, 2), EDITOR_MAX_COLUMNS);
    double first = core_position(document, left);
    double by = (core_position(document, right) - first) / (cache->count - 1);
    cache->first = first;
    cache->by = by;
    for (int c = 0; c < cache->count; c++) {
        cache->position[c] = outermost(core->evaluation, core->active, first + by * c, by, c % 2);
    }
    hit_knots(curves, core, first, by);
}

static double frame_of(const struct document *document, double position)
{
    return document->first_frame + position / document->substeps;
}

/// Spreads the fan's lags (radians) evenly along the tail or chain that the active spline moves. Returns how many.
static int fan_lags(const struct core *core, double lags[CURVES_FAN])
{
    int rig, number;
    const struct channel *channel = core_active_channel(core, &rig, &number);
    if (!channel || channel->spline != core->active || !axis_bends(channel->axis)) return 0;
    const int joints = bones_joints(core, rig);
    for (int i = 0; i < CURVES_FAN; i++) {
        int joint = (joints - 1) * (i + 1) / CURVES_FAN;
        lags[i] = angles_lag(&channel->lag, joint, joints) * (M_PI / 180);
    }
    return CURVES_FAN;
}

/// Whether a line of alternating maxima and minima swings in most columns: the next point is far away, the one after it near.
static bool is_band(const struct curve_cache *cache, const polyline line)
{
    static const float least = 4; // pixels
    int swings = 0;
    for (int c = 0; c + 2 < cache->count; c++) {
        const float swing = fabsf(line[c + 1][1] - line[c][1]), drift = fabsf(line[c + 2][1] - line[c][1]);
        swings += swing > least && drift < 0.5f * swing;
    }
    return cache->by > 1 && 2 * swings > cache->count;
}

/// A band's point covers the columns on both sides. Otherwise a swing two columns long would vanish.
static double widened(const struct curve_cache *cache) { return 2 * cache->by; }

/// A spline's total as a band: maximum and minimum around each column.
static void draw_band(const struct curves *curves, const struct core *core, int spline, struct value_map map,
                      polyline line)
{
    const struct curve_cache *cache = &curves->cache;
    for (int c = 0; c < cache->count; c++) {
        const double middle = cache->first + cache->by * c;
        const double position = outermost(core->evaluation, spline, middle, widened(cache), c % 2);
        const wiggly_value v = evaluation_at(core->evaluation, spline, position);
        line[c][0] = curves_x(curves, core, frame_of(core->document, middle));
        line[c][1] = curves_y(curves, core, map.scale * (v.y + v.re) + map.offset);
    }
}

/// Im x as a band, from at most about sixteen samples a column.
static void draw_imaginary_band(struct curves *curves, const struct core *core)
{
    struct curve_cache *cache = &curves->cache;
    const double reach = widened(cache) / 2, step = 1 + floor(reach / 8), last = core->evaluation->samples - 1;
    for (int c = 0; c < cache->count; c++) {
        const double middle = cache->first + cache->by * c;
        double most = c % 2 ? -INFINITY : INFINITY;
        for (double at = fmax(ceil(middle - reach), 0); at <= fmin(middle + reach, last); at += step) {
            const wiggly_value v = evaluation_at(core->evaluation, core->active, at);
            most = c % 2 ? fmax(most, v.y + v.im) : fmin(most, v.y + v.im);
        }
        cache->im[c][0] = cache->re[c][0];
        if (isfinite(most)) cache->im[c][1] = curves_y(curves, core, most);
    }
}

/// Whether the active spline's visible knots are too close together to tell its lagged copies apart.
static bool is_crowded(const struct curves *curves, const struct core *core)
{
    static const int apart = 3; // columns
    const struct curve_cache *cache = &curves->cache;
    const struct spline *spline = core_active_spline(core);
    if (!spline) return false;
    const double end = fmin(cache->first + cache->by * cache->count, INT_MAX);
    const int knots = spline_lower_bound(core->document, spline, (int)end) -
                      spline_lower_bound(core->document, spline, (int)cache->first);
    return knots > cache->count / apart;
}

static void draw_active(struct curves *curves, const struct core *core)
{
    struct curve_cache *cache = &curves->cache;
    double lags[CURVES_FAN], turn[CURVES_FAN][2];
    const bool fans = core->look == LOOK_WIGGLY && !is_crowded(curves, core);
    cache->fan_count = fans ? fan_lags(core, lags) : 0;
    for (int i = 0; i < cache->fan_count; i++) {
        turn[i][0] = maths_cos(lags[i]);
        turn[i][1] = maths_sin(lags[i]);
    }
    for (int c = 0; c < cache->count; c++) {
        wiggly_value v = evaluation_at(core->evaluation, core->active, cache->position[c]);
        float x = curves_x(curves, core, frame_of(core->document, cache->position[c]));
        memcpy(cache->re[c], (float[2]){x, curves_y(curves, core, v.y + v.re)}, sizeof cache->re[c]);
        memcpy(cache->im[c], (float[2]){x, curves_y(curves, core, v.y + v.im)}, sizeof cache->im[c]);
        memcpy(cache->equilibrium[c], (float[2]){x, curves_y(curves, core, v.y)}, sizeof cache->equilibrium[c]);
        for (int i = 0; i < cache->fan_count; i++) { /* eq. 27: Re(e^{−jφ} x) */
            cache->fan[i][c][0] = x;
            cache->fan[i][c][1] = curves_y(curves, core, v.y + turn[i][0] * v.re + turn[i][1] * v.im);
        }
    }
    cache->band = is_band(cache, cache->re);
    if (!cache->band) return;
    cache->fan_count = 0; // the copies would fill the same band
    draw_band(curves, core, core->active, (struct value_map){1, 0}, cache->re);
    draw_imaginary_band(curves, core);
}

static void draw_others(struct curves *curves, const struct core *core)
{
    struct curve_cache *cache = &curves->cache;
    cache->other_count = 0;
    for (int s = 0; s < core->document->spline_count && cache->other_count < CURVES_MAX_OTHERS; s++) {
        if (s == core->active || !spline_list_shows(core, s)) continue;
        polyline *line = &cache->others[cache->other_count];
        const struct value_map map = normal_map(curves, core, s);
        cache->other_spline[cache->other_count] = s;
        cache->other_id[cache->other_count] = core->document->splines[s]->id;
        for (int c = 0; c < cache->count; c++) {
            double position = outermost(core->evaluation, s, cache->position[c], cache->by, c % 2);
            wiggly_value v = evaluation_at(core->evaluation, s, position);
            (*line)[c][0] = curves_x(curves, core, frame_of(core->document, position));
            (*line)[c][1] = curves_y(curves, core, map.scale * (v.y + v.re) + map.offset);
        }
        const bool band = cache->other_band[cache->other_count++] = is_band(cache, *line);
        if (band) draw_band(curves, core, s, map, *line);
    }
}

int take_line(const struct curves *curves, const struct core *core, int spline, float *xy)
{
    const struct curve_cache *cache = &curves->cache;
    const struct take *take = &core->take;
    const int before = take_spline(core, spline);
    const struct value_map map = normal_map(curves, core, spline);
    const double by = cache->by * take->document->substeps / core->document->substeps;
    int count = 0;
    for (int c = 0; c < cache->count && before >= 0; c++) {
        const double frame = frame_of(core->document, cache->first + cache->by * c);
        const double middle = core_position(take->document, frame);
        if (middle < 0 || middle > take->evaluation.samples - 1) continue;
        const wiggly_value v =
            evaluation_at(&take->evaluation, before, outermost(&take->evaluation, before, middle, by, c % 2));
        xy[2 * count] = curves_x(curves, core, frame);
        xy[2 * count++ + 1] = curves_y(curves, core, map.scale * (v.y + v.re) + map.offset);
    }
    return count;
}

int curves_other(const struct curves *curves, const struct document *document, int other)
{
    const int spline = curves->cache.other_spline[other];
    const bool same =
        spline < document->spline_count && document->splines[spline]->id == curves->cache.other_id[other];
    return same ? spline : -1;
}

void curves_update(struct curves *curves, struct core *core)
{
    uint64_t key = cache_key(curves, core);
    if (key == curves->cache.key) return;
    curves->cache.key = key;
    place_columns(curves, core);
    draw_active(curves, core);
    normal_update(curves, core);
    draw_others(curves, core);
}

void keep_ghost(struct curves *curves, const struct core *core)
{
    struct ghost *ghost = &curves->ghost;
    const bool was_shown = ghost->is_shown;
    ghost->is_shown = core->drag.moved && core->drag.label;
    if (was_shown || !ghost->is_shown) return;
    const struct curve_cache *cache = &curves->cache;
    ghost->count = cache->count;
    ghost->band = cache->band;
    for (int c = 0; c < cache->count; c++) {
        wiggly_value v = evaluation_at(core->evaluation, core->active, cache->position[c]);
        ghost->frame[c] = frame_of(core->document, cache->position[c]);
        ghost->value[c] = v.y + v.re;
        if (!cache->band) continue;
        ghost->frame[c] = curves_frame(curves, core, cache->re[c][0]);
        ghost->value[c] = curves_value(curves, core, cache->re[c][1]);
    }
}
