/// The inspector's list of rigs, and the menu of additions.
#include "editor/core/rigs.h"
#include "base/file.h"
#include "base/names.h"
#include "editor/core/bones.h"
#include "editor/core/core.h"
#include "editor/core/knots.h"
#include "editor/inspector/inspector.h"
#include "editor/inspector/parts.h"
#include <stdio.h>

enum { MAX_ROWS = 12 }; ///< listed at once

static bool is_tail_or_chain(const struct document *document, int rig)
{
    return rig >= 0 && rig < document->rig_count &&
           (document->rigs[rig]->kind == RIG_TAIL || document->rigs[rig]->kind == RIG_CHAIN);
}

const struct rig *inspector_shown(const struct inspector *in)
{
    const int rig = in->rig;
    return is_tail_or_chain(in->core->document, rig) ? in->core->document->rigs[rig] : NULL;
}

void inspector_find_rig(struct inspector *in)
{
    const int limb = core_limb(in->core);
    if (limb >= 0 && limb != in->selected) inspector_show_spline(in, in->core->active); // dragged, not clicked
    if (!inspector_shown(in)) {
        const int tail = document_find_rig(in->core->document, RIG_TAIL, 0),
                  chain = document_find_rig(in->core->document, RIG_CHAIN, 0);
        in->rig = tail >= 0 ? tail : chain >= 0 ? chain : 0;
        in->channel = 0;
    }
    const struct rig *shown = inspector_shown(in);
    if (shown && in->channel >= rig_input_count(shown)) in->channel = 0;
    if (in->selected >= in->core->document->rig_count) in->selected = in->core->document->rig_count - 1;
    if (in->selected < 0) in->selected = 0;
}

/// Shows a rig in the section of its kind.
static void show_rig(struct inspector *in, int rig)
{
    struct core *core = in->core;
    const int number = document_rig_number(core->document, rig);
    in->selected = rig;
    switch (core->document->rigs[rig]->kind) {
    case RIG_TAIL:
    case RIG_CHAIN:
        in->channel = rig == in->rig ? in->channel : 0;
        in->rig = rig;
        break;
    case RIG_CHARACTER:
        core->characters.drive = number == core->characters.character ? core->characters.drive : 0;
        core->characters.character = number;
        break;
    case RIG_MODEL:
        in->model = number;
        break;
    case RIG_KINDS:
        break;
    }
}

static int input_of(const struct rig *rig, int spline)
{
    for (int i = 0; i < rig_input_count(rig); i++) {
        if (rig_input(rig, i) == spline) return i;
    }
    return -1;
}

void inspector_show_spline(struct inspector *in, int spline)
{
    const struct document *document = in->core->document;
    const int limb = core_limb(in->core);
    int found = limb >= 0 ? limb : in->selected < document->rig_count ? in->selected : -1;
    if (found >= 0 && input_of(document->rigs[found], spline) < 0) found = -1;
    for (int r = 0; r < document->rig_count && found < 0; r++) {
        if (input_of(document->rigs[r], spline) >= 0) found = r;
    }
    if (found < 0) return;
    const int input = input_of(document->rigs[found], spline);
    show_rig(in, found);
    if (is_tail_or_chain(document, found)) in->channel = input;
    if (document->rigs[found]->kind == RIG_CHARACTER) in->core->characters.drive = input;
}

void inspector_show_rig(struct inspector *in, int rig)
{
    static const char *const sections[] = {[RIG_TAIL] = "section.tail",
                                           [RIG_CHAIN] = "section.tail",
                                           [RIG_CHARACTER] = "section.character",
                                           [RIG_MODEL] = "section.model"};
    const struct rig *chosen = in->core->document->rigs[rig];
    if (chosen->kind == RIG_MODEL) bones_clear(in->core);
    show_rig(in, rig);
    in->core->limb = chosen->id;
    inspector_unfold(in, sections[chosen->kind]);
    if (rig_input_count(chosen) == 0) return;
    if (input_of(chosen, in->core->active) < 0) core_activate(in->core, rig_input(chosen, 0));
    inspector_show_spline(in, in->core->active);
}

void inspector_show_clicked(struct inspector *in)
{
    const int rig = in->core->clicked - 1;
    in->core->clicked = 0;
    if (rig < 0 || rig >= in->core->document->rig_count) return;
    inspector_show_rig(in, rig);
    in->seen_bone = in->core->bone; // of a chain
    in->revealed = NULL;
}

static void build_row(struct inspector *in, int rig)
{
    const struct rig *shown = in->core->document->rigs[rig];
    const struct rect r = ui_row(&in->ui, UI_ROW);
    char name[32], text[160];
    snprintf(name, sizeof name, "%s.%d", rig_word(shown->kind), document_rig_number(in->core->document, rig));
    snprintf(text, sizeof text, "%.*s, %s", name_fit(path_name(rig_title(shown)), 100), path_name(rig_title(shown)),
             rig_word(shown->kind));
    const uint32_t color =
        rig_input_count(shown) > 0 ? spline_list_color(in->core->document, rig_input(shown, 0)) : 0;
    ui_hint(&in->ui, r, "Show this rig and the splines that drive it");
    if (ui_list_row(&in->ui, r, name, text, color, rig == in->selected)) inspector_show_rig(in, rig);
}

enum { MAX_COPIES = 4, MAX_ITEMS = 5 + MAX_COPIES, LABEL = 96, WIDTH = 244 };

