/// A sentence on the control under the pointer or with the keyboard focus, beside it.
#ifndef UI_TOOLTIP_H
#define UI_TOOLTIP_H

#include "ui/drawlist.h"

/// All zero is none.
struct tooltip {
    const char *text; ///< that is waited for or shown; NULL: none
    struct rect at;   ///< the rectangle to keep free
    float x, y;       ///< of the pointer
    double rest;      ///< seconds that it has rested there
    bool spent;       ///< a press has put it away, until the text changes
};

/// Offers a tooltip for the control at `at`, with the pointer at x, y. A moving pointer restarts the wait until it is shown.
void tooltip_offer(struct tooltip *tooltip, const char *text, float x, float y, struct rect at);
/// A press, a key or the wheel puts it away.
void tooltip_dismiss(struct tooltip *tooltip);
void tooltip_advance(struct tooltip *tooltip, double dt);
bool tooltip_is_shown(const struct tooltip *tooltip);
/// Whether it is about to be shown: frames must go on.
bool tooltip_waits(const struct tooltip *tooltip);
/// Its rectangle in a window: below the control or above it, always inside the window.
struct rect tooltip_box(const struct tooltip *tooltip, struct rect window);
void tooltip_show(const struct tooltip *tooltip, struct rect window, struct drawlist *list);

#endif
