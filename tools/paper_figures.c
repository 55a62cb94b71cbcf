/// Writes the paper's figures as SVG and CSV, from assets/scenes and the present solver. Usage: paper_figures <folder>. Exit status 1 if a
/// scene cannot be read or solved, 3 if a file cannot be written.
#include "base/error.h"
#include "editor/inspector/poles.h"
#include "model/character.h"
#include "rig/posing.h"
#include "scene/load.h"
#include "ui/theme.h"
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { WIDTH = 760, ROW = 170, GAP = 34, LEFT = 96, RIGHT = 24, TOP = 24, MAX_ROWS = 3 };

static const char ink[] = "#20252c", grey[] = "#c3c9d1", accent[] = "#c97a00", blue[] = "#2f7fb8";

/// A scene and its solution.
struct solved {
    struct document *document;
    struct evaluation evaluation;
};

/// A plot of a figure: a spline's values.
struct plot {
    const char *spline, *label;
    enum { ROW_TOTAL, ROW_RE, ROW_IM } row;
    bool knots;
};

struct chart {
    const char *scene;
    int rows;
    struct plot plot[MAX_ROWS]; ///< top to bottom, as in the paper
};

static const struct chart curves[] = {
    {"figure1", 2, {{"resonance", "resonance (Hz)", ROW_TOTAL, false}, {"curve", "curve", ROW_TOTAL, true}}},
    {"figure3", 2, {{"curve", "imaginary part", ROW_IM, false}, {"curve", "real part", ROW_RE, true}}},
    {"figure4", 2, {{"moved", "third knot moved", ROW_TOTAL, true}, {"before", "before", ROW_TOTAL, true}}},
    {"figure5",
     3,
     {{"edited", "edited", ROW_TOTAL, true},
      {"free", "passive response", ROW_TOTAL, false},
      {"equilibrium", "equilibrium", ROW_TOTAL, true}}},
};

static void stop(int status, const char *sentence)
{
    fprintf(stderr, "paper_figures: %s\n", sentence);
    exit(status);
}

static FILE *create(const char *folder, const char *name, const char *extension)
{
    char path[1024], sentence[1200];
    snprintf(path, sizeof path, "%s/%s.%s", folder, name, extension);
    FILE *file = fopen(path, "w");
    if (file) return file;
    snprintf(sentence, sizeof sentence, "cannot write %s: %s", path, strerror(errno));
    stop(3, sentence);
    return NULL;
}

static void finish(FILE *file, const char *name)
{
    bool failed = ferror(file) != 0;
    char sentence[256];
    if (fclose(file) == 0 && !failed) return;
    snprintf(sentence, sizeof sentence, "cannot write %s: %s", name, strerror(errno));
    stop(3, sentence);
}

static struct solved solve(const char *name)
{
    char path[256];
    struct error error = {0};
    struct solved s = {0};
    snprintf(path, sizeof path, "assets/scenes/%s.json", name);
    s.document = scene_load(path, NULL, &error);
    if (!s.document) stop(1, error.text);
    evaluation_update(&s.evaluation, s.document, false);
    for (int i = 0; i < s.evaluation.count; i++) {
        if (s.evaluation.status[i] != WIGGLY_OK) stop(1, wiggly_status_text(s.evaluation.status[i]));
    }
    return s;
}

static void release(struct solved *s)
{
    evaluation_free(&s->evaluation);
    document_destroy(s->document);
}

static FILE *svg_begin(const char *folder, const char *name, int height)
{
    FILE *svg = create(folder, name, "svg");
    fprintf(svg,
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%d\" height=\"%d\" viewBox=\"0 0 %d %d\" "
            "font-family=\"Inter, sans-serif\" font-size=\"12\" fill=\"%s\">\n<rect width=\"%d\" height=\"%d\" "
            "fill=\"#ffffff\"/>\n",
            WIDTH, height, WIDTH, height, ink, WIDTH, height);
    return svg;
}

