/// Motions of joints that equilibria follow: what a document says of them. motion.h has them read.
#ifndef SCENE_JOINT_MOTION_H
#define SCENE_JOINT_MOTION_H

#include <stdatomic.h>
#include <stdbool.h>

/// What of a joint is followed: degrees about world up, or metres across the chain's direction or up.
enum motion_of { MOTION_TURN, MOTION_ACROSS, MOTION_UP, MOTION_KINDS };

/// The file's words for them, ended by NULL.
extern const char *const motion_words[];

/// A joint, in the clip that its model plays, against its mean over the clip.
struct joint_motion {
    atomic_int holders; ///< splines
    char *model;        ///< the name of a model rig, or its file
    bool by_file;       ///< `model` is the file
    char *joint;        ///< its name; not looked up here
    enum motion_of of;
    char *chain; ///< name of the chain whose direction counts, or NULL
};

/// A copy with one holder.
struct joint_motion *motion_create(const struct joint_motion *motion);
bool motion_equals(const struct joint_motion *a, const struct joint_motion *b);

/// NULL is fine, as of the next.
void motion_hold(struct joint_motion *motion);
void motion_drop(struct joint_motion *motion);

#endif
