/// Pins on the stage: what is pointed at, drags in the plane that faces the eye, keys, and their markers.
#include "editor/core/pins.h"
#include "editor/core/bones.h"
#include "editor/core/core.h"
#include "editor/core/drag.h"
#include "editor/stage/parts.h"
#include "editor/stage/stage.h"
#include "model/vector.h"
#include "scene/pins.h"
#include "ui/font.h"
#include "ui/theme.h"
#include <math.h>
#include <stdio.h>
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
static struct hover surface_hover(struct stage *stage, const struct core *core, float x, float y)
{
    struct pointed *pointed = &stage->pointed;
    const bool still = pointed->x == x && pointed->y == y;
    if (core->brush.on || core->characters.compare || core->pick.use != BONE_SELECTED)
        return (struct hover){.kind = HOVER_NONE};
    if (still && pointed->hash == stage->view.hash) return pointed->hover;
    if (still && core->playback.playing) return (struct hover){.kind = HOVER_NONE};
    *pointed = (struct pointed){x, y, stage->view.hash, find_vertex(stage, core->document, x, y)};
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

struct hover pins_hover(struct stage *stage, const struct core *core, const struct hover *found, float x, float y)
{
    if (core->brush.on || core->pick.use != BONE_SELECTED) return (struct hover){.kind = HOVER_NONE};
    const struct hover marker = marker_hover(stage, core, x, y);
    if (marker.kind != HOVER_NONE) return marker;
    return found->kind == HOVER_NONE ? surface_hover(stage, core, x, y) : (struct hover){.kind = HOVER_NONE};
}

bool pins_hover_exists(const struct core *core, const struct hover *hover)
{
    if (hover->kind == HOVER_POINT) return point_exists(core, (struct rig_point){hover->rig, hover->joint});
    const struct document *document = core->document;
    return hover->rig < document->rig_count && pins_find_id(document->rigs[hover->rig], hover->pin) >= 0;
}

/// The picture's directions in the world, and its scale at a place.
static void pins_take_plane(const struct stage *stage, const struct core *core, const double place[3],
                            struct pin_drag *drag)
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
static void apply(void *room, struct core *core)
{
    const struct pin_drag *drag = &((const struct stage *)room)->pin_drag;
    double to[3];
    drag_to(drag, core->drag.moved_x, core->drag.moved_y, to);
    pins_put(core, drag->point.rig, drag->point.at, drag->frame, to);
}

static enum drag_answer take_event(void *room, struct core *core, const struct event *event)
{
    // Ctrl may still be down, which takes joints.
    const bool key = event->kind == EVENT_KEY && event->action == ACTION_PRESS && !(event->mods & MOD_ALT);
    return key && lock(room, &core->drag, event->key) ? DRAG_USED : DRAG_PASSES;
}

static const float HERE = 5, ELSEWHERE = 3.5f, RING = 8, LIT = 6.5f, END = 2; ///< radii, pixels
static const float LEAST_LINE = 1.5f;                                         ///< pixels that are left to be seen
static const float FAINT = 0.5f;                                              ///< opacity of markers of other frames
static const float AXIS = 2; ///< metres of a locked axis to each side

/// Draws the line along which a locked drag goes.
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

void pins_begin(struct stage *stage, struct core *core, const struct hover *hover, const struct event *event)
{
    static const struct drag_owner owner = {
        .cursor = CURSOR_HAND, .apply = apply, .event = take_event, .end = stage_click, .show = pins_show_axis};
    struct pin_drag *drag = &stage->pin_drag;
    const struct document *document = core->document;
    drag_begin(core, &owner, stage, hover->kind == HOVER_PIN ? "Move pin" : "Pin", event);
    *drag = (struct pin_drag){.point = {hover->rig, hover->joint}, .axis = -1};
    if (hover->kind == HOVER_PIN) {
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

static const double NUDGE = 0.01; ///< of the height of what is seen

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
    if (hover.kind == HOVER_JOINT) hover = strand_end(stage, core, &hover);
    const struct pin *selected = pins_selected(core, &rig);
    if (hover.kind == HOVER_POINT) {
        hold(core, (struct rig_point){hover.rig, hover.joint});
    } else if (selected) {
        const struct pin pin = *selected;
        pins_put_here(core, rig, pin.point, pin.to);
    } else {
        hold(core, overlay_point(stage, core));
    }
}

static void add_pin(struct stage *stage, const struct core *core, int rig, int at)
{
    const struct document *document = core->document;
    const struct pin *pin = &document->rigs[rig]->pins[at];
    const struct pin_left *left = evaluation_pin(core->evaluation, document, rig, at);
    const int spline = rig_point_spline(document->rigs[rig]);
    struct shown_pin *shown = &stage->pins[stage->pin_count++];
    *shown = (struct shown_pin){.id = pin->id, .point = {rig, pin->point}, .frame = pin->frame};
    shown->color = spline >= 0 ? spline_list_color(document, spline) : theme()->text_dim;
    shown->is_known = left && left->is_found;
    for (int k = 0; k < 3; k++) shown->to[k] = (float)pin->to[k];
    for (int k = 0; k < 3 && shown->is_known; k++) shown->place[k] = (float)left->at[k];
}

/// Finds all markers for the document as it is solved now.
static void update(struct stage *stage, const struct core *core)
{
    const struct document *document = core->document;
    stage->pin_count = 0;
    for (int r = 0; r < document->rig_count; r++) {
        if (document->rigs[r]->kind == RIG_CHARACTER && core->characters.compare) continue; // they stand aside
        for (int i = 0; i < document->rigs[r]->pin_count; i++) add_pin(stage, core, r, i);
    }
}

static void show_disc(struct drawlist *list, const float xy[2], float radius, uint32_t color)
{
    drawlist_rounded(list, (struct rect){xy[0] - radius, xy[1] - radius, 2 * radius, 2 * radius}, radius, color);
}

static void show_circle(struct drawlist *list, const float xy[2], float radius, uint32_t color)
{
    const struct rect r = {xy[0] - radius, xy[1] - radius, 2 * radius, 2 * radius};
    drawlist_rounded_line(list, r, radius, 1.5f, color);
}

/// The frame of a marker, right of it.
static void show_frame(struct core *core, const float xy[2], double frame)
{
    char text[32];
    snprintf(text, sizeof text, "%.6g", frame);
    drawlist_text(&core->list, xy[0] + RING + 4, xy[1] + 4, FONT_NUMBER, THEME_TEXT_SMALL, theme()->text, text);
}

static void show_marker(const struct stage *stage, struct core *core, const struct shown_pin *pin, bool here)
{
    struct drawlist *list = &core->list;
    const bool selected = core->pin.any && core->pin.id == pin->id;
    const bool hot = core->hover.kind == HOVER_PIN && core->hover.pin == pin->id;
    const float radius = here || selected || hot ? HERE : ELSEWHERE;
    const uint32_t color = theme_fade(pin->color, here || selected || hot ? 1 : FAINT);
    float line[2][2];
    if (!stage_project_point(stage, core->layout.stage, pin->to, line[0])) return;
    const bool has_end = pin->is_known && stage_project_point(stage, core->layout.stage, pin->place, line[1]);
    if (has_end && hypotf(line[1][0] - line[0][0], line[1][1] - line[0][1]) > LEAST_LINE) {
        drawlist_line(list, line[0], 2, 1.25f, color);
        show_disc(list, line[1], END, color);
    }
    show_disc(list, line[0], radius + 1.5f, theme_fade(theme()->panel, here || selected ? 0.8f : 0.4f));
    show_disc(list, line[0], radius, color);
    if (selected || hot) show_circle(list, line[0], RING, theme()->playhead);
    if (selected || hot) show_frame(core, line[0], pin->frame);
}

/// What a press would take hold of.
static void show_lit(struct core *core)
{
    const float xy[2] = {core->hover.x, core->hover.y};
    if (core->hover.kind != HOVER_POINT || core->drag.owner) return;
    show_circle(&core->list, xy, LIT + 1.5f, theme_fade(theme()->panel, 0.6f));
    show_circle(&core->list, xy, LIT, theme()->playhead);
    show_disc(&core->list, xy, END, theme()->playhead);
}

void pins_show(struct stage *stage, struct core *core)
{
    const struct document *document = core->document;
    int rig;
    update(stage, core);
    const struct pin *selected = pins_selected(core, &rig);
    if (selected && point_exists(core, (struct rig_point){rig, selected->point}))
        path_show(stage, core, TRAIL_OF_PIN, (struct rig_point){rig, selected->point});
    const int now = document_sample(document, core_frame(core));
    for (int i = 0; i < stage->pin_count; i++) {
        const struct shown_pin *pin = &stage->pins[i];
        show_marker(stage, core, pin, document_sample(document, pin->frame) == now);
    }
    show_lit(core);
}

bool stage_pin_point(const struct stage *stage, const struct core *core, unsigned id, float xy[2])
{
    for (int i = 0; i < stage->pin_count; i++) {
        if (stage->pins[i].id == id) return stage_project_point(stage, core->layout.stage, stage->pins[i].to, xy);
    }
    return false;
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

/// Out of a posed rig.
static void take_place(const struct rig_pose *pose, int at, float place[3])
{
    if (pose->kind == RIG_CHARACTER) {
        const struct figure *figure = pose->character.figure;
        morph_vertex(figure, &pose->character.morph, at, place, NULL);
        for (int k = 0; k < 3; k++) place[k] += pose->character.position[k] - (k == 1 ? figure->lo[1] : 0.0f);
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
