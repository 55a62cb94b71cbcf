/// Draws the curves panel: polylines of the solved splines, grid, ruler, knots, slope handles, playhead.
#include "base/hash.h"
#include "editor/core/core.h"
#include "editor/curves/state.h"
#include "maths/maths.h"
#include "scene/pins.h"
#include "scene/warnings.h"
#include "ui/font.h"
#include "ui/theme.h"
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

// Polylines: one vertex per pixel column, and one exactly on each knot.

/// A column that covers many samples shows their maximum, the next column their minimum. An oscillation finer than a pixel then fills a
/// band instead of aliasing to a slow wave.
static double outermost(const struct evaluation *evaluation, int spline, double position, double by, bool highest)
{
    if (by <= 1 || spline < 0 || spline >= evaluation->count) return position;
    int first = (int)fmax(ceil(position - by / 2), 0);
    int end = (int)fmin(floor(position + by / 2), evaluation->samples - 1);
    return first <= end ? evaluation_extreme(evaluation, spline, first, end, highest) : position;
}

static double frame_of(const struct document *document, double position)
{
    return document->first_frame + position / document->substeps;
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

/// A spline's total; as a band, maximum and minimum around each column and its neighbours, or a swing two columns long would vanish.
static void draw_total(const struct curves *curves, const struct core *core, int spline, bool band, polyline line)
{
    const struct curve_cache *cache = &curves->cache;
    const struct value_map map = normal_map(curves, core, spline);
    for (int c = 0; c < cache->count; c++) {
        const double middle = band ? cache->first + cache->by * c : cache->position[c];
        const double by = band ? 2 * cache->by : cache->by;
        const double position = outermost(core->evaluation, spline, middle, by, c % 2);
        const wiggly_value v = evaluation_at(core->evaluation, spline, position);
        line[c][0] = curves_x(core, frame_of(core->document, band ? middle : position));
        line[c][1] = curves_y(core, map.scale * (v.y + v.re) + map.offset);
    }
}

int curves_other(const struct curves *curves, const struct document *document, int other)
{
    return document_find_spline_id(document, curves->cache.other_id[other]);
}

int curves_fan(const struct core *core, double turn[CURVES_FAN][2], double *delay)
{
    int rig, number;
    const struct channel *channel = core_active_channel(core, &rig, &number);
    if (core->view.look != LOOK_WIGGLY || !channel || channel->spline != core->focus.active ||
        !axis_bends(channel->axis))
        return 0;
    *delay = document_delay(core->document, rig);
    for (int i = 0; i < CURVES_FAN; i++) {
        const int joints = bones_joints(core, rig), joint = (joints - 1) * (i + 1) / CURVES_FAN;
        const double lag = angles_lag(&channel->lag, joint, joints) * (M_PI / 180);
        turn[i][0] = maths_cos(lag);
        turn[i][1] = maths_sin(lag);
    }
    return CURVES_FAN;
}

/// Draws the active spline's lines; its lagged copies unless its visible knots are too close together to tell them apart.
static void draw_active(struct curves *curves, const struct core *core)
{
    static const int apart = 3; // columns
    struct curve_cache *cache = &curves->cache;
    const struct evaluation *evaluation = core->evaluation;
    const struct spline *spline = core_active_spline(core);
    double turn[CURVES_FAN][2], delay = 0;
    cache->fan_count = spline ? curves_fan(core, turn, &delay) : 0;
    if (cache->fan_count > 0) {
        const double end = fmin(cache->first + cache->by * cache->count, INT_MAX);
        const int knots = spline_lower_bound(core->document, spline, (int)end) -
                          spline_lower_bound(core->document, spline, (int)cache->first);
        if (knots > cache->count / apart) cache->fan_count = 0;
    }
    for (int c = 0; c < cache->count; c++) {
        wiggly_value v = evaluation_at(evaluation, core->focus.active, cache->position[c]);
        float x = curves_x(core, frame_of(core->document, cache->position[c]));
        memcpy(cache->re[c], (float[2]){x, curves_y(core, v.y + v.re)}, sizeof cache->re[c]);
        memcpy(cache->im[c], (float[2]){x, curves_y(core, v.y + v.im)}, sizeof cache->im[c]);
        memcpy(cache->equilibrium[c], (float[2]){x, curves_y(core, v.y)}, sizeof cache->equilibrium[c]);
        if (cache->fan_count > 0 && delay != 0)
            v = evaluation_at(evaluation, core->focus.active, cache->position[c] - delay);
        for (int i = 0; i < cache->fan_count; i++) { /* eq. 27: Re(e^{−jφ} x) */
            cache->fan[i][c][0] = x;
            cache->fan[i][c][1] = curves_y(core, v.y + turn[i][0] * v.re + turn[i][1] * v.im);
        }
    }
    cache->band = is_band(cache, cache->re);
    if (!cache->band) return;
    cache->fan_count = 0; // the copies would fill the same band
    draw_total(curves, core, core->focus.active, true, cache->re);

    // Im x as a band, from at most about sixteen samples a column.
    const double reach = cache->by, step = 1 + floor(reach / 8), last = evaluation->samples - 1;
    for (int c = 0; c < cache->count; c++) {
        const double middle = cache->first + cache->by * c;
        double most = c % 2 ? -INFINITY : INFINITY;
        for (double at = fmax(ceil(middle - reach), 0); at <= fmin(middle + reach, last); at += step) {
            const wiggly_value v = evaluation_at(evaluation, core->focus.active, at);
            most = c % 2 ? fmax(most, v.y + v.im) : fmin(most, v.y + v.im);
        }
        cache->im[c][0] = cache->re[c][0];
        if (isfinite(most)) cache->im[c][1] = curves_y(core, most);
    }
}

/// Rebuilds the vertices if document, view or layout changed. Allocates nothing.
static void curves_update(struct curves *curves, struct core *core)
{
    struct curve_cache *cache = &curves->cache;
    const struct document *document = core->document;
    const struct evaluation *evaluation = core->evaluation;
    const bool normalises = core->view.on[SWITCH_NORMALISE];
    const uint64_t state[] = {history_revision(core->history),
                              evaluation ? evaluation->revision : 0,
                              (uint64_t)(core->focus.active + 1),
                              (uint64_t)core->view.look,
                              normalises,
                              normalises && core->input.drag.owner,
                              core->view.visibility};
    uint64_t key = hash_bytes(HASH_START, state, sizeof state);
    key = hash_bytes(key, &core->view.plot, sizeof core->view.plot);
    key = hash_bytes(key, &core->view.layout.plot, sizeof core->view.layout.plot);
    if (key == 0) key = 1;
    if (key == cache->key) return;
    cache->key = key;

    // The columns of the visible part of the scene's range.
    const double left = fmax(core->view.plot.frame0, document->first_frame);
    const double right = fmin(core->view.plot.frame1, document->last_frame);
    const double pixels = (right - left) * curves_pixels_per_frame(core);
    cache->count = right > left ? (int)fmin(fmax(ceil(pixels) + 1, 2), EDITOR_MAX_COLUMNS) : 0;
    if (cache->count > 0) {
        cache->first = core_position(document, left);
        cache->by = (core_position(document, right) - cache->first) / (cache->count - 1);
    }
    const double first = cache->first, by = cache->by;
    for (int c = 0; c < cache->count; c++)
        cache->position[c] = outermost(evaluation, core->focus.active, first + by * c, by, c % 2);

    // The nearest column moves onto each knot of the active spline. Where knots share one, its lowest and highest samples show them.
    const struct spline *spline = cache->count > 0 ? core_active_spline(core) : NULL;
    int k = spline ? spline_lower_bound(document, spline, (int)fmax(floor(first - by), 0)) : 0;
    for (double before = -1; spline && k < spline->knot_count; k++) {
        const double sample = document_sample(document, spline->knots[k].frame);
        const double column = floor((sample - first) / by + 0.5);
        if (column >= cache->count) break;
        const double after = k + 1 < spline->knot_count
                                 ? floor((document_sample(document, spline->knots[k + 1].frame) - first) / by + 0.5)
                                 : INFINITY;
        if (column >= 0 && column != before && column != after) cache->position[(int)column] = sample;
        before = column;
    }
    draw_active(curves, core);

    // What normalised curves cover. During a drag it stays, so that the other curves hold still.
    if (normalises && !core->input.drag.owner && evaluation) {
        cache->range_count = evaluation->count < CURVES_MAX_RANGES ? evaluation->count : CURVES_MAX_RANGES;
        for (int i = 0; i < 2 * cache->range_count; i++) {
            const int sample = evaluation_extreme(evaluation, i / 2, 0, evaluation->samples - 1, i % 2);
            cache->range[i / 2][i % 2] = evaluation->curves[i / 2].total[sample];
        }
    }
    cache->other_count = 0;
    for (int s = 0; s < document->spline_count && cache->other_count < CURVES_MAX_OTHERS; s++) {
        if (s == core->focus.active || !spline_list_shows(core, s)) continue;
        polyline *line = &cache->others[cache->other_count];
        cache->other_id[cache->other_count] = document->splines[s]->id;
        draw_total(curves, core, s, false, *line);
        const bool band = cache->other_band[cache->other_count++] = is_band(cache, *line);
        if (band) draw_total(curves, core, s, true, *line);
    }
}

void keep_ghost(struct curves *curves, const struct core *core)
{
    struct ghost *ghost = &curves->ghost;
    const uint64_t was = ghost->of;
    ghost->of = core->input.drag.moved && core->input.drag.label ? UINT64_MAX
                : core->cleaning.of                              ? core->cleaning.merge
                                                                 : 0;
    if (was == ghost->of || ghost->of == 0) return;
    const struct curve_cache *cache = &curves->cache;
    ghost->count = cache->count;
    ghost->band = cache->band;
    for (int c = 0; c < cache->count; c++) {
        wiggly_value v = evaluation_at(core->evaluation, core->focus.active, cache->position[c]);
        ghost->frame[c] = frame_of(core->document, cache->position[c]);
        ghost->value[c] = v.y + v.re;
        if (cache->band) ghost->frame[c] = curves_frame(core, cache->re[c][0]);
        if (cache->band) ghost->value[c] = curves_value(core, cache->re[c][1]);
    }
}

// Grid and ruler.

static const float MIN_FRAME_STEP = 64, MIN_VALUE_STEP = 34, TAG_GAP = 3; ///< pixels between numbers

/// A round distance between numbers, and how many subdivisions it has.
struct grid_step {
    double size;
    int parts;
    int decimals;
};

/// The smallest of 1, 2, 5 · 10ⁿ that is not below `least`.
static struct grid_step round_step(double least)
{
    const double power = maths_power_of_ten(maths_decade(least)), factor = least / power;
    const double size = (factor > 5 ? 10 : factor > 2 ? 5 : factor > 1 ? 2 : 1) * power;
    const int decimals = (int)fmin(fmax(-maths_decade((1 + 1e-9) * size), 0), 9);
    return (struct grid_step){size, factor > 1 && factor <= 2 ? 4 : 5, decimals};
}

/// Rounds to device pixels, so that hairlines stay sharp at every scale.
static float sharp(const struct core *core, float at) { return roundf(at * core->view.scale) / core->view.scale; }

struct rect ruler_corner(const struct core *core)
{
    const struct layout *layout = &core->view.layout;
    return (struct rect){layout->value_axis.x, layout->ruler.y, layout->value_axis.w, layout->ruler.h};
}

/// A press that did not move plays the whole scene again; `keep` false restores the former range.
static void end_range(void *room, struct core *core, bool keep)
{
    const double *before = ((const struct curves *)room)->range_before;
    if (!keep) memcpy(core->view.playback.range, before, sizeof core->view.playback.range);
    if (keep && !core->input.drag.moved) playback_choose(core, -INFINITY, INFINITY);
}

/// The rectangle of the playhead's frame number on the ruler, and its text; empty if the playhead is not visible.
static struct rect playhead_tag(const struct core *core, char text[32])
{
    const struct rect *ruler = &core->view.layout.ruler;
    float x = curves_x(core, core_frame(core));
    if (x < ruler->x || x > ruler->x + ruler->w) return (struct rect){0};
    double frame = round(core_frame(core)) + 0.0; /* the one that I would insert at */
    snprintf(text, 32, core->view.on[SWITCH_SECONDS] ? "%.2f" : "%.0f",
             core->view.on[SWITCH_SECONDS] ? frame / core->document->fps : frame);
    float width = roundf(font_width(FONT_NUMBER, THEME_TEXT_SMALL, text)) + 10;
    float left = fminf(fmaxf(roundf(x - width / 2), ruler->x), ruler->x + ruler->w - width);
    return (struct rect){left, ruler->y + 3, width, 16};
}

static void grid_show(struct core *core)
{
    struct drawlist *list = &core->list;
    const struct layout *layout = &core->view.layout;
    const struct rect *plot = &layout->plot, *ruler = &layout->ruler, *axis = &layout->value_axis;
    const struct rect field = {plot->x, layout->sheet.y, plot->w, layout->sheet.h + plot->h}; // with the dope sheet
    const struct plotted *view = &core->view.plot;
    char text[32];
    const double unit = core->view.on[SWITCH_SECONDS] ? core->document->fps : 1; // frames per unit of the ruler
    struct grid_step times = round_step(MIN_FRAME_STEP / (curves_pixels_per_frame(core) * unit));
    struct grid_step values = round_step(MIN_VALUE_STEP / curves_pixels_per_value(core));
    drawlist_rect(list, layout->curves, theme()->panel);
    struct rect clip = drawlist_push_clip(list, field);
    const float right = field.x + field.w;
    float first = fmaxf(curves_x(core, core->document->first_frame), field.x);
    float last = fminf(curves_x(core, core->document->last_frame), right);
    if (first > field.x)
        drawlist_rect(list, (struct rect){field.x, field.y, first - field.x, field.h}, theme()->outside);
    if (last < right) drawlist_rect(list, (struct rect){last, field.y, right - last, field.h}, theme()->outside);

    // Minor lines, then major ones over them.
    for (int major = 0; major < 2; major++) {
        const uint32_t color = major ? theme()->grid_major : theme()->grid_minor;
        const double frames = times.size / (major ? 1 : times.parts) * unit;
        for (double i = ceil(view->frame0 / frames); i * frames <= view->frame1; i++) {
            const float x = sharp(core, curves_x(core, i * frames));
            if (major || fmod(i, times.parts) != 0) drawlist_rect(list, (struct rect){x, field.y, 1, field.h}, color);
        }
        const double up = values.size / (major ? 1 : values.parts);
        for (double i = ceil(view->value0 / up); i * up <= view->value1; i++) {
            const float y = sharp(core, curves_y(core, i * up));
            if (major || fmod(i, values.parts) != 0)
                drawlist_rect(list, (struct rect){plot->x, y, plot->w, 1}, major && i == 0 ? theme()->zero : color);
        }
    }
    drawlist_set_clip(list, clip);
    drawlist_rect(list, (struct rect){ruler->x, layout->sheet.y - 1, ruler->w, 1}, theme()->border);
    if (playback_is_part(core)) { // the played range: marked on the ruler, tinted in the plot
        const uint32_t color = theme()->accent;
        double range[2];
        float x[2];
        playback_range(core, range);
        for (int end = 0; end < 2; end++)
            x[end] = fminf(fmaxf(curves_x(core, range[end]), plot->x), plot->x + plot->w);
        const float width = x[1] - x[0];
        drawlist_rect(list, (struct rect){x[0], plot->y, width, plot->h}, theme_fade(color, 0.05f));
        drawlist_rect(list, (struct rect){x[0], ruler->y, width, ruler->h}, theme_fade(color, 0.14f));
        drawlist_rect(list, (struct rect){x[0], ruler->y, 2, ruler->h}, color);
        drawlist_rect(list, (struct rect){x[1] - 2, ruler->y, 2, ruler->h}, color);
    }

    // Frames or seconds, centred over the grid lines, but for the one under the playhead's tag.
    clip = drawlist_push_clip(list, *ruler);
    const struct rect tag = playhead_tag(core, text);
    for (double i = ceil(view->frame0 / unit / times.size); i * times.size <= view->frame1 / unit; i++) {
        snprintf(text, sizeof text, "%.*f", times.decimals, i * times.size + 0.0);
        float width = font_width(FONT_NUMBER, THEME_TEXT_SMALL, text);
        float x = curves_x(core, i * times.size * unit) - width / 2;
        if (x < ruler->x || x + width > ruler->x + ruler->w) continue;
        if (x < tag.x + tag.w + TAG_GAP && x + width > tag.x - TAG_GAP) continue;
        drawlist_text(list, x, ruler->y + 15, FONT_NUMBER, THEME_TEXT_SMALL, theme()->text_dim, text);
    }
    drawlist_set_clip(list, clip);
    const struct rect corner = ruler_corner(core);
    const char *name = core->view.on[SWITCH_SECONDS] ? "s" : "frame";
    const float left = corner.x + corner.w - 8 - font_width(FONT_LABEL, THEME_TEXT_SMALL, name);
    drawlist_text(list, left, corner.y + 15, FONT_LABEL, THEME_TEXT_SMALL,
                  core->input.hover.thing == &thing_units ? theme()->text : theme()->text_dim, name);

    clip = drawlist_push_clip(list, *axis);
    const float half = font_cap_height(FONT_NUMBER, THEME_TEXT_SMALL) / 2;
    for (double i = ceil(view->value0 / values.size); i * values.size <= view->value1; i++) {
        double value = i * values.size;
        float y = curves_y(core, value);
        if (y < axis->y + 8 || y > axis->y + axis->h - 8) continue;
        bool wide = fabs(value) >= 1e6 || values.size < 1e-6;
        snprintf(text, sizeof text, wide ? "%.*g" : "%.*f", wide ? 3 : values.decimals, value + 0.0);
        float x = axis->x + axis->w - 8 - font_width(FONT_NUMBER, THEME_TEXT_SMALL, text);
        drawlist_text(list, fmaxf(x, axis->x + 2), roundf(y + half), FONT_NUMBER, THEME_TEXT_SMALL, theme()->text_dim,
                      text);
    }
    drawlist_set_clip(list, clip);
}

static void choose_range(void *room, struct core *core)
{
    const double from = round(curves_frame(core, core->input.drag.start_x));
    const double to = round(curves_frame(core, core->input.drag.x));
    (void)room;
    playback_choose(core, fmin(from, to), fmax(from, to));
}

static void scrub(void *room, struct core *core)
{
    const double frame = curves_frame(core, core->input.drag.x);
    (void)room;
    playback_seek(core, core->input.drag.snap ? round(frame) : frame);
}

/// Moves the playhead; with Shift chooses the played range.
static void press_ruler(void *room, struct core *core, const struct hover *hover, const struct event *event)
{
    static const struct drag_owner scrubbing = {.cursor = CURSOR_HORIZONTAL, .move = scrub},
                                   choosing = {.cursor = CURSOR_HORIZONTAL, .move = choose_range, .end = end_range};
    struct curves *curves = room;
    const double frame = curves_frame(core, event->x);
    (void)hover;
    drag_begin(core, event->mods & MOD_SHIFT ? &choosing : &scrubbing, curves, NULL, event);
    memcpy(curves->range_before, core->view.playback.range, sizeof curves->range_before);
    if (!(event->mods & MOD_SHIFT)) playback_seek(core, drag_snaps(core, event->mods) ? round(frame) : frame);
}

static bool find_ruler(void *room, const struct core *core, const struct target *target, float xy[2])
{
    const struct rect *ruler = &core->view.layout.ruler;
    (void)room;
    xy[0] = curves_x(core, target->number[0]);
    xy[1] = ruler->y + ruler->h / 2;
    return rect_contains(*ruler, xy[0], xy[1]);
}

const struct thing thing_ruler = {
    .cursor = CURSOR_HORIZONTAL,
    .hint = "Drag to scrub; Shift+drag to play part of the range, Shift+click to play it all",
    .place = ON_TIME,
    .press = press_ruler,
    .name = "ruler",
    .numbers = 1,
    .find = find_ruler,
    .missing = "that frame is not on the visible part of the ruler"};

static const float REACH = 6;                        ///< pixels at which a mark is hit
static const float RADIUS = 4, ABOVE = 9, BELOW = 6; ///< pixels around a mark on the ruler's lower edge

static void place_pin(const struct core *core, const struct pin *pin, float xy[2])
{
    const struct rect *ruler = &core->view.layout.ruler;
    xy[0] = curves_x(core, document_frame(core->document, document_sample(core->document, pin->frame)));
    xy[1] = ruler->y + ruler->h - 1;
}

struct hover ruler_pins_hover(const struct core *core, float x, float y)
{
    const struct rect *ruler = &core->view.layout.ruler;
    struct hover hover = {.thing = NULL};
    float best = REACH;
    const float edge = ruler->y + ruler->h;
    if (y < edge - ABOVE || y >= edge + BELOW || x < ruler->x || x >= ruler->x + ruler->w) return hover;
    struct pin_place at = PINS_START;
    for (const struct pin *pin; (pin = pins_next(core->document, &at));) {
        float xy[2];
        place_pin(core, pin, xy);
        float distance = fabsf(x - xy[0]);
        if (distance < REACH && core->focus.pin == pin->id) distance = -1;
        if (distance >= best) continue;
        best = distance;
        hover = (struct hover){.thing = &thing_pin_time, .rig = at.rig, .pin = pin->id};
    }
    return hover;
}

static void move_pin_time(void *room, struct core *core)
{
    struct knot_drag *drag = &((struct curves *)room)->knot_drag;
    const struct document *document = core->document;
    int rig;
    const struct pin *pin = pins_selected(core, &rig);
    if (!pin) return;
    struct pin moved = *pin;
    double frame = pin->frame + core->input.drag.moved_x / curves_pixels_per_frame(core);
    if (core->input.drag.snap) frame = round(frame);
    int sample = document_sample(document, frame), last = pins_last_sample(document, document->rigs[rig]);
    sample = sample < 0 ? 0 : sample > last ? last : sample;
    const int there = pins_find(document, document->rigs[rig], pin->point, sample);
    if (there < 0 || document->rigs[rig]->pins[there].id == pin->id)
        drag->free_frame = document_frame(document, sample); // else it stays at the last free frame
    moved.frame = drag->free_frame;
    if (!pins_set(core->document, rig, &moved, &core->step.error)) return;
    playback_seek(core, moved.frame);
    pins_tell(core, rig);
}

/// Selects the pin, goes to its frame and starts dragging it.
static void press_pin_time(void *room, struct core *core, const struct hover *hover, const struct event *event)
{
    struct curves *curves = room;
    static const struct drag_owner owner = {.cursor = CURSOR_HORIZONTAL, .apply = move_pin_time};
    const struct document *document = core->document;
    const struct rig *rig = document->rigs[hover->rig];
    const int at = pins_find_id(rig, hover->pin);
    if (at < 0) return;
    drag_begin(core, &owner, curves, "Move pin in time", event);
    curves->knot_drag = (struct knot_drag){.free_frame = rig->pins[at].frame};
    pins_visit(core, &rig->pins[at]);
}

static bool find_pin_time(void *room, const struct core *core, const struct target *target, float xy[2])
{
    (void)room;
    place_pin(core, target->pin, xy);
    return rect_contains(core->view.layout.ruler, xy[0], xy[1]);
}

/// pintime(tail,0): a pin's mark on the ruler, counted by frame.
const struct thing thing_pin_time = {
    .cursor = CURSOR_MOVE,
    .hint = "Drag to move the pin in time (Ctrl: off frames); Del removes it; Alt+PgUp, Alt+PgDn: by a frame",
    .place = ON_PIN,
    .press = press_pin_time,
    .name = "pintime",
    .of = OF_PIN,
    .numbers = 1,
    .find = find_pin_time,
    .missing = "that pin is not on the visible part of the ruler"};

// Lines and knots.

static const float KNOT_RADIUS = 4.5f, OTHER_RADIUS = 3, HOVER_RADIUS = 7.125f, HANDLE_REACH = 130, HANDLE_RADIUS = 3;
static const double FIRM_LENGTH = 48,
                    DECADE_LENGTH = 12; ///< pixels: a firm handle; longer for ten times the stiffness
static const float MARK_STEP = 12;      ///< columns between marks in a band
static const float MARK_RADIUS = 3.5f;  ///< on the dope sheet
static const float CROWDED = 3;         ///< pixels; closer knots share one mark
static const float FAN_NEAR = 0.24f,
                   FAN_STEP = 0.03f; ///< opacity of the first lagged copy, and how much each further one loses

static void show_line(struct core *core, const float *xy, int count, bool band, float width, uint32_t color)
{
    (band ? drawlist_band : drawlist_line)(&core->list, xy, count, width, color);
}

/// A spline's colour, fainter if it is locked.
static uint32_t color_of(const struct document *document, int spline)
{
    const bool locked = spline >= 0 && spline < document->spline_count && document->splines[spline]->locked;
    return theme_fade(spline_list_color(document, spline), locked ? 0.45f : 1);
}

static bool shows_imaginary(const struct core *core, const struct spline *spline)
{
    return core->view.on[SWITCH_PHASE] && spline_mode(spline) == WIGGLY_COMPLEX && core->view.look != LOOK_CUBIC;
}

/// In painter's order, the active line and the take last.
static void show_lines(struct curves *curves, struct core *core)
{
    const struct document *document = core->document;
    const struct curve_cache *cache = &curves->cache;
    const struct spline *spline = spline_list_seen(core);
    const struct ghost *ghost = &curves->ghost;
    const struct rect plot = core->view.layout.plot;
    uint32_t color = color_of(document, core->focus.active);
    float *xy = curves->scratch;

    // The frames in which the active curve is pushed to a selected knot, as a faint band; in a loop also round the seam.
    const bool winds_up = spline && core->view.look != LOOK_CUBIC && spline_winds_up(document, core->focus.active);
    const bool loops = winds_up && spline_start(spline) == WIGGLY_LOOP;
    const bool rests = winds_up && spline_start(spline) == WIGGLY_REST;
    const double period = document->last_frame - document->first_frame;
    for (int k = 0; winds_up && k < spline->knot_count; k++) {
        const struct knot *knot = &spline->knots[k], *last = &spline->knots[spline->knot_count - 1];
        if (!selection_has(&core->focus.selection, knot->id) || (k == 0 && !loops && !rests)) continue;
        const double frequency =
            core_parameter_at(core, spline, PARAMETER_FREQUENCY, document_sample(document, knot->frame));
        const double before = k > 0   ? spline->knots[k - 1].frame
                              : loops ? last->frame - period
                                      : document->first_frame;
        const double long_ago = spline->parameter[PARAMETER_WIND_UP].value * document->fps / frequency;
        const double from = fmax(before, knot->frame - fmax(long_ago, 1.0 / document->substeps));
        for (int round = 0; round < (from < document->first_frame ? 2 : 1); round++) {
            const double first = fmax(from + round * period, document->first_frame);
            const double end = fmin(knot->frame + round * period, document->last_frame);
            const float x = curves_x(core, first), width = curves_x(core, end) - x;
            drawlist_rect(&core->list, (struct rect){x, plot.y, width, plot.h}, theme_fade(color, 0.07f));
        }
    }
    for (int i = 0; i < cache->other_count && cache->count > 1; i++) {
        const int other = curves_other(curves, document, i);
        const bool hot = core->input.hover.thing == &thing_curve && core->input.hover.spline == other;
        show_line(core, &cache->others[i][0][0], cache->count, cache->other_band[i], 1.25f,
                  theme_fade(color_of(document, other), hot ? 1 : THEME_OTHERS));
    }
    if (spline && cache->count > 1) {
        if (ghost->of && (core->input.drag.owner || core->cleaning.of) && ghost->count > 1) {
            for (int c = 0; c < ghost->count; c++) {
                xy[2 * c] = curves_x(core, ghost->frame[c]);
                xy[2 * c + 1] = curves_y(core, ghost->value[c]);
            }
            show_line(core, xy, ghost->count, ghost->band, 1, theme_fade(theme()->playhead, 0.25f));
        }
        for (int i = cache->fan_count - 1; i >= 0; i--) {
            drawlist_line(&core->list, &cache->fan[i][0][0], cache->count, 1,
                          theme_fade(color, FAN_NEAR - FAN_STEP * (float)i));
        }
        drawlist_dashed(&core->list, &cache->equilibrium[0][0], cache->count, 1.25f, 6, 4, theme()->equilibrium);
        if (shows_imaginary(core, spline))
            show_line(core, &cache->im[0][0], cache->count, cache->band, 1.25f, theme_fade(color, 0.45f));
        show_line(core, &cache->re[0][0], cache->count, cache->band, 2.5f, color);
    }

    // The shown curves as they were before, the active one last.
    for (int i = take_is_shown(core) ? cache->other_count - 1 : -2; i >= -1; i--) {
        const int shown = i < 0 ? core->focus.active : curves_other(curves, document, i);
        if (!spline_list_shows(core, shown)) continue;
        color = i < 0 ? theme()->playhead : spline_list_color(document, shown);
        const struct take *take = &core->take;
        const int before = take_spline(core, shown);
        const struct value_map map = normal_map(curves, core, shown);
        const double by = cache->by * take->document->substeps / document->substeps;
        int count = 0;
        for (int c = 0; c < cache->count && before >= 0; c++) {
            const double frame = frame_of(document, cache->first + cache->by * c);
            const double middle = core_position(take->document, frame);
            if (middle < 0 || middle > take->evaluation.samples - 1) continue;
            const double position = outermost(&take->evaluation, before, middle, by, c % 2);
            const wiggly_value v = evaluation_at(&take->evaluation, before, position);
            xy[2 * count] = curves_x(core, frame);
            xy[2 * count++ + 1] = curves_y(core, map.scale * (v.y + v.re) + map.offset);
        }
        if (count > 1) drawlist_line(&core->list, xy, count, 1.25f, theme_fade(color, i < 0 ? 0.8f : 0.4f));
    }
}

double handle_length(double stiffness)
{
    return fmin(fmax(FIRM_LENGTH + DECADE_LENGTH * maths_log(stiffness / KNOT_DEFAULT_STIFFNESS) / M_LN10, 12), 120);
}

double handle_stiffness(double length)
{
    double stiffness = KNOT_DEFAULT_STIFFNESS * maths_exp(M_LN10 * (length - FIRM_LENGTH) / DECADE_LENGTH);
    return core_round(stiffness, 0.05 * stiffness);
}

void curves_handle(const struct core *core, const struct knot *knot, int end, float xy[2])
{
    double across = curves_pixels_per_frame(core) * core->document->fps; /* pixels a second */
    double down = -curves_pixels_per_value(core) * knot->slope;
    double length = maths_hypot(across, down);
    double factor = (end ? 1 : -1) * handle_length(knot->stiffness) / (isfinite(length) && length > 0 ? length : 1);
    xy[0] = curves_knot_x(core, knot) + (float)fmin(fmax(across * factor, -1e3), 1e3);
    xy[1] = curves_y(core, knot->value) + (float)fmin(fmax(down * factor, -1e3), 1e3);
}

static void hover_ring(struct drawlist *list, const float middle[2])
{
    drawlist_circle(list, middle, HOVER_RADIUS, 1.25f, theme()->playhead);
}

/// A diamond for a value, a circle for a pose, a square for a still pose; filled, or with an outline. Where the motion settles a level line goes
/// through it.
static void knot_mark(struct drawlist *list, const struct knot *knot, const float middle[2], float r, uint32_t color,
                      uint32_t outline)
{
    const float x = middle[0], y = middle[1], s = 0.8f * r;
    const float diamond[] = {x, y - r, x + r, y, x, y + r, x - r, y, x, y - r};
    const float square[] = {x - s, y - s, x + s, y - s, x + s, y + s, x - s, y + s, x - s, y - s};
    const float *xy = knot->still ? square : diamond;
    if (knot->has_phase) {
        drawlist_disc(list, middle, 0.9f * r, color);
        if (outline) drawlist_circle(list, middle, 0.9f * r, 1.5f, outline);
    } else {
        drawlist_convex(list, xy, 4, color);
        if (outline) drawlist_line(list, xy, 5, 1.5f, outline);
    }
    if (knot->settles)
        drawlist_line(list, (const float[]){x - 1.5f * r, y, x + 1.5f * r, y}, 2, 1.5f, outline ? outline : color);
}

static bool is_hovered(const struct core *core, const struct knot *knot)
{
    return core->input.hover.thing == &thing_knot && core->input.hover.knot == knot->id;
}

/// A knot's pixel column, counted from the scene's first frame so that panning does not regroup knots.
static double column_of(const struct core *core, const struct knot *knot)
{
    const double pixels = curves_pixels_per_frame(core) / core->document->substeps; // of a sample
    return floor(document_sample(core->document, knot->frame) * pixels);
}

/// Draws one of the active spline's knots in each pixel column: the hovered, else a selected one.
static void show_active_knots(const struct curves *curves, struct core *core)
{
    const struct document *document = core->document;
    const struct spline *spline = spline_list_seen(core);
    const struct rect *plot = &core->view.layout.plot;
    uint32_t color = color_of(document, core->focus.active);
    if (!spline) return;
    const struct knot *knots = spline->knots;
    int k = curves_knot_from(core, spline, plot->x - HANDLE_REACH);
    for (int end; k < spline->knot_count; k = end) {
        const float x = curves_knot_x(core, &knots[k]);
        const double column = column_of(core, &knots[k]);
        int shown = k;
        if (x > plot->x + plot->w + HANDLE_REACH) break;
        for (end = k + 1; end < spline->knot_count && column_of(core, &knots[end]) == column;) end++;
        for (int i = k; i < end && !is_hovered(core, &knots[shown]); i++) {
            const bool better = selection_has(&core->focus.selection, knots[i].id) &&
                                !selection_has(&core->focus.selection, knots[shown].id);
            if (better || is_hovered(core, &knots[i])) shown = i;
        }
        // In a band most columns get no mark: marks so close would cover each other.
        if (curves->cache.band && !is_hovered(core, &knots[shown]) &&
            !selection_has(&core->focus.selection, knots[shown].id) && fmod(column, MARK_STEP) != 0 && k > 0 &&
            column - column_of(core, &knots[k - 1]) <= MARK_STEP)
            continue;
        if (!curves->cache.band) { // a stroke over the values of all, for those without a mark
            double range[2];
            spline_values(spline, k, end, range);
            const float xy[] = {x, curves_y(core, range[0]), x, curves_y(core, range[1])};
            if (range[1] > range[0]) drawlist_line(&core->list, xy, 2, 1.5f, theme_fade(color, 0.7f));
        }

        // The knot, with its slope: handles if it is selected, or a short stroke in their place.
        const struct knot *knot = &knots[shown];
        const bool selected = selection_has(&core->focus.selection, knot->id);
        float ends[2][2];
        for (int i = 0; i < 2 && knot->has_slope; i++) {
            curves_handle(core, knot, i, ends[i]);
            const float own[2] = {curves_knot_x(core, knot), curves_y(core, knot->value)};
            for (int n = 0; n < 2 && !selected; n++) ends[i][n] = own[n] + 0.3f * (ends[i][n] - own[n]);
        }
        if (knot->has_slope)
            drawlist_line(&core->list, &ends[0][0], 2, selected ? 1 : 1.5f,
                          theme_fade(color, selected ? 0.8f : 0.7f));
        for (int i = 0; i < 2 && knot->has_slope && selected; i++) {
            drawlist_disc(&core->list, ends[i], HANDLE_RADIUS, color);
            if (core->input.hover.thing == &thing_slope && core->input.hover.knot == knot->id &&
                core->input.hover.handle == i)
                hover_ring(&core->list, ends[i]);
        }
        const float middle[2] = {x, curves_knot_y(curves, core, core->focus.active, knot)};
        knot_mark(&core->list, knot, middle, KNOT_RADIUS, selected ? color : theme()->panel,
                  selected ? theme()->playhead : color); // hollow unless selected
        if (is_hovered(core, knot)) hover_ring(&core->list, middle);
    }
}

void knots_show(const struct curves *curves, struct core *core, int s, float row)
{
    const struct spline *spline = core->document->splines[s];
    const struct rect *plot = &core->view.layout.plot;
    const uint32_t full = color_of(core->document, s);
    const bool on_sheet = !isnan(row);
    const float margin = on_sheet ? MARK_RADIUS + 1 : 0;
    float end = -INFINITY; // of the last mark
    for (int k = curves_knot_from(core, spline, plot->x - margin); k < spline->knot_count; k++) {
        const struct knot *knot = &spline->knots[k];
        const bool selected = selection_has(&core->focus.selection, knot->id);
        const float x = curves_knot_x(core, knot);
        if (x < end && !selected && !is_hovered(core, knot)) continue; // where knots are crowded these show
        const float middle[2] = {x, on_sheet ? row : curves_knot_y(curves, core, s, knot)};
        end = x + CROWDED;
        if (x < plot->x - margin) continue;
        if (x > plot->x + plot->w + margin) break;
        knot_mark(&core->list, knot, middle,
                  selected   ? KNOT_RADIUS
                  : on_sheet ? MARK_RADIUS
                             : OTHER_RADIUS,
                  on_sheet || selected ? full : theme_fade(full, THEME_OTHERS), selected ? theme()->playhead : 0);
        if (is_hovered(core, knot)) hover_ring(&core->list, middle);
    }
}

void curves_show(struct curves *curves, struct core *core)
{
    static const char *const looks[] = {[LOOK_WIGGLY] = "", [LOOK_STIFF] = "Stiff", [LOOK_CUBIC] = "Cubic"};
    const struct rect *plot = &core->view.layout.plot, *sheet = &core->view.layout.sheet,
                      *ruler = &core->view.layout.ruler;
    const struct document *document = core->document;
    const struct spline *spline = core_active_spline(core), *visible = spline_list_seen(core);
    struct rect clip = drawlist_push_clip(&core->list, core->view.layout.curves);
    curves_update(curves, core);
    grid_show(core);
    struct rect panel = drawlist_push_clip(&core->list, *plot);
    for (int i = 0; visible && i < 2; i++) {
        const double limit = visible->parameter[i ? PARAMETER_HIGH : PARAMETER_LOW].value;
        if (!isfinite(limit)) continue;
        const bool hot = core->input.hover.thing == &thing_limit && core->input.hover.handle == i;
        const float y = curves_y(core, limit), line[] = {plot->x, y, plot->x + plot->w, y};
        drawlist_dashed(&core->list, line, 2, hot ? 2 : 1.25f, 10, 6,
                        theme_fade(spline_list_color(document, core->focus.active), hot ? 1 : 0.6f));
    }
    show_lines(curves, core);
    for (int i = 0; i < curves->cache.other_count; i++)
        knots_show(curves, core, curves_other(curves, document, i), NAN);
    show_active_knots(curves, core);
    if (!core->input.drag.owner) scale_box_show(curves, core, true); // it would change with every step of a drag
    warnings_update(curves, core);
    warnings_show(curves, core);

    // The hint of an empty panel, unless a swinging equilibrium would be under the text.
    const bool flat = spline && spline->knot_count == 0 &&
                      !param_follows(&spline->parameter[PARAMETER_EQUILIBRIUM]) &&
                      !pins_move_spline(document, core->focus.active);
    if (!visible || flat) {
        const char *hint = spline && !visible ? "This spline is hidden. Click its eye in the list to show it."
                           : flat             ? "Double-click to set the first knot."
                           : rigs_have_bones(core)
                               ? "This scene has no splines. Click a bone and press Shift+J to let it swing."
                               : "This scene has no splines. Click + in the list to add one.";
        const float x = plot->x + (plot->w - font_width(FONT_LABEL, THEME_TEXT_NORMAL, hint)) / 2;
        drawlist_text(&core->list, x, plot->y + 32, FONT_LABEL, THEME_TEXT_NORMAL, theme()->text_dim, hint);
    }
    drawlist_set_clip(&core->list, panel);
    sheet_show(curves, core);

    // Notes above the list, or where that is narrow in the plot: before, look, phase curve, normalised, no snapping.
    const char *normal = core->view.on[SWITCH_NORMALISE] ? "fit" : "",
               *snap = core->view.on[SWITCH_SNAP] ? "" : "free";
    const char *phase = visible && shows_imaginary(core, visible) ? "phase" : "";
    const char *const words[] = {take_is_shown(core) ? "Before" : "", looks[core->view.look], phase, normal, snap};
    char text[48] = "", frame[32];
    for (int i = 0; i < 5; i++) {
        if (*text && *words[i]) strcat(text, ", ");
        strcat(text, words[i]);
    }
    const bool wide = core->view.layout.list.w > 80;
    drawlist_text(&core->list, wide ? core->view.layout.list.x + 10 : plot->x + 28, (wide ? ruler : plot)->y + 15,
                  FONT_LABEL_BOLD, THEME_TEXT_SMALL, theme()->text, text);

    // The playhead comes last, so that playing redraws nothing before it.
    const struct rect tag = playhead_tag(core, frame);
    if (tag.w > 0) {
        const float x = curves_x(core, core_frame(core));
        drawlist_rect(&core->list, (struct rect){x - 0.5f, sheet->y, 1, sheet->h + plot->h}, theme()->playhead);
        drawlist_rounded(&core->list, tag, 3, theme()->playhead);
        drawlist_text(&core->list, tag.x + 5, tag.y + 12, FONT_NUMBER, THEME_TEXT_SMALL, theme()->panel, frame);
    }

    // The pins' marks on the ruler.
    struct pin_place at = PINS_START;
    for (const struct pin *pin; (pin = pins_next(document, &at));) {
        const uint32_t color = pins_color(document, at.rig);
        const bool selected = core->focus.pin == pin->id;
        const bool hot = core->input.hover.thing == &thing_pin_time && core->input.hover.pin == pin->id;
        const float radius = RADIUS + (selected || hot ? 1 : 0);
        float xy[2];
        place_pin(core, pin, xy);
        if (xy[0] < ruler->x || xy[0] > ruler->x + ruler->w) continue;
        drawlist_disc(&core->list, xy, radius, selected ? theme()->playhead : color);
        drawlist_circle(&core->list, xy, radius, 1, selected || hot ? color : theme()->panel);
    }
    drag_show(curves, core);
    warnings_show_words(curves, core);
    drawlist_set_clip(&core->list, clip);
}
