/// The stage: poses the tails, drives the camera, finds what the pointer is over.
#include "base/hash.h"
#include "editor/core/actions.h"
#include "editor/curves/curves.h"
#include "editor/stage/body.h"
#include "editor/stage/follow.h"
#include "editor/stage/overlays.h"
#include "rig/shadow.h"
#include "ui/font.h"
#include "ui/theme.h"
#include <assert.h>
#include <math.h>

enum { FIT_STEPS = 120, BLOBS_OF_ONE_TAIL = 16, RING_SIZE = 13 };

static const float GRAB_REACH = 16; ///< pixels from the tail's centre line
/// Radians. Characters look towards +z; one is met from a bit aside, a pair from the front.
static const float AZIMUTH_OF_ONE = -1.13f, AZIMUTH_OF_PAIR = -1.5708f;
static const double ZOOM_STEP = 0.12; ///< of a wheel's notch, as a power of e

struct posing stage_posing(const struct editor *editor, const struct editor_world *world)
{
    return (struct posing){world->document, world->evaluation, world->cast, editor->look};
}

/// What moves a tail besides the document: its body in the hand, what swings after it, and `change` (may be NULL).
static struct by_hand by_hand(const struct editor *editor, const struct tail *shown, int tail,
                              const struct what_if *change)
{
    struct by_hand hand = {0};
    for (int c = 0; c < shown->channel_count; c++) {
        hand.channel[c] = follow_value(editor, tail, c);
        if (!change || change->spline != shown->channels[c].spline) continue;
        hand.channel[c].re += change->re;
        hand.channel[c].im += change->im;
    }
    body_offset(editor, tail, hand.base);
    return hand;
}

void stage_pose_tail(const struct editor *editor, const struct editor_world *world, int tail, double position,
                     const struct what_if *change, struct pose *pose)
{
    const struct posing posing = stage_posing(editor, world);
    const struct by_hand hand = by_hand(editor, document_tail(world->document, tail), tail, change);
    posing_tail(&posing, tail, position, &hand, pose);
}

static void add_blobs(struct stage_view *view, const struct pose *pose)
{
    struct shadow_blob blobs[BLOBS_OF_ONE_TAIL];
    int room = STAGE_MAX_BLOBS - view->blob_count;
    int count = pose_blobs(pose, blobs, room < BLOBS_OF_ONE_TAIL ? room : BLOBS_OF_ONE_TAIL);
    for (int i = 0; i < count; i++) {
        view->blobs[view->blob_count++] =
            (struct stage_blob){blobs[i].x, blobs[i].z, blobs[i].radius, blobs[i].strength};
    }
}

void stage_fit(struct editor *editor, const struct editor_world *world)
{
    float lo[3] = {INFINITY, INFINITY, INFINITY}, hi[3] = {-INFINITY, -INFINITY, -INFINITY};
    double last = document_samples(world->document) - 1;
    const int tails = document_count_rigs(world->document, RIG_TAIL);
    for (int i = 0; i <= FIT_STEPS; i++) {
        for (int t = 0; t < tails && t < STAGE_MAX_TAILS; t++) {
            struct pose pose;
            float low[3], high[3];
            stage_pose_tail(editor, world, t, last * i / FIT_STEPS, NULL, &pose);
            pose_bounds(&pose, low, high);
            for (int axis = 0; axis < 3; axis++) {
                lo[axis] = fminf(lo[axis], low[axis]);
                hi[axis] = fmaxf(hi[axis], high[axis]);
            }
        }
    }
    editor->camera = camera_default();
    bool any = characters_bounds(editor, world, lo, hi);
    if (any && tails == 0) editor->camera.azimuth = editor->characters.compare ? AZIMUTH_OF_PAIR : AZIMUTH_OF_ONE;
    camera_lamp(&editor->camera, editor->stage.key_from); // it stays there while the camera goes round
    if (!any && tails == 0) return;
    for (int k = 0; k < 2; k++) editor->stage.middle[k] = 0.5f * (lo[2 * k] + hi[2 * k]);
    camera_fit(&editor->camera, lo, hi, editor->layout.stage.w / editor->layout.stage.h);
}

static uint64_t characters_hash(uint64_t hash, const struct stage_view *view)
{
    for (int c = 0; c < view->character_count; c++) {
        const struct stage_character *shown = &view->characters[c];
        const struct morph *morph = &shown->morph;
        const int looks[] = {shown->coarse, shown->map_coordinate, shown->map_axis};
        hash = hash_word(hash_word(hash, shown->figure->id), shown->figure->version);
        hash = hash_bytes(hash, shown->position, sizeof shown->position);
        hash = hash_bytes(hash, looks, sizeof looks);
        hash = hash_bytes(hash, morph->coordinate, (size_t)morph->count * sizeof *morph->coordinate);
        hash = hash_bytes(hash, morph->weight, (size_t)morph->count * sizeof *morph->weight);
    }
    return hash;
}

static uint64_t view_hash(const struct stage_view *view)
{
    uint64_t hash = hash_bytes(HASH_START, &view->viewport, sizeof view->viewport);
    hash = hash_bytes(hash, view->view, sizeof view->view);
    hash = hash_bytes(hash, view->projection, sizeof view->projection);
    hash = hash_bytes(hash, view->middle, sizeof view->middle);
    hash = hash_bytes(hash, view->key_from, sizeof view->key_from);
    hash = hash_bytes(hash, &view->colors, sizeof view->colors);
    for (int t = 0; t < view->tail_count; t++) {
        const struct stage_tail *tail = &view->tails[t];
        hash = hash_bytes(hash, &tail->joints, sizeof tail->joints);
        hash = hash_bytes(hash, &tail->length, sizeof tail->length);
        hash = hash_bytes(hash, &tail->pose.ground, sizeof tail->pose.ground);
        hash = hash_bytes(hash, tail->pose.matrix, (size_t)tail->pose.count * sizeof tail->pose.matrix[0]);
    }
    hash = characters_hash(hash, view);
    return hash_bytes(hash, view->blobs, (size_t)view->blob_count * sizeof view->blobs[0]);
}

void stage_pose(struct editor *editor, const struct editor_world *world)
{
    struct stage_view *view = &editor->stage;
    const struct document *document = world->document;
    const int tails = document_count_rigs(document, RIG_TAIL);
    view->tail_count = tails < STAGE_MAX_TAILS ? tails : STAGE_MAX_TAILS;
    view->blob_count = 0;
    for (int t = 0; t < view->tail_count; t++) {
        const struct tail *tail = document_tail(document, t);
        struct stage_tail *shown = &view->tails[t];
        shown->joints = tail->joints;
        shown->length = (float)tail->length;
        stage_pose_tail(editor, world, t, editor->playback.position, NULL, &shown->pose);
        add_blobs(view, &shown->pose);
    }
    characters_pose(editor, world);
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
        return "This scene's character could not be read: its curves are below.";
    return editor->active < 0 ? "This scene is empty." : "This scene moves no tail: its curves are below.";
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