static void svg_end(FILE *svg, const char *name)
{
    fputs("</svg>\n", svg);
    finish(svg, name);
}

static void svg_line(FILE *svg, double x0, double y0, double x1, double y1, const char *color, double width)
{
    fprintf(svg, "<path d=\"M%.2f %.2fL%.2f %.2f\" stroke=\"%s\" stroke-width=\"%.2f\" fill=\"none\"/>\n", x0, y0, x1,
            y1, color, width);
}

static void svg_text(FILE *svg, double x, double y, const char *anchor, const char *text)
{
    fprintf(svg, "<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"%s\">%s</text>\n", x, y, anchor, text);
}

/// A rectangle of the picture, and the values at its edges.
struct frame {
    double x, y, w, h, x0, x1, y0, y1;
};

static double at_x(const struct frame *f, double x) { return f->x + f->w * (x - f->x0) / (f->x1 - f->x0); }

static double at_y(const struct frame *f, double y) { return f->y + f->h * (f->y1 - y) / (f->y1 - f->y0); }

static void svg_curve(FILE *svg, const struct frame *f, const double *x, const double *y, int count,
                      const char *color, double width)
{
    fputs("<path d=\"", svg);
    for (int i = 0; i < count; i++) {
        fprintf(svg, "%c%.2f %.2f", i == 0 ? 'M' : 'L', at_x(f, x[i]), at_y(f, y[i]));
    }
    fprintf(svg, "\" stroke=\"%s\" stroke-width=\"%.2f\" stroke-linejoin=\"round\" fill=\"none\"/>\n", color, width);
}

static const double *row_of(const struct solved *s, const struct plot *plot)
{
    int spline = document_find_spline(s->document, plot->spline);
    if (spline < 0) stop(1, "a figure's spline is missing from its scene");
    const wiggly_curve *curve = &s->evaluation.curves[spline];
    return plot->row == ROW_TOTAL ? curve->total : plot->row == ROW_RE ? curve->re : curve->im;
}

/// Knots as diamonds, their slopes as short lines.
static void svg_knots(FILE *svg, const struct frame *f, const struct document *document, const char *name)
{
    const struct spline *spline = document->splines[document_find_spline(document, name)];
    for (int i = 0; i < spline->knot_count; i++) {
        const struct knot *knot = &spline->knots[i];
        double x = at_x(f, knot->frame), y = at_y(f, knot->value);
        if (knot->has_slope) {
            double rise = knot->slope / document->fps * f->h / (f->y1 - f->y0) * (f->x1 - f->x0) / f->w;
            double reach = 22 / hypot(1, rise);
            svg_line(svg, x - reach, y + rise * reach, x + reach, y - rise * reach, ink, 1);
        }
        fprintf(svg, "<path d=\"M%.2f %.2fl5 5l-5 5l-5 -5z\" fill=\"#fff\" stroke=\"%s\" stroke-width=\"1.5\"/>\n", x,
                y - 5, ink);
    }
}

static void svg_row(FILE *svg, const struct solved *s, const struct plot *plot, double top, const double *frames)
{
    const double *row = row_of(s, plot);
    int count = s->evaluation.samples;
    struct frame f = {LEFT, top, WIDTH - LEFT - RIGHT, ROW, frames[0], frames[count - 1], INFINITY, -INFINITY};
    for (int i = 0; i < count; i++) {
        f.y0 = fmin(f.y0, row[i]);
        f.y1 = fmax(f.y1, row[i]);
    }
    double margin = 0.1 * (f.y1 - f.y0);
    f.y0 -= margin;
    f.y1 += margin;
    svg_line(svg, f.x, at_y(&f, 0), f.x + f.w, at_y(&f, 0), grey, 1);
    svg_line(svg, f.x, f.y, f.x, f.y + f.h, grey, 1);
    svg_text(svg, f.x - 26, at_y(&f, 0) + 4, "end", "0");
    svg_text(svg, f.x + 8, f.y + 6, "start", plot->label);
    if (f.y1 > 1 && f.y0 < 1) {
        svg_line(svg, f.x - 4, at_y(&f, 1), f.x, at_y(&f, 1), grey, 1);
        svg_text(svg, f.x - 26, at_y(&f, 1) + 4, "end", "1");
    }
    svg_curve(svg, &f, frames, row, count, plot->knots ? accent : blue, 2);
    if (plot->knots) svg_knots(svg, &f, s->document, plot->spline);
}

