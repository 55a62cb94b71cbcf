/// Reads the models of a document's characters, and caches them by path.
#include "rig/models.h"
#include "base/file.h"
#include "base/need.h"
#include "model/fox.h"
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

enum model_kind { MODEL_FIGURE, MODEL_IMPORTED };

/// A file that was read, and its state at that time.
struct model_file {
    char *path; ///< absolute
    struct timespec changed;
    off_t size;
    enum model_kind kind;
    union {
        struct figure figure;
        struct imported imported;
    };
};

/// A cache of models by path; a model is read again only if its file has changed.
struct model_files {
    struct model_file **files;
    int count;
};

static void file_destroy(struct model_file *file)
{
    if (!file) return;
    if (file->kind == MODEL_FIGURE) {
        figure_free(&file->figure);
    } else {
        imported_free(&file->imported);
    }
    free(file->path);
    free(file);
}

static void free_files(struct model_files *files)
{
    for (int i = 0; i < files->count; i++) file_destroy(files->files[i]);
    free(files->files);
    *files = (struct model_files){0};
}

static bool is_current(const struct model_file *file, const struct stat *about)
{
    return file->size == about->st_size && file->changed.tv_sec == about->st_mtim.tv_sec &&
           file->changed.tv_nsec == about->st_mtim.tv_nsec;
}

static int find_file(const struct model_files *files, const char *path, enum model_kind kind)
{
    for (int i = 0; i < files->count; i++) {
        if (files->files[i]->kind == kind && strcmp(files->files[i]->path, path) == 0) return i;
    }
    return -1;
}

static bool read_figure(struct figure *figure, const char *path, struct error *error)
{
    struct character character = {0};
    if (!character_read(path, &character, error)) return false;
    if (!figure_has_room(&character)) {
        character_free(&character);
        return fail_no_memory(error, path);
    }
    figure_create(figure, &character);
    return true;
}

static struct model_file *read_file(const char *path, enum model_kind kind, struct error *error)
{
    struct model_file *file = need_zeroed(1, sizeof *file);
    file->path = need_text(path);
    file->kind = kind;
    if (kind == MODEL_FIGURE ? read_figure(&file->figure, path, error) : imported_read(&file->imported, path, error))
        return file;
    file_destroy(file);
    return NULL;
}

/// Replaces an older file or, if `at` is −1, adds one.
static void keep(struct model_files *files, int at, struct model_file *file)
{
    if (at >= 0) {
        file_destroy(files->files[at]);
        files->files[at] = file;
        return;
    }
    files->files = need_more(files->files, (size_t)files->count + 1, sizeof *files->files);
    files->files[files->count++] = file;
}

/// The model in a file, read again only if the file has changed; NULL and an error if it cannot be read.
static const struct model_file *obtain(struct model_files *files, const char *path, enum model_kind kind,
                                       struct error *error)
{
    struct stat about = {0};
    bool is_there = stat(path, &about) == 0;
    int at = find_file(files, path, kind);
    if (at >= 0 && is_there && is_current(files->files[at], &about)) return files->files[at];
    struct model_file *file = read_file(path, kind, error);
    if (!file) return NULL;
    file->changed = about.st_mtim;
    file->size = about.st_size;
    keep(files, at, file);
    return file;
}

// --- the models of a document

/// The model of one character.
struct character_model {
    const struct figure *plain; ///< owned by one of the files; NULL: it could not be read
    struct painted *painted;    ///< NULL until it is first painted
    uint64_t version;           ///< of its paint, 0: none
};

/// An imported character of a rig, or the fox of a tail, and its poses.
struct placed_model {
    char *path;        ///< as in the rig; NULL: a tail
    int level, joints; ///< of a fox
    struct imported *fox;
    const struct imported *imported; ///< NULL: it could not be read
    struct gltf_pose pose[POSE_MEMORIES];
};

struct models {
    struct model_files files;
    struct placed_model *placed; ///< in the order of the document
    int placed_count;
    struct placed_model *tails; ///< in the order of the document
    int tail_count;
    struct character_model *characters; ///< in the order of the document
    int character_count;
    uint64_t version;
};

struct models *models_create(void) { return need_zeroed(1, sizeof(struct models)); }

static void drop_characters(struct models *models)
{
    for (int i = 0; i < models->character_count; i++) painted_destroy(models->characters[i].painted);
    models->character_count = 0;
}

