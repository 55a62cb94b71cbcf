/// Reads the models of a document's characters, and keeps them by path.
#include "rig/models.h"
#include "base/path.h"
#include "rig/model_files.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/// The model of one character.
struct character_model {
    const struct figure *plain; ///< one of the files'; NULL: it could not be read
    struct painted *painted;    ///< NULL until somebody paints on it
    uint64_t version;           ///< of the paint on it, 0: none
};

struct models {
    struct model_files files;
    struct character_model *characters; ///< in the order of the document
    int character_count;
};

struct models *models_create(void) { return calloc(1, sizeof(struct models)); }

static void drop_characters(struct models *models)
{
    for (int i = 0; i < models->character_count; i++) painted_destroy(models->characters[i].painted);
    models->character_count = 0;
}

void models_destroy(struct models *models)
{
    if (!models) return;
    drop_characters(models);
    model_files_free(&models->files);
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
                rig->paint ? rig->paint : "paint", figure->character.coordinate_count, figure->character.vertex_count,
                rig->model, paint->coordinates, paint->vertices);
}

/// The model of one rig, or NULL with a sentence; `error` is also set if the model does not suit the rig.
static const struct figure *find_figure(struct models *models, const struct document *document,
                                        const struct character_rig *rig, struct error *error)
{
    char path[PATH_LIMIT];
    if (!path_resolve(document->folder, rig->model, path)) {
        fail(error, ERROR_INPUT, "%s: the path is too long", rig->model);
        return NULL;
    }
    const struct figure *figure = model_files_figure(&models->files, path, error);
    if (figure && check_names(rig, figure, error)) check_paint(rig, figure, error);
    return figure;
}

bool models_update(struct models *models, const struct document *document, struct error *error)
{
    struct error first = {0};
    drop_characters(models);
    const int count = document_count_rigs(document, RIG_CHARACTER);
    struct character_model *characters = realloc(models->characters, ((size_t)count + 1) * sizeof *characters);
    if (!characters) return fail(error, ERROR_ENVIRONMENT, "not enough memory for the characters");
    models->characters = characters;
    int rig = document_next_rig(document, RIG_CHARACTER, 0);
    for (int i = 0; i < count; i++, rig = document_next_rig(document, RIG_CHARACTER, rig + 1)) {
        struct error trouble = {0};
        characters[i] = (struct character_model){
            .plain = find_figure(models, document, &document->rigs[rig].character, &trouble)};
        if (first.kind == ERROR_NONE) first = trouble;
    }
    models->character_count = count;
    models_paint(models, document);
    if (first.kind != ERROR_NONE && error) *error = first;
    return first.kind == ERROR_NONE;
}

void models_paint(struct models *models, const struct document *document)
{
    int rig = document_next_rig(document, RIG_CHARACTER, 0);
    for (int i = 0; i < models->character_count && rig >= 0;
         i++, rig = document_next_rig(document, RIG_CHARACTER, rig + 1)) {
        const struct paint *paint = document->rigs[rig].character.painted;
        struct character_model *model = &models->characters[i];
        if (paint && (!model->plain || !models_paint_fits(paint, model->plain))) paint = NULL;
        if (model->version == (paint ? paint->version : 0)) continue;
        if (!model->painted) model->painted = painted_create(model->plain);
        if (!model->painted) continue;
        painted_update(model->painted, paint ? (const float(*)[2])paint->values : NULL);
        model->version = paint ? paint->version : 0;
    }
}

const struct figure *models_figure(const struct models *models, int character)
{
    if (!models || character >= models->character_count) return NULL;
    const struct character_model *model = &models->characters[character];
    return model->painted ? &model->painted->figure : model->plain;
}
