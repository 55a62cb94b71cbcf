/// The splines' list, left of the curves. It is the inspector's, because its widgets share focus, typed line and popup with the others.
#include "base/names.h"
#include "editor/core/core.h"
#include "editor/inspector/inspector.h"
#include "editor/inspector/state.h"
#include "scene/text.h"
#include <math.h>
#include <stdio.h>

enum { SWATCH = 18, BUTTON = 20, INDENT = 8, WIDE = 124 }; ///< pixels; the last is the width with names
enum { COLOR = 28, WIDTH = THEME_SPLINE_COLORS * COLOR + 20 };

/// The colours of the theme, a typed one, and none.
static void build_palette(struct inspector *in, const struct dropdown *list)
{
    enum { UNCHANGED = -2, DEFAULT = -1 };
    static const struct row hex = {.name = "color.hex"};
    struct ui *ui = &in->ui;
    const int spline = document_find_spline_id(in->core->document, (unsigned)ui->popup.which);
    if (spline < 0) return;
    ui_popup_begin(ui, WIDTH, COLOR + UI_ROW + 8);
    const struct rect r = {ui->scroll_area.x + 6, ui->y + 2, THEME_SPLINE_COLORS * COLOR, COLOR};
    const uint32_t present = spline_list_color(in->core->document, spline);
    int color = UNCHANGED;
    for (int i = 0; i < THEME_SPLINE_COLORS; i++) {
        char name[24];
        snprintf(name, sizeof name, "color.%d", i);
        const struct rect field = {r.x + (float)(i * COLOR), r.y, COLOR, COLOR};
        if (ui_color(ui, field, name, theme()->spline[i], theme()->spline[i] == present))
            color = (int)theme_spline_rgb(i);
    }
    bool picked = color != UNCHANGED;

    // Typed "#RRGGBB"; anything else shows an error and changes nothing.
    const struct rect typed = {r.x, r.y + COLOR + 2, 86, UI_ROW}, none = {r.x + 92, typed.y, r.w - 92, UI_ROW};
    const int stored = in->core->document->splines[spline]->color;
    char text[COLOR_TEXT_SIZE];
    color_print(stored < 0 ? (int)theme_spline_rgb(spline % THEME_SPLINE_COLORS) : stored, text);
    if (!ui_line_is_open(ui, hex.name)) {
        if (ui_button(ui, typed, "color.type", text, false)) ui_line_begin(ui, hex.name, text);
    } else if (inspector_line(in, typed, &hex) && !color_parse(ui->text.bytes, &color)) {
        snprintf(ui->complaint, sizeof ui->complaint, "colour: expected something like #FFB000, got “%.*s”",
                 name_fit(ui->text.bytes, 40), ui->text.bytes);
    }
    if (ui_button(ui, none, "color.none", "Default", false)) {
        color = DEFAULT;
        picked = true;
    }
    if (inspector_opens(in, color != UNCHANGED, list->undo)) {
        for (int s = 0; s < in->core->document->spline_count; s++) {
            if (spline_list_acts(in->core, spline, spline + 1, s))
                edit_spline_color(in->core->document, s, color, &in->core->step.error);
        }
    }
    ui_space(ui, COLOR + UI_ROW + 8);
    ui_popup_end(ui);
    if (picked) ui_popup_close(ui);
}

static const struct dropdown palette = {
    .name = "palette", .hint = "Colour of this spline", .undo = "Set colour", .build = build_palette};

static const struct row rename_row = {.name = "rename", .undo = "Rename spline"},
                        folder_row = {.name = "rename.folder", .undo = "Rename folder"}; // that of the active spline

void inspector_rename(struct inspector *in, int unused)
{
    const struct core *core = in->core;
    const struct spline *spline = core_active_spline(core);
    (void)unused;
    if (!spline) return;
    int first = core->focus.active;
    while (spline_list_together(core->document, first - 1, first)) first--;
    selection_set(&in->core->view.folded, core->document->splines[first]->id, false);
    in->listed = 0; // scrolls there
    ui_line_begin(&in->ui, rename_row.name, spline->name);
}

