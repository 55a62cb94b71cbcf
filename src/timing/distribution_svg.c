/// The picture: frames along the session above, the histogram and the percentiles side by side below.
#include "base/need.h"
#include "timing/columns.h"
#include "timing/distribution.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { WIDTH = 1080, HEIGHT = 660, LEFT = 56, RIGHT = 24, GAP = 72 };
static const double DECADES = 3; ///< of the percentiles' axis: p0 to p99.9
static const char ink[] = "#23272e", grey[] = "#7a828e", grid[] = "#e4e7eb", blue[] = "#2f6fb5", red[] = "#c8502a";

/// A rectangle of the picture and the numbers at its edges.
struct plot {
    double x, y, w, h, x0, x1, y0, y1;
};

static double at_x(const struct plot *p, double x) { return p->x + p->w * (x - p->x0) / (p->x1 - p->x0); }
static double at_y(const struct plot *p, double y) { return p->y + p->h * (p->y1 - y) / (p->y1 - p->y0); }

static void line(FILE *svg, double x0, double y0, double x1, double y1, const char *color, const char *dashes)
{
    fprintf(svg, "<path d=\"M%.1f %.1fL%.1f %.1f\" stroke=\"%s\" fill=\"none\"%s%s%s/>\n", x0, y0, x1, y1, color,
            dashes ? " stroke-dasharray=\"" : "", dashes ? dashes : "", dashes ? "\"" : "");
}

static void number(FILE *svg, double x, double y, const char *anchor, double value, const char *unit)
{
    fprintf(svg, "<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"%s\" fill=\"%s\">%.6g%s</text>\n", x, y, anchor, grey,
            value, unit);
}

static void text(FILE *svg, double x, double y, const char *anchor, const char *color, const char *what)
{
    fprintf(svg, "<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"%s\" fill=\"%s\">", x, y, anchor, color);
    for (; *what; what++) {
        if (strchr("<>&\"", *what) || (unsigned char)*what < ' ') {
            fprintf(svg, "&#%d;", (unsigned char)*what < ' ' ? ' ' : *what);
        } else {
            fputc(*what, svg);
        }
    }
    fputs("</text>\n", svg);
}

static void milliseconds_up(FILE *svg, const struct plot *p)
{
    double step = round_step(p->y1 / 6);
    for (double ms = 0; ms <= p->y1 * (1 + 1e-9); ms += step) {
        line(svg, p->x, at_y(p, ms), p->x + p->w, at_y(p, ms), grid, NULL);
        number(svg, p->x - 8, at_y(p, ms) + 4, "end", ms, "");
    }
}

static void budgets(FILE *svg, const struct plot *p)
{
    static const char *const names[] = {"16.7 ms: 60 a second", "33.3 ms: 30 a second"};
    for (int b = 0; b < BUDGET_COUNT; b++) {
        double y = at_y(p, frame_budgets_ms[b]);
        if (frame_budgets_ms[b] > p->y1) continue;
        line(svg, p->x, y, p->x + p->w, y, red, "5 4");
        double below = b == BUDGET_60 ? 13 : -4; // the two labels may be close
        fprintf(svg, "<rect x=\"%.1f\" y=\"%.1f\" width=\"122\" height=\"14\" fill=\"#fff\" fill-opacity=\"0.8\"/>\n",
                p->x + p->w - 122, y + below - 11);
        text(svg, p->x + p->w, y + below, "end", red, names[b]);
    }
}

/// Every frame of every run as a dot, fainter where there are more runs.
static void draw_frames(FILE *svg, const struct timing_log *log, double top_ms)
{
    double last = 1, shown = fmax(0.4, 0.7 / sqrt(log->runs));
    for (int row = 0; row < log->rows; row++) {
        last = fmax(last, log->values[(size_t)row * COLUMN_COUNT + COLUMN_FRAME]);
    }
    struct plot p = {LEFT, 64, WIDTH - LEFT - RIGHT, 250, 0, last, 0, top_ms};
    milliseconds_up(svg, &p);
    double step = round_step(last / 12);
    for (double frame = 0; frame <= last; frame += step)
        number(svg, at_x(&p, frame), p.y + p.h + 18, "middle", frame, "");
    text(svg, p.x, p.y - 12, "start", ink,
         "frame_ms of every frame, along the session; at the upper edge: that and more");
    text(svg, p.x + p.w, p.y + p.h + 34, "end", grey, "frame");
    fprintf(svg, "<path stroke=\"%s\" stroke-opacity=\"%.2f\" stroke-width=\"2.4\" stroke-linecap=\"round\" d=\"",
            blue, shown);
    for (int row = 0; row < log->rows; row++) {
        const double *values = &log->values[(size_t)row * COLUMN_COUNT];
        if (isnan(values[COLUMN_FRAME_MS])) continue;
        fprintf(svg, "M%.1f %.1fh0", at_x(&p, values[COLUMN_FRAME]), at_y(&p, fmin(values[COLUMN_FRAME_MS], top_ms)));
    }
    fputs("\"/>\n", svg);
    budgets(svg, &p);
}

