/// Reads the models of a document's characters and caches them by path; prepares them, and finds their bones.
#include "rig/models.h"
#include "base/file.h"
#include "base/need.h"
#include "maths/maths.h"
#include "model/fox.h"
#include "model/vector.h"
#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

// --- characters

static const float SHORT_TIP = 0.1f;     ///< share of the character's height: length of a lone joint's bone
static const float BESIDE = 0.1f;        ///< share of its length: a tail that ends nearer to the middle shows no back
static const float SHORT_SIBLING = 0.4f; ///< share of the way from its parent, for one of several bones, like an eye
static const float STRAIGHT = 0.8f;      ///< cosine within which one of several children goes on from the bone before

static vec3s place_of(const struct gltf_pose *pose, int node) { return vec3_from(pose->world[node] + 12); }

/// How a bone goes on if no child says so: as far as the bone before is long, if it has one.
static vec3s way_on(const struct imported *imported, const bool *is_bone, int node)
{
    const struct gltf *gltf = &imported->gltf;
    const int parent = gltf->nodes[node].parent;
    if (parent < 0 || !is_bone[parent]) return (vec3s){.raw = {0, SHORT_TIP * (gltf->hi[1] - gltf->lo[1]), 0}};
    int siblings = 0;
    for (int c = gltf->nodes[parent].child; c >= 0; c = gltf->nodes[c].next) siblings += is_bone[c];
    const vec3s on = glms_vec3_sub(place_of(&imported->rest, node), place_of(&imported->rest, parent));
    return siblings > 1 ? glms_vec3_scale(on, SHORT_SIBLING) : on;
}

/// The child that a bone leads to: the only one that leads to vertices, or the only one at all; of several, the one that goes straight on.
static int main_child(const struct imported *imported, const struct skeleton *skeleton, const bool *is_bone, int node)
{
    const struct gltf_node *nodes = imported->gltf.nodes;
    const vec3s at = place_of(&imported->rest, node), on = glms_vec3_normalize(way_on(imported, is_bone, node));
    for (int all = 0; all < 2; all++) {
        int count = 0, only = -1, best = -1;
        float most = STRAIGHT;
        for (int c = nodes[node].child; c >= 0; c = nodes[c].next) {
            if (!is_bone[c] || !(skeleton->leads[c] || all)) continue;
            const vec3s way = glms_vec3_normalize(glms_vec3_sub(place_of(&imported->rest, c), at));
            only = count++ == 0 ? c : -1;
            if (glms_vec3_dot(way, on) <= most) continue;
            most = glms_vec3_dot(way, on);
            best = c;
        }
        if (count > 0) return only >= 0 ? only : best;
    }
    return -1;
}

static bool is_hidden(const struct gltf *gltf, const struct skeleton *skeleton, int node)
{
    bool seen = skeleton->carries[node];
    for (int c = gltf->nodes[node].child; c >= 0 && !seen; c = gltf->nodes[c].next) seen = skeleton->carries[c];
    return !seen;
}

void skeleton_ends(const struct bone *bone, const struct gltf_pose *pose, float ends[2][3])
{
    vec3s end = bone->child >= 0 ? place_of(pose, bone->child)
                                 : glms_mat4_mulv3(mat4_from(pose->world[bone->node]), vec3_from(bone->tip), 1.0f);
    memcpy(ends[0], pose->world[bone->from] + 12, sizeof ends[0]);
    memcpy(ends[1], end.raw, sizeof ends[1]);
}

bool imported_back(const struct imported *imported, float back[2])
{
    const struct gltf *gltf = &imported->gltf;
    const float *lo = gltf->lo, *hi = gltf->hi;
    float farthest = BESIDE * (hi[2] - lo[2]);
    bool found = false;
    for (int b = 0; b < imported->skeleton.count; b++) {
        const struct bone *bone = &imported->skeleton.bones[b];
        float ends[2][3];
        if (!strcasestr(gltf->nodes[bone->node].name, "tail")) continue;
        skeleton_ends(bone, &imported->rest, ends);
        const float x = ends[1][0] - 0.5f * (lo[0] + hi[0]), z = ends[1][2] - 0.5f * (lo[2] + hi[2]);
        if (maths_hypotf(x, z) <= farthest) continue;
        farthest = maths_hypotf(x, z);
        back[0] = x;
        back[1] = z;
        found = true;
    }
    if (found) return true;
    back[0] = 0;
    back[1] = -1;
    return gltf->skin_count > 0 && hi[2] - lo[2] > hi[0] - lo[0];
}

