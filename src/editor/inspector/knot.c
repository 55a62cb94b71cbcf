/// The sections on the selected knots and on pins. A number typed for several knots sets all of them; a drag or an arrow moves all by the
/// same amount. Frames keep their distances either way.
#include "base/names.h"
#include "editor/core/bones.h"
#include "editor/core/core.h"
#include "editor/core/knots.h"
#include "editor/core/pins.h"
#include "editor/core/selection.h"
#include "editor/inspector/state.h"
#include "scene/pins.h"
#include <math.h>
#include <stddef.h>
#include <stdio.h>

enum { FIELD_FRAME, FIELD_VALUE, FIELD_PHASE, FIELD_SLOPE, FIELD_STIFFNESS, FIELDS };

static const struct number_row knot_rows[FIELDS] = {
    [FIELD_FRAME] = {NUMBER_AT(struct knot, frame), .name = "frame", .label = "frame",
                     .hint = "Frame of the first selected knot; the others move with it", .undo = "Move knots",
                     TYPED(-SCENE_MAX_FRAME, SCENE_MAX_FRAME), .fallback = NAN, .step = 1},
    [FIELD_VALUE] = {NUMBER_AT(struct knot, value), .name = "value", .label = "value",
                     .hint = "Type to set all selected knots; drag to shift each by the same amount",
                     .undo = "Set values", TYPED(-INSPECTOR_NO_LIMIT, INSPECTOR_NO_LIMIT), .step = 0.01,
                     .decimals = 3},
    [FIELD_PHASE] = {NUMBER_AT(struct knot, phase), .name = "phase", .label = "phase",
                     .hint = "Type to set all selected knots; drag to shift each by the same amount",
                     .undo = "Set phases", TYPED(-INSPECTOR_NO_LIMIT, INSPECTOR_NO_LIMIT), .step = 0.01,
                     .decimals = 3},
    [FIELD_SLOPE] = {NUMBER_AT(struct knot, slope), .name = "slope", .label = "slope", .unit = "/s",
                     .hint = "Type to set all selected knots; drag to shift each by the same amount",
                     .undo = "Set slopes", TYPED(-INSPECTOR_NO_LIMIT, INSPECTOR_NO_LIMIT), .step = 0.05,
                     .decimals = 2},
    [FIELD_STIFFNESS] = {NUMBER_AT(struct knot, stiffness), .name = "stiffness", .label = "stiffness", .unit = "1/s",
                         .hint = "How firmly the slopes hold; 1000 is firm", .undo = "Set stiffness",
                         TYPED(0.001, INSPECTOR_NO_LIMIT), .fallback = KNOT_DEFAULT_STIFFNESS, .step = 10,
                         .decimals = 1},
};

/// The fields for a single selected knot.
static const struct {
    const char *undo, *hint;
} of_one[FIELDS] = {
    [FIELD_FRAME] = {"Move knot", "Frame of the knot"},
    [FIELD_VALUE] = {"Set value", "Value of the knot; the curve hits it exactly"},
    [FIELD_PHASE] = {"Set phase", "Phase of a pose, which holds every part that lags (P)"},
    [FIELD_SLOPE] = {"Set slope", "Change per second (D, E)"},
    [FIELD_STIFFNESS] = {"Set stiffness", "How firmly the slope holds; 1000 is firm (Shift+D, Shift+E)"},
};

static double get_knots(const struct inspector *in, int field)
{
    (void)field;
    return in->knots.first;
}

/// Sets the number of all selected knots, or moves them along with the first, in an order in which they do not collide. false with an error
/// if one cannot go there.
static bool set_knots(struct inspector *in, int field, double value, struct error *error)
{
    const struct originals *originals = &in->core->originals;
    core_collect(in->core, false);
    const double by = value - number_at(&knot_rows[field], &originals->list[0].knot);
    const bool together = in->change != UI_SET || field == FIELD_FRAME;
    for (int i = 0; i < originals->count; i++) {
        const struct original *original = &originals->list[by > 0 ? originals->count - 1 - i : i];
        struct knot knot = original->knot;
        const double number = together ? number_at(&knot_rows[field], &knot) + by : value;
        number_put(&knot_rows[field], &knot, fmax(knot_rows[field].lowest, number));
        if (!edit_knot_set(in->core->document, original->spline, &knot, error)) return false;
    }
    return true;
}

