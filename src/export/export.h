/// Exports a document's rigs and splines to files for other programs. The file name's extension selects the format.
#ifndef EXPORT_EXPORT_H
#define EXPORT_EXPORT_H

#include "model/motion.h"
#include "rig/posing.h"
#include <stdio.h>

/// What a user can choose for a format, besides name and frames.
enum export_choice {
    CHOICE_KEYS = 1,   ///< keys per frame
    CHOICE_RIG = 2,    ///< one rig or all
    CHOICE_ONE = 4,    ///< one rig per file
    CHOICE_CLIP = 8,   ///< the animation's name
    CHOICE_CLIPS = 16, ///< one clip or all
    CHOICE_SIGNED = 32,
    CHOICE_SIZE = 64, ///< size of its pictures
    CHOICE_ALPHA = 128,
    CHOICE_JOINTS = 256, ///< tails and characters only
};

/// Films and pictures, which src/app/film.c draws. A browser has only the first.
enum export_film { FILM_NONE, FILM_GIF, FILM_MP4, FILM_WEBM, FILM_PNG };

struct export_range;

struct export_format {
    const char *ending, *use; ///< ".glb", and one line about its use
    bool is_more;             ///< the Export dialog has it behind "More formats"
    unsigned choices;         ///< of enum export_choice
    unsigned holds; ///< the content it needs of a rig (FORM_MESH … in form.h); 0: any kind, or no rig at all
    bool is_binary; ///< the binary one of two containers
    enum motion_form motion;
    /// Writes everything to a stream and fills the summary. The caller checks the stream for errors. NULL: a film.
    bool (*write)(struct export_range *range, FILE *out, struct error *error);

    enum export_film film;
    int width, height; ///< default size
    double most_rate;  ///< pictures per second that players show
    bool is_even;      ///< only even sizes
    bool repeats;      ///< players loop it
};

enum { EXPORT_FORMATS = 12, EXPORT_ENDINGS = 256 };

extern const struct export_format export_formats[EXPORT_FORMATS];

/// The format by the path's extension; NULL: an unknown one.
const struct export_format *export_format(const char *path);

/// Whether the scene's end meets its start, by a spline or an imported clip.
bool export_loops(const struct document *document);

/// How many pictures a film of so many frames has, and, where `*rate` is 0, how many a second. `loops`: as in struct export_options.
double export_pictures(const struct export_format *format, const struct document *document, double frames, int loops,
                       double *rate);

/// The extensions as a list for sentences: ".glb, .gltf … or .npy". Of the formats for rigs with this content (FORM_MESH …), or, if 0, of
/// all, films too.
void export_endings(unsigned holds, char text[EXPORT_ENDINGS]);

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
    bool all_clips;         ///< applies chains to all clips of a character (glTF)
    bool as_shown;          ///< the stage's size and place, not the character's file's or a cache's node's
    // films and pictures (app/film.h)
    int size[2];      ///< pixels; 0: the format's
    int loops;        ///< rounds, each without its last frame, which repeats the first; 0: one with it
    bool transparent; ///< only rigs (.png, .webm)
    bool (*proceed)(void *user, long done, long total); ///< progress callback; returning false stops. May be NULL
    void *user;
};

struct export_report {
    char text[160]; ///< content and size: "24 joints, 121 keys, 47 KB"
    char note[256]; ///< a remark for the user, or empty
};

/// Writes the file completely or not at all; not for films. The document's splines must be solved and its models loaded.
bool export_write(const struct posing *posing, const char *path, const struct export_options *options,
                  struct export_report *report, struct error *error);

#endif
