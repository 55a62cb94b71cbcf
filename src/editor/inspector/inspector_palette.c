/// The palette of a spline's colour: the theme's six, a typed one, or none of its own.
#include "editor/core/arrange.h"
#include "editor/core/core.h"
#include "editor/inspector/inspection.h"
#include "scene/color.h"
#include <stdio.h>

enum { SWATCH = 28, WIDTH = THEME_SPLINE_COLORS * SWATCH + 20 };

static const char palette[] = "palette", hex_line[] = "color.hex";

static void set_color(struct inspection *in, int spline, int color)
{
    struct edit edit = core_edit_of(EDIT_SPLINE_COLOR, spline);
    edit.color = color;
    core_step(in->core, in->world, "Set colour", 0, &edit);
}

/// true where one of the theme's was picked.
static bool build_theme(struct inspection *in, int spline, struct rect r)
{
    uint32_t present = arrange_color(in->document, spline);
    bool picked = false;
    for (int i = 0; i < THEME_SPLINE_COLORS; i++) {
        char name[24];
        snprintf(name, sizeof name, "color.%d", i);
        struct rect field = {r.x + (float)(i * SWATCH), r.y, SWATCH, SWATCH};
        if (!ui_color(in->ui, field, name, theme()->spline[i], theme()->spline[i] == present)) continue;
        set_color(in, spline, (int)theme_spline_rgb(i));
        picked = true;
    }
    return picked;
}

/// "#RRGGBB", typed over; nonsense is said and changes nothing.
static void build_typed(struct inspection *in, int spline, struct rect r)
{
    struct ui *ui = in->ui;
    char text[COLOR_TEXT_SIZE];
    int color;
    int stored = in->document->splines[spline].color;
    color_print(stored < 0 ? (int)theme_spline_rgb(spline % THEME_SPLINE_COLORS) : stored, text);
    if (!ui_line_is_open(ui, hex_line)) {
        if (ui_button(ui, r, "color.type", text, false)) ui_line_begin(ui, hex_line, text);
        return;
    }
    if (ui_line(ui, r, hex_line) != UI_LINE_DONE) return;
    if (color_parse(ui->text.bytes, &color)) {
        set_color(in, spline, color);
    } else {
        snprintf(ui->complaint, sizeof ui->complaint, "colour: expected something like #FFB000, got “%.40s”",
                 ui->text.bytes);
    }
}

void inspector_palette(struct inspection *in)
{
    struct ui *ui = in->ui;
    if (!ui_popup_is_open(ui, palette)) return;
    int spline = document_find_spline_id(in->document, (unsigned)ui->popup.which);
    if (spline < 0) return;
    ui_popup_begin(ui, WIDTH, SWATCH + UI_ROW + 8);
    struct rect r = {ui->scroll_area.x + 6, ui->y + 2, THEME_SPLINE_COLORS * SWATCH, SWATCH};
    bool picked = build_theme(in, spline, r);
    struct rect typed = {r.x, r.y + SWATCH + 2, 86, UI_ROW}, none = {r.x + 92, typed.y, r.w - 92, UI_ROW};
    build_typed(in, spline, typed);
    if (ui_button(ui, none, "color.none", "Default", false)) {
        set_color(in, spline, -1);
        picked = true;
    }
    ui_space(ui, SWATCH + UI_ROW + 8);
    ui_popup_end(ui);
    if (picked) ui_popup_close(ui);
}
