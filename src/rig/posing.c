#include "rig/posing.h"

/// Where the coordinates of a tail's position that follow splines are; 0 for the others.
static void base_at(const struct posing *posing, const struct tail *tail, double position, double base[3])
{
    for (int k = 0; k < 3; k++) {
        wiggly_value value = {0};
        if (tail->position[k].track >= 0)
            value = evaluation_at(posing->evaluation, tail->position[k].track, position);
        base[k] = value.y + value.re;
    }
}

void posing_tail(const struct posing *posing, int index, double position, const struct by_hand *by_hand,
                 struct pose *pose)
{
    const struct tail *tail = document_tail(posing->document, index);
    wiggly_value values[SCENE_MAX_CHANNELS];
    double base[3];
    for (int c = 0; c < tail->channel_count; c++) {
        values[c] = evaluation_at(posing->evaluation, tail->channels[c].spline, position);
        if (!by_hand) continue;
        values[c].re += by_hand->channel[c].re;
        values[c].im += by_hand->channel[c].im;
    }
    pose_tail(tail, values, posing->look, pose);
    base_at(posing, tail, position, base);
    for (int k = 0; k < 3 && by_hand; k++) base[k] += by_hand->base[k];
    pose_move(pose, base);
}

bool posing_character(const struct posing *posing, int index, double position, struct morph *morph)
{
    const struct character_rig *rig = document_character(posing->document, index);
    const struct figure *figure = cast_figure(posing->cast, index);
    wiggly_value values[CHARACTER_MAX_DRIVES] = {{0}};
    if (!figure) return false;
    for (int k = 0; k < rig->drive_count; k++) {
        values[k] = evaluation_at(posing->evaluation, rig->drives[k].spline, position);
    }
    pose_character(rig, figure, values, posing->look, morph);
    return true;
}
