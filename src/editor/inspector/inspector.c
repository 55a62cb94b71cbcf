/// The inspector: the table of its sections, what they share, and the sections on scene and history.
#include "editor/inspector/inspector.h"
#include "base/need.h"
#include "editor/core/core.h"
#include "editor/core/knots.h"
#include "editor/core/pins.h"
#include "editor/inspector/state.h"
#include "ui/theme.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

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
    CHARACTERS = 1 << RIG_CHARACTER,
    MODELS = 1 << RIG_MODEL,
    SPLINE = 1 << RIG_KINDS,
    SWING = SPLINE << 1,
};

static bool always(const struct core *core)
{
    (void)core;
    return true;
}

/// Without a spline the rigs matter more.
static bool has_no_spline(const struct core *core) { return core_active_spline(core) == NULL; }

static bool has_bone(const struct core *core)
{
    return has_no_spline(core) || core->bone.any || core->pick.use != BONE_SELECTED;
}

static bool has_brush(const struct core *core) { return core->brush.on; }

/// In order. Replays address headers by `name`.
static const struct section {
    const char *name;
    void (*build)(struct inspector *in);
    const char *title;
    const char *(*titled)(struct inspector *in); ///< replaces a fixed title
    unsigned needs;                              ///< shown if one of these is there; 0: always
    bool (*shown)(const struct core *core);      ///< shown without More; NULL: only on request
    bool closed;                                 ///< initially
} sections[] = {
    {"section.feel", inspector_feel, .titled = inspector_feel_title, .needs = SPLINE, .shown = always},
    {"section.knot", inspector_knot, .titled = inspector_knot_title, .needs = SPLINE, .shown = always},
    {"section.splines", inspector_splines, .title = "Splines", .shown = always},
    {"section.spline", inspector_spline, .title = "Spline", .needs = SPLINE},
    {"section.rigs", inspector_rigs, .title = "Rigs", .shown = has_no_spline},
    {"section.model", inspector_model, .title = "Imported character", .needs = MODELS, .shown = has_bone},
    {"section.tail", inspector_tail, .titled = tail_title, .needs = TAILS | CHAINS},
    {"section.character", inspector_character, .title = "Character", .needs = CHARACTERS, .shown = has_brush},
    {"section.pins", inspector_pins, .title = "Pins", .needs = TAILS | CHAINS | CHARACTERS,
     .shown = pins_any_selected},
    {"section.advanced", inspector_advanced, .title = "Advanced", .needs = SPLINE, .closed = true},
    {"section.poles", inspector_poles, .title = "Poles and response", .needs = SPLINE, .closed = true},
    {"section.limits", inspector_limits, .title = "Limits and steadiness", .needs = SPLINE, .closed = true},
    {"section.variation", inspector_variation, .title = "Variation", .needs = SWING, .closed = true},
    {"section.scene", inspector_scene, .title = "Scene", .closed = true},
    {"section.history", inspector_history, .title = "History", .closed = true}, // last: its height changes
};

enum { SECTIONS = sizeof sections / sizeof sections[0], FIRST = 3 /* of sections that More opens */ };

_Static_assert(SECTIONS <= (int)INSPECTOR_MAX_SECTIONS, "each has a flag in struct inspector");

/// Whether the scene has the section's subject and the user needs it now.
static bool is_shown(const struct inspector *in, int i)
{
    const struct section *section = &sections[i];
    const struct core *core = in->core;
    const struct spline *spline = core_active_spline(core);
    unsigned found = !spline ? 0 : spline_mode(spline) == WIGGLY_CUBIC ? SPLINE : SPLINE | SWING;
    for (int r = 0; r < core->document->rig_count; r++) found |= 1u << core->document->rigs[r]->kind;
    if (section->needs && !(section->needs & found)) return false;
    return core->more || in->called[i] || (section->shown && section->shown(core));
}

