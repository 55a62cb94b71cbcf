/// Equilibria that follow a joint of an imported character: which joint, what of it, and how much.
#include "editor/core/bones.h"
#include "editor/core/core.h"
#include "editor/inspector/inspection.h"

enum { ICON = 24, MAX_BONES = 1024 }; ///< in a list

static const char joint_list[] = "joint";

/// What the active spline's equilibrium follows.
static const struct param *followed(const struct inspection *in)
{
    const struct spline *spline = core_active_spline(in->core, in->world);
    return spline ? &spline->parameter[PARAMETER_EQUILIBRIUM] : NULL;
}

static struct edit joint_edit(const struct inspection *in, const struct param *param)
{
    struct edit edit = core_edit_of(EDIT_PARAMETER, in->core->active);
    edit.parameter = PARAMETER_EQUILIBRIUM;
    edit.param = *param;
    return edit;
}

void inspector_joint_field(struct inspection *in, const struct joint_motion *motion, struct rect field)
{
    struct rect icon = {field.x + field.w - ICON, field.y, ICON, field.h};
    const int active = in->core->active;
    const int model = document_find_model(in->document, motion->model, motion->by_file);
    char title[BONES_TITLE];
    const char *text = model < 0 ? motion->joint : bones_title(in->document, model, motion->joint, title);
    field.w -= ICON + 4;
    ui_hint(in->ui, field, "The joint it follows through the clip");
    ui_dropdown(in->ui, field, joint_list, 0, text, 0);
    const bool picking = in->core->pick.use == BONE_FOLLOWED && in->core->pick.which == active;
    if (ui_icon_button(in->ui, icon, "joint.pick", UI_ICON_PICK, picking, "Pick it on the stage"))
        bones_pick(in->core, picking ? BONE_SELECTED : BONE_FOLLOWED, active);
}

static void build_of(struct inspection *in)
{
    static const struct ui_choice choices[] = {
        [MOTION_TURN] = {"turn", "Turn"}, [MOTION_ACROSS] = {"across", "Across"}, [MOTION_UP] = {"up", "Up"}};
    struct joint_motion motion = *followed(in)->motion;
    int of = (int)motion.of;
    struct rect r = inspector_labelled(in, "its");
    ui_hint(in->ui, r, "Its turn in degrees, or its way across or up in metres");
    if (!ui_segments(in->ui, r, "joint.of", choices, MOTION_KINDS, &of)) return;
    struct edit edit = joint_edit(in, followed(in));
    motion.of = (enum motion_of)of;
    edit.param.motion = &motion;
    core_step(in->core, in->world, "Set joint's motion", 0, &edit);
}

static void now(const struct inspection *in, int which, struct setting *setting)
{
    (void)which;
    setting->edit = joint_edit(in, followed(in));
}

static const struct number_row gain_row = {"joint.gain",
                                           "times",
                                           NULL,
                                           "How much of the joint's motion it follows",
                                           "Set joint's gain",
                                           NUMBER_AT(edit.param.gain),
                                           0,
                                           0,
                                           -1e6,
                                           1e6,
                                           1,
                                           0.01,
                                           2};

void inspector_joint(struct inspection *in)
{
    if (followed(in)->motion) build_of(in);
    if (followed(in)->motion) inspector_numbers(in, &gain_row, 1, now);
}

int inspector_bone_list(struct inspection *in, const char *list, int model, int top, const char *chosen)
{
    const struct imported *character = bones_character(in->world, model);
    int nodes[MAX_BONES], row = -1;
    struct ui_item items[MAX_BONES];
    const int count = bones_below(character, top, nodes, MAX_BONES), node = gltf_find_node(&character->gltf, chosen);
    for (int b = 0; b < count; b++) {
        const char *name = character->gltf.nodes[nodes[b]].name;
        if (nodes[b] == node) row = b;
        items[b] = (struct ui_item){name, name, 0};
    }
    const int picked = ui_popup_list(in->ui, list, items, count, row);
    return picked < 0 ? -1 : nodes[picked];
}

void inspector_joint_list(struct inspection *in)
{
    const struct param *param = followed(in);
    if (!ui_popup_is_open(in->ui, joint_list) || !param || !param->motion) return;
    const int model = document_find_model(in->document, param->motion->model, param->motion->by_file);
    if (model < 0 || !bones_character(in->world, model)) return;
    const int node = inspector_bone_list(in, joint_list, model, -1, param->motion->joint);
    if (node >= 0) bones_follow(in->core, in->world, in->core->active, model, node);
}