static void write_curves(const char *folder, const struct chart *figure)
{
    struct solved s = solve(figure->scene);
    int count = s.evaluation.samples;
    FILE *svg = svg_begin(folder, figure->scene, TOP + figure->rows * (ROW + GAP));
    FILE *csv = create(folder, figure->scene, "csv");
    double *frames = malloc(sizeof *frames * (size_t)count);
    if (!frames) stop(3, "not enough memory");
    for (int i = 0; i < count; i++) frames[i] = document_frame(s.document, i);
    fputs("frame", csv);
    for (int r = 0; r < figure->rows; r++) {
        svg_row(svg, &s, &figure->plot[r], TOP + r * (ROW + GAP), frames);
        fprintf(csv, ",%s", figure->plot[r].label);
    }
    for (int i = 0; i < count; i++) {
        fprintf(csv, "\n%.17g", frames[i]);
        for (int r = 0; r < figure->rows; r++) fprintf(csv, ",%.17g", row_of(&s, &figure->plot[r])[i]);
    }
    fputc('\n', csv);
    svg_end(svg, figure->scene);
    finish(csv, figure->scene);
    free(frames);
    release(&s);
}

enum { RESPONSE_POINTS = 801, CIRCLE_RADIUS = 72 };

static void svg_circle(FILE *svg, const struct filter *filter, double cx, double cy)
{
    fprintf(svg, "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"%d\" fill=\"none\" stroke=\"%s\"/>\n", cx, cy, CIRCLE_RADIUS,
            ink);
    svg_line(svg, cx - CIRCLE_RADIUS - 8, cy, cx + CIRCLE_RADIUS + 8, cy, grey, 1);
    svg_line(svg, cx, cy - CIRCLE_RADIUS - 8, cx, cy + CIRCLE_RADIUS + 8, grey, 1);
    for (int i = 0; i < filter->count; i++) {
        double size = CIRCLE_RADIUS * exp(filter->s[i][0] * filter->step), angle = filter->s[i][1] * filter->step;
        double x = cx + size * cos(angle), y = cy - size * sin(angle);
        svg_line(svg, x - 3.5, y - 3.5, x + 3.5, y + 3.5, accent, 1.75);
        svg_line(svg, x - 3.5, y + 3.5, x + 3.5, y - 3.5, accent, 1.75);
    }
}

static void svg_response(FILE *svg, const struct filter *filter, const struct frame *f, double *hz, double *db)
{
    enum { SCAN = 20000 };
    static const double fine = 1e-4; // Hz
    double peak = -INFINITY;
    int low = 0, high = SCAN; // the outermost frequencies with half the peak's power
    char text[128];
    for (int i = 0; i <= SCAN; i++) peak = fmax(peak, filter_decibels(filter, fine * i));
    while (filter_decibels(filter, fine * low) < peak - 10 * log10(2)) low++;
    while (filter_decibels(filter, fine * high) < peak - 10 * log10(2)) high--;
    for (int i = 0; i < RESPONSE_POINTS; i++) {
        hz[i] = f->x0 + (f->x1 - f->x0) * i / (RESPONSE_POINTS - 1);
        db[i] = filter_decibels(filter, hz[i]) - peak;
    }
    for (int level = 0; level >= -60; level -= 20) {
        svg_line(svg, f->x, at_y(f, level), f->x + f->w, at_y(f, level), grey, 1);
        snprintf(text, sizeof text, "%d dB", level);
        svg_text(svg, f->x - 6, at_y(f, level) + 4, "end", text);
    }
    svg_line(svg, at_x(f, 0), f->y, at_x(f, 0), f->y + f->h, grey, 1);
    svg_curve(svg, f, hz, db, RESPONSE_POINTS, accent, 2);
    snprintf(text, sizeof text, "%.1f dB at 0 Hz, %.3f Hz wide at half power", filter_decibels(filter, 0) - peak,
             fine * (high - low));
    svg_text(svg, f->x + 8, f->y + f->h + 16, "start", text);
}

