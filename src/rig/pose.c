/// Poses tails and chains, and a tail's body.
#include "model/fox.h"
#include "rig/posing_kind.h"
#include "rig/strand.h"
#include <math.h>

_Static_assert((int)TAIL_MAX_JOINTS <= (int)POSE_MAX_JOINTS, "a pose holds every tail");

double channel_bend(const struct channel *channel, wiggly_value value, int n, int joints, enum look look)
{
    const double lag = look == LOOK_STIFF ? 0.0 : radians(angles_lag(&channel->lag, n, joints));
    return radians(angles_at(&channel->gain, n, joints)) * wiggly_lagged(value, lag);
}

double channel_moves(const struct channel *channel, wiggly_value value, int n, enum look look)
{
    const double lag = look == LOOK_STIFF ? 0.0 : n * radians(angles_at(&channel->lag, 0, 1));
    return angles_at(&channel->gain, 0, 1) * wiggly_lagged(value, lag);
}

/// Limits of the body's parts, degrees and percent, so that no spline breaks the fox.
static const struct {
    double lowest, highest;
} limits[AXES] = {
    [AXIS_LOOK] = {-70, 70},   [AXIS_NOD] = {-35, 35},     [AXIS_EARS] = {-30, 60},
    [AXIS_BREATH] = {-15, 25}, [AXIS_STRETCH] = {-40, 40}, [AXIS_BLINK] = {0, 100},
};

/// Sum of an axis' channels for a part's n-th joint, within the limits.
static double moved(const struct tail *tail, const wiggly_value *values, enum look look, enum axis axis, int n)
{
    double sum = 0;
    for (int c = 0; c < tail->channel_count; c++) {
        if (tail->channels[c].axis == axis) sum += channel_moves(&tail->channels[c], values[c], n, look);
    }
    return fmin(fmax(sum, limits[axis].lowest), limits[axis].highest);
}

/// The body parts' motion, and how far it moves the tail's base, metres.
static struct limbs tail_limbs(const struct tail *tail, const wiggly_value *values, enum look look, double shift[3])
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

float tail_ground(const struct tail *tail)
{
    const double height = (double)(FOX_BASE_HEIGHT / FOX_TAIL_LENGTH) * tail->length;
    return tail->position[1].track < 0 ? (float)(tail->position[1].value - height) : 0.0f;
}

struct limbs tail_base(const struct posing *posing, int rig, double position, const wiggly_value *values,
                       const struct by_hand *by_hand, double base[3])
{
    const struct tail *tail = &posing->document->rigs[rig]->tail;
    const struct limbs limbs = tail_limbs(tail, values, posing->look, base);
    double moved[3];
    posing_base(posing, rig, by_hand, moved);
    for (int k = 0; k < 3; k++) {
        const struct param *param = &tail->position[k];
        const wiggly_value value = evaluation_at(posing->evaluation, param->track, position);
        base[k] += moved[k] + (param->track < 0 ? param->value : value.y + value.re);
    }
    return limbs;
}

static bool pose(const struct posing *posing, int rig, double position, const struct by_hand *by_hand,
                 struct rig_pose *posed)
{
    struct pose *strand = &posed->strand;
    struct path path;
    if (!path_find(posing, rig, position, by_hand, &path)) return false;
    strand->count = path.count - path.first + 1;
    for (int n = 0; n < strand->count; n++) {
        const struct path_node *node = &path.nodes[n + 1 < strand->count ? path.first + n : path.count - 1];
        const double *at = n + 1 < strand->count ? node->at : path.end;
        for (int k = 0; k < 12; k++)
            strand->matrix[n][k] = k % 4 == 3 ? 0.0f : (float)node->frame[3 * (k / 4) + k % 4];
        for (int k = 0; k < 3; k++) strand->matrix[n][12 + k] = (float)at[k];
        strand->matrix[n][15] = 1.0f;
    }
    return true;
}

static bool pose_fox(const struct posing *posing, int rig, double position, const struct by_hand *by_hand,
                     struct rig_pose *posed)
{
    const struct tail *tail = &posing->document->rigs[rig]->tail;
    wiggly_value values[RIG_MAX_INPUTS];
    double base[3];
    posing_values(posing, rig, position, by_hand, values);
    posed->strand.ground = tail_ground(tail);
    posed->strand.scale = (float)(tail->length / (double)FOX_TAIL_LENGTH);
    posed->strand.limbs = tail_base(posing, rig, position, values, by_hand, base);
    return pose(posing, rig, position, by_hand, posed);
}

static void bounds(const struct rig_pose *posed, float lo[3], float hi[3]) { pose_bounds(&posed->strand, lo, hi); }

const struct posing_functions tail_posing = {pose_fox, bounds, &strand_pinning};
const struct posing_functions chain_posing = {pose, NULL, &strand_pinning};
