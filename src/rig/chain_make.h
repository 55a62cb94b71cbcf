/// Makes a chain of an imported character's bones, with splines and channels that suit its size.
#ifndef RIG_CHAIN_MAKE_H
#define RIG_CHAIN_MAKE_H

#include "rig/models.h"
#include "scene/document.h"

/// What is wanted; numbers that are 0 are chosen by the chain's length.
struct chain_wish {
    int model;        ///< index of the model rig
    const char *from; ///< its first bone
    const char *to;   ///< its last; NULL: the only way down to a tip
    bool own;         ///< it shares no splines with its twin
    bool follows;     ///< its splines' equilibria follow its tip through the clip, so that it swings without a knot
    double frequency; ///< Hz
    double damping;   ///< ratio
    double lag;       ///< degrees a bone
};

/// Adds the chain and its splines (side and up). Where its twin on the other side, by the bones' names, is a chain already, it
/// shares the twin's splines, mirrored, unless the wish is for its own. `rig`: its index. After a failure some of its splines may be there: the
/// caller takes them back.
bool chain_make(struct document *document, const struct models *models, const struct chain_wish *wish, int *rig,
                struct error *error);

/// Degrees by which each of its bones is to bend where the tip is to move by a metre; `scale`: of the character.
double chain_bend_a_metre(const struct imported *imported, const struct chain_bones *bones, double scale);

#endif