/// Figure 2, for f 1 Hz, damping 0.05, bandwidth 0.1 at 24 frames per second.
static void write_responses(const char *folder)
{
    static const char *const name[FILTER_KINDS] = {"two-pole real", "four-pole real", "two-pole complex"};
    static double hz[RESPONSE_POINTS], db[FILTER_KINDS][RESPONSE_POINTS];
    FILE *svg = svg_begin(folder, "figure2", TOP + FILTER_KINDS * (ROW + GAP));
    FILE *csv = create(folder, "figure2", "csv");
    for (int kind = 0; kind < FILTER_KINDS; kind++) {
        struct filter filter = filter_of((enum filter_kind)kind, 1, 0.05, 0.1, 1.0 / 24);
        double top = TOP + kind * (ROW + GAP);
        struct frame f = {310, top, WIDTH - 310 - RIGHT, ROW - 20, -3, 3, -65, 2};
        svg_circle(svg, &filter, 130, top + ROW / 2.0);
        svg_text(svg, 16, top + 4, "start", name[kind]);
        svg_response(svg, &filter, &f, hz, db[kind]);
    }
    fprintf(csv, "hz,%s,%s,%s\n", name[0], name[1], name[2]);
    for (int i = 0; i < RESPONSE_POINTS; i++) {
        fprintf(csv, "%.17g,%.17g,%.17g,%.17g\n", hz[i], db[0][i], db[1][i], db[2][i]);
    }
    svg_end(svg, "figure2");
    finish(csv, "figure2");
}

/// Figure 6: the tail from above at every few frames, and all joints in the table.
static void write_tail(const char *folder)
{
    enum { POSES = 9, EVERY = 6, PER_ROW = 3 };
    struct solved s = solve("figure6");
    const struct posing posing = {.document = s.document, .evaluation = &s.evaluation};
    struct rig_pose pose;
    FILE *svg = svg_begin(folder, "figure6", TOP + POSES / PER_ROW * (ROW + GAP));
    FILE *csv = create(folder, "figure6", "csv");
    fputs("frame,joint,x,y,z\n", csv);
    for (int sample = 0; sample < s.evaluation.samples; sample++) {
        rig_pose(&posing, 0, sample, &pose);
        for (int j = 0; j < pose.strand.count; j++) {
            const float *at = &pose.strand.matrix[j][12];
            fprintf(csv, "%g,%d,%.9g,%.9g,%.9g\n", document_frame(s.document, sample), j, at[0], at[1], at[2]);
        }
    }
    for (int i = 0; i < POSES; i++) {
        double x[TAIL_MAX_JOINTS + 1], z[TAIL_MAX_JOINTS + 1], wide = WIDTH / (double)PER_ROW;
        struct frame f = {
            wide * (i % PER_ROW) + 30, TOP + i / PER_ROW * (ROW + GAP), wide - 60, ROW, -0.35, 2.15, -1.1, 1.1};
        char text[32];
        rig_pose(&posing, 0, 24 + i * EVERY, &pose);
        for (int j = 0; j < pose.strand.count; j++) {
            x[j] = pose.strand.matrix[j][14];
            z[j] = pose.strand.matrix[j][12];
        }
        snprintf(text, sizeof text, "frame %g", document_frame(s.document, 24 + i * EVERY));
        svg_text(svg, f.x, f.y + 6, "start", text);
        svg_line(svg, f.x, at_y(&f, 0), f.x + f.w, at_y(&f, 0), grey, 1);
        svg_curve(svg, &f, x, z, pose.strand.count, accent, 5);
    }
    svg_end(svg, "figure6");
    finish(csv, "figure6");
    release(&s);
}

