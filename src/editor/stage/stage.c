/// The stage: poses the rigs, drives the camera, finds what the pointer is over.
#include "base/hash.h"
#include "editor/core/actions.h"
#include "editor/curves/curves.h"
#include "editor/stage/body.h"
#include "editor/stage/kinds.h"
#include "editor/stage/overlays.h"
#include "ui/font.h"
#include "ui/theme.h"
#include <assert.h>
#include <math.h>

enum { RING_SIZE = 13 };

static const float GRAB_REACH = 16; ///< pixels from the tail's centre line
/// Radians. Characters look towards +z; one is met from a bit aside, a pair from the front.
static const float AZIMUTH_OF_ONE = -1.13f, AZIMUTH_OF_PAIR = -1.5708f;
static const double ZOOM_STEP = 0.12; ///< of a wheel's notch, as a power of e

struct posing stage_posing(const struct editor *editor, const struct editor_world *world)
{
    return (struct posing){world->document, world->evaluation, world->cast, editor->look};
}

/// In this order they are posed, hashed and drawn.
static const struct stage_kind *const kinds[RIG_KINDS] = {
    [RIG_TAIL] = &stage_tails, [RIG_CHARACTER] = &stage_characters};

/// Adds all motion of a kind to the box lo … hi; false where nothing of it is to be seen.
static bool add_bounds(const struct editor *editor, const struct editor_world *world, enum rig_kind kind, float lo[3],
                       float hi[3])
{
    const struct document *document = world->document;
    bool any = false;
    int rig = document_next_rig(document, kind, 0);
    for (int n = 0; rig >= 0; n++, rig = document_next_rig(document, kind, rig + 1)) {
        any |= kinds[kind]->bounds(editor, world, rig, n, lo, hi);
    }
    return any;
}

void stage_fit(struct editor *editor, const struct editor_world *world)
{
    float lo[3] = {INFINITY, INFINITY, INFINITY}, hi[3] = {-INFINITY, -INFINITY, -INFINITY};
    bool seen[RIG_KINDS], any = false;
    for (int kind = 0; kind < RIG_KINDS; kind++) {
        seen[kind] = add_bounds(editor, world, (enum rig_kind)kind, lo, hi);
        any |= seen[kind];
    }
    editor->camera = camera_default();
    if (seen[RIG_CHARACTER] && !seen[RIG_TAIL])
        editor->camera.azimuth = editor->characters.compare ? AZIMUTH_OF_PAIR : AZIMUTH_OF_ONE;
    camera_lamp(&editor->camera, editor->stage.key_from); // it stays there while the camera goes round
    if (!any) return;
    for (int k = 0; k < 2; k++) editor->stage.middle[k] = 0.5f * (lo[2 * k] + hi[2 * k]);
    camera_fit(&editor->camera, lo, hi, editor->layout.stage.w / editor->layout.stage.h);
}

static uint64_t view_hash(const struct stage_view *view)
{
    uint64_t hash = hash_bytes(HASH_START, &view->viewport, sizeof view->viewport);
    hash = hash_bytes(hash, view->view, sizeof view->view);
    hash = hash_bytes(hash, view->projection, sizeof view->projection);
    hash = hash_bytes(hash, view->middle, sizeof view->middle);
    hash = hash_bytes(hash, view->key_from, sizeof view->key_from);
    hash = hash_bytes(hash, &view->colors, sizeof view->colors);
    for (int kind = 0; kind < RIG_KINDS; kind++) hash = kinds[kind]->hash(hash, view);
    return hash_bytes(hash, view->blobs, (size_t)view->blob_count * sizeof view->blobs[0]);
}

void stage_pose(struct editor *editor, const struct editor_world *world)
{
    struct stage_view *view = &editor->stage;
    const struct document *document = world->document;
    view->tail_count = view->character_count = view->blob_count = 0;
    for (int kind = 0; kind < RIG_KINDS; kind++) {
        int rig = document_next_rig(document, (enum rig_kind)kind, 0);
        for (int n = 0; rig >= 0; n++, rig = document_next_rig(document, (enum rig_kind)kind, rig + 1)) {
            kinds[kind]->pose(editor, world, rig, n);
        }
    }
    view->viewport = editor->layout.stage;
    view->colors = theme()->stage;
    camera_matrices(&editor->camera, view->viewport.w / view->viewport.h, view->view, view->projection, view->eye);
    view->hash = view_hash(view);
}

/// A ring where the tail can be taken hold of.
static void show_hold(struct editor *editor)
{
    float xy[2] = {editor->hover.x, editor->hover.y};
    if (editor->drag.kind == DRAG_GRAB) {
        if (!stage_project(editor, editor->grab.tail, editor->grab.joint, editor->grab.fraction, xy)) return;
    } else if (editor->hover.kind != HOVER_JOINT) {
        return;
    }
    struct rect ring = {xy[0] - RING_SIZE / 2.0f, xy[1] - RING_SIZE / 2.0f, RING_SIZE, RING_SIZE};
    drawlist_rounded_line(&editor->list, ring, RING_SIZE / 2.0f, 1.5f, theme()->playhead);
}

