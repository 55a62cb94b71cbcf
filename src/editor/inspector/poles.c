/// The poles of the active spline: the filter's frequency response, the settling time of a spline, and the section that shows and drags them.
#include "editor/inspector/poles.h"
#include "editor/core/core.h"
#include "editor/core/view.h"
#include "editor/inspector/state.h"
#include "maths/maths.h"
#include "ui/font.h"
#include "ui/theme.h"
#include <complex.h>
#include <math.h>
#include <stdio.h>

enum { SCAN = 512, BISECTIONS = 60 };
static const double half_power = 3.0102999566398120; // dB, 10 log₁₀ 2
static const double least = 1e-24;                   // |1 − λ z⁻¹|² at a pole on the circle
static const double golden = 0.6180339887498949;

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

/// Where the response falls below a level between `inside` (above it) and `outside`.
static double crossing(const struct filter *filter, double inside, double outside, double level)
{
    if (filter_decibels(filter, outside) >= level) return outside;
    for (int i = 0; i < BISECTIONS; i++) {
        double middle = 0.5 * (inside + outside);
        if (filter_decibels(filter, middle) >= level) {
            inside = middle;
        } else {
            outside = middle;
        }
    }
    return 0.5 * (inside + outside);
}

struct passband filter_passband(const struct filter *filter)
{
    // The peak lies near a pole or between two, so a grid and the poles themselves bracket it.
    double nyquist = 0.5 / filter->step, spacing = nyquist / SCAN, best = 0;
    for (int i = 1; i <= SCAN; i++) {
        if (filter_decibels(filter, i * spacing) > filter_decibels(filter, best)) best = i * spacing;
    }
    for (int i = 0; i < filter->count; i++) {
        double hz = filter->s[i][1] / (2 * M_PI);
        if (hz < 0 || hz > nyquist || filter_decibels(filter, hz) <= filter_decibels(filter, best)) continue;
        best = hz;
        spacing = fmax(fabs(filter->s[i][0]) / (2 * M_PI), 1e-9 * nyquist);
    }
    double low = fmax(0, best - spacing), high = fmin(nyquist, best + spacing);
    for (int i = 0; i < BISECTIONS; i++) { // golden-section search
        double a = high - golden * (high - low), b = low + golden * (high - low);
        if (filter_decibels(filter, a) < filter_decibels(filter, b)) {
            low = a;
        } else {
            high = b;
        }
    }
    const double refined = 0.5 * (low + high);
    low = high = filter_decibels(filter, refined) > filter_decibels(filter, best) ? refined : best;
    struct passband band = {.peak = filter_decibels(filter, low)};
    band.zero = filter_decibels(filter, 0) - band.peak;
    double level = band.peak - half_power;
    for (int i = 0; i < filter->count; i++) { // with a large bandwidth the response dips between the poles
        double hz = filter->s[i][1] / (2 * M_PI);
        if (hz < 0 || hz > nyquist || filter_decibels(filter, hz) < level) continue;
        low = fmin(low, hz);
        high = fmax(high, hz);
    }
    band.width = crossing(filter, high, nyquist, level) - crossing(filter, low, 0, level);
    return band;
}

static const double LEFT = 0.05; ///< of the initial displacement
enum { MAX_SAMPLES = 100000 };

/// The sample after which the swing stays within LEFT, of the first `count`, interpolated linearly. Two equal samples count as standstill
/// half-way between them.
static double settled_sample(const struct filter *filter, bool is_complex, int count)
{
    const double(*s)[2] = filter->s;
    double complex l[2];
    for (int k = 0; k < 2; k++) {
        const maths_point turn = maths_turn(s[k][1] * filter->step);
        l[k] = maths_exp(s[k][0] * filter->step) * (turn.cos + I * turn.sin);
    }
    double complex a = l[0] + l[1], b = -l[0] * l[1];
    double complex before = 1, now = is_complex ? a / 2 : 1;
    double size = 1, settled = 0;
    for (int i = 0; i < count; i++) {
        double next_size = is_complex ? maths_hypot(creal(now), cimag(now)) : fabs(creal(now));
        if (size > LEFT) settled = next_size < size ? i + fmin(1, (size - LEFT) / (size - next_size)) : i + 1;
        double complex next = a * now + b * before;
        before = now;
        now = next;
        size = next_size;
    }
    return is_complex ? settled : settled - 0.5;
}

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
    double seconds = step * settled_sample(&filter, is_complex, (int)samples);
    return (struct settling){.kind = SETTLE_ALONE, .seconds = seconds};
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

