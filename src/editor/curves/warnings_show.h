/// The markers of warnings, and their words.
#ifndef EDITOR_CURVES_WARNINGS_SHOW_H
#define EDITOR_CURVES_WARNINGS_SHOW_H

#include "editor/curves/state.h"

/// Where a warning's marker is, in logical pixels; false where it is out of sight.
bool warning_place(const struct curves *curves, const struct core *core, const struct warning *warning, float xy[2]);
/// The markers.
void warnings_show(const struct curves *curves, struct core *core);
/// Words under the pointer; after everything else, so that nothing lies over them.
void warnings_show_words(const struct curves *curves, struct core *core);

#endif