static void open_add(struct inspector *in, struct rect at)
{
    at.w = WIDTH;
    ui_popup_open(&in->ui, inspector_add_list.name, 0, at);
}

static void build_buttons(struct inspector *in)
{
    static const struct icon_button buttons[] = {
        {"rig.add", "Add a tail, a character, a chain … (A)", UI_ICON_ADD},
        {"rig.copy", "Copy this rig, beside it", UI_ICON_COPY},
        {"rig.delete", "Remove this rig, with its splines or without (Shift+Del)", UI_ICON_DELETE},
    };
    const struct rect r = ui_row(&in->ui, UI_ROW);
    const int before = in->core->document->rig_count, rig = in->selected;
    const int pressed = inspector_icons(in, r, buttons, before > 0 ? 3 : 1);
    if (pressed == 0) open_add(in, (struct rect){r.x - 2, r.y, INSPECTOR_ICON, r.h});
    if (pressed == 1) rigs_copy(in->core, rig);
    if (pressed == 2) rigs_ask_remove(in->core, rig);
    if (in->core->document->rig_count > before) inspector_show_rig(in, before);
}

void inspector_remove_rig(struct inspector *in, int unused)
{
    (void)unused;
    rigs_ask_remove(in->core, in->selected);
}

void inspector_rigs(struct inspector *in)
{
    const int count = in->core->document->rig_count, first = inspector_first_row(count, in->selected, MAX_ROWS);
    if (count == 0) ui_paragraph(&in->ui, "Nothing is on the stage yet.", theme()->text_dim);
    for (int r = first; r < count && r < first + MAX_ROWS; r++) build_row(in, r);
    inspector_more(in, count, MAX_ROWS, "");
    build_buttons(in);
}

struct choice {
    enum added what;
    int rig; ///< for ADD_COPY
};

struct menu {
    struct choice choices[MAX_ITEMS];
    struct ui_item items[MAX_ITEMS];
    char names[MAX_COPIES][24], labels[MAX_COPIES][LABEL];
    int count;
};

static void add_item(struct menu *menu, struct choice choice, const char *name, const char *label)
{
    menu->choices[menu->count] = choice;
    menu->items[menu->count++] = (struct ui_item){name, label, 0};
}

static void add_copies(const struct inspector *in, struct menu *menu)
{
    int copies = 0;
    for (int r = 0; r < in->core->document->rig_count && copies < MAX_COPIES; r++) {
        const struct rig *rig = in->core->document->rigs[r];
        if (rig->kind != RIG_CHARACTER && rig->kind != RIG_MODEL) continue;
        snprintf(menu->names[copies], sizeof menu->names[0], "copy.%d", r);
        snprintf(menu->labels[copies], LABEL, "One more %.*s", name_fit(path_name(rig_title(rig)), 80),
                 path_name(rig_title(rig)));
        add_item(menu, (struct choice){ADD_COPY, r}, menu->names[copies], menu->labels[copies]);
        copies++;
    }
}

static void fill(const struct inspector *in, struct menu *menu)
{
    const struct document *document = in->core->document;
    add_item(menu, (struct choice){ADD_TAIL, 0}, "tail", "Tail");
    add_item(menu, (struct choice){ADD_FILE, 0}, "file", "Character or model from a file …");
    add_copies(in, menu);
    if (document_find_rig(document, RIG_MODEL, 0) >= 0)
        add_item(menu, (struct choice){ADD_CHAIN, 0}, "chain", "Chain from the selected bone (J)");
    add_item(menu, (struct choice){ADD_SPLINE, 0}, "spline", "Spline");
}

static void carry_out(struct inspector *in, struct choice choice)
{
    const int before = in->core->document->rig_count;
    switch (choice.what) {
    case ADD_TAIL:
        rigs_add_tail(in->core);
        break;
    case ADD_FILE:
        core_request(in->core, REQUEST_ADD, NULL);
        break;
    case ADD_COPY:
        rigs_copy(in->core, choice.rig);
        break;
    case ADD_CHAIN:
        bones_make_chain(in->core, false);
        break;
    case ADD_SPLINE:
        spline_list_add(in->core);
        break;
    }
    if (in->core->document->rig_count > before) inspector_show_rig(in, before);
}

void inspector_add(struct inspector *in, int what) { carry_out(in, (struct choice){(enum added)what, in->selected}); }

static void choose_added(struct inspector *in, const struct dropdown *list)
{
    struct menu menu = {.count = 0};
    fill(in, &menu);
    const int picked = ui_popup_list(&in->ui, list->name, menu.items, menu.count, -1);
    if (picked >= 0) carry_out(in, menu.choices[picked]);
}

const struct dropdown inspector_add_list = {.name = "add", .build = choose_added};

void inspector_add_menu(struct inspector *in, int unused)
{
    const struct layout *layout = &in->core->layout;
    const float x = in->core->pointer_x, y = in->core->pointer_y;
    const bool beside = rect_contains(layout->stage, x, y) || rect_contains(layout->curves, x, y);
    const struct rect panel = layout->inspector;
    (void)unused;
    open_add(in, beside ? (struct rect){x, y, 0, 0} : (struct rect){panel.x + UI_PAD, panel.y, 0, 4});
    if (beside) in->ui.popup.room = (struct rect){0, 0, panel.x, layout->status.y};
    ui_push(&in->ui, 0);
    in->ui.focus = ui_id(&in->ui, "item.tail"); // the first row
    ui_pop(&in->ui);
}
