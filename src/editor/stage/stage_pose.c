/// Poses the rigs, drives the camera, and draws over the picture.
#include "base/hash.h"
#include "editor/core/drag.h"
#include "editor/stage/bones.h"
#include "editor/stage/brush.h"
#include "editor/stage/floors.h"
#include "editor/stage/hold.h"
#include "editor/stage/overlays.h"
#include "editor/stage/pins.h"
#include "editor/stage/rigs.h"
#include "editor/stage/skin.h"
#include "editor/stage/stage.h"
#include "ui/font.h"
#include "ui/theme.h"
#include <math.h>

struct posing stage_posing(const struct core *core, const struct editor_world *world)
{
    return (struct posing){
        .document = world->document, .evaluation = world->evaluation, .models = world->models, .look = core->look};
}

bool stage_project_point(const struct stage *stage, struct rect r, const float point[3], float xy[2])
{
    const float viewport[4] = {r.x, r.y, r.w, r.h};
    return camera_project(stage->view.view, stage->view.projection, viewport, point, xy);
}

enum { RING_SIZE = 13 };

/// Radians. Characters look towards +z; one is met from a bit aside, a pair from the front.
static const float AZIMUTH_OF_ONE = -1.13f, AZIMUTH_OF_PAIR = -1.5708f;

/// In this order they are posed, hashed and drawn.
static const struct stage_kind *const kinds[RIG_KINDS] = {
    [RIG_TAIL] = &stage_tails,   [RIG_CHARACTER] = &stage_characters, [RIG_MODEL] = &stage_models,
    [RIG_CHAIN] = &stage_chains, [RIG_MEADOW] = &stage_meadows,
};

/// Adds all motion of a kind to the box lo … hi; false where nothing of it is to be seen.
static bool add_bounds(const struct stage *stage, const struct core *core, const struct editor_world *world,
                       enum rig_kind kind, float lo[3], float hi[3])
{
    const struct document *document = world->document;
    bool any = false;
    int rig = document_next_rig(document, kind, 0);
    for (int n = 0; rig >= 0; n++, rig = document_next_rig(document, kind, rig + 1)) {
        any |= kinds[kind]->bounds(stage, core, world, rig, n, lo, hi);
    }
    return any;
}

/// Keeps where its motion is in the picture, from the middle of the stage in heights of it, as the camera stands now.
static void note_figure(struct stage *stage, struct rect place, const float lo[3], const float hi[3])
{
    const struct rect unit = {-0.5f * place.w / place.h, -0.5f, place.w / place.h, 1};
    struct stage_view *view = &stage->view;
    float least[2] = {INFINITY, INFINITY}, most[2] = {-INFINITY, -INFINITY};
    camera_matrices(&stage->camera, unit.w, view->view, view->projection, view->eye);
    for (int corner = 0; corner < 8; corner++) {
        const float point[3] = {(corner & 1 ? hi : lo)[0], (corner & 2 ? hi : lo)[1], (corner & 4 ? hi : lo)[2]};
        float xy[2];
        if (!stage_project_point(stage, unit, point, xy)) continue;
        for (int k = 0; k < 2; k++) {
            least[k] = fminf(least[k], xy[k]);
            most[k] = fmaxf(most[k], xy[k]);
        }
    }
    stage->figure = (struct rect){least[0], least[1], most[0] - least[0], most[1] - least[1]};
}

struct rect stage_figure(const struct stage *stage, const struct core *core)
{
    const struct rect *place = &core->layout.stage, *figure = &stage->figure;
    return (struct rect){place->x + place->w / 2 + figure->x * place->h, place->y + (figure->y + 0.5f) * place->h,
                         figure->w * place->h, figure->h * place->h};
}

void stage_fit(struct stage *stage, const struct core *core, const struct editor_world *world)
{
    float lo[3] = {INFINITY, INFINITY, INFINITY}, hi[3] = {-INFINITY, -INFINITY, -INFINITY};
    bool seen[RIG_KINDS], any = false;
    for (int kind = 0; kind < RIG_KINDS; kind++) {
        seen[kind] = add_bounds(stage, core, world, (enum rig_kind)kind, lo, hi);
        any |= seen[kind];
    }
    stage->camera = camera_default();
    if ((seen[RIG_CHARACTER] || seen[RIG_MODEL]) && !seen[RIG_TAIL])
        stage->camera.azimuth = core->characters.compare ? AZIMUTH_OF_PAIR : AZIMUTH_OF_ONE;
    camera_lamp(&stage->camera, stage->view.key_from); // it stays there while the camera goes round
    stage->figure = (struct rect){0};
    if (!any) return;
    for (int k = 0; k < 2; k++) stage->view.middle[k] = 0.5f * (lo[2 * k] + hi[2 * k]);
    const struct rect place = core->layout.stage;
    const float caption = core->plain ? 0 : caption_height(place, world->document);
    camera_fit(&stage->camera, lo, hi, place.w / place.h, caption / place.h);
    note_figure(stage, place, lo, hi);
}

