/// The brush works like an airbrush: a stroke adds flow × time to every vertex under it.
#include "base/error.h"
#include "editor/core/characters.h"
#include "editor/core/core.h"
#include "editor/core/drag.h"
#include "editor/stage/parts.h"
#include "maths/maths.h"
#include "model/vector.h"
#include "ui/theme.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

static const double RADIUS_LEAST = 0.01, RADIUS_MOST = 0.5, STRENGTH_LEAST = 0.02;
static const double WHEEL_STEP = 0.15;   ///< per wheel notch, as a power of e
static const double SHORTEST = 1.0 / 60; ///< seconds of paint for a click
static const float STRIDE = 0.3f;        ///< of the radius on the screen, between spots within a frame
static const float RIM = 0.25f;          ///< search beyond the radius, so that the ring can be drawn between vertices

/// The brush's radius on a figure, metres.
static float radius_of(const struct brush *brush, const struct figure *figure)
{
    return (float)brush->radius * (figure->hi[1] - figure->lo[1]);
}

static void free_work(struct brush_work *work)
{
    pool_free(&work->pool);
    *work = (struct brush_work){0};
}

void brush_free(struct painting *painting) { free_work(&painting->work); }

/// Allocates for a figure, unless there is enough already.
static void reserve(struct brush_work *work, int vertices)
{
    const size_t room = (size_t)vertices;
    if (work->capacity >= vertices) return;
    free_work(work);
    work->vertices = pool_take(&work->pool, room, sizeof *work->vertices);
    work->values = pool_take(&work->pool, room, sizeof *work->values);
    work->steps = pool_take(&work->pool, room, sizeof *work->steps);
    work->turned = pool_take(&work->pool, room, sizeof *work->turned);
    work->spent = pool_take(&work->pool, room, sizeof *work->spent);
    reach_create(&work->reach, &work->pool, vertices);
    for (int i = 0; i < vertices; i++) {
        work->turned[i][0] = 1;
        work->turned[i][1] = 0;
    }
    work->capacity = vertices;
}

/// The painted figure, with the skin posed as shown, or NULL.
static const struct figure *pose_figure(struct stage *stage, const struct core *core, int *coordinate)
{
    const struct figure *figure = characters_figure(core, coordinate);
    if (!figure) return NULL;
    reserve(&stage->painting.work, figure->character.vertex_count);
    return skin_pose(stage, core->characters.character) ? figure : NULL;
}

/// Names of strokes, and the modes with Shift and Ctrl.
static const struct stroke {
    const char *label;
    enum brush_mode smoothed, other;
} strokes[] = {
    [BRUSH_ADVANCE] = {"Advance phase", BRUSH_SMOOTH_PHASE, BRUSH_DELAY},
    [BRUSH_DELAY] = {"Delay phase", BRUSH_SMOOTH_PHASE, BRUSH_ADVANCE},
    [BRUSH_SMOOTH_PHASE] = {"Smooth phase", BRUSH_ADVANCE, BRUSH_SMOOTH_PHASE},
    [BRUSH_MORE] = {"More amplitude", BRUSH_SMOOTH_AMPLITUDE, BRUSH_LESS},
    [BRUSH_LESS] = {"Less amplitude", BRUSH_SMOOTH_AMPLITUDE, BRUSH_MORE},
    [BRUSH_SMOOTH_AMPLITUDE] = {"Smooth amplitude", BRUSH_MORE, BRUSH_SMOOTH_AMPLITUDE},
    [BRUSH_ERASE] = {"Erase paint", BRUSH_ERASE, BRUSH_ERASE},
};

/// Mode of a stroke with modifiers: Shift smooths, Ctrl reverses.
static enum brush_mode brush_stroke(const struct brush *brush, unsigned mods)
{
    const struct stroke *stroke = &strokes[brush->mode];
    return mods & MOD_SHIFT ? stroke->smoothed : mods & MOD_CTRL ? stroke->other : brush->mode;
}

