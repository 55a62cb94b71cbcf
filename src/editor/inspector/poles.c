/// The poles of the active spline: the filter's frequency response, the settling time, and the picture for the paper's Figure 2.
#include "editor/inspector/poles.h"
#include "editor/core/core.h"
#include "editor/inspector/state.h"
#include "maths/maths.h"
#include "ui/font.h"
#include "ui/theme.h"
#include <complex.h>
#include <math.h>
#include <stdio.h>

static const double least = 1e-24; // |1 − λ z⁻¹|² at a pole on the circle

static void add_pole(struct filter *filter, double re, double im)
{
    filter->s[filter->count][0] = re;
    filter->s[filter->count][1] = im;
    filter->count++;
}

struct filter filter_of(enum filter_kind kind, double hz, double damping, double bandwidth, double step)
{
    struct filter filter = {.step = step};
    double omega = 2 * M_PI * hz;
    if (kind == FILTER_TWO_REAL && damping > 1) {
        double root = sqrt((damping - 1) * (damping + 1));
        add_pole(&filter, -omega / (damping + root), 0);
        add_pole(&filter, -omega * (damping + root), 0);
        return filter;
    }
    double zeta = fmin(damping, 1), re = -zeta * omega, im = omega * sqrt((1 - zeta) * (1 + zeta));
    double turn = kind == FILTER_TWO_REAL ? 0 : bandwidth * omega;
    add_pole(&filter, re, im + turn);
    if (kind != FILTER_TWO_REAL) add_pole(&filter, re, im - turn);
    if (kind == FILTER_TWO_COMPLEX) return filter;
    for (int i = filter.count; i > 0; i--) add_pole(&filter, filter.s[i - 1][0], -filter.s[i - 1][1]);
    return filter;
}

double filter_decibels(const struct filter *filter, double hz)
{
    double decibels = 0;
    for (int i = 0; i < filter->count; i++) {
        double size = maths_exp(filter->s[i][0] * filter->step);
        double half = 0.5 * (filter->s[i][1] - 2 * M_PI * hz) * filter->step;
        double away = (1 - size) * (1 - size) + 4 * size * maths_sin(half) * maths_sin(half); // |1 − λ z⁻¹|²
        decibels -= 10 / M_LN10 * maths_log(fmax(away, least));
    }
    return decibels;
}

static const double LEFT = 0.05; ///< of the initial displacement
enum { MAX_SAMPLES = 100000 };

struct settling settle_alone(const struct spline *spline, double step)
{
    if (spline_mode(spline) == WIGGLY_CUBIC) return (struct settling){.kind = SETTLE_CUBIC};
    const struct param *p = spline->parameter;
    const bool is_complex = spline_mode(spline) == WIGGLY_COMPLEX;
    if (p[PARAMETER_FREQUENCY].track >= 0 || p[PARAMETER_DAMPING].track >= 0 ||
        (is_complex && p[PARAMETER_BANDWIDTH].track >= 0))
        return (struct settling){.kind = SETTLE_UNKNOWN};
    const struct filter filter =
        filter_of(is_complex ? FILTER_TWO_COMPLEX : FILTER_TWO_REAL, p[PARAMETER_FREQUENCY].value,
                  p[PARAMETER_DAMPING].value, p[PARAMETER_BANDWIDTH].value, step);
    if (p[PARAMETER_FREQUENCY].value == 0) return (struct settling){.kind = SETTLE_CUBIC};
    if (p[PARAMETER_DAMPING].value == 0) return (struct settling){.kind = SETTLE_NEVER};
    double rate = fmin(-filter.s[0][0], -filter.s[1][0]); // of the slower pole
    double expected = maths_log(1 / LEFT) / rate;
    if (expected > SETTLE_LIMIT) return (struct settling){.kind = SETTLE_LATE};
    double samples = 3 * expected / step + 8; // a double pole takes 1.6 times as long as its radius suggests
    bool envelope = is_complex && p[PARAMETER_PASSIVE].value == WIGGLY_OSCILLATOR;
    if (envelope || samples > MAX_SAMPLES) return (struct settling){.kind = SETTLE_ALONE, .seconds = expected};

