/// Characters on the stage: posing, the posed surface of a soft one for hover, and their bones: hover, drawing, and what the camera frames.
#include "base/hash.h"
#include "base/names.h"
#include "editor/core/core.h"
#include "editor/stage/stage.h"
#include "editor/stage/state.h"
#include "maths/maths.h"
#include "model/figure.h"
#include "model/vector.h"
#include "ui/font.h"
#include "ui/theme.h"
#include <math.h>
#include <string.h>

enum { FEET = 8 };

static const float FOOT_HEIGHT = 0.1f, FOOT_RADIUS = 0.085f; ///< shares of the character's height
static const float ASIDE = 1.1f;                             ///< share of the character's width
static const float FOOT_STRENGTH = 0.55f, BODY_STRENGTH = 0.4f;

/// A shadow under the whole, and one under each joint that vertices follow near the ground, or sole of a soft one without joints.
static void add_shadows(struct stage_view *view, const struct stage_model *shown, const struct skeleton *skeleton)
{
    const mat4s root = mat4_from(shown->posed.root);
    const struct figure *figure = shown->posed.gltf->skin_count == 0 ? shown->posed.figure : NULL;
    if (figure) {
        const float scale = glms_vec3_norm(vec3_from(shown->posed.root));
        const float width = figure->hi[0] - figure->lo[0], depth = figure->hi[2] - figure->lo[2];
        const vec3s middle = {{0.5f * (figure->lo[0] + figure->hi[0]), 0, 0.5f * (figure->lo[2] + figure->hi[2])}};
        const vec3s under = glms_mat4_mulv3(root, middle, 1.0f);
        stage_add_blob(view, under.x, under.z, 0.32f * scale * (width + depth), 0.5f);
        for (int s = 0; s < FIGURE_SOLES; s++) {
            const struct sole *sole = &figure->soles[s];
            const vec3s at = glms_mat4_mulv3(root, (vec3s){{sole->x, 0, sole->z}}, 1.0f);
            if (sole->radius > 0.0f) stage_add_blob(view, at.x, at.z, 1.35f * scale * sole->radius, 0.7f);
        }
        return;
    }
    const float height = fmaxf(shown->hi[1] - shown->lo[1], 1e-6f);
    const float width = shown->hi[0] - shown->lo[0], depth = shown->hi[2] - shown->lo[2];
    stage_add_blob(view, 0.5f * (shown->lo[0] + shown->hi[0]), 0.5f * (shown->lo[2] + shown->hi[2]),
                   0.28f * (width + depth), BODY_STRENGTH);
    int feet = 0;
    for (int b = 0; shown->posed.gltf->skin_count > 0 && b < skeleton->own && feet < FEET; b++) {
        const int node = skeleton->bones[b].node;
        const vec3s joint = glms_mat4_mulv3(root, vec3_from(shown->posed.pose->world[node] + 12), 1.0f);
        const float near = 1.0f - (joint.y - shown->posed.ground) / (FOOT_HEIGHT * height);
        if (near <= 0.0f || !skeleton->carries[node]) continue;
        stage_add_blob(view, joint.x, joint.z, FOOT_RADIUS * height, FOOT_STRENGTH * fminf(near, 1.0f));
        feet++;
    }
}

struct stage_model *models_show(struct stage_view *view, const struct rig_pose *posed)
{
    if (view->model_count == STAGE_MAX_MODELS) return NULL;
    struct stage_model *shown = &view->models[view->model_count++];
    *shown = (struct stage_model){.posed = posed->model, .rig = -1, .map_coordinate = -1};
    rig_bounds(posed, shown->lo, shown->hi);
    return shown;
}

float models_aside(const struct core *core, int rig)
{
    const bool is_model = core->document->rigs[rig]->kind == RIG_MODEL;
    const struct imported *imported = is_model ? models_imported(core->models, core->document, rig) : NULL;
    if (!core->view.on[SWITCH_ORIGINAL] || !imported) return 0.0f;
    const float *lo = imported->gltf.lo, *hi = imported->gltf.hi;
    return ASIDE * (float)core->document->rigs[rig]->model.scale * fmaxf(hi[0] - lo[0], hi[2] - lo[2]);
}

