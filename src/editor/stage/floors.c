/// Characters' floors on the stage: hover, vertical drags and drawing.
#include "editor/core/core.h"
#include "editor/core/drag.h"
#include "editor/stage/parts.h"
#include "editor/stage/stage.h"
#include "maths/maths.h"
#include "model/vector.h"
#include "ui/font.h"
#include "ui/theme.h"
#include <math.h>
#include <stdio.h>

static const float AROUND = 0.42f;    ///< from the middle to the edge, as a share of the character's width or depth
static const float EDGE_REACH = 5;    ///< pixels
static const double LEAST_RISE = 0.3; ///< cosine of the camera's elevation; below it height follows the pointer less

/// A shown character's floor and its place on the screen, or NULL.
static const struct character_rig *floors_find(const struct stage *stage, const struct core *core,
                                               const struct stage_character *shown, struct shown_floor *floor)
{
    const struct character_rig *rig = document_character(core->document, shown->rig);
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

struct hover floors_hover(const struct stage *stage, const struct core *core, float x, float y)
{
    struct hover hover = {.thing = NULL};
    float best = EDGE_REACH;
    if (core->brush.on || core->pick.use != BONE_SELECTED) return hover;
    for (int c = 0; c < stage->view.character_count; c++) {
        const struct stage_character *shown = &stage->view.characters[c];
        struct shown_floor floor = {0};
        if (!floors_find(stage, core, shown, &floor)) continue;
        for (int side = 1; side < 4; side += 2) { // edges behind the character would block its surface
            const float *a = floor.xy[floor.first], *b = floor.xy[(floor.first + side) % 4];
            const float along = segment_nearest(a, b, (const float[2]){x, y});
            const float distance = maths_hypotf(a[0] + along * (b[0] - a[0]) - x, a[1] + along * (b[1] - a[1]) - y);
            if (distance >= best) continue;
            best = distance;
            hover = (struct hover){.thing = &thing_floor, .x = x, .y = y};
            hover.rig = document_find_rig(core->document, RIG_CHARACTER, shown->rig);
        }
    }
    return hover;
}

/// Moves the floor to the pointer.
static void apply(void *room, struct core *core)
{
    const struct floor_drag *drag = &((const struct stage *)room)->floor_drag;
    const struct document *document = core->document;
    if (drag->rig >= document->rig_count || !rig_has_floor(document->rigs[drag->rig])) return; // an edit removed it
    struct rig changed = *document->rigs[drag->rig];
    const double height = drag->start - core->drag.moved_y / drag->pixels_per_metre;
    const double rounded = core_round(height, 0.5 / drag->pixels_per_metre);
    changed.character.floor = fmin(rounded, changed.character.position[1]);
    edit_rig_set(core->document, drag->rig, &changed, &core->error);
}

static void press_floor(void *room, struct core *core, const struct hover *hover, const struct event *event)
{
    struct stage *stage = room;
    static const struct drag_owner owner = {.cursor = CURSOR_VERTICAL, .apply = apply, .end = stage_click};
    const struct character_rig *rig = &core->document->rigs[hover->rig]->character;
    const float at[3] = {(float)rig->position[0], (float)rig->floor, (float)rig->position[2]};
    const double rise = fmax(maths_cos((double)stage->camera.elevation), LEAST_RISE);
    core->hover = *hover;
    drag_begin(core, &owner, stage, "Set floor", event);
    stage->floor_drag = (struct floor_drag){
        .rig = hover->rig, .start = rig->floor, .pixels_per_metre = rise * stage_pixels_per_metre(stage, core, at)};
}

/// The middle of a near edge.
static bool find_floor(void *room, const struct core *core, const struct target *target, float xy[2])
{
    const struct stage_character *shown = stage_character_shown(room, target->nth);
    struct shown_floor floor = {0};
    if (!shown || !floors_find(room, core, shown, &floor)) return false;
    for (int k = 0; k < 2; k++) xy[k] = 0.5f * (floor.xy[floor.first][k] + floor.xy[(floor.first + 1) % 4][k]);
    return true;
}

const struct thing thing_floor = {.cursor = CURSOR_VERTICAL,
                                  .hint =
                                      "Drag the floor up or down (Shift: fine); the whole character stays above it",
                                  .press = press_floor,
                                  .name = "floor",
                                  .of = OF_RIG,
                                  .rig = RIG_CHARACTER,
                                  .find = find_floor,
                                  .missing = "no floor of that character is to be seen"};

static const float TOUCH = 2e-3f;     ///< of the character's height; closer counts as touching
static const float MARK = 4, END = 2; ///< radii, pixels
static const float FAR_SIDE = 0.35f,
                   FAR_PART = 0.4f; ///< edges behind the character: opacity, and visible share

static void show_floor(const struct stage *stage, struct core *core, const struct stage_character *shown,
                       const struct shown_floor *floor, double height, bool is_hot)
{
    float lowest = INFINITY, low[3];
    int found = 0;
    for (int v = 0; v < shown->figure->character.vertex_count; v++) {
        float at[3];
        morph_vertex(shown->figure, &shown->morph, v, at, NULL);
        if (at[1] < lowest) lowest = at[1], found = v;
    }
    stage_vertex(shown->figure, &shown->morph, shown->position, found, low);
    const float near_enough = TOUCH * (shown->figure->hi[1] - shown->figure->lo[1]);
    const float below = (float)height - low[1];
    const bool is_missed = below > near_enough, is_touched = below > -near_enough;
    const uint32_t color = is_missed    ? theme()->warning
                           : is_hot     ? theme()->playhead
                           : is_touched ? theme()->accent
                                        : theme()->text_dim;

    // The edges at the nearest corner and the start of the others, so that no line crosses the character.
    for (int side = 1; side < 4; side += 2) {
        const float *corner = floor->xy[(floor->first + side) % 4], *far = floor->xy[(floor->first + 2) % 4];
        const float *near = floor->xy[floor->first];
        const float line[3][2] = {
            {near[0], near[1]},
            {corner[0], corner[1]},
            {corner[0] + FAR_PART * (far[0] - corner[0]), corner[1] + FAR_PART * (far[1] - corner[1])}};
        drawlist_line(&core->list, line[0], 2, is_hot ? 2.25f : 1.5f, color);
        drawlist_line(&core->list, line[1], 2, is_hot ? 2.25f : 1.5f, theme_fade(color, FAR_SIDE));
    }

    // The point on the floor at the lowest vertex, with a line if the vertex is below.
    const float on[3] = {low[0], (float)height, low[2]};
    const struct rect r = core->layout.stage;
    float line[2][2];
    if (is_touched && stage_project_point(stage, r, on, line[0]) && stage_project_point(stage, r, low, line[1])) {
        if (low[1] < (float)height) drawlist_line(&core->list, line[0], 2, 1.25f, color);
        drawlist_disc(&core->list, line[0], MARK, color);
        drawlist_disc(&core->list, line[1], END, color);
    }

    // The height, at the rightmost corner.
    char text[80];
    int right = 0;
    for (int i = 1; i < 4; i++) {
        if (floor->xy[i][0] > floor->xy[right][0]) right = i;
    }
    const int length = snprintf(text, sizeof text, "floor %.3g m", height + 0.0);
    if (is_missed) snprintf(text + length, sizeof text - (size_t)length, ", %.2g m below", (double)below);
    const float width = font_width(FONT_LABEL, THEME_TEXT_SMALL, text);
    const float x = fmaxf(fminf(floor->xy[right][0] + 8, r.x + r.w - width - 8), r.x + 8);
    stage_note(core, x, floor->xy[right][1] + 4, FONT_LABEL, is_missed ? color : theme()->text_dim, text);
}

void floors_show(const struct stage *stage, struct core *core)
{
    const struct document *document = core->document;
    for (int c = 0; c < stage->view.character_count; c++) {
        const struct stage_character *shown = &stage->view.characters[c];
        struct shown_floor floor = {0};
        const struct character_rig *rig = floors_find(stage, core, shown, &floor);
        if (!rig) continue;
        const int index = document_find_rig(document, RIG_CHARACTER, shown->rig);
        const bool is_hot = core->hover.thing == &thing_floor && core->hover.rig == index;
        show_floor(stage, core, shown, &floor, rig->floor, is_hot);
    }
}