/// The surface points under the pointer's path since the last frame.
static int find_way(const struct stage *stage, const struct core *core, const struct figure *figure,
                    struct surface_spot spots[REACH_MAX_SPOTS])
{
    const struct painting *painting = &stage->painting;
    const float dx = core->pointer_x - painting->x, dy = core->pointer_y - painting->y;
    const float metres = 2 * stage->camera.distance / stage->view.projection[5] / core->layout.stage.h;
    const float stride = fmaxf(1, STRIDE * radius_of(&core->brush, figure) / metres);
    const int steps = (int)fminf(REACH_MAX_SPOTS, fmaxf(1, ceilf(maths_hypotf(dx, dy) / stride)));
    int count = 0;
    for (int i = 1; i <= steps; i++) {
        const float share = (float)i / (float)steps;
        count += skin_spot(stage, figure, painting->x + share * dx, painting->y + share * dy, &spots[count]);
    }
    return count;
}

/// 1 in the middle, 0 at the rim, with zero slope at both.
static float falloff(float distance, float radius)
{
    const float t = distance / radius;
    return t < 1 ? (1 - t * t) * (1 - t * t) : 0;
}

enum { SMOOTHINGS = 4 }; ///< passes per frame

static const double PHASE_FLOW = 6.2831853071795865;     ///< radians per second at full strength
static const double AMPLITUDE_FLOW = 1.3862943611198906; ///< log of a: four times as much per second
static const float STROKE_LEAD = 1.5707963f,
                   STROKE_SWELL = 1.3862944f; ///< a stroke saturates at these, however long:
                                              ///< larger differences make a surface fold through itself
static const double BLENDING_FLOW = 12;       ///< of smoothing and erasing, 1/s
static const double MOST_BLEND = 0.5;         ///< per pass; more would overshoot
static const float MOST_LEAD = 12.5663706f, LEAST_SWELL = -4.60517f, MOST_SWELL = 1.3862944f; ///< ±720°; 0.01 … 4
static const float STILL = 1e-4f; ///< of the largest amplitude; phases below this mean nothing

static double blend(double flow) { return fmin(MOST_BLEND, BLENDING_FLOW * flow / SMOOTHINGS); }

static void multiply(const float a[2], const float b[2], float out[2])
{
    const float re = a[0] * b[0] - a[1] * b[1], im = a[0] * b[1] + a[1] * b[0];
    out[0] = re;
    out[1] = im;
}

/// A vertex's Ñ' with this frame's changes so far.
static void motion_of(const struct brush_work *work, const struct coordinate *c, uint32_t vertex, float out[3][2])
{
    for (int k = 0; k < 3; k++)
        multiply(work->turned[vertex], (const float[2]){c->re[vertex][k], c->im[vertex][k]}, out[k]);
}

/// Difference between a vertex and its neighbours: log of amplitude, and the angle φ for which e^{jφ} Ñ' is closest to their mean m, which
/// is the angle of Σ conj(Ñ') m over the three directions. These angles need no unwrapping. False without motion.
static bool difference(const struct brush_work *work, const struct figure *figure, int coordinate, int vertex,
                       float out[2])
{
    const struct coordinate *c = &figure->character.coordinates[coordinate];
    const int first = figure->edges.first[vertex], end = figure->edges.first[vertex + 1];
    float own[3][2], turn[2] = {0}, size = 0, mean = 0, largest = 0;
    for (int k = 0; k < 3; k++) largest = fmaxf(largest, figure->largest[coordinate][k]);
    motion_of(work, c, (uint32_t)vertex, own);
    for (int k = 0; k < 3; k++) size += own[k][0] * own[k][0] + own[k][1] * own[k][1];
    for (int e = first; e < end; e++) {
        float other[3][2], square = 0;
        motion_of(work, c, figure->edges.other[e], other);
        for (int k = 0; k < 3; k++) {
            turn[0] += own[k][0] * other[k][0] + own[k][1] * other[k][1];
            turn[1] += own[k][0] * other[k][1] - own[k][1] * other[k][0];
            square += other[k][0] * other[k][0] + other[k][1] * other[k][1];
        }
        mean += sqrtf(square) / (float)(end - first);
    }
    size = sqrtf(size);
    if (!(size > STILL * largest) || !(mean > STILL * largest)) return false;
    out[0] = maths_logf(mean / size);
    out[1] = maths_atan2f(turn[1], turn[0]);
    return true;
}