static const char *show_several(const struct inspector *in, int field, char text[64])
{
    if (in->knots.count == 1) return NULL;
    if (field != FIELD_FRAME) return in->knots.mixed ? "mixed" : NULL;
    snprintf(text, 64, "%.6g …", in->knots.first);
    return text;
}

static void build_knots(struct inspector *in, int field, struct rect r)
{
    static const struct number_home home = {.get = get_knots, .set = set_knots, .shown = show_several};
    struct number_row row = knot_rows[field];
    struct knot_numbers *numbers = &in->knots;
    *numbers = (struct knot_numbers){.first = NAN}; // after the edit of the previous field
    for (struct knot_place at = SELECTED_START; selected_next(in->core, &at); numbers->count++) {
        const double number = number_at(&row, knot_at(in->core->document, at));
        if (isnan(numbers->first)) numbers->first = number;
        numbers->mixed |= number != numbers->first;
    }
    if (numbers->count == 0) return;
    if (numbers->count == 1) { // its own hint, limits and decimals
        const double value = numbers->first;
        row.hint = of_one[field].hint;
        row.undo = of_one[field].undo;
        if (field == FIELD_FRAME) {
            const struct spline *spline = core_active_spline(in->core);
            row.lowest = in->core->document->first_frame;
            row.highest = document_frame(in->core->document, document_last_knot_sample(in->core->document, spline));
            row.decimals = value == floor(value) ? 0 : 2;
        }
        if (field == FIELD_SLOPE) row.label = NULL; // its switch has the label
        if (field == FIELD_STIFFNESS && value < 10) row.decimals = 3;
    }
    if (inspector_changed(inspector_number(in, &row, &home, field, r))) core_edited(in->core, -1);
}

static bool all_sloped(const struct inspector *in)
{
    bool sloped = true;
    for (struct knot_place at = SELECTED_START; selected_next(in->core, &at);)
        sloped &= knot_at(in->core->document, at)->has_slope || knot_at(in->core->document, at)->still;
    return sloped;
}

/// What all selected knots hold, or -1. A still pose counts as a pose.
static int all_hold(const struct inspector *in, bool *any_still)
{
    int all = -1;
    *any_still = false;
    for (struct knot_place at = SELECTED_START; selected_next(in->core, &at);) {
        const int holds = (int)knot_holds(knot_at(in->core->document, at));
        *any_still = *any_still || holds == HOLDS_STILL;
        all = all == -1 ? holds : all == holds ? all : HOLDS_STILL + 1;
    }
    return all > HOLDS_STILL ? -1 : all;
}

struct knot_button {
    const char *name, *label, *hint;
    bool lit;
};

/// A row of buttons; returns the pressed one, or -1.
static int build_buttons(struct inspector *in, int count, const struct knot_button *buttons)
{
    enum { GAP = 4 };
    struct rect r = ui_row(&in->ui, UI_ROW);
    int pressed = -1;
    r.w = (r.w - (float)((count - 1) * GAP)) / (float)count;
    for (int i = 0; i < count; i++, r.x += r.w + GAP) {
        ui_hint(&in->ui, r, buttons[i].hint);
        if (ui_button(&in->ui, r, buttons[i].name, buttons[i].label, buttons[i].lit)) pressed = i;
    }
    return pressed;
}

static void build_holds(struct inspector *in)
{
    bool any_still;
    const int lit = all_hold(in, &any_still);
    bool settles = true;
    for (struct knot_place at = SELECTED_START; selected_next(in->core, &at);)
        settles &= knot_at(in->core->document, at)->settles;
    const int pressed = build_buttons(
        in, 4,
        (const struct knot_button[]){
            {"holds.value", "Value", "Hold the value and leave the phase free", lit == HOLDS_VALUE},
            {"holds.pose", "Pose", "Hold every part that lags as it is seen now (P)", lit == HOLDS_POSE},
            {"holds.still", "Still", "The motion comes to rest at the equilibrium, and begins from rest (Shift+P)",
             lit == HOLDS_STILL},
            {"settles", "Settle", "Let the motion stay here: it overshoots the value and swings about it (Alt+P)",
             settles}});
    if (pressed == 3) {
        core_toggle_settles(in->core, 0);
    } else if (pressed >= 0 && pressed != lit) {
        core_set_hold(in->core, pressed);
    }
}

