/// The inspector's section on the scene: frame rate, range, substeps, solver.
#include "editor/core/core.h"
#include "editor/inspector/parts.h"
#include <math.h>

enum { ROW_RATE, ROW_FIRST, ROW_LAST, ROW_SUBSTEPS, ROWS };

static const void *document_of(const struct inspector *in) { return in->core->document; }

/// Rate and range ask before they move knots.
static bool set(struct inspector *in, int which, double number, struct error *error)
{
    const struct document *document = in->core->document;
    const int whole = (int)lround(number);
    (void)error;
    if (which == ROW_RATE) spline_list_fps(in->core, number);
    if (which == ROW_FIRST) spline_list_range(in->core, whole, document->last_frame);
    if (which == ROW_LAST) spline_list_range(in->core, document->first_frame, whole);
    if (which == ROW_SUBSTEPS && core_begin(in->core, "Set substeps", 0))
        core_end(in->core, edit_substeps(in->core->document, whole, &in->core->error));
    return true;
}

static const struct number_row rows[ROWS] = {
    [ROW_RATE] = {"scene.fps", "rate", "fps", "Frames per second; asks whether to keep frames or seconds", NULL,
                  NUMBER_AT(struct document, fps), 0, 0, 0.001, SCENE_MAX_FPS, 24, 1, 0},
    [ROW_FIRST] = {"scene.first", "first", NULL, "First frame of the scene", NULL,
                   WHOLE_AT(struct document, first_frame), 0, 0, -SCENE_MAX_FRAME, SCENE_MAX_FRAME, NAN, 1, 0},
    [ROW_LAST] = {"scene.last", "last", NULL, "Last frame of the scene; in a loop it repeats the first", NULL,
                  WHOLE_AT(struct document, last_frame), 0, 0, -SCENE_MAX_FRAME, SCENE_MAX_FRAME, NAN, 1, 0},
    [ROW_SUBSTEPS] = {"scene.substeps", "substeps", NULL, "Samples per frame, for motion blur", NULL,
                      WHOLE_AT(struct document, substeps), 0, 0, 1, SCENE_MAX_SUBSTEPS, 1, 1, 0},
};

static void build_solver(struct inspector *in)
{
    const struct rect r = inspector_labelled(in, "solver");
    ui_hint(&in->ui, r,
            "Band: all samples at once, as in the paper. Chain: from knot to knot, beyond 4096 samples or 300 "
            "without a knot");
    if (in->core->evaluation) ui_label(&in->ui, r, evaluation_solver(in->core->evaluation), theme()->text);
}

void inspector_scene(struct inspector *in)
{
    static const struct number_home home = {.of = document_of, .set = set, .settles = true};
    for (int i = 0; i < ROWS; i++) {
        struct number_row row = rows[i];
        const double longest = document_longest(in->core->document);
        if (i == ROW_RATE && in->core->document->fps != floor(in->core->document->fps)) row.decimals = 3;
        if (i == ROW_FIRST) row.lowest = fmax(row.lowest, in->core->document->last_frame - longest);
        if (i == ROW_LAST) row.highest = fmin(row.highest, in->core->document->first_frame + longest);
        inspector_number(in, &row, &home, i, ui_row(&in->ui, UI_ROW));
    }
    build_solver(in);
}