/// A row: of the spline `first`, or a header of the folder that has first … end − 1.
struct line {
    int first, end;
    bool is_header;
};

/// The row after another one, {0} before the first; `first` is the number of splines after the last.
static struct line next_line(const struct core *core, struct line at)
{
    const struct document *document = core->document;
    const bool enters = at.is_header && !selection_has(&core->view.folded, document->splines[at.first]->id);
    struct line next = {.first = enters ? at.first : at.end};
    next.is_header = !enters && spline_list_together(document, next.first, next.first) &&
                     !spline_list_together(document, next.first - 1, next.first);
    next.end = next.first + 1;
    while (next.is_header && spline_list_together(document, next.end - 1, next.end)) next.end++;
    return next;
}

/// A click on a row: selects it alone, with Ctrl as well or no longer, with Shift all from the active one to it. `keeps`: of several selected rows
/// it becomes the active one.
static void choose_line(struct core *core, struct line line, bool keeps)
{
    struct selection *selection = &core->focus.selection;
    const int active = core->focus.active, within = active >= line.first && active < line.end;
    const bool extends = core->input.mods & MOD_SHIFT, adds = extends || core->input.mods & MOD_CTRL;
    bool is_in = true;
    for (int s = line.first; s < line.end; s++) is_in &= core_is_chosen(core, s);
    if (keeps && is_in && !adds) core_turn_to(core, line.first);
    if (keeps && is_in && !adds) return;
    if (!adds) selection_clear(selection);
    core_choose(core, adds || within ? active : line.first);
    const int first = extends && active < line.first ? active : line.first;
    const int end = extends && active >= line.end ? active + 1 : line.end;
    for (int s = first; s < end; s++)
        selection_set(selection, core->document->splines[s]->id, extends || !adds || !is_in);
}

/// A row: colour or triangle, name, eye and lock. The buttons are there while the pointer is on it, and on the active row for keyboard and
/// fingers; a closed eye or lock always.
static enum ui_row_event build_line(struct inspector *in, struct line line, struct rect r, const char *id)
{
    struct ui *ui = &in->ui;
    struct core *core = in->core;
    struct document *document = core->document;
    const struct spline *spline = document->splines[line.first];
    const char *name = line.is_header ? spline->folder : spline->name;
    const bool has_active = core->focus.active >= line.first && core->focus.active < line.end;
    const bool is_folded = selection_has(&core->view.folded, spline->id), is_wide = r.w > WIDE / 2.0f;
    const struct row *typed = line.is_header ? &folder_row : &rename_row;
    struct rect label = r;
    bool chosen = true,
         types = false; // types: the row was active when this pass began; a click may have changed that
    for (int s = line.first; s < line.end; s++) {
        chosen &= core_is_chosen(core, s);
        types |= document->splines[s]->id == in->listed;
    }
    const float left = SWATCH + (line.is_header || !spline->folder ? 0 : INDENT);
    if (is_wide) label = (struct rect){r.x + left, r.y, r.w - left, r.h};
    if (types && ui_line_is_open(ui, typed->name)) {
        bool good = true;
        for (int s = inspector_line(in, label, typed) ? line.first : line.end; s < line.end; s++)
            good = (line.is_header ? edit_spline_folder : edit_spline_name)(document, s, ui->text.bytes,
                                                                            &core->step.error);
        if (!good) ui_line_again(ui, typed->name);
        return UI_ROW_NONE;
    }

