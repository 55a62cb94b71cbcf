/// What a drag that the stage began does, and what time does to it.
#include "editor/core/drag.h"
#include "editor/stage/body.h"
#include "editor/stage/brush.h"
#include "editor/stage/follow.h"
#include "editor/stage/grab.h"
#include "editor/stage/record.h"
#include "editor/stage/stage.h"
#include "editor/stage/state.h"

static const float ORBIT_SPEED = 0.008f; ///< radians a pixel

/// A body that is to be recorded is so from the first movement on.
static void start_recording(struct stage *stage, struct core *core)
{
    if (core->drag.kind != DRAG_BODY || stage->body_drag.begun) return;
    stage->body_drag.begun = true;
    if (core->record_armed) record_begin(stage, core);
}

void stage_drag_move(struct stage *stage, struct core *core)
{
    const struct drag *drag = &core->drag;
    start_recording(stage, core);
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
    bool key = event->kind == EVENT_KEY && event->action == ACTION_PRESS && !(event->mods & (MOD_CTRL | MOD_ALT));
    if (core->drag.kind != DRAG_BODY || !key) return DRAG_PASSES;
    if (event->key == 'R') {
        drag_start_moving(core, world);
        start_recording(stage, core);
        record_begin(stage, core);
        return DRAG_USED;
    }
    return drag_lock(&core->drag, event->key) ? DRAG_USED : DRAG_PASSES;
}

void stage_drag_end(struct stage *stage, struct core *core, const struct editor_world *world, bool keep)
{
    if (core->drag.kind == DRAG_BODY && core->drag.moved) body_release(stage, core, world, keep);
    if (core->drag.kind == DRAG_PAINT) brush_end(stage, core, world, keep);
}

void stage_advance(struct stage *stage, struct core *core, const struct editor_world *world, double dt)
{
    brush_advance(stage, core, world, dt);
    grab_apply(stage, core, world);
    follow_advance(stage, core, world, dt);
    record_advance(stage, core, world);
}
