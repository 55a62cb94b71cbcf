/// Motion out: a document's rigs and splines into the files of other programs. What a file holds follows from its name's end.
#ifndef EXPORT_EXPORT_H
#define EXPORT_EXPORT_H

#include "rig/posing.h"

/// What to export; all zero: every rig that the file can hold, over all frames, a key a sample.
struct export_options {
    const char *rig;        ///< its name, or NULL
    const char *rig_choice; ///< what sentences call the way to choose a rig; NULL: "--rig"
    const char *clip;       ///< what the animation is called; NULL: as the scene
    bool has_frames;        ///< else all
    double first, last;     ///< frames
    double rate;            ///< keys or pictures a second; 0: one a sample or, of a film, a frame
    int substeps;           ///< keys a frame, or 0
    bool is_signed;         ///< morph weights may be negative, which takes half as many targets
    bool is_cubic;          ///< keys have tangents (glTF)
    bool all_clips;         ///< the chains move every clip of an imported character's file (glTF)
    bool as_shown;          ///< an imported character as large and where it is on the stage, not as in its own file
    // of films and pictures (app/film.h)
    int size[2];      ///< pixels; 0: 1280 × 720, for .gif 640 × 360
    int loops;        ///< rounds, each without its last frame, which is the next one's first; 0: once with it
    bool transparent; ///< the rigs alone (.png, .webm)
    bool (*proceed)(void *user, long done, long total); ///< called as it goes on; false: stop. May be NULL
    void *user;
};

struct export_report {
    char text[160]; ///< what is in the file and how large it is: "24 joints, 121 keys, 47 KB"
    char note[256]; ///< what the user should know besides, or empty
};

enum { EXPORT_ENDINGS = 256 };

/// Whether there is a format for a file of that name.
bool export_knows(const char *path);

/// The endings there are, as a sentence lists them: ".glb, .gltf … or .npy".
void export_endings(char text[EXPORT_ENDINGS]);

/// Writes the file, whole or not at all. The document's splines must be solved and its models read.
bool export_write(const struct posing *posing, const char *path, const struct export_options *options,
                  struct export_report *report, struct error *error);

#endif