    const bool shown = spline_list_shows(core, line.first), locked = spline->locked;
    const bool without_mouse = chosen && has_active && (core->input.finger || ui->focus);
    const bool near = is_wide && (ui->pass == UI_PASS_FIND || without_mouse ||
                                  (ui_hovered(ui, r) && !core->input.finger && !ui->held));
    label.w -= near || (is_wide && !shown)  ? 2 * BUTTON
               : is_wide && locked          ? BUTTON
               : is_wide || !line.is_header ? 0
                                            : r.w; // a narrow folder only opens and closes
    char full[UI_NAME_SIZE];
    const char *hint = line.is_header ? "Click to select its splines, double-click to rename it"
                                      : "Click to edit (Ctrl, Shift: several), F2 to rename, drag to reorder";
    ui_hint(ui, label, ui->held ? NULL : hint);
    const enum ui_row_event event =
        ui_sort_row(ui, r, label, id, is_wide ? name : "", chosen || (is_folded && line.is_header && has_active));
    const struct rect first = {r.x + left - SWATCH, r.y, is_wide ? SWATCH : r.w, r.h};
    if (line.is_header) {
        snprintf(full, sizeof full, "fold.%s", name);
        if (ui_icon_button(ui, first, full, is_folded ? UI_ICON_RIGHT : UI_ICON_DOWN, false,
                           "Close or open the folder"))
            selection_set(&core->view.folded, spline->id, !is_folded);
    } else if (near) {
        snprintf(full, sizeof full, "color.%s", name);
        ui_hint(ui, first, palette.hint);
        ui_swatch(ui, first, full, palette.name, (int)spline->id, spline_list_color(document, line.first));
    } else if (ui->pass == UI_PASS_DRAW) {
        const struct rect chip = {first.x + (first.w - 10) / 2, r.y + (r.h - 10) / 2, 10, 10};
        drawlist_rounded(ui->list, chip, 3, theme_fade(spline_list_color(document, line.first), shown ? 1 : 0.3f));
    }
    static const enum ui_icon icons[2][2] = {{UI_ICON_EYE, UI_ICON_EYE_CLOSED}, {UI_ICON_UNLOCKED, UI_ICON_LOCK}};
    static const char *const hints[] = {"Show or hide it", "Lock it against edits on the curves, or unlock it"};
    for (int locks = 0; locks < 2; locks++) {
        const bool told = locks ? locked : !shown;
        const struct rect icon = {r.x + r.w - (float)((2 - locks) * BUTTON), r.y, BUTTON, r.h};
        snprintf(full, sizeof full, locks ? "lock.%s" : "eye.%s", name);
        if ((near || (is_wide && told)) && ui_icon_button(ui, icon, full, icons[locks][told], false, hints[locks]))
            spline_list_flip(core, locks ? LIST_LOCK : LIST_HIDE, line.first, line.end);
    }
    if (event == UI_ROW_PRESSED) {
        in->adds = core->input.mods & (MOD_CTRL | MOD_SHIFT);
        choose_line(core, line, ui->held);
    }
    if (event == UI_ROW_TWICE || (event == UI_ROW_CLICKED && !in->adds)) choose_line(core, line, false);
    if (event != UI_ROW_TWICE) return event;
    ui_line_begin(ui, typed->name, name);
    in->listed = 0; // no other row has the line in this pass
    return event;
}

