/// The stage panel: its beginning and end, the mouse on it, what its drags do, and what time does.
#include "editor/stage/stage.h"
#include "editor/core/drag.h"
#include "editor/core/pins.h"
#include "editor/stage/bones.h"
#include "editor/stage/brush.h"
#include "editor/stage/floors.h"
#include "editor/stage/hold.h"
#include "editor/stage/pins.h"
#include "editor/stage/skin.h"
#include "editor/stage/strand.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

struct stage *stage_create(void)
{
    struct stage *stage = calloc(1, sizeof *stage);
    if (stage) stage->camera = camera_default();
    return stage;
}

void stage_destroy(struct stage *stage)
{
    if (!stage) return;
    brush_free(&stage->painting);
    skin_free(&stage->skin);
    free(stage);
}

void stage_open(struct stage *stage)
{
    memset(stage->sway, 0, sizeof stage->sway);
    memset(&stage->meadow, 0, sizeof stage->meadow);
    stage->strand_count = stage->bone_count = stage->pin_count = 0;
    stage->pins_key = 0;
}

const struct stage_view *stage_seen(const struct stage *stage) { return &stage->view; }

static const double ZOOM_STEP = 0.12; ///< of a wheel's notch, as a power of e

/// The nearer of two on the screen; the first where only that is there.
static struct hover nearer(struct hover a, struct hover b, float x, float y)
{
    if (b.kind == HOVER_NONE) return a;
    return a.kind == HOVER_NONE || hypotf(b.x - x, b.y - y) < hypotf(a.x - x, a.y - y) ? b : a;
}

struct hover stage_hover(struct stage *stage, const struct core *core, const struct document *document, float x,
                         float y)
{
    struct hover joint = nearer(strand_hover(stage, core, x, y), bone_hover(stage, core, x, y), x, y);
    const bool pins = core->mods & MOD_CTRL && !core->brush.on && core->pick.use == BONE_SELECTED;
    if (pins && joint.kind == HOVER_JOINT) joint = strand_end(stage, core, &joint);
    struct hover found = joint;
    if (found.kind == HOVER_NONE) found = floors_hover(stage, core, document, x, y);
    if (found.kind == HOVER_NONE) found = hold_hover(stage, x, y);
    const struct hover pin = pins_hover(stage, core, document, &found, x, y);
    return pin.kind == HOVER_NONE ? found : pin;
}

/// What is under a point and still in the document: an edit in the same frame may have taken away what was last shown.
static struct hover hover_now(struct stage *stage, const struct core *core, const struct editor_world *world, float x,
                              float y)
{
    const struct document *document = world->document;
    struct hover hover = stage_hover(stage, core, document, x, y);
    if (hover.kind == HOVER_JOINT && !grab_holds(document, hover.rig, hover.joint)) hover.kind = HOVER_NONE;
    if (hover.kind == HOVER_BONE && !bone_exists(document, hover.model)) hover.kind = HOVER_NONE;
    if (hover.kind == HOVER_BODY && !document_tail(document, hover.tail)) hover.kind = HOVER_NONE;
    if ((hover.kind == HOVER_POINT || hover.kind == HOVER_PIN) && !pins_hover_exists(world, &hover))
        hover.kind = HOVER_NONE;
    if (hover.kind == HOVER_FLOOR && !floors_exist(document, hover.rig)) hover.kind = HOVER_NONE;
    return hover;
}

bool stage_body_point(struct stage *stage, const struct core *core, const struct document *document, int tail,
                      float xy[2])
{
    for (int i = 0; i < HOLD_POINTS; i++) {
        if (!hold_point(stage, core, tail, i, xy)) continue;
        struct hover hover = stage_hover(stage, core, document, xy[0], xy[1]);
        if (hover.kind == HOVER_BODY && hover.tail == tail) return true;
    }
    return false;
}

