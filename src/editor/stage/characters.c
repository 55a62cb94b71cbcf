/// Soft characters on the stage: the legend of their phases, their floors, and the brush.
/// It works like an airbrush: a stroke adds flow × time to every vertex under it.
#include "base/error.h"
#include "base/names.h"
#include "editor/core/core.h"
#include "editor/stage/state.h"
#include "maths/maths.h"
#include "model/vector.h"
#include "ui/font.h"
#include "ui/theme.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { SECTORS = 36, RINGS = 5, LEGEND_WIDTH = 196, LEGEND_HEIGHT = 132 };

static const float WHEEL = 30; ///< radius
static const float TEXT_SIZE = 11;

static void show_centred(struct drawlist *list, float x, float y, const char *text, uint32_t color)
{
    const float width = font_width(FONT_LABEL, TEXT_SIZE, text);
    drawlist_text(list, x - width / 2, y, FONT_LABEL, TEXT_SIZE, color, text);
}

/// The legend's place.
static struct rect characters_legend(const struct core *core)
{
    const struct rect stage = core->view.layout.stage;
    return (struct rect){stage.x + 12, stage.y + stage.h - LEGEND_HEIGHT - 12, LEGEND_WIDTH, LEGEND_HEIGHT};
}

/// The legend of the phases. Angles as in the complex plane: in step to the right, a quarter ahead at the top.
static void show_legend(struct core *core)
{
    static const char *const directions[] = {"left and right (x)", "up and down (y)", "back and forth (z)"};
    const struct coordinate *coordinate = characters_coordinate(core);
    struct drawlist *list = &core->list;
    if (!coordinate || !(core->view.on[SWITCH_PHASE_MAP] || core->focus.brush.on)) return;
    const struct rect box = characters_legend(core);
    const float x = box.x + box.w / 2, y = box.y + 80;
    char title[96];
    snprintf(title, sizeof title, "%.*s: %s", name_fit(coordinate->name, 40), coordinate->name,
             directions[core->focus.characters.axis]);
    stage_scrim(core, box);
    drawlist_text_fit(list, box.x + 10, box.y + 18, box.w - 20, FONT_LABEL, TEXT_SIZE, theme()->text, title);

    // Its wheel: amplitude grows outwards. Rings and sectors overlap, so that no edges show.
    const float step = 6.28318531f / SECTORS;
    for (int ring = RINGS; ring >= 1; ring--) {
        const float radius = WHEEL * (float)ring / RINGS, amplitude = ((float)ring - 0.5f) / (RINGS - 0.5f);
        for (int s = 0; s < SECTORS; s++) {
            const float middle = step * (float)s, from = middle - 0.62f * step, to = middle + 0.62f * step;
            const float xy[3][2] = {{x, y},
                                    {x + radius * maths_cosf(from), y - radius * maths_sinf(from)},
                                    {x + radius * maths_cosf(to), y - radius * maths_sinf(to)}};
            drawlist_convex(list, xy[0], 3,
                            phase_color(amplitude * maths_cosf(middle), amplitude * maths_sinf(middle)));
        }
    }
    for (int i = 0; i < 8; i++) { // the same lines as on the character (stage_mesh.frag)
        const float angle = 0.785398163f * ((float)i + 0.5f), along = maths_cosf(angle), up = maths_sinf(angle),
                    from = 0.2f * WHEEL;
        const float xy[] = {x + from * along, y - from * up, x + WHEEL * along, y - WHEEL * up};
        drawlist_line(list, xy, 2, 1.25f, 0x000000A0u);
    }
    show_centred(list, x, y - WHEEL - 6, "ahead", theme()->text_dim);
    show_centred(list, x, y + WHEEL + 14, "behind", theme()->text_dim);
    drawlist_text(list, x + WHEEL + 8, y + 4, FONT_LABEL, TEXT_SIZE, theme()->text_dim, "in step");
    const char *left = "opposite";
    drawlist_text(list, x - WHEEL - 8 - font_width(FONT_LABEL, TEXT_SIZE, left), y + 4, FONT_LABEL, TEXT_SIZE,
                  theme()->text_dim, left);
}