/// Derives everything else from `gltf`. False if memory is short.
static bool imported_complete(struct imported *imported)
{
    if (!gltf_pose_create(&imported->gltf, &imported->rest) ||
        !gltf_bounds_create(&imported->gltf, &imported->bounds))
        return false;

    const struct gltf *gltf = &imported->gltf;
    const struct gltf_bounds *bounds = &imported->bounds;
    const size_t count = (size_t)gltf->node_count + 1;
    bool *is_bone = need_zeroed(count, sizeof *is_bone);
    struct pool *pool = &imported->gltf.pool;
    imported->skeleton = (struct skeleton){.bones = pool_take(pool, 2 * count, sizeof(struct bone)),
                                           .carries = pool_take(pool, count, sizeof(bool)),
                                           .leads = pool_take(pool, count, sizeof(bool))};
    struct skeleton *skeleton = &imported->skeleton;

    // Joints; in a file without skins, nodes below others. A single mesh is no skeleton.
    for (int s = 0; s < gltf->skin_count; s++) {
        for (int j = 0; j < gltf->skins[s].joint_count; j++) is_bone[gltf->skins[s].joints[j]] = true;
    }
    for (int n = 0; n < gltf->node_count && gltf->skin_count == 0; n++)
        is_bone[n] = gltf->nodes[n].parent >= 0 && bounds->count != 1;

    // A mesh without a skin is carried by the bone above it.
    for (int f = 0; f < bounds->count; f++) {
        const struct gltf_box *box = &bounds->boxes[f];
        int n = box->joint < 0 ? box->node : gltf->skins[gltf->nodes[box->node].skin].joints[box->joint];
        while (n >= 0 && !is_bone[n]) n = gltf->nodes[n].parent;
        if (n >= 0) skeleton->carries[n] = true;
    }
    for (int n = 0; n < gltf->node_count; n++) skeleton->carries[n] |= bounds->count == 0 && is_bone[n];
    for (int k = gltf->node_count - 1; k >= 0; k--) {
        const int n = gltf->order[k], parent = gltf->nodes[n].parent;
        skeleton->leads[n] |= skeleton->carries[n];
        if (parent >= 0) skeleton->leads[parent] |= skeleton->leads[n];
    }

    for (int n = 0; n < gltf->node_count; n++) {
        if (!is_bone[n]) continue;
        const mat3s turn = mat3_inverse(glms_mat4_pick3(mat4_from(imported->rest.world[n])));
        const vec3s tip = glms_mat3_mulv(turn, way_on(imported, is_bone, n));
        struct bone *bone = &skeleton->bones[skeleton->own++];
        *bone = (struct bone){.node = n, .from = n, .hidden = is_hidden(gltf, skeleton, n)};
        bone->child = main_child(imported, skeleton, is_bone, n);
        memcpy(bone->tip, tip.raw, sizeof bone->tip);
    }
    skeleton->count = skeleton->own;
    for (int b = 0; b < skeleton->own; b++) {
        const int parent = skeleton->bones[b].from, main = skeleton->bones[b].child;
        for (int c = gltf->nodes[parent].child; c >= 0; c = gltf->nodes[c].next) {
            const bool hidden = skeleton->bones[b].hidden || is_hidden(gltf, skeleton, c);
            if (is_bone[c] && c != main)
                skeleton->bones[skeleton->count++] =
                    (struct bone){.node = c, .from = parent, .child = c, .hidden = hidden};
        }
    }
    free(is_bone);
    return true;
}

bool imported_read(struct imported *imported, const char *path, struct error *error)
{
    struct character soft = {0};
    *imported = (struct imported){0};
    if (!gltf_read(path, &imported->gltf, error)) return false;
    bool good = !gltf_is_soft(&imported->gltf) || character_from_gltf(&imported->gltf, &soft, error);
    if (good && !(figure_has_room(&soft) && imported_complete(imported))) good = fail_no_memory(error, path);
    if (good && soft.vertex_count > 0 && soft.node >= 0) figure_create(&imported->figure, &soft);
    character_free(&soft);
    if (!good) imported_free(imported);
    return good;
}

