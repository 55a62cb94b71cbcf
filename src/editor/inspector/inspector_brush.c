/// The inspector's rows for the brush that paints phase and amplitude onto a character.
#include "editor/core/characters.h"
#include "editor/inspector/inspection.h"

/// Modes of one kind side by side; none is marked where the brush is set to another kind.
static void build_modes(struct inspection *in, const char *name, const char *hint, enum brush_mode first,
                        const struct ui_choice *choices, int count)
{
    struct brush *brush = &in->core->brush;
    const struct rect r = ui_row(in->ui, UI_ROW);
    const int chosen = (int)brush->mode - (int)first;
    int index = chosen >= 0 && chosen < count ? chosen : -1;
    ui_hint(in->ui, r, hint);
    if (ui_segments(in->ui, r, name, choices, count, &index)) brush->mode = (enum brush_mode)((int)first + index);
}

static void build_share(struct inspection *in, const char *name, const char *hint, double fallback, double minimum,
                        double maximum, double *share)
{
    const struct ui_number row = {.name = name,
                                  .label = name,
                                  .unit = "%",
                                  .hint = hint,
                                  .minimum = 100 * minimum,
                                  .maximum = 100 * maximum,
                                  .lowest = 100 * minimum,
                                  .highest = 100 * maximum,
                                  .fallback = 100 * fallback,
                                  .step = 1};
    double percent = 100 * *share;
    const enum ui_change change = ui_value(in->ui, ui_row(in->ui, UI_ROW), &row, &percent);
    if (change == UI_DRAG || change == UI_SET || change == UI_NUDGE) *share = percent / 100;
}

void inspector_brush(struct inspection *in)
{
    static const struct ui_choice switches[] = {{"off", "Off"}, {"on", "Brush"}};
    static const struct ui_choice phase[] = {{"advance", "Advance"}, {"delay", "Delay"}, {"smooth", "Smooth"}};
    static const struct ui_choice amplitude[] = {
        {"more", "Swing more"}, {"less", "Swing less"}, {"smooth", "Smooth"}};
    static const struct ui_choice erase[] = {{"all", "Erase"}};
    struct brush *brush = &in->core->brush;
    struct rect r = inspector_labelled(in, "paint");
    int on = brush->on;
    ui_hint(in->ui, r, "Paint phase and amplitude onto the character (K)");
    if (ui_segments(in->ui, r, "paint", switches, 2, &on)) characters_set_brush(in->core, in->world, on);
    const struct character_rig *rig = characters_selected(in->core, in->world);
    if (brush->on) {
        build_modes(in, "phase", "Move earlier, later, or blend with the surroundings", BRUSH_ADVANCE, phase, 3);
        build_modes(in, "swing", "Swing more, less, or blend with the surroundings", BRUSH_MORE, amplitude, 3);
        build_modes(in, "erase", "Remove paint and restore the model", BRUSH_ERASE, erase, 1);
        build_share(in, "radius", "Radius, relative to the character's height (Ctrl+wheel on the stage)", 0.12, 0.01,
                    0.5, &brush->radius);
        build_share(in, "strength", "How fast paint flows (Shift+wheel on the stage)", 0.4, 0.02, 1,
                    &brush->strength);
    }
    if (!rig || !rig->painted || paint_is_plain(rig->painted)) return;
    r = ui_row(in->ui, UI_ROW);
    ui_hint(in->ui, r, "Back to what the model says, everywhere");
    if (ui_button(in->ui, r, "paint.clean", "Remove all paint", false)) characters_clean_paint(in->core, in->world);
}
