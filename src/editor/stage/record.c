/// Records a dragged body: a place per sample, knots fitted to them, and the path on the stage.
#include "base/need.h"
#include "editor/core/core.h"
#include "editor/stage/parts.h"
#include "ui/font.h"
#include "ui/theme.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

void record_begin(struct stage *stage, struct core *core)
{
    struct record *record = &stage->record;
    if (record->running) return;
    *record = (struct record){.running = true, .first = (int)ceil(core->playback.position)};
    core->playback.playing = true;
    core_message(core, false, "Recording the body: release to keep it.");
}

void record_advance(struct stage *stage, const struct core *core)
{
    struct record *record = &stage->record;
    if (!record->running || !body_is_held(core)) return;
    double offset[3], position = core->playback.position;
    body_drag_way(stage, core, offset);
    int next = record->first + record->count;
    bool ended = position < next - 1 || !core->playback.playing || record->count == RECORD_SAMPLES ||
                 next >= document_samples(core->document);
    if (ended) {
        record->running = false;
        return;
    }
    const double from = record->seen_position, span = position - from;
    for (; next <= position && record->count < RECORD_SAMPLES; next++) {
        double share = span > 0 && record->count > 0 ? fmax(0, (next - from) / span) : 1;
        for (int k = 0; k < 3; k++) {
            record->way[k][record->count] = record->seen[k] + share * (offset[k] - record->seen[k]);
        }
        record->count++;
    }
    record->seen_position = position;
    for (int k = 0; k < 3; k++) record->seen[k] = offset[k];
}

bool record_has_motion(const struct stage *stage) { return stage->record.count >= 3; }

void record_forget(struct stage *stage) { stage->record = (struct record){0}; }

/// The cubic through some of the values, level at both ends; false if it cannot be solved.
static bool solve_through(wiggly_solver *solver, const double *values, int count, const int *knots, int knot_count,
                          wiggly_knot *buffer, double *total)
{
    wiggly_desc desc = wiggly_default_desc();
    wiggly_curve curve = {.size = sizeof curve, .total = total};
    desc.samples = count;
    desc.mode = WIGGLY_CUBIC;
    for (int i = 0; i < knot_count; i++) {
        bool end = i == 0 || i == knot_count - 1;
        buffer[i] = (wiggly_knot){
            .sample = knots[i], .value = values[knots[i]], .has_slope = end, .stiffness = RECORD_STIFFNESS};
    }
    desc.knots = buffer;
    desc.knot_count = knot_count;
    return wiggly_solve(solver, &desc, &curve) < WIGGLY_ERROR_ARGUMENT;
}

/// The sample with the largest distance between two curves, and that distance. Excludes neighbours of the ends: a knot there would change
/// the end's slope.
static int farthest(const double *a, const double *b, int count, double *distance)
{
    int at = 0;
    *distance = 0;
    for (int i = 2; i < count - 2; i++) {
        double d = fabs(a[i] - b[i]);
        if (d > *distance) *distance = d, at = i;
    }
    return at;
}

static void insert_sorted(int *knots, int count, int sample)
{
    int i = count;
    for (; i > 0 && knots[i - 1] > sample; i--) knots[i] = knots[i - 1];
    knots[i] = sample;
}

int record_simplify(const double *values, int count, double tolerance, int *knots, int capacity)
{
    wiggly_solver *solver = NULL;
    double *total = need((size_t)count, sizeof *total), miss = 0;
    wiggly_knot *buffer = need((size_t)capacity, sizeof *buffer);
    int made = 2;
    knots[0] = 0;
    knots[1] = count - 1;
    if (wiggly_create(count, capacity, &solver) != WIGGLY_OK) need_failed();
    while (solve_through(solver, values, count, knots, made, buffer, total)) {
        int at = farthest(values, total, count, &miss);
        if (miss <= tolerance || made == capacity) break;
        insert_sorted(knots, made++, at);
    }
    wiggly_destroy(solver);
    free(buffer);
    free(total);
    return made;
}

enum { MAX_KNOTS = 64 };

static const double STILL = 2e-3;     ///< metres; less is no movement
static const double TOLERANCE = 4e-3; ///< metres between the recorded path and the cubic

static double largest(const double *values, int count)
{
    double most = 0;
    for (int i = 0; i < count; i++) most = fmax(most, fabs(values[i]));
    return most;
}

static void clear_knots(struct core *core, int spline, int from, int to)
{
    const struct document *document = core->document;
    for (;;) {
        int at = spline_lower_bound(document, document->splines[spline], from);
        const struct spline *cleared = document->splines[spline];
        if (at == cleared->knot_count || document_sample(document, cleared->knots[at].frame) > to) return;
        if (!edit_knot_remove(core->document, spline, cleared->knots[at].id, &core->error)) return;
    }
}