void stage_press(struct stage *stage, struct core *core, const struct editor_world *world, const struct event *event)
{
    bool pan = event->button == BUTTON_MIDDLE || (event->button == BUTTON_LEFT && core->space_down);
    if (pan) {
        core->space_used = core->space_down;
        drag_begin(core, DRAG_STAGE_PAN, NULL, event);
        return;
    }
    if (brush_press(stage, core, world, event)) return;
    stage->pointed.hash = 0; // a press means what is there now, even while all moves
    struct hover hover = hover_now(stage, core, world, event->x, event->y);
    const bool holds = event->button == BUTTON_LEFT && core->pick.use == BONE_SELECTED;
    if (holds && hover.kind == HOVER_NONE) hover = hold_moment_ago(stage, core, world, event->x, event->y);
    stage->pressed = hover;
    if (event->button == BUTTON_LEFT && hover.kind != HOVER_PIN) pins_clear(core);
    if (holds && (hover.kind == HOVER_POINT || hover.kind == HOVER_PIN)) {
        pins_begin(stage, core, world, &hover, event);
    } else if (holds && hover.kind == HOVER_FLOOR) {
        floors_begin(stage, core, world, &hover, event);
    } else if (holds && hover.kind == HOVER_BODY) {
        drag_begin(core, DRAG_BODY, "Move body", event);
        hold_begin(stage, core, hover.tail, event->mods & MOD_CTRL);
    } else if (holds && hover.kind == HOVER_JOINT) {
        const bool is_chain = world->document->rigs[hover.rig].kind == RIG_CHAIN;
        drag_begin(core, DRAG_GRAB, is_chain ? "Pull chain" : "Pull tail", event);
        grab_begin(stage, core, world, &hover);
    } else {
        drag_begin(core, DRAG_ORBIT, NULL, event);
    }
}

void stage_wheel(struct stage *stage, struct core *core, const struct event *event)
{
    if (brush_wheel(core, event)) return;
    camera_zoom(&stage->camera, (float)exp(-ZOOM_STEP * fmin(fmax(event->dy, -20), 20)));
}

static const float ORBIT_SPEED = 0.008f; ///< radians a pixel

/// A body that is to be recorded is so from the first movement on.
static void start_recording(struct stage *stage, struct core *core)
{
    if (core->drag.kind != DRAG_BODY || stage->hold.begun) return;
    stage->hold.begun = true;
    if (core->record_armed) record_begin(stage, core);
}

void stage_drag_move(struct stage *stage, struct core *core)
{
    const struct drag *drag = &core->drag;
    start_recording(stage, core);
    stage->pin_drag.stale = stage->floor_drag.stale = true;
    if (drag->kind == DRAG_ORBIT) {
        camera_orbit(&stage->camera, -(float)drag->moved_x * ORBIT_SPEED, (float)drag->moved_y * ORBIT_SPEED);
    }
    if (drag->kind == DRAG_STAGE_PAN) {
        camera_pan(&stage->camera, (float)drag->moved_x, (float)drag->moved_y, core->layout.stage.h);
    }
}

enum drag_answer stage_drag_event(struct stage *stage, struct core *core, const struct editor_world *world,
                                  const struct event *event)
{
    // Ctrl may still be down, which lifts bodies and takes joints.
    bool key = event->kind == EVENT_KEY && event->action == ACTION_PRESS && !(event->mods & MOD_ALT);
    if (core->drag.kind == DRAG_PIN && key) return pins_lock(stage, event->key) ? DRAG_USED : DRAG_PASSES;
    if (core->drag.kind != DRAG_BODY || !key) return DRAG_PASSES;
    if (event->key == 'R') {
        drag_start_moving(core, world);
        start_recording(stage, core);
        record_begin(stage, core);
        return DRAG_USED;
    }
    return hold_lock(stage, event->key) ? DRAG_USED : DRAG_PASSES;
}

void stage_drag_end(struct stage *stage, struct core *core, const struct editor_world *world, bool keep)
{
    if (core->drag.kind == DRAG_BODY && core->drag.moved) hold_release(stage, core, world, keep);
    if (!core->drag.moved && core->drag.button == BUTTON_LEFT && keep) bone_click(stage, core, world);
    if (core->drag.kind == DRAG_PAINT) brush_end(stage, core, world, keep);
}

void stage_advance(struct stage *stage, struct core *core, const struct editor_world *world, double dt)
{
    brush_advance(stage, core, world, dt);
    grab_apply(stage, core, world);
    pins_apply(stage, core, world);
    floors_apply(stage, core, world);
    hold_advance(stage, core, world);
    sway_advance(stage, core, world, dt);
    stage->meadow.dt += dt;
    record_advance(stage, core, world);
}
