/// The menu of what can be added to the scene (A, or the + of the list of rigs).
#include "base/path.h"
#include "editor/core/arrange.h"
#include "editor/core/bones.h"
#include "editor/core/core.h"
#include "editor/core/rigs.h"
#include "editor/inspector/inspection.h"
#include "editor/inspector/inspector.h"
#include <stdio.h>

enum { MAX_COPIES = 4, MAX_ITEMS = 5 + MAX_COPIES, LABEL = 96, WIDTH = 244 };

static const char add_list[] = "add";

/// A row of the menu.
struct choice {
    enum { ADD_TAIL, ADD_FILE, ADD_COPY, ADD_CHAIN, ADD_MEADOW, ADD_SPLINE } what;
    int rig; ///< of ADD_COPY
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

static void add_copies(const struct inspection *in, struct menu *menu)
{
    int copies = 0;
    for (int r = 0; r < in->document->rig_count && copies < MAX_COPIES; r++) {
        const struct rig *rig = &in->document->rigs[r];
        if (rig->kind != RIG_CHARACTER && rig->kind != RIG_MODEL) continue;
        snprintf(menu->names[copies], sizeof menu->names[0], "copy.%d", r);
        snprintf(menu->labels[copies], LABEL, "One more %.80s", path_name(rig_title(rig)));
        add_item(menu, (struct choice){ADD_COPY, r}, menu->names[copies], menu->labels[copies]);
        copies++;
    }
}

static void fill(const struct inspection *in, struct menu *menu)
{
    const struct document *document = in->document;
    add_item(menu, (struct choice){ADD_TAIL, 0}, "tail", "Tail");
    add_item(menu, (struct choice){ADD_FILE, 0}, "file", "Character or model from a file …");
    add_copies(in, menu);
    if (document_find_rig(document, RIG_MODEL, 0) >= 0)
        add_item(menu, (struct choice){ADD_CHAIN, 0}, "chain", "Chain from the selected bone (J)");
    if (document_find_rig(document, RIG_MEADOW, 0) < 0)
        add_item(menu, (struct choice){ADD_MEADOW, 0}, "meadow", "Meadow");
    add_item(menu, (struct choice){ADD_SPLINE, 0}, "spline", "Spline");
}

static void carry_out(struct inspection *in, struct choice choice)
{
    const int before = in->document->rig_count;
    switch (choice.what) {
    case ADD_TAIL:
        rigs_add_tail(in->core, in->world);
        break;
    case ADD_FILE:
        in->core->ask = (struct ask){.kind = ASK_ADD};
        break;
    case ADD_COPY:
        rigs_copy(in->core, in->world, choice.rig);
        break;
    case ADD_CHAIN:
        bones_make_chain(in->core, in->world, false);
        break;
    case ADD_MEADOW:
        rigs_add_meadow(in->core, in->world);
        break;
    case ADD_SPLINE:
        arrange_add(in->core, in->world);
        break;
    }
    if (in->document->rig_count > before) inspector_choose_rig(in, before);
}

void inspector_add_list(struct inspection *in)
{
    struct menu menu = {.count = 0};
    if (!ui_popup_is_open(in->ui, add_list)) return;
    fill(in, &menu);
    const int picked = ui_popup_list(in->ui, add_list, menu.items, menu.count, -1);
    if (picked >= 0) carry_out(in, menu.choices[picked]);
}

void inspector_open_add(struct inspector *inspector, struct rect at)
{
    at.w = WIDTH;
    ui_popup_open(&inspector->ui, add_list, 0, at);
}

void inspector_add_menu(struct inspector *inspector, const struct core *core)
{
    const struct layout *layout = &core->layout;
    const float x = core->pointer_x, y = core->pointer_y;
    const bool beside = rect_contains(layout->stage, x, y) || rect_contains(layout->curves, x, y);
    const struct rect panel = layout->inspector;
    inspector_open_add(inspector,
                       beside ? (struct rect){x, y, 0, 0} : (struct rect){panel.x + UI_PAD, panel.y, 0, 4});
    if (beside) inspector->ui.popup.room = (struct rect){0, 0, panel.x, layout->status.y};
    inspector->ui.focus = ui_id("item.tail");
}