/// Keys a coordinate's motion; returns the number of knots. `swings` receives a new spline that swings the tail with it; `why` what limited
/// a knot. Before and after it a newly keyed body stands still, except in a loop, where it moves back by itself.
static int key_coordinate(const struct stage *stage, struct core *core, int coordinate, int *swings,
                          char why[STOPPED_SIZE])
{
    const struct record *record = &stage->record;
    const struct document *document = core->document;
    const int rig = stage->body_drag.rig, last = document_samples(document) - 1;
    const bool is_new = tail_of(document, rig)->position[coordinate].track < 0;
    double way[RECORD_SAMPLES];
    int knots[MAX_KNOTS];
    int spline = base_spline(stage, core, coordinate);
    if (spline < 0) return 0;
    int count = record->count, end = document_last_knot_sample(document, document->splines[spline]);
    if (record->first + count - 1 > end) count = end - record->first + 1;
    for (int i = 0; i < count; i++)
        way[i] = base_value(core, rig, coordinate, record->first + i) + record->way[coordinate][i];
    int made = count >= 2 ? record_simplify(way, count, TOLERANCE, knots, MAX_KNOTS) : 0;
    if (made == 0) return 0;
    if (!is_new) clear_knots(core, spline, record->first, record->first + count - 1);
    for (int i = 0; i < made; i++) {
        base_put_knot(core, spline, record->first + knots[i], way[knots[i]], i == 0 || i == made - 1, why);
    }
    if (is_new && !stage->body_drag.loops) {
        if (record->first > 1) base_put_knot(core, spline, 0, way[0], true, why);
        if (record->first + count < last) base_put_knot(core, spline, last, way[count - 1], true, why);
    }
    if (is_new) base_follow(stage, core, coordinate, spline);
    const int hung = base_hang_channels(stage, core, coordinate, spline);
    if (hung >= 0) *swings = hung;
    core_edited(core, spline);
    return made;
}

void record_keep(struct stage *stage, struct core *core)
{
    struct record *record = &stage->record;
    char text[768], why[STOPPED_SIZE] = "";
    int made = 0, swings = -1;
    base_begin(stage, core);
    for (int k = 0; k < 3; k++) {
        if (largest(record->way[k], record->count) >= STILL) made += key_coordinate(stage, core, k, &swings, why);
    }
    snprintf(text, sizeof text, made == 0 ? "Nothing moved, so nothing was recorded." : "%d knots recorded.", made);
    core_add_stopped(why, text, sizeof text);
    base_say_channel(core, swings, text, sizeof text);
    core_message(core, false, "%s", text);
    record_forget(stage);
}

enum { MARGIN = 12, HEIGHT = 22, PAD = 8, DOT = 10, MAX_POINTS = 256 };

/// In the top right corner, below the caption.
static void show_sign(struct core *core, bool runs, const char *text)
{
    const struct rect stage = core->layout.stage;
    const float width = ceilf(font_width(FONT_LABEL_BOLD, THEME_TEXT_NORMAL, text)) + DOT + 3 * PAD;
    const struct rect sign = {stage.x + stage.w - MARGIN - width,
                              stage.y + fmaxf(MARGIN, caption_height(stage, core->document)), width, HEIGHT};
    const struct rect dot = {sign.x + PAD, sign.y + (HEIGHT - DOT) / 2.0f, DOT, DOT};
    drawlist_rounded(&core->list, sign, HEIGHT / 2.0f, theme()->panel);
    if (runs) {
        drawlist_rounded(&core->list, dot, DOT / 2.0f, theme()->error);
    } else {
        drawlist_rounded_line(&core->list, dot, DOT / 2.0f, 1.5f, theme()->error);
    }
    drawlist_text(&core->list, dot.x + DOT + PAD, sign.y + HEIGHT - 7, FONT_LABEL_BOLD, THEME_TEXT_NORMAL,
                  theme()->error, text);
}

/// The recorded path, with the base's place at each sample.
static void show_way(const struct stage *stage, struct core *core)
{
    const struct record *record = &stage->record;
    const int rig = stage->body_drag.rig, step = record->count / MAX_POINTS + 1;
    float points[MAX_POINTS][2];
    int count = 0;
    for (int i = 0; i < record->count; i += step) {
        float place[3];
        for (int k = 0; k < 3; k++) {
            const struct param *param = &tail_of(core->document, rig)->position[k];
            double value = param->value;
            if (param->track >= 0) value = base_value(core, rig, k, record->first + i);
            place[k] = (float)(value + record->way[k][i]);
        }
        if (!stage_project_point(stage, core->layout.stage, place, points[count++])) return;
    }
    if (count > 1) drawlist_line(&core->list, (const float *)points, count, 2, theme()->error);
}

void record_show(struct stage *stage, struct core *core)
{
    const struct document *document = core->document;
    const bool is_held = body_is_held(core);
    const int rig = is_held ? stage->body_drag.rig : core->hover.rig;
    const struct tail *shown = is_held || core->hover.thing == &thing_body ? tail_of(document, rig) : NULL;
    bool moves = false;
    for (int k = 0; shown && k < 3; k++) moves |= shown->position[k].track >= 0;
    if (moves && !core->overlays.trail) path_show(stage, core, TRAIL_OF_BODY, (struct rig_point){rig, POINT_BASE});
    if (is_held && stage->record.running) {
        char text[32];
        show_way(stage, core);
        snprintf(text, sizeof text, "REC %.1f s", stage->record.count / (document->fps * document->substeps));
        show_sign(core, true, text);
    } else if (core->record_armed && document_tail(document, 0)) {
        show_sign(core, false, "Drag the body to record it");
    }
}
