/// Carries out edits as data.
#include "scene/edit_kinds.h"
#include <assert.h>

static bool apply_to_rig(struct document *d, const struct edit *e, struct error *error)
{
    const struct channel_place at = {e->rig, e->channel};
    switch (e->kind) {
    case EDIT_ANGLES:
        return edit_angles(d, at, e->angle, e->angles, error);
    case EDIT_AXIS:
        return edit_axis(d, at, e->axis, error);
    case EDIT_PART:
        return edit_part(d, at, e->of, error);
    case EDIT_FEED:
        return edit_feed(d, at, e->spline, error);
    case EDIT_POSITION:
        return edit_position(d, e->rig, e->coordinate, &e->param, error);
    case EDIT_LENGTH:
        return edit_length(d, e->rig, e->number, error);
    case EDIT_JOINTS:
        return edit_joints(d, e->rig, e->to, error);
    case EDIT_TAIL_ADD:
        return edit_tail_add(d, e->rig, e->spline, e->axis, e->of, error);
    case EDIT_RIG_REMOVE:
        return edit_rig_remove(d, e->rig, error);
    case EDIT_RIG_NAME:
        return edit_rig_name(d, e->rig, e->text, error);
    case EDIT_CHANNEL_ADD:
        return edit_channel_add(d, e->rig, e->spline, e->axis, e->of, error);
    case EDIT_CHANNEL_REMOVE:
        return edit_channel_remove(d, at, error);
    case EDIT_DRIVE:
        return edit_drive(d, e->rig, e->channel, &e->drive, error);
    case EDIT_DRIVE_ADD:
        return edit_drive_add(d, e->rig, e->text ? e->text : e->drive.name, &e->drive, error);
    case EDIT_DRIVE_REMOVE:
        return edit_drive_remove(d, e->rig, e->channel, error);
    case EDIT_FLOOR:
        return edit_floor(d, e->rig, e->flag, e->number, error);
    case EDIT_PAINT_NEW:
        return edit_paint_new(d, e->rig, e->coordinates, e->vertices, error);
    case EDIT_PAINT:
        return edit_paint(d, e->rig, e->dab, error);
    case EDIT_MODEL_ADD:
    case EDIT_RIG_ADD:
    case EDIT_CHAIN_ADD:
        return edit_rig_add(d, e->contents, error);
    case EDIT_CLIP:
        return edit_clip(d, e->rig, e->text, error);
    case EDIT_PLACE:
        return edit_place(d, e->rig, &e->contents->model, error);
    case EDIT_CHAIN:
        return edit_chain(d, e->rig, &e->contents->chain, error);
    case EDIT_MEADOW:
        return edit_meadow(d, e->rig, &e->contents->meadow, error);
    case EDIT_PIN_ADD:
        return edit_pin_add(d, e->rig, &e->pin, error);
    case EDIT_PIN_SET:
        return edit_pin_set(d, e->rig, &e->pin, error);
    case EDIT_PIN_REMOVE:
        return edit_pin_remove(d, e->rig, e->pin.id, error);
    default:
        return false;
    }
}

static bool apply(struct document *d, const struct edit *e, struct error *error)
{
    switch (e->kind) {
    case EDIT_KNOT_INSERT:
        return edit_knot_insert(d, e->spline, &e->knot, error);
    case EDIT_KNOT_REMOVE:
        return edit_knot_remove(d, e->spline, e->knot.id, error);
    case EDIT_KNOT_SET:
        return edit_knot_set(d, e->spline, &e->knot, error);
    case EDIT_PARAMETER:
        return edit_parameter(d, e->spline, e->parameter, &e->param, error);
    case EDIT_SPLINE_ADD:
        return edit_spline_add(d, e->spline, e->text, e->flag ? &e->knot : NULL, error);
    case EDIT_SPLINE_COPY:
        return edit_spline_copy(d, e->spline, error);
    case EDIT_SPLINE_REMOVE:
        return edit_spline_remove(d, e->spline, error);
    case EDIT_SPLINE_MOVE:
        return edit_spline_move(d, e->spline, e->to, error);
    case EDIT_SPLINE_NAME:
        return edit_spline_name(d, e->spline, e->text, error);
    case EDIT_SPLINE_COLOR:
        return edit_spline_color(d, e->spline, e->color, error);
    case EDIT_FPS:
        return edit_fps(d, e->number, e->flag, error);
    case EDIT_SUBSTEPS:
        return edit_substeps(d, e->substeps, error);
    case EDIT_RANGE:
        return edit_range(d, e->first, e->last, e->fit, error);
    default:
        return apply_to_rig(d, e, error);
    }
}

bool history_apply(struct history *history, struct document *document, const struct edit *edit, struct error *error)
{
    assert(history_is_open(history));
    return apply(document, edit, error);
}
