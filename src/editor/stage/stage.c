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

void stage_click(void *room, struct core *core, const struct editor_world *world, bool keep)
{
    if (!core->drag.moved && core->drag.button == BUTTON_LEFT && keep) bone_click(room, core, world);
}

static const float ORBIT_SPEED = 0.008f; ///< radians a pixel

static void orbit(void *room, struct core *core, const struct editor_world *world)
{
    struct stage *stage = room;
    (void)world;
    camera_orbit(&stage->camera, -(float)core->drag.moved_x * ORBIT_SPEED, (float)core->drag.moved_y * ORBIT_SPEED);
}

static void pan(void *room, struct core *core, const struct editor_world *world)
{
    struct stage *stage = room;
    (void)world;
    camera_pan(&stage->camera, (float)core->drag.moved_x, (float)core->drag.moved_y, core->layout.stage.h);
}

static const struct drag_owner panning = {.cursor = CURSOR_MOVE, .move = pan, .end = stage_click};
static const struct drag_owner orbiting = {.cursor = CURSOR_ARROW, .move = orbit, .end = stage_click};

void stage_press(struct stage *stage, struct core *core, const struct editor_world *world, const struct event *event)
{
    const bool pans = event->button == BUTTON_MIDDLE || (event->button == BUTTON_LEFT && core->space_down);
    if (pans) {
        core->space_used = core->space_down;
        drag_begin(core, &panning, stage, NULL, event);
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
        hold_begin(stage, core, hover.tail, event);
    } else if (holds && hover.kind == HOVER_JOINT) {
        grab_begin(stage, core, world, &hover, event);
    } else {
        drag_begin(core, &orbiting, stage, NULL, event);
    }
}

void stage_wheel(struct stage *stage, struct core *core, const struct event *event)
{
    if (brush_wheel(core, event)) return;
    camera_zoom(&stage->camera, (float)exp(-ZOOM_STEP * fmin(fmax(event->dy, -20), 20)));
}

void stage_advance(struct stage *stage, struct core *core, const struct editor_world *world, double dt)
{
    hold_advance(stage, core, world);
    sway_advance(stage, core, world, dt);
    stage->meadow.dt += dt;
    record_advance(stage, core, world);
}