void imported_free(struct imported *imported)
{
    figure_free(&imported->figure);
    gltf_pose_free(&imported->rest);
    gltf_free(&imported->gltf);
    *imported = (struct imported){0};
}

// --- bones of a chain

static bool fail_missing(const struct gltf *gltf, const char *name, struct error *error)
{
    return fail(error, ERROR_INPUT, "%s: expected a bone called \"%s\", got none", gltf->path, name);
}

bool chain_find(const struct gltf *gltf, const char *from, const char *to, struct chain_bones *bones,
                struct error *error)
{
    const int first = gltf_find_node(gltf, from), last = gltf_find_node(gltf, to);
    if (first < 0) return fail_missing(gltf, from, error);
    if (last < 0) return fail_missing(gltf, to, error);
    bones->count = 1;
    for (int n = last; n != first; n = gltf->nodes[n].parent, bones->count++) {
        if (n < 0)
            return fail(error, ERROR_INPUT, "%s: expected \"%s\" below \"%s\", got it elsewhere", gltf->path, to,
                        from);
        if (bones->count == ANGLES_MAX_JOINTS)
            return fail(error, ERROR_INPUT, "%s: expected at most %d bones from \"%s\" to \"%s\", got more",
                        gltf->path, ANGLES_MAX_JOINTS, from, to);
    }
    for (int i = bones->count - 1, n = last; i >= 0; i--, n = gltf->nodes[n].parent) {
        bones->node[i] = n;
        if (!gltf->nodes[n].has_matrix) continue;
        return fail(error, ERROR_INPUT,
                    "%s: expected a bone that can turn, got \"%s\", which a matrix shears or flattens", gltf->path,
                    gltf->nodes[n].name);
    }
    return true;
}

/// The first of `node` and those after it below the same parent that counts as a way down.
static int next_way(const struct imported *imported, int node, bool leads)
{
    while (node >= 0 && leads && !imported->skeleton.leads[node]) node = imported->gltf.nodes[node].next;
    return node;
}

int chain_end(const struct imported *imported, int from, struct error *error)
{
    const struct gltf *gltf = &imported->gltf;
    const bool leads = imported->skeleton.leads[from];
    int last = from;
    for (int count = 1; count <= ANGLES_MAX_JOINTS; count++) {
        const int child = next_way(imported, gltf->nodes[last].child, leads);
        const int other = child < 0 ? -1 : next_way(imported, gltf->nodes[child].next, leads);
        if (child < 0) return last;
        if (other >= 0) {
            fail(error, ERROR_INPUT,
                 "\"%s\" branches into \"%s\" and \"%s\": choose the bone where the chain begins or ends",
                 gltf->nodes[last].name, gltf->nodes[child].name, gltf->nodes[other].name);
            return -1;
        }
        last = child;
    }
    fail(error, ERROR_INPUT, "below \"%s\" there are more than %d bones: choose the one where the chain ends",
         gltf->nodes[from].name, ANGLES_MAX_JOINTS);
    return -1;
}

// --- pairs

bool bone_other_side(const char *name, char other[BONE_NAME_SIZE])
{
    static const char *const words[][2] = {{"Left", "Right"}, {"left", "right"}, {"LEFT", "RIGHT"}};
    static const char *const letters[][2] = {{"L", "R"}, {"l", "r"}};
    for (size_t w = 0; w < 3; w++) {
        for (int side = 0; side < 2; side++) {
            const char *at = strstr(name, words[w][side]);
            if (!at) continue;
            return snprintf(other, BONE_NAME_SIZE, "%.*s%s%s", (int)(at - name), name, words[w][!side],
                            at + strlen(words[w][side])) < BONE_NAME_SIZE;
        }
    }
    for (size_t i = 0; name[i]; i++) {
        for (int k = 0; k < 4; k++) {
            const char *letter = letters[k / 2][k % 2];
            const char before = i > 0 ? name[i - 1] : ' '; // the letter is a separate word, as in ear.l, or earL
            if (name[i] != letter[0] || isalpha((unsigned char)name[i + 1])) continue;
            if (isalpha((unsigned char)before) &&
                !(islower((unsigned char)before) && isupper((unsigned char)name[i])))
                continue;
            return snprintf(other, BONE_NAME_SIZE, "%.*s%s%s", (int)i, name, letters[k / 2][!(k % 2)], name + i + 1) <
                   BONE_NAME_SIZE;
        }
    }
    return false;
}