/// A number's row, or a note that there is none.
static void build_or_idle(struct inspector *in, int field, bool there)
{
    if (there) {
        build_knots(in, field, ui_row(&in->ui, UI_ROW));
    } else {
        inspector_idle(in, knot_rows[field].label, "–");
    }
}

/// In the place of a still knot's value.
static void build_at_rest(struct inspector *in)
{
    ui_label(&in->ui, ui_row(&in->ui, UI_ROW), "Comes to rest at the equilibrium", theme()->text_dim);
}

static void build_several(struct inspector *in)
{
    const bool sloped = all_sloped(in);
    bool any_still;
    const int holds = all_hold(in, &any_still);
    for (int i = 0; i < FIELDS; i++) {
        if (i == FIELD_PHASE) build_holds(in);
        if (i >= FIELD_SLOPE && !sloped) {
            inspector_idle(in, knot_rows[i].label, i == FIELD_SLOPE ? "not all have one" : "–");
        } else if (i == FIELD_PHASE && holds != HOLDS_POSE) {
            inspector_idle(in, knot_rows[i].label, "not all hold one");
        } else if (i == FIELD_VALUE && holds == HOLDS_STILL) {
            build_at_rest(in);
        } else if (i == FIELD_VALUE && any_still) {
            inspector_idle(in, knot_rows[i].label, "not all have one");
        } else {
            build_knots(in, i, ui_row(&in->ui, UI_ROW));
        }
    }
}

static bool has_slope(const struct inspector *in, unsigned id)
{
    const struct spline *spline = core_active_spline(in->core);
    return spline->knots[spline_find_id(spline, id)].has_slope;
}

static void build_slope(struct inspector *in, unsigned id)
{
    struct ui *ui = &in->ui;
    struct rect r = inspector_labelled(in, "slope");
    bool sloped = has_slope(in, id);
    ui_hint(ui, r, "Give the knot a slope (T); D and E turn it");
    if (ui_toggle(ui, r, "has_slope", &sloped)) {
        slopes_set(in->core, SLOPES_TOGGLE); // the only selected knot
        return;
    }
    r = (struct rect){r.x + 36, r.y, r.w - 36, r.h};
    if (sloped) {
        build_knots(in, FIELD_SLOPE, r);
    } else {
        ui_label(ui, r, "free", theme()->text_dim);
    }
}

static void build_slopes(struct inspector *in, bool sloped)
{
    static const enum slopes how[] = {SLOPES_FLAT, SLOPES_SMOOTH, SLOPES_TOGGLE};
    const int pressed = build_buttons(
        in, 3,
        (const struct knot_button[]){
            {"slope.flat", "Flat", "Make the slopes flat (Shift+T)", false},
            {"slope.smooth", "Smooth", "Aim the slopes at the neighbours, as Catmull-Rom does (Ctrl+T)", false},
            {"slope.switch", sloped ? "Remove" : "Add",
             sloped ? "Remove the slopes (T)" : "Give the knots the slope that the curve has there (T)", false}});
    if (pressed >= 0) slopes_set(in->core, (int)how[pressed]);
}

/// Without a selection: the spline's knots, and buttons that work without pointing.
static void build_overview(struct inspector *in, const struct spline *spline)
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
    ui_paragraph(&in->ui, "Click a knot to edit it. Double-click the curve to insert one.", theme()->text_dim);
    inspector_idle(in, "knots", frames);
    inspector_idle(in, "values", values);
    const int pressed =
        build_buttons(in, 3,
                      (const struct knot_button[]){
                          {"knot.insert", "Insert", "Insert a knot on the curve at the playhead (I)", false},
                          {"knot.next", "Next", "Go to the next knot after the playhead (Alt+.)", false},
                          {"knot.all", "All", "Select all knots of the spline (Ctrl+A)", false},
                      });
    if (pressed == 0) core_insert_on_curve(in->core, core_frame(in->core), true, false);
    if (pressed == 1) core_visit_neighbour(in->core, 1);
    if (pressed == 2) core_select_all(in->core, false);
}

