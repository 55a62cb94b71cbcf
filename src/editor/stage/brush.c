/// The brush: strokes as an airbrush makes them. A stroke adds flow × time to every vertex under it.
#include "editor/stage/brush.h"
#include "editor/core/characters.h"
#include "editor/core/core.h"
#include "editor/core/drag.h"
#include "editor/stage/skin.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double RADIUS_LEAST = 0.01, RADIUS_MOST = 0.5, STRENGTH_LEAST = 0.02;
static const double WHEEL_STEP = 0.15;   ///< of a notch, as a power of e
static const double SHORTEST = 1.0 / 60; ///< seconds that a click paints
static const float STRIDE = 0.3f;        ///< of the radius on the screen, between the spots of one frame
static const float RIM = 0.25f;          ///< beyond the radius, so that the ring can be drawn between vertices

static void free_work(struct brush_work *work)
{
    reach_free(&work->reach);
    free(work->vertices);
    free(work->values);
    free(work->steps);
    free(work->turned);
    free(work->spent);
    *work = (struct brush_work){0};
}

void brush_free(struct painting *painting) { free_work(&painting->work); }

/// Memory for a figure; kept for the next one where that is no larger.
static bool reserve(struct brush_work *work, int vertices)
{
    const size_t room = (size_t)vertices + 1;
    if (work->capacity >= vertices) return true;
    free_work(work);
    work->vertices = malloc(room * sizeof *work->vertices);
    work->values = malloc(room * sizeof *work->values);
    work->steps = malloc(room * sizeof *work->steps);
    work->turned = malloc(room * sizeof *work->turned);
    work->spent = calloc(room, sizeof *work->spent);
    const bool good = work->vertices && work->values && work->steps && work->turned && work->spent &&
                      reach_create(&work->reach, vertices);
    if (!good) {
        free_work(work);
        return false;
    }
    for (int i = 0; i < vertices; i++) {
        work->turned[i][0] = 1;
        work->turned[i][1] = 0;
    }
    work->capacity = vertices;
    return true;
}

/// The figure that is painted on with the skin as the stage shows it; NULL where there is none.
static const struct figure *pose_figure(struct stage *stage, const struct core *core,
                                        const struct editor_world *world, int *coordinate)
{
    const struct figure *figure = characters_figure(core, world, coordinate);
    if (!figure || !reserve(&stage->painting.work, figure->character.vertex_count)) return NULL;
    return skin_pose(stage, core->characters.character) ? figure : NULL;
}

enum brush_mode brush_stroke(const struct brush *brush, unsigned mods)
{
    static const enum brush_mode smooth[] = {
        [BRUSH_ADVANCE] = BRUSH_SMOOTH_PHASE,  [BRUSH_DELAY] = BRUSH_SMOOTH_PHASE,
        [BRUSH_SMOOTH_PHASE] = BRUSH_ADVANCE,  [BRUSH_MORE] = BRUSH_SMOOTH_AMPLITUDE,
        [BRUSH_LESS] = BRUSH_SMOOTH_AMPLITUDE, [BRUSH_SMOOTH_AMPLITUDE] = BRUSH_MORE,
        [BRUSH_ERASE] = BRUSH_ERASE,
    };
    static const enum brush_mode other[] = {
        [BRUSH_ADVANCE] = BRUSH_DELAY,
        [BRUSH_DELAY] = BRUSH_ADVANCE,
        [BRUSH_SMOOTH_PHASE] = BRUSH_SMOOTH_PHASE,
        [BRUSH_MORE] = BRUSH_LESS,
        [BRUSH_LESS] = BRUSH_MORE,
        [BRUSH_SMOOTH_AMPLITUDE] = BRUSH_SMOOTH_AMPLITUDE,
        [BRUSH_ERASE] = BRUSH_ERASE,
    };
    return mods & MOD_SHIFT ? smooth[brush->mode] : mods & MOD_CTRL ? other[brush->mode] : brush->mode;
}

const char *brush_label(enum brush_mode stroke)
{
    static const char *const labels[] = {
        [BRUSH_ADVANCE] = "Advance phase",     [BRUSH_DELAY] = "Delay phase",
        [BRUSH_SMOOTH_PHASE] = "Smooth phase", [BRUSH_MORE] = "More amplitude",
        [BRUSH_LESS] = "Less amplitude",       [BRUSH_SMOOTH_AMPLITUDE] = "Smooth amplitude",
        [BRUSH_ERASE] = "Erase paint",
    };
    return labels[stroke];
}

/// The spots that the pointer went over since the last frame; those off the character are left out.
static int find_way(const struct stage *stage, const struct core *core, const struct figure *figure,
                    struct surface_spot spots[REACH_MAX_SPOTS])
{
    const struct painting *painting = &stage->painting;
    const float dx = core->pointer_x - painting->x, dy = core->pointer_y - painting->y;
    const float metres = 2 * stage->camera.distance / stage->view.projection[5] / core->layout.stage.h;
    const float stride = fmaxf(1, STRIDE * brush_radius_of(&core->brush, figure) / metres);
    const int steps = (int)fminf(REACH_MAX_SPOTS, fmaxf(1, ceilf(hypotf(dx, dy) / stride)));
    int count = 0;
    for (int i = 1; i <= steps; i++) {
        const float share = (float)i / (float)steps;
        count += skin_spot(stage, figure, painting->x + share * dx, painting->y + share * dy, &spots[count]);
    }
    return count;
}

