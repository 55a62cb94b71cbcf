/// Warnings in the curves panel: what the active spline does that nobody wants, where, and a remedy for each.
#ifndef EDITOR_CURVES_WARNINGS_H
#define EDITOR_CURVES_WARNINGS_H

#include "editor/core/state.h"

/// Finds what is wrong with a solved spline. At most WARNINGS_MAX, spans in the order of time.
void warnings_find(const struct document *document, const struct evaluation *evaluation, int spline,
                   struct warnings *found);
/// The same for the active spline where document or look have changed since; allocates nothing.
void warnings_update(struct editor *editor, const struct editor_world *world);

/// Where a warning's marker is, in logical pixels; false where it is out of sight.
bool warning_place(const struct editor *editor, const struct warning *warning, float xy[2]);
void warnings_show(struct editor *editor);
/// Words under the pointer; after everything else, so that nothing lies over them.
void warnings_show_words(struct editor *editor);

/// Does away with a warning, as one undo step; of several remedies the first that helps when it is tried.
void warning_remedy(struct editor *editor, const struct editor_world *world, const struct warning *warning);

#endif
