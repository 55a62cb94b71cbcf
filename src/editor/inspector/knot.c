/// The inspector's section on the selected knots. Of several, a typed number is all of theirs, a drag or an arrow moves each by
/// the same; frames keep their distances either way.
#include "editor/core/core.h"
#include "editor/core/knots.h"
#include "editor/core/selected_knots.h"
#include "editor/inspector/inspection.h"
#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

struct knot_field {
    struct ui_number number;
    const char *undo, *undo_one, *hint_one; ///< the last two where one knot alone is selected
    size_t offset;                          ///< of the number in struct knot
    bool moves; ///< what is typed is the first knot's; the others keep their distance to it
};

enum { FIELD_FRAME, FIELD_VALUE, FIELD_SLOPE, FIELD_STIFFNESS, FIELDS };

static const struct knot_field fields[FIELDS] = {
    [FIELD_FRAME] = {.number = {.name = "frame",
                                .label = "frame",
                                .hint = "Frame of the first selected knot; the others move with it",
                                .lowest = -SCENE_MAX_FRAME,
                                .highest = SCENE_MAX_FRAME,
                                .fallback = NAN,
                                .step = 1},
                     .undo = "Move knots",
                     .undo_one = "Move knot",
                     .hint_one = "Frame of the knot",
                     .offset = offsetof(struct knot, frame),
                     .moves = true},
    [FIELD_VALUE] = {.number = {.name = "value",
                                .label = "value",
                                .hint = "Type to set all selected knots; drag to shift each by the same amount",
                                .lowest = -INSPECTOR_NO_LIMIT,
                                .highest = INSPECTOR_NO_LIMIT,
                                .fallback = 0,
                                .step = 0.01,
                                .decimals = 3},
                     .undo = "Set values",
                     .undo_one = "Set value",
                     .hint_one = "Value of the knot; the curve hits it exactly",
                     .offset = offsetof(struct knot, value)},
    [FIELD_SLOPE] = {.number = {.name = "slope",
                                .label = "slope",
                                .unit = "/s",
                                .hint = "Type to set all selected knots; drag to shift each by the same amount",
                                .lowest = -INSPECTOR_NO_LIMIT,
                                .highest = INSPECTOR_NO_LIMIT,
                                .fallback = 0,
                                .step = 0.05,
                                .decimals = 2},
                     .undo = "Set slopes",
                     .undo_one = "Set slope",
                     .hint_one = "Change per second (D, E)",
                     .offset = offsetof(struct knot, slope)},
    [FIELD_STIFFNESS] = {.number = {.name = "stiffness",
                                    .label = "stiffness",
                                    .unit = "1/s",
                                    .hint = "How firmly the slopes hold; 1000 is firm",
                                    .lowest = 0.001,
                                    .highest = INSPECTOR_NO_LIMIT,
                                    .fallback = KNOT_DEFAULT_STIFFNESS,
                                    .step = 10,
                                    .decimals = 1},
                         .undo = "Set stiffness",
                         .undo_one = "Set stiffness",
                         .hint_one = "How firmly the slope holds; 1000 is firm (Shift+D, Shift+E)",
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

/// Gives every collected knot the number, or moves it by what the first one moves; in the order in which no knot meets
/// another of them. false with a sentence where one cannot go there.
static bool set_all(struct inspection *in, const struct knot_field *field, double value, bool together,
                    struct error *error)
{
    struct originals *originals = &in->core->originals;
    double by = value - number_of(field, &originals->list[0].knot);
    for (int i = 0; i < originals->count; i++) {
        const struct original *original = &originals->list[by > 0 ? originals->count - 1 - i : i];
        struct knot knot = original->knot;
        const double number = together ? number_of(field, &knot) + by : value;
        set_number(field, &knot, fmax(field->number.lowest, number));
        if (!edit_knot_set(in->document, original->spline, &knot, error)) return false;
    }
    return true;
}

/// A drag stays where it last was possible; anything else that is not possible is said and changes nothing.
static void change_all(struct inspection *in, enum ui_change change, const struct knot_field *field, const char *undo,
                       double value)
{
    double *possible = &in->inspector->dragged;
    const bool is_drag = change == UI_DRAG, is_first = is_drag && !history_is_open(in->world->history);
    const bool together = change != UI_SET || field->moves;
    if (!inspector_begin(in, change, undo, field->number.name)) return;
    core_collect(in->core, in->document, false);
    if (is_first) *possible = number_of(field, &in->core->originals.list[0].knot);
    const bool done = set_all(in, field, value, together, is_drag ? NULL : &in->core->error);
    if (done) {
        *possible = value;
    } else if (is_drag) {
        history_restart(in->world->history);
        set_all(in, field, *possible, together, NULL);
    }
    inspector_end(in, change, done);
}

/// What the selected knots have in a field: the first one's number, and whether others have another.
struct numbers {
    int count;
    double first;
    bool mixed;
};

static struct numbers survey(const struct inspection *in, const struct knot_field *field)
{
    struct numbers numbers = {.first = NAN};
    for (struct knot_place at = SELECTED_START; selected_next(in->core, in->document, &at); numbers.count++) {
        double number = number_of(field, knot_at(in->document, at));
        if (isnan(numbers.first)) numbers.first = number;
        numbers.mixed |= number != numbers.first;
    }
    return numbers;
}

/// Where one knot alone is selected, its field knows more.
static void fit_to_one(const struct inspection *in, int which, double value, struct ui_number *number)
{
    number->hint = fields[which].hint_one;
    if (which == FIELD_FRAME) {
        const struct spline *spline = core_active_spline(in->core, in->world);
        number->lowest = in->document->first_frame;
        number->highest = document_frame(in->document, document_last_knot_sample(in->document, spline));
        number->decimals = value == floor(value) ? 0 : 2;
    }
    if (which == FIELD_SLOPE) number->label = NULL; // before its switch
    if (which == FIELD_STIFFNESS && value < 10) number->decimals = 3;
}

static void build_field(struct inspection *in, int which, struct rect r)
{
    const struct knot_field *field = &fields[which];
    const struct numbers numbers = survey(in, field); // as the field before left the document
    struct ui_number number = field->number;
    double value = numbers.first;
    char shown[64];
    if (numbers.count == 0) return;
    if (numbers.count == 1) {
        fit_to_one(in, which, value, &number);
    } else if (field->moves) {
        snprintf(shown, sizeof shown, "%.6g …", value);
        number.shown = shown;
    } else if (numbers.mixed) {
        number.shown = "mixed";
    }
    const char *undo = numbers.count == 1 ? field->undo_one : field->undo;
    const enum ui_change change = ui_value(in->ui, r, &number, &value);
    change_all(in, change, field, undo, value);
    if (inspector_changed(change)) core_edited(in->core, -1);
}

static bool all_sloped(const struct inspection *in)
{
    bool sloped = true;
    for (struct knot_place at = SELECTED_START; selected_next(in->core, in->document, &at);)
        sloped &= knot_at(in->document, at)->has_slope;
    return sloped;
}

/// A row without anything to set yet.
static void build_idle(struct inspection *in, const char *label, const char *text)
{
    ui_label(in->ui, inspector_labelled(in, label), text, theme()->text_dim);
}

static void build_several(struct inspection *in)
{
    const bool sloped = all_sloped(in);
    for (int i = 0; i < FIELDS; i++) {
        if (i >= FIELD_SLOPE && !sloped) {
            build_idle(in, fields[i].number.label, i == FIELD_SLOPE ? "not all have one" : "–");
        } else {
            build_field(in, i, ui_row(in->ui, UI_ROW));
        }
    }
}

static bool has_slope(const struct inspection *in, unsigned id)
{
    const struct spline *spline = core_active_spline(in->core, in->world);
    return spline->knots[spline_find_id(spline, id)].has_slope;
}

static void build_slope(struct inspection *in, unsigned id)
{
    struct ui *ui = in->ui;
    struct rect r = inspector_labelled(in, "slope");
    bool sloped = has_slope(in, id);
    ui_hint(ui, r, "Give the knot a slope (T); D and E turn it");
    if (ui_toggle(ui, r, "has_slope", &sloped)) {
        slopes_set(in->core, in->world, SLOPES_TOGGLE); // the knot is the only selected one
        return;
    }
    r = (struct rect){r.x + 36, r.y, r.w - 36, r.h};
    if (sloped) {
        build_field(in, FIELD_SLOPE, r);
    } else {
        ui_label(ui, r, "free", theme()->text_dim);
    }
}

struct knot_button {
    const char *name, *label, *hint;
};

/// A row of three buttons; the one that was pressed, or -1.
static int build_buttons(struct inspection *in, const struct knot_button buttons[3])
{
    enum { GAP = 4 };
    struct rect r = ui_row(in->ui, UI_ROW);
    int pressed = -1;
    r.w = (r.w - 2 * GAP) / 3;
    for (int i = 0; i < 3; i++, r.x += r.w + GAP) {
        ui_hint(in->ui, r, buttons[i].hint);
        if (ui_button(in->ui, r, buttons[i].name, buttons[i].label, false)) pressed = i;
    }
    return pressed;
}

/// What can be done with the slopes of all selected knots.
static void build_slopes(struct inspection *in, bool sloped)
{
    static const enum slopes how[] = {SLOPES_FLAT, SLOPES_SMOOTH, SLOPES_TOGGLE};
    const int pressed = build_buttons(
        in, (const struct knot_button[3]){
                {"slope.flat", "Flat", "Make the slopes flat (Shift+T)"},
                {"slope.smooth", "Smooth", "Aim the slopes at the neighbours, as Catmull-Rom does (Ctrl+T)"},
                {"slope.switch", sloped ? "Remove" : "Add",
                 sloped ? "Let go of the slopes (T)" : "Give the knots the slope that the curve has there (T)"}});
    if (pressed >= 0) slopes_set(in->core, in->world, (int)how[pressed]);
}

/// Nothing is selected: what knots there are, and what can be done without pointing at one.
static void build_overview(struct inspection *in, const struct spline *spline)
{
    char frames[64] = "none", values[64] = "–";
    double range[2];
    if (spline->knot_count > 0) {
        spline_values(spline, 0, spline->knot_count, range);
        const bool one = spline->knot_count == 1;
        snprintf(frames, sizeof frames, one ? "%d, frame %.6g" : "%d, frames %.6g … %.6g", spline->knot_count,
                 spline->knots[0].frame, spline->knots[spline->knot_count - 1].frame);
        snprintf(values, sizeof values, one ? "%.4g" : "%.4g … %.4g", range[0], range[1]);
    }
    ui_paragraph(in->ui, "Click a knot to edit it. Double-click the curve to insert one.", theme()->text_dim);
    build_idle(in, "knots", frames);
    build_idle(in, "values", values);
    const int pressed =
        build_buttons(in, (const struct knot_button[3]){
                              {"knot.insert", "Insert", "Insert a knot on the curve at the playhead (I)"},
                              {"knot.next", "Next", "Go to the next knot after the playhead (Alt+.)"},
                              {"knot.all", "All", "Select all knots of the spline (Ctrl+A)"},
                          });
    if (pressed == 0) core_insert_on_curve(in->core, in->world, core_frame(in->core, in->document), true, false);
    if (pressed == 1 && !core_visit_neighbour(in->core, in->world, 1))
        core_message(in->core, false, "There is no knot after the playhead.");
    if (pressed == 2) core_select_all(in->core, in->world, false);
}

const char *inspector_knot_title(struct inspection *in)
{
    const int count = selected_count(in->core, in->document);
    if (count < 2) return "Knot";
    snprintf(in->inspector->knot_title, sizeof in->inspector->knot_title, "%d knots", count);
    return in->inspector->knot_title;
}

/// Takes the same room whatever is selected, so that nothing below it moves.
void inspector_knot(struct inspection *in)
{
    struct ui *ui = in->ui;
    const struct spline *spline = core_active_spline(in->core, in->world);
    const int count = selected_count(in->core, in->document);
    struct knot_place only = SELECTED_START;
    const bool one = count == 1 && selected_next(in->core, in->document, &only) && only.spline == in->core->active;
    const float end = ui->y + (FIELDS + 1) * UI_ROW;
    if (count > 1) {
        build_several(in);
        build_slopes(in, all_sloped(in));
    } else if (!one) {
        build_overview(in, spline);
    } else {
        // Each is built from the document as the one before left it; ids survive what happens to the order of knots.
        const unsigned id = spline->knots[only.knot].id;
        build_field(in, FIELD_FRAME, ui_row(ui, UI_ROW));
        build_field(in, FIELD_VALUE, ui_row(ui, UI_ROW));
        build_slope(in, id);
        if (has_slope(in, id)) {
            build_field(in, FIELD_STIFFNESS, ui_row(ui, UI_ROW));
        } else {
            build_idle(in, "stiffness", "–");
        }
        build_slopes(in, has_slope(in, id));
    }
    ui->y = end;
}
