/// A figure whose coordinates are turned and scaled vertex by vertex: Ñ' = Ñ e^{a + jψ}. All else is the plain figure's.
#ifndef MODEL_PAINTED_H
#define MODEL_PAINTED_H

#include "model/figure.h"

struct painted {
    struct figure figure; ///< with coordinates, slopes and largest amplitudes of its own
    const struct figure *plain;
    float (*applied)[2]; ///< a and ψ that it has, at coordinate · vertex_count + vertex
    bool *stale;         ///< vertices whose slopes are to be fitted anew
};

/// A figure that is as the plain one, which must outlive it. NULL where memory is short.
struct painted *painted_create(const struct figure *plain);
void painted_destroy(struct painted *painted);

/// Gives it the paint (NULL: none; laid out as `applied`). Only what differs from the last time is computed, and noted in
/// figure.version and figure.changed. Allocates nothing.
void painted_update(struct painted *painted, const float (*paint)[2]);

#endif