    // The sample after which the swing stays within LEFT, interpolated linearly. Two equal samples count as standstill half-way between them.
    double complex l[2];
    for (int k = 0; k < 2; k++) {
        const maths_point turn = maths_turn(filter.s[k][1] * step);
        l[k] = maths_exp(filter.s[k][0] * step) * (turn.cos + I * turn.sin);
    }
    const double complex a = l[0] + l[1], b = -l[0] * l[1];
    double complex before = 1, now = is_complex ? a / 2 : 1;
    double size = 1, settled = 0;
    for (int i = 0; i < (int)samples; i++) {
        const double next_size = is_complex ? maths_hypot(creal(now), cimag(now)) : fabs(creal(now));
        if (size > LEFT) settled = next_size < size ? i + fmin(1, (size - LEFT) / (size - next_size)) : i + 1;
        const double complex next = a * now + b * before;
        before = now;
        now = next;
        size = next_size;
    }
    return (struct settling){.kind = SETTLE_ALONE, .seconds = step * (is_complex ? settled : settled - 0.5)};
}

struct settling settle_measure(const struct spline *spline, const wiggly_curve *curve, int last_knot)
{
    struct settling alone = settle_alone(spline, curve->step);
    bool dies = alone.kind != SETTLE_CUBIC && alone.kind != SETTLE_NEVER;
    bool open = spline_start(spline) != WIGGLY_LOOP && curve->mode != WIGGLY_CUBIC && last_knot >= 0 &&
                last_knot + 1 < curve->samples;
    if (open) { // a swing above rounding error follows the last knot
        const double *re = curve->re + last_knot;
        const double size = maths_hypot(re[0], curve->im[last_knot]) + fabs(re[1]);
        open = size > 1e-9 * fabs(curve->total[last_knot]) && size > 0;
    }
    if (!dies || !open) return alone;
    const int end = (int)fmin(curve->samples, (double)last_knot + MAX_SAMPLES);
    const double left = maths_hypot(curve->re[end - 1], curve->im[end - 1]);
    double size = maths_hypot(curve->re[last_knot], curve->im[last_knot]);
    int last = last_knot;
    for (int i = last_knot; curve->mode == WIGGLY_REAL && i < end; i++) size = fmax(size, fabs(curve->re[i]));
    for (int i = last_knot; i < end; i++) {
        if (maths_hypot(curve->re[i], curve->im[i]) > LEFT * size) last = i + 1;
    }
    if (last == end && end < curve->samples) return alone; // too long for one frame, and still swinging there
    if (last == end) return (struct settling){.kind = SETTLE_LEFT, .left = left / size};
    return (struct settling){.kind = SETTLE_SEEN, .seconds = (last - last_knot) * curve->step};
}

enum { COLUMNS = 217, CIRCLE = 112, RESPONSE = 112 };    ///< points of a curve, odd for one at 0 Hz; heights
static const float FLOOR = -60;                          ///< decibels
static const float margin_left = 26, margin_bottom = 15; // of the plot, for its numbers

static void draw_straight(struct drawlist *list, float x0, float y0, float x1, float y1, float width, uint32_t color)
{
    const float xy[] = {x0, y0, x1, y1};
    drawlist_line(list, xy, 2, width, color);
}

static void draw_number(struct drawlist *list, float x, float y, const char *text)
{
    drawlist_text(list, x, y, FONT_NUMBER, THEME_TEXT_SMALL, theme()->text_dim, text);
}

