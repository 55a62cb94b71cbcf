/// What is wrong with the texts of a screen: whether each can be read where it stands.
#ifndef TESTS_LEGIBLE_H
#define TESTS_LEGIBLE_H

#include "ui/drawlist.h"
#include "ui/theme.h"

/// What lies below the draw list.
struct legible_ground {
    struct rect window, stage;
    bool whole; ///< no text may be cut short with "…" either
};

/// Prints each text that leaves the window or its clip sideways, lies over another one, or has a contrast below 4.5:1 on
/// what was painted there before it. What something opaque was painted over is not seen. Returns how many there are.
int legible_problems(const struct drawlist *list, const struct legible_ground *ground, const char *screen);

#endif