static const float floor_decibels = -60;
static const float margin_left = 26, margin_bottom = 15; // of a plot, for its numbers

static const char *const filter_name[FILTER_KINDS] = {"two-pole real", "four-pole real", "two-pole complex"};

/// Maps frequency and damping ratio to the inset. Values near 0, where damping matters most, are spread out.
static float poles_x(const struct poles_view *view, struct rect inset, double hz)
{
    return inset.x + inset.w * (float)(hz / view->reach);
}

static float poles_y(const struct poles_view *view, struct rect inset, double damping)
{
    return inset.y + inset.h * (1 - (float)sqrt(fmin(1, damping / view->top)));
}

static void draw_cross(struct drawlist *list, float x, float y, float arm, uint32_t color)
{
    const float falling[] = {x - arm, y - arm, x + arm, y + arm}, rising[] = {x - arm, y + arm, x + arm, y - arm};
    drawlist_line(list, falling, 2, 1.75f, color);
    drawlist_line(list, rising, 2, 1.75f, color);
}

static void draw_straight(struct drawlist *list, float x0, float y0, float x1, float y1, uint32_t color)
{
    const float xy[] = {x0, y0, x1, y1};
    drawlist_line(list, xy, 2, 1, color);
}

/// The current filter has the accent colour.
static uint32_t filter_color(const struct poles_view *view, enum filter_kind kind)
{
    static const int spare[FILTER_KINDS] = {1, 2, 1};
    return view->setting.kind == kind ? theme()->accent : theme()->spline[spare[kind]];
}

/// The unit circle with the filter's poles; beside it name, response at zero frequency and width of the three filters.
static void draw_overview(const struct poles_view *view, struct rect r, struct rect legend, struct drawlist *list)
{
    const struct pole_setting *setting = &view->setting;
    enum { POINTS = 65 };
    float radius = fminf(r.w, r.h) / 2 - 6, cx = r.x + r.w / 2, cy = r.y + r.h / 2, circle[POINTS][2];
    for (int i = 0; i < POINTS; i++) {
        double angle = 2 * M_PI * (i % (POINTS - 1)) / (POINTS - 1);
        circle[i][0] = cx + radius * (float)maths_cos(angle);
        circle[i][1] = cy - radius * (float)maths_sin(angle);
    }
    draw_straight(list, cx - radius - 5, cy, cx + radius + 5, cy, theme()->grid_major);
    draw_straight(list, cx, cy - radius - 5, cx, cy + radius + 5, theme()->grid_major);
    drawlist_line(list, circle[0], POINTS, 1.25f, theme()->equilibrium);
    struct filter filter = filter_of(setting->kind, setting->hz, setting->damping, setting->bandwidth, setting->step);
    for (int i = 0; i < filter.count; i++) {
        double size = radius * maths_exp(filter.s[i][0] * setting->step), angle = filter.s[i][1] * setting->step;
        draw_cross(list, cx + (float)(size * maths_cos(angle)), cy - (float)(size * maths_sin(angle)), 3,
                   theme()->accent);
    }

    static const enum filter_kind order[FILTER_KINDS] = {FILTER_TWO_COMPLEX, FILTER_TWO_REAL, FILTER_FOUR_REAL};
    const float row = 33;
    drawlist_text(list, legend.x, legend.y + 8, FONT_LABEL, THEME_TEXT_SMALL, theme()->text_dim, "at 0 Hz · width");
    for (int i = 0; i < FILTER_KINDS; i++) {
        const struct passband *band = &view->band[order[i]];
        bool own = view->setting.kind == order[i];
        uint32_t color = filter_color(view, order[i]), text_color = own ? theme()->text : theme()->text_dim;
        char text[64];
        float y = legend.y + 26 + row * (float)i;
        drawlist_rounded(list, (struct rect){legend.x, y - 8, 3, 24}, 1.5f, color);
        drawlist_text(list, legend.x + 9, y, own ? FONT_LABEL_BOLD : FONT_LABEL, THEME_TEXT_SMALL, text_color,
                      filter_name[order[i]]);
        snprintf(text, sizeof text, "%.1f dB %.3g Hz", band->zero, band->width);
        drawlist_text_fit(list, legend.x + 9, y + 14, legend.w - 9, FONT_NUMBER, THEME_TEXT_SMALL, text_color, text);
    }
}