/// Goes on with the stroke for drag.dt seconds.
static void apply(void *room, struct core *core, const struct editor_world *world)
{
    struct stage *stage = room;
    const struct brush *brush = &core->brush;
    struct painting *painting = &stage->painting;
    struct surface_spot spots[REACH_MAX_SPOTS];
    int coordinate;
    const struct figure *figure = pose_figure(stage, core, world, &coordinate);
    const struct paint *paint = figure ? characters_selected(core, world)->painted : NULL;
    if (!paint || !models_paint_fits(paint, figure)) return;
    const int count = find_way(stage, core, figure, spots);
    painting->x = core->pointer_x;
    painting->y = core->pointer_y;
    painting->has_dabbed = true;
    if (count == 0) return;
    reach_find(&painting->work.reach, figure, spots, count, brush_radius_of(brush, figure));
    const struct dab dab = brush_dab(painting, paint, figure, coordinate, brush_radius_of(brush, figure),
                                     brush->strength * core->drag.dt);
    struct edit edit = characters_paint_edit(core, world, EDIT_PAINT);
    edit.dab = &dab;
    core_edit(core, world, &edit);
}

static void end(void *room, struct core *core, const struct editor_world *world, bool keep)
{
    const struct stage *stage = room;
    if (!keep || stage->painting.has_dabbed) return;
    core->drag.dt = SHORTEST;
    apply(room, core, world);
}

static const struct drag_owner owner = {.cursor = CURSOR_ARROW, .goes_on = true, .apply = apply, .end = end};

bool brush_paints(const struct core *core) { return core->drag.owner == &owner; }

bool brush_press(struct stage *stage, struct core *core, const struct editor_world *world, const struct event *event)
{
    const struct brush *brush = &core->brush;
    struct painting *painting = &stage->painting;
    int coordinate;
    if (!brush->on || event->button != BUTTON_LEFT || history_is_open(world->history)) return false;
    const struct figure *figure = pose_figure(stage, core, world, &coordinate);
    if (!figure || !skin_spot(stage, figure, event->x, event->y, &painting->spot)) return false;
    const struct paint *paint = characters_selected(core, world)->painted;
    if (paint && !models_paint_fits(paint, figure)) {
        core_message(core, true, "The paint in this scene belongs to another model. Remove it first.");
        return true;
    }
    painting->stroke = brush_stroke(brush, event->mods);
    drag_begin(core, &owner, stage, brush_label(painting->stroke), event);
    painting->x = event->x;
    painting->y = event->y;
    painting->has_dabbed = false;
    memset(painting->work.spent, 0, (size_t)painting->work.capacity * sizeof *painting->work.spent);
    drag_start_moving(core, world);
    const struct edit blank = characters_blank_paint(core, world, figure);
    if (!paint) core_edit(core, world, &blank);
    return true;
}

bool brush_wheel(struct core *core, const struct event *event)
{
    struct brush *brush = &core->brush;
    const double factor = exp(WHEEL_STEP * fmin(fmax(event->dy, -20), 20));
    char text[64];
    if (!brush->on || !(event->mods & (MOD_CTRL | MOD_SHIFT))) return false;
    if (event->mods & MOD_CTRL) {
        brush->radius = fmin(fmax(brush->radius * factor, RADIUS_LEAST), RADIUS_MOST);
        snprintf(text, sizeof text, "Brush: radius %.0f %% of the character's height.", 100 * brush->radius);
    } else {
        brush->strength = fmin(fmax(brush->strength * factor, STRENGTH_LEAST), 1);
        snprintf(text, sizeof text, "Brush: strength %.0f %%.", 100 * brush->strength);
    }
    core_message(core, false, text);
    return true;
}

/// Memory for what is to be painted on; without it the brush is put away.
static bool reserve_figure(struct stage *stage, struct core *core, const struct editor_world *world)
{
    int coordinate;
    const struct figure *figure = characters_figure(core, world, &coordinate);
    if (!figure || reserve(&stage->painting.work, figure->character.vertex_count)) return true;
    core->brush.on = false;
    core_message(core, true, "Not enough memory to paint.");
    return false;
}

void brush_pose(struct stage *stage, struct core *core, const struct editor_world *world, bool covered)
{
    const struct brush *brush = &core->brush;
    struct painting *painting = &stage->painting;
    const bool pointed = rect_contains(core->layout.stage, core->pointer_x, core->pointer_y);
    const bool free_hand = !core->drag.owner || brush_paints(core);
    int coordinate;
    painting->covers = false;
    if (brush->on && !reserve_figure(stage, core, world)) return;
    if (!brush->on || !pointed || !free_hand || covered) return;
    const struct figure *figure = pose_figure(stage, core, world, &coordinate);
    if (!figure || !skin_spot(stage, figure, core->pointer_x, core->pointer_y, &painting->spot)) return;
    painting->covers = true;
    reach_find(&painting->work.reach, figure, &painting->spot, 1, (1 + RIM) * brush_radius_of(brush, figure));
}
