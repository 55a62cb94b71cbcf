/// Scenes for glTF characters: one stands on the stage and plays its first clip; chains of its bones, with splines and channels that suit its size.
/// And scenes opened for commands.
#ifndef RIG_IMPORT_H
#define RIG_IMPORT_H

#include "rig/posing.h"

/// Whether a file is a character: by its name, .glb or .gltf, or by its first bytes.
bool import_suits(const char *path);

/// A new document without a path, with the character of the file, as import_add() adds it. It takes the first clip's range, from its first key to
/// its last, and the frame rate of the clip's keys. NULL and an error on failure.
struct document *import_scene(const char *path, struct error *error);

/// Adds the character in a file to a document. It plays its first clip; `spline` (-1: a new one) drives its first coordinate, if it has any.
/// False with a sentence.
bool import_add(struct document *document, const char *path, int spline, struct error *error);

/// Shows a model rig by a copy of its file to which `wiggly flesh` has added coordinates. Each gets a spline that follows its bone in the clip.
/// Paint stays; but if it chose the part, amplitudes that it raised go. False with a sentence; the document may then be half changed.
bool import_flesh(struct document *document, int rig, const char *path, bool by_paint, struct error *error);

/// Makes a model rig play a clip of its file, NULL: none. A scene without splines, or with some that follow the clip and no knots or pins,
/// takes the clip's frame rate and range, and splines that follow it loop if it does.
bool import_choose_clip(struct document *document, int rig, const struct gltf *gltf, const char *clip,
                        enum clip_repeat repeat, struct error *error);

/// A copy of a document in which a model rig plays another clip, by its index, in that clip's frames. It has no pins of chains and no knots of
/// splines that follow the clip, because those were set for the first clip. NULL with a sentence.
struct document *import_with_clip(const struct document *document, int rig, const struct gltf *gltf, int clip,
                                  struct error *error);

// --- chains

/// The strength of a new chain that follows a clip: the largest swing of the clip turns its tip by so many degrees, all bones together.
enum { CHAIN_SWING = 30 };

/// A request for a chain; numbers that are 0 are chosen by its length.
struct chain_wish {
    int model;        ///< index of the model rig
    const char *from; ///< its first bone
    const char *to;   ///< its last; NULL: the only way down to a tip
    bool own;         ///< it shares no splines with its twin
    bool follows;     ///< its splines' equilibria follow its tip through the clip, so that it swings without knots
    double frequency; ///< Hz
    double damping;   ///< ratio
    double lag;       ///< degrees a bone
};

/// Adds the chain and its splines (side and up). If its twin on the other side, by the bones' names, is already a chain, it shares the twin's
/// splines, mirrored, unless the request is for its own. `rig` receives its index. After a failure some of its splines may remain: the caller
/// undoes them.
bool chain_make(struct document *document, const struct models *models, const struct chain_wish *wish, int *rig,
                struct error *error);

/// Degrees that each of its bones must bend to move the tip by a metre; `scale`: the character's.
double chain_bend_a_metre(const struct imported *imported, const struct chain_bones *bones, double scale);

// --- opened for a command

/// A scene: the document, its models, and its splines solved.
struct opened {
    struct document *document;
    struct models *models;
    struct evaluation evaluation;
};

/// Reads a scene, or makes one for a glTF character, and reads its models and paint. On failure nothing is left to free.
bool opened_read(struct opened *opened, const char *path, struct error *error);

/// The same for commands that need only the splines: models are read only if an equilibrium follows a joint or a point is pinned.
bool opened_read_splines(struct opened *opened, const char *path, struct error *error);

/// Solves all splines, with the motions that they follow; again after edits.
void opened_solve(struct opened *opened, enum solver_choice solver);

void opened_free(struct opened *opened);

/// The context for posing its rigs.
struct posing opened_posing(const struct opened *opened);

#endif