// Floors: hover, vertical drags and drawing.

static const float AROUND = 0.42f;    ///< from the middle to the edge, as a share of the character's width or depth
static const float EDGE_REACH = 5;    ///< pixels
static const double LEAST_RISE = 0.3; ///< cosine of the camera's elevation; below it height follows the pointer less

/// A floor's corners in order, on the screen.
struct shown_floor {
    float xy[4][2];
    int first; ///< corner nearest to the eye
};

/// A shown character's floor and its place on the screen, or NULL.
static const struct model_rig *floors_find(const struct stage *stage, const struct stage_model *shown,
                                           struct shown_floor *floor)
{
    const struct document *document = stage->core->document;
    const struct figure *figure = shown ? shown->posed.figure : NULL;
    if (!figure || shown->rig < 0 || shown->rig >= document->rig_count || !rig_has_floor(document->rigs[shown->rig]))
        return NULL;
    const struct model_rig *rig = &document->rigs[shown->rig]->model;
    static const float sides[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    const float *lo = figure->lo, *hi = figure->hi, scale = (float)rig->scale;
    const vec3s middle = {{0.5f * (lo[0] + hi[0]), 0, 0.5f * (lo[2] + hi[2])}};
    const vec3s under = glms_mat4_mulv3(mat4_from(shown->posed.root), middle, 1.0f);
    float nearest = INFINITY;
    for (int i = 0; i < 4; i++) {
        float at[3] = {0, (float)rig->floor, 0};
        for (int k = 0; k < 3; k += 2)
            at[k] = under.raw[k] + sides[i][k / 2] * AROUND * scale * fmaxf(hi[0] - lo[0], hi[2] - lo[2]);
        if (!stage_project_point(stage, at, floor->xy[i])) return NULL;
        const float depth = glms_vec3_distance(vec3_from(stage->view.eye), vec3_from(at));
        if (depth < nearest) nearest = depth, floor->first = i;
    }
    return rig;
}

struct hover floors_hover(const struct stage *stage, float x, float y)
{
    struct hover hover = {.thing = NULL};
    float best = EDGE_REACH;
    for (int m = 0; m < stage->view.model_count; m++) {
        const struct stage_model *shown = &stage->view.models[m];
        struct shown_floor floor = {0};
        if (!floors_find(stage, shown, &floor)) continue;
        for (int side = 1; side < 4; side += 2) { // edges behind the character would block its surface
            const float *a = floor.xy[floor.first], *b = floor.xy[(floor.first + side) % 4];
            const float along = segment_nearest(a, b, (const float[2]){x, y});
            const float distance = maths_hypotf(a[0] + along * (b[0] - a[0]) - x, a[1] + along * (b[1] - a[1]) - y);
            if (distance >= best) continue;
            best = distance;
            hover = (struct hover){.thing = &thing_floor, .rig = shown->rig, .x = x, .y = y};
        }
    }
    return hover;
}

/// Moves the floor to the pointer.
static void move_floor(void *room, struct core *core)
{
    const double scale = ((const struct stage *)room)->floor_scale;
    const struct document *document = core->document;
    const int rig = core->input.hover.rig;
    if (rig >= document->rig_count || !rig_has_floor(document->rigs[rig])) return; // an edit removed it
    struct rig changed = *document->rigs[rig];                                     // as at the start
    const double height = core_round(changed.model.floor - core->input.drag.moved_y / scale, 0.5 / scale);
    changed.model.floor = fmin(height, changed.model.position[1]);
    edit_rig_set(core->document, rig, &changed, &core->step.error);
}

static void press_floor(void *room, struct core *core, const struct hover *hover, const struct event *event)
{
    struct stage *stage = room;
    static const struct drag_owner owner = {.cursor = CURSOR_VERTICAL, .apply = move_floor, .end = stage_click};
    const struct model_rig *rig = &core->document->rigs[hover->rig]->model;
    const float at[3] = {(float)rig->position[0], (float)rig->floor, (float)rig->position[2]};
    const double rise = fmax(maths_cos((double)core->view.camera.elevation), LEAST_RISE);
    core->input.hover = *hover;
    drag_begin(core, &owner, stage, "Set floor", event);
    stage->floor_scale = rise * stage_pixels_per_metre(stage, at);
}

/// The middle of a near edge.
static bool find_floor(void *room, const struct core *core, const struct target *target, float xy[2])
{
    struct shown_floor floor = {0};
    (void)core;
    if (!floors_find(room, stage_soft_shown(room, target->rig), &floor)) return false;
    for (int k = 0; k < 2; k++) xy[k] = 0.5f * (floor.xy[floor.first][k] + floor.xy[(floor.first + 1) % 4][k]);
    return true;
}

const struct thing thing_floor = {.cursor = CURSOR_VERTICAL,
                                  .hint =
                                      "Drag the floor up or down (Shift: fine); the whole character stays above it",
                                  .press = press_floor,
                                  .name = "floor",
                                  .of = OF_RIG,
                                  .rig = RIG_MODEL,
                                  .find = find_floor,
                                  .missing = "no floor of that character is to be seen"};

static const float TOUCH = 2e-3f;     ///< of the character's height; closer counts as touching
static const float MARK = 4, END = 2; ///< radii, pixels
static const float FAR_SIDE = 0.35f,
                   FAR_PART = 0.4f; ///< edges behind the character: opacity, and visible share

void characters_show(const struct stage *stage, struct core *core)
{
    for (int m = 0; m < stage->view.model_count; m++) {
        const struct stage_model *shown = &stage->view.models[m];
        struct shown_floor floor = {0};
        const struct model_rig *rig = floors_find(stage, shown, &floor);
        if (!rig) continue;
        const bool is_hot = core->input.hover.thing == &thing_floor && core->input.hover.rig == shown->rig;

        float height = INFINITY, low[3];
        const int lowest = figure_lowest(&shown->posed, &height);
        figure_vertex(&shown->posed, lowest < 0 ? 0 : lowest, low);
        const float near_enough =
            TOUCH * (float)rig->scale * (shown->posed.figure->hi[1] - shown->posed.figure->lo[1]);
        const float below = (float)rig->floor - low[1];
        const bool is_missed = below > near_enough, is_touched = below > -near_enough;
        const uint32_t color = is_missed    ? theme()->warning
                               : is_hot     ? theme()->playhead
                               : is_touched ? theme()->accent
                                            : theme()->text_dim;

        // The edges at the nearest corner and the start of the others, so that no line crosses the character.
        for (int side = 1; side < 4; side += 2) {
            const float *corner = floor.xy[(floor.first + side) % 4], *far = floor.xy[(floor.first + 2) % 4];
            const float *near = floor.xy[floor.first];
            const float line[3][2] = {
                {near[0], near[1]},
                {corner[0], corner[1]},
                {corner[0] + FAR_PART * (far[0] - corner[0]), corner[1] + FAR_PART * (far[1] - corner[1])}};
            drawlist_line(&core->list, line[0], 2, is_hot ? 2.25f : 1.5f, color);
            drawlist_line(&core->list, line[1], 2, is_hot ? 2.25f : 1.5f, theme_fade(color, FAR_SIDE));
        }

        // The point on the floor at the lowest vertex, with a line if the vertex is below.
        const float on[3] = {low[0], (float)rig->floor, low[2]};
        const struct rect r = core->view.layout.stage;
        float line[2][2];
        if (is_touched && stage_project_point(stage, on, line[0]) && stage_project_point(stage, low, line[1])) {
            if (low[1] < (float)rig->floor) drawlist_line(&core->list, line[0], 2, 1.25f, color);
            drawlist_disc(&core->list, line[0], MARK, color);
            drawlist_disc(&core->list, line[1], END, color);
        }

        // The height, at the rightmost corner.
        char text[80];
        int right = 0;
        for (int i = 1; i < 4; i++) {
            if (floor.xy[i][0] > floor.xy[right][0]) right = i;
        }
        const int length = snprintf(text, sizeof text, "floor %.3g m", rig->floor + 0.0);
        if (is_missed) snprintf(text + length, sizeof text - (size_t)length, ", %.2g m below", (double)below);
        const float width = font_width(FONT_LABEL, THEME_TEXT_SMALL, text);
        const float x = fmaxf(fminf(floor.xy[right][0] + 8, r.x + r.w - width - 8), r.x + 8);
        stage_note(core, x, floor.xy[right][1] + 4, FONT_LABEL, is_missed ? color : theme()->text_dim, text);
    }
    show_legend(core);
}

// The brush.

static const double SHORTEST = 1.0 / 60; ///< seconds of paint for a click
static const float STRIDE = 0.3f;        ///< of the radius on the screen, between spots within a frame
static const float RIM = 0.25f;          ///< search beyond the radius, so that the ring can be drawn between vertices

/// The brush's radius on a figure, metres.
static float radius_of(const struct brush *brush, const struct figure *figure)
{
    return (float)brush->radius * (figure->hi[1] - figure->lo[1]);
}

/// The painted figure, with the skin posed as shown, or NULL. Allocates if the figure has more vertices than any before.
static const struct figure *pose_figure(struct stage *stage, const struct core *core, int *coordinate)
{
    struct brush_work *work = &stage->painting.work;
    const struct figure *figure = characters_figure(core, coordinate);
    if (!figure) return NULL;
    const int vertices = figure->character.vertex_count;
    if (work->capacity < vertices) {
        const size_t room = (size_t)vertices;
        pool_free(&work->pool);
        *work = (struct brush_work){0};
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
    return skin_pose(stage, characters_rig(core)) ? figure : NULL;
}

/// A vertex' paint: log of the amplitude, and the phase.
enum { SWELL, LEAD };

/// Names of strokes, the modes with Shift and Ctrl, and what they paint: 1 more of it, −1 less, 0 blended with the surroundings.
static const struct stroke {
    const char *label;
    enum brush_mode smoothed, other;
    int part, way;
} strokes[] = {
    [BRUSH_ADVANCE] = {"Advance phase", BRUSH_SMOOTH_PHASE, BRUSH_DELAY, LEAD, 1},
    [BRUSH_DELAY] = {"Delay phase", BRUSH_SMOOTH_PHASE, BRUSH_ADVANCE, LEAD, -1},
    [BRUSH_SMOOTH_PHASE] = {"Smooth phase", BRUSH_ADVANCE, BRUSH_SMOOTH_PHASE, LEAD, 0},
    [BRUSH_MORE] = {"More amplitude", BRUSH_SMOOTH_AMPLITUDE, BRUSH_LESS, SWELL, 1},
    [BRUSH_LESS] = {"Less amplitude", BRUSH_SMOOTH_AMPLITUDE, BRUSH_MORE, SWELL, -1},
    [BRUSH_SMOOTH_AMPLITUDE] = {"Smooth amplitude", BRUSH_MORE, BRUSH_SMOOTH_AMPLITUDE, SWELL, 0},
    [BRUSH_ERASE] = {"Erase paint", BRUSH_ERASE, BRUSH_ERASE, LEAD, 0},
};

/// Mode of a stroke with modifiers: Shift smooths, Ctrl reverses.
static enum brush_mode brush_stroke(const struct brush *brush, unsigned mods)
{
    const struct stroke *stroke = &strokes[brush->mode];
    return mods & MOD_SHIFT ? stroke->smoothed : mods & MOD_CTRL ? stroke->other : brush->mode;
}

/// 1 in the middle, 0 at the rim, with zero slope at both.
static float falloff(float distance, float radius)
{
    const float t = distance / radius;
    return t < 1 ? (1 - t * t) * (1 - t * t) : 0;
}

enum { SMOOTHINGS = 4 }; ///< passes per frame

// Of each part of the paint: how much flows per second at full strength, where a stroke saturates, however long (larger differences make a
// surface fold through itself), and the least and most of it: an amplitude of 0.01 … 4, and ±720°.
static const double flows[] = {[SWELL] = 1.3862943611198906, [LEAD] = 6.2831853071795865};
static const float saturated[] = {[SWELL] = 1.3862944f, [LEAD] = 1.5707963f};
static const float least[] = {[SWELL] = -4.60517f, [LEAD] = -12.5663706f};
static const float most[] = {[SWELL] = 1.3862944f, [LEAD] = 12.5663706f};
static const double BLENDING_FLOW = 12; ///< of smoothing and erasing, 1/s
static const double MOST_BLEND = 0.5;   ///< per pass; more would overshoot
static const float STILL = 1e-4f;       ///< of the largest amplitude; phases below this mean nothing

static void multiply_complex(const float a[2], const float b[2], float out[2])
{
    const float re = a[0] * b[0] - a[1] * b[1], im = a[0] * b[1] + a[1] * b[0];
    out[0] = re;
    out[1] = im;
}

/// A vertex's Ñ' with this frame's changes so far.
static void motion_of(const struct brush_work *work, const struct coordinate *c, uint32_t vertex, float out[3][2])
{
    for (int k = 0; k < 3; k++)
        multiply_complex(work->turned[vertex], (const float[2]){c->re[vertex][k], c->im[vertex][k]}, out[k]);
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
    out[SWELL] = maths_logf(mean / size);
    out[LEAD] = maths_atan2f(turn[1], turn[0]);
    return true;
}

/// Continues the stroke for drag.dt seconds.
static void paint_stroke(void *room, struct core *core)
{
    struct stage *stage = room;
    struct painting *painting = &stage->painting;
    struct brush_work *work = &painting->work;
    struct surface_spot spots[REACH_MAX_SPOTS];
    int coordinate, count = 0;
    const struct figure *figure = pose_figure(stage, core, &coordinate);
    const struct paint *paint = figure ? characters_selected(core)->painted : NULL;
    if (!paint || !models_paint_fits(paint, figure)) return;

    // The surface points under the pointer's path since the last frame.
    const float radius = radius_of(&core->focus.brush, figure);
    const float dx = core->input.pointer_x - painting->x, dy = core->input.pointer_y - painting->y;
    const float metres = 2 * core->view.camera.distance / stage->view.projection[5] / core->view.layout.stage.h;
    const float stride = fmaxf(1, STRIDE * radius / metres);
    const int steps = (int)fminf(REACH_MAX_SPOTS, fmaxf(1, ceilf(maths_hypotf(dx, dy) / stride)));
    for (int i = 1; i <= steps; i++) {
        const float share = (float)i / (float)steps;
        count += skin_spot(stage, figure, painting->x + share * dx, painting->y + share * dy, &spots[count]);
    }
    painting->x = core->input.pointer_x;
    painting->y = core->input.pointer_y;
    painting->has_dabbed = true;
    if (count == 0) return;
    reach_find(&work->reach, figure, spots, count, radius);

    // A dab on the vertices within reach, in modes that ignore their neighbours.
    const enum brush_mode mode = painting->stroke;
    const int part = strokes[mode].part, way = strokes[mode].way;
    const double flow = core->focus.brush.strength * core->input.drag.dt;
    struct dab dab = {coordinate, 0, work->vertices, (const float(*)[2])work->values};
    for (int i = 0; i < work->reach.count; i++) {
        const int vertex = work->reach.vertices[i];
        const float weight = falloff(work->reach.distance[vertex], radius);
        const float *old = paint->values[(size_t)coordinate * (size_t)paint->vertices + (size_t)vertex];
        if (!(weight > 0)) continue;
        work->vertices[dab.count] = vertex;
        float *value = work->values[dab.count++], *spent = &work->spent[vertex];
        for (int k = 0; k < 2; k++) value[k] = old[k];
        const float kept = 1 - weight * (float)fmin(1, BLENDING_FLOW * flow);
        if (way != 0) {
            const float left = fmaxf(weight * saturated[part] - *spent, 0);
            const float step = fminf(weight * (float)(flows[part] * flow), left);
            *spent += step;
            value[part] = glm_clamp(value[part] + (float)way * step, least[part], most[part]);
        }
        for (int k = 0; k < 2 && mode == BRUSH_ERASE; k++) value[k] = fabsf(value[k]) < 1e-3f ? 0 : kept * value[k];
    }

    // Smoothing: Jacobi passes over all vertices, so that their order does not matter.
    const bool smooths = mode == BRUSH_SMOOTH_PHASE || mode == BRUSH_SMOOTH_AMPLITUDE;
    const float blend = (float)fmin(MOST_BLEND, BLENDING_FLOW * flow / SMOOTHINGS);
    for (int pass = 0; pass < SMOOTHINGS && smooths; pass++) {
        for (int i = 0; i < dab.count; i++) {
            const int vertex = work->vertices[i];
            const float weight = blend * falloff(work->reach.distance[vertex], radius);
            float by[2] = {0, 0};
            difference(work, figure, coordinate, vertex, by);
            work->steps[i] = weight * by[part];
        }
        for (int i = 0; i < dab.count; i++) {
            float *value = work->values[i], *turned = work->turned[work->vertices[i]];
            const float step = glm_clamp(value[part] + work->steps[i], least[part], most[part]) - value[part];
            const float factor[2] = {part == LEAD ? maths_cosf(step) : maths_expf(step),
                                     part == LEAD ? maths_sinf(step) : 0};
            multiply_complex(turned, factor, turned);
            value[part] += step;
        }
    }
    for (int i = 0; i < dab.count && smooths; i++) {
        work->turned[work->vertices[i]][0] = 1;
        work->turned[work->vertices[i]][1] = 0;
    }
    edit_paint(core->document, characters_rig(core), &dab, &core->step.error);
}

static void end_stroke(void *room, struct core *core, bool keep)
{
    const struct stage *stage = room;
    if (!keep || stage->painting.has_dabbed) return;
    core->input.drag.dt = SHORTEST;
    paint_stroke(room, core);
}

static const struct drag_owner brush_owner = {
    .cursor = CURSOR_ARROW, .goes_on = true, .apply = paint_stroke, .end = end_stroke};

/// Whether a stroke is running.
static bool brush_paints(const struct core *core) { return core->input.drag.owner == &brush_owner; }

bool brush_press(struct stage *stage, struct core *core, const struct event *event)
{
    const struct brush *brush = &core->focus.brush;
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
    drag_begin(core, &brush_owner, stage, strokes[painting->stroke].label, event);
    painting->x = event->x;
    painting->y = event->y;
    painting->has_dabbed = false;
    memset(painting->work.spent, 0, (size_t)painting->work.capacity * sizeof *painting->work.spent);
    drag_start_moving(core);
    if (!paint) characters_blank_paint(core, figure);
    core_settle(core);
    return true;
}

void brush_pose(struct stage *stage, struct core *core, bool covered)
{
    const struct brush *brush = &core->focus.brush;
    struct painting *painting = &stage->painting;
    const bool pointed = rect_contains(core->view.layout.stage, core->input.pointer_x, core->input.pointer_y);
    const bool free_hand = !core->input.drag.owner || brush_paints(core);
    int coordinate;
    painting->covers = false;
    if (!brush->on || !pointed || !free_hand || covered) return;
    const struct figure *figure = pose_figure(stage, core, &coordinate);
    if (!figure || !skin_spot(stage, figure, core->input.pointer_x, core->input.pointer_y, &painting->spot)) return;
    painting->covers = true;
    reach_find(&painting->work.reach, figure, &painting->spot, 1, (1 + RIM) * radius_of(brush, figure));
}

enum { STATE_HEIGHT = 46 };

static const double DEGREES = 57.29577951308232;

static const float RING_WIDTH = 1.5f, SHADE_WIDTH = 3.5f;
static const uint32_t RING = 0xFFFFFFFFu, SHADE = 0x00000060u; ///< in every theme, on the map's colours

/// Outlines the brush's reach.
static void show_ring(struct stage *stage, struct core *core, const struct figure *figure)
{
    struct silhouette *silhouette = &stage->silhouette;
    const struct reach *reach = &stage->painting.work.reach;
    const float radius = radius_of(&core->focus.brush, figure);
    silhouette_clear(silhouette);
    for (int i = 0; i < reach->count; i++) {
        float xy[2];
        if (!stage_project_point(stage, stage->skin.posed[reach->vertices[i]], xy)) return;
        silhouette_widen(silhouette, xy, 0);
    }
    if (!silhouette_open(silhouette, core->view.layout.stage)) return;

    // Triangles that face the eye. A corner is inside by the rest of the radius, in pixels.
    const float scale = 0.5f * fmaxf(silhouette->area.w, silhouette->area.h) / radius;
    for (int t = 0; t < figure->character.index_count; t += 3) {
        const uint32_t *corner = figure->character.indices + t;
        float xy[3][2], inside[3];
        bool all = true;
        for (int c = 0; c < 3 && all; c++) {
            inside[c] = (radius - reach->distance[corner[c]]) * scale;
            all = isfinite(inside[c]) && stage_project_point(stage, stage->skin.posed[corner[c]], xy[c]);
        }
        if (all && (xy[1][0] - xy[0][0]) * (xy[2][1] - xy[0][1]) < (xy[1][1] - xy[0][1]) * (xy[2][0] - xy[0][0]))
            silhouette_add_triangle(silhouette, (const float(*)[2])xy, inside);
    }
    silhouette_soften(silhouette);
    for (int count; (count = silhouette_follow(silhouette)) > 0;) {
        drawlist_line(&core->list, silhouette->points[0], count, SHADE_WIDTH, SHADE);
        drawlist_line(&core->list, silhouette->points[0], count, RING_WIDTH, RING);
    }
}

void brush_show(struct stage *stage, struct core *core)
{
    const struct brush *brush = &core->focus.brush;
    const struct painting *painting = &stage->painting;
    int coordinate;
    const struct figure *figure = brush->on ? characters_figure(core, &coordinate) : NULL;
    if (!figure) return;
    const struct paint *paint = characters_selected(core)->painted;
    if (paint && !models_paint_fits(paint, figure)) paint = NULL;
    if (painting->covers) show_ring(stage, core, figure);

    const struct rect legend = characters_legend(core);
    const struct rect box = {legend.x, legend.y - STATE_HEIGHT - 8, legend.w, STATE_HEIGHT};
    const char *label = strokes[brush_paints(core) ? painting->stroke : brush_stroke(brush, core->input.mods)].label;
    char text[64] = "nothing painted here";
    if (!painting->covers) {
        snprintf(text, sizeof text, "radius %.0f %%, strength %.0f %%", 100 * brush->radius, 100 * brush->strength);
    } else if (paint) { // at the vertex nearest to the pointer
        const size_t nearest = (size_t)spot_vertex(&painting->spot);
        const float *value = paint->values[(size_t)coordinate * (size_t)paint->vertices + nearest];
        if (value[0] != 0 || value[1] != 0)
            snprintf(text, sizeof text, "painted here: %+.0f°, × %.2f",
                     printable_number((double)value[1] * DEGREES, 1), maths_exp((double)value[0]));
    }
    stage_scrim(core, box);
    drawlist_text_fit(&core->list, box.x + 10, box.y + 18, box.w - 20, FONT_LABEL_BOLD, THEME_TEXT_SMALL,
                      theme()->text, label);
    drawlist_text_fit(&core->list, box.x + 10, box.y + 35, box.w - 20, FONT_LABEL, THEME_TEXT_SMALL,
                      theme()->text_dim, text);
}
