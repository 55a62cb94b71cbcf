/// What is to be seen on the stage: a camera, posed tails and their shadows. Made by the editor, drawn by draw/.
#ifndef UI_STAGE_H
#define UI_STAGE_H

#include "rig/pose.h"
#include "ui/drawlist.h"

enum { STAGE_MAX_TAILS = 8, STAGE_MAX_BLOBS = 16 * STAGE_MAX_TAILS };

/// One tail to draw; its mesh is rebuilt only when joints or length change.
struct stage_tail {
    int joints;
    float length;
    struct pose pose;
};

/// A soft contact shadow on the ground: a disc that darkens; `strength` 0 … 1, more where nearer.
struct stage_blob {
    float x, z, radius, strength;
};

struct stage_view {
    struct rect viewport; ///< logical pixels of the window
    float view[16];       ///< world → eye, column-major
    float projection[16]; ///< eye → clip
    float eye[3];         ///< camera position, world
    float middle[2];      ///< x and z of the middle of the lit ground
    struct stage_tail tails[STAGE_MAX_TAILS];
    int tail_count;
    struct stage_blob blobs[STAGE_MAX_BLOBS];
    int blob_count;
    uint64_t hash; ///< of everything above: equal hash, equal pixels
};

#endif
