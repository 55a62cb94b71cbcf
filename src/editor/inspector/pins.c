/// The inspector's section on pins: all pins with their remaining offsets, and the selected one's numbers.
#include "editor/core/pins.h"
#include "base/names.h"
#include "editor/core/bones.h"
#include "editor/core/core.h"
#include "editor/inspector/parts.h"
#include "scene/pins.h"
#include <math.h>
#include <stdio.h>

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

static void build_list(struct inspector *in, int count)
{
    const int first = inspector_first_row(count, selected_row(in->core), MAX_ROWS);
    struct pin_place place = PINS_START;
    for (int row = 0; row < first + MAX_ROWS && pins_next(in->core->document, &place); row++) {
        if (row >= first && build_row(in, row, place)) return;
    }
    inspector_more(in, count, MAX_ROWS, " pins; , and . show more");
}

static int points_of(const struct inspector *in, int rig)
{
    const struct rig *pinned = in->core->document->rigs[rig];
    if (pinned->kind != RIG_CHARACTER) return bones_joints(in->core, rig);
    const struct figure *figure = models_figure(in->core->models, document_rig_number(in->core->document, rig));
    return figure ? figure->character.vertex_count : 1;
}

enum { ROW_FRAME, ROW_POINT, ROWS = ROW_POINT + 4 };

static const struct number_row rows[ROWS] = {
    {"pin.frame", "frame", NULL, "Frame of the pin (Alt+PgUp, Alt+PgDn)", "Move pin in time",
     NUMBER_AT(struct pin, frame), 0, 0, 0, 0, NAN, 1, 0},
    {"pin.point", NULL, NULL, "The pinned point", "Pin another point", WHOLE_AT(struct pin, point), 0, 0, 0, 0, NAN,
     1, 0},
    {"pin.x", "x", "m", "Target of the point: across; 0 is the middle", "Move pin", NUMBER_AT(struct pin, to[0]), 0,
     0, -INSPECTOR_NO_LIMIT, INSPECTOR_NO_LIMIT, NAN, 0.005, 3},
    {"pin.y", "y", "m", "Target of the point: height", "Move pin", NUMBER_AT(struct pin, to[1]), 0, 0,
     -INSPECTOR_NO_LIMIT, INSPECTOR_NO_LIMIT, NAN, 0.005, 3},
    {"pin.z", "z", "m", "Target of the point: depth", "Move pin", NUMBER_AT(struct pin, to[2]), 0, 0,
     -INSPECTOR_NO_LIMIT, INSPECTOR_NO_LIMIT, NAN, 0.005, 3},
};

static const void *selected(const struct inspector *in)
{
    int rig;
    return pins_selected(in->core, &rig);
}

static bool set(struct inspector *in, int which, double number, struct error *error)
{
    int rig;
    struct pin pin = *pins_selected(in->core, &rig);
    number_put(&rows[which], &pin, number);
    return pins_set(in->core->document, rig, &pin, error);
}

static void build_field(struct inspector *in, int field)
{
    int rig;
    struct number_row row = rows[field];
    if (!pins_selected(in->core, &rig)) return;
    const struct rig *pinned = in->core->document->rigs[rig];
    if (field == ROW_FRAME) {
        row.lowest = in->core->document->first_frame;
        row.highest = document_frame(in->core->document, pins_last_sample(in->core->document, pinned));
    } else if (field == ROW_POINT) {
        row.label = word_of(pinned);
        row.highest = points_of(in, rig) - 1;
    }
    static const struct number_home home = {.of = selected, .set = set};
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
    build_list(in, count);
    if (!pins_selected(in->core, &rig)) return;
    ui_space(&in->ui, 4);
    for (int field = 0; field < ROWS; field++) build_field(in, field);
}
