/// The inspector: what its sections share, those on scene, history, selected knots and pins, and the panel with the table of all.
#include "editor/inspector/inspector.h"
#include "base/names.h"
#include "base/need.h"
#include "editor/core/core.h"
#include "editor/inspector/state.h"
#include "maths/maths.h"
#include "scene/pins.h"
#include "ui/theme.h"
#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/// Whether a change is finished, not a step of a drag.
static bool is_finished(enum ui_change change) { return change == UI_DROP || change == UI_SET || change == UI_NUDGE; }

bool inspector_step(struct inspector *in, enum ui_change change, const char *label, const char *what)
{
    struct core *core = in->core;
    if (change == UI_CANCEL && history_is_open(core->history)) history_restart(core->history);
    if (change == UI_NONE || change == UI_CANCEL || change == UI_DROP) return false; // inspector_event() ends a drag
    if (!core_step(core, label, change == UI_NUDGE ? core_merge_key(core, ui_id(&in->ui, what)) : 0)) {
        if (change != UI_DRAG) return false;
        core->step.error = (struct error){0};
        history_restart(core->history);
    }
    if (change == UI_DRAG) core->step.ends = false;
    return true;
}

bool inspector_opens(struct inspector *in, bool used, const char *undo)
{
    return used && (!undo || inspector_step(in, UI_SET, undo, NULL));
}

bool inspector_button(struct inspector *in, struct rect r, const struct row *row)
{
    ui_hint(&in->ui, r, row->hint);
    return inspector_opens(in, ui_button(&in->ui, r, row->name, row->label, row->lit), row->undo);
}

bool inspector_icon(struct inspector *in, struct rect r, const struct row *row)
{
    return inspector_opens(in, ui_icon_button(&in->ui, r, row->name, row->icon, row->lit, row->hint), row->undo);
}

bool inspector_choice(struct inspector *in, const struct row *row, int *chosen)
{
    const struct rect r = row->label ? inspector_labelled(in, row->label) : ui_row(&in->ui, UI_ROW);
    ui_hint(&in->ui, r, row->hint);
    return inspector_opens(in, ui_segments(&in->ui, r, row->name, row->choices, row->count, chosen), row->undo);
}

bool inspector_toggle(struct inspector *in, struct rect r, const struct row *row, bool *on)
{
    if (row->label) r = inspector_label(in, r, row->label);
    ui_hint(&in->ui, r, row->hint);
    return inspector_opens(in, ui_toggle(&in->ui, r, row->name, on), row->undo);
}

bool inspector_line(struct inspector *in, struct rect r, const struct row *row)
{
    return inspector_opens(in, ui_line(&in->ui, r, row->name) == UI_LINE_DONE, row->undo);
}

int inspector_buttons(struct inspector *in, struct rect r, const struct row *rows, int count)
{
    const bool icons = !rows->label;
    const float gap = icons ? 6 : 4;
    int pressed = -1;
    r.w = icons ? INSPECTOR_ICON : (r.w - (float)(count - 1) * gap) / (float)count;
    if (icons) r.x -= 2;
    for (int i = 0; i < count; i++, r.x += r.w + gap) {
        if (icons ? inspector_icon(in, r, &rows[i]) : inspector_button(in, r, &rows[i])) pressed = i;
    }
    return pressed;
}

int inspector_list(struct inspector *in, const struct dropdown *list, const struct ui_item *items, int count,
                   int chosen)
{
    int row = count - 1;
    while (row >= 0 && items[row].value != chosen) row--;
    const int picked = ui_popup_list(&in->ui, list->name, items, count, row);
    return inspector_opens(in, picked >= 0, list->undo) ? items[picked].value : -1;
}

double number_at(const struct number_row *row, const void *of)
{
    const void *at = (const char *)of + row->at;
    return row->is_whole ? *(const int *)at : (row->scale > 0 ? row->scale : 1) * *(const double *)at;
}

void number_put(const struct number_row *row, void *of, double number)
{
    void *at = (char *)of + row->at;
    if (row->is_whole) *(int *)at = (int)lround(number);
    if (!row->is_whole) *(double *)at = row->scale > 0 ? number / row->scale : number;
}

static bool set_number(struct inspector *in, const struct number_row *row, const struct number_home *home, int which,
                       double number, struct error *error)
{
    if (home->own) number_put(row, home->own, number);
    if (home->own) return true;
    if (home->set) return home->set(in, which, number, error);
    struct rig changed = *in->core->document->rigs[*home->rig];
    number_put(row, &changed, number);
    return edit_rig_set(in->core->document, *home->rig, &changed, error);
}

enum ui_change inspector_number(struct inspector *in, const struct number_row *row, const struct number_home *home,
                                int which, struct rect r)
{
    struct core *core = in->core;
    struct ui_number number = row->ui;
    const void *of = home->rig ? core->document->rigs[*home->rig] : home->own ? home->own : home->of;
    const bool waits = home->settles && ui_is_dragged(&in->ui, number.name);
    char text[64] = "";
    const double was = home->get && core->take.document ? home->get(in, which, true, text) : NAN;
    double now = was;
    if (!isfinite(was) || in->ui.pass != UI_PASS_DRAW || !take_is_shown(core)) {
        text[0] = '\0';
        now = waits ? in->dragged : of ? number_at(row, of) : home->get(in, which, false, text);
    }
    if (waits) snprintf(text, sizeof text, "%g%s%s", now, number.unit ? " " : "", number.unit ? number.unit : "");
    number.shown = text[0] ? text : NULL;
    number.was = isfinite(was) ? &was : NULL;
    double value = now;
    const enum ui_change change = ui_value(&in->ui, r, &number, &value);
    if (change == UI_SET && row->is_whole && value != floor(value)) {
        snprintf(in->ui.complaint, sizeof in->ui.complaint, "%s: expected a whole number, got %g", number.label,
                 value);
        return UI_NONE;
    }
    if (home->settles || !row->undo) {
        if (inspector_opens(in, home->settles ? is_finished(change) : change != UI_NONE, row->undo))
            set_number(in, row, home, which, value, &core->step.error);
        if (change == UI_DRAG) in->dragged = value;
        return change;
    }

    // One undo step. A drag repeats it in each frame, and stops at the last possible value.
    const bool is_first = change == UI_DRAG && !history_is_open(core->history);
    in->change = change;
    if (!inspector_step(in, change, row->undo, number.name)) return change;
    if (is_first) in->dragged = now;
    if (set_number(in, row, home, which, value, change == UI_DRAG ? NULL : &core->step.error)) {
        in->dragged = value;
    } else if (change == UI_DRAG) {
        history_restart(core->history);
        set_number(in, row, home, which, in->dragged, NULL);
    }
    return change;
}

