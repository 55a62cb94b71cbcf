/// Draws the curves panel: lines, knots, slope handles, names, playhead.
#include "editor/core/core.h"
#include "editor/core/rigs.h"
#include "editor/core/selection.h"
#include "editor/curves/state.h"
#include "maths/maths.h"
#include "scene/pins.h"
#include "scene/warnings.h"
#include "ui/font.h"
#include "ui/theme.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { MAX_LABELS = CURVES_MAX_OTHERS + 2 };

static const float KNOT_RADIUS = 4.5f, OTHER_RADIUS = 3, HOVER_RADIUS = 7.125f, HANDLE_REACH = 130, HANDLE_RADIUS = 3;
static const double FIRM_LENGTH = 48,
                    DECADE_LENGTH = 12; ///< pixels: a firm handle; longer for ten times the stiffness
static const float MARK_STEP = 12;      ///< columns between marks in a band
static const float MARK_RADIUS = 3.5f;  ///< on the dope sheet
static const float CROWDED = 3;         ///< pixels; closer knots share one mark
static const float LABEL_STEP = 15;
static const float FAN_NEAR = 0.24f,
                   FAN_STEP = 0.03f; ///< opacity of the first lagged copy, and how much each further one loses

/// A name beside the right end of its curve.
struct label {
    float y;
    enum font font;
    uint32_t color;
    const char *text;
};

static void show_line(struct core *core, const float *xy, int count, bool band, float width, uint32_t color)
{
    if (band) {
        drawlist_band(&core->list, xy, count, width, color);
    } else {
        drawlist_line(&core->list, xy, count, width, color);
    }
}

static void show_ghost(struct curves *curves, struct core *core)
{
    const struct ghost *ghost = &curves->ghost;
    if (!ghost->is_shown || !core->drag.owner || ghost->count < 2) return;
    float *xy = curves->scratch;
    for (int c = 0; c < ghost->count; c++) {
        xy[2 * c] = curves_x(curves, core, ghost->frame[c]);
        xy[2 * c + 1] = curves_y(curves, core, ghost->value[c]);
    }
    show_line(core, xy, ghost->count, ghost->band, 1, theme_fade(theme()->playhead, 0.25f));
}

/// The shown curves as they were before, the active one last.
static void show_take(struct curves *curves, struct core *core)
{
    if (!take_is_shown(core)) return;
    for (int i = curves->cache.other_count - 1; i >= -1; i--) {
        const int spline = i < 0 ? core->active : curves->cache.other_spline[i];
        const uint32_t color = i < 0 ? theme()->playhead : spline_list_color(core->document, spline);
        if (!spline_list_shows(core, spline)) continue;
        const int count = take_line(curves, core, spline, curves->scratch);
        if (count > 1)
            drawlist_line(&core->list, curves->scratch, count, 1.25f, theme_fade(color, i < 0 ? 0.8f : 0.4f));
    }
}

static bool shows_imaginary(const struct core *core, const struct spline *spline)
{
    return core->curves.phase && spline_mode(spline) == WIGGLY_COMPLEX && core->look != LOOK_CUBIC;
}

/// The frames in which the active curve is pushed to a selected knot, as a faint band; in a loop also round the seam.
static void show_wind_up(const struct curves *curves, struct core *core)
{
    const struct document *document = core->document;
    const struct spline *spline = spline_list_seen(core);
    const struct rect plot = core->layout.plot;
    if (!spline || core->look == LOOK_CUBIC || !spline_winds_up(document, core->active)) return;
    const uint32_t color = theme_fade(spline_list_color(document, core->active), 0.07f);
    const double period = document->last_frame - document->first_frame;
    const bool loops = spline_start(spline) == WIGGLY_LOOP, rests = spline_start(spline) == WIGGLY_REST;
    for (int k = 0; k < spline->knot_count; k++) {
        const struct knot *knot = &spline->knots[k], *last = &spline->knots[spline->knot_count - 1];
        if (!selection_has(&core->selection, knot->id) || (k == 0 && !loops && !rests)) continue;
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
            const float x = curves_x(curves, core, first);
            drawlist_rect(&core->list, (struct rect){x, plot.y, curves_x(curves, core, end) - x, plot.h}, color);
        }
    }
}

