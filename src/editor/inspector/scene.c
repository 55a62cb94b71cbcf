/// The inspector's section on the scene: frames per second, range and substeps; and how it is solved.
#include "editor/core/core.h"
#include "editor/core/spline_list.h"
#include "editor/inspector/inspection.h"
#include <math.h>
#include <stdio.h>

/// A number that is taken over when it is let go of, because it may ask before. Returns whether `*value` is a new one.
static bool build_settled(struct inspection *in, struct ui_number number, double *value)
{
    struct inspector *inspector = in->inspector;
    char shown[64];
    bool dragged = ui_is_dragged(in->ui, number.name) && inspector->dragged_name == number.name;
    if (dragged) {
        snprintf(shown, sizeof shown, "%g%s%s", inspector->dragged, number.unit ? " " : "",
                 number.unit ? number.unit : "");
        number.shown = shown;
        *value = inspector->dragged;
    }
    switch (ui_value(in->ui, ui_row(in->ui, UI_ROW), &number, value)) {
    case UI_DRAG:
        inspector->dragged_name = number.name;
        inspector->dragged = *value;
        return false;
    case UI_DROP:
        *value = inspector->dragged;
        return inspector->dragged_name == number.name;
    case UI_SET:
    case UI_NUDGE:
        return true;
    default:
        return false;
    }
}

/// The same for whole numbers; what is typed with a fraction is refused.
static bool build_whole(struct inspection *in, struct ui_number number, int *whole)
{
    double value = *whole;
    if (!build_settled(in, number, &value)) return false;
    if (value != floor(value)) {
        snprintf(in->ui->complaint, sizeof in->ui->complaint, "%s: expected a whole number, got %g", number.label,
                 value);
        return false;
    }
    *whole = (int)value;
    return true;
}

static void build_substeps(struct inspection *in)
{
    int substeps = in->document->substeps;
    struct ui_number number = {.name = "scene.substeps",
                               .label = "substeps",
                               .hint = "Samples per frame, for motion blur",
                               .lowest = 1,
                               .highest = SCENE_MAX_SUBSTEPS,
                               .fallback = 1,
                               .step = 1};
    if (!build_whole(in, number, &substeps)) return;
    if (core_begin(in->core, in->world, "Set substeps", 0))
        core_end(in->core, in->world, edit_substeps(in->document, substeps, &in->core->error));
}

static void build_solver(struct inspection *in)
{
    const struct rect r = inspector_labelled(in, "solver");
    ui_hint(in->ui, r,
            "Band: all samples at once, as in the paper. Chain: stretches between knots, beyond 4096 samples");
    if (in->world->evaluation) ui_label(in->ui, r, evaluation_solver(in->world->evaluation), theme()->text);
}

void inspector_scene(struct inspection *in)
{
    const struct document *document = in->document;
    double fps = document->fps;
    int first = document->first_frame, last = document->last_frame, longest = document_longest(document);
    struct ui_number rate = {.name = "scene.fps",
                             .label = "rate",
                             .unit = "fps",
                             .hint = "Frames per second; asks whether to keep frames or seconds",
                             .lowest = 0.001,
                             .highest = SCENE_MAX_FPS,
                             .fallback = 24,
                             .step = 1,
                             .decimals = fps == floor(fps) ? 0 : 3};
    if (build_settled(in, rate, &fps)) spline_list_fps(in->core, in->world, fps);
    struct ui_number end = {.name = "scene.first",
                            .label = "first",
                            .hint = "First frame of the scene",
                            .lowest = fmax(-SCENE_MAX_FRAME, (double)last - longest),
                            .highest = SCENE_MAX_FRAME,
                            .fallback = NAN,
                            .step = 1};
    if (build_whole(in, end, &first)) spline_list_range(in->core, in->world, first, last);
    end.name = "scene.last";
    end.lowest = -SCENE_MAX_FRAME;
    end.highest = fmin(SCENE_MAX_FRAME, (double)document->first_frame + longest);
    end.label = "last";
    end.hint = "Last frame of the scene; in a loop it repeats the first";
    if (build_whole(in, end, &last)) spline_list_range(in->core, in->world, document->first_frame, last);
    build_substeps(in);
    build_solver(in);
}