static void free_placed(struct placed_model *placed)
{
    for (int k = 0; k < POSE_MEMORIES; k++) gltf_pose_free(&placed->pose[k]);
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
    drop_characters(models);
    drop_placed(models);
    for (int i = 0; i < models->tail_count; i++) free_placed(&models->tails[i]);
    free(models->placed);
    free(models->tails);
    free_files(&models->files);
    free(models->characters);
    free(models);
}

/// Whether the model has all coordinates that the scene names.
static bool check_names(const struct character_rig *rig, const struct figure *figure, struct error *error)
{
    for (int k = 0; k < rig->drive_count; k++) {
        if (figure_find(figure, rig->drives[k].name) >= 0) continue;
        const struct character *c = &figure->character;
        return fail(error, ERROR_INPUT, "%s: expected a coordinate called \"%s\", got %s%s", rig->model,
                    rig->drives[k].name, c->coordinate_count > 0 ? "others, such as " : "none",
                    c->coordinate_count > 0 ? c->coordinates[0].name : "");
    }
    return true;
}

bool models_paint_fits(const struct paint *paint, const struct figure *figure)
{
    return paint->coordinates == figure->character.coordinate_count &&
           paint->vertices == figure->character.vertex_count;
}

static bool check_paint(const struct character_rig *rig, const struct figure *figure, struct error *error)
{
    const struct paint *paint = rig->painted;
    if (!paint || models_paint_fits(paint, figure)) return true;
    return fail(error, ERROR_INPUT, "%s: expected paint for the %d coordinates of %d vertices of %s, got %d of %d",
                rig->paint_file ? rig->paint_file : "paint", figure->character.coordinate_count,
                figure->character.vertex_count, rig->model, paint->coordinates, paint->vertices);
}