void stage_pose_model(struct stage *stage, const struct core *core, int rig)
{
    struct stage_view *view = &stage->view;
    struct posing posing = stage_posing_by_hand(stage);
    struct rig_pose posed;
    posing.memory = POSE_SHOWN;
    if (!rig_pose_body(&posing, rig, core->view.playback.position, &posed)) return;
    struct stage_model *shown = models_show(view, &posed);
    if (!shown) return;
    const struct figure *figure = posed.model.figure;
    const struct model_rig *model = &core->document->rigs[rig]->model;
    const struct character_view *how = &core->focus.characters;
    const int drive = how->drive < model->drive_count ? how->drive : 0;
    const bool is_painted = core->focus.brush.on && rig == characters_rig(core);
    shown->rig = rig;
    shown->map_axis = how->axis;
    if (figure && (core->view.on[SWITCH_PHASE_MAP] || is_painted) && model->drive_count > 0)
        shown->map_coordinate = figure_find(figure, model->drives[drive].name);
    const struct skeleton *skeleton = &posed.imported->skeleton;
    const mat4s to_world = mat4_from(posed.model.root);
    for (int b = 0; b < skeleton->count && stage->bone_count < STAGE_MAX_BONES; b++) {
        const struct bone *bone = &skeleton->bones[b];
        struct shown_bone *added = &stage->bones[stage->bone_count++];
        float ends[2][3];
        *added =
            (struct shown_bone){.model = rig, .part = *bone, .carries = skeleton->carries[bone->node], .chain = -1};
        skeleton_ends(bone, posed.model.pose, ends);
        for (int e = 0; e < 2; e++) {
            const vec3s at = glms_mat4_mulv3(to_world, vec3_from(ends[e]), 1.0f);
            memcpy(added->ends[e], at.raw, sizeof at.raw);
        }
    }
    const float height = figure ? (float)model->scale * (figure->hi[1] - figure->lo[1]) : shown->hi[1] - shown->lo[1];
    shown->dusk = fmaxf(0.3f * height, 1e-6f);
    add_shadows(view, shown, skeleton);

    // The clip without its chains, beside it.
    posing = (struct posing){.document = core->document, .models = core->models, .memory = POSE_BESIDE};
    if (!core->view.on[SWITCH_ORIGINAL] || view->model_count == STAGE_MAX_MODELS) return;
    if (!rig_pose_body(&posing, rig, core->view.playback.position, &posed)) return;
    const float by = models_aside(core, rig);
    shown = &view->models[view->model_count++];
    *shown = shown[-1];
    shown->rig = -1;
    shown->posed.pose = posed.model.pose;
    shown->posed.morph = posed.model.morph;
    shown->posed.root[12] += by;
    shown->lo[0] += by;
    shown->hi[0] += by;
    add_shadows(view, shown, &posed.imported->skeleton);
}

const struct stage_model *stage_soft_shown(const struct stage *stage, int rig)
{
    for (int m = 0; m < stage->view.model_count; m++) {
        const struct stage_model *shown = &stage->view.models[m];
        if (shown->rig == rig && rig >= 0) return shown->posed.figure ? shown : NULL;
    }
    return NULL;
}

bool skin_pose(struct stage *stage, int rig)
{
    struct skin *skin = &stage->skin;
    const struct stage_model *shown = stage_soft_shown(stage, rig);
    if (!shown || shown->posed.figure->character.vertex_count > skin->capacity) return false;
    const uint64_t hash = hash_word(hash_word(stage->view.hash, shown->posed.figure->id), (uint64_t)rig);
    if (skin->hash != hash) figure_vertices(&shown->posed, skin->posed, NULL, NULL, NULL);
    skin->hash = hash;
    return true;
}

bool skin_spot(const struct stage *stage, const struct figure *figure, float x, float y, struct surface_spot *spot)
{
    float direction[3];
    stage_ray(stage, x, y, direction);
    return pick_ray(figure, (const float(*)[3])stage->skin.posed, stage->view.eye, direction, spot);
}

// Bones.

static const float REACH = 12;      ///< pixels from a bone
static const float OVERLAP = 4;     ///< pixels; of bones this close, the nearest to the eye wins
static const float AS_DEEP = 0.02f; ///< share of the depth; closer bones count as equally deep
static const float AS_FAR = 0.5f;   ///< pixels; closer bones count as equally near

/// A bone near the pointer.
struct candidate {
    int bone;
    float xy[2], fraction, distance, depth;
};

/// Control, pole and leaf bones show while Alt is held.
static bool is_hidden(const struct core *core, const struct shown_bone *bone)
{
    return bone->part.hidden && !(core->input.mods & MOD_ALT);
}

