/// Warnings about the active spline: found, shown, and fixed by a click.
#ifndef EDITOR_CURVES_WARNINGS_H
#define EDITOR_CURVES_WARNINGS_H

#include "editor/curves/state.h"

/// Finds what is wrong with a solved spline. At most WARNINGS_MAX, spans in the order of time.
void warnings_find(const struct document *document, const struct evaluation *evaluation, int of,
                   struct warnings *found);
/// The same for the active spline where document or look have changed since; allocates nothing.
void warnings_update(struct curves *curves, const struct core *core, const struct editor_world *world);

/// Where a warning's marker is, in logical pixels; false where it is out of sight.
bool warning_place(const struct curves *curves, const struct core *core, const struct warning *warning, float xy[2]);
/// The markers.
void warnings_show(const struct curves *curves, struct core *core);
/// Words under the pointer; after everything else, so that nothing lies over them.
void warnings_show_words(const struct curves *curves, struct core *core);

/// Fixes a warning, as one undo step: tries the remedies in turn and keeps the first that helps.
void warning_remedy(const struct curves *curves, struct core *core, const struct editor_world *world,
                    const struct warning *warning);

#endif
