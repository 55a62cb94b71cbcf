/// What the inspector shows of a chain besides its channels: its bones, how they turn, and its twin on the other side.
#include "editor/core/bones.h"
#include "editor/core/core.h"
#include "editor/inspector/inspection.h"

enum { ICON = 24 };

/// Where a chain begins and where it ends.
static const struct end {
    const char *label, *list, *pick, *hint;
    enum bone_use use;
} ends[2] = {
    {"from", "chain.from", "chain.from.pick", "The bone that it begins with", BONE_FIRST},
    {"to", "chain.to", "chain.to.pick", "The bone that it ends with", BONE_LAST},
};

static struct edit chain_edit(const struct inspection *in, const struct rig *contents)
{
    struct edit edit = core_edit_of(EDIT_CHAIN, in->core->active);
    edit.rig = in->inspector->rig;
    edit.contents = contents;
    return edit;
}

/// The bone at one end: a list of those that it may be, and a button to pick it on the stage.
static void build_end(struct inspection *in, const struct end *end, const char *bone)
{
    struct rect field = inspector_labelled(in, end->label), icon = {field.x + field.w - ICON, field.y, ICON, field.h};
    field.w -= ICON + 4;
    const int rig = in->inspector->rig;
    ui_hint(in->ui, field, end->hint);
    ui_dropdown(in->ui, field, end->list, rig, bone, 0);
    const bool picking = in->core->pick.use == end->use && in->core->pick.which == rig;
    if (ui_icon_button(in->ui, icon, end->pick, UI_ICON_PICK, picking, "Pick it on the stage"))
        bones_pick(in->core, picking ? BONE_SELECTED : end->use, rig);
}

static void end_list(struct inspection *in, const struct end *end, const struct chain *chain)
{
    const int model = bones_model_of(in->document, chain);
    const struct imported *character = model >= 0 ? bones_character(in->world, model) : NULL;
    if (!ui_popup_is_open(in->ui, end->list) || !character) return;
    const bool first = end->use == BONE_FIRST;
    const int top = first ? -1 : gltf_find_node(&character->gltf, chain->from);
    const int node = inspector_bone_list(in, end->list, model, top, first ? chain->from : chain->to);
    if (node >= 0) bones_set_end(in->core, in->world, in->inspector->rig, first, node);
}

void inspector_chain_lists(struct inspection *in)
{
    for (int e = 0; e < 2; e++) {
        const struct rig *rig = inspector_shown(in);
        if (rig && rig->kind == RIG_CHAIN) end_list(in, &ends[e], &rig->chain);
    }
}

static void now(const struct inspection *in, int which, struct setting *setting)
{
    (void)which;
    setting->contents = *inspector_shown(in);
    setting->edit = chain_edit(in, &setting->contents);
}

static const struct number_row turn_row = {"chain.turn",
                                           "turn",
                                           "°",
                                           "Turns the axes of side and up about the chain's own direction",
                                           "Turn chain's axes",
                                           NUMBER_AT(contents.chain.turn),
                                           -180,
                                           180,
                                           -36000,
                                           36000,
                                           0,
                                           1,
                                           0};

static void build_mirror(struct inspection *in)
{
    struct rig contents = *inspector_shown(in);
    struct rect r = inspector_labelled(in, "mirror");
    ui_hint(in->ui, r, "Bend to the other side, as a left ear does to a right one");
    if (!ui_toggle(in->ui, r, "chain.mirror", &contents.chain.mirror)) return;
    const struct edit edit = chain_edit(in, &contents);
    core_step(in->core, in->world, "Mirror chain", 0, &edit);
}

static void build_twin(struct inspection *in)
{
    if (!bones_has_twin(in->world, in->inspector->rig)) return;
    const struct rect row = ui_row(in->ui, UI_ROW), button = {row.x, row.y + 2, row.w, row.h - 4};
    ui_hint(in->ui, button, "The same chain on the other side, mirrored, by the same splines");
    if (!ui_button(in->ui, button, "chain.twin", "Mirror to other side", false)) return;
    bones_make_twin(in->core, in->world, in->inspector->rig);
    in->inspector->rig = in->document->rig_count - 1;
}

void inspector_chain(struct inspection *in)
{
    const struct chain *chain = &inspector_shown(in)->chain;
    build_end(in, &ends[0], chain->from);
    build_end(in, &ends[1], chain->to);
    inspector_numbers(in, &turn_row, 1, now);
    build_mirror(in);
    build_twin(in);
}
