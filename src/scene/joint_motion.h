/// Motions of joints that equilibria follow: what a document says of them. motion.h has them read.
#ifndef SCENE_JOINT_MOTION_H
#define SCENE_JOINT_MOTION_H

#include <stdbool.h>
#include <stddef.h>

/// What of a joint is followed: degrees about world up, or metres across the chain's direction or up.
enum motion_of { MOTION_TURN, MOTION_ACROSS, MOTION_UP, MOTION_KINDS };

/// The file's words for them, ended by NULL.
extern const char *const motion_words[];

/// A joint, in the clip that its model plays, against its mean over the clip.
struct joint_motion {
    char *model;  ///< the name of a model rig, or its file
    bool by_file; ///< `model` is the file
    char *joint;  ///< its name; not looked up here
    enum motion_of of;
    char *chain; ///< name of the chain whose direction counts, or NULL
};

/// All motions that a document's parameters follow or followed. Starts as zeros.
struct motion_list {
    struct joint_motion **items;
    int count;
};

/// The list's own motion equal to this one, whose texts are copied if it is new. NULL if memory runs out.
const struct joint_motion *motion_list_keep(struct motion_list *list, const struct joint_motion *motion);

/// Rewrites those that go by a file for another folder; false if memory runs out.
bool motion_list_rebase(struct motion_list *list, const char *from, const char *to);

size_t motion_list_bytes(const struct motion_list *list);
void motion_list_free(struct motion_list *list);

#endif
