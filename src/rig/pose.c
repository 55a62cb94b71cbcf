/// Bends a tail's joints by the values of its channels.
#include "model/fox.h"
#include "model/limbs.h"
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

double channel_moves(const struct channel *channel, wiggly_value value, int n, enum look look)
{
    const double lag = look == LOOK_STIFF ? 0.0 : n * radians(angles_at(&channel->lag, 0, 1));
    if (channel->of == PART_DISPLACEMENT) value.y = 0.0;
    return angles_at(&channel->gain, 0, 1) * wiggly_lagged(value, lag);
}

/// What the body bears, degrees and percent: however wild a spline, it stays a fox.
static const struct {
    double lowest, highest;
} bearable[AXES] = {
    [AXIS_LOOK] = {-70, 70},   [AXIS_NOD] = {-35, 35},     [AXIS_EARS] = {-30, 60},
    [AXIS_BREATH] = {-15, 25}, [AXIS_STRETCH] = {-40, 40}, [AXIS_BLINK] = {0, 100},
};

/// Sum of the channels of an axis for a part's n-th joint, within what the body bears.
static double moved(const struct tail *tail, const wiggly_value *values, enum look look, enum axis axis, int n)
{
    double sum = 0;
    for (int c = 0; c < tail->channel_count; c++) {
        if (tail->channels[c].axis == axis) sum += channel_moves(&tail->channels[c], values[c], n, look);
    }
    return fmin(fmax(sum, bearable[axis].lowest), bearable[axis].highest);
}

struct limbs tail_limbs(const struct tail *tail, const wiggly_value *values, enum look look, double shift[3])
{
    const double stretch = moved(tail, values, look, AXIS_STRETCH, 1) / 100;
    struct limbs limbs = {
        .look = (float)radians(moved(tail, values, look, AXIS_LOOK, 1)),
        .nod = (float)radians(moved(tail, values, look, AXIS_NOD, 1)),
        .breath = (float)moved(tail, values, look, AXIS_BREATH, 1) / 100,
        .stretch = (float)stretch,
        .blink = (float)moved(tail, values, look, AXIS_BLINK, 1) / 100,
    };
    for (int n = 0; n < 2; n++) limbs.ears[n] = (float)radians(moved(tail, values, look, AXIS_EARS, n + 1));
    limbs_base(stretch, tail->length / (double)FOX_TAIL_LENGTH, shift);
    return limbs;
}

void tail_bend_at(const struct tail *tail, const wiggly_value *values, enum look look, int n, double *side,
                  double *up)
{
    *side = 0.0;
    *up = radians(angles_at(&tail->rest, n, tail->joints));
    for (int c = 0; c < tail->channel_count; c++) {
        const struct channel *channel = &tail->channels[c];
        if (!axis_bends(channel->axis)) continue;
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
    const double segment = tail->length / tail->joints, height = FOX_BASE_HEIGHT / FOX_TAIL_LENGTH;
    pose->ground = tail->position[1].track < 0 ? (float)(tail->position[1].value - height * tail->length) : 0.0f;
    pose->count = tail->joints + 1;
    double shift[3];
    pose->limbs = tail_limbs(tail, values, look, shift);
    for (int k = 0; k < 3; k++) frame[12 + k] += shift[k];
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
    const struct tail *tail = &posing->document->rigs[rig]->tail;
    double base[3], moved[3];
    pose_tail(tail, values, posing->look, &posed->tail);
    base_at(posing, tail, position, base);
    posing_base(posing, rig, by_hand, moved);
    for (int k = 0; k < 3; k++) base[k] += moved[k];
    pose_move(&posed->tail, base);
    return true;
}

static void bounds(const struct rig_pose *posed, float lo[3], float hi[3]) { pose_bounds(&posed->tail, lo, hi); }

const struct posing_functions tail_posing = {pose, bounds};