static void build_sections(struct inspector *in)
{
    struct ui *ui = &in->ui;
    inspector_find_rig(in);
    for (int i = 0; i < SECTIONS; i++) {
        const struct section *section = &sections[i];
        bool *flipped = &in->flipped[i];
        if (i == FIRST) { // at a fixed place
            const bool more = in->core->more;
            const struct rect row = ui_row(ui, UI_ROW + 4), r = {row.x, row.y + 3, row.w, UI_ROW - 2};
            ui_hint(ui, r, more ? "Show only the main sections (F9)" : "Show all sections and controls (F9)");
            if (ui_button(ui, r, "more", more ? "Less" : "More", false)) core_flip(in->core, SWITCH_MORE);
        }
        if (!is_shown(in, i)) continue;
        bool closed = *flipped != section->closed;
        const float top = ui->y;
        bool open = ui_section(ui, section->name, section->titled ? section->titled(in) : section->title, &closed);
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
}

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
    const float offset = in->sections.offset;
    build_sections(in);
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
    int look = (int)in->core->look;
    if (ui_segments(ui, inspector_label(in, row, "compare with"), "look", looks, 3, &look))
        core_set_look(in->core, (enum look)look);
    inspector_offer(in, &inspector_add_list); // A works anywhere
    if (in->list) in->list->build(in, in->list);
    return roundf(next.offset) == offset;
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
    in->sections.offset = 0;
    in->rig = 0;
    in->selected = 0;
    in->model = 0;
    in->channel = 0;
    memset(in->called, 0, sizeof in->called);
}

/// Whether the panel handles the event. Without keyboard focus here, keys go to the editor.
static bool concerns(const struct inspector *in, const struct event *event)
{
    const struct ui *ui = &in->ui;
    struct rect area = in->core->layout.inspector;
    bool input = event->kind <= EVENT_WHEEL;
    const bool inside =
        rect_contains(area, event->x, event->y) && core_divider_at(in->core, event->x, event->y) == DIVIDER_NONE;
    if (event->kind == EVENT_KEY && event->action == ACTION_RELEASE) return false;
    if (ui->popup.id) return input;
    switch (event->kind) {
    case EVENT_KEY:
        if (in->core->held_key && !ui->typing) return false; // a held letter and an arrow go to the editor
        return ui->held || ui->typing || ui->focus || event->key == KEY_TAB;
    case EVENT_TEXT:
        return ui->typing || ui->focus;
    case EVENT_POINTER:
        return ui->held || rect_contains(area, event->x, event->y);
    case EVENT_BUTTON:
        return ui->held || ui->typing || inside;
    case EVENT_WHEEL:
        return rect_contains(area, event->x, event->y);
    default:
        return false;
    }
}

bool inspector_event(struct inspector *in, const struct event *event)
{
    struct ui *ui = &in->ui;
    struct rect area = in->core->layout.inspector;
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
    if (was_dragging && !ui->held && history_is_open(in->core->history)) history_end(in->core->history);
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
    struct rect area = in->core->layout.inspector;
    if (covered) in->ui.pointer_x = area.x - 1; // nothing here is under the pointer
    const struct bone_selection *bone = &in->core->bone, *seen = &in->seen_bone;
    const bool same = bone->any == seen->any && bone->node == seen->node && bone->file == seen->file;
    in->seen_bone = *bone;
    if (!same && bone->any) inspector_unfold(in, "section.model");
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
    if (inspector_is_dragging(in) && history_is_open(in->core->history)) history_end(in->core->history);
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
    ui_begin_find(&in->ui, in->core->layout.inspector, widget, comma ? &value : NULL);
    build_panel(in, in->core->layout.inspector);
    bool found = ui_end(&in->ui);
    *x = in->ui.found_x;
    *y = in->ui.found_y;
    return found;
}

bool inspector_changed(enum ui_change change) { return change == UI_DROP || change == UI_SET || change == UI_NUDGE; }