static bool project_bone(const struct stage *stage, const struct shown_bone *bone, float ends[2][2])
{
    return stage_project_point(stage, bone->ends[0], ends[0]) && stage_project_point(stage, bone->ends[1], ends[1]);
}

/// False if the bone is gone, hidden or out of reach. A bone without vertices counts as farther.
static bool measure_bone(const struct stage *stage, const struct core *core, int bone, const float p[2],
                         struct candidate *found)
{
    const struct shown_bone *shown = &stage->bones[bone];
    const struct document *document = core->document;
    float ends[2][2];
    if (shown->model >= document->rig_count || document->rigs[shown->model]->kind != RIG_MODEL ||
        (shown->chain >= 0 && !tail_drag_holds(document, shown->chain, shown->joint)))
        return false; // an edit in the same frame removed it
    if (is_hidden(core, shown) || !project_bone(stage, shown, ends)) return false;
    found->bone = bone;
    found->fraction = segment_nearest(ends[0], ends[1], p);
    for (int k = 0; k < 2; k++) found->xy[k] = ends[0][k] + (ends[1][k] - ends[0][k]) * found->fraction;
    found->distance = maths_hypotf(p[0] - found->xy[0], p[1] - found->xy[1]) + (shown->carries ? 0 : OVERLAP);
    const vec3s at = glms_vec3_lerp(vec3_from(shown->ends[0]), vec3_from(shown->ends[1]), found->fraction);
    found->depth = camera_depth(stage->view.view, stage->view.eye, at.raw);
    return found->distance < REACH;
}

struct hover bone_hover(const struct stage *stage, const struct core *core, float x, float y)
{
    const float p[2] = {x, y};
    struct candidate best = {.bone = -1}, candidate;
    float nearest = REACH;
    for (int b = 0; b < stage->bone_count; b++) {
        if (measure_bone(stage, core, b, p, &candidate)) nearest = fminf(nearest, candidate.distance);
    }
    for (int b = 0; b < stage->bone_count && !core->focus.brush.on; b++) {
        if (!measure_bone(stage, core, b, p, &candidate) || candidate.distance >= nearest + OVERLAP) continue;
        float worse = candidate.fraction - best.fraction; // at a joint the bone that starts there wins
        if (fabsf(candidate.distance - best.distance) > AS_FAR) worse = candidate.distance - best.distance;
        if (fabsf(candidate.depth - best.depth) > AS_DEEP * best.depth) worse = candidate.depth - best.depth;
        if (best.bone < 0 || worse < 0) best = candidate;
    }
    if (best.bone < 0) return (struct hover){.thing = NULL};
    const struct shown_bone *bone = &stage->bones[best.bone];
    return (struct hover){.thing = bone->chain >= 0 ? &thing_chain : &thing_bone,
                          .rig = bone->chain,
                          .joint = bone->joint,
                          .fraction = (double)best.fraction,
                          .model = bone->model,
                          .node = bone->part.node,
                          .x = best.xy[0],
                          .y = best.xy[1]};
}

/// The middle of a bone; with "dog 2/" before its name, of that character.
static bool find_bone(void *room, const struct core *core, const struct target *target, float xy[2])
{
    const struct stage *stage = room;
    const struct document *document = core->document;
    for (int r = -1; (r = document_next_rig(document, RIG_MODEL, r)) >= 0;) {
        const char *title = rig_title(document->rigs[r]);
        const size_t length = strlen(title);
        const bool is_its = strncmp(target->name, title, length) == 0 && target->name[length] == '/';
        const struct imported *shown = bones_character(core, r);
        const int node = shown ? gltf_find_node(&shown->gltf, target->name + (is_its ? length + 1 : 0)) : -1;
        for (int b = 0; b < stage->bone_count && node >= 0; b++) {
            const struct shown_bone *bone = &stage->bones[b];
            const vec3s middle = glms_vec3_lerp(vec3_from(bone->ends[0]), vec3_from(bone->ends[1]), 0.5f);
            if (bone->model != r || bone->part.node != node || is_hidden(core, bone)) continue;
            if (stage_project_point(stage, middle.raw, xy)) return true;
            break;
        }
    }
    return false;
}

