/// Equilibria that follow a joint of an imported character (joint_motion.h). What the joint does is read by a layer above, which knows
/// models, and baked into one number a sample before the splines are solved.
#ifndef SCENE_MOTION_H
#define SCENE_MOTION_H

#include "scene/evaluate.h"
#include "scene/joint_motion.h"

/// Writes what a joint does at each of the document's samples, in degrees or metres, without gain. false: it cannot be read.
typedef bool motion_reader(void *context, const struct document *document, const struct joint_motion *motion,
                           double *samples);

/// What motions are read from.
struct motion_source {
    motion_reader *read; ///< NULL: nothing can be read
    void *context;
    uint64_t version; ///< changes when `read` may give something else for the same document
};

/// Reads again the motions for which the document's frames, model, clip or chain or the source's version have changed; the next update then
/// solves their splines. To be called before each update, after evaluation_resize(). Whether any has changed. What cannot be read is
/// 0 throughout. Allocates nothing.
bool motions_bake(struct evaluation *evaluation, const struct document *document, const struct motion_source *source);

/// Takes over what is baked in another evaluation, for a trial of the same document.
void motions_copy(struct evaluation *evaluation, const struct evaluation *from);

/// What is baked for a spline, with gain: one number a sample. NULL if there is nothing.
const double *motions_samples(const struct evaluation *evaluation, int spline);

#endif
