#include "editor/stage/brush.h"
#include "base/hash.h"
#include "editor/core/actions.h"
#include "rig/pick.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static const double RADIUS_LEAST = 0.01, RADIUS_MOST = 0.5, STRENGTH_LEAST = 0.02;
static const double WHEEL_STEP = 0.15;   ///< of a notch, as a power of e
static const double SHORTEST = 1.0 / 60; ///< seconds that a click paints
static const float STRIDE = 0.3f;        ///< of the radius on the screen, between the spots of one frame
static const float RIM = 0.25f;          ///< beyond the radius, so that the ring can be drawn between vertices

void brush_init(struct brush *brush) { *brush = (struct brush){.radius = 0.12, .strength = 0.4}; }

static void free_work(struct brush_work *work)
{
    reach_free(&work->reach);
    free(work->posed);
    free(work->vertices);
    free(work->values);
    free(work->steps);
    free(work->turned);
    *work = (struct brush_work){0};
}

void brush_free(struct brush *brush) { free_work(&brush->work); }

/// Memory for a figure; kept for the next one where that is no larger.
static bool reserve(struct brush_work *work, int vertices)
{
    const size_t room = (size_t)vertices + 1;
    if (work->capacity >= vertices) return true;
    free_work(work);
    work->posed = malloc(room * sizeof *work->posed);
    work->vertices = malloc(room * sizeof *work->vertices);
    work->values = malloc(room * sizeof *work->values);
    work->steps = malloc(room * sizeof *work->steps);
    work->turned = malloc(room * sizeof *work->turned);
    const bool good = work->posed && work->vertices && work->values && work->steps && work->turned &&
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

const struct figure *brush_figure(const struct editor *editor, const struct editor_world *world, int *coordinate)
{
    const struct coordinate *selected = characters_coordinate(editor, world);
    if (!selected) return NULL;
    const struct figure *figure = cast_figure(world->cast, editor->characters.character);
    *coordinate = (int)(selected - figure->character.coordinates);
    return figure;
}

/// Shows the phases along the axis in which the coordinate moves most, where no other was chosen.
static void choose_axis(struct editor *editor, const struct figure *figure, int coordinate)
{
    const float *largest = figure->largest[coordinate];
    int axis = 0;
    if (editor->characters.mapped) return;
    for (int k = 1; k < 3; k++) {
        if (largest[k] > largest[axis]) axis = k;
    }
    editor->characters.axis = axis;
}

void brush_set(struct editor *editor, const struct editor_world *world, bool on)
{
    struct brush *brush = &editor->brush;
    int coordinate;
    const struct figure *figure = on ? brush_figure(editor, world, &coordinate) : NULL;
    brush->on = false;
    brush->covers = false;
    if (!on) return;
    if (!figure) {
        editor_message(editor, false, "This scene has no character to paint.");
    } else if (!reserve(&brush->work, figure->character.vertex_count)) {
        editor_message(editor, true, "Not enough memory to paint.");
    } else {
        brush->on = true;
        choose_axis(editor, figure, coordinate);
        inspector_unfold(editor, "section.character");
        editor_message(editor, false, "Drag over the character to paint. Ctrl reverses, Shift smooths, Esc ends.");
    }
}

/// The selected character as the stage shows it, its stiff twin left out; NULL where it is not shown.
static const struct stage_character *find_shown(const struct editor *editor)
{
    const struct stage_view *view = &editor->stage;
    for (int i = 0; i < view->character_count; i++) {
        if (view->characters[i].rig == editor->characters.character && !view->characters[i].is_twin)
            return &view->characters[i];
    }
    return NULL;
}

/// The figure that is painted on with `posed` as the stage shows it; NULL where there is none.
static const struct figure *pose_figure(struct editor *editor, const struct editor_world *world, int *coordinate)
{
    struct brush *brush = &editor->brush;
    const struct figure *figure = brush_figure(editor, world, coordinate);
    const struct stage_character *shown = find_shown(editor);
    if (!figure || !shown || !reserve(&brush->work, figure->character.vertex_count)) return NULL;
    const uint64_t hash = hash_word(hash_word(editor->stage.hash, figure->id), (uint64_t)shown->rig);
    if (brush->posed_hash != hash) {
        pick_pose(figure, &shown->morph, shown->position, brush->work.posed);
        brush->posed_hash = hash;
    }
    return figure;
}

static bool find_spot(const struct editor *editor, const struct figure *figure, float x, float y,
                      struct surface_spot *spot)
{
    const struct stage_view *view = &editor->stage;
    const float viewport[4] = {view->viewport.x, view->viewport.y, view->viewport.w, view->viewport.h};
    float direction[3];
    camera_ray(view->view, view->projection, viewport, (const float[2]){x, y}, direction);
    return pick_ray(figure, (const float(*)[3])editor->brush.work.posed, view->eye, direction, spot);
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

static struct edit paint_edit(const struct editor *editor, const struct editor_world *world, enum edit_kind kind)
{
    struct edit edit = editor_edit_of(kind, 0);
    edit.rig = document_find_rig(world->document, RIG_CHARACTER, editor->characters.character);
    return edit;
}

/// Blank paint of the figure's shape.
static struct edit blank_edit(const struct editor *editor, const struct editor_world *world,
                              const struct figure *figure)
{
    struct edit edit = paint_edit(editor, world, EDIT_PAINT_NEW);
    edit.coordinates = figure->character.coordinate_count;
    edit.vertices = figure->character.vertex_count;
    return edit;
}

bool brush_press(struct editor *editor, const struct editor_world *world, const struct event *event)
{
    struct brush *brush = &editor->brush;
    int coordinate;
    if (!brush->on || event->button != BUTTON_LEFT || history_is_open(world->history)) return false;
    const struct figure *figure = pose_figure(editor, world, &coordinate);
    if (!figure || !find_spot(editor, figure, event->x, event->y, &brush->spot)) return false;
    const struct paint *paint = characters_selected(editor, world)->painted;
    if (paint && !cast_fits(paint, figure)) {
        editor_message(editor, true, "The paint in this scene belongs to another model. Remove it first.");
        return true;
    }
    drag_begin(editor, DRAG_PAINT, event);
    brush->stroke = brush_stroke(brush, event->mods);
    brush->x = event->x;
    brush->y = event->y;
    brush->has_dabbed = false;
    history_begin(world->history, brush_label(brush->stroke), 0);
    const struct edit blank = blank_edit(editor, world, figure);
    if (!paint) editor_edit(editor, world, &blank);
    return true;
}

/// The spots that the pointer went over since the last frame; those off the character are left out.
static int find_way(const struct editor *editor, const struct figure *figure,
                    struct surface_spot spots[REACH_MAX_SPOTS])
{
    const struct brush *brush = &editor->brush;
    const float dx = editor->pointer_x - brush->x, dy = editor->pointer_y - brush->y;
    const float metres = 2 * editor->camera.distance / editor->stage.projection[5] / editor->layout.stage.h;
    const float stride = fmaxf(1, STRIDE * brush_radius_of(brush, figure) / metres);
    const int steps = (int)fminf(REACH_MAX_SPOTS, fmaxf(1, ceilf(hypotf(dx, dy) / stride)));
    int count = 0;
    for (int i = 1; i <= steps; i++) {
        const float share = (float)i / (float)steps;
        count += find_spot(editor, figure, brush->x + share * dx, brush->y + share * dy, &spots[count]);
    }
    return count;
}

void brush_advance(struct editor *editor, const struct editor_world *world, double dt)
{
    struct brush *brush = &editor->brush;
    struct surface_spot spots[REACH_MAX_SPOTS];
    int coordinate;
    if (editor->drag.kind != DRAG_PAINT) return;
    const struct figure *figure = pose_figure(editor, world, &coordinate);
    const struct paint *paint = figure ? characters_selected(editor, world)->painted : NULL;
    if (!paint || !cast_fits(paint, figure)) return;
    const int count = find_way(editor, figure, spots);
    brush->x = editor->pointer_x;
    brush->y = editor->pointer_y;
    brush->has_dabbed = true;
    if (count == 0) return;
    reach_find(&brush->work.reach, figure, spots, count, brush_radius_of(brush, figure));
    const struct dab dab = brush_dab(brush, paint, figure, coordinate, brush->strength * dt);
    struct edit edit = paint_edit(editor, world, EDIT_PAINT);
    edit.dab = &dab;
    editor_edit(editor, world, &edit);
}

void brush_end(struct editor *editor, const struct editor_world *world, bool keep)
{
    if (keep && !editor->brush.has_dabbed) brush_advance(editor, world, SHORTEST);
    if (!keep) history_restart(world->history, world->document);
    history_end(world->history);
}

bool brush_wheel(struct editor *editor, const struct event *event)
{
    struct brush *brush = &editor->brush;
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
    editor_message(editor, false, text);
    return true;
}

void brush_pose(struct editor *editor, const struct editor_world *world)
{
    struct brush *brush = &editor->brush;
    const bool pointed = rect_contains(editor->layout.stage, editor->pointer_x, editor->pointer_y);
    const bool free_hand = editor->drag.kind == DRAG_NONE || editor->drag.kind == DRAG_PAINT;
    int coordinate;
    brush->covers = false;
    if (!brush->on || !pointed || !free_hand || editor->dialog.kind != DIALOG_NONE || editor->help.open) return;
    const struct figure *figure = pose_figure(editor, world, &coordinate);
    if (!figure || !find_spot(editor, figure, editor->pointer_x, editor->pointer_y, &brush->spot)) return;
    brush->covers = true;
    reach_find(&brush->work.reach, figure, &brush->spot, 1, (1 + RIM) * brush_radius_of(brush, figure));
}

void brush_clean(struct editor *editor, const struct editor_world *world)
{
    int coordinate;
    const struct figure *figure = brush_figure(editor, world, &coordinate);
    if (!figure || history_is_open(world->history)) return;
    const struct edit blank = blank_edit(editor, world, figure);
    editor_step(editor, world, "Remove paint", 0, &blank);
}