const char *inspector_knot_title(struct inspector *in)
{
    const int count = selected_count(in->core);
    if (count < 2) return "Knot";
    snprintf(in->knot_title, sizeof in->knot_title, "%d knots", count);
    return in->knot_title;
}

/// Has the same height for every selection, so that nothing below moves.
void inspector_knot(struct inspector *in)
{
    struct ui *ui = &in->ui;
    const struct spline *spline = core_active_spline(in->core);
    const int count = selected_count(in->core);
    struct knot_place only = SELECTED_START;
    const bool one = count == 1 && selected_next(in->core, &only) && only.spline == in->core->active;
    const float end = ui->y + (FIELDS + 2) * UI_ROW;
    if (count > 1) {
        build_several(in);
        build_slopes(in, all_sloped(in));
    } else if (!one) {
        build_overview(in, spline);
    } else {
        // Rows may edit the document and reorder knots; ids stay valid.
        const unsigned id = spline->knots[only.knot].id;
        bool still;
        build_knots(in, FIELD_FRAME, ui_row(ui, UI_ROW));
        const bool posed = all_hold(in, &still) == HOLDS_POSE;
        if (still) {
            build_at_rest(in);
        } else {
            build_knots(in, FIELD_VALUE, ui_row(ui, UI_ROW));
        }
        build_holds(in);
        build_or_idle(in, FIELD_PHASE, posed);
        if (still) {
            inspector_idle(in, "slope", "–");
        } else {
            build_slope(in, id);
        }
        build_or_idle(in, FIELD_STIFFNESS, has_slope(in, id));
        build_slopes(in, has_slope(in, id));
    }
    ui->y = end;
}

enum { MAX_ROWS = 8 }; ///< listed at once

/// The selected pin's row, or 0.
static int selected_row(const struct core *core)
{
    struct pin_place place = PINS_START;
    int row = 0;
    for (const struct pin *pin; core->pin.any && (pin = pins_next(core->document, &place)); row++) {
        if (pin->id == core->pin.id) return row;
    }
    return 0;
}

/// Remaining offset in millimetres; NAN if unknown.
static double left_of(const struct inspector *in, int rig, int at)
{
    const struct pin_left *left = evaluation_pin(in->core->evaluation, in->core->document, rig, at);
    if (!left || !left->is_found) return NAN;
    return 1e3 * sqrt(left->way[0] * left->way[0] + left->way[1] * left->way[1] + left->way[2] * left->way[2]);
}

static const char *word_of(const struct rig *rig) { return rig->kind == RIG_CHARACTER ? "vertex" : "joint"; }

/// true if the pin was removed.
static bool build_row(struct inspector *in, int row, struct pin_place place)
{
    struct ui *ui = &in->ui;
    const struct rig *rig = in->core->document->rigs[place.rig];
    const struct pin *pin = &rig->pins[place.at];
    struct rect r = ui_row(ui, UI_ROW), button = {r.x + r.w - r.h, r.y, r.h, r.h};
    char name[32], remove[32], text[160], left[32] = "";
    snprintf(name, sizeof name, "pin.%d", row);
    snprintf(remove, sizeof remove, "pin.%d.remove", row);
    snprintf(text, sizeof text, "%.6g: %.*s, %s %d", pin->frame, name_fit(rig_title(rig), 60), rig_title(rig),
             word_of(rig), pin->point);
    const double millimetres = left_of(in, place.rig, place.at);
    if (isfinite(millimetres)) snprintf(left, sizeof left, "%.1f mm", millimetres);
    r.w -= r.h + 4;
    const struct rect label = {r.x, r.y, r.w - 60, r.h};
    const bool selected = in->core->pin.any && in->core->pin.id == pin->id;
    const bool pressed = ui_list_row(ui, r, name, "", 0, selected);
    ui_label(ui, (struct rect){label.x + 6, label.y, label.w - 6, label.h}, text, theme()->text);
    ui_label_right(ui, (struct rect){r.x, r.y, r.w - 4, r.h}, left, theme()->text_dim);
    ui_hint(ui, r, "Frame and point of a pin, and how far the point is from it");
    if (pressed) pins_visit(in->core, pin);
    if (!ui_icon_button(ui, button, remove, UI_ICON_DELETE, false, "Remove this pin")) return false;
    return core_begin(in->core, "Delete pin", 0) &&
           core_end(in->core, edit_pin_remove(in->core->document, place.rig, pin->id, &in->core->error));
}