bool chain_find_twin(const struct gltf *gltf, const char *from, const char *to, struct chain_bones *bones)
{
    char ends[2][BONE_NAME_SIZE];
    return bone_other_side(from, ends[0]) && bone_other_side(to, ends[1]) &&
           chain_find(gltf, ends[0], ends[1], bones, NULL);
}

// --- files

/// A file that was read, and its state at that time.
struct model_file {
    char *path; ///< absolute
    struct timespec changed;
    off_t size;
    struct imported imported;
};

static void file_destroy(struct model_file *file)
{
    if (!file) return;
    imported_free(&file->imported);
    free(file->path);
    free(file);
}

// --- the models of a document

/// The character of a rig, or the fox of a tail, and its poses.
struct placed_model {
    char *path;        ///< as in the rig; NULL: a tail
    int level, joints; ///< of a fox
    struct imported *fox;
    const struct imported *imported; ///< NULL: it could not be read
    struct gltf_pose pose[POSE_MEMORIES];
    struct painted *painted; ///< NULL until it is first painted
    uint64_t version;        ///< of its paint, 0: none
};

struct models {
    struct model_file **files; ///< a cache by path
    int file_count;
    struct placed_model *placed; ///< in the order of the document
    int placed_count;
    struct placed_model *tails; ///< in the order of the document
    int tail_count;
    uint64_t version;
    struct background *background;
};

struct models *models_create(void)
{
    struct models *models = need_zeroed(1, sizeof *models);
    models->background = background_create();
    return models;
}

struct background *models_background(const struct models *models) { return models ? models->background : NULL; }

static void free_placed(struct placed_model *placed)
{
    for (int k = 0; k < POSE_MEMORIES; k++) gltf_pose_free(&placed->pose[k]);
    painted_destroy(placed->painted);
    if (placed->fox) imported_free(placed->fox);
    free(placed->fox);
    free(placed->path);
    *placed = (struct placed_model){0};
}

static void drop_placed(struct models *models)
{
    for (int i = 0; i < models->placed_count; i++) free_placed(&models->placed[i]);
    models->placed_count = 0;
}

void models_destroy(struct models *models)
{
    if (!models) return;
    drop_placed(models);
    for (int i = 0; i < models->tail_count; i++) free_placed(&models->tails[i]);
    free(models->placed);
    free(models->tails);
    for (int i = 0; i < models->file_count; i++) file_destroy(models->files[i]);
    free(models->files);
    background_destroy(models->background);
    free(models);
}

bool models_paint_fits(const struct paint *paint, const struct figure *figure)
{
    return paint->coordinates == figure->character.coordinate_count &&
           paint->vertices == figure->character.vertex_count;
}

/// The model in a file named by the document, read again only if the file has changed; NULL and an error if it cannot be read.
static const struct model_file *read_model(struct models *models, const struct document *document, const char *name,
                                           struct error *error)
{
    char path[PATH_LIMIT];
    if (!path_resolve(document->folder, name, path)) {
        fail(error, ERROR_INPUT, "%s: the path is too long", name);
        return NULL;
    }
    struct stat status = {0};
    const bool is_there = stat(path, &status) == 0;
    struct model_file **old = NULL;
    for (int i = 0; i < models->file_count && !old; i++) {
        if (strcmp(models->files[i]->path, path) == 0) old = &models->files[i];
    }
    if (old && is_there && (*old)->size == status.st_size && (*old)->changed.tv_sec == status.st_mtim.tv_sec &&
        (*old)->changed.tv_nsec == status.st_mtim.tv_nsec)
        return *old;

    struct model_file *file = need_zeroed(1, sizeof *file);
    file->path = need_text(path);
    if (!imported_read(&file->imported, path, error)) {
        file_destroy(file);
        return NULL;
    }
    file->changed = status.st_mtim;
    file->size = status.st_size;