void inspector_numbers(struct inspector *in, const struct number_row *rows, int count, const struct number_home *home)
{
    for (int i = 0; i < count; i++) inspector_number(in, &rows[i], home, i, ui_row(&in->ui, UI_ROW));
}

int inspector_spline_items(const struct inspector *in, const bool *left_out, struct ui_item *items)
{
    int count = 0;
    for (int s = 0; s < in->core->document->spline_count && s < INSPECTOR_MAX_SPLINES; s++) {
        if (left_out && left_out[s]) continue;
        const char *name = in->core->document->splines[s]->name;
        items[count++] = (struct ui_item){name, name, spline_list_color(in->core->document, s), s};
    }
    return count;
}

int inspector_spline_list(struct inspector *in, const struct dropdown *list, int chosen)
{
    struct ui_item items[INSPECTOR_MAX_SPLINES];
    const int count = inspector_spline_items(in, NULL, items);
    return inspector_list(in, list, items, count, chosen);
}

void inspector_offer(struct inspector *in, const struct dropdown *list)
{
    if (ui_popup_is_open(&in->ui, list->name)) in->list = list;
}

void inspector_dropdown(struct inspector *in, const struct dropdown *list, struct rect r, int which, const char *text,
                        uint32_t color)
{
    if (list->label) r = inspector_label(in, r, list->label);
    ui_hint(&in->ui, r, list->hint);
    ui_dropdown(&in->ui, r, list->name, which, text, color);
    inspector_offer(in, list);
}

void inspector_spline_field(struct inspector *in, const struct dropdown *list, struct rect r, int which, int spline)
{
    const struct document *document = in->core->document;
    inspector_dropdown(in, list, r, which, document->splines[spline]->name, spline_list_color(document, spline));
}

struct rect inspector_label(struct inspector *in, struct rect r, const char *label)
{
    ui_label(&in->ui, (struct rect){r.x, r.y, UI_LABEL, r.h}, label, theme()->text_dim);
    return (struct rect){r.x + UI_LABEL + UI_GAP, r.y, r.w - UI_LABEL - UI_GAP, r.h};
}

struct rect inspector_labelled(struct inspector *in, const char *label)
{
    return inspector_label(in, ui_row(&in->ui, UI_ROW), label);
}

void inspector_idle(struct inspector *in, const char *label, const char *text)
{
    ui_label(&in->ui, inspector_labelled(in, label), text, theme()->text_dim);
}

int inspector_first_row(int count, int chosen, int most)
{
    struct ui_list list = {.view = (float)most, .content = (float)count};
    ui_list_scroll(&list, (float)(chosen - most / 2));
    return (int)list.offset;
}

void inspector_more(struct inspector *in, int count, int most, const char *what)
{
    char text[96];
    snprintf(text, sizeof text, "%d of %d%s", most, count, what);
    if (count > most) ui_paragraph(&in->ui, text, theme()->text_dim);
}

enum { ROW_FIRST, ROW_LAST, ROW_RATE, SCENE_ROWS };

/// Rate and range ask before they move knots.
static bool set_scene(struct inspector *in, int which, double number, struct error *error)
{
    const struct document *document = in->core->document;
    const int whole = (int)lround(number);
    (void)error;
    if (which == ROW_RATE) spline_list_fps(in->core, number);
    if (which == ROW_FIRST) spline_list_range(in->core, whole, document->last_frame);
    if (which == ROW_LAST) spline_list_range(in->core, document->first_frame, whole);
    return true;
}

static const struct number_row scene_rows[SCENE_ROWS] = {
    [ROW_RATE] = {NUMBER_AT(struct document, fps),
                  .ui = {NAMED("scene.fps", "rate"), .unit = "fps",
                         .hint = "Frames per second; asks whether to keep frames or seconds",
                         TYPED(0.001, SCENE_MAX_FPS), .fallback = 24, .step = 1}},
    [ROW_FIRST] = {WHOLE_AT(struct document, first_frame),
                   .ui = {NAMED("scene.first", "first"), .hint = "First frame of the scene",
                          TYPED(-SCENE_MAX_FRAME, SCENE_MAX_FRAME), .fallback = NAN, .step = 1}},
    [ROW_LAST] = {WHOLE_AT(struct document, last_frame),
                  .ui = {NAMED("scene.last", "last"),
                         .hint = "Last frame of the scene; in a loop it repeats the first",
                         TYPED(-SCENE_MAX_FRAME, SCENE_MAX_FRAME), .fallback = NAN, .step = 1}},
};

// Range and frame rate are at the ruler's end, above the splines' list, or if that is narrow, in the panel.

