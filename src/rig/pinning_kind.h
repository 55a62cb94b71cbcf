/// How points of each kind of rig are found and moved. Private to src/rig.
#ifndef RIG_PINNING_KIND_H
#define RIG_PINNING_KIND_H

#include "rig/posing.h"

struct pinning_functions {
    /// As model_source.find() and weigh(). `posing` is as the paper has it, and `sample` a pin's.
    bool (*find)(const struct posing *posing, int rig, double sample, int which, const int *splines, int count,
                 pin_pull *c, struct pin_point *point);
    void (*weigh)(const struct posing *posing, int rig, const int *splines, int count, double *weights);
};

/// As model_source.lowest() and follow().
bool character_lowest(const struct posing *posing, int rig, double ceiling, double *room, struct low_point *low);
bool clip_follow(void *context, const struct document *document, const struct joint_motion *motion, double *samples);

extern const struct pinning_functions strand_pinning, character_pinning;

/// Adds what a channel's spline does to a point that a bend of joint n takes along `way`, metres a radian.
void pinning_add_channel(const struct channel *channel, int n, int joints, const double way[3], pin_pull c);

/// Σ |c|²
double pinning_square(const pin_pull c);

#endif