    if (old) {
        file_destroy(*old);
        return *old = file;
    }
    models->files = need_more(models->files, (size_t)models->file_count + 1, sizeof *models->files);
    return models->files[models->file_count++] = file;
}

/// Whether a rig's model, with `points` points, has all points that are pinned.
static bool check_pins(const struct rig *rig, int points, struct error *error)
{
    for (int i = 0; i < rig->pin_count; i++) {
        const struct pin *pin = &rig->pins[i];
        if (pin->point < points) continue;
        return fail(error, ERROR_INPUT, "%s: expected a %s from 0 to %d in the pin at frame %.10g, got %d",
                    rig_title(rig), rig_pin_key(rig), points - 1, pin->frame, pin->point);
    }
    return true;
}

/// Whether a file has what a model rig names in it.
static bool check_model(const struct rig *of, const struct imported *imported, struct error *error)
{
    const struct model_rig *rig = &of->model;
    const struct gltf *gltf = &imported->gltf;
    const struct character *c = &imported->figure.character;
    if (rig->clip && gltf_find_clip(gltf, rig->clip) < 0)
        return fail(error, ERROR_INPUT, "%s: expected a clip called \"%s\", got %s%s", rig->model, rig->clip,
                    gltf->clip_count > 0 ? "others, such as " : "none",
                    gltf->clip_count > 0 ? gltf->clips[0].name : "");
    for (int k = 0; k < rig->drive_count; k++) {
        if (figure_find(&imported->figure, rig->drives[k].name) >= 0) continue;
        return fail(error, ERROR_INPUT, "%s: expected a coordinate called \"%s\", got %s%s", rig->model,
                    rig->drives[k].name, c->coordinate_count > 0 ? "others, such as " : "none",
                    c->coordinate_count > 0 ? c->coordinates[0].name : "");
    }
    if (c->vertex_count == 0 && (of->pin_count > 0 || rig->has_floor))
        return fail(error, ERROR_INPUT, "%s: expected a soft mesh for its %s, got none", rig->model,
                    of->pin_count > 0 ? "pins" : "floor");
    const struct paint *paint = rig->painted;
    return check_pins(of, c->vertex_count, error) &&
           (!paint || models_paint_fits(paint, &imported->figure) ||
            fail(error, ERROR_INPUT, "%s: expected paint for the %d coordinates of %d vertices of %s, got %d of %d",
                 rig->paint_file ? rig->paint_file : "paint", c->coordinate_count, c->vertex_count, rig->model,
                 paint->coordinates, paint->vertices));
}

/// Keeps the first of several errors.
static void keep_first(struct error *first, const struct error *trouble)
{
    if (first->kind == ERROR_NONE) *first = *trouble;
}

static bool make_poses(struct placed_model *placed, const struct imported *imported)
{
    placed->imported = imported;
    for (int k = 0; k < POSE_MEMORIES; k++)
        if (!gltf_pose_create(&imported->gltf, &placed->pose[k])) return false;
    return true;
}

bool models_update(struct models *models, const struct document *document, struct error *error)
{
    struct error first = {0};
    models->version++;

    drop_placed(models);
    const int count = document_count_rigs(document, RIG_MODEL);
    models->placed = need_more(models->placed, (size_t)count + 1, sizeof *models->placed);
    for (int i = 0, rig = -1; i < count; i++) {
        struct error trouble = {0};
        rig = document_next_rig(document, RIG_MODEL, rig);
        const struct model_rig *model = &document->rigs[rig]->model;
        struct placed_model *placed = &models->placed[models->placed_count++];
        *placed = (struct placed_model){.path = need_text(model->model)};
        const struct model_file *file = read_model(models, document, model->model, &trouble);
        if (file && !make_poses(placed, &file->imported)) {
            fail_no_memory(&trouble, model->model);
        } else if (file) {
            check_model(document->rigs[rig], &file->imported, &trouble);
        }
        keep_first(&first, &trouble);
    }
    models_follow(models, document);

    // All chains must find their bones, and pins their points.
    bool good = true;
    for (int r = -1; good && (r = document_next_rig(document, RIG_CHAIN, r)) >= 0;) {
        const struct chain *chain = &document->rigs[r]->chain;
        const struct imported *imported =
            models_imported(models, document, document_find_model(document, chain->model));
        struct chain_bones bones;
        struct error trouble = {0};
        if (!imported) continue;
        good = chain_find(&imported->gltf, chain->from, chain->to, &bones, &trouble) &&
               check_pins(document->rigs[r], bones.count, &trouble);
        keep_first(&first, &trouble);
    }
    if (first.kind != ERROR_NONE && error) *error = first;
    return first.kind == ERROR_NONE;
}