/// One Jacobi pass over all vertices, so that their order does not matter.
static void smooth_once(struct painting *painting, const struct figure *figure, int coordinate, float radius,
                        int count, double flow)
{
    struct brush_work *work = &painting->work;
    const bool phase = painting->stroke == BRUSH_SMOOTH_PHASE;
    const float share = (float)blend(flow);
    for (int i = 0; i < count; i++) {
        const int vertex = work->vertices[i];
        const float weight = share * falloff(work->reach.distance[vertex], radius);
        float by[2] = {0, 0};
        difference(work, figure, coordinate, vertex, by);
        work->steps[i][0] = phase ? 0 : weight * by[0];
        work->steps[i][1] = phase ? weight * by[1] : 0;
    }
    for (int i = 0; i < count; i++) {
        float *value = work->values[i], *turned = work->turned[work->vertices[i]];
        const float swell = glm_clamp(value[0] + work->steps[i][0], LEAST_SWELL, MOST_SWELL) - value[0];
        const float lead = glm_clamp(value[1] + work->steps[i][1], -MOST_LEAD, MOST_LEAD) - value[1];
        const float size = maths_expf(swell);
        multiply(turned, (const float[2]){size * maths_cosf(lead), size * maths_sinf(lead)}, turned);
        value[0] += swell;
        value[1] += lead;
    }
}

static void smooth(struct painting *painting, const struct figure *figure, int coordinate, float radius, int count,
                   double flow)
{
    struct brush_work *work = &painting->work;
    for (int pass = 0; pass < SMOOTHINGS; pass++) smooth_once(painting, figure, coordinate, radius, count, flow);
    for (int i = 0; i < count; i++) {
        work->turned[work->vertices[i]][0] = 1;
        work->turned[work->vertices[i]][1] = 0;
    }
}

/// Limits a step so that the stroke's sum `spent` stays within `most`; adds the step to it.
static float saturate(float step, float most, float *spent)
{
    const float allowed = fminf(step, fmaxf(most - *spent, 0));
    *spent += allowed;
    return allowed;
}

/// Changes one vertex's paint, in modes that ignore its neighbours.
static void change(enum brush_mode mode, double flow, float weight, float *spent, float value[2])
{
    const bool turns = mode == BRUSH_ADVANCE || mode == BRUSH_DELAY,
               swells = mode == BRUSH_MORE || mode == BRUSH_LESS;
    const float lead = turns ? saturate(weight * (float)(PHASE_FLOW * flow), weight * STROKE_LEAD, spent) : 0;
    const float swell = swells ? saturate(weight * (float)(AMPLITUDE_FLOW * flow), weight * STROKE_SWELL, spent) : 0;
    const float kept = 1 - weight * (float)fmin(1, BLENDING_FLOW * flow);
    if (mode == BRUSH_ADVANCE) value[1] = glm_clamp(value[1] + lead, -MOST_LEAD, MOST_LEAD);
    if (mode == BRUSH_DELAY) value[1] = glm_clamp(value[1] - lead, -MOST_LEAD, MOST_LEAD);
    if (mode == BRUSH_MORE) value[0] = glm_clamp(value[0] + swell, LEAST_SWELL, MOST_SWELL);
    if (mode == BRUSH_LESS) value[0] = glm_clamp(value[0] - swell, LEAST_SWELL, MOST_SWELL);
    if (mode != BRUSH_ERASE) return;
    for (int k = 0; k < 2; k++) value[k] = fabsf(value[k]) < 1e-3f ? 0 : kept * value[k];
}

/// A dab on the vertices of work.reach: `flow` is strength times time. The brush owns the arrays.
static struct dab brush_dab(struct painting *painting, const struct paint *paint, const struct figure *figure,
                            int coordinate, float radius, double flow)
{
    struct brush_work *work = &painting->work;
    const bool smooths = painting->stroke == BRUSH_SMOOTH_PHASE || painting->stroke == BRUSH_SMOOTH_AMPLITUDE;
    int count = 0;
    for (int i = 0; i < work->reach.count; i++) {
        const int vertex = work->reach.vertices[i];
        const float weight = falloff(work->reach.distance[vertex], radius);
        const float *old = paint->values[(size_t)coordinate * (size_t)paint->vertices + (size_t)vertex];
        if (!(weight > 0)) continue;
        work->vertices[count] = vertex;
        for (int k = 0; k < 2; k++) work->values[count][k] = old[k];
        change(painting->stroke, flow, weight, &work->spent[vertex], work->values[count]);
        count++;
    }
    if (smooths) smooth(painting, figure, coordinate, radius, count, flow);
    return (struct dab){coordinate, count, work->vertices, (const float(*)[2])work->values};
}

