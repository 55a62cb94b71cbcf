/// Opens and solves scenes for commands.
#include "rig/opened.h"
#include "rig/import.h"
#include "scene/load.h"
#include "scene/pins.h"

static bool read_models(struct opened *opened, struct error *error)
{
    opened->models = models_create();
    if (scene_read_paint(opened->document, error) && models_update(opened->models, opened->document, error))
        return true;
    opened_free(opened);
    return false;
}

bool opened_read_splines(struct opened *opened, const char *path, struct error *error)
{
    *opened =
        (struct opened){.document = import_suits(path) ? import_scene(path, error) : scene_load(path, NULL, error)};
    if (!opened->document) return false;
    document_note_models(opened->document);
    const bool needs_models = document_has_motions(opened->document) || pins_hold_any(opened->document);
    return !needs_models || read_models(opened, error);
}

bool opened_read(struct opened *opened, const char *path, struct error *error)
{
    return opened_read_splines(opened, path, error) && (opened->models || read_models(opened, error));
}

void opened_solve(struct opened *opened, enum solver_choice solver)
{
    opened->evaluation.solver = solver;
    opened->evaluation.models = models_source(opened->models);
    evaluation_update(&opened->evaluation, opened->document, false);
}

void opened_free(struct opened *opened)
{
    evaluation_free(&opened->evaluation);
    models_destroy(opened->models);
    document_destroy(opened->document);
    *opened = (struct opened){0};
}

struct posing opened_posing(const struct opened *opened)
{
    return (struct posing){.document = opened->document, .evaluation = &opened->evaluation, .models = opened->models};
}
