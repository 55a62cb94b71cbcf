/// The fixed frame that every timing log carries as its yardstick: lines, text and a bent tail that come from constants
/// alone, so that logs of different builds and documents can be compared. Private to draw/.
#ifndef DRAW_REFERENCE_H
#define DRAW_REFERENCE_H

#include "base/error.h"
#include "ui/stage.h"

enum { REFERENCE_RUNS_MAX = 64 };

struct reference {
    struct drawlist list;
    struct stage_view stage;
    double ms[REFERENCE_RUNS_MAX];
};

void reference_create(struct reference *reference);
void reference_destroy(struct reference *reference);

/// Lays the frame out in a window of width × height logical pixels.
void reference_arrange(struct reference *reference, float width, float height);

/// Sorts the first `count` entries of `ms` and returns their median.
double reference_median(struct reference *reference, int count);

#endif