static bool resolve(const struct document *document, const char *model, char path[PATH_LIMIT], struct error *error)
{
    return path_resolve(document->folder, model, path) || fail(error, ERROR_INPUT, "%s: the path is too long", model);
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

/// The model of a rig; NULL and an error if it cannot be read. `error` is also set if it does not suit the rig.
static const struct figure *find_figure(struct models *models, const struct document *document, const struct rig *of,
                                        struct error *error)
{
    const struct character_rig *rig = &of->character;
    char path[PATH_LIMIT];
    if (!resolve(document, rig->model, path, error)) return NULL;
    const struct model_file *file = obtain(&models->files, path, MODEL_FIGURE, error);
    const struct figure *figure = file ? &file->figure : NULL;
    if (figure && check_names(rig, figure, error) && check_pins(of, figure->character.vertex_count, error))
        check_paint(rig, figure, error);
    return figure;
}

/// Keeps the first of several errors.
static void keep_first(struct error *first, const struct error *trouble)
{
    if (first->kind == ERROR_NONE) *first = *trouble;
}

static void update_characters(struct models *models, const struct document *document, struct error *first)
{
    drop_characters(models);
    const int count = document_count_rigs(document, RIG_CHARACTER);
    struct character_model *characters = models->characters =
        need_more(models->characters, (size_t)count + 1, sizeof *characters);
    for (int i = 0, rig = -1; i < count; i++) {
        struct error trouble = {0};
        rig = document_next_rig(document, RIG_CHARACTER, rig);
        characters[i] =
            (struct character_model){.plain = find_figure(models, document, document->rigs[rig], &trouble)};
        keep_first(first, &trouble);
    }
    models->character_count = count;
}

static bool check_clip(const struct model_rig *rig, const struct gltf *gltf, struct error *error)
{
    if (!rig->clip || gltf_find_clip(gltf, rig->clip) >= 0) return true;
    return fail(error, ERROR_INPUT, "%s: expected a clip called \"%s\", got %s%s", rig->model, rig->clip,
                gltf->clip_count > 0 ? "others, such as " : "none", gltf->clip_count > 0 ? gltf->clips[0].name : "");
}

static bool make_poses(struct placed_model *placed, const struct imported *imported)
{
    placed->imported = imported;
    for (int k = 0; k < POSE_MEMORIES; k++)
        if (!gltf_pose_create(&imported->gltf, &placed->pose[k])) return false;
    return true;
}

/// Rebuilds a fox if its tail's joints or the number of tails have changed.
static void update_tails(struct models *models, const struct document *document)
{
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

/// Reads the model of a rig and allocates its poses.
static bool place_model(struct models *models, const struct document *document, const struct model_rig *rig,
                        struct placed_model *placed, struct error *error)
{
    char path[PATH_LIMIT];
    *placed = (struct placed_model){.path = need_text(rig->model)};
    if (!resolve(document, rig->model, path, error)) return false;
    const struct model_file *file = obtain(&models->files, path, MODEL_IMPORTED, error);
    if (!file) return false;
    if (!make_poses(placed, &file->imported)) return fail_no_memory(error, rig->model);
    return check_clip(rig, &file->imported.gltf, error);
}

static void update_placed(struct models *models, const struct document *document, struct error *first)
{
    drop_placed(models);
    const int count = document_count_rigs(document, RIG_MODEL);
    struct placed_model *placed = models->placed = need_more(models->placed, (size_t)count + 1, sizeof *placed);
    for (int i = 0, rig = -1; i < count; i++) {
        struct error trouble = {0};
        rig = document_next_rig(document, RIG_MODEL, rig);
        place_model(models, document, &document->rigs[rig]->model, &placed[i], &trouble);
        models->placed_count++;
        keep_first(first, &trouble);
    }
}

/// Whether all chains find their bones, and pins their points.
static bool check_chains(const struct models *models, const struct document *document, struct error *error)
{
    for (int r = -1; (r = document_next_rig(document, RIG_CHAIN, r)) >= 0;) {
        const struct chain *chain = &document->rigs[r]->chain;
        const struct imported *imported =
            models_imported(models, document, document_find_model(document, chain->model, chain->by_file));
        struct chain_bones bones;
        if (!imported) continue;
        if (!chain_find(&imported->gltf, chain->from, chain->to, &bones, error)) return false;
        if (!check_pins(document->rigs[r], bones.count, error)) return false;
    }
    return true;
}

bool models_update(struct models *models, const struct document *document, struct error *error)
{
    struct error first = {0}, trouble = {0};
    models->version++;
    update_characters(models, document, &first);
    update_placed(models, document, &first);
    models_follow(models, document);
    check_chains(models, document, &trouble);
    keep_first(&first, &trouble);
    if (first.kind != ERROR_NONE && error) *error = first;
    return first.kind == ERROR_NONE;
}

bool models_suit(const struct models *models, const struct document *document)
{
    if (document_count_rigs(document, RIG_CHARACTER) != models->character_count ||
        document_count_rigs(document, RIG_MODEL) != models->placed_count)
        return false;
    for (int i = 0, rig = -1; i < models->placed_count; i++) {
        const char *path = models->placed[i].path;
        rig = document_next_rig(document, RIG_MODEL, rig);
        if (!path || strcmp(path, document->rigs[rig]->model.model) != 0) return false;
    }
    return true;
}

void models_follow(struct models *models, const struct document *document)
{
    for (int i = 0, rig = -1; i < models->character_count; i++) {
        rig = document_next_rig(document, RIG_CHARACTER, rig);
        if (rig < 0) break;
        const struct paint *paint = document->rigs[rig]->character.painted;
        struct character_model *model = &models->characters[i];
        if (paint && (!model->plain || !models_paint_fits(paint, model->plain))) paint = NULL;
        if (model->version == (paint ? paint->version : 0)) continue;
        if (!model->painted) model->painted = painted_create(model->plain);
        painted_update(model->painted, paint ? (const float(*)[2])paint->values : NULL);
        model->version = paint ? paint->version : 0;
    }
    update_tails(models, document);
}

const struct figure *models_figure(const struct models *models, int character)
{
    if (!models || character >= models->character_count) return NULL;
    const struct character_model *model = &models->characters[character];
    return model->painted ? &model->painted->figure : model->plain;
}

uint64_t models_version(const struct models *models) { return models ? models->version : 0; }

static struct placed_model *find_placed(const struct models *models, const struct document *document, int rig)
{
    const bool is_tail = rig >= 0 && document->rigs[rig]->kind == RIG_TAIL;
    if (!models || rig < 0 || (!is_tail && document->rigs[rig]->kind != RIG_MODEL)) return NULL;
    const int number = document_rig_number(document, rig);
    if (number >= (is_tail ? models->tail_count : models->placed_count)) return NULL;
    return is_tail ? &models->tails[number] : &models->placed[number];
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