static void draw_number(struct drawlist *list, float x, float y, const char *text)
{
    drawlist_text(list, x, y, FONT_NUMBER, THEME_TEXT_SMALL, theme()->text_dim, text);
}

/// A number below a plot, centred at x but inside `r`.
static void draw_below(struct drawlist *list, struct rect r, float x, float y, const char *text)
{
    float width = font_width(FONT_NUMBER, THEME_TEXT_SMALL, text);
    draw_number(list, fmaxf(r.x, fminf(r.x + r.w - width, x - width / 2)), y, text);
}

static void draw_curve(const struct poles_view *view, enum filter_kind kind, struct rect plot, struct drawlist *list)
{
    float xy[POLES_COLUMNS][2];
    for (int i = 0; i < POLES_COLUMNS; i++) {
        xy[i][0] = plot.x + plot.w * (float)i / (POLES_COLUMNS - 1);
        xy[i][1] = plot.y + plot.h * fmaxf(view->decibels[kind][i], 2 * floor_decibels) / floor_decibels;
    }
    bool own = view->setting.kind == kind;
    drawlist_line(list, xy[0], POLES_COLUMNS, own ? 2 : 1.25f, theme_fade(filter_color(view, kind), own ? 1 : 0.7f));
}

static void poles_draw_response(const struct poles_view *view, struct rect r, struct drawlist *list)
{
    struct rect plot = {r.x + margin_left, r.y + 4, r.w - margin_left, r.h - margin_bottom - 4};
    char text[32];
    for (int db = 0; db >= (int)floor_decibels; db -= 20) {
        float y = plot.y + plot.h * (float)db / floor_decibels;
        draw_straight(list, plot.x, y, plot.x + plot.w, y, theme()->grid_major);
        snprintf(text, sizeof text, "%d", db);
        draw_number(list, plot.x - 6 - font_width(FONT_NUMBER, THEME_TEXT_SMALL, text), y + 4, text);
    }
    float middle = plot.x + plot.w / 2, peak = plot.w / 2 * (float)(view->setting.hz / view->span);
    draw_straight(list, middle, plot.y, middle, plot.y + plot.h, theme()->zero);
    draw_below(list, r, middle, r.y + r.h - 2, "0");
    for (int side = -1; side <= 1 && peak <= plot.w / 2; side += 2) {
        float x = middle + (float)side * peak;
        draw_straight(list, x, plot.y, x, plot.y + plot.h, theme()->grid_major);
        snprintf(text, sizeof text, "%.3g Hz", side * view->setting.hz);
        draw_below(list, r, x, r.y + r.h - 2, text);
    }
    struct rect old = drawlist_push_clip(list, (struct rect){plot.x, plot.y - 2, plot.w, plot.h + 2});
    for (enum filter_kind kind = 0; kind < FILTER_KINDS; kind++) {
        if (view->setting.kind != kind) draw_curve(view, kind, plot, list);
    }
    draw_curve(view, view->setting.kind, plot, list);
    drawlist_set_clip(list, old);
}

enum { CIRCLE = 112, INSET = 92, TICKS = 18, RESPONSE = 112 }; ///< heights

/// A parameter's value at the playhead, clamped to its range.
static double value_now(const struct inspector *in, const struct spline *spline, enum parameter parameter)
{
    return core_parameter_at(in->core, spline, parameter, document_sample(in->core->document, core_frame(in->core)));
}

