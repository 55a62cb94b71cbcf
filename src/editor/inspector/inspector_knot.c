/// The inspector's section on the selected knot.
#include "editor/core/core.h"
#include "editor/core/knots.h"
#include "editor/core/selection.h"
#include "editor/inspector/inspection.h"
#include <math.h>
#include <stdio.h>

static void change_knot(struct inspection *in, enum ui_change change, const char *label, const char *what,
                        const struct knot *knot)
{
    struct edit edit = core_edit_of(EDIT_KNOT_SET, in->core->active);
    edit.knot = *knot;
    inspector_change(in, change, label, what, &edit);
}

/// Whether another knot sits where this one would go.
static bool is_occupied(const struct inspection *in, const struct spline *spline, const struct knot *knot)
{
    int at = spline_find_knot(in->document, spline, document_sample(in->document, knot->frame));
    return at >= 0 && spline->knots[at].id != knot->id;
}

static void build_frame(struct inspection *in, const struct spline *spline, const struct knot *knot)
{
    const struct document *document = in->document;
    int last = document_last_knot_sample(document, spline);
    bool whole = knot->frame == floor(knot->frame);
    struct ui_number number = {.name = "frame",
                               .label = "frame",
                               .hint = "Frame of the knot",
                               .lowest = document->first_frame,
                               .highest = document_frame(document, last),
                               .fallback = NAN,
                               .step = 1,
                               .decimals = whole ? 0 : 2};
    struct knot next = *knot;
    enum ui_change change = ui_value(in->ui, ui_row(in->ui, UI_ROW), &number, &next.frame);
    if (change == UI_DRAG && is_occupied(in, spline, &next)) return; // stays where it last was free, passing through
    change_knot(in, change, "Move knot", number.name, &next);
}

static void build_value(struct inspection *in, const struct knot *knot)
{
    struct ui_number number = {.name = "value",
                               .label = "value",
                               .hint = "Value of the knot; the curve hits it exactly",
                               .lowest = -INSPECTOR_NO_LIMIT,
                               .highest = INSPECTOR_NO_LIMIT,
                               .fallback = 0,
                               .step = 0.01,
                               .decimals = 3};
    struct knot next = *knot;
    enum ui_change change = ui_value(in->ui, ui_row(in->ui, UI_ROW), &number, &next.value);
    change_knot(in, change, "Set value", number.name, &next);
}

static void build_slope(struct inspection *in, const struct knot *knot)
{
    struct ui *ui = in->ui;
    struct rect r = inspector_labelled(in, "slope");
    struct knot next = *knot;
    if (ui_hovered(ui, r)) ui->hint = "Give the knot a slope (T); D and E turn it";
    if (ui_toggle(ui, r, "has_slope", &next.has_slope)) {
        slopes_set(in->core, in->world, SLOPES_TOGGLE); // the knot is the only selected one
        return;
    }
    r = (struct rect){r.x + 36, r.y, r.w - 36, r.h};
    if (!knot->has_slope) {
        ui_label(ui, r, "free", theme()->text_dim);
        return;
    }
    struct ui_number number = {.name = "slope",
                               .unit = "/s",
                               .hint = "Change per second (D, E)",
                               .lowest = -INSPECTOR_NO_LIMIT,
                               .highest = INSPECTOR_NO_LIMIT,
                               .fallback = 0,
                               .step = 0.05,
                               .decimals = 2};
    enum ui_change change = ui_value(ui, r, &number, &next.slope);
    change_knot(in, change, "Set slope", number.name, &next);
}

static void build_stiffness(struct inspection *in, const struct knot *knot)
{
    struct ui_number number = {.name = "stiffness",
                               .label = "stiffness",
                               .unit = "1/s",
                               .hint = "How firmly the slope holds; 1000 is firm (Shift+D, Shift+E)",
                               .lowest = 0.001,
                               .highest = INSPECTOR_NO_LIMIT,
                               .fallback = 1000,
                               .step = 10,
                               .decimals = knot->stiffness < 10 ? 3 : 1};
    struct knot next = *knot;
    enum ui_change change = ui_value(in->ui, ui_row(in->ui, UI_ROW), &number, &next.stiffness);
    change_knot(in, change, "Set stiffness", number.name, &next);
}

/// What can be done with the slopes of all selected knots.
static void build_slopes(struct inspection *in)
{
    enum { GAP = 4 };
    static const struct {
        const char *name, *label, *hint;
        enum slopes how;
    } buttons[] = {
        {"slope.flat", "Flat", "Make the slopes flat (Shift+T)", SLOPES_FLAT},
        {"slope.smooth", "Smooth", "Aim the slopes at the neighbours, as Catmull-Rom does (Ctrl+T)", SLOPES_SMOOTH},
        {"slope.switch", "On, off", "Switch slopes on, along the curve, or off (T)", SLOPES_TOGGLE},
    };
    struct ui *ui = in->ui;
    struct rect r = ui_row(ui, UI_ROW);
    r.w = (r.w - 2 * GAP) / 3;
    for (size_t i = 0; i < sizeof buttons / sizeof buttons[0]; i++, r.x += r.w + GAP) {
        if (ui_hovered(ui, r)) ui->hint = buttons[i].hint;
        if (ui_button(ui, r, buttons[i].name, buttons[i].label, false))
            slopes_set(in->core, in->world, buttons[i].how);
    }
}

void inspector_knot(struct inspection *in)
{
    struct ui *ui = in->ui;
    const struct spline *spline = core_active_spline(in->core, in->world);
    int count = selection_count(&in->core->selection, spline);
    int single = selection_single(&in->core->selection, spline);
    if (count > 1) {
        char text[64];
        snprintf(text, sizeof text, "%d knots selected.", count);
        ui_paragraph(ui, text, theme()->text_dim);
        inspector_knots(in);
        build_slopes(in);
    } else if (single < 0) {
        ui_paragraph(ui, "Click a knot to edit it. Double-click the curve to insert one.", theme()->text_dim);
    } else {
        // Each is built from the document as the one before left it; ids survive what happens to the order of knots.
        unsigned id = spline->knots[single].id;
        build_frame(in, spline, &spline->knots[single]);
        build_value(in, &spline->knots[spline_find_id(spline, id)]);
        build_slope(in, &spline->knots[spline_find_id(spline, id)]);
        const struct knot *knot = &spline->knots[spline_find_id(spline, id)];
        if (knot->has_slope) build_stiffness(in, knot);
        build_slopes(in);
    }
}
