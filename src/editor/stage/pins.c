/// Pins on the stage: hover, drags parallel to the screen, keys and markers.
#include "editor/core/pins.h"
#include "editor/core/bones.h"
#include "editor/core/command.h"
#include "editor/core/core.h"
#include "editor/core/drag.h"
#include "editor/stage/parts.h"
#include "editor/stage/stage.h"
#include "maths/maths.h"
#include "model/vector.h"
#include "scene/pins.h"
#include "ui/theme.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

static const float MARKER_REACH = 9;    ///< pixels
static const float LEAST_SHARE = 0.05f; ///< of the largest movement; vertices that move less are not offered

/// A vertex's movement per unit of the coordinates, squared, relative to the largest movement along each axis.
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

/// The surface vertex under a point; of several characters the one nearest to the eye.
static struct hover find_vertex(struct stage *stage, const struct core *core, float x, float y)
{
    const struct stage_view *view = &stage->view;
    struct hover hover = {.thing = NULL};
    float nearest = INFINITY;
    for (int c = 0; c < view->character_count; c++) {
        const struct stage_character *shown = &view->characters[c];
        struct surface_spot spot;
        float xy[2];
        if (!skin_pose(stage, shown->rig) || !skin_spot(stage, shown->figure, x, y, &spot)) continue;
        int corner = 0;
        for (int k = 1; k < 3; k++) {
            if (spot.weight[k] > spot.weight[corner]) corner = k;
        }
        const int rig = document_find_rig(core->document, RIG_CHARACTER, shown->rig),
                  vertex = (int)spot.corner[corner];
        if (!point_exists(core, (struct rig_point){rig, vertex})) continue; // an edit in the same frame removed it
        const float *place = stage->skin.posed[vertex];
        const float depth = camera_depth(view->view, view->eye, place);
        if (depth >= nearest) continue;
        nearest = depth;
        hover.thing = NULL;
        if (share_of(shown, vertex) < LEAST_SHARE * LEAST_SHARE) continue;
        if (!stage_project_point(stage, view->viewport, place, xy)) continue;
        hover = (struct hover){.thing = &thing_point, .rig = rig, .joint = vertex, .x = xy[0], .y = xy[1]};
    }
    return hover;
}

/// The next pin with a marker. Characters of a pair stand aside, so their pins have none.
static const struct pin *next_marker(const struct core *core, struct pin_place *place)
{
    const struct pin *pin;
    do {
        pin = pins_next(core->document, place);
    } while (pin && core->characters.compare && core->document->rigs[place->rig]->kind == RIG_CHARACTER);
    return pin;
}

static bool project(const struct stage *stage, const struct core *core, const double place[3], float xy[2])
{
    const float at[3] = {(float)place[0], (float)place[1], (float)place[2]};
    return stage_project_point(stage, core->layout.stage, at, xy);
}

struct hover pins_hover(struct stage *stage, const struct core *core, const struct hover *found, float x, float y)
{
    struct hover hover = {.thing = NULL};
    const float reach = core_reach(core, MARKER_REACH);
    float best = reach;
    if (core->brush.on || core->pick.use != BONE_SELECTED) return hover;

    // The marker under the point: the selected one, else the nearest.
    struct pin_place place = PINS_START;
    for (const struct pin *pin; (pin = next_marker(core, &place));) {
        float xy[2];
        if (!project(stage, core, pin->to, xy)) continue;
        float distance = maths_hypotf(xy[0] - x, xy[1] - y);
        if (distance < reach && core->pin.any && core->pin.id == pin->id) distance = 0;
        if (distance >= best) continue;
        best = distance;
        hover = (struct hover){
            .thing = &thing_pin, .rig = place.rig, .joint = pin->point, .pin = pin->id, .x = xy[0], .y = xy[1]};
    }
    if (hover.thing || found->thing || core->characters.compare) return hover;

    // A vertex, cached while pointer and picture stay. Playback under a still pointer highlights nothing.
    struct pointed *pointed = &stage->pointed;
    const bool still = pointed->x == x && pointed->y == y, same = still && pointed->hash == stage->view.hash;
    if (still && !same && core->playback.playing) return hover;
    if (!same) *pointed = (struct pointed){x, y, stage->view.hash, find_vertex(stage, core, x, y)};
    return pointed->hover;
}

/// The screen's directions in the world, and its scale at a place.
static void pins_take_plane(const struct stage *stage, const struct core *core, const double place[3],
                            struct pin_drag *drag)
{
    const struct stage_view *view = &stage->view;
    const float at[3] = {(float)place[0], (float)place[1], (float)place[2]};
    drag->pixels_per_metre = stage_pixels_per_metre(stage, core, at);
    for (int k = 0; k < 3; k++) {
        drag->right[k] = (double)view->view[4 * k];
        drag->up[k] = (double)view->view[4 * k + 1];
    }
}

