/// What the inspector shows of a chain besides its channels: its bones, how they turn, and its twin on the other side.
#include "editor/core/bones.h"
#include "editor/core/core.h"
#include "editor/inspector/inspection.h"
#include <stdio.h>
#include <string.h>

enum { ICON = 24 };

static struct edit chain_edit(const struct inspection *in, const struct rig *contents)
{
    struct edit edit = core_edit_of(EDIT_CHAIN, in->core->active);
    edit.rig = in->inspector->rig;
    edit.contents = contents;
    return edit;
}

static void build_bones(struct inspection *in, const struct chain *chain)
{
    char text[256];
    const bool single = strcmp(chain->from, chain->to) == 0;
    snprintf(text, sizeof text, single ? "%.100s" : "%.100s → %.100s", chain->from, chain->to);
    ui_label(in->ui, inspector_labelled(in, "bones"), text, theme()->text);
}

static void build_turn(struct inspection *in)
{
    static const struct ui_number turn = {.name = "chain.turn",
                                          .label = "turn",
                                          .unit = "°",
                                          .hint = "Turns the axes of side and up about the chain's own direction",
                                          .minimum = -180,
                                          .maximum = 180,
                                          .lowest = -36000,
                                          .highest = 36000,
                                          .fallback = 0,
                                          .step = 1};
    struct rig contents = *inspector_shown(in);
    const enum ui_change change = ui_value(in->ui, ui_row(in->ui, UI_ROW), &turn, &contents.chain.turn);
    const struct edit edit = chain_edit(in, &contents);
    inspector_change(in, change, "Turn chain's axes", turn.name, &edit);
}

static void build_mirror(struct inspection *in)
{
    struct rig contents = *inspector_shown(in);
    struct rect r = inspector_labelled(in, "mirror");
    if (ui_hovered(in->ui, r)) in->ui->hint = "Bend to the other side, as a left ear does to a right one";
    if (!ui_toggle(in->ui, r, "chain.mirror", &contents.chain.mirror)) return;
    const struct edit edit = chain_edit(in, &contents);
    core_step(in->core, in->world, "Mirror chain", 0, &edit);
}

static void build_buttons(struct inspection *in)
{
    struct rect r = inspector_labelled(in, "chain"), icon = {r.x - 2, r.y, ICON, r.h};
    if (ui_icon_button(in->ui, icon, "chain.delete", UI_ICON_DELETE, false, "Delete this chain")) {
        struct edit edit = core_edit_of(EDIT_RIG_REMOVE, in->core->active);
        edit.rig = in->inspector->rig;
        core_step(in->core, in->world, "Delete chain", 0, &edit);
        return;
    }
    if (!bones_has_twin(in->world, in->inspector->rig)) return;
    struct rect button = {icon.x + ICON + 6, r.y + 2, r.x + r.w - icon.x - ICON - 6, r.h - 4};
    if (ui_hovered(in->ui, button)) in->ui->hint = "The same chain on the other side, mirrored, by the same splines";
    if (!ui_button(in->ui, button, "chain.twin", "Mirror to other side", false)) return;
    bones_make_twin(in->core, in->world, in->inspector->rig);
    in->inspector->rig = in->document->rig_count - 1;
}

void inspector_chain(struct inspection *in)
{
    build_bones(in, &inspector_shown(in)->chain);
    build_turn(in);
    build_mirror(in);
    build_buttons(in);
}