/// Continues the stroke for drag.dt seconds.
static void apply(void *room, struct core *core)
{
    struct stage *stage = room;
    const struct brush *brush = &core->brush;
    struct painting *painting = &stage->painting;
    struct surface_spot spots[REACH_MAX_SPOTS];
    int coordinate;
    const struct figure *figure = pose_figure(stage, core, &coordinate);
    const struct paint *paint = figure ? characters_selected(core)->painted : NULL;
    if (!paint || !models_paint_fits(paint, figure)) return;
    const int count = find_way(stage, core, figure, spots);
    painting->x = core->pointer_x;
    painting->y = core->pointer_y;
    painting->has_dabbed = true;
    if (count == 0) return;
    reach_find(&painting->work.reach, figure, spots, count, radius_of(brush, figure));
    const struct dab dab =
        brush_dab(painting, paint, figure, coordinate, radius_of(brush, figure), brush->strength * core->drag.dt);
    edit_paint(core->document, characters_rig(core), &dab, &core->error);
}

static void end(void *room, struct core *core, bool keep)
{
    const struct stage *stage = room;
    if (!keep || stage->painting.has_dabbed) return;
    core->drag.dt = SHORTEST;
    apply(room, core);
}

static const struct drag_owner owner = {.cursor = CURSOR_ARROW, .goes_on = true, .apply = apply, .end = end};

/// Whether a stroke is running.
static bool brush_paints(const struct core *core) { return core->drag.owner == &owner; }

bool brush_press(struct stage *stage, struct core *core, const struct event *event)
{
    const struct brush *brush = &core->brush;
    struct painting *painting = &stage->painting;
    int coordinate;
    if (!brush->on || event->button != BUTTON_LEFT || history_is_open(core->history)) return false;
    const struct figure *figure = pose_figure(stage, core, &coordinate);
    if (!figure || !skin_spot(stage, figure, event->x, event->y, &painting->spot)) return false;
    const struct paint *paint = characters_selected(core)->painted;
    if (paint && !models_paint_fits(paint, figure)) {
        core_message(core, true, "The paint in this scene belongs to another model. Remove it first.");
        return true;
    }
    painting->stroke = brush_stroke(brush, event->mods);
    drag_begin(core, &owner, stage, strokes[painting->stroke].label, event);
    painting->x = event->x;
    painting->y = event->y;
    painting->has_dabbed = false;
    memset(painting->work.spent, 0, (size_t)painting->work.capacity * sizeof *painting->work.spent);
    drag_start_moving(core);
    if (!paint) characters_blank_paint(core, figure);
    core_settle(core);
    return true;
}

bool brush_wheel(struct core *core, const struct event *event)
{
    struct brush *brush = &core->brush;
    const double factor = maths_exp(WHEEL_STEP * fmin(fmax(event->dy, -20), 20));
    if (!brush->on || !(event->mods & (MOD_CTRL | MOD_SHIFT))) return false;
    if (event->mods & MOD_CTRL) {
        brush->radius = fmin(fmax(brush->radius * factor, RADIUS_LEAST), RADIUS_MOST);
        core_message(core, false, "Brush: radius %.0f %% of the character's height.", 100 * brush->radius);
    } else {
        brush->strength = fmin(fmax(brush->strength * factor, STRENGTH_LEAST), 1);
        core_message(core, false, "Brush: strength %.0f %%.", 100 * brush->strength);
    }
    return true;
}

void brush_pose(struct stage *stage, struct core *core, bool covered)
{
    const struct brush *brush = &core->brush;
    struct painting *painting = &stage->painting;
    const bool pointed = rect_contains(core->layout.stage, core->pointer_x, core->pointer_y);
    const bool free_hand = !core->drag.owner || brush_paints(core);
    int coordinate;
    painting->covers = false;
    if (!brush->on || !pointed || !free_hand || covered) return;
    const struct figure *figure = pose_figure(stage, core, &coordinate);
    if (!figure || !skin_spot(stage, figure, core->pointer_x, core->pointer_y, &painting->spot)) return;
    painting->covers = true;
    reach_find(&painting->work.reach, figure, &painting->spot, 1, (1 + RIM) * radius_of(brush, figure));
}

enum { STATE_HEIGHT = 46 };

static const double DEGREES = 57.29577951308232;

static const float RING_WIDTH = 1.5f, SHADE_WIDTH = 3.5f;
static const uint32_t RING = 0xFFFFFFFFu, SHADE = 0x00000060u; ///< in every theme, on the map's colours