void inspector_splines(struct inspector *in)
{
    enum { SCOPE = 64 /* no section's */ };
    struct ui *ui = &in->ui;
    struct core *core = in->core;
    const struct document *document = core->document;
    const struct event *event = ui->event;
    const struct rect panel = ui->clip;
    struct rect area = core->view.layout.list;
    if (ui_line_is_open(ui, rename_row.name) || ui_line_is_open(ui, folder_row.name)) area.w = fmaxf(area.w, WIDE);
    ui->clip = area;
    if (ui->pass == UI_PASS_DRAW) {
        drawlist_set_clip(ui->list, area);
        drawlist_rect(ui->list, area, theme()->panel);
        drawlist_rect(ui->list, (struct rect){area.x + area.w - 1, area.y, 1, area.h}, theme()->border);
    }
    ui_push(ui, SCOPE);
    ui_list_begin(ui, &in->lines, area);
    const float top = ui->y;

    // Where dropped rows go: above a row, before a spline, into a folder or NULL. On a folder's header they go in; below its last row they
    // leave it, unless they come from there.
    const float height = (ui->pointer_y - top) / UI_ROW;
    int above_row = 0;
    struct line above = {.first = -1}, below = next_line(core, (struct line){0});
    for (; below.first < document->spline_count; above_row++, below = next_line(core, below)) {
        if (height <= (float)above_row + (below.is_header ? 0.25f : 0.5f)) break;
        above = below;
    }
    const bool enters = above.is_header && height < (float)above_row;
    const bool stays = height < (float)above_row + 0.5f && !above.is_header &&
                       spline_list_together(document, above.first, core->focus.active);
    const bool within = enters || stays || spline_list_together(document, above.first, below.first);
    const char *folder = within ? document->splines[above.first]->folder : NULL;
    const bool presses = event && event->kind == EVENT_BUTTON && event->action == ACTION_PRESS && !ui->used;
    bool dragged = false, scrolls = false;
    struct line dropped = {0};
    const bool follows = in->listed != core->focus.active_id;
    in->listed = core->focus.active_id;
    for (struct line line = next_line(core, (struct line){0}); line.first < document->spline_count;
         line = next_line(core, line)) {
        const struct spline *spline = document->splines[line.first];
        const struct rect r = {area.x + 6, ui->y, area.w - 14, UI_ROW};
        char id[UI_NAME_SIZE];
        ui_space(ui, UI_ROW);
        if (follows && core->focus.active >= line.first && core->focus.active < line.end)
            ui_list_show(&in->lines, r.y - top, UI_ROW);
        snprintf(id, sizeof id, "%s.%s", line.is_header ? "folder" : "spline",
                 line.is_header ? spline->folder : spline->name);
        ui_push(ui, 2 * spline->id + line.is_header);
        if ((r.y + r.h > area.y && r.y < area.y + area.h) || ui->held == ui_id(ui, id)) {
            const bool was_chosen = core_is_chosen(core, line.first);
            const enum ui_row_event used = build_line(in, line, r, id);
            dragged |= ui_is_dragged(ui, id);
            if (used == UI_ROW_DROPPED) dropped = line;
            scrolls |= used == UI_ROW_PRESSED && core->input.finger && ui->held && !was_chosen;
            if (presses && event->button == BUTTON_RIGHT && !ui->held && ui_hovered(ui, r))
                choose_line(core, line, true);
        }
        ui_pop(ui);
    }
    if (scrolls) ui->held = ui_id(ui, "scroll"); // a finger drags only rows that it has chosen before
    const struct rect last = {area.x + 6, ui->y, fminf(area.w - 14, UI_ROW), UI_ROW};
    ui_space(ui, UI_ROW);
    if (ui_icon_button(ui, last, "splines.add", UI_ICON_ADD, false, "Add a spline with a knot at the playhead"))
        spline_list_change(core, LIST_ADD);
    const float y = top + (float)above_row * UI_ROW, left = area.x + (folder ? 6 + INDENT : 6);
    if (dragged && ui->pass == UI_PASS_DRAW)
        drawlist_rect(ui->list, (struct rect){left, y - 1, area.x + area.w - 6 - left, 2}, theme()->accent);
    if (dragged && event && ui->pointer_y < area.y + UI_ROW / 2.0f) ui_list_scroll(&in->lines, -UI_ROW);
    if (dragged && event && ui->pointer_y > area.y + area.h - UI_ROW / 2.0f) ui_list_scroll(&in->lines, UI_ROW);
    ui_list_end(ui);
    ui_pop(ui);
    ui->clip = panel;
    if (ui->pass == UI_PASS_DRAW) drawlist_set_clip(ui->list, panel);
    int to = below.first; // no folder goes into another
    while (dropped.is_header && spline_list_together(document, to - 1, to)) to++;
    if (dropped.end > 0)
        spline_list_place(core, to, dropped.is_header ? document->splines[dropped.first]->folder : folder);
    inspector_offer(in, &palette);
    if (ui_popup_is_open(ui, palette.name))
        ui->popup.room = (struct rect){0, 0, core->view.layout.window.w, core->view.layout.status.y};
}