enum { HANDLE_CENTRE, HANDLE_LOWER, HANDLE_UPPER, HANDLES };

/// Sets a parameter, rounded, unless it follows a track.
static void set_pole(struct inspector *in, enum parameter parameter, double number, double steps)
{
    if (core_active_spline(in->core)->parameter[parameter].track < 0)
        core_set_parameter(in->core, in->core->focus.active, parameter, round(number * steps) / steps);
}

/// The poles in the plane of frequency and damping, and handles on them.
static void build_inset(struct inspector *in, struct pole_setting setting)
{
    struct poles_view *view = &in->poles;
    const struct rect row = ui_row(&in->ui, INSET + TICKS), r = {row.x, row.y, row.w, INSET};
    const double spread = setting.kind == FILTER_TWO_COMPLEX ? setting.hz * setting.bandwidth : 0;
    const float x = poles_x(view, r, setting.hz), y = poles_y(view, r, setting.damping);
    const float low = poles_x(view, r, setting.hz - spread), high = poles_x(view, r, setting.hz + spread);
    struct ui_handle handles[HANDLES] = {
        [HANDLE_CENTRE] = {"pole.centre", "Drag sideways for frequency, up for damping (Shift: fine)", .x = x,
                           .y = y},
        [HANDLE_LOWER] = {"pole.lower", "Pole: drag sideways for bandwidth, up for damping", .x = low, .y = y},
        [HANDLE_UPPER] = {"pole.upper", "Pole: drag sideways for bandwidth, up for damping", .x = high, .y = y}};
    if (in->ui.pass == UI_PASS_DRAW) {
        static const double dampings[] = {0, 0.05, 0.2, 0.5, 1, 2};
        struct drawlist *list = in->ui.list;
        char text[32];
        drawlist_rounded(list, r, 3, theme()->raised);
        for (int i = 0; i < 6 && dampings[i] < view->top; i++) {
            const float line = poles_y(view, r, dampings[i]);
            draw_straight(list, r.x, line, r.x + r.w, line, theme()->grid_major);
            snprintf(text, sizeof text, "ζ %g", dampings[i]);
            if (i > 0) draw_number(list, r.x + 4, line - 3, text);
        }
        for (int i = 1; i <= 3; i++) {
            const double hz = view->reach * i / 4;
            const float line = poles_x(view, r, hz);
            draw_straight(list, line, r.y, line, r.y + r.h, theme()->grid_major);
            snprintf(text, sizeof text, "%.4g Hz", hz);
            draw_below(list, r, line, r.y + r.h + 12, text);
        }
        const struct rect whole = drawlist_push_clip(list, rect_inset(r, -6));
        if (spread > 0) {
            draw_straight(list, low, y, high, y, theme_fade(theme()->accent, 0.5f));
            draw_cross(list, low, y, 3.5f, theme()->accent);
            draw_cross(list, high, y, 3.5f, theme()->accent);
        }
        drawlist_disc(list, (const float[2]){x, y}, 3.5f, theme()->text);
        drawlist_set_clip(list, whole);
    }
    int which = 0;
    const int count = setting.kind == FILTER_TWO_COMPLEX ? HANDLES : 1;
    const enum ui_change change = ui_handles(&in->ui, row, handles, count, &which);
    const struct ui_handle *handle = &handles[which];
    const bool centre = which == HANDLE_CENTRE;
    if (change == UI_NONE || !inspector_step(in, change, "Move poles", handle->name)) return;
    const double side = which == HANDLE_LOWER ? -1 : 1, highest = fmin(12, 0.5 / setting.step);
    double hz = setting.hz, damping = setting.damping, bandwidth = setting.bandwidth;
    if (change == UI_NUDGE) {
        damping += 0.01 * handle->step_y;
        hz += 0.05 * handle->step_x; // of the centre
        bandwidth += side * 0.01 * handle->step_x;
    } else {
        const double part = fmax(0, fmin(1, 1 - (handle->y - r.y) / r.h));
        damping = part * part * view->top;
        hz = fmax(0, (handle->x - r.x) / r.w) * view->reach;
        bandwidth = side * (hz - setting.hz) / setting.hz;
    }
    if (centre) set_pole(in, PARAMETER_FREQUENCY, fmax(0.01, fmin(highest, hz)), 100);
    set_pole(in, PARAMETER_DAMPING, fmax(0, fmin(setting.kind == FILTER_TWO_REAL ? 3 : 1, damping)), 1000);
    if (!centre) set_pole(in, PARAMETER_BANDWIDTH, fmax(0, fmin(1, bandwidth)), 1000);
}

