/// A figure whose coordinates are turned and scaled vertex by vertex: Ñ' = Ñ e^{a + jψ}. Everything else is shared with the plain figure.
#ifndef MODEL_PAINTED_H
#define MODEL_PAINTED_H

#include "model/figure.h"

struct painted {
    struct figure figure; ///< with coordinates, slopes and largest amplitudes of its own
    const struct figure *plain;
    float (*applied)[2]; ///< a and ψ that it has, at coordinate · vertex_count + vertex
    bool *stale;         ///< vertices whose slopes must be refitted
};

/// A copy of the plain figure, which must outlive it. NULL if memory is short.
struct painted *painted_create(const struct figure *plain);
void painted_destroy(struct painted *painted);

/// Applies the paint (NULL: none; laid out as `applied`). Recomputes only what changed since the last time, and marks it in
/// figure.version and figure.changed. Allocates nothing.
void painted_update(struct painted *painted, const float (*paint)[2]);

#endif
