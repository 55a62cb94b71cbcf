/// Edits of the paint on a character.
#include "scene/edit_plan.h"
#include "scene/paint.h"
#include <math.h>

static struct paint *paint_of(const struct document *document, const struct edit *edit)
{
    return document->rigs[edit->rig].character.painted;
}

bool plan_paint_new(struct document *document, const struct edit *edit, struct change_list *list, struct error *error)
{
    (void)document;
    if (edit->coordinates < 1 || edit->vertices < 1) {
        return fail(error, ERROR_INPUT, "there is nothing to paint on this character");
    }
    struct change change = {.kind = CHANGE_SHEET, .spline = -1};
    change.sheet.rig = edit->rig;
    change.sheet.paint = paint_create(edit->coordinates, edit->vertices);
    if (!change.sheet.paint) return plan_no_memory(error);
    return plan_add(list, &change, error);
}

static bool check_dab(const struct paint *paint, const struct dab *dab, struct error *error)
{
    if (!paint) return fail(error, ERROR_INPUT, "this character has no paint yet");
    if (dab->coordinate < 0 || dab->coordinate >= paint->coordinates) {
        return fail(error, ERROR_INPUT, "there is no such coordinate in the paint");
    }
    for (int i = 0; i < dab->count; i++) {
        const float *value = dab->values[i];
        const bool good = fabsf(value[0]) <= PAINT_MOST_SWELL && fabsf(value[1]) <= PAINT_MOST_LEAD;
        if (!good || dab->vertices[i] < 0 || dab->vertices[i] >= paint->vertices) {
            return fail(error, ERROR_INPUT, "paint must be finite, and on the model");
        }
    }
    return true;
}

/// The open step's stroke on this coordinate, or NULL.
static struct touched *find_stroke(const struct change_list *list, const struct edit *edit)
{
    for (size_t i = list->count; i > 0; i--) {
        const struct change *change = &list->items[i - 1];
        if (change->kind == CHANGE_SHEET) return NULL; // earlier strokes are on other paint
        if (change->kind == CHANGE_PAINT && change->stroke.rig == edit->rig &&
            change->stroke.touched->coordinate == edit->dab->coordinate && change->stroke.touched->place)
            return change->stroke.touched;
    }
    return NULL;
}

/// A stroke is one change however many dabs it has, so that it takes no more memory than what it touches: later dabs join the first.
bool plan_dab(struct document *document, const struct edit *edit, struct change_list *list, struct error *error)
{
    struct paint *paint = paint_of(document, edit);
    if (!check_dab(paint, edit->dab, error)) return false;
    if (edit->dab->count == 0) return true;
    struct touched *stroke = find_stroke(list, edit);
    if (stroke) {
        touched_dab(stroke, paint, edit->dab);
        return true;
    }
    struct change change = {.kind = CHANGE_PAINT, .spline = -1};
    change.stroke.rig = edit->rig;
    change.stroke.touched = touched_create(paint, edit->dab->coordinate);
    if (!change.stroke.touched) return plan_no_memory(error);
    touched_dab(change.stroke.touched, paint, edit->dab);
    touched_swap(change.stroke.touched, paint); // a plan is not carried out yet
    return plan_add(list, &change, error);
}