static void build_range(struct inspector *in)
{
    static const float shares[SCENE_ROWS] = {[ROW_FIRST] = 0.28f, [ROW_LAST] = 0.3f, [ROW_RATE] = 0.42f};
    struct ui *ui = &in->ui;
    const struct number_home home = {.of = in->core->document, .set = set_scene, .settles = true};
    const struct rect panel = ui->clip, above = in->core->view.layout.range;
    struct rect r = above;
    if (above.w > 0) ui->clip = above;
    if (above.w > 0 && ui->pass == UI_PASS_DRAW) {
        drawlist_set_clip(ui->list, above);
        drawlist_rect(ui->list, above, theme()->panel);
    }
    for (int i = 0; i < SCENE_ROWS; i++, r.x += r.w) {
        r.w = shares[i] * above.w;
        struct number_row row = scene_rows[i];
        const double longest = document_longest(in->core->document);
        if (i == ROW_RATE && in->core->document->fps != floor(in->core->document->fps)) {
            row.ui.decimals = 3;
            if (above.w > 0) row.ui.unit = NULL; // 23.976 fills the field
        }
        if (i == ROW_FIRST) row.ui.lowest = fmax(row.ui.lowest, in->core->document->last_frame - longest);
        if (i == ROW_LAST) row.ui.highest = fmin(row.ui.highest, in->core->document->first_frame + longest);
        inspector_number(in, &row, &home, i, above.w > 0 ? r : ui_row(ui, UI_ROW));
    }
    ui->clip = panel;
    if (above.w > 0 && ui->pass == UI_PASS_DRAW) drawlist_set_clip(ui->list, panel);
}

void inspector_edit_range(struct inspector *in, int unused)
{
    (void)unused;
    if (in->core->view.layout.range.w == 0) inspector_unfold(in, "section.scene");
    in->ui.focus = ui_id(&in->ui, scene_rows[ROW_LAST].ui.name);
}

static bool set_offset(struct inspector *in, int which, double number, struct error *error)
{
    struct background_file changed = in->core->document->background;
    (void)which;
    changed.offset = (int)lround(number);
    return edit_background(in->core->document, &changed, error);
}

static void build_scene(struct inspector *in)
{
    static const struct number_row offset = {WHOLE_AT(struct background_file, offset), .undo = "Move background",
                                             .ui = {NAMED("background.offset", "offset"),
                                                    .hint = "The picture that the background shows at frame 0",
                                                    TYPED(-SCENE_MAX_FRAME, SCENE_MAX_FRAME), .step = 1}};
    static const struct row remover = {ICON("background.delete", UI_ICON_DELETE), .hint = "Remove the background",
                                       .undo = "Remove background"};
    if (in->core->view.layout.range.w == 0) build_range(in);

    const struct background_file *background = &in->core->document->background;
    static const struct row adder = {NAMED("background.add", "Background picture or film"),
                                     .hint = "What stands behind the stage; you can also drop it on the window"};
    if (!background->file) {
        if (inspector_button(in, ui_row(&in->ui, UI_ROW), &adder)) inspector_add(in, ADD_FILE);
        return;
    }
    struct rect r = inspector_labelled(in, "background");
    const struct rect icon = {r.x + r.w - INSPECTOR_ICON, r.y, INSPECTOR_ICON, r.h};
    r.w -= INSPECTOR_ICON + UI_GAP;
    ui_label(&in->ui, r, path_name(background->file), theme()->text);
    const bool removes = inspector_icon(in, icon, &remover);
    inspector_number(in, &offset, &(struct number_home){.of = background, .set = set_offset}, 0,
                     ui_row(&in->ui, UI_ROW));
    if (removes) edit_background(in->core->document, &(struct background_file){0}, &in->core->step.error);
}

enum { HISTORY_ROWS = 9 };

static void name_of(size_t row, char name[32]) { snprintf(name, 32, "history.%zu", row); }

static void go_to(struct inspector *in, size_t row)
{
    char name[32];
    name_of(row, name);
    if (in->ui.focus) in->ui.focus = ui_id(&in->ui, name);
    core_jump(in->core, row);
}

/// Row 0 is the state before the oldest step, row n the state after step n.
static void build_history(struct inspector *in)
{
    const struct history *history = in->core->history;
    struct history_view *view = &in->history;
    struct ui *ui = &in->ui;
    const size_t count = history_count(history), done = history_done(history);
    const bool changed = view->count != count || view->done != done;
    view->count = count;
    view->done = done;
    view->list.view = HISTORY_ROWS;
    if (changed) ui_list_show(&view->list, (float)done, 1); // the present step
    ui_list_fit(&view->list, HISTORY_ROWS, (float)(count + 1));

    const size_t first = (size_t)view->list.offset;
    const size_t end = first + HISTORY_ROWS < count + 1 ? first + HISTORY_ROWS : count + 1;
    size_t pressed = end;
    bool has_focus = false;
    const struct rect list = {ui->area.x, ui->y, ui->area.w, (float)(end - first) * UI_ROW};
    for (size_t row = first; row < end; row++) {
        const uint32_t color = row > done ? theme()->text_dim : theme()->text;
        const size_t dropped = history_dropped(history);
        char name[32], text[96] = "Opened";
        if (row > 0) {
            snprintf(text, sizeof text, "%s", history_label(history, row - 1));
        } else if (dropped > 0) {
            snprintf(text, sizeof text, "%zu older step%s dropped", dropped, dropped == 1 ? " was" : "s were");
        }
        const struct rect r = ui_row(ui, UI_ROW);
        name_of(row, name);
        has_focus |= ui->focus == ui_id(ui, name);
        if (ui_list_row(ui, r, name, "", 0, row == done)) pressed = row;
        ui_label(ui, (struct rect){r.x + 6, r.y, r.w - 60, r.h}, text, color);
        if (history_step_is_saved(history, row)) ui_label_right(ui, r, "saved", color);
        ui_hint(ui, r, row > done ? "Redo to here" : "Undo to here");
    }
    if (count + 1 > HISTORY_ROWS) {
        char text[96];
        snprintf(text, sizeof text, "Steps %zu to %zu of %zu", first > 0 ? first : 1, end - 1, count);
        ui_paragraph(ui, text, theme()->text_dim);
    }
    if (pressed < end) go_to(in, pressed);

    const struct event *event = ui->event;
    if (ui->pass != UI_PASS_EVENT || ui->used) return;
    if (event->kind == EVENT_WHEEL && ui_hovered(ui, list)) // at its end the wheel scrolls the panel
        ui->used = ui_list_scroll(&view->list, event->dy > 0 ? -3 : 3);
    const bool up = event->key == KEY_UP; // on a focused row: undo, redo
    if (!has_focus || event->kind != EVENT_KEY || event->action == ACTION_RELEASE) return;
    if (!up && event->key != KEY_DOWN) return;
    ui->used = true;
    if (up ? done > 0 : done < count) go_to(in, up ? done - 1 : done + 1);
}

