/// A sentence beside the control under the pointer or with the focus.
#ifndef UI_TOOLTIP_H
#define UI_TOOLTIP_H

#include "ui/drawlist.h"

/// Zero: none.
struct tooltip {
    const char *text; ///< NULL: none
    struct rect at;   ///< must stay visible
    float x, y;       ///< of the pointer
    double rest;      ///< seconds without movement
    bool spent;       ///< a press dismissed it, until the text changes
};

/// Offers a tooltip for the control at `at` with the pointer at x, y. Movement restarts the wait.
void tooltip_offer(struct tooltip *tooltip, const char *text, float x, float y, struct rect at);
/// Call on a press, a key or the wheel.
void tooltip_dismiss(struct tooltip *tooltip);
void tooltip_advance(struct tooltip *tooltip, double dt);
bool tooltip_is_shown(const struct tooltip *tooltip);
/// Whether it will appear soon, so that frames must go on.
bool tooltip_waits(const struct tooltip *tooltip);
/// Below or above the control, inside the window.
struct rect tooltip_box(const struct tooltip *tooltip, struct rect window);
void tooltip_show(const struct tooltip *tooltip, struct rect window, struct drawlist *list);

#endif
