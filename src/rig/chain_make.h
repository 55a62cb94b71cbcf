/// Makes a chain of an imported character's bones, with splines and channels that suit its size.
#ifndef RIG_CHAIN_MAKE_H
#define RIG_CHAIN_MAKE_H

#include "rig/models.h"
#include "scene/document.h"

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

#endif
