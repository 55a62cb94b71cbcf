/// Checks edits and turns them into changes, by kind.
#include "scene/edit_plan.h"

bool plan_no_memory(struct error *error) { return fail(error, ERROR_ENVIRONMENT, "not enough memory for this edit"); }

bool plan_has_spline(const struct document *document, int spline, struct error *error)
{
    return (spline >= 0 && spline < document->spline_count) || fail(error, ERROR_INPUT, "there is no such spline");
}

bool plan_add(struct change_list *list, const struct change *change, struct error *error)
{
    if (!change_list_reserve(list, 1)) {
        struct change lost = *change;
        change_release(&lost);
        return plan_no_memory(error);
    }
    list->items[list->count++] = *change;
    return true;
}

/// What an edit's index must name.
enum target { TARGET_SCENE, TARGET_SPLINE, TARGET_RIG };

#define KIND(kind) (1u << (kind))
#define CHANNELS (KIND(RIG_TAIL) | KIND(RIG_CHAIN))                     ///< kinds that have them
#define PINNED (KIND(RIG_TAIL) | KIND(RIG_CHAIN) | KIND(RIG_CHARACTER)) ///< kinds that take pins
#define ANY_KIND (KIND(RIG_KINDS) - 1)

static const struct {
    planner *plan;
    enum target target;
    unsigned kinds; ///< of TARGET_RIG
} planners[] = {
    [EDIT_KNOT_INSERT] = {plan_knot_insert, TARGET_SPLINE, 0},
    [EDIT_KNOT_REMOVE] = {plan_knot_remove, TARGET_SPLINE, 0},
    [EDIT_KNOT_SET] = {plan_knot_set, TARGET_SPLINE, 0},
    [EDIT_PARAMETER] = {plan_parameter, TARGET_SPLINE, 0},
    [EDIT_SPLINE_ADD] = {plan_spline_add, TARGET_SCENE, 0},
    [EDIT_SPLINE_COPY] = {plan_spline_copy, TARGET_SPLINE, 0},
    [EDIT_SPLINE_REMOVE] = {plan_spline_remove, TARGET_SPLINE, 0},
    [EDIT_SPLINE_MOVE] = {plan_spline_move, TARGET_SPLINE, 0},
    [EDIT_SPLINE_NAME] = {plan_spline_name, TARGET_SPLINE, 0},
    [EDIT_SPLINE_COLOR] = {plan_spline_color, TARGET_SPLINE, 0},
    [EDIT_DOCUMENT] = {plan_document, TARGET_SCENE, 0},
    [EDIT_FPS] = {plan_fps, TARGET_SCENE, 0},
    [EDIT_SUBSTEPS] = {plan_substeps, TARGET_SCENE, 0},
    [EDIT_RANGE] = {plan_range, TARGET_SCENE, 0},
    [EDIT_ANGLES] = {plan_angles, TARGET_RIG, CHANNELS},
    [EDIT_AXIS] = {plan_axis, TARGET_RIG, CHANNELS},
    [EDIT_PART] = {plan_part, TARGET_RIG, CHANNELS},
    [EDIT_FEED] = {plan_feed, TARGET_RIG, CHANNELS},
    [EDIT_POSITION] = {plan_position, TARGET_RIG, KIND(RIG_TAIL)},
    [EDIT_LENGTH] = {plan_length, TARGET_RIG, KIND(RIG_TAIL)},
    [EDIT_JOINTS] = {plan_joints, TARGET_RIG, KIND(RIG_TAIL)},
    [EDIT_TAIL_ADD] = {plan_tail_add, TARGET_SCENE, 0},
    [EDIT_RIG_REMOVE] = {plan_rig_remove, TARGET_RIG, ANY_KIND},
    [EDIT_RIG_NAME] = {plan_rig_name, TARGET_RIG, ANY_KIND},
    [EDIT_CHANNEL_ADD] = {plan_channel_add, TARGET_RIG, CHANNELS},
    [EDIT_CHANNEL_REMOVE] = {plan_channel_remove, TARGET_RIG, CHANNELS},
    [EDIT_DRIVE] = {plan_drive, TARGET_RIG, KIND(RIG_CHARACTER)},
    [EDIT_DRIVE_ADD] = {plan_drive_add, TARGET_RIG, KIND(RIG_CHARACTER)},
    [EDIT_DRIVE_REMOVE] = {plan_drive_remove, TARGET_RIG, KIND(RIG_CHARACTER)},
    [EDIT_FLOOR] = {plan_floor, TARGET_RIG, KIND(RIG_CHARACTER)},
    [EDIT_PAINT_NEW] = {plan_paint_new, TARGET_RIG, KIND(RIG_CHARACTER)},
    [EDIT_PAINT] = {plan_dab, TARGET_RIG, KIND(RIG_CHARACTER)},
    [EDIT_MODEL_ADD] = {plan_model_add, TARGET_SCENE, 0},
    [EDIT_RIG_ADD] = {plan_rig_add, TARGET_SCENE, 0},
    [EDIT_CHAIN_ADD] = {plan_chain_add, TARGET_SCENE, 0},
    [EDIT_CLIP] = {plan_clip, TARGET_RIG, KIND(RIG_MODEL)},
    [EDIT_PLACE] = {plan_place, TARGET_RIG, KIND(RIG_MODEL)},
    [EDIT_CHAIN] = {plan_chain, TARGET_RIG, KIND(RIG_CHAIN)},
    [EDIT_MEADOW] = {plan_meadow, TARGET_RIG, KIND(RIG_MEADOW)},
    [EDIT_PIN_ADD] = {plan_pin_add, TARGET_RIG, PINNED},
    [EDIT_PIN_SET] = {plan_pin_set, TARGET_RIG, PINNED},
    [EDIT_PIN_REMOVE] = {plan_pin_remove, TARGET_RIG, PINNED},
};

/// What to call a rig of one of those kinds.
static const char *word_for(unsigned kinds)
{
    for (int k = 0; k < RIG_KINDS; k++) {
        if (kinds == KIND(k)) return rig_word((enum rig_kind)k);
    }
    return "rig";
}

bool edit_plan(struct document *document, const struct edit *edit, struct change_list *list, struct error *error)
{
    enum target target = planners[edit->kind].target;
    if (target == TARGET_SPLINE && !plan_has_spline(document, edit->spline, error)) return false;
    const unsigned kinds = planners[edit->kind].kinds;
    const bool is_rig = edit->rig >= 0 && edit->rig < document->rig_count;
    if (target == TARGET_RIG && !(is_rig && kinds & KIND(document->rigs[edit->rig].kind))) {
        return fail(error, ERROR_INPUT, "there is no such %s", word_for(kinds));
    }
    return planners[edit->kind].plan(document, edit, list, error);
}