/// Adds a triangle that faces the eye. A corner is inside by the rest of `radius`, in pixels by `scale`.
static void add_reached(struct stage *stage, const uint32_t *corner, float radius, float scale)
{
    float xy[3][2], inside[3];
    for (int c = 0; c < 3; c++) {
        inside[c] = (radius - stage->painting.work.reach.distance[corner[c]]) * scale;
        if (!isfinite(inside[c])) return;
        if (!stage_project_point(stage, stage->view.viewport, stage->skin.posed[corner[c]], xy[c])) return;
    }
    if ((xy[1][0] - xy[0][0]) * (xy[2][1] - xy[0][1]) < (xy[1][1] - xy[0][1]) * (xy[2][0] - xy[0][0]))
        silhouette_add_triangle(&stage->silhouette, (const float(*)[2])xy, inside);
}

/// Outlines the brush's reach.
static void show_ring(struct stage *stage, struct core *core, const struct figure *figure)
{
    struct silhouette *silhouette = &stage->silhouette;
    const struct reach *reach = &stage->painting.work.reach;
    const float radius = radius_of(&core->brush, figure);
    silhouette_clear(silhouette);
    for (int i = 0; i < reach->count; i++) {
        float xy[2];
        if (!stage_project_point(stage, stage->view.viewport, stage->skin.posed[reach->vertices[i]], xy)) return;
        silhouette_widen(silhouette, xy, 0);
    }
    if (!silhouette_open(silhouette, core->layout.stage)) return;
    const float scale = 0.5f * fmaxf(silhouette->area.w, silhouette->area.h) / radius;
    for (int t = 0; t < figure->character.index_count; t += 3)
        add_reached(stage, figure->character.indices + t, radius, scale);
    silhouette_soften(silhouette);
    for (int count; (count = silhouette_follow(silhouette)) > 0;) {
        drawlist_line(&core->list, silhouette->points[0], count, SHADE_WIDTH, SHADE);
        drawlist_line(&core->list, silhouette->points[0], count, RING_WIDTH, RING);
    }
}

/// Describes the paint at the vertex nearest to the pointer; leaves the text alone if it has none.
static void describe_spot(const struct stage *stage, const struct paint *paint, int coordinate, char *text,
                          size_t size)
{
    const struct surface_spot *spot = &stage->painting.spot;
    int nearest = 0;
    for (int c = 1; c < 3; c++) {
        if (spot->weight[c] > spot->weight[nearest]) nearest = c;
    }
    const float *value = paint->values[(size_t)coordinate * (size_t)paint->vertices + spot->corner[nearest]];
    if (value[0] == 0 && value[1] == 0) return;
    snprintf(text, size, "painted here: %+.0f°, × %.2f", printable_number((double)value[1] * DEGREES, 1),
             maths_exp((double)value[0]));
}

static void show_state(const struct stage *stage, struct core *core, const struct paint *paint, int coordinate)
{
    const struct brush *brush = &core->brush;
    const struct painting *painting = &stage->painting;
    const struct rect legend = characters_legend(core);
    const struct rect box = {legend.x, legend.y - STATE_HEIGHT - 8, legend.w, STATE_HEIGHT};
    const bool paints = brush_paints(core);
    const char *label = strokes[paints ? painting->stroke : brush_stroke(brush, core->mods)].label;
    char text[64] = "nothing painted here";
    if (painting->covers && paint) describe_spot(stage, paint, coordinate, text, sizeof text);
    if (!painting->covers)
        snprintf(text, sizeof text, "radius %.0f %%, strength %.0f %%", 100 * brush->radius, 100 * brush->strength);
    stage_scrim(core, box);
    drawlist_text_fit(&core->list, box.x + 10, box.y + 18, box.w - 20, FONT_LABEL_BOLD, THEME_TEXT_SMALL,
                      theme()->text, label);
    drawlist_text_fit(&core->list, box.x + 10, box.y + 35, box.w - 20, FONT_LABEL, THEME_TEXT_SMALL,
                      theme()->text_dim, text);
}

void brush_show(struct stage *stage, struct core *core)
{
    int coordinate;
    const struct figure *figure = core->brush.on ? characters_figure(core, &coordinate) : NULL;
    if (!figure) return;
    const struct paint *paint = characters_selected(core)->painted;
    if (stage->painting.covers) show_ring(stage, core, figure);
    show_state(stage, core, paint && models_paint_fits(paint, figure) ? paint : NULL, coordinate);
}
