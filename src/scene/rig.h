/// A rig: what splines move. A kind of rigs is a row in each layer: how it is read, written and copied (rig_kind.c here), posed
/// (rig/posing.c), put on the stage (editor/stage/stage.c), drawn (draw/stage.c) and edited (editor/inspector/inspector.c).
#ifndef SCENE_RIG_H
#define SCENE_RIG_H

#include "scene/character.h"
#include "scene/tail.h"
#include <stddef.h>

enum rig_kind { RIG_TAIL, RIG_CHARACTER, RIG_KINDS };

enum { RIG_MAX_INPUTS = 64 }; ///< of a rig of any kind

struct rig {
    enum rig_kind kind;
    char *name; ///< NULL where the file has none
    union {
        struct tail tail;
        struct character_rig character;
    };
    struct json_t *extra;
};

/// The file's word for a kind: "tail" …
const char *rig_word(enum rig_kind kind);

/// The splines that move it besides its place, by index: channels, drives.
int rig_input_count(const struct rig *rig);
int rig_input(const struct rig *rig, int input);

/// A copy with a name of its own. On failure nothing is left to be freed.
bool rig_copy(const struct rig *rig, struct rig *copy);

/// Frees what it holds.
void rig_release(struct rig *rig);

/// Memory that it takes, unknown keys left out.
size_t rig_bytes(const struct rig *rig);

/// The files that it names are to be found from another folder (path.h); false where memory is short.
bool rig_rebase(struct rig *rig, const char *from, const char *to);

#endif