void inspector_poles(struct inspector *in)
{
    struct ui *ui = &in->ui;
    struct poles_view *view = &in->poles;
    struct spline *spline = core_active_spline(in->core);
    const struct pole_setting setting = {.kind = spline_mode(spline) == WIGGLY_REAL ? FILTER_TWO_REAL
                                                                                    : FILTER_TWO_COMPLEX,
                                         .hz = value_now(in, spline, PARAMETER_FREQUENCY),
                                         .damping = value_now(in, spline, PARAMETER_DAMPING),
                                         .bandwidth = value_now(in, spline, PARAMETER_BANDWIDTH),
                                         .step = document_step(in->core->document)};
    if (spline_mode(spline) == WIGGLY_CUBIC || !(setting.hz > 0)) {
        ui_paragraph(ui, "Both poles are at 1 (frequency 0): a cubic does not swing.", theme()->text_dim);
        return;
    }
    if (!ui->held || (ui->held != ui_id(ui, "pole.centre") && ui->held != ui_id(ui, "pole.lower") &&
                      ui->held != ui_id(ui, "pole.upper"))) { // the inset's scale stays during a drag
        static const double nice[] = {1, 1.5, 2, 3, 4, 6, 8, 10};
        const double wanted = fmax(0.05, 1.3 * setting.hz * (1 + setting.bandwidth)),
                     decade = maths_power_of_ten(maths_decade(wanted));
        int i = 0;
        while (i < 7 && nice[i] * decade < wanted) i++;
        view->reach = nice[i] * decade;
        view->top = setting.damping > 1 ? 3 : 1;
    }
    const struct pole_setting *old = &view->setting;
    if (old->kind != setting.kind || old->hz != setting.hz || old->damping != setting.damping ||
        old->bandwidth != setting.bandwidth || old->step != setting.step) {
        view->setting = setting;
        view->span = fmin(0.5 / setting.step, 3 * setting.hz);
        for (int kind = 0; kind < FILTER_KINDS; kind++) {
            const struct filter filter =
                filter_of((enum filter_kind)kind, setting.hz, setting.damping, setting.bandwidth, setting.step);
            view->band[kind] = filter_passband(&filter);
            for (int i = 0; i < POLES_COLUMNS; i++) {
                const double hz = view->span * (2.0 * i / (POLES_COLUMNS - 1) - 1);
                view->decibels[kind][i] = (float)(filter_decibels(&filter, hz) - view->band[kind].peak);
            }
        }
    }
    ui_space(ui, 4);
    struct rect top = ui_row(ui, CIRCLE);
    struct rect circle = {top.x, top.y, CIRCLE, CIRCLE};
    ui_hint(ui, circle, "Unit circle: poles inside are stable; angle is frequency, distance from the rim damping");
    if (ui->pass == UI_PASS_DRAW) {
        struct rect legend = {top.x + CIRCLE + UI_GAP, top.y, top.w - CIRCLE - UI_GAP, CIRCLE};
        draw_overview(view, circle, legend, ui->list);
    }
    ui_space(ui, 6);
    build_inset(in, setting);
    ui_space(ui, 4);
    struct rect response = ui_row(ui, RESPONSE);
    ui_hint(ui, response, "Response in dB over Hz: a wiggly spline rejects low frequencies");
    if (ui->pass == UI_PASS_DRAW) poles_draw_response(view, response, ui->list);
    ui_space(ui, 4);
}