bool inspector_begin(struct inspector *in, enum ui_change change, const char *label, const char *what)
{
    struct history *history = in->core->history;
    switch (change) {
    case UI_NONE:
        return false;
    case UI_DRAG:
        in->core->error = (struct error){0};
        if (!core_begin(in->core, label, 0)) history_restart(history);
        return true;
    case UI_CANCEL:
    case UI_DROP:
        if (history_is_open(history)) core_end(in->core, change == UI_DROP);
        return false;
    case UI_NUDGE:
    case UI_SET:
        return core_begin(in->core, label, change == UI_NUDGE ? core_merge_key(in->core, ui_id(&in->ui, what)) : 0);
    }
    return false;
}

void inspector_end(struct inspector *in, enum ui_change change, bool done)
{
    if (change == UI_DRAG) {
        core_keep_following(in->core);
        core_settle(in->core);
    } else {
        core_end(in->core, done);
    }
}

double number_at(const struct number_row *row, const void *of)
{
    const char *at = (const char *)of + row->at;
    double number;
    int whole;
    if (row->is_whole) {
        memcpy(&whole, at, sizeof whole);
        return whole;
    }
    memcpy(&number, at, sizeof number);
    return number;
}

void number_put(const struct number_row *row, void *of, double number)
{
    char *at = (char *)of + row->at;
    const int whole = row->is_whole ? (int)lround(number) : 0;
    if (row->is_whole) {
        memcpy(at, &whole, sizeof whole);
    } else {
        memcpy(at, &number, sizeof number);
    }
}

static double get_number(const struct inspector *in, const struct number_row *row, const struct number_home *home,
                         int which)
{
    if (home->rig) return number_at(row, in->core->document->rigs[home->rig(in)]);
    return home->of ? number_at(row, home->of(in)) : home->get(in, which);
}

static bool set_number(struct inspector *in, const struct number_row *row, const struct number_home *home, int which,
                       double number, struct error *error)
{
    if (home->set) return home->set(in, which, number, error);
    const int rig = home->rig(in);
    struct rig changed = *in->core->document->rigs[rig];
    number_put(row, &changed, number);
    return edit_rig_set(in->core->document, rig, &changed, error);
}

/// Sets a number in one undo step; a drag repeats that step in each frame.
static void change_number(struct inspector *in, const struct number_row *row, const struct number_home *home,
                          int which, enum ui_change change, double value)
{
    const bool is_first = change == UI_DRAG && !history_is_open(in->core->history);
    in->change = change;
    if (!inspector_begin(in, change, row->undo, row->name)) return;
    if (is_first) in->dragged = get_number(in, row, home, which);
    if (change != UI_DRAG) {
        inspector_end(in, change, set_number(in, row, home, which, value, &in->core->error));
        return;
    }
    if (set_number(in, row, home, which, value, NULL)) {
        in->dragged = value;
    } else { // stop at the last possible value
        history_restart(in->core->history);
        set_number(in, row, home, which, in->dragged, NULL);
    }
    inspector_end(in, change, true);
}

enum ui_change inspector_number(struct inspector *in, const struct number_row *row, const struct number_home *home,
                                int which, struct rect r)
{
    const bool waits = home->settles && ui_is_dragged(&in->ui, row->name);
    char shown[64];
    double value = waits ? in->dragged : get_number(in, row, home, which);
    const double was = home->was && in->core->take.document ? home->was(in, which) : NAN;
    if (isfinite(was) && in->ui.pass == UI_PASS_DRAW && take_is_shown(in->core)) value = was;
    struct ui_number number = {.name = row->name,
                               .label = row->label,
                               .unit = row->unit,
                               .hint = row->hint,
                               .shown = waits         ? shown
                                        : home->shown ? home->shown(in, which, shown)
                                                      : NULL,
                               .minimum = row->minimum,
                               .maximum = row->maximum,
                               .was = isfinite(was) ? &was : NULL,
                               .lowest = row->lowest,
                               .highest = row->highest,
                               .fallback = row->fallback,
                               .step = row->step,
                               .decimals = row->decimals};
    if (waits) snprintf(shown, sizeof shown, "%g%s%s", value, row->unit ? " " : "", row->unit ? row->unit : "");
    const enum ui_change change = ui_value(&in->ui, r, &number, &value);
    if (change == UI_SET && row->is_whole && value != floor(value)) {
        snprintf(in->ui.complaint, sizeof in->ui.complaint, "%s: expected a whole number, got %g", row->label, value);
        return UI_NONE;
    }
    if (row->undo) {
        change_number(in, row, home, which, change, value);
    } else if (home->settles ? inspector_changed(change) : change != UI_NONE) {
        home->set(in, which, value, NULL);
    }
    if (home->settles && change == UI_DRAG) in->dragged = value;
    return change;
}