// The selected knots. A number typed for several knots sets all of them; a drag or an arrow moves all by the same amount. Frames keep
// their distances either way.

enum { FIELD_FRAME, FIELD_VALUE, FIELD_PHASE, FIELD_SLOPE, FIELD_STIFFNESS, FIELDS };

static const char of_several[] = "Type to set all selected knots; drag to shift each by the same amount";

static const struct number_row knot_rows[FIELDS] = {
    [FIELD_FRAME] = {NUMBER_AT(struct knot, frame), .undo = "Move knots",
                     .ui = {NAMED("frame", "frame"),
                            .hint = "Frame of the first selected knot; the others move with it",
                            TYPED(-SCENE_MAX_FRAME, SCENE_MAX_FRAME), .fallback = NAN, .step = 1}},
    [FIELD_VALUE] = {NUMBER_AT(struct knot, value), .undo = "Set values",
                     .ui = {NAMED("value", "value"), .hint = of_several, ANY_NUMBER, .step = 0.01, .decimals = 3}},
    [FIELD_PHASE] = {NUMBER_AT(struct knot, phase), .undo = "Set phases",
                     .ui = {NAMED("phase", "phase"), .hint = of_several, ANY_NUMBER, .step = 0.01, .decimals = 3}},
    [FIELD_SLOPE] = {NUMBER_AT(struct knot, slope), .undo = "Set slopes",
                     .ui = {NAMED("slope", "slope"), .unit = "/s", .hint = of_several, ANY_NUMBER, .step = 0.05,
                            .decimals = 2}},
    [FIELD_STIFFNESS] = {NUMBER_AT(struct knot, stiffness), .undo = "Set stiffness",
                         .ui = {NAMED("stiffness", "stiffness"), .unit = "1/s",
                                .hint = "How firmly the slopes hold; 1000 is firm", TYPED(0.001, INSPECTOR_NO_LIMIT),
                                .fallback = KNOT_DEFAULT_STIFFNESS, .step = 10, .decimals = 1}},
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

/// The first knot's.
static double get_knots(const struct inspector *in, int field, bool kept, char text[64])
{
    double first = NAN;
    bool mixed = false;
    for (struct knot_place at = SELECTED_START; selected_next(in->core, &at);) {
        const double number = number_at(&knot_rows[field], knot_at(in->core->document, at));
        if (isnan(first)) first = number;
        mixed |= number != first;
    }
    if (selected_count(in->core) > 1 && field == FIELD_FRAME) snprintf(text, 64, "%.6g …", first);
    if (mixed && field != FIELD_FRAME) snprintf(text, 64, "mixed");
    return kept ? NAN : first;
}

/// Sets the number of all selected knots, or moves them along with the first, in an order in which they do not collide. false with an error
/// if one cannot go there.
static bool set_knots(struct inspector *in, int field, double value, struct error *error)
{
    const struct originals *originals = &in->core->step.originals;
    core_collect(in->core, false);
    const double by = value - number_at(&knot_rows[field], &originals->list[0].knot);
    const bool together = in->change != UI_SET || field == FIELD_FRAME;
    for (int i = 0; i < originals->count; i++) {
        const struct original *original = &originals->list[by > 0 ? originals->count - 1 - i : i];
        struct knot knot = original->knot;
        const double number = together ? number_at(&knot_rows[field], &knot) + by : value;
        number_put(&knot_rows[field], &knot, fmax(knot_rows[field].ui.lowest, number));
        if (!edit_knot_set(in->core->document, original->spline, &knot, error)) return false;
    }
    return true;
}

static void build_knots(struct inspector *in, int field, struct rect r)
{
    static const struct number_home home = {.get = get_knots, .set = set_knots};
    struct number_row row = knot_rows[field];
    const int count = selected_count(in->core); // after the edit of the previous field
    if (count == 0) return;
    if (count == 1) { // its own hint, limits and decimals
        char text[64];
        const double value = get_knots(in, field, false, text);
        row.ui.hint = of_one[field].hint;
        row.undo = of_one[field].undo;
        if (field == FIELD_FRAME) {
            const struct spline *spline = core_active_spline(in->core);
            row.ui.lowest = in->core->document->first_frame;
            row.ui.highest =
                document_frame(in->core->document, document_last_knot_sample(in->core->document, spline));
            row.ui.decimals = value == floor(value) ? 0 : 2;
        }
        if (field == FIELD_SLOPE) row.ui.label = NULL; // its switch has the label
        if (field == FIELD_STIFFNESS && value < 10) row.ui.decimals = 3;
    }
    if (is_finished(inspector_number(in, &row, &home, field, r))) core_edited(in->core, -1);
}

/// What is true of all selected knots.
struct common {
    int holds;    ///< of enum holds, or -1
    bool sloped;  ///< among several, a still one counts as having a slope
    bool settles; ///< the motion at each
    bool still;   ///< at least one is
};

static struct common common_of(const struct inspector *in)
{
    const bool several = selected_count(in->core) > 1;
    struct common all = {.holds = -1, .sloped = true, .settles = true};
    bool first = true;
    for (struct knot_place at = SELECTED_START; selected_next(in->core, &at); first = false) {
        const struct knot *knot = knot_at(in->core->document, at);
        const int holds = (int)knot_holds(knot);
        all.holds = first || all.holds == holds ? holds : -1;
        all.sloped &= knot->has_slope || (several && knot->still);
        all.settles &= knot->settles;
        all.still |= knot->still;
    }
    return all;
}

static void build_holds(struct inspector *in)
{
    const struct common all = common_of(in);
    const int lit = all.holds;
    const struct row rows[] = {
        {NAMED("holds.value", "Value"), .hint = "Hold the value and leave the phase free", .lit = lit == HOLDS_VALUE},
        {NAMED("holds.pose", "Pose"), .hint = "Hold every part that lags as it is seen now (P)",
         .lit = lit == HOLDS_POSE},
        {NAMED("holds.still", "Still"),
         .hint = "The motion comes to rest at the equilibrium, and begins from rest (Shift+P)",
         .lit = lit == HOLDS_STILL},
        {NAMED("settles", "Settle"),
         .hint = "Let the motion stay here: it overshoots the value and swings about it (Alt+P)",
         .lit = all.settles}};
    const int pressed = inspector_buttons(in, ui_row(&in->ui, UI_ROW), rows, 4);
    if (pressed == 3) {
        core_toggle_settles(in->core);
    } else if (pressed >= 0 && pressed != lit) {
        core_set_hold(in->core, pressed);
    }
}

/// The row of a field, or why there is no number. Rows before it may have edited the knots.
static void build_field(struct inspector *in, int field, bool one)
{
    struct ui *ui = &in->ui;
    struct common all = common_of(in);
    const char *idle = NULL;
    if (field == FIELD_VALUE && all.still) idle = "not all have one";
    if (field == FIELD_PHASE && all.holds != HOLDS_POSE) idle = one ? "–" : "not all hold one";
    if (field == FIELD_SLOPE && (one ? all.still : !all.sloped)) idle = one ? "–" : "not all have one";
    if (field == FIELD_STIFFNESS && !all.sloped) idle = "–";
    if (field == FIELD_VALUE && all.holds == HOLDS_STILL) {
        inspector_parameter(in, PARAMETER_EQUILIBRIUM); // where it comes to rest
    } else if (idle) {
        inspector_idle(in, knot_rows[field].ui.label, idle);
    } else if (field != FIELD_SLOPE || !one) {
        build_knots(in, field, ui_row(ui, UI_ROW));
    } else {
        static const struct row slope = {NAMED("has_slope", NULL),
                                         .hint = "Give the knot a slope (T); D and E turn it"};
        const struct rect r = inspector_labelled(in, "slope"), beside = {r.x + 36, r.y, r.w - 36, r.h};
        if (inspector_toggle(in, r, &slope, &all.sloped)) {
            slopes_set(in->core, SLOPES_TOGGLE);
        } else if (all.sloped) {
            build_knots(in, FIELD_SLOPE, beside);
        } else {
            ui_label(ui, beside, "free", theme()->text_dim);
        }
    }
}

/// Says how many knots are selected.
static const char *knot_title(struct inspector *in)
{
    const struct simplify *cleaning = in->core->cleaning.of;
    const int count = selected_count(in->core);
    if (!cleaning && count < 2) return "Knot";
    snprintf(in->knot_title, sizeof in->knot_title, "%d knots", count);
    if (cleaning) snprintf(in->knot_title, sizeof in->knot_title, "%d knots → %d", cleaning->count, cleaning->left);
    return in->knot_title;
}

/// Has the same height for nearly every selection, so that nothing below moves.
static void build_knot(struct inspector *in)
{
    struct ui *ui = &in->ui;
    const struct spline *spline = core_active_spline(in->core);
    const int count = selected_count(in->core);
    struct knot_place only = SELECTED_START;
    const bool one = count == 1 && selected_next(in->core, &only) && only.spline == in->core->focus.active;
    const float end = ui->y + (FIELDS + 2) * UI_ROW;
    if (count > 1 || one) {
        static const enum slopes how[] = {SLOPES_FLAT, SLOPES_SMOOTH, SLOPES_TOGGLE};
        for (int field = 0; field < FIELDS; field++) {
            if (field == FIELD_PHASE) build_holds(in);
            build_field(in, field, one);
        }
        const bool sloped = common_of(in).sloped;
        const struct row rows[] = {
            {NAMED("slope.flat", "Flat"), .hint = "Make the slopes flat (Shift+T)"},
            {NAMED("slope.smooth", "Smooth"),
             .hint = "Aim the slopes at the neighbours, as Catmull-Rom does (Ctrl+T)"},
            {NAMED("slope.switch", sloped ? "Remove" : "Add"),
             .hint = sloped ? "Remove the slopes (T)" : "Give the knots the slope that the curve has there (T)"}};
        const int pressed = in->core->cleaning.of ? -1 : inspector_buttons(in, ui_row(ui, UI_ROW), rows, 3);
        if (pressed >= 0) slopes_set(in->core, (int)how[pressed]);
    } else { // the spline's knots
        const int knots = spline->knot_count;
        char frames[64] = "none", values[64] = "–";
        double range[2];
        if (knots > 0) {
            spline_values(spline, 0, knots, range);
            snprintf(frames, sizeof frames, knots == 1 ? "%d, frame %.6g" : "%d, frames %.6g … %.6g", knots,
                     spline->knots[0].frame, spline->knots[knots - 1].frame);
            snprintf(values, sizeof values, knots == 1 ? "%.4g" : "%.4g … %.4g", range[0], range[1]);
        }
        ui_paragraph(ui, "Click a knot to edit it. Double-click the curve to insert one.", theme()->text_dim);
        inspector_idle(in, "knots", frames);
        inspector_idle(in, "values", values);
        enum { FEW = 6 }; // need no thinning
        static const struct row simplify = {NAMED("knot.simplify", "Simplify"),
                                            .hint = "Fewer knots for nearly the same motion"};
        if (!in->core->cleaning.of && knots > FEW && inspector_button(in, ui_row(ui, UI_ROW), &simplify))
            core_simplify(in->core, true);
    }
    if (in->core->cleaning.of) {
        const double range = in->core->cleaning.of->range;
        const struct number_row row = {
            NUMBER_AT(struct cleaning, tolerance),
            .ui = {NAMED("tolerance", "tolerance"),
                   .hint = "How far the curve may be from any of the knots that were there", BAR(0, 0.2 * range),
                   TYPED(0, INSPECTOR_NO_LIMIT), .fallback = 0.03 * range, .step = 0.002 * range,
                   .decimals = (int)fmax(0, 3 - maths_decade(range))}};
        const struct number_home home = {.own = &in->core->cleaning};
        inspector_number(in, &row, &home, 0, ui_row(&in->ui, UI_ROW));
    }
    ui->y = fmaxf(ui->y, end);
}

enum { MAX_PINS = 8 }; ///< listed at once

enum { ROW_FRAME, ROW_POINT, PIN_ROWS = ROW_POINT + 4 };

static const struct number_row pin_rows[PIN_ROWS] = {
    {NUMBER_AT(struct pin, frame), .undo = "Move pin in time",
     .ui = {NAMED("pin.frame", "frame"), .hint = "Frame of the pin (Alt+PgUp, Alt+PgDn)", .fallback = NAN,
            .step = 1}},
    {WHOLE_AT(struct pin, point), .undo = "Pin another point",
     .ui = {.name = "pin.point", .hint = "The pinned point", .fallback = NAN, .step = 1}},
    {NUMBER_AT(struct pin, to[0]), .undo = "Move pin",
     .ui = {NAMED("pin.x", "x"), .unit = "m", .hint = "Target of the point: across; 0 is the middle", ANY_NUMBER,
            .fallback = NAN, .step = 0.005, .decimals = 3}},
    {NUMBER_AT(struct pin, to[1]), .undo = "Move pin",
     .ui = {NAMED("pin.y", "y"), .unit = "m", .hint = "Target of the point: height", ANY_NUMBER, .fallback = NAN,
            .step = 0.005, .decimals = 3}},
    {NUMBER_AT(struct pin, to[2]), .undo = "Move pin",
     .ui = {NAMED("pin.z", "z"), .unit = "m", .hint = "Target of the point: depth", ANY_NUMBER, .fallback = NAN,
            .step = 0.005, .decimals = 3}},
};

static bool set_pin(struct inspector *in, int which, double number, struct error *error)
{
    int rig;
    struct pin pin = *pins_selected(in->core, &rig);
    number_put(&pin_rows[which], &pin, number);
    return pins_set(in->core->document, rig, &pin, error);
}

static void build_pins(struct inspector *in)
{
    struct ui *ui = &in->ui;
    struct core *core = in->core;
    const int count = pins_count(core->document);
    if (count == 0)
        ui_paragraph(ui, "Drag a character's surface on the stage to pin it; on tails and chains, hold Ctrl.",
                     theme()->text_dim);

    struct pin_place place = PINS_START;
    int selected = 0, row = 0, owner;
    for (const struct pin *pin; core->focus.pin && (pin = pins_next(core->document, &place)); row++) {
        if (pin->id == core->focus.pin) selected = row;
    }
    const int first = inspector_first_row(count, selected, MAX_PINS);
    bool removed = false;
    place = PINS_START;
    for (row = 0; !removed && row < first + MAX_PINS && pins_next(core->document, &place); row++) {
        if (row < first) continue;
        const struct rig *rig = core->document->rigs[place.rig];
        const struct pin *pin = &rig->pins[place.at];
        struct rect r = ui_row(ui, UI_ROW), button = {r.x + r.w - r.h, r.y, r.h, r.h};
        char name[32], remove[32], text[160], left[32] = "";
        snprintf(name, sizeof name, "pin.%d", row);
        snprintf(remove, sizeof remove, "pin.%d.remove", row);
        snprintf(text, sizeof text, "%.6g: %.*s, %s %d", pin->frame, name_fit(rig_title(rig), 60), rig_title(rig),
                 rig_pin_key(rig), pin->point);
        const struct pin_left *way = evaluation_pin(core->evaluation, core->document, place.rig, place.at);
        const double *w = way && way->is_found ? way->way : NULL;
        const double millimetres = w ? 1e3 * sqrt(w[0] * w[0] + w[1] * w[1] + w[2] * w[2]) : NAN;
        if (isfinite(millimetres)) snprintf(left, sizeof left, "%.1f mm", millimetres);
        r.w -= r.h + 4;
        const bool pressed = ui_list_row(ui, r, name, "", 0, core->focus.pin == pin->id);
        ui_label(ui, (struct rect){r.x + 6, r.y, r.w - 66, r.h}, text, theme()->text);
        ui_label_right(ui, (struct rect){r.x, r.y, r.w - 4, r.h}, left, theme()->text_dim);
        ui_hint(ui, r, "Frame and point of a pin, and how far the point is from it");
        if (pressed) pins_visit(core, pin);
        const struct row remover = {ICON(remove, UI_ICON_DELETE), .hint = "Remove this pin", .undo = "Delete pin"};
        removed = inspector_icon(in, button, &remover) &&
                  edit_pin_remove(core->document, place.rig, pin->id, &core->step.error);
    }
    if (!removed) inspector_more(in, count, MAX_PINS, " pins; , and . show more");
    if (!pins_selected(core, &owner)) return;

    ui_space(ui, 4);
    for (int field = 0; field < PIN_ROWS && pins_selected(core, &owner); field++) {
        const struct rig *pinned = core->document->rigs[owner];
        struct number_row number = pin_rows[field];
        if (field == ROW_FRAME) {
            number.ui.lowest = core->document->first_frame;
            number.ui.highest = document_frame(core->document, pins_last_sample(core->document, pinned));
        } else if (field == ROW_POINT) {
            const struct figure *figure = models_figure(core->models, core->document, owner);
            number.ui.label = rig_pin_key(pinned);
            number.ui.highest = pinned->kind != RIG_MODEL ? bones_joints(core, owner) - 1
                                : figure                  ? figure->character.vertex_count - 1
                                                          : 0;
        }
        const struct number_home home = {.of = pins_selected(core, &owner), .set = set_pin};
        const enum ui_change change = inspector_number(in, &number, &home, field, ui_row(ui, UI_ROW));
        if (is_finished(change)) pins_tell(core, owner);
    }
}

// The panel.

enum { FOOTER = 40 }; ///< height of the look switch, which does not scroll

static const char *tail_title(struct inspector *in)
{
    const struct rig *shown = inspector_shown(in);
    return shown && shown->kind == RIG_CHAIN ? "Chain set-up" : "Tail set-up";
}

/// What a section needs, one of: a kind of rig, the active spline, a swinging spline.
enum {
    TAILS = 1 << RIG_TAIL,
    CHAINS = 1 << RIG_CHAIN,
    MODELS = 1 << RIG_MODEL,
    SPLINE = 1 << RIG_KINDS,
    SWING = SPLINE << 1,
    SOFT = SPLINE << 2, ///< a character with coordinates
};

/// Without a spline the rigs matter more.
static bool has_no_spline(const struct core *core) { return core_active_spline(core) == NULL; }

static bool has_bone_or_brush(const struct core *core)
{
    return has_no_spline(core) || core->focus.bone.any || core->focus.pick.use != BONE_SELECTED ||
           core->focus.brush.on;
}

/// In order. Replays address headers by `name`.
static const struct section {
    const char *name;
    void (*build)(struct inspector *in);
    const char *title;
    const char *(*titled)(struct inspector *in); ///< replaces a fixed title
    unsigned needs;                              ///< shown if one of these is there; 0: always
    bool (*shown)(const struct core *core);      ///< shown without More, as the first ones are; NULL: only on request
    bool closed;                                 ///< initially
} sections[] = {
    {"section.feel", inspector_feel, .titled = inspector_feel_title, .needs = SPLINE},
    {"section.knot", build_knot, .titled = knot_title, .needs = SPLINE},
    {"section.spline", inspector_spline, .title = "Spline", .needs = SPLINE},
    {"section.rigs", inspector_rigs, .title = "Rigs", .shown = has_no_spline},
    {"section.tail", inspector_tail, .titled = tail_title, .needs = TAILS | CHAINS},
    {"section.character", inspector_character, .title = "Character", .needs = MODELS, .shown = has_bone_or_brush},
    {"section.pins", build_pins, .title = "Pins", .needs = TAILS | CHAINS | SOFT, .shown = pins_any_selected},
    {"section.advanced", inspector_advanced, .title = "Advanced", .needs = SPLINE, .closed = true},
    {"section.limits", inspector_limits, .title = "Limits and steadiness", .needs = SPLINE, .closed = true},
    {"section.variation", inspector_variation, .title = "Variation", .needs = SWING, .closed = true},
    {"section.scene", build_scene, .title = "Scene", .closed = true},
    {"section.history", build_history, .title = "History", .closed = true}, // last: its height changes
};

enum { SECTIONS = sizeof sections / sizeof sections[0], FIRST = 2 /* always shown */ };

_Static_assert(SECTIONS <= (int)INSPECTOR_MAX_SECTIONS, "each has a flag in struct inspector");

void inspector_unfold(struct inspector *in, const char *name)
{
    for (int i = 0; i < SECTIONS; i++) {
        if (strcmp(sections[i].name, name) != 0) continue;
        in->called[i] = true;
        in->flipped[i] = sections[i].closed;
        in->revealed = sections[i].name; // the next pass scrolls there
    }
}

/// false if the sections no longer fit where they were laid out: a shorter panel was scrolled past its end, or one was to be revealed.
static bool build_panel(struct inspector *in, struct rect area)
{
    static const struct ui_choice looks[] = {
        [LOOK_WIGGLY] = {"wiggly", "Off"}, [LOOK_STIFF] = {"stiff", "Stiff"}, [LOOK_CUBIC] = {"cubic", "Cubic"}};
    struct ui *ui = &in->ui;
    struct rect view = {area.x, area.y, area.w, fmaxf(0, area.h - FOOTER)};
    in->list = NULL;
    ui_list_begin(ui, &in->sections, view);
    const float offset = in->sections.offset, listed = in->lines.offset;
    inspector_find_rig(in);
    if (in->core->view.shows_poles) inspector_poles(in);
    for (int i = 0; i < SECTIONS; i++) {
        const struct section *section = &sections[i];
        bool *flipped = &in->flipped[i];
        if (i == FIRST) { // at a fixed place
            const bool more = in->core->view.on[SWITCH_MORE];
            const struct rect row = ui_row(ui, UI_ROW + 4), r = {row.x, row.y + 3, row.w, UI_ROW - 2};
            ui_hint(ui, r, more ? "Show only the main sections (F9)" : "Show all sections and controls (F9)");
            if (ui_button(ui, r, "more", more ? "Less" : "More", false)) core_flip(in->core, SWITCH_MORE);
        }
        // Shown if the scene has its subject and the user needs it now.
        const struct core *core = in->core;
        const struct spline *spline = core_active_spline(core);
        unsigned found = !spline ? 0 : spline_mode(spline) == WIGGLY_CUBIC ? SPLINE : SPLINE | SWING;
        for (int r = 0; r < core->document->rig_count; r++) found |= 1u << core->document->rigs[r]->kind;
        if (characters_rig(core) >= 0) found |= SOFT;
        if (section->needs && !(section->needs & found)) continue;
        if (i >= FIRST && !core->view.on[SWITCH_MORE] && !in->called[i] && !(section->shown && section->shown(core)))
            continue;
        bool closed = *flipped != section->closed;
        const float top = ui->y;
        const bool open =
            ui_section(ui, section->name, section->titled ? section->titled(in) : section->title, &closed);
        *flipped = closed != section->closed;
        in->called[i] &= open;
        if (!open) continue;
        ui_push(ui, (uint32_t)i);
        section->build(in);
        ui_pop(ui);
        ui_space(ui, 4);
        if (!in->revealed || strcmp(in->revealed, section->name) != 0) continue;
        in->revealed = NULL;
        ui_list_show(&in->sections, top - ui->scroll_area.y + in->sections.offset, ui->y - top);
    }
    ui_space(ui, 4);
    ui_list_end(ui);
    struct ui_list next = in->sections;
    ui_list_fit(&next, view.h, next.content);

    const struct rect footer = {area.x, area.y + view.h, area.w, FOOTER};
    const struct rect row = {footer.x + UI_PAD, footer.y + 8, footer.w - 2 * UI_PAD, UI_ROW};
    if (ui->pass == UI_PASS_DRAW) {
        drawlist_rect(ui->list, footer, theme()->panel);
        drawlist_rect(ui->list, (struct rect){footer.x, footer.y, footer.w, 1}, theme()->border);
    }
    ui_hint(ui, footer, "Show the same knots without lag (stiff), or as a cubic (V)");
    int look = (int)in->core->view.look;
    if (ui_segments(ui, inspector_label(in, row, "compare with"), "look", looks, 3, &look))
        core_set_look(in->core, (enum look)look);
    inspector_splines(in);
    if (in->core->view.layout.range.w > 0) build_range(in);
    inspector_offer(in, &inspector_add_list); // A works anywhere
    if (in->list) in->list->build(in, in->list);
    return roundf(next.offset) == offset && in->lines.offset == listed;
}

struct inspector *inspector_create(struct core *core)
{
    struct inspector *in = need_zeroed(1, sizeof *in);
    in->core = core;
    return in;
}

void inspector_destroy(struct inspector *in) { free(in); }

const struct ui *inspector_ui(const struct inspector *in) { return &in->ui; }

void inspector_reset(struct inspector *in)
{
    ui_release(&in->ui);
    in->sections.offset = in->lines.offset = 0;
    in->listed = 0;
    in->rig = 0;
    in->selected = 0;
    in->channel = 0;
    memset(in->called, 0, sizeof in->called);
}

/// Whether the panel handles the event. Without keyboard focus here, keys go to the editor.
static bool concerns(const struct inspector *in, const struct event *event)
{
    const struct ui *ui = &in->ui;
    const struct layout *layout = &in->core->view.layout;
    const float x = event->x, y = event->y;
    const bool inside = rect_contains(layout->inspector, x, y) || rect_contains(layout->list, x, y) ||
                        rect_contains(layout->range, x, y);
    if (event->kind == EVENT_KEY && event->action == ACTION_RELEASE) return false;
    if (ui->popup.id) return event->kind <= EVENT_WHEEL;
    switch (event->kind) {
    case EVENT_KEY:
        if (in->core->input.held_key && !ui->typing) return false; // a held letter and an arrow go to the editor
        return ui->held || ui->typing || ui->focus || event->key == KEY_TAB;
    case EVENT_TEXT:
        return ui->typing || ui->focus;
    case EVENT_POINTER:
        return ui->held || inside;
    case EVENT_BUTTON:
        return ui->held || ui->typing || (inside && core_divider_at(in->core, x, y) == DIVIDER_NONE);
    case EVENT_WHEEL:
        return inside;
    default:
        return false;
    }
}

bool inspector_event(struct inspector *in, const struct event *event)
{
    struct ui *ui = &in->ui;
    struct rect area = in->core->view.layout.inspector;
    if (!concerns(in, event)) {
        if (event->kind == EVENT_SIZE) ui->popup.id = 0; // its anchor has moved
        if (event->kind != EVENT_POINTER && event->kind != EVENT_BUTTON) return false;
        ui->pointer_x = event->x;
        ui->pointer_y = event->y;
        ui->hint = NULL;
        if (event->kind == EVENT_BUTTON && event->action == ACTION_PRESS) ui->focus = 0;
        return false;
    }
    const bool press = event->action == ACTION_PRESS && (event->kind == EVENT_BUTTON || event->kind == EVENT_KEY);
    if (press && !ui->typing) in->alone = event->mods & MOD_ALT;
    bool was_dragging = ui->held && ui->moved;
    ui_begin_event(ui, area, event);
    build_panel(in, area);
    bool used = ui_end(ui);
    const bool is_open = history_is_open(in->core->history);
    if (was_dragging && !ui->held) in->core->step.ends = is_open;
    if (inspector_is_dragging(in) && is_open && !in->core->step.ends) {
        core_keep_following(in->core);
        core_settle(in->core);
    }
    if (ui->complaint[0]) {
        core_message(in->core, true, "%s", ui->complaint);
        ui->complaint[0] = '\0';
    }
    bool inside = rect_contains(area, ui->pointer_x, ui->pointer_y);
    bool pointer = event->kind == EVENT_POINTER || event->kind == EVENT_WHEEL ||
                   (event->kind == EVENT_BUTTON && event->action == ACTION_PRESS);
    return used || (pointer && inside);
}

void inspector_show(struct inspector *in, bool covered)
{
    struct rect area = in->core->view.layout.inspector;
    if (covered) in->ui.pointer_x = area.x - 1; // nothing here is under the pointer
    const struct bone_selection *bone = &in->core->focus.bone, *seen = &in->seen_bone;
    const bool same = bone->any == seen->any && bone->node == seen->node && bone->file == seen->file;
    in->seen_bone = *bone;
    if (!same && bone->any) inspector_unfold(in, "section.character");
    struct drawlist *list = &in->core->list;
    const struct drawlist below = *list;
    bool fits = false;
    for (int pass = 0; pass < 2 && !fits; pass++) { // seldom twice
        *list = below;
        drawlist_rect(list, area, theme()->panel);
        ui_begin_draw(&in->ui, area, list);
        fits = build_panel(in, area);
        ui_end(&in->ui);
    }
}

void inspector_let_go(struct inspector *in)
{
    if (inspector_is_dragging(in) && history_is_open(in->core->history)) in->core->step.ends = true;
    core_close(in->core);
    ui_release(&in->ui);
}

bool inspector_is_dragging(const struct inspector *in) { return in->ui.held && in->ui.moved; }

bool inspector_target(struct inspector *in, const char *name, float *x, float *y)
{
    char widget[UI_NAME_SIZE];
    snprintf(widget, sizeof widget, "%s", name);
    char *comma = strrchr(widget, ',');
    double value = 0;
    if (comma) {
        char *end;
        value = strtod(comma + 1, &end);
        if (end == comma + 1 || *end || !isfinite(value)) return false;
        *comma = '\0';
    }
    ui_begin_find(&in->ui, in->core->view.layout.inspector, widget, comma ? &value : NULL);
    build_panel(in, in->core->view.layout.inspector);
    bool found = ui_end(&in->ui);
    *x = in->ui.found_x;
    *y = in->ui.found_y;
    return found;
}
