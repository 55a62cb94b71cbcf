/// Exports a document's rigs and splines to files for other programs. The file name's extension selects the format.
#ifndef EXPORT_EXPORT_H
#define EXPORT_EXPORT_H

#include "rig/posing.h"

/// What to export. All zero: every rig that the format supports, all frames, a key per sample.
struct export_options {
    const char *rig;        ///< name, or NULL
    const char *rig_choice; ///< the option for choosing a rig, as named in errors; NULL: "--rig"
    const char *clip;       ///< name of the animation; NULL: the scene's
    bool has_frames;        ///< false: all frames
    double first, last;     ///< frames
    double rate;            ///< keys or pictures per second; 0: one per sample or, in films, per frame
    int substeps;           ///< keys per frame, or 0
    bool is_signed;         ///< allows negative morph weights, which halves the number of targets
    bool is_cubic;          ///< keys with tangents (glTF)
    bool all_clips;         ///< applies chains to all clips of an imported character (glTF)
    bool as_shown;          ///< an imported character in the stage's size and place, not its file's
    // films and pictures (app/film.h)
    int size[2];      ///< pixels; 0: 1280 × 720, for .gif 640 × 360
    int loops;        ///< rounds, each without its last frame, which repeats the first; 0: one with it
    bool transparent; ///< only rigs (.png, .webm)
    bool (*proceed)(void *user, long done, long total); ///< progress callback; returning false stops. May be NULL
    void *user;
};

struct export_report {
    char text[160]; ///< content and size: "24 joints, 121 keys, 47 KB"
    char note[256]; ///< a remark for the user, or empty
};

enum { EXPORT_ENDINGS = 256 };

/// Whether the file name has a known extension.
bool export_knows(const char *path);

/// The extensions as a list for sentences: ".glb, .gltf … or .npy".
void export_endings(char text[EXPORT_ENDINGS]);

/// Writes the file completely or not at all. The document's splines must be solved and its models loaded.
bool export_write(const struct posing *posing, const char *path, const struct export_options *options,
                  struct export_report *report, struct error *error);

#endif
