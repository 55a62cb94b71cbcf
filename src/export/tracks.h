/// What moves the nodes of an imported character: rows of numbers at each key. Private to src/export.
#ifndef EXPORT_TRACKS_H
#define EXPORT_TRACKS_H

#include "export/take.h"

struct track {
    int node;
    enum gltf_path path;
    int components;
    float *values; ///< key after key; rotations the short way from each to the next
};

struct tracks {
    struct track *list;
    int count;
    bool has_chains;
    bool keeps_clip; ///< the keys span the clip once, so that whatever else it moves can stay as it is
};

/// Of a model rig: the rotations of all bones in its chains and, unless `keeps_clip`, all else that its clip moves. False with a sentence,
/// and nothing to free.
bool tracks_collect(struct take *take, int rig, struct tracks *tracks, struct error *error);
void tracks_free(struct tracks *tracks);

#endif