/// What an empty stage says, or NULL.
static const char *empty_text(const struct editor *editor, const struct editor_world *world)
{
    const struct stage_view *view = &editor->stage;
    if (view->tail_count > 0 || view->character_count > 0) return NULL;
    if (document_character(world->document, 0))
        return "wiggly could not read this scene's character. Its curves are below.";
    return editor->active < 0 ? "This scene is empty." : "This scene has no tail. Its curves are below.";
}

void stage_show(struct editor *editor, const struct editor_world *world)
{
    const struct stage_view *view = &editor->stage;
    struct rect clip = drawlist_push_clip(&editor->list, view->viewport);
    const char *text = empty_text(editor, world);
    if (text) {
        float room = view->viewport.w - 16, width = font_width(FONT_LABEL, THEME_TEXT_NORMAL, text);
        float x = view->viewport.x + 8 + fmaxf(room - width, 0) / 2;
        drawlist_text_fit(&editor->list, x, view->viewport.y + view->viewport.h / 2, room, FONT_LABEL,
                          THEME_TEXT_NORMAL, theme()->text_dim, text);
    }
    onion_show(editor, world);
    trail_show(editor, world);
    characters_show(editor, world);
    brush_show(editor, world);
    body_show(editor);
    show_hold(editor);
    drawlist_set_clip(&editor->list, clip);
}

bool stage_project_pose(const struct editor *editor, const struct pose *pose, int joint, double fraction, float xy[2])
{
    const struct rect *r = &editor->layout.stage;
    const float viewport[4] = {r->x, r->y, r->w, r->h};
    float world[3];
    assert(joint >= 0 && joint < pose->count);
    int next = joint + 1 < pose->count ? joint + 1 : joint;
    for (int i = 0; i < 3; i++) {
        float from = pose->matrix[joint][12 + i], to = pose->matrix[next][12 + i];
        world[i] = from + (to - from) * (float)fraction;
    }
    return camera_project(editor->stage.view, editor->stage.projection, viewport, world, xy);
}

bool stage_project(const struct editor *editor, int tail, int joint, double fraction, float xy[2])
{
    if (tail >= editor->stage.tail_count || joint >= editor->stage.tails[tail].pose.count) return false;
    return stage_project_pose(editor, &editor->stage.tails[tail].pose, joint, fraction, xy);
}

/// How far along the segment a … b the point nearest to p is, 0 … 1.
static float nearest_on_segment(const float a[2], const float b[2], const float p[2])
{
    float dx = b[0] - a[0], dy = b[1] - a[1];
    float square = dx * dx + dy * dy;
    float along = (p[0] - a[0]) * dx + (p[1] - a[1]) * dy;
    return square > 0 ? fmaxf(0, fminf(1, along / square)) : 0;
}

struct hover stage_hover(const struct editor *editor, float x, float y)
{
    struct hover hover = {.kind = HOVER_NONE};
    const float p[2] = {x, y};
    float best = GRAB_REACH;
    for (int t = 0; t < editor->stage.tail_count; t++) {
        for (int n = 0; n + 1 < editor->stage.tails[t].pose.count; n++) {
            float a[2], b[2];
            if (!stage_project(editor, t, n, 0, a) || !stage_project(editor, t, n, 1, b)) continue;
            float fraction = nearest_on_segment(a, b, p);
            float at[2] = {a[0] + (b[0] - a[0]) * fraction, a[1] + (b[1] - a[1]) * fraction};
            float distance = hypotf(x - at[0], y - at[1]);
            if (distance >= best) continue;
            best = distance;
            hover = (struct hover){
                .kind = HOVER_JOINT, .tail = t, .joint = n, .fraction = fraction, .x = at[0], .y = at[1]};
        }
    }
    return hover.kind == HOVER_NONE ? body_hover(editor, x, y) : hover;
}

void stage_press(struct editor *editor, const struct editor_world *world, const struct event *event)
{
    bool pan = event->button == BUTTON_MIDDLE || (event->button == BUTTON_LEFT && editor->space_down);
    if (pan) {
        editor->space_used = editor->space_down;
        drag_begin(editor, DRAG_STAGE_PAN, event);
        return;
    }
    if (brush_press(editor, world, event)) return;
    struct hover hover = stage_hover(editor, event->x, event->y);
    if (event->button == BUTTON_LEFT && hover.kind == HOVER_BODY) {
        drag_begin(editor, DRAG_BODY, event);
        body_begin(editor, hover.tail);
    } else if (event->button == BUTTON_LEFT && hover.kind == HOVER_JOINT) {
        drag_begin(editor, DRAG_GRAB, event);
        grab_begin(editor, world, &hover);
    } else {
        drag_begin(editor, DRAG_ORBIT, event);
    }
}

void stage_wheel(struct editor *editor, const struct event *event)
{
    if (brush_wheel(editor, event)) return;
    camera_zoom(&editor->camera, (float)exp(-ZOOM_STEP * fmin(fmax(event->dy, -20), 20)));
}