/// In painter's order, the active line last.
static void show_lines(struct curves *curves, struct core *core)
{
    const struct curve_cache *cache = &curves->cache;
    const struct spline *spline = spline_list_seen(core);
    uint32_t color = spline_list_color(core->document, core->active);
    if (cache->count < 2) return;
    for (int i = 0; i < cache->other_count; i++) {
        const bool hot = core->hover.thing == &thing_curve && core->hover.spline == cache->other_spline[i];
        show_line(core, &cache->others[i][0][0], cache->count, cache->other_band[i], 1.25f,
                  theme_fade(spline_list_color(core->document, cache->other_spline[i]), hot ? 1 : THEME_OTHERS));
    }
    if (!spline) return;
    show_ghost(curves, core);
    for (int i = cache->fan_count - 1; i >= 0; i--) {
        drawlist_line(&core->list, &cache->fan[i][0][0], cache->count, 1,
                      theme_fade(color, FAN_NEAR - FAN_STEP * (float)i));
    }
    drawlist_dashed(&core->list, &cache->equilibrium[0][0], cache->count, 1.25f, 6, 4, theme()->equilibrium);
    if (shows_imaginary(core, spline))
        show_line(core, &cache->im[0][0], cache->count, cache->band, 1.25f, theme_fade(color, 0.45f));
    show_line(core, &cache->re[0][0], cache->count, cache->band, 2.5f, color);
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

void curves_handle(const struct curves *curves, const struct core *core, const struct knot *knot, int end,
                   float xy[2])
{
    double across = curves_pixels_per_frame(curves, core) * core->document->fps; /* pixels a second */
    double down = -curves_pixels_per_value(curves, core) * knot->slope;
    double length = maths_hypot(across, down);
    double factor = (end ? 1 : -1) * handle_length(knot->stiffness) / (isfinite(length) && length > 0 ? length : 1);
    xy[0] = curves_knot_x(curves, core, knot) + (float)fmin(fmax(across * factor, -1e3), 1e3);
    xy[1] = curves_y(curves, core, knot->value) + (float)fmin(fmax(down * factor, -1e3), 1e3);
}

static void hover_ring(struct drawlist *list, float x, float y)
{
    drawlist_circle(list, (const float[2]){x, y}, HOVER_RADIUS, 1.25f, theme()->playhead);
}

static void show_handle(const struct curves *curves, struct core *core, const struct knot *knot, uint32_t color)
{
    float ends[2][2];
    curves_handle(curves, core, knot, 0, ends[0]);
    curves_handle(curves, core, knot, 1, ends[1]);
    drawlist_line(&core->list, &ends[0][0], 2, 1, theme_fade(color, 0.8f));
    for (int end = 0; end < 2; end++) {
        drawlist_disc(&core->list, ends[end], HANDLE_RADIUS, color);
        if (core->hover.thing == &thing_slope && core->hover.knot == knot->id && core->hover.handle == end)
            hover_ring(&core->list, ends[end][0], ends[end][1]);
    }
}

/// A diamond for a value, a circle for a pose, a square for a still pose; filled, or with an outline. Where the motion settles a level line goes
/// through it.
static void knot_mark(struct drawlist *list, const struct knot *knot, float x, float y, float r, uint32_t color,
                      uint32_t outline)
{
    const float s = 0.8f * r;
    const float diamond[] = {x, y - r, x + r, y, x, y + r, x - r, y, x, y - r};
    const float square[] = {x - s, y - s, x + s, y - s, x + s, y + s, x - s, y + s, x - s, y - s};
    const float *xy = knot->still ? square : diamond;
    if (knot->has_phase) {
        drawlist_disc(list, (const float[]){x, y}, 0.9f * r, color);
        if (outline) drawlist_circle(list, (const float[]){x, y}, 0.9f * r, 1.5f, outline);
    } else {
        drawlist_convex(list, xy, 4, color);
        if (outline) drawlist_line(list, xy, 5, 1.5f, outline);
    }
    if (knot->settles)
        drawlist_line(list, (const float[]){x - 1.5f * r, y, x + 1.5f * r, y}, 2, 1.5f, outline ? outline : color);
}

/// A short stroke in place of a slope handle.
static void show_tick(const struct curves *curves, struct core *core, const struct knot *knot, uint32_t color)
{
    float ends[2][2], x = curves_knot_x(curves, core, knot);
    float y = curves_y(curves, core, knot->value);
    for (int end = 0; end < 2; end++) {
        curves_handle(curves, core, knot, end, ends[end]);
        ends[end][0] = x + 0.3f * (ends[end][0] - x);
        ends[end][1] = y + 0.3f * (ends[end][1] - y);
    }
    drawlist_line(&core->list, &ends[0][0], 2, 1.5f, theme_fade(color, 0.7f));
}

static bool is_hovered(const struct core *core, const struct knot *knot)
{
    return core->hover.thing == &thing_knot && core->hover.knot == knot->id;
}

/// The next knot to draw where knots are crowded: a selected or hovered one, or the first at least `gap` pixels away.
static int crowd_next(const struct curves *curves, const struct core *core, int spline, int knot, float gap)
{
    const struct spline *of = core->document->splines[spline];
    const float end = curves_knot_x(curves, core, &of->knots[knot]) + gap;
    for (int next = knot + 1; next < of->knot_count; next++) {
        const struct knot *other = &of->knots[next];
        if (curves_knot_x(curves, core, other) >= end) return next;
        if (is_hovered(core, other) || selection_has(&core->selection, other->id)) return next;
    }
    return of->knot_count;
}

/// Of the knots first … end − 1 in one pixel column, the one to draw: hovered, else selected.
static int column_knot(const struct core *core, const struct knot *knots, int first, int end)
{
    int shown = first;
    for (int k = first; k < end; k++) {
        if (is_hovered(core, &knots[k])) return k;
        if (!selection_has(&core->selection, knots[shown].id) && selection_has(&core->selection, knots[k].id))
            shown = k;
    }
    return shown;
}

/// A knot's pixel column, counted from the scene's first frame so that panning does not regroup knots.
static double column_of(const struct curves *curves, const struct core *core, const struct knot *knot)
{
    const double pixels = curves_pixels_per_frame(curves, core) / core->document->substeps; // of a sample
    return floor(document_sample(core->document, knot->frame) * pixels);
}

/// A vertical stroke over the values of all knots in one pixel column, for those without a mark.
static void show_column(const struct curves *curves, struct core *core, int first, int end, float x, uint32_t color)
{
    double range[2];
    spline_values(core->document->splines[core->active], first, end, range);
    const float xy[] = {x, curves_y(curves, core, range[0]), x, curves_y(curves, core, range[1])};
    if (range[1] > range[0]) drawlist_line(&core->list, xy, 2, 1.5f, theme_fade(color, 0.7f));
}

static void show_knot(const struct curves *curves, struct core *core, const struct knot *knot, float x,
                      uint32_t color)
{
    bool selected = selection_has(&core->selection, knot->id);
    float y = curves_knot_y(curves, core, core->active, knot);
    if (knot->has_slope && selected) show_handle(curves, core, knot, color);
    if (knot->has_slope && !selected) show_tick(curves, core, knot, color);
    knot_mark(&core->list, knot, x, y, KNOT_RADIUS, selected ? color : theme()->panel,
              selected ? theme()->playhead : color); // hollow unless selected
    if (is_hovered(core, knot)) hover_ring(&core->list, x, y);
}

/// Whether a column of knots in a band gets no mark, because marks so close would cover each other.
static bool is_lost(const struct curves *curves, const struct core *core, int first, int shown)
{
    const struct knot *knots = core->document->splines[core->active]->knots;
    const double column = column_of(curves, core, &knots[first]);
    if (!curves->cache.band || is_hovered(core, &knots[shown]) || selection_has(&core->selection, knots[shown].id))
        return false;
    const bool alone = first == 0 || column - column_of(curves, core, &knots[first - 1]) > MARK_STEP;
    return !alone && fmod(column, MARK_STEP) != 0;
}

static void show_knots(const struct curves *curves, struct core *core)
{
    const struct document *document = core->document;
    const struct spline *spline = spline_list_seen(core);
    const struct rect *plot = &core->layout.plot;
    uint32_t color = spline_list_color(document, core->active);
    if (!spline) return;
    int k = curves_knot_from(curves, core, spline, plot->x - HANDLE_REACH);
    for (int end; k < spline->knot_count; k = end) {
        const float x = curves_knot_x(curves, core, &spline->knots[k]);
        const double column = column_of(curves, core, &spline->knots[k]);
        if (x > plot->x + plot->w + HANDLE_REACH) break;
        end = k + 1;
        while (end < spline->knot_count && column_of(curves, core, &spline->knots[end]) == column) end++;
        const int shown = column_knot(core, spline->knots, k, end);
        if (is_lost(curves, core, k, shown)) continue;
        if (!curves->cache.band) show_column(curves, core, k, end, x, color);
        show_knot(curves, core, &spline->knots[shown], x, color);
    }
}

void knots_show(const struct curves *curves, struct core *core, int s, float row)
{
    const struct spline *spline = core->document->splines[s];
    const struct rect *plot = &core->layout.plot;
    const uint32_t full = spline_list_color(core->document, s);
    const bool on_sheet = !isnan(row);
    const float margin = on_sheet ? MARK_RADIUS + 1 : 0;
    int k = curves_knot_from(curves, core, spline, plot->x - margin);
    for (; k < spline->knot_count; k = crowd_next(curves, core, s, k, CROWDED)) {
        const struct knot *knot = &spline->knots[k];
        const bool selected = selection_has(&core->selection, knot->id);
        const float x = curves_knot_x(curves, core, knot);
        const float y = on_sheet ? row : curves_knot_y(curves, core, s, knot);
        if (x < plot->x - margin) continue;
        if (x > plot->x + plot->w + margin) break;
        knot_mark(&core->list, knot, x, y,
                  selected   ? KNOT_RADIUS
                  : on_sheet ? MARK_RADIUS
                             : OTHER_RADIUS,
                  on_sheet || selected ? full : theme_fade(full, THEME_OTHERS), selected ? theme()->playhead : 0);
        if (is_hovered(core, knot)) hover_ring(&core->list, x, y);
    }
}

static void insert_label(struct label *labels, int *count, struct label label)
{
    int i = (*count)++;
    for (; i > 0 && labels[i - 1].y > label.y; i--) labels[i] = labels[i - 1];
    labels[i] = label;
}

/// Moves labels apart: downwards, then back up from the panel's bottom.
static void spread_labels(struct label *labels, int count, float top, float bottom)
{
    for (int i = 0; i < count; i++) labels[i].y = fmaxf(labels[i].y, i ? labels[i - 1].y + LABEL_STEP : top);
    float limit = bottom;
    for (int i = count - 1; i >= 0; i--, limit -= LABEL_STEP) labels[i].y = fminf(labels[i].y, limit);
}

/// A spline's colour with enough contrast for text.
static uint32_t label_color(const struct core *core, int spline)
{
    return theme_readable(spline_list_color(core->document, spline), theme()->panel, 4.5f);
}

/// Labels of at most `most` drawn curves, the active one always among them, sorted by height. Returns how many.
static int place_labels(const struct curves *curves, const struct core *core, struct label *labels, int most)
{
    const struct curve_cache *cache = &curves->cache;
    const struct spline *active = spline_list_seen(core);
    uint32_t color = label_color(core, core->active);
    int count = 0, end = cache->count - 1;
    if (active) {
        insert_label(labels, &count, (struct label){cache->re[end][1], FONT_LABEL_BOLD, color, active->name});
    }
    if (active && shows_imaginary(core, active)) {
        insert_label(labels, &count, (struct label){cache->im[end][1], FONT_LABEL, color, "phase"});
    }
    for (int i = 0; i < cache->other_count && count < most; i++) {
        int spline = cache->other_spline[i];
        insert_label(labels, &count,
                     (struct label){cache->others[i][end][1], FONT_LABEL, label_color(core, spline),
                                    core->document->splines[spline]->name});
    }
    return count;
}

static void show_labels(const struct curves *curves, struct core *core)
{
    const struct rect *plot = &core->layout.plot;
    struct label labels[MAX_LABELS];
    if (curves->cache.count < 2) return;
    const float top = plot->y + 8, bottom = plot->y + plot->h - 8;
    int most = (int)fmaxf(2, (bottom - top) / LABEL_STEP + 1);
    int count = place_labels(curves, core, labels, most);
    spread_labels(labels, count, top, bottom);
    float x = plot->x + plot->w + 6;
    float width = core->layout.curves.x + core->layout.curves.w - 6 - x;
    for (int i = 0; i < count; i++) {
        drawlist_text_fit(&core->list, x, roundf(labels[i].y + 4), width, labels[i].font, THEME_TEXT_SMALL,
                          labels[i].color, labels[i].text);
    }
}

static void tag_text(const struct core *core, char text[32])
{
    double frame = round(core_frame(core)) + 0.0; /* the one that I would insert at */
    snprintf(text, 32, core->curves.seconds ? "%.2f" : "%.0f",
             core->curves.seconds ? frame / core->document->fps : frame);
}

struct rect playhead_tag(const struct curves *curves, const struct core *core)
{
    const struct rect *ruler = &core->layout.ruler;
    float x = curves_x(curves, core, core_frame(core));
    if (x < ruler->x || x > ruler->x + ruler->w) return (struct rect){0};
    char text[32];
    tag_text(core, text);
    float width = roundf(font_width(FONT_NUMBER, THEME_TEXT_SMALL, text)) + 10;
    float left = fminf(fmaxf(roundf(x - width / 2), ruler->x), ruler->x + ruler->w - width);
    return (struct rect){left, ruler->y + 3, width, 16};
}

/// Drawn separately, so that playing redraws nothing else.
static void show_playhead(const struct curves *curves, struct core *core)
{
    const struct rect *plot = &core->layout.plot, *sheet = &core->layout.sheet;
    float x = curves_x(curves, core, core_frame(core));
    const struct rect tag = playhead_tag(curves, core);
    if (tag.w <= 0) return;
    char text[32];
    tag_text(core, text);
    drawlist_rect(&core->list, (struct rect){x - 0.5f, sheet->y, 1, sheet->h + plot->h}, theme()->playhead);
    drawlist_rounded(&core->list, tag, 3, theme()->playhead);
    drawlist_text(&core->list, tag.x + 5, tag.y + 12, FONT_NUMBER, THEME_TEXT_SMALL, theme()->panel, text);
}

/// The hint of an empty panel, unless a swinging equilibrium would be under the text.
static void show_empty(struct core *core)
{
    const struct spline *spline = core_active_spline(core);
    bool flat = spline && spline->knot_count == 0 && !param_follows(&spline->parameter[PARAMETER_EQUILIBRIUM]) &&
                !pins_move_spline(core->document, core->active);
    bool hidden = spline && !spline_list_seen(core);
    if (spline && !flat && !hidden) return;
    const bool has_bones = rigs_have_bones(core);
    const char *text = hidden      ? "This spline is hidden. Click its eye in the list (F9: More) to show it."
                       : flat      ? "Double-click to set the first knot."
                       : has_bones ? "This scene has no splines. Click a bone and press Shift+J to let it swing."
                                   : "This scene has no splines. Click + in the list on the right to add one.";
    const struct rect *plot = &core->layout.plot;
    float x = plot->x + (plot->w - font_width(FONT_LABEL, THEME_TEXT_NORMAL, text)) / 2;
    drawlist_text(&core->list, x, plot->y + 32, FONT_LABEL, THEME_TEXT_NORMAL, theme()->text_dim, text);
}

/// Notes above the curves' names: before (K), phase curve (V), normalised (N), no snapping (G).
static void show_state(struct core *core)
{
    static const char *const looks[] = {[LOOK_WIGGLY] = "", [LOOK_STIFF] = "Stiff", [LOOK_CUBIC] = "Cubic"};
    const struct rect *ruler = &core->layout.ruler;
    const char *normal = core->curves.normalise ? "fit" : "", *snap = core->no_snap ? "free" : "";
    const char *const words[] = {take_is_shown(core) ? "Before" : "", looks[core->look], normal, snap};
    char text[40] = "";
    for (int i = 0; i < 4; i++) {
        if (*text && *words[i]) strcat(text, ", ");
        strcat(text, words[i]);
    }
    drawlist_text(&core->list, ruler->x + ruler->w + 6, ruler->y + 15, FONT_LABEL_BOLD, THEME_TEXT_SMALL,
                  theme()->text, text);
}

void curves_show(struct curves *curves, struct core *core)
{
    struct rect clip = drawlist_push_clip(&core->list, core->layout.curves);
    curves_update(curves, core);
    grid_show(curves, core);
    struct rect panel = drawlist_push_clip(&core->list, core->layout.plot);
    limits_show(curves, core);
    show_wind_up(curves, core);
    show_lines(curves, core);
    show_take(curves, core);
    for (int i = 0; i < curves->cache.other_count; i++) {
        knots_show(curves, core, curves->cache.other_spline[i], NAN);
    }
    show_knots(curves, core);
    if (!core->drag.owner) scale_box_show(curves, core, true); // it would change with every step of a drag
    warnings_update(curves, core);
    warnings_show(curves, core);
    show_empty(core);
    drawlist_set_clip(&core->list, panel);
    sheet_show(curves, core);
    show_state(core);
    show_labels(curves, core);
    show_playhead(curves, core);
    ruler_pins_show(curves, core);
    drag_show(curves, core);
    warnings_show_words(curves, core);
    drawlist_set_clip(&core->list, clip);
}
