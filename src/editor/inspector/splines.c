/// The inspector's list of splines: names, colours, visibility, order.
#include "base/names.h"
#include "editor/core/core.h"
#include "editor/core/selection.h"
#include "editor/inspector/inspector.h"
#include "editor/inspector/parts.h"
#include "scene/text.h"
#include <math.h>
#include <stdio.h>

enum { MAX_ROWS = 8, SWATCH = 22, KIND = 56 }; ///< splines listed at once; pixels

static const char rename_line[] = "rename";

enum { COLOR = 28, WIDTH = THEME_SPLINE_COLORS * COLOR + 20 };

static const char hex_line[] = "color.hex";

static void set_color(struct inspector *in, int spline, int color)
{
    if (core_begin(in->core, "Set colour", 0))
        core_end(in->core, edit_spline_color(in->core->document, spline, color, &in->core->error));
}

static void build_palette(struct inspector *in, const struct dropdown *list)
{
    (void)list;
    struct ui *ui = &in->ui;
    const int spline = document_find_spline_id(in->core->document, (unsigned)ui->popup.which);
    if (spline < 0) return;
    ui_popup_begin(ui, WIDTH, COLOR + UI_ROW + 8);
    const struct rect r = {ui->scroll_area.x + 6, ui->y + 2, THEME_SPLINE_COLORS * COLOR, COLOR};
    const uint32_t present = spline_list_color(in->core->document, spline);
    bool picked = false;
    for (int i = 0; i < THEME_SPLINE_COLORS; i++) {
        char name[24];
        snprintf(name, sizeof name, "color.%d", i);
        const struct rect field = {r.x + (float)(i * COLOR), r.y, COLOR, COLOR};
        if (!ui_color(ui, field, name, theme()->spline[i], theme()->spline[i] == present)) continue;
        set_color(in, spline, (int)theme_spline_rgb(i));
        picked = true;
    }

    // Typed "#RRGGBB"; anything else shows an error and changes nothing.
    const struct rect typed = {r.x, r.y + COLOR + 2, 86, UI_ROW}, none = {r.x + 92, typed.y, r.w - 92, UI_ROW};
    const int stored = in->core->document->splines[spline]->color;
    char text[COLOR_TEXT_SIZE];
    int color;
    color_print(stored < 0 ? (int)theme_spline_rgb(spline % THEME_SPLINE_COLORS) : stored, text);
    if (!ui_line_is_open(ui, hex_line)) {
        if (ui_button(ui, typed, "color.type", text, false)) ui_line_begin(ui, hex_line, text);
    } else if (ui_line(ui, typed, hex_line) == UI_LINE_DONE) {
        if (color_parse(ui->text.bytes, &color)) {
            set_color(in, spline, color);
        } else {
            snprintf(ui->complaint, sizeof ui->complaint, "colour: expected something like #FFB000, got “%.*s”",
                     name_fit(ui->text.bytes, 40), ui->text.bytes);
        }
    }
    if (ui_button(ui, none, "color.none", "Default", false)) {
        set_color(in, spline, -1);
        picked = true;
    }
    ui_space(ui, COLOR + UI_ROW + 8);
    ui_popup_end(ui);
    if (picked) ui_popup_close(ui);
}

static const struct dropdown palette = {"palette", "Colour of this spline", build_palette};

void inspector_rename(struct inspector *in, int unused)
{
    const struct spline *spline = core_active_spline(in->core);
    (void)unused;
    if (!spline) return;
    inspector_unfold(in, "section.splines");
    in->scroll.offset = 0; // the list is near the top
    ui_line_begin(&in->ui, rename_line, spline->name);
}

