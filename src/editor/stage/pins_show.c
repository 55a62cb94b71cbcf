/// How pins look: a marker where a point is to be, a thin line to where it comes, the path that it takes.
#include "base/hash.h"
#include "editor/core/arrange.h"
#include "editor/core/core.h"
#include "editor/core/pins.h"
#include "editor/stage/overlays.h"
#include "editor/stage/pins.h"
#include "editor/stage/points.h"
#include "editor/stage/rigs.h"
#include "editor/stage/stage.h"
#include "ui/font.h"
#include "ui/theme.h"
#include <math.h>
#include <stdio.h>

static const float HERE = 5, ELSEWHERE = 3.5f, RING = 8, LIT = 6.5f, END = 2; ///< radii, pixels
static const float LEAST_LINE = 1.5f;                                         ///< pixels that are left to be seen
static const float FAINT = 0.5f;                                              ///< opacity of markers of other frames
static const float AXIS = 2; ///< metres of a locked axis to each side

/// The document as it is solved now.
static uint64_t state_key(const struct core *core, const struct editor_world *world)
{
    const uint64_t solved = world->evaluation ? world->evaluation->revision : 0;
    const uint64_t edited = world->history ? history_revision(world->history) : 0; // a film has none
    return hash_word(hash_word(hash_word(HASH_START, edited), solved), (uint64_t)core->look);
}

static void add_pin(struct stage *stage, const struct editor_world *world, int rig, int at)
{
    const struct document *document = world->document;
    const struct pin *pin = &document->rigs[rig].pins[at];
    const struct pin_left *left = evaluation_pin(world->evaluation, document, rig, at);
    const int spline = rig_point_spline(&document->rigs[rig]);
    struct shown_pin *shown = &stage->pins[stage->pin_count++];
    *shown = (struct shown_pin){.id = pin->id, .point = {rig, pin->point}, .frame = pin->frame};
    shown->color = spline >= 0 ? arrange_color(document, spline) : theme()->text_dim;
    shown->is_known = left && left->is_found;
    for (int k = 0; k < 3; k++) shown->to[k] = (float)pin->to[k];
    for (int k = 0; k < 3 && shown->is_known; k++) shown->place[k] = (float)left->at[k];
}

/// Finds all markers for the document as it is solved now.
static void update(struct stage *stage, const struct core *core, const struct editor_world *world)
{
    const struct document *document = world->document;
    const uint64_t key = hash_word(state_key(core, world), (uint64_t)theme_in_use() << 32 | document->serial);
    if (stage->pins_key == key) return;
    stage->pins_key = key;
    stage->pin_count = 0;
    for (int r = 0; r < document->rig_count; r++) {
        if (document->rigs[r].kind == RIG_CHARACTER && core->characters.compare) continue; // they stand aside
        for (int i = 0; i < document->rigs[r].pin_count; i++) add_pin(stage, world, r, i);
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

void pins_show_axis(void *room, struct core *core, const struct editor_world *world)
{
    const struct stage *stage = room;
    const struct pin_drag *drag = &stage->pin_drag;
    float ends[2][3], line[2][2];
    (void)world;
    if (drag->axis < 0) return;
    for (int e = 0; e < 2; e++) {
        for (int k = 0; k < 3; k++) ends[e][k] = (float)drag->start[k];
        ends[e][drag->axis] += e ? AXIS : -AXIS;
        if (!stage_project_point(stage, core->layout.stage, ends[e], line[e])) return;
    }
    drawlist_dashed(&core->list, line[0], 2, 1, 6, 4, theme_fade(theme()->playhead, 0.7f));
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

void pins_show(struct stage *stage, struct core *core, const struct editor_world *world)
{
    const struct document *document = world->document;
    int rig;
    update(stage, core, world);
    const struct pin *selected = pins_selected(core, document, &rig);
    if (selected && point_exists(world, (struct rig_point){rig, selected->point}))
        path_show(stage, core, world, TRAIL_OF_PIN, (struct rig_point){rig, selected->point});
    const int now = document_sample(document, core_frame(core, document));
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
