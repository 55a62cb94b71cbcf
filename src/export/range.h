/// What is exported: rigs of a document, posed at evenly spaced times; and the formats that it goes into. Private to src/export.
#ifndef EXPORT_RANGE_H
#define EXPORT_RANGE_H

#include "export/sidecar.h"
#include "rig/posing.h"
#include <stdio.h>

enum { FORMAT_SUMMARY = 96 };

struct export_range {
    const struct posing *posing;
    int rigs[SCENE_MAX_RIGS]; ///< by index in the document
    int rig_count;
    double first;   ///< frame of the first key
    double spacing; ///< frames from one key to the next
    int key_count;
    const char *clip;       ///< what the animation is to be called, or NULL
    const char *title;      ///< what else it may be called: as the scene
    const char *path;       ///< of the file that is written
    const char *rig_choice; ///< how a rig is chosen, for sentences
    bool is_signed;         ///< a morph target's weight may be negative; else there is a second target for that
    bool is_cubic;          ///< keys have tangents
    bool (*proceed)(void *user, long done, long total); ///< called as keys are done; false: stop. NULL: nobody asks
    void *user;
    long done, total;         ///< keys of all rigs
    struct sidecars sidecars; ///< files that the one that is written names
};

/// The frame of a key, and its time in seconds from the first.
double range_frame(const struct export_range *range, double key);
double range_seconds(const struct export_range *range, double key);

/// Poses a rig of the document, a chain's model, at a key; between two keys for one that is not whole. Outside of the document loops go on, and all
/// else stands still. False with a sentence if the rig's model is missing.
bool range_pose(const struct export_range *range, int rig, double key, struct rig_pose *pose, struct error *error);

/// A spline's value at a key.
wiggly_value range_value(const struct export_range *range, int spline, double key);

/// Whether a key's time is within the document.
bool range_is_inside(const struct export_range *range, double key);

/// Counts a key of a rig as done. False with a sentence if the export is to stop.
bool range_proceed(struct export_range *range, struct error *error);

// --- formats: each writes all of it to a stream, whose errors the caller sees, and says in a few words what it wrote

bool csv_write(struct export_range *range, FILE *out, char summary[FORMAT_SUMMARY], struct error *error);
bool pc2_write(struct export_range *range, FILE *out, char summary[FORMAT_SUMMARY], struct error *error);
bool mdd_write(struct export_range *range, FILE *out, char summary[FORMAT_SUMMARY], struct error *error);
bool npy_write(struct export_range *range, FILE *out, char summary[FORMAT_SUMMARY], struct error *error);
bool glb_write(struct export_range *range, FILE *out, char summary[FORMAT_SUMMARY], struct error *error);
bool gltf_write(struct export_range *range, FILE *out, char summary[FORMAT_SUMMARY], struct error *error);
bool bvh_write(struct export_range *range, FILE *out, char summary[FORMAT_SUMMARY], struct error *error);
bool usda_write(struct export_range *range, FILE *out, char summary[FORMAT_SUMMARY], struct error *error);

/// Writes a rig that is no imported character as a .glb of its own.
bool gltf_write_rig(struct export_range *range, int rig, FILE *out, struct error *error);

#endif