/// true if the row was dropped after a drag.
static bool build_row(struct inspector *in, int s, struct rect r)
{
    struct ui *ui = &in->ui;
    struct core *core = in->core;
    const struct spline *spline = core->document->splines[s];
    bool active = s == core->active, dropped = false;
    char name[UI_NAME_SIZE];
    snprintf(name, sizeof name, "spline.%s", spline->name);
    const float right = core->more ? 2 * INSPECTOR_ICON : KIND;
    struct rect label = {r.x + SWATCH, r.y, r.w - SWATCH - right, r.h};
    if (active && ui_line_is_open(ui, rename_line)) {
        if (ui_line(ui, label, rename_line) == UI_LINE_DONE && core_begin(core, "Rename spline", 0))
            core_end(core, edit_spline_name(core->document, s, ui->text.bytes, &core->error));
    } else {
        ui_hint(ui, label, "Click to edit (PgUp, PgDn), M for another kind, F2 to rename, drag to reorder");
        enum ui_row_event event = ui_sort_row(ui, r, label, name, spline->name, active);
        if (event == UI_ROW_PRESSED) core_choose(core, s);
        if (event == UI_ROW_TWICE) {
            core_choose(core, s);
            inspector_rename(in, 0);
        }
        dropped = event == UI_ROW_DROPPED;
    }
    struct rect swatch = {r.x, r.y, SWATCH, r.h};
    if (!core->more) {
        const struct rect chip = {r.x + (SWATCH - 10) / 2, r.y + (r.h - 10) / 2, 10, 10};
        if (ui->pass == UI_PASS_DRAW) drawlist_rounded(ui->list, chip, 3, spline_list_color(core->document, s));
        ui_label_right(ui, (struct rect){label.x + label.w, r.y, KIND - 4, r.h},
                       parameter_rows[PARAMETER_MODE].labels[spline_mode(spline)], theme()->text_dim);
        return dropped;
    }
    snprintf(name, sizeof name, "color.%s", spline->name);
    ui_hint(ui, swatch, palette.hint);
    ui_swatch(ui, swatch, name, palette.name, (int)spline->id, spline_list_color(core->document, s));
    inspector_offer(in, &palette);
    const bool solo = selection_has(&core->solo, spline->id), shown = spline_list_shows(core, s);
    struct rect icon = {r.x + r.w - 2 * INSPECTOR_ICON, r.y, INSPECTOR_ICON, r.h};
    snprintf(name, sizeof name, "solo.%s", spline->name);
    if (ui_icon_button(ui, icon, name, UI_ICON_SOLO, solo, "Show only this curve"))
        spline_list_flip(core, &core->solo, s);
    icon.x += INSPECTOR_ICON;
    snprintf(name, sizeof name, "eye.%s", spline->name);
    if (ui_icon_button(ui, icon, name, shown ? UI_ICON_EYE : UI_ICON_EYE_CLOSED, false, "Show or hide this curve"))
        spline_list_flip(core, &core->hidden, s);
    return dropped;
}

static void build_buttons(struct inspector *in)
{
    static const struct icon_button buttons[] = {
        {"splines.add", "Add a spline with a knot at the playhead", UI_ICON_ADD},
        {"splines.copy", "Duplicate this spline", UI_ICON_COPY},
        {"splines.delete", "Delete this spline", UI_ICON_DELETE},
        {"splines.up", "Move this spline up", UI_ICON_UP},
        {"splines.down", "Move this spline down", UI_ICON_DOWN},
    };
    struct core *core = in->core;
    const int count = core->more ? sizeof buttons / sizeof buttons[0] : 1;
    const int pressed = inspector_icons(in, ui_row(&in->ui, UI_ROW), buttons, count);
    if (pressed == 0) spline_list_add(core);
    if (pressed == 1) spline_list_copy(core);
    if (pressed == 2) spline_list_remove(core);
    if (pressed >= 3) spline_list_move(core, core->active, core->active + (pressed == 3 ? -1 : 1));
}

void inspector_splines(struct inspector *in)
{
    struct ui *ui = &in->ui;
    const int count = in->core->document->spline_count,
              first = inspector_first_row(count, in->core->active, MAX_ROWS);
    int from = -1, dropped = -1;
    if (count == 0) ui_paragraph(ui, "This scene has no splines yet.", theme()->text_dim);
    int rows = count < MAX_ROWS ? count : MAX_ROWS;
    float top = ui->y;
    for (int i = 0; i < rows; i++) {
        const struct spline *spline = in->core->document->splines[first + i];
        char name[UI_NAME_SIZE];
        snprintf(name, sizeof name, "spline.%s", spline->name);
        ui_push(ui, spline->id);
        if (ui_is_dragged(ui, name)) from = first + i;
        if (build_row(in, first + i, ui_row(ui, UI_ROW))) dropped = first + i;
        ui_pop(ui);
    }
    const int row = (int)floorf((ui->pointer_y - top) / UI_ROW); // where a dragged row would go
    const int to = first + (row < 0 ? 0 : row >= rows ? rows - 1 : row);
    if (from >= 0 && to != from && ui->pass == UI_PASS_DRAW) {
        const float y = top + (float)((to - first + (to > from ? 1 : 0)) * UI_ROW);
        drawlist_rect(ui->list, (struct rect){ui->area.x + UI_PAD, y - 1, ui->area.w - 2 * UI_PAD, 2},
                      theme()->accent);
    }
    if (dropped >= 0) spline_list_move(in->core, dropped, to);
    inspector_more(in, count, MAX_ROWS, " splines; PgUp and PgDn show more");
    build_buttons(in);
}