/// Where the pointer has dragged the point.
static void drag_to(const struct pin_drag *drag, double dx, double dy, double to[3])
{
    for (int k = 0; k < 3; k++) {
        to[k] = drag->start[k];
        if (drag->axis < 0) to[k] += (dx * drag->right[k] - dy * drag->up[k]) / drag->pixels_per_metre;
    }
    if (drag->axis < 0) return;
    to[drag->axis] += stage_along(drag->right[drag->axis], drag->up[drag->axis], dx, dy) / drag->pixels_per_metre;
}

/// Moves the point or marker to the pointer.
static void apply(void *room, struct core *core)
{
    const struct pin_drag *drag = &((const struct stage *)room)->pin_drag;
    double to[3];
    drag_to(drag, core->drag.moved_x, core->drag.moved_y, to);
    pins_put(core, drag->point.rig, drag->point.at, drag->frame, to);
}

static enum drag_answer take_event(void *room, struct core *core, const struct event *event)
{
    // Ctrl may still be held from grabbing a joint.
    const bool key = event->kind == EVENT_KEY && event->action == ACTION_PRESS && !(event->mods & MOD_ALT);
    return key && drag_lock_axis(&core->drag, &((struct stage *)room)->pin_drag.axis, event->key) ? DRAG_USED
                                                                                                  : DRAG_PASSES;
}

static const float HERE = 5, ELSEWHERE = 3.5f, RING = 8, LIT = 6.5f, END = 2; ///< radii, pixels
static const float LEAST_LINE = 1.5f;                                         ///< pixels; shorter lines are not drawn
static const float FAINT = 0.5f;                                              ///< opacity of markers at other frames
static const float AXIS = 2; ///< metres of a locked axis to each side, as drawn

/// Draws the axis of a locked drag.
static void pins_show_axis(void *room, struct core *core)
{
    const struct stage *stage = room;
    const struct pin_drag *drag = &stage->pin_drag;
    float ends[2][3], line[2][2];
    if (drag->axis < 0) return;
    for (int e = 0; e < 2; e++) {
        for (int k = 0; k < 3; k++) ends[e][k] = (float)drag->start[k];
        ends[e][drag->axis] += e ? AXIS : -AXIS;
        if (!stage_project_point(stage, core->layout.stage, ends[e], line[e])) return;
    }
    drawlist_dashed(&core->list, line[0], 2, 1, 6, 4, theme_fade(theme()->playhead, 0.7f));
}

static void press_pin(void *room, struct core *core, const struct hover *hover, const struct event *event)
{
    struct stage *stage = room;
    static const struct drag_owner owner = {
        .cursor = CURSOR_HAND, .apply = apply, .event = take_event, .end = stage_click, .show = pins_show_axis};
    struct pin_drag *drag = &stage->pin_drag;
    const struct document *document = core->document;
    drag_begin(core, &owner, stage, hover->thing == &thing_pin ? "Move pin" : "Pin", event);
    *drag = (struct pin_drag){.point = {hover->rig, hover->joint}, .axis = -1};
    if (hover->thing == &thing_pin) {
        const struct rig *rig = document->rigs[hover->rig];
        const struct pin *pin = &rig->pins[pins_find_id(rig, hover->pin)];
        pins_visit(core, pin);
        drag->frame = pin->frame;
        memcpy(drag->start, pin->to, sizeof drag->start);
    } else {
        float place[3] = {0};
        drag->frame = pins_frame_here(core, hover->rig);
        playback_seek(core, drag->frame);
        point_place(core, drag->point, core->playback.position, place);
        for (int k = 0; k < 3; k++) drag->start[k] = (double)place[k];
    }
    pins_take_plane(stage, core, drag->start, drag);
}

static bool find_pin(void *room, const struct core *core, const struct target *target, float xy[2])
{
    return project(room, core, target->pin->to, xy);
}

/// pin(tail,0): a pin's marker, counted by frame.
const struct thing thing_pin = {
    .cursor = CURSOR_MOVE,
    .hint = "Drag the pin (X, Y or Z locks an axis, Shift: fine); Del removes it; Alt+arrows nudge it",
    .place = ON_PIN,
    .press = press_pin,
    .name = "pin",
    .of = OF_PIN,
    .numbers = 1,
    .find = find_pin,
    .missing = "that pin is not in sight"};

/// character(up,0.5,0.8): a surface point where it is now. u runs across and v up the rest pose's box, seen from the front.
const struct thing thing_point = {
    .cursor = CURSOR_HAND,
    .hint = "Drag to pin this point at the playhead (X, Y or Z locks an axis, Shift: fine); H pins it where it is",
    .press = press_pin,
    .name = "character",
    .of = OF_RIG,
    .rig = RIG_CHARACTER,
    .numbers = 2,
    .find = find_character,
    .missing = "that character is not to be seen"};

static const double NUDGE = 0.01; ///< of the view's height

void stage_nudge_pin(struct stage *stage, struct core *core, double right, double up)
{
    int rig;
    struct pin_drag plane;
    const struct pin *pin = pins_selected(core, &rig);
    if (!pin) return;
    pins_take_plane(stage, core, pin->to, &plane);
    const double step = core_round(NUDGE * (double)core->layout.stage.h / plane.pixels_per_metre, 0.01);
    double by[3];
    for (int k = 0; k < 3; k++) by[k] = step * (right * plane.right[k] + up * plane.up[k]);
    pins_nudge(core, by);
}