static uint64_t view_hash(const struct stage_view *view)
{
    uint64_t hash = stage_scenery_hash(view);
    for (int kind = 0; kind < RIG_KINDS; kind++) hash = kinds[kind]->hash(hash, view);
    return hash_bytes(hash, view->blobs, (size_t)view->blob_count * sizeof view->blobs[0]);
}

void stage_orbit(struct stage *stage, float across, float up) { camera_orbit(&stage->camera, across, up); }

void stage_approach(struct stage *stage, float factor) { camera_zoom(&stage->camera, factor); }

void stage_pose(struct stage *stage, struct core *core, const struct editor_world *world, bool covered)
{
    if (core->refit_stage) stage_fit(stage, core, world);
    core->refit_stage = false;
    struct stage_view *view = &stage->view;
    const struct document *document = world->document;
    view->tail_count = view->character_count = view->model_count = view->blob_count = 0;
    view->meadow.count = 0;
    stage->strand_count = stage->bone_count = 0;
    for (int kind = 0; kind < RIG_KINDS; kind++) {
        int rig = document_next_rig(document, (enum rig_kind)kind, 0);
        for (int n = 0; rig >= 0; n++, rig = document_next_rig(document, (enum rig_kind)kind, rig + 1)) {
            kinds[kind]->pose(stage, core, world, rig, n);
        }
    }
    view->viewport = core->layout.stage;
    view->colors = theme()->stage;
    camera_matrices(&stage->camera, view->viewport.w / view->viewport.h, view->view, view->projection, view->eye);
    view->hash = view_hash(view);
    skin_reserve(stage);
    brush_pose(stage, core, world, covered);
}

void stage_ring(struct core *core, const float xy[2])
{
    struct rect ring = {xy[0] - RING_SIZE / 2.0f, xy[1] - RING_SIZE / 2.0f, RING_SIZE, RING_SIZE};
    drawlist_rounded_line(&core->list, ring, RING_SIZE / 2.0f, 1.5f, theme()->playhead);
}

/// What an empty stage says, or NULL.
static const char *empty_text(const struct stage *stage, const struct core *core, const struct editor_world *world)
{
    const struct stage_view *view = &stage->view;
    if (view->tail_count > 0 || view->character_count > 0 || view->model_count > 0 || view->meadow.count > 0)
        return NULL;
    if (document_character(world->document, 0) || document_find_rig(world->document, RIG_MODEL, 0) >= 0)
        return "wiggly could not read this scene's character. Its curves are below.";
    return core->active < 0 ? "This scene is empty." : "This scene has no tail. Its curves are below.";
}

void stage_show(struct stage *stage, struct core *core, const struct editor_world *world)
{
    const struct stage_view *view = &stage->view;
    struct rect clip = drawlist_push_clip(&core->list, view->viewport);
    const char *text = empty_text(stage, core, world);
    if (text) {
        float room = view->viewport.w - 16, width = font_width(FONT_LABEL, THEME_TEXT_NORMAL, text);
        float x = view->viewport.x + 8 + fmaxf(room - width, 0) / 2;
        drawlist_text_fit(&core->list, x, view->viewport.y + view->viewport.h / 2, room, FONT_LABEL,
                          THEME_TEXT_NORMAL, theme()->text_dim, text);
    }
    onion_show(stage, core, world);
    ghost_show(stage, core, world);
    trail_show(stage, core, world);
    floors_show(stage, core, world);
    characters_show(stage, core, world);
    names_show(stage, core, world->document);
    brush_show(stage, core, world);
    hold_show(stage, core);
    record_show(stage, core, world);
    bones_show(stage, core, world);
    if (!core->drag.owner && core->hover.kind == HOVER_JOINT)
        stage_ring(core, (float[2]){core->hover.x, core->hover.y});
    drag_show(stage, core, world);
    pins_show(stage, core, world);
    drawlist_set_clip(&core->list, clip);
}
