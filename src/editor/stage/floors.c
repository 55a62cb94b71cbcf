/// Floors of characters by mouse: where their edges are, and drags up and down.
#include "editor/stage/floors.h"
#include "editor/core/core.h"
#include "editor/core/drag.h"
#include "editor/stage/rigs.h"
#include "editor/stage/segment.h"
#include "model/vector.h"
#include <math.h>

static const float AROUND = 0.42f; ///< of the character's breadth or depth: how far the edge is from its middle
static const float EDGE_REACH = 5; ///< pixels
static const double LEAST_RISE =
    0.3; ///< cosine of the camera's elevation below which height follows the pointer less

bool floors_exist(const struct document *document, int rig)
{
    return rig >= 0 && rig < document->rig_count && rig_has_floor(&document->rigs[rig]);
}

const struct character_rig *floors_find(const struct stage *stage, const struct core *core,
                                        const struct document *document, const struct stage_character *shown,
                                        struct shown_floor *floor)
{
    const struct character_rig *rig = document_character(document, shown->rig);
    if (!rig || !rig->has_floor || shown->is_twin) return NULL;
    static const float sides[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    const float *lo = shown->figure->lo, *hi = shown->figure->hi;
    float nearest = INFINITY;
    for (int i = 0; i < 4; i++) {
        float at[3] = {0, (float)rig->floor, 0};
        for (int k = 0; k < 3; k += 2) {
            const float reach = AROUND * fmaxf(hi[0] - lo[0], hi[2] - lo[2]);
            at[k] = shown->position[k] + 0.5f * (lo[k] + hi[k]) + sides[i][k / 2] * reach;
        }
        if (!stage_project_point(stage, core->layout.stage, at, floor->xy[i])) return NULL;
        const float depth = glms_vec3_distance(vec3_from(stage->view.eye), vec3_from(at));
        if (depth < nearest) nearest = depth, floor->first = i;
    }
    return rig;
}

/// How far a point of the screen is from a line between two others.
static float distance_to(const float a[2], const float b[2], float x, float y)
{
    const float along = segment_nearest(a, b, (const float[2]){x, y});
    return hypotf(a[0] + along * (b[0] - a[0]) - x, a[1] + along * (b[1] - a[1]) - y);
}

struct hover floors_hover(const struct stage *stage, const struct core *core, const struct document *document,
                          float x, float y)
{
    struct hover hover = {.kind = HOVER_NONE};
    float best = EDGE_REACH;
    if (core->brush.on || core->pick.use != BONE_SELECTED) return hover;
    for (int c = 0; c < stage->view.character_count; c++) {
        const struct stage_character *shown = &stage->view.characters[c];
        struct shown_floor floor = {0};
        if (!floors_find(stage, core, document, shown, &floor)) continue;
        for (int side = 1; side < 4; side += 2) { // those behind the character are not in the way of its surface
            const float distance = distance_to(floor.xy[floor.first], floor.xy[(floor.first + side) % 4], x, y);
            if (distance >= best) continue;
            best = distance;
            hover = (struct hover){.kind = HOVER_FLOOR, .x = x, .y = y};
            hover.rig = document_find_rig(document, RIG_CHARACTER, shown->rig);
        }
    }
    return hover;
}

/// The floor goes where the pointer is now.
static void apply(void *room, struct core *core, const struct editor_world *world)
{
    const struct floor_drag *drag = &((const struct stage *)room)->floor_drag;
    if (!floors_exist(world->document, drag->rig)) return;
    const double highest = world->document->rigs[drag->rig].character.position[1];
    const double height = drag->start - core->drag.moved_y / drag->pixels_per_metre;
    struct edit edit = core_edit_of(EDIT_FLOOR, -1);
    edit.rig = drag->rig;
    edit.flag = true;
    edit.number = fmin(core_round(height, 0.5 / drag->pixels_per_metre), highest);
    core_edit(core, world, &edit);
}

void floors_begin(struct stage *stage, struct core *core, const struct editor_world *world, const struct hover *hover,
                  const struct event *event)
{
    static const struct drag_owner owner = {.cursor = CURSOR_VERTICAL, .apply = apply, .end = stage_click};
    const struct character_rig *rig = &world->document->rigs[hover->rig].character;
    const float at[3] = {(float)rig->position[0], (float)rig->floor, (float)rig->position[2]};
    const float depth = fmaxf(camera_depth(stage->view.view, stage->view.eye, at), 0.1f);
    const double rise = fmax(cos((double)stage->camera.elevation), LEAST_RISE);
    core->hover = *hover;
    drag_begin(core, &owner, stage, "Set floor", event);
    stage->floor_drag = (struct floor_drag){
        .rig = hover->rig,
        .start = rig->floor,
        .pixels_per_metre = 0.5 * rise * (double)(core->layout.stage.h * stage->view.projection[5] / depth)};
}
