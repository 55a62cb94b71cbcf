/// The inspector's fields of several selected knots at once: a typed number is all of theirs, a drag or an arrow moves each by
/// the same. Frames keep their distances either way.
#include "editor/core/core.h"
#include "editor/core/knots.h"
#include "editor/core/selection.h"
#include "editor/inspector/inspection.h"
#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

struct knot_field {
    struct ui_number number;
    const char *undo;
    size_t offset; ///< of the number in struct knot
    bool moves;    ///< what is typed is the first knot's; the others keep their distance to it
};

static const struct knot_field fields[] = {
    {.number = {.name = "frame",
                .label = "frame",
                .hint = "Frame of the first selected knot; the others move with it",
                .lowest = -SCENE_MAX_FRAME,
                .highest = SCENE_MAX_FRAME,
                .fallback = NAN,
                .step = 1},
     .undo = "Move knots",
     .offset = offsetof(struct knot, frame),
     .moves = true},
    {.number = {.name = "value",
                .label = "value",
                .hint = "Type to set all selected knots; drag to shift each by the same amount",
                .lowest = -INSPECTOR_NO_LIMIT,
                .highest = INSPECTOR_NO_LIMIT,
                .fallback = 0,
                .step = 0.01,
                .decimals = 3},
     .undo = "Set values",
     .offset = offsetof(struct knot, value)},
    {.number = {.name = "slope",
                .label = "slope",
                .unit = "/s",
                .hint = "Type to set all selected knots; drag to shift each by the same amount",
                .lowest = -INSPECTOR_NO_LIMIT,
                .highest = INSPECTOR_NO_LIMIT,
                .fallback = 0,
                .step = 0.05,
                .decimals = 2},
     .undo = "Set slopes",
     .offset = offsetof(struct knot, slope)},
    {.number = {.name = "stiffness",
                .label = "stiffness",
                .unit = "1/s",
                .hint = "How firmly the slopes hold; 1000 is firm",
                .lowest = 0.001,
                .highest = INSPECTOR_NO_LIMIT,
                .fallback = KNOT_DEFAULT_STIFFNESS,
                .step = 10,
                .decimals = 1},
     .undo = "Set stiffness",
     .offset = offsetof(struct knot, stiffness)},
};

static double number_of(const struct knot_field *field, const struct knot *knot)
{
    double number;
    memcpy(&number, (const char *)knot + field->offset, sizeof number);
    return number;
}

static void set_number(const struct knot_field *field, struct knot *knot, double number)
{
    memcpy((char *)knot + field->offset, &number, sizeof number);
}

/// The selected knots as the document has them, in the memory that a drag of knots has for the same: for an edit alone, while
/// none is under way; how many.
static int collect(struct inspection *in)
{
    const struct spline *spline = core_active_spline(in->core, in->world);
    core_collect(in->core, spline);
    return in->core->originals.count;
}

/// Gives every collected knot the number, or moves it by what the first one moves; in the order in which no knot meets
/// another of them. false with a sentence where one cannot go there.
static bool set_all(struct inspection *in, const struct knot_field *field, double value, bool together,
                    struct error *error)
{
    struct originals *originals = &in->core->originals;
    double by = value - number_of(field, &originals->knot[0]);
    for (int i = 0; i < originals->count; i++) {
        struct edit edit = core_edit_of(EDIT_KNOT_SET, in->core->active);
        edit.knot = originals->knot[by > 0 ? originals->count - 1 - i : i];
        double number = together ? number_of(field, &edit.knot) + by : value;
        set_number(field, &edit.knot, fmax(field->number.lowest, number));
        if (!history_apply(in->world->history, in->document, &edit, error)) return false;
    }
    return true;
}

/// A drag stays where it last was possible; anything else that is not possible is said and changes nothing.
static void change_all(struct inspection *in, enum ui_change change, const struct knot_field *field, double value)
{
    struct history *history = in->world->history;
    double *possible = &in->inspector->dragged;
    struct error error = {0};
    inspector_take_back(in, change);
    if ((change != UI_DRAG && history_is_open(history)) || collect(in) == 0) return;
    if (!history_is_open(history)) {
        uint64_t merge = change == UI_NUDGE ? core_merge_key(in->core, in->world, ui_id(field->number.name)) : 0;
        history_begin(history, field->undo, merge);
        *possible = number_of(field, &in->core->originals.knot[0]);
    }
    bool together = change != UI_SET || field->moves;
    if (set_all(in, field, value, together, &error)) {
        *possible = value;
    } else {
        history_restart(history, in->document);
        if (change == UI_DRAG) set_all(in, field, *possible, together, &error);
    }
    if (change == UI_DRAG) return;
    history_end(history);
    if (error.kind != ERROR_NONE) core_message(in->core, true, error.text);
}

/// What the selected knots have in a field: the first one's number, and whether others have another.
struct numbers {
    double first;
    bool mixed;
};

static struct numbers survey(const struct inspection *in, const struct spline *spline, const struct knot_field *field)
{
    struct numbers numbers = {.first = NAN};
    for (int k = 0; k < spline->knot_count; k++) {
        if (!selection_has(&in->core->selection, spline->knots[k].id)) continue;
        double number = number_of(field, &spline->knots[k]);
        if (isnan(numbers.first)) numbers.first = number;
        numbers.mixed |= number != numbers.first;
    }
    return numbers;
}

static void build_field(struct inspection *in, const struct knot_field *field, struct numbers numbers)
{
    struct ui_number number = field->number;
    double value = numbers.first;
    char shown[64];
    if (field->moves) {
        snprintf(shown, sizeof shown, "%.6g …", value);
        number.shown = shown;
    } else if (numbers.mixed) {
        number.shown = "mixed";
    }
    enum ui_change change = ui_value(in->ui, ui_row(in->ui, UI_ROW), &number, &value);
    if (change == UI_DROP || change == UI_CANCEL) {
        inspector_change(in, change, field->undo, number.name, NULL);
    } else if (change != UI_NONE) {
        change_all(in, change, field, value);
    }
}

static bool all_sloped(const struct inspection *in, const struct spline *spline)
{
    bool sloped = true;
    for (int k = 0; k < spline->knot_count; k++)
        sloped &= !selection_has(&in->core->selection, spline->knots[k].id) || spline->knots[k].has_slope;
    return sloped;
}

void inspector_knots(struct inspection *in)
{
    const struct spline *spline = core_active_spline(in->core, in->world);
    bool sloped = all_sloped(in, spline);
    for (size_t i = 0; i < sizeof fields / sizeof fields[0]; i++) {
        bool of_slope =
            fields[i].offset != offsetof(struct knot, frame) && fields[i].offset != offsetof(struct knot, value);
        if (!sloped && of_slope) continue;
        struct numbers numbers = survey(in, spline, &fields[i]); // as the field before left the document
        if (!isnan(numbers.first)) build_field(in, &fields[i], numbers);
    }
}