void inspector_numbers(struct inspector *in, const struct number_row *rows, int count, const struct number_home *home)
{
    for (int i = 0; i < count; i++) inspector_number(in, &rows[i], home, i, ui_row(&in->ui, UI_ROW));
}

int inspector_spline_items(const struct inspector *in, const bool *left_out, int chosen, struct ui_item *items,
                           int *splines, int *row)
{
    int count = 0;
    *row = -1;
    for (int s = 0; s < in->core->document->spline_count && s < INSPECTOR_MAX_SPLINES; s++) {
        if (left_out && left_out[s]) continue;
        const char *name = in->core->document->splines[s]->name;
        if (s == chosen) *row = count;
        items[count] = (struct ui_item){name, name, spline_list_color(in->core->document, s)};
        splines[count++] = s;
    }
    return count;
}

int inspector_spline_list(struct inspector *in, const struct dropdown *list, int chosen)
{
    struct ui_item items[INSPECTOR_MAX_SPLINES];
    int splines[INSPECTOR_MAX_SPLINES] = {0}, row;
    const int count = inspector_spline_items(in, NULL, chosen, items, splines, &row);
    int picked = ui_popup_list(&in->ui, list->name, items, count, row);
    return picked < 0 ? -1 : splines[picked];
}

void inspector_offer(struct inspector *in, const struct dropdown *list)
{
    if (ui_popup_is_open(&in->ui, list->name)) in->list = list;
}