/// Pins a point at the playhead where it is.
static void hold(struct core *core, struct rig_point point)
{
    float place[3];
    if (!point_exists(core, point)) {
        core_message(core, false, "There is no tail, chain or character to pin.");
        return;
    }
    const double frame = pins_frame_here(core, point.rig);
    if (!point_place(core, point, core_position(core->document, frame), place)) return;
    pins_put_here(core, point.rig, point.at, (const double[3]){place[0], place[1], place[2]});
}

void stage_hold_point(struct stage *stage, struct core *core)
{
    int rig;
    struct hover hover = core->hover;
    if (is_strand(&hover)) hover = strand_end(stage, core, &hover);
    const struct pin *selected = pins_selected(core, &rig);
    if (hover.thing == &thing_point) {
        hold(core, (struct rig_point){hover.rig, hover.joint});
    } else if (selected) {
        const struct pin pin = *selected;
        pins_put_here(core, rig, pin.point, pin.to);
    } else {
        hold(core, overlay_point(stage, core));
    }
}

/// The target, and a line to the point at the pin's frame if known.
static void show_marker(const struct stage *stage, struct core *core, struct pin_place place, const struct pin *pin)
{
    struct drawlist *list = &core->list;
    const struct document *document = core->document;
    const struct pin_left *left = evaluation_pin(core->evaluation, document, place.rig, place.at);
    const bool here = document_sample(document, pin->frame) == document_sample(document, core_frame(core));
    const bool selected = core->pin.any && core->pin.id == pin->id;
    const bool hot = core->hover.thing == &thing_pin && core->hover.pin == pin->id;
    const float radius = here || selected || hot ? HERE : ELSEWHERE;
    const uint32_t color = theme_fade(pins_color(document, place.rig), here || selected || hot ? 1 : FAINT);
    float line[2][2];
    if (!project(stage, core, pin->to, line[0])) return;
    const bool has_end = left && left->is_found && project(stage, core, left->at, line[1]);
    if (has_end && maths_hypotf(line[1][0] - line[0][0], line[1][1] - line[0][1]) > LEAST_LINE) {
        drawlist_line(list, line[0], 2, 1.25f, color);
        drawlist_disc(list, line[1], END, color);
    }
    drawlist_disc(list, line[0], radius + 1.5f, theme_fade(theme()->panel, here || selected ? 0.8f : 0.4f));
    drawlist_disc(list, line[0], radius, color);
    if (!selected && !hot) return;
    char text[32];
    snprintf(text, sizeof text, "%.6g", pin->frame);
    drawlist_circle(list, line[0], RING, 1.5f, theme()->playhead);
    stage_note(core, line[0][0] + RING + 8, line[0][1] + 4, FONT_NUMBER, theme()->text, text);
}

void pins_show(struct stage *stage, struct core *core)
{
    int rig;
    struct pin_place place = PINS_START;
    const struct pin *selected = pins_selected(core, &rig);
    if (selected && point_exists(core, (struct rig_point){rig, selected->point}))
        path_show(stage, core, TRAIL_OF_PIN, (struct rig_point){rig, selected->point});
    for (const struct pin *pin; (pin = next_marker(core, &place));) show_marker(stage, core, place, pin);
    if (core->hover.thing != &thing_point || core->drag.owner) return;
    const float xy[2] = {core->hover.x, core->hover.y}; // the target of a press
    drawlist_circle(&core->list, xy, LIT + 1.5f, 1.5f, theme_fade(theme()->panel, 0.6f));
    drawlist_circle(&core->list, xy, LIT, 1.5f, theme()->playhead);
    drawlist_disc(&core->list, xy, END, theme()->playhead);
}

bool point_exists(const struct core *core, struct rig_point point)
{
    const struct document *document = core->document;
    if (point.rig < 0 || point.rig >= document->rig_count) return false;
    const enum rig_kind kind = document->rigs[point.rig]->kind;
    if (point.at < 0) return point.at == POINT_BASE && kind == RIG_TAIL;
    if (kind == RIG_TAIL || kind == RIG_CHAIN) return point.at < bones_joints(core, point.rig);
    const int n = document_rig_number(document, point.rig);
    const struct figure *figure = kind == RIG_CHARACTER ? models_figure(core->models, n) : NULL;
    return figure && point.at < figure->character.vertex_count;
}

/// Reads a place from a posed rig.
static void take_place(const struct rig_pose *pose, int at, float place[3])
{
    if (pose->kind == RIG_CHARACTER) {
        stage_vertex(pose->character.figure, &pose->character.morph, pose->character.position, at, place);
    } else {
        memcpy(place, pose->strand.matrix[at + 1] + 12, 3 * sizeof *place);
    }
}

bool point_place(const struct core *core, struct rig_point point, double position, float place[3])
{
    struct rig_pose pose;
    const struct posing posing = stage_posing(core);
    if (!point_exists(core, point) || !rig_pose(&posing, point.rig, position, NULL, &pose)) return false;
    take_place(&pose, point.at, place);
    return true;
}
