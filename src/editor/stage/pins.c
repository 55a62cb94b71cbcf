/// Pins by mouse: what is pointed at, and drags in the plane that faces the eye.
#include "editor/stage/pins.h"
#include "editor/core/core.h"
#include "editor/core/drag.h"
#include "editor/core/pins.h"
#include "editor/core/playback.h"
#include "editor/stage/points.h"
#include "editor/stage/rigs.h"
#include "editor/stage/skin.h"
#include "model/vector.h"
#include "scene/pins.h"
#include <math.h>
#include <string.h>

static const float MARKER_REACH = 9;    ///< pixels
static const float LEAST_SHARE = 0.05f; ///< of how far the surface moves at most: what moves less is not offered
static const double LEAST_AXIS = 0.3;   ///< pixels of an axis in a pixel across, below which it is as slow as that

/// How far a vertex moves with a unit of what moves the character, squared, as a share of what is the most along each axis.
static float share_of(const struct stage_character *shown, int vertex)
{
    float own = 0, most = 0;
    for (int k = 0; k < shown->morph.count; k++) {
        const int c = shown->morph.coordinate[k];
        const struct coordinate *coordinate = &shown->figure->character.coordinates[c];
        const float *largest = shown->figure->largest[c];
        own +=
            glms_vec3_norm2(vec3_from(coordinate->re[vertex])) + glms_vec3_norm2(vec3_from(coordinate->im[vertex]));
        most += glms_vec3_norm2(vec3_from(largest));
    }
    return most > 0 ? own / most : 0;
}

/// The corner of the triangle under the point that is nearest to it.
static int nearest_corner(const struct surface_spot *spot)
{
    int best = 0;
    for (int c = 1; c < 3; c++) {
        if (spot->weight[c] > spot->weight[best]) best = c;
    }
    return (int)spot->corner[best];
}

/// The vertex of the characters' surfaces under a point, that of the nearest to the eye.
static struct hover find_vertex(struct stage *stage, const struct document *document, float x, float y)
{
    const struct stage_view *view = &stage->view;
    struct hover hover = {.kind = HOVER_NONE};
    float nearest = INFINITY;
    for (int c = 0; c < view->character_count; c++) {
        const struct stage_character *shown = &view->characters[c];
        struct surface_spot spot;
        float xy[2];
        if (!skin_pose(stage, shown->rig) || !skin_spot(stage, shown->figure, x, y, &spot)) continue;
        const int rig = document_find_rig(document, RIG_CHARACTER, shown->rig), vertex = nearest_corner(&spot);
        const float *place = stage->skin.posed[vertex];
        const float depth = camera_depth(view->view, view->eye, place);
        if (depth >= nearest) continue;
        nearest = depth;
        hover.kind = HOVER_NONE;
        if (share_of(shown, vertex) < LEAST_SHARE * LEAST_SHARE) continue;
        if (!stage_project_point(stage, view->viewport, place, xy)) continue;
        hover = (struct hover){.kind = HOVER_POINT, .rig = rig, .joint = vertex, .x = xy[0], .y = xy[1]};
    }
    return hover;
}

/// The same, from memory while neither pointer nor picture have moved. Nothing lights up by playing on under a still pointer.
static struct hover surface_hover(struct stage *stage, const struct core *core, const struct document *document,
                                  float x, float y)
{
    struct pointed *pointed = &stage->pointed;
    const bool still = pointed->x == x && pointed->y == y;
    if (core->brush.on || core->characters.compare || core->pick.use != BONE_SELECTED)
        return (struct hover){.kind = HOVER_NONE};
    if (still && pointed->hash == stage->view.hash) return pointed->hover;
    if (still && core->playback.playing) return (struct hover){.kind = HOVER_NONE};
    *pointed = (struct pointed){x, y, stage->view.hash, find_vertex(stage, document, x, y)};
    return pointed->hover;
}

/// The marker under a point; of several the selected one, else the nearest.
static struct hover marker_hover(const struct stage *stage, const struct core *core, float x, float y)
{
    struct hover hover = {.kind = HOVER_NONE};
    float best = MARKER_REACH;
    for (int i = 0; i < stage->pin_count; i++) {
        const struct shown_pin *pin = &stage->pins[i];
        float xy[2];
        if (!stage_project_point(stage, core->layout.stage, pin->to, xy)) continue;
        float distance = hypotf(xy[0] - x, xy[1] - y);
        if (distance >= MARKER_REACH) continue;
        if (core->pin.any && core->pin.id == pin->id) distance = 0;
        if (distance >= best) continue;
        best = distance;
        hover = (struct hover){
            .kind = HOVER_PIN, .rig = pin->point.rig, .joint = pin->point.at, .pin = pin->id, .x = xy[0], .y = xy[1]};
    }
    return hover;
}

