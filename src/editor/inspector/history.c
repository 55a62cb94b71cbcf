/// The inspector's list of undo steps. A click goes to the end of a step. It must be the last section, because it changes the document that
/// later sections would show.
#include "editor/core/core.h"
#include "editor/inspector/parts.h"
#include "ui/theme.h"
#include <stdio.h>

enum { ROWS = 9 };

/// Row 0 is the state before the oldest step, row n the state after step n.
static void text_of(const struct history *history, size_t row, char *text, size_t size)
{
    size_t dropped = history_dropped(history);
    if (row > 0) {
        snprintf(text, size, "%s", history_label(history, row - 1));
    } else if (dropped == 0) {
        snprintf(text, size, "Opened");
    } else {
        snprintf(text, size, "%zu older step%s dropped", dropped, dropped == 1 ? " was" : "s were");
    }
}

static void name_of(size_t row, char name[32]) { snprintf(name, 32, "history.%zu", row); }

/// Scrolls to the present step when it changes.
static void keep_in_sight(struct history_view *view, size_t count, size_t done)
{
    size_t last_top = count + 1 > ROWS ? count + 1 - ROWS : 0;
    if (view->count != count || view->done != done) {
        if (done < view->top) view->top = done;
        if (done >= view->top + ROWS) view->top = done - ROWS + 1;
    }
    view->count = count;
    view->done = done;
    if (view->top > last_top) view->top = last_top;
}

static void go_to(struct inspector *in, size_t row)
{
    char name[32];
    name_of(row, name);
    if (in->ui.focus) in->ui.focus = ui_id(&in->ui, name);
    core_jump(in->core, row);
}

static void scroll(struct inspector *in, struct rect list)
{
    struct ui *ui = &in->ui;
    struct history_view *view = &in->history;
    bool wheel = ui->pass == UI_PASS_EVENT && ui->event->kind == EVENT_WHEEL && !ui->used && ui_hovered(ui, list);
    if (!wheel || view->count < ROWS) return;
    bool up = ui->event->dy > 0;
    size_t room = up ? view->top : view->count + 1 - ROWS - view->top;
    size_t by = room < 3 ? room : 3;
    view->top = up ? view->top - by : view->top + by;
    ui->used = by > 0;
}

/// ↑ and ↓ on the focused row: undo, redo.
static void step_by_key(struct inspector *in, size_t first, size_t end)
{
    struct ui *ui = &in->ui;
    bool key = ui->pass == UI_PASS_EVENT && ui->event->kind == EVENT_KEY && ui->event->action != ACTION_RELEASE;
    if (!key || ui->used || (ui->event->key != KEY_UP && ui->event->key != KEY_DOWN)) return;
    const struct history_view *view = &in->history;
    for (size_t row = first; row < end; row++) {
        char name[32];
        name_of(row, name);
        if (ui->focus != ui_id(ui, name)) continue;
        ui->used = true;
        bool up = ui->event->key == KEY_UP;
        if (up ? view->done > 0 : view->done < view->count) go_to(in, up ? view->done - 1 : view->done + 1);
        return;
    }
}

static bool build_row(struct inspector *in, size_t row)
{
    const struct history *history = in->core->history;
    const struct history_view *view = &in->history;
    struct ui *ui = &in->ui;
    struct rect r = ui_row(ui, UI_ROW);
    char name[32], text[96];
    name_of(row, name);
    text_of(history, row, text, sizeof text);
    bool pressed = ui_list_row(ui, r, name, "", 0, row == view->done);
    uint32_t color = row > view->done ? theme()->text_dim : theme()->text;
    ui_label(ui, (struct rect){r.x + 6, r.y, r.w - 60, r.h}, text, color);
    if (history_step_is_saved(history, row)) ui_label_right(ui, r, "saved", color);
    ui_hint(ui, r, row > view->done ? "Redo to here" : "Undo to here");
    return pressed;
}

void inspector_history(struct inspector *in)
{
    const struct history *history = in->core->history;
    struct history_view *view = &in->history;
    size_t count = history_count(history);
    keep_in_sight(view, count, history_done(history));
    size_t first = view->top, end = first + ROWS < count + 1 ? first + ROWS : count + 1, pressed = end;
    struct rect list = {in->ui.area.x, in->ui.y, in->ui.area.w, (float)(end - first) * UI_ROW};
    for (size_t row = first; row < end; row++) {
        if (build_row(in, row)) pressed = row;
    }
    if (count + 1 > ROWS) {
        char text[96];
        snprintf(text, sizeof text, "Steps %zu to %zu of %zu", first > 0 ? first : 1, end - 1, count);
        ui_paragraph(&in->ui, text, theme()->text_dim);
    }
    scroll(in, list);
    step_by_key(in, first, end);
    if (pressed < end) go_to(in, pressed);
}
