/// How long a spline's filter takes to settle: what people feel of damping.
#ifndef EDITOR_INSPECTOR_SETTLE_H
#define EDITOR_INSPECTOR_SETTLE_H

#include "scene/document.h"

enum { SETTLE_LIMIT = 1000 }; ///< seconds; later than that nobody waits for it

enum settle_kind {
    SETTLE_UNKNOWN,  ///< a track drives a pole: no number is true for long
    SETTLE_CUBIC,    ///< there is no filter
    SETTLE_NEVER,    ///< it rings forever
    SETTLE_LATE,     ///< after SETTLE_LIMIT
    SETTLE_MEASURED, ///< `seconds`
};

struct settling {
    enum settle_kind kind;
    double seconds;
};

/// Runs the spline's own filter at this sampling (`step` seconds), x_{i+1} = a x_i + b x_{i−1} (eq. 20, 21), and says when
/// what it was let go with stays within 5 %: in real mode a displacement at standstill, |x|; in complex mode a swing with
/// both poles alike, |x|. Allocates nothing; beyond some 100,000 samples the slower pole's radius answers.
struct settling settle_measure(const struct spline *spline, double step);

#endif