void inspector_poles(struct inspector *in)
{
    static const char *const names[FILTER_KINDS] = {"two-pole real", "four-pole real", "two-pole complex"};
    const struct core *core = in->core;
    const struct spline *spline = core_active_spline(core);
    const int sample = document_sample(core->document, core_frame(core));
    const double hz = spline ? core_parameter_at(core, spline, PARAMETER_FREQUENCY, sample) : 0;
    if (!(hz > 0) || spline_mode(spline) == WIGGLY_CUBIC) {
        ui_paragraph(&in->ui, "Both poles are at 1 (frequency 0): a cubic does not swing.", theme()->text_dim);
        return;
    }
    ui_space(&in->ui, 4);
    const struct rect top = ui_row(&in->ui, CIRCLE), below = ui_row(&in->ui, RESPONSE);
    ui_space(&in->ui, 4);
    if (in->ui.pass != UI_PASS_DRAW) return;
    const double step = document_step(core->document), span = fmin(0.5 / step, 3 * hz),
                 damping = core_parameter_at(core, spline, PARAMETER_DAMPING, sample),
                 bandwidth = core_parameter_at(core, spline, PARAMETER_BANDWIDTH, sample);
    const enum filter_kind own = spline_mode(spline) == WIGGLY_REAL ? FILTER_TWO_REAL : FILTER_TWO_COMPLEX;
    const struct rect plot = {below.x + margin_left, below.y + 4, below.w - margin_left, below.h - margin_bottom - 4};
    struct drawlist *list = in->ui.list;
    char text[32];

    // The axes: decibels, and frequencies from −span to span.
    for (int db = 0; db >= (int)FLOOR; db -= 20) {
        const float y = plot.y + plot.h * (float)db / FLOOR;
        draw_straight(list, plot.x, y, plot.x + plot.w, y, 1, theme()->grid_major);
        snprintf(text, sizeof text, "%d", db);
        draw_number(list, plot.x - 6 - font_width(FONT_NUMBER, THEME_TEXT_SMALL, text), y + 4, text);
    }
    for (int side = -1; side <= 1; side++) {
        const float x = plot.x + plot.w / 2 * (1 + (float)side * (float)(hz / span));
        if (x < plot.x || x > plot.x + plot.w) continue;
        snprintf(text, sizeof text, side ? "%.3g Hz" : "0", side * hz);
        const float width = font_width(FONT_NUMBER, THEME_TEXT_SMALL, text);
        draw_straight(list, x, plot.y, x, plot.y + plot.h, 1, side ? theme()->grid_major : theme()->zero);
        draw_number(list, fmaxf(plot.x, fminf(plot.x + plot.w - width, x - width / 2)),
                    plot.y + plot.h + margin_bottom - 2, text);
    }
    for (int i = 1; i <= FILTER_KINDS; i++) { // its own last, on top
        static const int spare[FILTER_KINDS] = {1, 2, 1};
        const enum filter_kind kind = (enum filter_kind)(((int)own + i) % (int)FILTER_KINDS);
        const bool is_own = kind == own;
        const uint32_t color = is_own ? theme()->accent : theme()->spline[spare[kind]],
                       text_color = is_own ? theme()->text : theme()->text_dim;
        const float x = top.x + CIRCLE + UI_GAP, y = top.y + 20 + 33 * (float)((int)kind);
        const struct filter filter = filter_of(kind, hz, damping, bandwidth, step);

        // Its response below the peak, which may be narrower than a column.
        float xy[COLUMNS][2], peak = -INFINITY;
        for (int c = 0; c < COLUMNS; c++) {
            xy[c][0] = plot.x + plot.w * (float)c / (COLUMNS - 1);
            xy[c][1] = (float)filter_decibels(&filter, span * (2.0 * c / (COLUMNS - 1) - 1));
            peak = fmaxf(peak, xy[c][1]);
        }
        for (int p = 0; p < filter.count; p++)
            peak = fmaxf(peak, (float)filter_decibels(&filter, filter.s[p][1] / (2 * M_PI)));
        snprintf(text, sizeof text, "%.0f dB at 0 Hz", (double)(xy[COLUMNS / 2][1] - peak));
        for (int c = 0; c < COLUMNS; c++) xy[c][1] = plot.y + plot.h * fmaxf(xy[c][1] - peak, 2 * FLOOR) / FLOOR;
        const struct rect old = drawlist_push_clip(list, (struct rect){plot.x, plot.y - 2, plot.w, plot.h + 2});
        drawlist_line(list, xy[0], COLUMNS, is_own ? 2 : 1.25f, color);
        drawlist_set_clip(list, old);
        drawlist_rounded(list, (struct rect){x, y - 8, 3, 24}, 1.5f, color);
        drawlist_text(list, x + 9, y, is_own ? FONT_LABEL_BOLD : FONT_LABEL, THEME_TEXT_SMALL, text_color,
                      names[kind]);
        drawlist_text(list, x + 9, y + 14, FONT_NUMBER, THEME_TEXT_SMALL, text_color, text);
    }

    // The unit circle with its poles.
    const struct filter filter = filter_of(own, hz, damping, bandwidth, step);
    const float radius = top.h / 2 - 6, cx = top.x + top.h / 2, cy = top.y + top.h / 2;
    draw_straight(list, cx - radius - 5, cy, cx + radius + 5, cy, 1, theme()->grid_major);
    draw_straight(list, cx, cy - radius - 5, cx, cy + radius + 5, 1, theme()->grid_major);
    drawlist_rounded_line(list, (struct rect){cx - radius, cy - radius, 2 * radius, 2 * radius}, radius, 1.25f,
                          theme()->equilibrium);
    for (int i = 0; i < filter.count; i++) {
        const double size = radius * maths_exp(filter.s[i][0] * step), angle = filter.s[i][1] * step;
        const float x = cx + (float)(size * maths_cos(angle)), y = cy - (float)(size * maths_sin(angle));
        draw_straight(list, x - 3, y - 3, x + 3, y + 3, 1.75f, theme()->accent);
        draw_straight(list, x - 3, y + 3, x + 3, y - 3, 1.75f, theme()->accent);
    }
}