void inspector_dropdown(struct inspector *in, const struct dropdown *list, struct rect r, int which, const char *text,
                        uint32_t color)
{
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

bool inspector_choice(struct inspector *in, const char *label, const char *hint, const char *name,
                      const struct ui_choice *choices, int count, int *chosen)
{
    const struct rect r = inspector_labelled(in, label);
    ui_hint(&in->ui, r, hint);
    return ui_segments(&in->ui, r, name, choices, count, chosen);
}

int inspector_icons(struct inspector *in, struct rect r, const struct icon_button *buttons, int count)
{
    int pressed = -1;
    for (int i = 0; i < count; i++) {
        const struct rect icon = {r.x - 2 + (float)(i * (INSPECTOR_ICON + 6)), r.y, INSPECTOR_ICON, r.h};
        if (ui_icon_button(&in->ui, icon, buttons[i].name, buttons[i].icon, false, buttons[i].hint)) pressed = i;
    }
    return pressed;
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

enum { ROW_RATE, ROW_FIRST, ROW_LAST, ROW_SUBSTEPS, SCENE_ROWS };

static const void *document_of(const struct inspector *in) { return in->core->document; }

/// Rate and range ask before they move knots.
static bool set_scene(struct inspector *in, int which, double number, struct error *error)
{
    const struct document *document = in->core->document;
    const int whole = (int)lround(number);
    (void)error;
    if (which == ROW_RATE) spline_list_fps(in->core, number);
    if (which == ROW_FIRST) spline_list_range(in->core, whole, document->last_frame);
    if (which == ROW_LAST) spline_list_range(in->core, document->first_frame, whole);
    if (which == ROW_SUBSTEPS && core_begin(in->core, "Set substeps", 0))
        core_end(in->core, edit_substeps(in->core->document, whole, &in->core->error));
    return true;
}

static const struct number_row scene_rows[SCENE_ROWS] = {
    [ROW_RATE] = {NUMBER_AT(struct document, fps), .name = "scene.fps", .label = "rate", .unit = "fps",
                  .hint = "Frames per second; asks whether to keep frames or seconds", TYPED(0.001, SCENE_MAX_FPS),
                  .fallback = 24, .step = 1},
    [ROW_FIRST] = {WHOLE_AT(struct document, first_frame), .name = "scene.first", .label = "first",
                   .hint = "First frame of the scene", TYPED(-SCENE_MAX_FRAME, SCENE_MAX_FRAME), .fallback = NAN,
                   .step = 1},
    [ROW_LAST] = {WHOLE_AT(struct document, last_frame), .name = "scene.last", .label = "last",
                  .hint = "Last frame of the scene; in a loop it repeats the first",
                  TYPED(-SCENE_MAX_FRAME, SCENE_MAX_FRAME), .fallback = NAN, .step = 1},
    [ROW_SUBSTEPS] = {WHOLE_AT(struct document, substeps), .name = "scene.substeps", .label = "substeps",
                      .hint = "Samples per frame, for motion blur", TYPED(1, SCENE_MAX_SUBSTEPS), .fallback = 1,
                      .step = 1},
};

void inspector_scene(struct inspector *in)
{
    static const struct number_home home = {.of = document_of, .set = set_scene, .settles = true};
    for (int i = 0; i < SCENE_ROWS; i++) {
        struct number_row row = scene_rows[i];
        const double longest = document_longest(in->core->document);
        if (i == ROW_RATE && in->core->document->fps != floor(in->core->document->fps)) row.decimals = 3;
        if (i == ROW_FIRST) row.lowest = fmax(row.lowest, in->core->document->last_frame - longest);
        if (i == ROW_LAST) row.highest = fmin(row.highest, in->core->document->first_frame + longest);
        inspector_number(in, &row, &home, i, ui_row(&in->ui, UI_ROW));
    }
    const struct rect r = inspector_labelled(in, "solver");
    ui_hint(&in->ui, r,
            "Band: all samples at once, as in the paper. Chain: from knot to knot, beyond 4096 samples or 300 "
            "without a knot");
    if (in->core->evaluation) ui_label(&in->ui, r, evaluation_solver(in->core->evaluation), theme()->text);
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

/// Row 0 is the state before the oldest step, row n the state after step n.
static bool build_step(struct inspector *in, size_t row)
{
    const struct history *history = in->core->history;
    const struct history_view *view = &in->history;
    struct ui *ui = &in->ui;
    struct rect r = ui_row(ui, UI_ROW);
    char name[32], text[96];
    name_of(row, name);
    const size_t dropped = history_dropped(history);
    if (row > 0) {
        snprintf(text, sizeof text, "%s", history_label(history, row - 1));
    } else if (dropped == 0) {
        snprintf(text, sizeof text, "Opened");
    } else {
        snprintf(text, sizeof text, "%zu older step%s dropped", dropped, dropped == 1 ? " was" : "s were");
    }
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
    const struct rect list = {in->ui.area.x, in->ui.y, in->ui.area.w, (float)(end - first) * UI_ROW};
    for (size_t row = first; row < end; row++) {
        if (build_step(in, row)) pressed = row;
    }
    if (count + 1 > HISTORY_ROWS) {
        char text[96];
        snprintf(text, sizeof text, "Steps %zu to %zu of %zu", first > 0 ? first : 1, end - 1, count);
        ui_paragraph(&in->ui, text, theme()->text_dim);
    }
    const struct event *event = in->ui.event; // at its end the wheel scrolls the panel
    if (in->ui.pass == UI_PASS_EVENT && event->kind == EVENT_WHEEL && !in->ui.used && ui_hovered(&in->ui, list))
        in->ui.used = ui_list_scroll(&view->list, event->dy > 0 ? -3 : 3);
    step_by_key(in, first, end);
    if (pressed < end) go_to(in, pressed);
}