struct hover pins_hover(struct stage *stage, const struct core *core, const struct document *document,
                        const struct hover *found, float x, float y)
{
    if (core->brush.on || core->pick.use != BONE_SELECTED) return (struct hover){.kind = HOVER_NONE};
    const struct hover marker = marker_hover(stage, core, x, y);
    if (marker.kind != HOVER_NONE) return marker;
    return found->kind == HOVER_NONE ? surface_hover(stage, core, document, x, y)
                                     : (struct hover){.kind = HOVER_NONE};
}

bool pins_hover_exists(const struct editor_world *world, const struct hover *hover)
{
    if (hover->kind == HOVER_POINT) return point_exists(world, (struct rig_point){hover->rig, hover->joint});
    const struct document *document = world->document;
    return hover->rig < document->rig_count && pins_find_id(&document->rigs[hover->rig], hover->pin) >= 0;
}

void pins_take_plane(const struct stage *stage, const struct core *core, const double place[3], struct pin_drag *drag)
{
    const struct stage_view *view = &stage->view;
    const float at[3] = {(float)place[0], (float)place[1], (float)place[2]};
    const float depth = fmaxf(camera_depth(view->view, view->eye, at), 0.1f);
    drag->pixels_per_metre = 0.5 * (double)(core->layout.stage.h * view->projection[5] / depth);
    for (int k = 0; k < 3; k++) {
        drag->right[k] = (double)view->view[4 * k];
        drag->up[k] = (double)view->view[4 * k + 1];
    }
}

/// X, Y and Z lock an axis; false for other keys.
static bool lock(struct stage *stage, struct drag *drag, int key)
{
    if (key != 'X' && key != 'Y' && key != 'Z') return false;
    const int axis = key - 'X';
    stage->pin_drag.axis = stage->pin_drag.axis == axis ? -1 : axis;
    drag->stale = true;
    return true;
}

/// Where the pointer has taken the point.
static void drag_to(const struct pin_drag *drag, double dx, double dy, double to[3])
{
    for (int k = 0; k < 3; k++) {
        to[k] = drag->start[k];
        if (drag->axis < 0) to[k] += (dx * drag->right[k] - dy * drag->up[k]) / drag->pixels_per_metre;
    }
    if (drag->axis < 0) return;
    const double across = drag->right[drag->axis], up = drag->up[drag->axis];
    const double square = fmax(across * across + up * up, LEAST_AXIS * LEAST_AXIS);
    to[drag->axis] += (dx * across - dy * up) / square / drag->pixels_per_metre;
}

/// The point, or the marker, goes where the pointer is now.
static void apply(void *room, struct core *core, const struct editor_world *world)
{
    const struct pin_drag *drag = &((const struct stage *)room)->pin_drag;
    double to[3];
    drag_to(drag, core->drag.moved_x, core->drag.moved_y, to);
    pins_put(core, world, drag->point.rig, drag->point.at, drag->frame, to);
}

static enum drag_answer take_event(void *room, struct core *core, const struct editor_world *world,
                                   const struct event *event)
{
    // Ctrl may still be down, which takes joints.
    const bool key = event->kind == EVENT_KEY && event->action == ACTION_PRESS && !(event->mods & MOD_ALT);
    (void)world;
    return key && lock(room, &core->drag, event->key) ? DRAG_USED : DRAG_PASSES;
}

void pins_begin(struct stage *stage, struct core *core, const struct editor_world *world, const struct hover *hover,
                const struct event *event)
{
    static const struct drag_owner owner = {
        .cursor = CURSOR_HAND, .apply = apply, .event = take_event, .end = stage_click, .show = pins_show_axis};
    struct pin_drag *drag = &stage->pin_drag;
    const struct document *document = world->document;
    drag_begin(core, &owner, stage, hover->kind == HOVER_PIN ? "Move pin" : "Pin", event);
    *drag = (struct pin_drag){.point = {hover->rig, hover->joint}, .axis = -1};
    if (hover->kind == HOVER_PIN) {
        const struct rig *rig = &document->rigs[hover->rig];
        const struct pin *pin = &rig->pins[pins_find_id(rig, hover->pin)];
        pins_visit(core, document, pin);
        drag->frame = pin->frame;
        memcpy(drag->start, pin->to, sizeof drag->start);
    } else {
        float place[3] = {0};
        drag->frame = pins_frame_here(core, document, hover->rig);
        playback_seek(core, document, drag->frame);
        point_place(core, world, drag->point, core->playback.position, place);
        for (int k = 0; k < 3; k++) drag->start[k] = (double)place[k];
    }
    pins_take_plane(stage, core, drag->start, drag);
}
