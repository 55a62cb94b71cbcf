/// Finds illegible texts on a screen.
#ifndef TESTS_LEGIBLE_H
#define TESTS_LEGIBLE_H

#include "ui/drawlist.h"
#include "ui/theme.h"

/// What lies below the draw list.
struct legible_ground {
    struct rect window, stage;
    bool whole; ///< also no text may be cut with "…"
};

/// Prints each text that leaves the window or its clip sideways, overlaps another, or has a contrast below 4.5:1 with what was painted
/// before it. Ignores texts under opaque paint. Returns their number.
int legible_problems(const struct drawlist *list, const struct legible_ground *ground, const char *screen);

#endif