/// A triangle of figure 7, seen from the front.
struct facet {
    float depth;
    int at; ///< its first index
};

static int compare_depth(const void *a, const void *b)
{
    float x = ((const struct facet *)a)->depth, y = ((const struct facet *)b)->depth;
    return (x > y) - (x < y);
}

/// Triangles that face the viewer at +z, farthest first. Returns their number.
static int facets_of(const struct character *c, struct facet *facets)
{
    int count = 0;
    for (int i = 0; i < c->index_count; i += 3) {
        const float *p = c->position[c->indices[i]], *q = c->position[c->indices[i + 1]];
        const float *r = c->position[c->indices[i + 2]];
        float area = (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
        if (area > 0) facets[count++] = (struct facet){p[2] + q[2] + r[2], i};
    }
    qsort(facets, (size_t)count, sizeof *facets, compare_depth);
    return count;
}

static void svg_facet(FILE *svg, const struct character *c, const struct coordinate *up, int at, float largest)
{
    enum { UP = 1, SCALE = 280, FLOOR = 570 };
    float re = 0, im = 0;
    fputs("<path d=\"", svg);
    for (int k = 0; k < 3; k++) {
        uint32_t v = c->indices[at + k];
        re += up->re[v][UP] / (3 * largest);
        im += up->im[v][UP] / (3 * largest);
        fprintf(svg, "%c%.1f %.1f", k == 0 ? 'M' : 'L', WIDTH / 2.0 + SCALE * (double)c->position[v][0],
                FLOOR - SCALE * (double)c->position[v][1]);
    }
    unsigned color = (unsigned)(phase_color(re, im) >> 8);
    fprintf(svg, "z\" fill=\"#%06X\" stroke=\"#%06X\" stroke-width=\".6\"/>\n", color, color);
}

/// Figure 7: the phase of the vertical motion as hue, its amplitude as chroma; all vertices in the table.
static void write_phases(const char *folder)
{
    enum { UP = 1 };
    struct character c = {0};
    struct error error = {0};
    if (!character_read("assets/models/creature.glb", &c, &error)) stop(1, error.text);
    if (c.coordinate_count < 1) stop(1, "assets/models/creature.glb has no coordinates");
    const struct coordinate *up = &c.coordinates[0];
    struct facet *facets = malloc(sizeof *facets * (size_t)(c.index_count / 3));
    if (!facets) stop(3, "not enough memory");
    float largest = 0;
    FILE *csv = create(folder, "figure7", "csv");
    fputs("x,y,z,amplitude,phase_degrees\n", csv);
    for (int v = 0; v < c.vertex_count; v++) {
        float re = up->re[v][UP], im = up->im[v][UP], size = hypotf(re, im);
        const float *p = c.position[v];
        largest = fmaxf(largest, size);
        fprintf(csv, "%.9g,%.9g,%.9g,%.9g,%.9g\n", (double)p[0], (double)p[1], (double)p[2], (double)size,
                (double)atan2f(im, re) * 180 / M_PI);
    }
    finish(csv, "figure7");
    FILE *svg = svg_begin(folder, "figure7", TOP + 3 * (ROW + GAP));
    int count = facets_of(&c, facets);
    for (int i = 0; i < count; i++) svg_facet(svg, &c, up, facets[i].at, largest);
    svg_text(svg, 16, TOP + 4, "start", "up and down: hue is how far ahead a point moves, chroma how much");
    svg_end(svg, "figure7");
    free(facets);
    character_free(&c);
}

int main(int argc, char **argv)
{
    if (argc != 2) {
        fputs("usage: paper_figures <folder>\n", stderr);
        return 2;
    }
    for (size_t i = 0; i < sizeof curves / sizeof curves[0]; i++) write_curves(argv[1], &curves[i]);
    write_responses(argv[1]);
    write_tail(argv[1]);
    write_phases(argv[1]);
    return 0;
}
