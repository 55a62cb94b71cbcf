/// `wiggly check`: reports every problem of a scene, its solution and its models, and what a character holds.
#include "base/error.h"
#include "commands/commands.h"
#include "commands/report.h"
#include "rig/import.h"
#include "scene/load.h"
#include "scene/warnings.h"
#include <math.h>
#include <stdio.h>

/// Degrees or metres between the start and end of a looping clip.
static const double MOTION_SLACK = 1e-3;

static void print_problem(void *user, bool is_error, const char *sentence)
{
    (void)user;
    print_line(stdout, "%s%s", is_error ? "" : "warning: ", sentence);
}

int command_check(int argc, char **argv)
{
    const char *path;
    const struct usage usage = {
        .command = "check",
        .operands = "scene.json",
        .summary = "Prints every problem in a scene file, with its line, or a character's clips, bones and chains.",
        .options = (const struct option_spec[]){{0}},
    };
    const int result = options_parse(&usage, argc, argv, &path);
    if (result != OPTIONS_RUN) return result;
    struct error error = {0};
    if (import_suits(path)) {
        struct imported imported;
        int triangles = 0;
        if (!imported_read(&imported, path, &error)) return options_end(false, &error);
        const struct gltf *gltf = &imported.gltf;
        for (int m = 0; m < gltf->mesh_count; m++) {
            for (int p = 0; p < gltf->meshes[m].part_count; p++)
                triangles += gltf->meshes[m].parts[p].index_count / 3;
        }
        const int joints = gltf->skin_count > 0 ? imported.skeleton.own : 0;
        print_line(stdout, "%s: a glTF character of %d triangle%s and %d joint%s", path, triangles,
                   triangles == 1 ? "" : "s", joints, joints == 1 ? "" : "s");
        contents_print(&imported);
        imported_free(&imported);
        return 0;
    }

    // It goes on where paint, a model, something the scene names in one, or the background is missing.
    struct problems problems = {.report = print_problem};
    struct opened opened = {.document = scene_load(path, &problems, &error)};
    if (!opened.document) return (int)error.kind;
    opened.models = models_create();
    const bool good = scene_read_paint(opened.document, &error) &&
                      models_update(opened.models, opened.document, &error) &&
                      background_follow(models_background(opened.models), opened.document, false, &error);
    if (!good) print_line(stdout, "%s: %s", path, error.text);

    const struct document *document = opened.document;
    const struct evaluation *evaluation = &opened.evaluation;
    opened_solve(&opened, SOLVER_BY_LENGTH);
    for (int i = 0; i < evaluation->count; i++) {
        const struct spline *spline = document->splines[i];
        struct warnings found = {0}; // poses that force the swing, or send it far beyond the knots
        char text[WARNING_SENTENCE];
        warnings_add_far(document, evaluation, i, &found);
        warnings_add_forced(document, evaluation, i, &found);
        for (int k = 0; k < found.count; k++) {
            warning_say(&found.list[k], text);
            print_line(stdout, "warning: %s: splines[%d]: \"%s\": %s", path, i, spline->name, text);
        }

        // A loop whose equilibrium ends elsewhere than it starts jumps.
        const struct param *equilibrium = &spline->parameter[PARAMETER_EQUILIBRIUM];
        const double *y = equilibrium->track >= 0 ? evaluation->curves[equilibrium->track].total
                          : equilibrium->motion   ? evaluation_motion(evaluation, i)
                                                  : NULL;
        if (spline_start(spline) != WIGGLY_LOOP || !y) continue;
        const double slack = equilibrium->motion ? MOTION_SLACK * fabs(equilibrium->motion->gain) : 0;
        if (fabs(y[0] - y[evaluation->samples - 1]) <= slack) continue;
        print_line(stdout,
                   "warning: %s: splines[%d]: \"%s\": the equilibrium of this loop does not end where it starts",
                   path, i, spline->name);
    }
    solution_warnings(document, evaluation, path, stdout);
    opened_free(&opened);
    return good ? 0 : ERROR_INPUT;
}
