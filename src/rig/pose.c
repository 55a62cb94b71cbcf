/// Bends a tail's joints by the values of its channels.
#include "model/creature.h"
#include "rig/posing_kind.h"
#include <math.h>

_Static_assert((int)TAIL_MAX_JOINTS <= (int)POSE_MAX_JOINTS, "a pose holds every tail");

static double radians(double degrees) { return degrees * 3.14159265358979323846 / 180.0; }

double channel_bend(const struct channel *channel, wiggly_value value, int n, int joints, enum look look)
{
    const double lag = look == LOOK_STIFF ? 0.0 : radians(angles_lag(&channel->lag, n, joints));
    if (channel->of == PART_DISPLACEMENT) value.y = 0.0;
    return radians(angles_at(&channel->gain, n, joints)) * wiggly_lagged(value, lag);
}

void tail_bend_at(const struct tail *tail, const wiggly_value *values, enum look look, int n, double *side,
                  double *up)
{
    *side = 0.0;
    *up = radians(angles_at(&tail->rest, n, tail->joints));
    for (int c = 0; c < tail->channel_count; c++) {
        const struct channel *channel = &tail->channels[c];
        *(channel->axis == AXIS_UP ? up : side) += channel_bend(channel, values[c], n, tail->joints, look);
    }
}

void tail_bend_frame(double frame[16], double side, double up)
{
    const double cs = cos(side), ss = sin(side), cu = cos(up), su = sin(up);
    for (int k = 0; k < 3; k++) {
        const double x = frame[k], y = frame[4 + k], z = frame[8 + k];
        const double turned = ss * x + cs * z;
        frame[k] = cs * x - ss * z;
        frame[4 + k] = cu * y - su * turned;
        frame[8 + k] = su * y + cu * turned;
    }
}

void pose_tail(const struct tail *tail, const wiggly_value *values, enum look look, struct pose *pose)
{
    double frame[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    for (int k = 0; k < 3; k++) frame[12 + k] = tail->position[k].track < 0 ? tail->position[k].value : 0.0;
    const double segment = tail->length / tail->joints, height = CREATURE_BASE_HEIGHT / CREATURE_TAIL_LENGTH;
    pose->ground = tail->position[1].track < 0 ? (float)(tail->position[1].value - height * tail->length) : 0.0f;
    pose->count = tail->joints + 1;
    for (int n = 0; n <= tail->joints; n++) {
        if (n < tail->joints) {
            double side, up;
            tail_bend_at(tail, values, look, n, &side, &up);
            tail_bend_frame(frame, side, up);
        }
        for (int k = 0; k < 16; k++) pose->matrix[n][k] = (float)frame[k];
        for (int k = 0; k < 3; k++) frame[12 + k] += segment * frame[8 + k];
    }
}

/// Coordinates of a tail's position that follow splines; 0 for the others.
static void base_at(const struct posing *posing, const struct tail *tail, double position, double base[3])
{
    for (int k = 0; k < 3; k++) {
        const wiggly_value value = evaluation_at(posing->evaluation, tail->position[k].track, position);
        base[k] = value.y + value.re;
    }
}

static bool pose(const struct posing *posing, int rig, double position, const wiggly_value *values,
                 const struct by_hand *by_hand, struct rig_pose *posed)
{
    const struct tail *tail = &posing->document->rigs[rig].tail;
    double base[3];
    pose_tail(tail, values, posing->look, &posed->tail);
    base_at(posing, tail, position, base);
    for (int k = 0; k < 3 && by_hand; k++) base[k] += by_hand->base[k];
    pose_move(&posed->tail, base);
    return true;
}

static void bounds(const struct rig_pose *posed, float lo[3], float hi[3]) { pose_bounds(&posed->tail, lo, hi); }

const struct posing_functions tail_posing = {pose, bounds};
