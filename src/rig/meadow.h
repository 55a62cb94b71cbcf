/// The reeds of a meadow, each with a curve of its own: variations of one spline, solved as a batch.
#ifndef RIG_MEADOW_H
#define RIG_MEADOW_H

#include "scene/evaluate.h"

/// A reed as it stands.
struct reed {
    float place[3]; ///< metres
    float height;   ///< metres
    float turn;     ///< radians that its wind is off +x
    float shade;    ///< 0 … 1
};

/// Opaque.
struct meadow;

struct meadow *meadow_create(void);
void meadow_destroy(struct meadow *meadow);

/// Solves the reeds of the document's first meadow anew if their number, seed or variation or their spline's curve has changed. Allocates only where there are more
/// reeds, samples or knots than before.
void meadow_update(struct meadow *meadow, const struct document *document, const struct evaluation *evaluation);

/// Number of reeds solved by the last update.
int meadow_solved(const struct meadow *meadow);

/// Number of reeds; the place of each; and its value at a position in samples.
int meadow_count(const struct meadow *meadow);
const struct reed *meadow_reed(const struct meadow *meadow, int reed);
wiggly_value meadow_value(const struct meadow *meadow, int reed, double position);

#endif
