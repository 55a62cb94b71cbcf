/// Points of tails: the ends of their joints.
#include "model/fox.h"
#include "model/limbs.h"
#include "rig/pinning_kind.h"
#include "rig/posing_kind.h"
#include <string.h>

static const double SLACK = 1e-6; ///< of the length

/// A joint in the world: where it is, and what it turns about for `side` and for `up`.
struct hinge {
    double at[3], axis[2][3];
};

/// The first `count` joints, and where the last one ends.
static void find_hinges(const struct tail *tail, const double base[3], const wiggly_value *values, int count,
                        struct hinge *hinges, double end[3])
{
    double frame[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    const double segment = tail->length / tail->joints;
    memcpy(frame + 12, base, 3 * sizeof *base);
    for (int n = 0; n < count; n++) {
        double side, up;
        memcpy(hinges[n].at, frame + 12, sizeof hinges[n].at);
        memcpy(hinges[n].axis[AXIS_SIDE], frame + 4, sizeof hinges[n].axis[0]);
        tail_bend_at(tail, values, LOOK_WIGGLY, n, &side, &up);
        tail_bend_frame(frame, side, up);
        for (int k = 0; k < 3; k++) {
            hinges[n].axis[AXIS_UP][k] = -frame[k];
            frame[12 + k] += segment * frame[8 + k];
        }
    }
    memcpy(end, frame + 12, 3 * sizeof *end);
}

/// How a spline's channels move a point by bending the joints up to its own.
static void add_bends(const struct tail *tail, const struct hinge *hinges, int count, const double point[3],
                      int spline, pin_pull c)
{
    for (int i = 0; i < tail->channel_count; i++) {
        const struct channel *channel = &tail->channels[i];
        if (!axis_bends(channel->axis)) continue;
        for (int n = 0; channel->spline == spline && n < count; n++) {
            const double *a = hinges[n].axis[channel->axis], *at = hinges[n].at;
            const double arm[3] = {point[0] - at[0], point[1] - at[1], point[2] - at[2]};
            const double way[3] = {a[1] * arm[2] - a[2] * arm[1], a[2] * arm[0] - a[0] * arm[2],
                                   a[0] * arm[1] - a[1] * arm[0]};
            pinning_add_channel(channel, n, tail->joints, way, c);
        }
    }
}

/// How the base moves with the body's stretch, metres a radian: pinning_add_channel() takes percent for degrees.
static void find_stretch(const struct tail *tail, const struct limbs *limbs, double way[3])
{
    limbs_base_slope((double)limbs->stretch, tail->length / (double)FOX_TAIL_LENGTH, way);
    for (int k = 0; k < 3; k++) way[k] *= 1.8 / 3.14159265358979323846;
}

static void add_stretch(const struct tail *tail, const double way[3], int spline, pin_pull c)
{
    for (int i = 0; i < tail->channel_count; i++) {
        const struct channel *channel = &tail->channels[i];
        if (channel->spline == spline && channel->axis == AXIS_STRETCH) pinning_add_channel(channel, 1, 1, way, c);
    }
}

static bool find(const struct posing *posing, int rig, double sample, int which, const int *splines, int count,
                 pin_pull *c, struct pin_point *point)
{
    const struct tail *tail = &posing->document->rigs[rig]->tail;
    struct hinge hinges[TAIL_MAX_JOINTS];
    wiggly_value values[RIG_MAX_INPUTS];
    double base[3], shift[3], by_stretch[3];
    if (which >= tail->joints) return false;
    for (int k = 0; k < 3; k++) {
        const wiggly_value follows = evaluation_at(posing->evaluation, tail->position[k].track, sample);
        base[k] = tail->position[k].track < 0 ? tail->position[k].value : follows.y + follows.re;
    }
    posing_values(posing, rig, sample, NULL, values);
    const struct limbs limbs = tail_limbs(tail, values, LOOK_WIGGLY, shift);
    find_stretch(tail, &limbs, by_stretch);
    for (int k = 0; k < 3; k++) base[k] += shift[k];
    *point = (struct pin_point){.size = tail->length,
                                .slack = SLACK * tail->length,
                                .base = {base[0], base[1], base[2]},
                                .reach = tail->length * (which + 1) / tail->joints};
    find_hinges(tail, base, values, which + 1, hinges, point->at);
    for (int i = 0; i < count; i++) {
        add_bends(tail, hinges, which + 1, point->at, splines[i], c[i]);
        add_stretch(tail, by_stretch, splines[i], c[i]);
        for (int k = 0; k < 3; k++) c[i][k][0] += tail->position[k].track == splines[i];
    }
    return true;
}

static void weigh(const struct posing *posing, int rig, const int *splines, int count, double *weights)
{
    const struct tail *tail = &posing->document->rigs[rig]->tail;
    const wiggly_value values[RIG_MAX_INPUTS] = {{0}};
    const double base[3] = {0};
    struct hinge hinges[TAIL_MAX_JOINTS + 1];
    double end[3];
    find_hinges(tail, base, values, tail->joints, hinges, end);
    memcpy(hinges[tail->joints].at, end, sizeof end);
    for (int i = 0; i < count; i++) {
        double sum = 0;
        for (int n = 1; n <= tail->joints; n++) {
            pin_pull c = {{0}};
            add_bends(tail, hinges, n, hinges[n].at, splines[i], c);
            sum += pinning_square(c);
        }
        weights[i] += sum / tail->joints;
    }
}

const struct pinning_functions tail_pinning = {find, weigh};
