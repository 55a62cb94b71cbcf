/// The stage's contents: camera, characters, shadows. The editor fills it, draw/ draws it.
#ifndef UI_STAGE_H
#define UI_STAGE_H

#include "base/hash.h"
#include "base/png.h"
#include "model/figure.h"
#include "model/fox.h"
#include "model/gltf.h"
#include "ui/drawlist.h"
#include "ui/theme.h"

enum {
    STAGE_MAX_TAILS = 8,
    STAGE_MAX_MODELS = 8 + STAGE_MAX_TAILS, ///< characters, and tails' foxes
    STAGE_MAX_BLOBS = 20 * STAGE_MAX_TAILS + 4 * STAGE_MAX_MODELS,
};

/// A character or a fox.
struct stage_model {
    struct model_pose posed; ///< valid until the next frame at least
    int rig;                 ///< index in the document; −1: a fox, or a second picture of a character
    float dusk;              ///< metres above its ground, up to which that shades it
    float lo[3], hi[3];      ///< bounding box, world
    int map_coordinate;      ///< coordinate of its figure whose phases are shown; −1: own colours
    int map_axis;            ///< axis of the shown phases: x, y, z
};

struct stage_view {
    struct rect viewport; ///< logical pixels of the window
    float view[16];       ///< world → eye, column-major
    float projection[16]; ///< eye → clip
    float eye[3];         ///< camera position, world
    float middle[2];      ///< x and z of the lit ground's middle
    float key_from[3];    ///< unit vector towards the key light, world
    struct stage_colors colors;
    struct png_picture behind; ///< the background's; without pixels: none
    uint64_t behind_id;        ///< another one for other pixels
    bool has_tail;             ///< the ground is never small
    struct stage_model models[STAGE_MAX_MODELS];
    int model_count;
    struct shadow_blob blobs[STAGE_MAX_BLOBS];
    int blob_count;
    uint64_t hash; ///< of everything above: equal hashes mean equal pixels
};

/// Adds a blob if there is room.
static inline void stage_add_blob(struct stage_view *view, float x, float z, float radius, float strength)
{
    if (view->blob_count < STAGE_MAX_BLOBS)
        view->blobs[view->blob_count++] = (struct shadow_blob){x, z, radius, strength};
}

/// Hash of viewport, camera, light, colours and background.
static inline uint64_t stage_scenery_hash(const struct stage_view *view)
{
    uint64_t hash = hash_bytes(HASH_START, &view->viewport, sizeof view->viewport);
    hash = hash_bytes(hash, view->view, sizeof view->view);
    hash = hash_bytes(hash, view->projection, sizeof view->projection);
    hash = hash_bytes(hash, view->middle, sizeof view->middle);
    hash = hash_bytes(hash, view->key_from, sizeof view->key_from);
    hash = hash_word(hash, view->behind.pixels ? view->behind_id : 0);
    return hash_bytes(hash, &view->colors, sizeof view->colors);
}

#endif