/// bone(tail_1): the first such bone of all characters; bone(dog 2/tail_1): that character's.
const struct thing thing_bone = {
    .cursor = CURSOR_HAND,
    .hint = "Click to select this bone (Alt shows control bones too); drag to move the character",
    .press = press_body,
    .name = "bone",
    .of = OF_ITSELF,
    .find = find_bone,
    .missing = "there is no such bone to be seen"};

enum { LABEL_HEIGHT = 20, LABEL_PAD = 7, LABEL_AWAY = 14 };

static const float NEAR_BOX = 12;                    ///< pixels around a character; inside, its bones show
static const float THICKEST = 5, THINNEST = 1.5f;    ///< pixels: half of a bone's width
static const float SHARE = 0.09f, WIDEST_AT = 0.14f; ///< of a bone's length: half its width, and where it is widest
static const float PLAIN = 0.3f, MEANT = 0.6f, CHOSEN = 0.85f; ///< opacity of the fill

/// The bones from a node down to a tip, which a new chain would bend; −1: none.
struct way {
    int model, node, tip;
};

static struct way way_from(const struct core *core, int model, int node)
{
    const struct imported *character = node >= 0 ? bones_character(core, model) : NULL;
    return (struct way){model, node, character ? chain_end(character, node, NULL) : -1};
}

static struct way way_chosen(const struct core *core)
{
    int model;
    const int node = bones_selected(core, &model);
    return way_from(core, model, node);
}

/// The number of bones from the way's tip up to a node on it; 0 for others.
static int way_count(const struct core *core, const struct way *way, int model, int node)
{
    if (way->model != model || way->tip < 0) return 0;
    const struct gltf_node *nodes = bones_character(core, model)->gltf.nodes;
    int count = 1;
    for (int n = way->tip; n >= 0; n = n == way->node ? -1 : nodes[n].parent, count++) {
        if (n == node) return count;
    }
    return 0;
}

void bones_show(const struct stage *stage, struct core *core)
{
    const struct stage_view *view = &stage->view;
    const struct hover *hover = &core->input.hover;
    const struct rect place = core->view.layout.stage;

    // The rig whose bones show because the pointer is over its character's bounding box on the screen, or −1.
    int under = hover->thing == &thing_bone ? hover->model : -1;
    const bool searches = under < 0 && !core->focus.brush.on &&
                          rect_contains(view->viewport, core->input.pointer_x, core->input.pointer_y);
    for (int m = 0; searches && under < 0 && m < view->model_count; m++) {
        const struct stage_model *model = &view->models[m];
        struct rect box;
        if (model->rig >= 0 &&
            (!stage_project_box(stage, place, model->lo, model->hi, &box) ||
             rect_contains(rect_inset(box, -NEAR_BOX), core->input.pointer_x, core->input.pointer_y)))
            under = model->rig;
    }
    const struct way chosen = way_chosen(core);
    struct way meant = {-1, -1, -1};
    if (!core->input.drag.owner && hover->thing == &thing_bone)
        meant = way_from(core, hover->model, hover->node);
    else if (!core->input.drag.owner && hover->thing == &thing_chain)
        meant = (struct way){hover->model, hover->node, -1};
    for (int b = 0; b < stage->bone_count; b++) {
        const struct shown_bone *bone = &stage->bones[b];
        const int model = bone->model, node = bone->part.node;
        float ends[2][2];
        if (model != under && model != chosen.model && core->focus.pick.use == BONE_SELECTED) continue;
        const bool is_chosen = model == chosen.model && node == chosen.node;
        const bool is_meant = (model == meant.model && node == meant.node) ||
                              way_count(core, &chosen, model, node) > 0 || way_count(core, &meant, model, node) > 0;
        const float opacity = is_chosen ? CHOSEN : is_meant ? MEANT : PLAIN;
        if ((is_hidden(core, bone) && opacity == PLAIN) || !project_bone(stage, bone, ends)) continue;
        const uint32_t color = bone->chain >= 0 && bone->color ? bone->color : theme()->playhead;
        if (node != bone->part.from) {
            drawlist_line(&core->list, ends[0], 2, 1.25f, theme_fade(color, opacity));
            continue;
        }

        // A kite from joint to joint, widest near the first.
        const float *from = ends[0], *to = ends[1];
        const float dx = to[0] - from[0], dy = to[1] - from[1], length = maths_hypotf(dx, dy);
        const float half = fmaxf(THINNEST, fminf(THICKEST, SHARE * length));
        const float ux = length > 0 ? dx / length : 1, uy = length > 0 ? dy / length : 0;
        const float x = from[0] + WIDEST_AT * dx, y = from[1] + WIDEST_AT * dy;
        const float corners[5][2] = {{from[0], from[1]},
                                     {x - half * uy, y + half * ux},
                                     {to[0], to[1]},
                                     {x + half * uy, y - half * ux},
                                     {from[0], from[1]}};
        drawlist_line(&core->list, corners[0], 5, 3, theme_fade(theme()->panel, 0.45f));
        drawlist_convex(&core->list, corners[0], 4, theme_fade(color, opacity));
        drawlist_line(&core->list, corners[0], 5, 1.25f,
                      theme_fade(is_chosen ? theme()->text : color, 0.5f + 0.5f * opacity));
    }
    if (meant.node < 0) return;

    // The bone's name beside the pointer, inside the stage.
    char title[BONES_TITLE], text[2 * BONES_TITLE];
    const struct gltf_node *nodes = bones_character(core, meant.model)->gltf.nodes;
    const int count = way_count(core, &meant, meant.model, meant.node);
    int length =
        snprintf(text, sizeof text, "%s", bones_title(core->document, meant.model, nodes[meant.node].name, title));
    if (count > 1)
        snprintf(text + length, sizeof text - (size_t)length, " to %.*s, %d bones",
                 name_fit(nodes[meant.tip].name, 200), nodes[meant.tip].name, count);
    const float width = fminf(font_width(FONT_LABEL, THEME_TEXT_NORMAL, text), place.w / 2) + 2 * LABEL_PAD + 2;
    struct rect r = {core->input.pointer_x + LABEL_AWAY, core->input.pointer_y - LABEL_AWAY - LABEL_HEIGHT, width,
                     LABEL_HEIGHT};
    if (r.x + r.w > place.x + place.w) r.x = core->input.pointer_x - LABEL_AWAY - r.w;
    if (r.y < place.y) r.y = core->input.pointer_y + LABEL_AWAY;
    drawlist_rounded(&core->list, r, 4, theme_fade(theme()->raised, 0.92f));
    drawlist_rounded_line(&core->list, r, 4, 1, theme()->border);
    drawlist_text_fit(&core->list, r.x + LABEL_PAD, r.y + 14, r.w - LABEL_PAD, FONT_LABEL, THEME_TEXT_NORMAL,
                      theme()->text, text);
}

