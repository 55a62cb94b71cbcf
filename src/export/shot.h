/// What is exported: rigs of a document, posed at evenly spaced times. Private to src/export.
#ifndef EXPORT_SHOT_H
#define EXPORT_SHOT_H

#include "export/beside.h"
#include "rig/posing.h"

struct shot {
    const struct posing *posing;
    int rigs[SCENE_MAX_RIGS]; ///< by index in the document
    int rig_count;
    double first;   ///< frame of the first key
    double spacing; ///< frames from one key to the next
    int key_count;
    const char *clip;  ///< what the animation is to be called, or NULL
    const char *title; ///< what else it may be called: as the scene
    const char *path;  ///< of the file that is written
    bool is_signed;    ///< a morph target's weight may be negative; else there is a second target for that
    bool is_cubic;     ///< keys have tangents
    bool (*proceed)(void *user, long done, long total); ///< called as keys are done; false: stop. NULL: nobody asks
    void *user;
    long done, total;     ///< keys of all rigs
    struct beside beside; ///< files that the one that is written names
};

/// The frame of a key, and its time in seconds from the first.
double shot_frame(const struct shot *shot, double key);
double shot_seconds(const struct shot *shot, double key);

/// Poses a rig of the document at a key; between two keys for one that is not whole. Outside of the document loops go on, and all
/// else stands still. False with a sentence if the rig's model is missing.
bool shot_pose(const struct shot *shot, int rig, double key, struct rig_pose *pose, struct error *error);

/// A spline's value at a key.
wiggly_value shot_value(const struct shot *shot, int spline, double key);

/// Whether a key's time is within the document.
bool shot_is_inside(const struct shot *shot, double key);

/// Counts a key of a rig as done. False with a sentence if the export is to stop.
bool shot_proceed(struct shot *shot, struct error *error);

#endif
