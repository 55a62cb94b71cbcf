/// What the parts of the inspector's section on tails share. Private to inspector_*.c.
#ifndef EDITOR_INSPECTOR_INSPECTOR_TAIL_H
#define EDITOR_INSPECTOR_INSPECTOR_TAIL_H

#include "editor/inspector/inspection.h"

/// One of a tail's three angles, as a slider shows it.
struct angle_row {
    enum angle_kind kind;
    const char *name, *hint, *undo;
    double minimum, maximum, fallback, step;
};

extern const struct angle_row angle_row_lag, angle_row_gain, angle_row_rest;

/// Rows for the angles of the tail or channel that the inspector shows.
void inspector_angles(struct inspection *in, const struct angle_row *row, const struct angles *angles);

/// Its channels: the list, and how much and how late the chosen one bends; and what that is made of.
void inspector_channels(struct inspection *in, const struct tail *tail);
void inspector_channel(struct inspection *in, const struct tail *tail);

/// The list of splines that the channel can bend by, where it is open.
void inspector_feed_list(struct inspection *in);

#endif
