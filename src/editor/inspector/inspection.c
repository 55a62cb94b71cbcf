/// What the inspector's sections share: what a number's change means for the history, rows with a label.
#include "editor/inspector/inspection.h"
#include "editor/core/arrange.h"
#include "editor/core/core.h"
#include <math.h>
#include <string.h>

void inspector_take_back(struct inspection *in, enum ui_change change)
{
    struct history *history = in->world->history;
    if (change != UI_DRAG || !history_is_open(history)) return;
    history_restart(history, in->document);
    core_refresh(in->core, in->world);
}

bool inspector_changed(enum ui_change change) { return change == UI_DROP || change == UI_SET || change == UI_NUDGE; }

void inspector_change(struct inspection *in, enum ui_change change, const char *label, const char *what,
                      const struct edit *edit)
{
    inspector_change_all(in, change, label, what, edit, 1);
}

void inspector_change_all(struct inspection *in, enum ui_change change, const char *label, const char *what,
                          const struct edit *edits, int count)
{
    struct history *history = in->world->history;
    uint64_t merge = 0;
    switch (change) {
    case UI_NONE:
        return;
    case UI_DRAG:
        inspector_take_back(in, change);
        if (!history_is_open(history)) history_begin(history, label, 0);
        for (int i = 0; i < count; i++) core_edit(in->core, in->world, &edits[i]);
        return;
    case UI_CANCEL:
    case UI_DROP:
        if (!history_is_open(history)) return; // nothing was moved by this drag
        if (change == UI_CANCEL) history_restart(history, in->document);
        history_end(history);
        core_refresh(in->core, in->world);
        return;
    case UI_NUDGE:
        merge = (uint64_t)ui_id(what) << 32 | (uint32_t)(in->core->active + 1);
        break;
    case UI_SET:
        break;
    }
    if (history_is_open(history)) return; // as core_step()
    history_begin(history, label, merge);
    for (int i = 0; i < count; i++) core_edit(in->core, in->world, &edits[i]);
    history_end(history);
}

static double get_number(const struct number_row *row, const struct setting *setting)
{
    const char *at = (const char *)setting + row->at;
    double number;
    int whole;
    if (row->is_whole) {
        memcpy(&whole, at, sizeof whole);
        return whole;
    }
    memcpy(&number, at, sizeof number);
    return number;
}

static void set_number(const struct number_row *row, struct setting *setting, double number)
{
    char *at = (char *)setting + row->at;
    const int whole = row->is_whole ? (int)lround(number) : 0;
    if (row->is_whole) {
        memcpy(at, &whole, sizeof whole);
    } else {
        memcpy(at, &number, sizeof number);
    }
}

/// A drag stays where it last was possible.
static void drag(struct inspection *in, const struct number_row *row, struct setting *setting, double value)
{
    struct history *history = in->world->history;
    double *possible = &in->inspector->dragged;
    if (!history_is_open(history)) {
        history_begin(history, row->undo, 0);
        *possible = get_number(row, setting);
    }
    set_number(row, setting, value);
    if (history_apply(history, in->document, &setting->edit, NULL)) {
        *possible = value;
    } else {
        set_number(row, setting, *possible);
        history_apply(history, in->document, &setting->edit, NULL);
    }
    core_refresh(in->core, in->world);
}

enum ui_change inspector_number(struct inspection *in, const struct number_row *row, setting_now *now, int which,
                                struct rect r)
{
    const struct ui_number number = {.name = row->name,
                                     .label = row->label,
                                     .unit = row->unit,
                                     .hint = row->hint,
                                     .minimum = row->minimum,
                                     .maximum = row->maximum,
                                     .lowest = row->lowest,
                                     .highest = row->highest,
                                     .fallback = row->fallback,
                                     .step = row->step,
                                     .decimals = row->decimals};
    struct setting setting;
    now(in, which, &setting);
    double value = get_number(row, &setting);
    const enum ui_change change = ui_value(in->ui, r, &number, &value);
    if (change == UI_NONE) return change;
    inspector_take_back(in, change); // an edit may start from more than the number: from what was before the drag
    now(in, which, &setting);
    if (change == UI_DRAG) {
        drag(in, row, &setting, value);
        return change;
    }
    set_number(row, &setting, value);
    inspector_change(in, change, row->undo, row->name, &setting.edit);
    return change;
}

void inspector_numbers(struct inspection *in, const struct number_row *rows, int count, setting_now *now)
{
    for (int i = 0; i < count; i++) inspector_number(in, &rows[i], now, i, ui_row(in->ui, UI_ROW));
}

int inspector_spline_items(const struct inspection *in, const bool *left_out, int chosen, struct ui_item *items,
                           int *splines, int *row)
{
    int count = 0;
    *row = -1;
    for (int s = 0; s < in->document->spline_count && s < INSPECTOR_MAX_SPLINES; s++) {
        if (left_out && left_out[s]) continue;
        const char *name = in->document->splines[s].name;
        if (s == chosen) *row = count;
        items[count] = (struct ui_item){name, name, arrange_color(in->document, s)};
        splines[count++] = s;
    }
    return count;
}

int inspector_spline_list(struct inspection *in, const char *list, const bool *left_out, int chosen)
{
    struct ui_item items[INSPECTOR_MAX_SPLINES];
    int splines[INSPECTOR_MAX_SPLINES] = {0}, row;
    const int count = inspector_spline_items(in, left_out, chosen, items, splines, &row);
    int picked = ui_popup_list(in->ui, list, items, count, row);
    return picked < 0 ? -1 : splines[picked];
}

struct rect inspector_labelled(struct inspection *in, const char *label)
{
    struct rect r = ui_row(in->ui, UI_ROW);
    ui_label(in->ui, (struct rect){r.x, r.y, UI_LABEL, r.h}, label, theme()->text_dim);
    return (struct rect){r.x + UI_LABEL + UI_GAP, r.y, r.w - UI_LABEL - UI_GAP, r.h};
}
