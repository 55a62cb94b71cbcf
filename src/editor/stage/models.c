/// Imported characters on the stage, and the posed surface of a soft one for hover.
#include "base/hash.h"
#include "base/need.h"
#include "editor/stage/parts.h"
#include "model/figure.h"
#include "model/vector.h"
#include <math.h>
#include <stdlib.h>

enum { BOUND_STEPS = 60, FEET = 8 };

static const float FOOT_HEIGHT = 0.1f, FOOT_RADIUS = 0.085f; ///< shares of the character's height
static const float ASIDE = 1.1f;                             ///< share of the character's width
static const float FOOT_STRENGTH = 0.55f, BODY_STRENGTH = 0.4f;

/// A shadow under the whole, and one under each joint that vertices follow near the ground.
static void add_shadows(struct stage_view *view, const struct stage_model *shown, const struct skeleton *skeleton)
{
    const mat4s root = mat4_from(shown->root);
    const float height = fmaxf(shown->hi[1] - shown->lo[1], 1e-6f);
    const float width = shown->hi[0] - shown->lo[0], depth = shown->hi[2] - shown->lo[2];
    stage_add_blob(view, 0.5f * (shown->lo[0] + shown->hi[0]), 0.5f * (shown->lo[2] + shown->hi[2]),
                   0.28f * (width + depth), BODY_STRENGTH);
    int feet = 0;
    for (int b = 0; shown->gltf->skin_count > 0 && b < skeleton->own && feet < FEET; b++) {
        const int node = skeleton->bones[b].node;
        const vec3s joint = glms_mat4_mulv3(root, vec3_from(shown->pose->world[node] + 12), 1.0f);
        const float near = 1.0f - (joint.y - shown->ground) / (FOOT_HEIGHT * height);
        if (near <= 0.0f || !skeleton->carries[node]) continue;
        stage_add_blob(view, joint.x, joint.z, FOOT_RADIUS * height, FOOT_STRENGTH * fminf(near, 1.0f));
        feet++;
    }
}

struct stage_model *models_show(struct stage *stage, const struct core *core, int rig, struct rig_pose *posed)
{
    struct stage_view *view = &stage->view;
    struct posing posing = stage_posing_by_hand(stage);
    posing.memory = POSE_SHOWN;
    if (view->model_count == STAGE_MAX_MODELS) return NULL;
    if (!rig_pose_body(&posing, rig, core->playback.position, NULL, posed)) return NULL;
    struct stage_model *shown = &view->models[view->model_count++];
    *shown = (struct stage_model){
        .gltf = &posed->model.imported->gltf, .pose = posed->model.pose, .ground = posed->model.ground};
    memcpy(shown->root, posed->model.root, sizeof shown->root);
    rig_bounds(posed, shown->lo, shown->hi);
    return shown;
}

/// The distance between a character and its clip alone.
static float aside(const struct core *core, int n)
{
    const int rig = document_find_rig(core->document, RIG_MODEL, n);
    const struct imported *imported = models_imported(core->models, core->document, rig);
    if (!core->overlays.original || !imported) return 0.0f;
    const float *lo = imported->gltf.lo, *hi = imported->gltf.hi;
    return ASIDE * (float)core->document->rigs[rig]->model.scale * fmaxf(hi[0] - lo[0], hi[2] - lo[2]);
}

/// Adds the clip without its chains, beside the model that was added last.
static void add_original(struct stage *stage, const struct core *core, int rig, float by)
{
    struct stage_view *view = &stage->view;
    struct rig_pose posed;
    const struct posing posing = {.document = core->document, .models = core->models, .memory = POSE_BESIDE};
    if (view->model_count == STAGE_MAX_MODELS) return;
    if (!rig_pose_body(&posing, rig, core->playback.position, NULL, &posed)) return;
    struct stage_model *shown = &view->models[view->model_count++];
    *shown = shown[-1];
    shown->pose = posed.model.pose;
    shown->root[12] += by;
    shown->lo[0] += by;
    shown->hi[0] += by;
    add_shadows(view, shown, &posed.model.imported->skeleton);
}

static void pose(struct stage *stage, const struct core *core, int rig, int n)
{
    struct rig_pose posed;
    struct stage_model *shown = models_show(stage, core, rig, &posed);
    if (!shown) return;
    bones_add(stage, rig, &posed);
    shown->dusk = fmaxf(0.3f * (shown->hi[1] - shown->lo[1]), 1e-6f);
    add_shadows(&stage->view, shown, &posed.model.imported->skeleton);
    if (core->overlays.original) add_original(stage, core, rig, aside(core, n));
}

static uint64_t hash(uint64_t sum, const struct stage_view *view)
{
    for (int m = 0; m < view->model_count; m++) {
        const struct stage_model *shown = &view->models[m];
        const struct gltf *gltf = shown->gltf;
        sum = hash_word(sum, gltf->id);
        sum = hash_bytes(sum, shown->root, sizeof shown->root);
        sum = hash_bytes(sum, shown->pose->world, (size_t)gltf->node_count * sizeof *shown->pose->world);
        sum = hash_bytes(sum, shown->pose->weights, (size_t)gltf->weight_count * sizeof *shown->pose->weights);
    }
    return sum;
}

const struct stage_kind model_stage = {.pose = pose, .bound_steps = BOUND_STEPS, .aside = aside, .hash = hash};

void skin_free(struct skin *skin)
{
    free(skin->posed);
    *skin = (struct skin){0};
}

void skin_reserve(struct stage *stage)
{
    struct skin *skin = &stage->skin;
    int most = 0;
    for (int c = 0; c < stage->view.character_count; c++) {
        const int count = stage->view.characters[c].figure->character.vertex_count;
        most = count > most ? count : most;
    }
    for (int t = 0; t < stage->tail_count; t++) {
        if (stage->strands[t].model < 0) continue;
        const struct gltf *fox = stage->view.models[stage->strands[t].model].gltf;
        const int count = gltf_vertex_count(fox, fox->node_count - 1);
        most = count > most ? count : most;
    }
    if (most <= skin->capacity) return;
    skin_free(skin);
    skin->posed = need((size_t)most, sizeof *skin->posed);
    skin->capacity = most;
}

bool skin_pose(struct stage *stage, int character)
{
    struct skin *skin = &stage->skin;
    const struct stage_character *shown = stage_character_shown(stage, character);
    if (!shown || shown->figure->character.vertex_count > skin->capacity) return false;
    const uint64_t hash = hash_word(hash_word(stage->view.hash, shown->figure->id), (uint64_t)character);
    if (skin->hash != hash) morph_places(shown->figure, &shown->morph, shown->position, skin->posed);
    skin->hash = hash;
    return true;
}

bool skin_spot(const struct stage *stage, const struct figure *figure, float x, float y, struct surface_spot *spot)
{
    const struct stage_view *view = &stage->view;
    const float viewport[4] = {view->viewport.x, view->viewport.y, view->viewport.w, view->viewport.h};
    float direction[3];
    camera_ray(view->view, view->projection, viewport, (const float[2]){x, y}, direction);
    return pick_ray(figure, (const float(*)[3])stage->skin.posed, view->eye, direction, spot);
}