static const float AROUND = 0.15f; ///< of its largest side: room about what is framed

void stage_frame(struct stage *stage, struct core *core)
{
    float lo[3] = {INFINITY, INFINITY, INFINITY}, hi[3] = {-INFINITY, -INFINITY, -INFINITY}, widest = 0;
    const int rig = overlay_rig(stage, core);
    const struct pose *strand = rig >= 0 ? &strand_of(stage, rig)->pose : NULL;
    const struct way way = way_chosen(core);
    for (int b = 0; b < stage->bone_count; b++) {
        const struct shown_bone *bone = &stage->bones[b];
        const int node = bone->part.node;
        if (bone->model != way.model || node != bone->part.from) continue;
        if (node != way.node && way_count(core, &way, way.model, node) == 0) continue;
        for (int e = 0; e < 6; e++) {
            lo[e % 3] = fminf(lo[e % 3], bone->ends[e / 3][e % 3]);
            hi[e % 3] = fmaxf(hi[e % 3], bone->ends[e / 3][e % 3]);
        }
    }
    const int points = strand && !(lo[0] <= hi[0]) ? strand->count : 0; // without bones
    for (int i = 0; i < 3 * points; i++) {
        const float at = strand->matrix[i / 3][12 + i % 3];
        lo[i % 3] = fminf(lo[i % 3], at);
        hi[i % 3] = fmaxf(hi[i % 3], at);
    }
    if (!(lo[0] <= hi[0])) {
        stage_fit(stage, core);
        return;
    }
    for (int k = 0; k < 3; k++) widest = fmaxf(widest, hi[k] - lo[k]);
    for (int k = 0; k < 3; k++) {
        lo[k] -= AROUND * widest;
        hi[k] += AROUND * widest;
    }
    const float floor = core->view.camera.floor;
    camera_fit(&core->view.camera, lo, hi, core->view.layout.stage.w / core->view.layout.stage.h, 0);
    core->view.camera.floor = floor;
}
