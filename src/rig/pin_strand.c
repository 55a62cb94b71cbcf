/// Points of tails and chains: where their joints end.
///
/// Let L be the matrix from the frame of a bent joint to the world. A turn of the joint about an axis a moves a point at r from the joint, in
/// that frame, by L (a × r). Each axis is the one left by the turns after it.
#include "model/fox.h"
#include "rig/posing_kind.h"
#include "rig/strand.h"
#include <string.h>

static const double SLACK = 1e-6; ///< of the length

/// How splines move the end of a path's joint by bending a strand.
static void add_bends(const struct path *path, int joint, const struct strand *strand, const wiggly_value *values,
                      const int *splines, int count, pin_pull *c)
{
    for (int i = 0, n = 0; i <= path->first + joint && n < strand->joints; i++) {
        const struct path_node *node = &path->nodes[i];
        double axis[3][3], way[3][3];
        if (node->node != strand->bones.node[n]) continue;
        strand_turned_axes(strand, values, n, axis);
        for (int a = 0; a < 3; a++) {
            for (int k = 0; k < 3; k++) axis[a][k] *= strand_sign(strand, (enum axis)a);
            path_way(node, axis[a], way[a]);
        }
        for (int h = 0; h < strand->channel_count; h++) {
            const struct channel *channel = &strand->channels[h];
            for (int s = 0; s < count && axis_bends(channel->axis); s++) {
                if (splines[s] == channel->spline)
                    pinning_add_channel(channel, n, strand->joints, way[channel->axis], c[s]);
            }
        }
        n++;
    }
}

/// The motion of a tail's base, and how the body's stretch moves it; pinning_add_channel() takes percent for degrees.
static void add_base(const struct posing *posing, int rig, const wiggly_value *values, const int *splines, int count,
                     pin_pull *c)
{
    const struct tail *tail = &posing->document->rigs[rig]->tail;
    double way[3];
    const struct limbs limbs = tail_base(posing, rig, 0, values, NULL, way);
    limbs_base_slope((double)limbs.stretch, tail->length / (double)FOX_TAIL_LENGTH, way);
    for (int k = 0; k < 3; k++) way[k] *= 1.8 / 3.14159265358979323846;
    for (int s = 0; s < count; s++) {
        for (int k = 0; k < 3; k++) c[s][k][0] += tail->position[k].track == splines[s];
        for (int i = 0; i < tail->channel_count; i++) {
            const struct channel *channel = &tail->channels[i];
            if (channel->spline == splines[s] && channel->axis == AXIS_STRETCH)
                pinning_add_channel(channel, 1, 1, way, c[s]);
        }
    }
}

static bool find(const struct posing *posing, int rig, double sample, int which, const int *splines, int count,
                 pin_pull *c, struct pin_point *point)
{
    const struct document *document = posing->document;
    const int body = rig_body(document, rig);
    wiggly_value values[RIG_MAX_INPUTS];
    struct strand strand;
    struct path path;
    if (!path_find(posing, rig, sample, NULL, &path) || which >= path.count - path.first) return false;
    const double length = path_length(&path, path.count - path.first);
    *point = (struct pin_point){.size = length, .slack = SLACK * length, .reach = path_length(&path, which + 1)};
    memcpy(point->at, path_end(&path, which), sizeof point->at);
    memcpy(point->base, path.nodes[path.first].at, sizeof point->base);
    path_arms(&path, which);
    for (int r = 0; count > 0 && r < document->rig_count; r++) {
        if (!strand_find(posing, body, r, &strand)) continue;
        posing_values(posing, r, sample, NULL, values);
        add_bends(&path, which, &strand, values, splines, count, c);
        if (r == body) add_base(posing, rig, values, splines, count, c);
    }
    return true;
}

static void weigh(const struct posing *posing, int rig, const int *splines, int count, double *weights)
{
    const wiggly_value values[RIG_MAX_INPUTS] = {{0}};
    struct strand strand;
    struct path path;
    if (!path_find(posing, rig, 0, NULL, &path) ||
        !strand_find(posing, rig_body(posing->document, rig), rig, &strand))
        return;
    for (int n = 0; n < strand.joints; n++) {
        path_arms(&path, n);
        for (int i = 0; i < count; i++) {
            pin_pull c[1] = {{{0}}};
            add_bends(&path, n, &strand, values, &splines[i], 1, c);
            weights[i] += pinning_square(c[0]) / strand.joints;
        }
    }
}

const struct pinning_functions strand_pinning = {find, weigh};