enum { ROW_FRAME, ROW_POINT, PIN_ROWS = ROW_POINT + 4 };

static const struct number_row pin_rows[PIN_ROWS] = {
    {NUMBER_AT(struct pin, frame), .name = "pin.frame", .label = "frame",
     .hint = "Frame of the pin (Alt+PgUp, Alt+PgDn)", .undo = "Move pin in time", .fallback = NAN, .step = 1},
    {WHOLE_AT(struct pin, point), .name = "pin.point", .hint = "The pinned point", .undo = "Pin another point",
     .fallback = NAN, .step = 1},
    {NUMBER_AT(struct pin, to[0]), .name = "pin.x", .label = "x", .unit = "m",
     .hint = "Target of the point: across; 0 is the middle", .undo = "Move pin",
     TYPED(-INSPECTOR_NO_LIMIT, INSPECTOR_NO_LIMIT), .fallback = NAN, .step = 0.005, .decimals = 3},
    {NUMBER_AT(struct pin, to[1]), .name = "pin.y", .label = "y", .unit = "m", .hint = "Target of the point: height",
     .undo = "Move pin", TYPED(-INSPECTOR_NO_LIMIT, INSPECTOR_NO_LIMIT), .fallback = NAN, .step = 0.005,
     .decimals = 3},
    {NUMBER_AT(struct pin, to[2]), .name = "pin.z", .label = "z", .unit = "m", .hint = "Target of the point: depth",
     .undo = "Move pin", TYPED(-INSPECTOR_NO_LIMIT, INSPECTOR_NO_LIMIT), .fallback = NAN, .step = 0.005,
     .decimals = 3},
};

static const void *pin_of(const struct inspector *in)
{
    int rig;
    return pins_selected(in->core, &rig);
}

static bool set_pin(struct inspector *in, int which, double number, struct error *error)
{
    int rig;
    struct pin pin = *pins_selected(in->core, &rig);
    number_put(&pin_rows[which], &pin, number);
    return pins_set(in->core->document, rig, &pin, error);
}

static void build_pin(struct inspector *in, int field)
{
    int rig;
    struct number_row row = pin_rows[field];
    if (!pins_selected(in->core, &rig)) return;
    const struct rig *pinned = in->core->document->rigs[rig];
    if (field == ROW_FRAME) {
        row.lowest = in->core->document->first_frame;
        row.highest = document_frame(in->core->document, pins_last_sample(in->core->document, pinned));
    } else if (field == ROW_POINT) {
        row.label = word_of(pinned);
        const struct figure *figure = models_figure(in->core->models, document_rig_number(in->core->document, rig));
        row.highest = pinned->kind != RIG_CHARACTER ? bones_joints(in->core, rig) - 1
                      : figure                      ? figure->character.vertex_count - 1
                                                    : 0;
    }
    static const struct number_home home = {.of = pin_of, .set = set_pin};
    const enum ui_change change = inspector_number(in, &row, &home, field, ui_row(&in->ui, UI_ROW));
    if (inspector_changed(change)) pins_tell(in->core, rig);
}

void inspector_pins(struct inspector *in)
{
    int rig;
    const int count = pins_count(in->core->document);
    if (count == 0)
        ui_paragraph(&in->ui, "Drag a character's surface on the stage to pin it; on tails and chains, hold Ctrl.",
                     theme()->text_dim);
    const int first = inspector_first_row(count, selected_row(in->core), MAX_ROWS);
    struct pin_place place = PINS_START;
    bool removed = false;
    for (int row = 0; !removed && row < first + MAX_ROWS && pins_next(in->core->document, &place); row++)
        removed = row >= first && build_row(in, row, place);
    if (!removed) inspector_more(in, count, MAX_ROWS, " pins; , and . show more");
    if (!pins_selected(in->core, &rig)) return;
    ui_space(&in->ui, 4);
    for (int field = 0; field < PIN_ROWS; field++) build_pin(in, field);
}