bool models_suit(const struct models *models, const struct document *document)
{
    if (document_count_rigs(document, RIG_MODEL) != models->placed_count) return false;
    for (int i = 0, rig = -1; i < models->placed_count; i++) {
        const char *path = models->placed[i].path;
        rig = document_next_rig(document, RIG_MODEL, rig);
        if (!path || strcmp(path, document->rigs[rig]->model.model) != 0) return false;
    }
    return true;
}

void models_follow(struct models *models, const struct document *document)
{
    for (int i = 0, rig = -1; i < models->placed_count; i++) {
        rig = document_next_rig(document, RIG_MODEL, rig);
        if (rig < 0) break;
        const struct paint *paint = document->rigs[rig]->model.painted;
        struct placed_model *placed = &models->placed[i];
        const struct figure *plain = placed->imported ? &placed->imported->figure : NULL;
        if (paint && (!plain || !models_paint_fits(paint, plain))) paint = NULL;
        if (placed->version == (paint ? paint->version : 0)) continue;
        if (!placed->painted) placed->painted = painted_create(plain);
        painted_update(placed->painted, paint ? (const float(*)[2])paint->values : NULL);
        placed->version = paint ? paint->version : 0;
    }

    // A fox is rebuilt if its tail's joints or the number of tails have changed.
    const int count = document_count_rigs(document, RIG_TAIL), level = fox_level(count);
    while (models->tail_count > count) free_placed(&models->tails[--models->tail_count]);
    if (count > models->tail_count) models->tails = need_more(models->tails, (size_t)count, sizeof *models->tails);
    while (models->tail_count < count) models->tails[models->tail_count++] = (struct placed_model){0};
    for (int i = 0, rig = -1; i < count; i++) {
        struct placed_model *placed = &models->tails[i];
        rig = document_next_rig(document, RIG_TAIL, rig);
        const int joints = document->rigs[rig]->tail.joints;
        if (placed->joints == joints && placed->level == level) continue;
        free_placed(placed);
        placed->level = level;
        placed->joints = joints;
        placed->fox = need_zeroed(1, sizeof *placed->fox);
        fox_create(level, joints, &placed->fox->gltf);
        if (!imported_complete(placed->fox) || !make_poses(placed, placed->fox)) need_failed();
    }
}

uint64_t models_version(const struct models *models) { return models ? models->version : 0; }

static struct placed_model *find_placed(const struct models *models, const struct document *document, int rig)
{
    if (!models || rig < 0) return NULL;
    const bool is_tail = document->rigs[rig]->kind == RIG_TAIL;
    if (!is_tail && document->rigs[rig]->kind != RIG_MODEL) return NULL;
    const int number = document_rig_number(document, rig);
    if (number >= (is_tail ? models->tail_count : models->placed_count)) return NULL;
    return is_tail ? &models->tails[number] : &models->placed[number];
}

const struct figure *models_figure(const struct models *models, const struct document *document, int rig)
{
    const struct placed_model *placed = find_placed(models, document, rig);
    if (!placed || !placed->imported || placed->imported->figure.character.vertex_count == 0) return NULL;
    return placed->painted ? &placed->painted->figure : &placed->imported->figure;
}

const struct imported *models_imported(const struct models *models, const struct document *document, int rig)
{
    const struct placed_model *placed = find_placed(models, document, rig);
    return placed ? placed->imported : NULL;
}

struct gltf_pose *models_pose(const struct models *models, const struct document *document, int rig,
                              enum pose_memory memory)
{
    struct placed_model *placed = find_placed(models, document, rig);
    return placed && placed->imported ? &placed->pose[memory] : NULL;
}