static void draw_histogram(FILE *svg, const double *sorted, int count)
{
    struct histogram h = histogram_of(sorted, count);
    double width = (WIDTH - LEFT - RIGHT - GAP) / 2.0;
    struct plot p = {LEFT, 408, width, 200, h.start, h.start + h.bins * h.step, 0, h.most};
    double step = fmax(1, round_step(h.most / 4.0));
    for (double n = 0; n <= h.most; n += step) {
        line(svg, p.x, at_y(&p, n), p.x + p.w, at_y(&p, n), grid, NULL);
        number(svg, p.x - 8, at_y(&p, n) + 4, "end", n, "");
    }
    for (int i = 0; i < h.bins; i++) {
        double left = at_x(&p, h.start + i * h.step), right = at_x(&p, h.start + (i + 1) * h.step);
        bool rest = i == h.bins - 1;
        fprintf(svg, "<rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\" fill=\"%s\"/>\n", left + 0.5,
                at_y(&p, h.counts[i]), fmax(right - left - 1, 0.5), p.y + p.h - at_y(&p, h.counts[i]),
                rest ? red : blue);
    }
    for (int i = 0; i<h.bins; i += h.bins> 12 ? 4 : 2) {
        number(svg, at_x(&p, h.start + i * h.step), p.y + p.h + 18, "middle", h.start + i * h.step, "");
    }
    text(svg, p.x, p.y - 12, "start", ink, "frames by frame_ms; the last bar is all above it");
    text(svg, p.x + p.w, p.y + p.h + 34, "end", grey, "ms");
}

/// Position of percentile p on an axis that gives every further nine equal room.
static double nines(double p) { return -log10(1 - p); }

static void percentile_curve(FILE *svg, const struct plot *p, const double *sorted, int count, const char *color)
{
    enum { POINTS = 240 };
    for (int i = 0; i <= POINTS; i++) {
        double x = DECADES * i / POINTS, share = 1 - pow(10, -x);
        double y = fmin(statistics_quantile(sorted, count, share), p->y1);
        fprintf(svg, "%s%.1f %.1f", i ? "L" : "<path d=\"M", at_x(p, x), at_y(p, y));
    }
    fprintf(svg, "\" stroke=\"%s\" stroke-width=\"2\" stroke-linejoin=\"round\" fill=\"none\"/>\n", color);
}

static void draw_percentiles(FILE *svg, const struct timing_log *log, const double *sorted, int count, double top_ms,
                             double *values)
{
    static const double at[] = {0, 0.5, 0.9, 0.95, 0.99, 0.999};
    double width = (WIDTH - LEFT - RIGHT - GAP) / 2.0;
    struct plot p = {WIDTH - RIGHT - width, 408, width, 200, 0, DECADES, 0, top_ms};
    milliseconds_up(svg, &p);
    for (size_t i = 0; i < sizeof at / sizeof *at; i++) {
        line(svg, at_x(&p, nines(at[i])), p.y, at_x(&p, nines(at[i])), p.y + p.h, grid, NULL);
        number(svg, at_x(&p, nines(at[i])), p.y + p.h + 18, "middle", 100 * at[i], " %");
    }
    text(svg, p.x, p.y - 12, "start", blue, "frame_ms");
    text(svg, p.x + p.w, p.y - 12, "end", ink, "this share of frames is faster");
    int intervals = column_values(log, COLUMN_FRAME_INTERVAL_MS, values);
    statistics_sort(values, intervals);
    if (intervals > 0) {
        text(svg, p.x + 66, p.y - 12, "start", grey, "frame_interval_ms");
        percentile_curve(svg, &p, values, intervals, "#b3bac4");
    }
    percentile_curve(svg, &p, sorted, count, blue);
    budgets(svg, &p);
}

void distribution_draw(const struct timing_log *log, const char *name, FILE *out)
{
    double *sorted = need_zeroed(2 * (size_t)log->rows, sizeof *sorted);
    int count = column_values(log, COLUMN_FRAME_MS, sorted);
    statistics_sort(sorted, count);
    double top_ms =
        count ? fmax(1.04 * fmin(sorted[count - 1], 1.5 * statistics_quantile(sorted, count, 0.999)), 1e-3) : 1;
    fprintf(
        out,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%d\" height=\"%d\" viewBox=\"0 0 %d %d\" "
        "font-family=\"Inter, sans-serif\" font-size=\"12\">\n<rect width=\"%d\" height=\"%d\" fill=\"#ffffff\"/>\n",
        WIDTH, HEIGHT, WIDTH, HEIGHT, WIDTH, HEIGHT);
    char title[512];
    snprintf(title, sizeof title, "%s: %d frames of %d %s", name, log->rows, log->runs,
             log->runs == 1 ? "run" : "runs");
    text(out, LEFT, 26, "start", ink, title);
    if (count > 0) {
        draw_frames(out, log, top_ms);
        draw_histogram(out, sorted, count);
        draw_percentiles(out, log, sorted, count, top_ms, sorted + log->rows);
    }
    fputs("</svg>\n", out);
    free(sorted);
}
